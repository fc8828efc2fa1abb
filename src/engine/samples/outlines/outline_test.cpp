// Shares told from depth alone, against the true coverage of drawn things.
#include "engine/samples/outlines/outline.h"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

namespace petzval::engine {
namespace {

constexpr int kSide = 64;

using Inside = std::function<bool(float, float)>;

float covered(const Inside& inside, int x, int y) {
    constexpr int kFine = 8;
    int n = 0;
    for (int i = 0; i < kFine * kFine; ++i)
        n += inside(float(x) + (float(i % kFine) + 0.5f) / kFine,
                    float(y) + (float(i / kFine) + 0.5f) / kFine);
    return float(n) / (kFine * kFine);
}

// Agreement at pixels beside pixels of the other side.
struct Agreement {
    double correlation = 0, rms = 0;
};
Agreement agreement(const Inside& inside) {
    Plane coc(kSide, kSide, 10);
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x)
            if (inside(float(x) + 0.5f, float(y) + 0.5f)) coc(x, y) = 0;
    double n = 0, a = 0, b = 0, aa = 0, bb = 0, ab = 0, error = 0;
    for (int y = 6; y < kSide - 6; ++y)
        for (int x = 6; x < kSide - 6; ++x) {
            const bool shows_near = coc(x, y) < 5;
            bool beside = false;
            for (int v = y - 1; v <= y + 1; ++v)
                for (int u = x - 1; u <= x + 1; ++u) beside = beside || (coc(u, v) < 5) != shows_near;
            if (!beside) continue;
            const double share = double(Outline(coc, x, y, 5).near_share()),
                         truth = double(covered(inside, x, y));
            ++n, a += share, b += truth, aa += share * share, bb += truth * truth, ab += share * truth;
            error += (share - truth) * (share - truth);
        }
    const double covariance = ab / n - a / n * (b / n);
    return {covariance / std::sqrt((aa / n - a / n * (a / n)) * (bb / n - b / n * (b / n))),
            std::sqrt(error / n)};
}

// Bent strands, some pixels apart.
Inside strands(float width_px) {
    return [=](float x, float y) {
        return std::fmod(200 + x + 0.43f * y + 0.004f * y * y, 11.0f) < width_px * 1.2f;
    };
}

TEST(Outline, TellsTheShareOfStrands) {
    for (const float width : {0.7f, 1.0f, 1.8f}) {
        EXPECT_GE(agreement(strands(width)).correlation, 0.9) << width;
        EXPECT_LE(agreement(strands(width)).rms, 0.14) << width;
    }
}

TEST(Outline, TellsTheShareOfEdgesAndDiscs) {
    const Inside edge = [](float x, float y) { return x + 0.3f * y < 41; };
    const Inside disc = [](float x, float y) { return std::hypot(x - 31.3f, y - 32.6f) < 17; };
    for (const Inside& inside : {edge, disc}) {
        EXPECT_GE(agreement(inside).correlation, 0.95);
        EXPECT_LE(agreement(inside).rms, 0.12);
    }
}

}  // namespace
}  // namespace petzval::engine
