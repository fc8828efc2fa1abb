#include "kernel/model/gamut.h"

#include "base/cancel.h"
#include "kernel/model/spread.h"

#include <algorithm>
#include <numeric>
#include <span>
#include <vector>

namespace petzval::kernel {
namespace {

// A channel is complete when less than this fraction of its light is missing, as after rounding of weights.
constexpr double kPaid = 1e-6;
constexpr int kWider = 3;  // from one square of neighbours to the next

using Values = std::vector<double>;

// Sums over squares about each pixel; nothing lies outside of the kernel.
class SquareSums {
public:
    SquareSums(int width, int height)
        : width_(std::size_t(width)),
          height_(std::size_t(height)),
          running_(std::max(width_, height_) + 1),
          along_(width_ * height_) {}

    // The square of a pixel is 2 reach + 1 wide.
    void operator()(const Values& values, std::size_t reach, Values& sums) {
        for (std::size_t y = 0; y < height_; ++y) {
            check_cancelled();
            const double* row = values.data() + y * width_;
            std::partial_sum(row, row + width_, running_.begin() + 1);
            for (std::size_t x = 0; x < width_; ++x)
                along_[y * width_ + x] =
                    running_[std::min(x + reach + 1, width_)] - running_[x - std::min(reach, x)];
        }
        Values rows(width_, 0.0);
        for (std::size_t y = 0; y < std::min(reach, height_); ++y) add(rows, y, 1);
        for (std::size_t y = 0; y < height_; ++y) {
            if (y + reach < height_) add(rows, y + reach, 1);
            if (y > reach) add(rows, y - reach - 1, -1);
            std::copy(rows.begin(), rows.end(), sums.begin() + std::ptrdiff_t(y * width_));
        }
    }

private:
    void add(Values& rows, std::size_t y, double sign) const {
        const double* row = along_.data() + y * width_;
        for (std::size_t x = 0; x < width_; ++x) rows[x] += sign * row[x];
    }

    std::size_t width_, height_;
    Values running_, along_;
};

// Within growing squares, each pixel with missing light asks its neighbours, and each gives in proportion to
// its light and never more. Every step only moves light, so the sum stays.
void take_from_the_nearest(Values& light, int width, int height) {
    Values lacking(light.size());
    for (std::size_t i = 0; i < light.size(); ++i) {
        lacking[i] = std::max(0.0, -light[i]);
        light[i] = std::max(0.0, light[i]);
    }
    SquareSums square_sums(width, height);
    Values sums(light.size()), asked(light.size()), given(light.size());
    double owed = 1;
    for (int reach = 1; owed > kPaid && reach < kWider * std::max(width, height); reach *= kWider) {
        square_sums(light, std::size_t(reach), sums);
        for (std::size_t i = 0; i < light.size(); ++i)  // as a share of what the neighbours have
            asked[i] = lacking[i] > 0 && sums[i] > 0 ? std::min(1.0, lacking[i] / sums[i]) : 0;
        square_sums(asked, std::size_t(reach), sums);
        for (std::size_t i = 0; i < light.size(); ++i) {
            given[i] = light[i] / std::max(1.0, sums[i]);  // to each that asks, times its share
            light[i] = std::max(0.0, light[i] - given[i] * std::max(0.0, sums[i]));
        }
        square_sums(given, std::size_t(reach), sums);
        owed = 0;
        for (std::size_t i = 0; i < light.size(); ++i) {
            lacking[i] = std::max(0.0, lacking[i] - asked[i] * sums[i]);
            owed += lacking[i];
        }
    }
}

}  // namespace

void map_part_into_gamut(PointSpread& part) {
    if (part.neutral) return;
    const auto pixels = std::span(part.weights.pixels(), part.weights.size());
    for (const auto channel : {&Rgba::r, &Rgba::g, &Rgba::b}) {
        if (std::none_of(pixels.begin(), pixels.end(), [&](const Rgba& w) { return w.*channel < 0; }))
            continue;
        Values light;
        light.reserve(pixels.size());
        for (const Rgba& w : pixels) light.push_back(double(w.*channel));
        take_from_the_nearest(light, part.weights.width(), part.weights.height());
        for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i].*channel = float(light[i]);
    }
}

void map_into_gamut(PointSpread& spread) {
    if (spread.neutral) return;
    map_part_into_gamut(spread);
    normalise(spread);
}

void map_into_gamut(std::vector<Light>& rings) {
    for (const auto channel : {&Light::r, &Light::g, &Light::b}) {
        if (std::none_of(rings.begin(), rings.end(), [&](const Light& l) { return l.*channel < 0; }))
            continue;
        Values light;
        light.reserve(rings.size());
        for (const Light& ring : rings) light.push_back(ring.*channel);
        take_from_the_nearest(light, int(light.size()), 1);
        for (std::size_t i = 0; i < rings.size(); ++i) rings[i].*channel = light[i];
    }
}

}  // namespace petzval::kernel
