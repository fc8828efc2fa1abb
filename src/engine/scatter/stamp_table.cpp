#include "engine/scatter/stamp_table.h"

#include "kernel/model/spread.h"

#include <algorithm>
#include <cmath>

namespace petzval::engine {
namespace {

constexpr float kStepsPerCell = 16;
// What a narrow disc leaves in its own pixel changes fast: coarse steps would make one row of a slope cover
// 2 % too little, and let what is hidden show through. Below kNarrowCells steps are finer.
constexpr float kNarrowCells = 2, kNarrowSteps = 64;
constexpr float kMadePerCell = 4;  // of lenses that take long; rims a quarter cell apart blend
constexpr int kPartsX = 9, kPartsY = 6;
constexpr float kCoreEnd = 1.5f;       // times the radius a level is made for
constexpr float kTrace = 0.004f;       // share of light outside that is not worth a skirt
constexpr float kNegligible = 0.001f;  // share of light in all that is cut away from a piece

// Of a radius >= 0, on the scale of steps; and back.
float place_of(float radius) {
    return radius < kNarrowCells ? radius * kNarrowSteps
                                 : kNarrowCells * kNarrowSteps + (radius - kNarrowCells) * kStepsPerCell;
}
float radius_at(float place) {
    constexpr float kFine = kNarrowCells * kNarrowSteps;
    return place < kFine ? place / kNarrowSteps : kNarrowCells + (place - kFine) / kStepsPerCell;
}

// The light of a kernel from each whole distance outwards.
std::vector<float> light_beyond(const kernel::PointSpread& spread) {
    const Rect e = spread.extent;
    const int farthest = int(std::hypot(std::max(-e.x0, e.x1), std::max(-e.y0, e.y1))) + 2;
    std::vector<float> beyond(std::size_t(farthest), 0);
    for (int y = e.y0; y < e.y1; ++y)
        for (int x = e.x0; x < e.x1; ++x)
            beyond[std::size_t(std::hypot(x, y))] += spread.weights(x - e.x0, y - e.y0).a;
    for (std::size_t i = beyond.size() - 1; i > 0; --i) beyond[i - 1] += beyond[i];
    return beyond;
}

// The distance outside of which there is at most this share of the light.
int radius_but_for(const std::vector<float>& beyond, float share) {
    int radius = int(beyond.size());
    while (radius > 0 && beyond[std::size_t(radius - 1)] <= share * beyond[0]) --radius;
    return radius;
}

// 1 up to `begin`, 0 from `end` on: smoothstep.
float fade(float distance, float begin, float end) {
    const float t = std::clamp((end - distance) / (end - begin), 0.0f, 1.0f);
    return t * t * (3 - 2 * t);
}

// The part of a kernel within `radius` of its middle, each weight times factor(distance).
template <typename Factor>
kernel::PointSpread cut(const kernel::PointSpread& spread, int radius, const Factor& factor) {
    const Rect from = spread.extent, e = from.intersected({-radius, -radius, radius + 1, radius + 1});
    kernel::PointSpread piece{e, Picture(e.width(), e.height()), spread.neutral};
    for (int y = e.y0; y < e.y1; ++y)
        for (int x = e.x0; x < e.x1; ++x) {
            const float distance = float(std::hypot(x, y));
            if (distance <= float(radius))
                piece.weights(x - e.x0, y - e.y0) =
                    spread.weights(x - from.x0, y - from.y0) * factor(distance);
        }
    return piece;
}

Rgba sum_of(const kernel::PointSpread& spread) {
    Rgba sum;
    for (std::size_t i = 0; i < spread.weights.size(); ++i) sum += spread.weights.pixels()[i];
    return sum;
}

void scale(kernel::PointSpread& spread, Rgba by) {
    for (std::size_t i = 0; i < spread.weights.size(); ++i) {
        Rgba& w = spread.weights.pixels()[i];
        w = {w.r * by.r, w.g * by.g, w.b * by.b, w.a * by.a};
    }
}

// Keeps what was made in a slot, unless another thread was first (with the same).
template <typename T>
const T& keep_first(std::atomic<const T*>& slot, std::unique_ptr<const T> made) {
    const T* expected = nullptr;
    if (slot.compare_exchange_strong(expected, made.get(), std::memory_order_acq_rel)) return *made.release();
    return *expected;
}

}  // namespace

StampTable::StampTable(const LensOnPicture& lens, int width, int height, const LevelRule& rule)
    : lens_(lens),
      width_(width),
      height_(height),
      levels_(int(lens.lens_levels.size())),
      steps_(int(std::ceil(place_of(rule.largest_radius()))) + 2),
      inner_cells_(rule.inner_cells),
      outer_cells_(rule.outer_cells),
      core_begin_(rule.largest_cells),
      core_end_(kCoreEnd * rule.largest_cells) {
    if (lens.lens(0).varies_over_field()) parts_x_ = kPartsX, parts_y_ = kPartsY;
    const int longest = int(std::ceil(core_end_));
    for (int l = 0; l < levels_; ++l) {
        const int reach = int(std::ceil(lens.lens(l).reach_px(double(rule.largest_radius())) + 0.5));
        has_skirts_ = has_skirts_ || reach > longest;
        reach_.push_back(std::min(reach, longest));
        int farthest = reach;
        for (int step = 0; step < steps_; ++step) {
            const double radius = double(radius_at(float(step) + 0.5f));
            const int own = int(std::ceil(lens.lens(l).reach_px(radius) + 0.5));
            reach_of_radius_.push_back(short(std::min(own, reach_.back())));
            farthest = std::max(farthest, own);
        }
        most_skirt_levels_.push_back(farthest > longest ? skirt_levels_for(float(farthest) + 1) : 0);
    }
    const std::size_t radii = std::size_t(levels_ * 2 * steps_);
    kernels_ = std::vector<std::atomic<const Kernel*>>(
        radii * std::size_t(parts_x_ * parts_y_ * (has_skirts_ ? 1 + kMostSkirtLevels : 1)));
    skirt_levels_ = std::vector<std::atomic<short>>(has_skirts_ ? radii : 0);
    for (auto& levels : skirt_levels_) levels = -1;
}

StampTable::~StampTable() {
    for (auto& kernel : kernels_) delete kernel.load();
}

std::array<StampTable::PartShare, 4> StampTable::parts_for(int level, int x, int y, float radius) const {
    if (parts_x_ * parts_y_ == 1) return {{{0, 1}}};
    constexpr float kHidesTheChoice = 3;  // cells of radius
    constexpr int kNarrow = 2;            // cells beyond the radius
    const bool nearly_sharp = std::abs(radius) < kHidesTheChoice;
    const double px = std::ldexp(x + 0.5, level) / width_ * parts_x_ - 0.5;
    const double py = std::ldexp(y + 0.5, level) / height_ * parts_y_ - 0.5;
    const auto part = [&](double row, double column) {
        return std::clamp(int(std::floor(row)), 0, parts_y_ - 1) * parts_x_ +
               std::clamp(int(std::floor(column)), 0, parts_x_ - 1);
    };
    if (nearly_sharp && reach(level, radius) > int(std::abs(radius)) + kNarrow) {
        const float right = float(px - std::floor(px)), down = float(py - std::floor(py));
        return {{{part(py, px), (1 - down) * (1 - right)},
                 {part(py, px + 1), (1 - down) * right},
                 {part(py + 1, px), down * (1 - right)},
                 {part(py + 1, px + 1), down * right}}};
    }
    // Numbers 0…1 that fill every neighbourhood evenly: multiples of powers of the roots of x^3 = x + 1 and
    // x^4 = x + 1 (M. Roberts, "The unreasonable effectiveness of quasirandom sequences", 2018).
    const auto even = [&](double per_x, double per_y) {
        if (nearly_sharp) return 0.5;
        const double sum = x * per_x + y * per_y;
        return sum - std::floor(sum);
    };
    return {{{part(py + even(0.8191725134, 0.6710436067), px + even(0.7548776662, 0.5698402910)), 1}}};
}

int StampTable::step_of(float radius) const {
    return std::min(int(place_of(std::abs(radius)) + 0.5f), steps_ - 1);
}

int StampTable::reach(int level, float radius) const {
    return reach_of_radius_[std::size_t(std::min(level, levels_ - 1) * steps_ + step_of(radius))];
}

std::size_t StampTable::slot_of(int level, int part, float radius, int skirt_of) const {
    const int step = step_of(radius);
    const int side = radius < 0 ? 0 : 1, piece = skirt_of * parts_x_ * parts_y_ + part;
    return std::size_t(((piece * levels_ + level) * 2 + side) * steps_ + step);
}

float StampTable::stepped(float radius) const {
    return (radius < 0 ? -1 : 1) * radius_at(float(step_of(radius)));
}

kernel::PointSpread StampTable::whole(int level, int part, float radius) const {
    const int column = part % parts_x_, row = part / parts_x_;
    const double x = (column + 0.5) * width_ / parts_x_ - 0.5;
    const double y = (row + 0.5) * height_ / parts_y_ - 0.5;
    const kernel::LensModel& lens = lens_.lens(level);
    const auto made = [&](float r) { return lens.point_spread(double(r), lens_.field_at(x, y)); };
    const float asked = stepped(radius), side = radius < 0 ? -1 : 1;
    const float place = std::abs(asked) * kMadePerCell, first = std::floor(place);
    if (lens.is_quick() || place == first) return made(asked);
    // What takes long is made at some radii and mixed between them.
    const auto at = [&](float step) {
        return std::make_shared<const kernel::PointSpread>(made(side * step / kMadePerCell));
    };
    const kernel::Share shares[] = {{at(first), 1 - (place - first)}, {at(first + 1), place - first}};
    return kernel::mixed(shares);
}

kernel::PointSpread StampTable::piece(int level, int part, float radius, int skirt_of) const {
    kernel::PointSpread all = whole(level, part, radius);
    if (!has_skirts_) return all;
    const float finer = 1 / float(1 << skirt_of);
    const auto core = [&](float distance) { return fade(distance, core_begin_ * finer, core_end_ * finer); };
    const int longest = int(std::ceil(core_end_));
    if (skirt_of > 0)
        return skirt(cut(all, longest, [&](float d) { return 1 - core(d); }), level, part, radius, skirt_of);
    if (skirt_levels(level, radius) > 0) return cut(all, longest, core);
    // What little is cut away is made up for.
    kernel::PointSpread rest = cut(all, longest, [](float) { return 1.0f; });
    const Rgba sum = sum_of(rest);
    scale(rest, {1 / sum.r, 1 / sum.g, 1 / sum.b, 1 / sum.a});
    return rest;
}

// A skirt with just the light that its core lacks.
kernel::PointSpread StampTable::skirt(kernel::PointSpread cut_out, int level, int part, float radius,
                                      int skirt_of) const {
    const int finer = level - skirt_of;
    const Rgba core = sum_of(piece(finer, part, radius_in_cells(radius_in_pixels(radius, level), finer), 0));
    const Rgba sum = sum_of(cut_out);
    const auto factor = [](float has, float asked) {
        return has > 0 ? std::max(0.0f, 1 - asked) / has : 0.0f;
    };
    const Rgba f{factor(sum.r, core.r), factor(sum.g, core.g), factor(sum.b, core.b), factor(sum.a, core.a)};
    scale(cut_out, f);
    return cut_out;
}

const StampTable::Kernel& StampTable::kernel_at(int level, int part, float radius, int skirt_of) const {
    const std::size_t slot = slot_of(level, part, radius, skirt_of);
    if (const Kernel* kernel = kernels_[slot].load(std::memory_order_acquire)) return *kernel;
    return keep_first(kernels_[slot], std::make_unique<const Kernel>(
                                          StampKernel(piece(level, part, stepped(radius), skirt_of))));
}

std::span<const StampKernel, 1> StampTable::at(int level, int part, float radius, int skirt_of) const {
    const Kernel& kernel = kernel_at(std::min(level, levels_ - 1), part, radius, skirt_of);
    return std::span<const StampKernel, 1>(&kernel.whole, 1);
}

std::span<const StampKernel> StampTable::by_pupil_cell(int level, int part, float radius,
                                                       int skirt_of) const {
    level = std::min(level, levels_ - 1);
    const Kernel& kernel = kernel_at(level, part, radius, skirt_of);
    if (const Cells* cells = kernel.cells.load(std::memory_order_acquire)) return *cells;
    return keep_first(kernel.cells, cells_of(piece(level, part, stepped(radius), skirt_of), radius < 0));
}

// Cells of equal light: rings around the middle, cut across by angle. Taps that lie in several give to each.
// In front of focus the pupil appears turned by 180 degrees.
std::unique_ptr<const StampTable::Cells> StampTable::cells_of(const kernel::PointSpread& all,
                                                              bool turned) const {
    struct Grain {
        Rgba light;
        int x, y;
        double distance, turns;
    };
    const Rect e = all.extent;
    const int points = e.width() < 8 ? 4 : e.width() < 14 ? 2 : 1;  // per side of a pixel
    std::vector<Grain> grains;
    for (int y = e.y0; y < e.y1; ++y)
        for (int x = e.x0; x < e.x1; ++x) {
            const Rgba light = all.weights(x - e.x0, y - e.y0) * (1 / float(points * points));
            if (light.a <= 0) continue;
            for (int i = 0; i < points * points; ++i) {
                const int column = i % points, row = i / points;
                const double u = x + (column + 0.5) / points - 0.5, v = y + (row + 0.5) / points - 0.5;
                const double turns = std::atan2(v, u) / (2 * M_PI) + (turned ? 1 : 0.5);
                grains.push_back({light, x, y, std::hypot(u, v), turns - std::floor(turns)});
            }
        }
    const auto by = [&](std::size_t begin, std::size_t end, double Grain::*key) {
        std::stable_sort(grains.begin() + std::ptrdiff_t(begin), grains.begin() + std::ptrdiff_t(end),
                         [key](const Grain& a, const Grain& b) { return a.*key < b.*key; });
    };
    // Cuts the grains from `begin` on where their light comes to `light`; returns the first beyond.
    const auto cut_at = [&](std::size_t begin, float light) {
        float sum = 0;
        std::size_t i = begin;
        while (i < grains.size() && sum + grains[i].light.a <= light) sum += grains[i++].light.a;
        if (i == grains.size() || light - sum < 1e-7f) return i;
        const float share = (light - sum) / grains[i].light.a;
        Grain rest = grains[i];
        rest.light *= 1 - share, grains[i].light *= share;
        grains.insert(grains.begin() + std::ptrdiff_t(i) + 1, rest);
        return i + 1;
    };
    float whole = 0;
    for (const Grain& g : grains) whole += g.light.a;
    by(0, grains.size(), &Grain::distance);
    auto cells = std::make_unique<Cells>();
    std::size_t begin = 0;
    const float count = float(pupil_cells());
    for (const int in_ring : {inner_cells_, outer_cells_}) {
        const bool last_ring = in_ring == outer_cells_;
        std::size_t ring_end = last_ring ? grains.size() : cut_at(begin, whole * float(in_ring) / count);
        by(begin, ring_end, &Grain::turns);
        for (int i = 0; i < in_ring; ++i) {
            const std::size_t before = grains.size();
            const std::size_t end = i + 1 == in_ring ? ring_end : cut_at(begin, whole / count);
            ring_end += grains.size() - before;
            kernel::PointSpread part{e, Picture(e.width(), e.height()), all.neutral};
            for (; begin < end; ++begin)
                part.weights(grains[begin].x - e.x0, grains[begin].y - e.y0) += count * grains[begin].light;
            cells->emplace_back(part);
        }
    }
    return cells;
}

int StampTable::skirt_levels(int level, float radius) const {
    if (!has_skirts_) return 0;
    level = std::min(level, levels_ - 1);
    std::atomic<short>& known = skirt_levels_[slot_of(level, 0, radius, 0)];
    int levels = known.load(std::memory_order_relaxed);
    if (levels < 0) known = static_cast<short>(levels = find_skirt_levels(level, radius));
    return levels;
}

int StampTable::skirt_levels_for(float farthest) const {
    return std::clamp(int(std::ceil(std::log2(farthest / core_end_))), 1, kMostSkirtLevels);
}

int StampTable::coarsest_for(int level) const {
    int coarsest = level;
    for (int l = 0; l <= level; ++l)
        coarsest = std::max(coarsest, l + most_skirt_levels_[std::size_t(std::min(l, levels_ - 1))]);
    return coarsest;
}

// As many as make the skirt as small as a core, wherever in the picture it is largest.
int StampTable::find_skirt_levels(int level, float radius) const {
    int levels = 0;
    const int centre = parts_y_ / 2 * parts_x_ + parts_x_ / 2, corner = 0;
    for (const int part : {centre, corner}) {
        const std::vector<float> beyond = light_beyond(whole(level, part, radius));
        if (radius_but_for(beyond, kTrace) <= int(core_end_)) continue;
        levels = std::max(levels, skirt_levels_for(float(radius_but_for(beyond, kNegligible))));
    }
    return std::min(levels, most_skirt_levels_[std::size_t(level)]);
}

}  // namespace petzval::engine
