#include "depth/filtered_edges.h"

#include "base/parallel.h"
#include "depth/soft_edges.h"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

namespace petzval {
namespace {

constexpr int kWide = 96, kHigh = 64, kParts = 8;  // parts of a pixel, along each side
constexpr float kNearM = 1, kFarM = 4, kSkyM = 1e10f;
constexpr Rgba kOrange{0.6f, 0.3f, 0.1f, 1}, kGrey{0.2f, 0.25f, 0.3f, 1};

struct Filtering {
    Plane centres, means, inverse_means;
    Picture colour;

    Filtering(const std::function<float(float x, float y)>& depth_m)
        : centres(kWide, kHigh), means(kWide, kHigh), inverse_means(kWide, kHigh), colour(kWide, kHigh) {
        for (int y = 0; y < kHigh; ++y)
            for (int x = 0; x < kWide; ++x) {
                centres(x, y) = depth_m(float(x) + 0.5f, float(y) + 0.5f);
                for (int part = 0; part < kParts * kParts; ++part) {
                    const int column = part % kParts, row = part / kParts;
                    const float u = (float(column) + 0.5f) / kParts, v = (float(row) + 0.5f) / kParts;
                    const float z = depth_m(float(x) + u, float(y) + v);
                    means(x, y) += z / (kParts * kParts);
                    colour(x, y) += (z == kNearM ? kOrange : kGrey) * (1.0f / (kParts * kParts));
                }
                inverse_means(x, y) = 1 / means(x, y);
            }
    }
    EdgeSoftness softness() const { return edge_softness(inverse_means, one_thread()); }
    Plane unfiltered() const {
        return without_filter(colour, {means, inverse_means, false, 0.01f * softness().range}, one_thread());
    }
};

float disc_before(float far, float x, float y) { return std::hypot(x - 40, y - 30) < 20 ? kNearM : far; }

int pixels_elsewhere(const Plane& found, const Plane& exact) {
    int count = 0;
    for (std::size_t i = 0; i < exact.size(); ++i)
        count += std::abs(1 / found.pixels()[i] - 1 / exact.pixels()[i]) > 0.01f;
    return count;
}

TEST(FilteredEdges, AreFoundByTheirShare) {
    const Filtering discs([](float x, float y) {
        return std::hypot(std::fmod(x, 16.0f) - 8, std::fmod(y, 16.0f) - 8) < 6.3f ? kNearM : kFarM;
    });
    EXPECT_TRUE(discs.softness().is_filtered());
    EXPECT_FALSE(discs.softness().is_soft());
    Plane exact = discs.centres.clone();
    for (std::size_t i = 0; i < exact.size(); ++i) exact.pixels()[i] = 1 / exact.pixels()[i];
    EXPECT_FALSE(edge_softness(exact, one_thread()).is_filtered());
}

TEST(FilteredEdges, BelongToTheSideThatCoversMore) {
    for (const float far : {kFarM, kSkyM}) {
        const Filtering disc([&](float x, float y) { return disc_before(far, x, y); });
        EXPECT_GT(pixels_elsewhere(disc.means, disc.centres), 60);
        EXPECT_LT(pixels_elsewhere(disc.unfiltered(), disc.centres), 8) << far;
    }
}

TEST(FilteredEdges, ABoxInPerspectiveKeepsItsTop) {
    const auto box = [](float x, float y) {
        if (x < 20 || y < 30) return 40 - 0.5f * y;
        return std::max(kNearM, kNearM + 0.1f * (34 - y));
    };
    const Filtering filtered(box);
    const Plane found = filtered.unfiltered();
    for (int x = 30; x < kWide; ++x)
        for (int y = 30; y < 34; ++y) EXPECT_EQ(found(x, y), filtered.means(x, y)) << x << " " << y;
}

TEST(FilteredEdges, AFloorKeepsItsBits) {
    const Filtering floor([](float, float y) { return 200 / (y + 1); });
    EXPECT_EQ(pixels_elsewhere(floor.unfiltered(), floor.means), 0);
    EXPECT_FALSE(floor.softness().is_filtered());
}

TEST(FilteredEdges, ExactDepthKeepsItsBits) {
    const Filtering disc([](float x, float y) { return disc_before(kFarM, std::floor(x), std::floor(y)); });
    EXPECT_EQ(pixels_elsewhere(disc.unfiltered(), disc.centres), 0);
}

// The wire crosses each pixel's square in another place; the pixels with the most of it show its depth.
TEST(FilteredEdges, AWireThinnerThanAPixelIsOfOneDepth) {
    const Filtering wire(
        [](float x, float y) { return std::abs(x - 30 - 0.3f * y) < 0.45f ? kNearM : kFarM; });
    const Plane found = wire.unfiltered();
    int mixed = 0;
    for (int y = 8; y + 8 < kHigh; ++y) {
        const int x = int(30 + 0.3f * (float(y) + 0.5f));
        mixed += wire.means(x, y) > 1.5f;
        EXPECT_LT(found(x, y), 1.5f) << y;
        EXPECT_EQ(found(x - 3, y), kFarM);
        EXPECT_EQ(found(x + 3, y), kFarM);
    }
    EXPECT_GT(mixed, 12);
}

}  // namespace
}  // namespace petzval
