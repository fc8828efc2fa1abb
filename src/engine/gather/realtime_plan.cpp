#include "engine/gather/realtime_plan.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace petzval::engine {
namespace {

using kernel::PointSpread;
constexpr int kSide = RealtimeLens::kSide;
constexpr float kHalf = RealtimeLens::kHalf;

// Rings of 6, 12, … taps: each stands for as much of the disc.
void add_taps(std::vector<Rgba>& fours) {
    fours.push_back({0, 0, 0, 0});
    for (int ring = 1; ring <= RealtimeLens::kRings; ++ring)
        for (int i = 0; i < 6 * ring; ++i) {
            const double angle = 2 * std::numbers::pi * (i + 0.5 * (ring % 2)) / (6 * ring);
            const double r = ring / (RealtimeLens::kRings + 0.5);
            fours.push_back({float(r * std::cos(angle)), float(r * std::sin(angle)), float(r), 0});
        }
}

// The mean of a kernel's weights over a square of its pixels, times `scale`.
Rgba mean_weight(const PointSpread& spread, double x0, double y0, double side, float scale) {
    Rgba sum;
    const auto share = [side](double from, int pixel) {
        return std::max(0.0, std::min(from + side, pixel + 0.5) - std::max(from, pixel - 0.5));
    };
    const Rect& e = spread.extent;
    for (int y = std::max(e.y0, int(std::floor(y0 + 0.5))); y < e.y1 && y - 0.5 < y0 + side; ++y)
        for (int x = std::max(e.x0, int(std::floor(x0 + 0.5))); x < e.x1 && x - 0.5 < x0 + side; ++x)
            sum += float(share(x0, x) * share(y0, y) / (side * side)) * scale *
                   spread.weights(x - e.x0, y - e.y0);
    return sum;
}

void add_shape(const PointSpread& spread, double radius_px, std::vector<Rgba>& fours) {
    const double cell = 2.0 * double(kHalf) / kSide * radius_px;
    const auto scale = float(std::numbers::pi * radius_px * radius_px);
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x)
            fours.push_back(
                mean_weight(spread, (x - 0.5 * kSide) * cell, (y - 0.5 * kSide) * cell, cell, scale));
}

// A kernel of its own radius made into those of lamps' radii.
void add_lamp_kernels(const PointSpread& spread, double radius_px, std::size_t begins,
                      std::vector<Rgba>& fours) {
    double lamp_px = LampKernels::kFirstPx;
    for (int i = 0; i < LampKernels::kSteps; ++i, lamp_px *= std::numbers::sqrt2) {
        const int half = LampKernels::half_side(lamp_px);
        const double cell = radius_px / lamp_px;
        fours[begins + std::size_t(i)] = {float(fours.size()), float(half), float(lamp_px), 0};
        const std::size_t first = fours.size();
        Rgba sum;
        for (int y = -half; y <= half; ++y)
            for (int x = -half; x <= half; ++x) {
                const bool is_rim = std::max(std::abs(x), std::abs(y)) == half;
                fours.push_back(is_rim ? Rgba{}
                                       : mean_weight(spread, (x - 0.5) * cell, (y - 0.5) * cell, cell,
                                                     float(cell * cell)));
                sum += fours.back();
            }
        // Light that a shape throws beyond its square stays in it.
        for (std::size_t k = first; k < fours.size(); ++k) {
            Rgba& f = fours[k];
            f = {f.r / sum.r, f.g / sum.g, f.b / sum.b, f.a / sum.a};
        }
    }
}

// Weight of a tap for a surface blurred by a fraction of the disc's radius. Few taps count for the smallest
// radii, so these are even discs: a shape with a dark middle would lose them. Same as realtime_gather.comp.
float weight_of(const std::vector<Rgba>& fours, std::size_t shape, float u, float v, float share) {
    const int x = int(std::floor((u / kHalf * 0.5f + 0.5f) * kSide));
    const int y = int(std::floor((v / kHalf * 0.5f + 0.5f) * kSide));
    const bool is_inside = x >= 0 && y >= 0 && x < kSide && y < kSide;
    const float own = is_inside ? fours[shape + std::size_t(y * kSide + x)].a : 0;
    const float t = std::clamp((share - 0.15f) / 0.2f, 0.0f, 1.0f), shaped = t * t * (3 - 2 * t);
    const float even = u * u + v * v <= 1 ? 1 : 0;
    return even + shaped * (own - even);
}

// Sum of the taps' weights over a disc, for a plane that is blurred by a fraction of its radius.
float counted(const std::vector<Rgba>& fours, std::size_t shape, float share) {
    float sum = 0;
    for (int i = 0; i < RealtimeLens::kTaps; ++i) {
        const Rgba& tap = fours[std::size_t(i)];
        sum += weight_of(fours, shape, -tap.r / share, -tap.g / share, share);
    }
    return sum;
}

}  // namespace

RealtimeLens realtime_lens(const kernel::LensModel& lens, kernel::FieldPosition field, double near_radius_px,
                           double far_radius_px) {
    // Large enough to show the shape, no larger than can be made in a moment.
    constexpr double kLeastPx = 16, kMostPx = 64;
    RealtimeLens made;
    std::vector<Rgba>& fours = made.fours;
    fours.reserve(RealtimeLens::kFours);
    add_taps(fours);
    const std::size_t norms = fours.size();
    fours.resize(norms + RealtimeLens::kNorms);
    const std::size_t near = fours.size(), far = near + std::size_t(kSide) * kSide;
    const double near_px = std::clamp(near_radius_px, kLeastPx, kMostPx),
                 far_px = std::clamp(far_radius_px, kLeastPx, kMostPx);
    const PointSpread near_spread = lens.point_spread(-near_px, field),
                      far_spread = lens.point_spread(far_px, field);
    add_shape(near_spread, near_px, fours);
    add_shape(far_spread, far_px, fours);
    const std::size_t lamps = fours.size();
    fours.resize(lamps + 2 * std::size_t(LampKernels::kSteps));
    add_lamp_kernels(near_spread, near_px, lamps, fours);
    add_lamp_kernels(far_spread, far_px, lamps + LampKernels::kSteps, fours);
    for (int i = 0; i < RealtimeLens::kNorms; ++i) {
        const float share = std::max(float(i) / (RealtimeLens::kNorms - 1), 1e-3f);
        fours[norms + std::size_t(i)] = {1 / std::max(counted(fours, near, share), 0.05f),
                                         1 / std::max(counted(fours, far, share), 0.05f), 0, 0};
    }
    return made;
}

}  // namespace petzval::engine
