#include "engine/gather/realtime_plan.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace petzval::engine {
namespace {

using kernel::PointSpread;
constexpr int kSide = 64;                           // cells of a shape
constexpr float kHalf = float(LampKernels::kHalf);  // half its side, in radii

// A spiral whose turns are as far apart as its taps: each tap stands for as much of the disc, and none have
// the same radius. The four sets are its turns by a quarter, so together they have four arms and an even rim.
// Cells are read a little finer than taps are apart, because their means would soften the disc's rim.
void add_taps(int taps, const RealtimeZones& zones, std::vector<Rgba>& fours) {
    constexpr double kFiner = 0.75;
    fours.push_back({float(taps), float(kFiner * std::sqrt(std::numbers::pi / taps)), float(zones.columns),
                     float(zones.rows)});
    for (int set = 0; set < RealtimeLens::kSets; ++set)
        for (int i = 0; i < RealtimeLens::kMostTaps; ++i) {
            const double area = i == 0 || i >= taps ? 0 : i + 0.5;  // the first is for tiny discs
            const double r = std::sqrt(area / taps),
                         angle = 2 * std::numbers::pi * (std::sqrt(area / 3) + 0.25 * set);
            fours.push_back({float(r * std::cos(angle)), float(r * std::sin(angle)), float(r),
                             float(std::exp2(-8 * r * r))});
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

// The disc over -kHalf...kHalf radii; 1 is the mean over an even disc.
std::vector<Rgba> shape_of(const PointSpread& spread, double radius_px) {
    std::vector<Rgba> shape;
    const double cell = 2.0 * double(kHalf) / kSide * radius_px;
    const auto scale = float(std::numbers::pi * radius_px * radius_px);
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x)
            shape.push_back(
                mean_weight(spread, (x - 0.5 * kSide) * cell, (y - 0.5 * kSide) * cell, cell, scale));
    return shape;
}

// Makes kernels of the lamps' radii from a kernel of radius_px.
void add_lamp_kernels(const PointSpread& spread, double radius_px, std::size_t begins,
                      std::vector<Rgba>& fours) {
    double lamp_px = LampKernels::kFirstPx;
    for (int i = 0; i < LampKernels::kSteps; ++i, lamp_px *= std::numbers::sqrt2) {
        const int half = LampKernels::half_side(lamp_px), per_px = LampKernels::cells_per_px(lamp_px);
        const double cell = radius_px / (lamp_px * per_px), pixel = cell * per_px;
        fours[begins + std::size_t(i)] = {float(fours.size()), float(half), float(lamp_px * per_px), 0};
        const std::size_t first = fours.size();
        Rgba sum;
        for (int y = -half; y <= half; ++y)
            for (int x = -half; x <= half; ++x) {
                const bool is_rim = std::max(std::abs(x), std::abs(y)) == half;
                fours.push_back(is_rim ? Rgba{}
                                       : mean_weight(spread, x * cell - 0.5 * pixel, y * cell - 0.5 * pixel,
                                                     pixel, float(cell * cell)));
                sum += fours.back();
            }
        // Light beyond the square is given to the cells inside it.
        for (std::size_t k = first; k < fours.size(); ++k) {
            Rgba& f = fours[k];
            f = {f.r / sum.r, f.g / sum.g, f.b / sum.b, f.a / sum.a};
        }
    }
}

// Weight of a tap for a surface blurred by a fraction of the disc's radius. Few taps count for the smallest
// radii, so these are even discs: a shape with a dark middle would lose them.
Rgba weight_of(const std::vector<Rgba>& shape, const Rgba& tap, float share) {
    const float u = -tap.r / share, v = -tap.g / share;
    const int x = int(std::floor((u / kHalf * 0.5f + 0.5f) * kSide));
    const int y = int(std::floor((v / kHalf * 0.5f + 0.5f) * kSide));
    const bool is_inside = x >= 0 && y >= 0 && x < kSide && y < kSide;
    const Rgba own = is_inside ? shape[std::size_t(y * kSide + x)] : Rgba{};
    const float t = std::clamp((share - 0.15f) / 0.2f, 0.0f, 1.0f), shaped = t * t * (3 - 2 * t);
    const float even = u * u + v * v <= 1 ? 1 - shaped : 0;
    return Rgba{even, even, even, even} + shaped * own;
}

// A plane blurred by any share of the disc's radius keeps its light.
void add_weights(const std::vector<Rgba>& shape, std::vector<Rgba>& fours) {
    constexpr float kLeast = 0.05f;
    constexpr int kShares = RealtimeLens::kShares;
    const auto taps = std::size_t(fours[0].r);
    for (std::size_t set = 0; set < RealtimeLens::kSets; ++set) {
        const std::size_t begins = fours.size(), first = 1 + set * RealtimeLens::kMostTaps;
        fours.resize(begins + std::size_t(RealtimeLens::kMostTaps) * kShares);
        for (int k = 0; k < kShares; ++k) {
            const float share = std::max(float(k) / (kShares - 1), 1e-3f);
            const auto at = [&](std::size_t i) -> Rgba& {
                return fours[begins + i * kShares + std::size_t(k)];
            };
            Rgba sum;
            for (std::size_t i = 0; i < taps; ++i) sum += at(i) = weight_of(shape, fours[first + i], share);
            for (std::size_t i = 0; i < taps; ++i) {
                Rgba& w = at(i);
                w = {w.r / std::max(sum.r, kLeast), w.g / std::max(sum.g, kLeast),
                     w.b / std::max(sum.b, kLeast), w.a / std::max(sum.a, kLeast)};
            }
        }
    }
}

void add_zone(const kernel::LensModel& lens, kernel::FieldPosition field, double near_px, double far_px,
              std::vector<Rgba>& fours) {
    const PointSpread near_spread = lens.point_spread(-near_px, field),
                      far_spread = lens.point_spread(far_px, field);
    add_weights(shape_of(near_spread, near_px), fours);
    add_weights(shape_of(far_spread, far_px), fours);
    const std::size_t lamps = fours.size();
    fours.resize(lamps + 2 * std::size_t(LampKernels::kSteps));
    add_lamp_kernels(near_spread, near_px, lamps, fours);
    add_lamp_kernels(far_spread, far_px, lamps + LampKernels::kSteps, fours);
}

}  // namespace

kernel::FieldPosition RealtimeZones::at(std::uint32_t zone) const {
    const auto place = [](std::uint32_t node, std::uint32_t count) {
        return count == 1 ? 0.0 : 2.0 * node / (count - 1) - 1;
    };
    return {half_width * place(zone % columns, columns), -half_height * place(zone / columns, rows)};
}

RealtimeZones realtime_zones(const kernel::LensModel& lens, double width, double height) {
    if (!lens.varies_over_field()) return {};
    const double diagonal = std::hypot(width, height);
    const bool is_wide = width >= height;
    return {is_wide ? 9u : 5u, is_wide ? 5u : 9u, width / diagonal, height / diagonal};
}

int realtime_taps(Quality quality) {
    switch (quality) {
        case Quality::Draft:
            return 24;
        case Quality::Standard:
            return 48;
        default:
            return RealtimeLens::kMostTaps;
    }
}

RealtimeLens realtime_lens(const kernel::LensModel& lens, const RealtimeZones& zones, double near_radius_px,
                           double far_radius_px, int taps) {
    // Radii of the kernel: large enough to show its shape, small enough to be made in a moment.
    constexpr double kLeastPx = 16, kMostPx = 64;
    RealtimeLens made;
    std::vector<Rgba>& fours = made.fours;
    fours.reserve(RealtimeLens::kWeights + zones.count() * RealtimeLens::kOfZone);
    add_taps(taps, zones, fours);
    const double near_px = std::clamp(near_radius_px, kLeastPx, kMostPx),
                 far_px = std::clamp(far_radius_px, kLeastPx, kMostPx);
    for (std::uint32_t zone = 0; zone < zones.count(); ++zone)
        add_zone(lens, zones.at(zone), near_px, far_px, fours);
    return made;
}

}  // namespace petzval::engine
