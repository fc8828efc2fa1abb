#include "engine/gather/realtime_plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
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
    for (int set = 0; set < RealtimeLens::kSpirals; ++set)
        for (int i = 0; i < taps; ++i) {
            const double area = i == 0 ? 0 : i + 0.5;  // the first is for tiny discs
            const double r = std::sqrt(area / taps),
                         angle = 2 * std::numbers::pi * (std::sqrt(area / 3) + 0.25 * set);
            fours.push_back({float(r * std::cos(angle)), float(r * std::sin(angle)), float(r),
                             float(std::exp2(-8 * r * r))});
        }
}

// Small discs take every cell that they reach, because taps on a spiral leave some out: half as many cells
// again as taps, in whole rings around the middle.
void add_grid(int taps, std::vector<Rgba>& fours) {
    constexpr int kFarthest = 8, kMost = RealtimeLens::kGridTaps - 1;
    constexpr double kBeyond = 0.6;         // cells: a disc reaches cells this far beyond its rim
    std::vector<std::array<int, 3>> cells;  // squared distance, place
    for (int y = -kFarthest; y <= kFarthest; ++y)
        for (int x = -kFarthest; x <= kFarthest; ++x) cells.push_back({x * x + y * y, x, y});
    std::sort(cells.begin(), cells.end());
    auto count = std::size_t(std::min(3 * taps / 2, kMost));
    while (cells[count][0] == cells[count - 1][0]) --count;
    const auto distance = [&](std::size_t i) { return std::sqrt(double(cells[i][0])); };
    const double radius = distance(count) - kBeyond;
    std::size_t reached = 0;
    for (std::size_t i = 0; i < RealtimeLens::kGridTaps; ++i) {
        while (reached < count && distance(reached) < double(i + 1) / 8 + kBeyond) ++reached;
        Rgba tap{0, 0, 0, i < std::size_t(kMost) ? float(reached) : float(radius)};
        if (i < count) {
            tap.r = float(cells[i][1] / radius), tap.g = float(cells[i][2] / radius);
            tap.b = float(distance(i) / radius);
        }
        fours.push_back(tap);
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
    constexpr double kEmptyRim = 1.5;  // cells: all four cells around a place within reach lie in the square
    double lamp_px = LampKernels::kFirstPx;
    for (int i = 0; i < LampKernels::kSteps; ++i, lamp_px *= std::numbers::sqrt2) {
        const int half = LampKernels::half_side(lamp_px), per_px = LampKernels::cells_per_px(lamp_px);
        const double cell = radius_px / (lamp_px * per_px), pixel = cell * per_px;
        const std::size_t first = fours.size();
        Rgba sum;
        double farthest = 0;
        for (int y = -half; y <= half; ++y)
            for (int x = -half; x <= half; ++x) {
                const double away = std::hypot(x, y);
                fours.push_back(away > half - kEmptyRim
                                    ? Rgba{}
                                    : mean_weight(spread, x * cell - 0.5 * pixel, y * cell - 0.5 * pixel,
                                                  pixel, float(cell * cell)));
                const Rgba& made = fours.back();
                if (made.r + made.g + made.b > 0) farthest = std::max(farthest, away);
                sum += made;
            }
        const double reach = farthest + std::numbers::sqrt2;  // a place lies between four cells
        fours[begins + std::size_t(i)] = {float(first), float(half), float(lamp_px * per_px),
                                          float(reach * reach)};
        // Light beyond the circle is given to the cells inside it.
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

// Light of the shape in a cell of the grid. radius: that of the grid's disc, in cells.
Rgba weight_of_cell(const std::vector<Rgba>& shape, const Rgba& tap, float share, float radius) {
    const float blur = std::max(share, 0.25f / radius);  // half a pixel, the smallest radius
    const float per_radius = kSide / (2 * kHalf), side = per_radius / (blur * radius);
    const auto begin = [&](float at) { return 0.5f * kSide - at / blur * per_radius - 0.5f * side; };
    const auto part = [side](float from, int i) {
        return std::max(0.0f, std::min(from + side, float(i + 1)) - std::max(from, float(i)));
    };
    const float x0 = begin(tap.r), y0 = begin(tap.g);
    Rgba sum;
    for (int y = std::max(0, int(y0)); y < kSide && float(y) < y0 + side; ++y)
        for (int x = std::max(0, int(x0)); x < kSide && float(x) < x0 + side; ++x)
            sum += part(x0, x) * part(y0, y) * shape[std::size_t(y * kSide + x)];
    return sum;
}

// A plane blurred by any share of the disc's radius keeps its light.
void add_weights(const std::vector<Rgba>& shape, RealtimeLens& lens) {
    constexpr float kLeast = 0.05f;
    constexpr int kShares = RealtimeLens::kShares;
    std::vector<Rgba>& fours = lens.fours;
    const float radius = fours[lens.first_zone() - 1].a;  // of the grid
    for (std::size_t set = 0; set <= RealtimeLens::kSpirals; ++set) {
        const std::size_t begins = fours.size(), first = 1 + set * std::size_t(lens.taps());
        const bool is_grid = set == RealtimeLens::kSpirals;
        const auto room = std::size_t(is_grid ? RealtimeLens::kGridTaps : lens.taps());
        const auto taps = std::size_t(is_grid ? fours[first + room - 2].a : fours[0].r);
        fours.resize(begins + room * kShares);
        for (int k = 0; k < kShares; ++k) {
            const float share = std::max(float(k) / (kShares - 1), 1e-3f);
            const auto at = [&](std::size_t i) -> Rgba& {
                return fours[begins + i * kShares + std::size_t(k)];
            };
            Rgba sum;
            for (std::size_t i = 0; i < taps; ++i) {
                const Rgba& tap = fours[first + i];
                at(i) = is_grid ? weight_of_cell(shape, tap, share, radius) : weight_of(shape, tap, share);
                sum += at(i);
            }
            for (std::size_t i = 0; i < taps; ++i) {
                Rgba& w = at(i);
                w = {w.r / std::max(sum.r, kLeast), w.g / std::max(sum.g, kLeast),
                     w.b / std::max(sum.b, kLeast), w.a / std::max(sum.a, kLeast)};
            }
        }
    }
}

void add_zone(const kernel::LensModel& lens, kernel::FieldPosition field, double near_px, double far_px,
              RealtimeLens& made) {
    const PointSpread near_spread = lens.point_spread(-near_px, field),
                      far_spread = lens.point_spread(far_px, field);
    add_weights(shape_of(near_spread, near_px), made);
    add_weights(shape_of(far_spread, far_px), made);
    std::vector<Rgba>& fours = made.fours;
    const std::size_t lamps = fours.size();
    fours.resize(lamps + 2 * std::size_t(LampKernels::kSteps));
    add_lamp_kernels(near_spread, near_px, lamps, fours);
    add_lamp_kernels(far_spread, far_px, lamps + LampKernels::kSteps, fours);
}

// Kernels are interpolated between zones, so a lamp reaches as far as in any of them.
void share_reaches(std::uint32_t zones, RealtimeLens& made) {
    const std::size_t of_zone = RealtimeLens::of_zone(made.taps()),
                      heads = made.first_zone() + of_zone - RealtimeLens::kOfLamps;
    for (std::size_t i = heads; i < heads + 2 * std::size_t(LampKernels::kSteps); ++i) {
        float most = 0;
        for (std::size_t zone = 0; zone < zones; ++zone)
            most = std::max(most, made.fours[i + zone * of_zone].a);
        for (std::size_t zone = 0; zone < zones; ++zone) made.fours[i + zone * of_zone].a = most;
    }
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
    add_taps(taps, zones, made.fours);
    made.fours.reserve(RealtimeLens::count(taps, zones.count()));
    add_grid(taps, made.fours);
    const double near_px = std::clamp(near_radius_px, kLeastPx, kMostPx),
                 far_px = std::clamp(far_radius_px, kLeastPx, kMostPx);
    for (std::uint32_t zone = 0; zone < zones.count(); ++zone)
        add_zone(lens, zones.at(zone), near_px, far_px, made);
    share_reaches(zones.count(), made);
    static_assert(sizeof(RealtimeLens::kMark) == sizeof made.fours[1].r);
    std::memcpy(&made.fours[1].r, RealtimeLens::kMark.data(), sizeof(RealtimeLens::kMark));
    return made;
}

RealtimeLens realtime_lens_of_host(const kernel::LensModel& lens, double width, double height,
                                   Quality quality) {
    constexpr double kRadiusPx = 45;
    return realtime_lens(lens, realtime_zones(lens, width, height), kRadiusPx, kRadiusPx,
                         realtime_taps(quality));
}

}  // namespace petzval::engine
