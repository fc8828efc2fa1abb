#include "engine/scatter/scatter_kernels.h"

#include "engine/scatter/sectors.h"
#include "kernel/model/pieces.h"
#include "kernel/model/radius_on_grid.h"
#include "kernel/model/spread.h"

#include <algorithm>
#include <cmath>

namespace petzval::engine {
namespace {

constexpr float kStepsPerCell = 16;
// The light that a narrow disc keeps in its own pixel changes fast with the radius: with coarse steps one row
// of a slope covers 2 % too little and the hidden surface shows through. Below kNarrowCells steps are finer.
constexpr float kNarrowCells = 2, kNarrowSteps = 64;
constexpr float kMadePerCell = 4;  // for lenses whose kernels take long; rims a quarter cell apart blend
constexpr int kZonesX = 9, kZonesY = 6;
constexpr float kCoreEnd = 1.5f;       // end of the core, as a multiple of the level's radius
constexpr float kTrace = 0.004f;       // smaller fractions of light outside the core get no skirt
constexpr float kNegligible = 0.001f;  // fraction of all light that may be cut off a piece

// A kernel that reaches farther than this in focus, in cells, is nowhere narrow: its rims are as far apart
// from step to step as its rays, and blend.
constexpr int kBlurredCells = 8;
constexpr float kBlurredSteps = 4;

// Position of a radius >= 0 on the scale of steps; and back.
float place_of(float radius, bool blurred) {
    if (blurred) return radius * kBlurredSteps;
    return radius < kNarrowCells ? radius * kNarrowSteps
                                 : kNarrowCells * kNarrowSteps + (radius - kNarrowCells) * kStepsPerCell;
}
float radius_at(float place, bool blurred) {
    if (blurred) return place / kBlurredSteps;
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

}  // namespace

std::string ScatterKernels::name_for(const LevelRule& rule) {
    return "scatter " + std::to_string(rule.inner_sectors) + "+" + std::to_string(rule.outer_sectors);
}

ScatterKernels::ScatterKernels(const LensOnPicture& lens, const LevelRule& rule)
    : KernelSource(name_for(rule), device::KernelUse::Stamped),
      lens_(lens.from(lens.frame.x0, lens.frame.y0)),
      levels_(int(lens.levels.size())),
      steps_(int(std::ceil(place_of(rule.largest_radius(), false))) + 2),
      inner_sectors_(rule.inner_sectors),
      outer_sectors_(rule.outer_sectors),
      core_begin_(rule.largest_cells),
      core_end_(kCoreEnd * rule.largest_cells) {
    if (lens.level(0).varies_over_field()) zones_x_ = kZonesX, zones_y_ = kZonesY;
    const int longest = int(std::ceil(core_end_));
    for (int l = 0; l < levels_; ++l) {
        const int reach = int(std::ceil(lens.level(l).reach_px(double(rule.largest_radius())) + 0.5));
        has_skirts_ = has_skirts_ || reach > longest;
        const bool blurred = lens.level(l).reach_px(0) > kBlurredCells;
        blurred_.push_back(blurred);
        reach_.push_back(std::min(reach, longest));
        int farthest = reach;
        for (int step = 0; step < steps_; ++step) {
            const double radius = double(radius_at(float(step) + 0.5f, blurred));
            const int own = int(std::ceil(lens.level(l).reach_px(radius) + 0.5));
            reach_of_radius_.push_back(short(std::min(own, reach_.back())));
            farthest = std::max(farthest, own);
        }
        most_skirt_levels_.push_back(farthest > longest ? skirt_levels_for(float(farthest) + 1) : 0);
    }
    skirt_levels_ = std::vector<std::atomic<short>>(has_skirts_ ? std::size_t(levels_ * 2 * steps_) : 0);
    for (auto& levels : skirt_levels_) levels = -1;
}

std::array<ScatterKernels::ZoneShare, 4> ScatterKernels::zones_for(const Rect& frame, int level, int x, int y,
                                                                   float radius) const {
    if (zones_x_ * zones_y_ == 1) return {{{0, 1}}};
    x += -frame.x0 >> level, y += -frame.y0 >> level;
    constexpr float kHidesTheChoice = 3;  // radius in cells from which the choice of a zone is invisible
    constexpr int kNarrow = 2;            // reach beyond the radius, in cells
    const bool nearly_sharp = std::abs(radius) < kHidesTheChoice;
    const double px = std::ldexp(x + 0.5, level) / lens_.frame.width() * zones_x_ - 0.5;
    const double py = std::ldexp(y + 0.5, level) / lens_.frame.height() * zones_y_ - 0.5;
    const auto zone = [&](double row, double column) {
        return std::clamp(int(std::floor(row)), 0, zones_y_ - 1) * zones_x_ +
               std::clamp(int(std::floor(column)), 0, zones_x_ - 1);
    };
    if (nearly_sharp && reach(level, radius) > int(std::abs(radius)) + kNarrow) {
        const float right = float(px - std::floor(px)), down = float(py - std::floor(py));
        return {{{zone(py, px), (1 - down) * (1 - right)},
                 {zone(py, px + 1), (1 - down) * right},
                 {zone(py + 1, px), down * (1 - right)},
                 {zone(py + 1, px + 1), down * right}}};
    }
    // Numbers 0…1 that fill every neighbourhood evenly: multiples of powers of the roots of x^3 = x + 1 and
    // x^4 = x + 1 (M. Roberts, "The unreasonable effectiveness of quasirandom sequences", 2018).
    const auto even = [&](double per_x, double per_y) {
        if (nearly_sharp) return 0.5;
        const double sum = x * per_x + y * per_y;
        return sum - std::floor(sum);
    };
    return {{{zone(py + even(0.8191725134, 0.6710436067), px + even(0.7548776662, 0.5698402910)), 1}}};
}

int ScatterKernels::step_of(int level, float radius) const {
    return std::min(int(place_of(std::abs(radius), blurred_[std::size_t(level)]) + 0.5f), steps_ - 1);
}

int ScatterKernels::reach(int level, float radius) const {
    level = std::min(level, levels_ - 1);
    return reach_of_radius_[std::size_t(level * steps_ + step_of(level, radius))];
}

device::KernelAsk ScatterKernels::ask_of(std::size_t number) const {
    device::KernelAsk ask;
    const auto take = [&](int count) {
        const auto digit = int(number % std::size_t(count));
        number /= std::size_t(count);
        return digit;
    };
    ask.by_sector = take(2) == 1;
    ask.piece = take(pieces());
    ask.step = take(2 * steps_) - steps_;
    ask.zone = take(zones_x_ * zones_y_);
    ask.level = int(number);
    return ask;
}

float ScatterKernels::radius_of(const Place& place) const {
    const bool blurred = blurred_[std::size_t(place.level)];
    return place.step < 0 ? -radius_at(float(~place.step), blurred) : radius_at(float(place.step), blurred);
}

kernel::PointSpread ScatterKernels::whole(const Place& at_place) const {
    const int column = at_place.zone % zones_x_, row = at_place.zone / zones_x_;
    const double x = (column + 0.5) * lens_.frame.width() / zones_x_ - 0.5;
    const double y = (row + 0.5) * lens_.frame.height() / zones_y_ - 0.5;
    const kernel::LensModel& lens = lens_.level(at_place.level);
    const auto made = [&](float r) { return lens.point_spread(double(r), lens_.field_at(x, y)); };
    const auto asked =
        float(kernel::radius_on_grid(double(radius_of(at_place)), kernel::blurs_in_focus(lens)));
    const float side = at_place.step < 0 ? -1 : 1;
    const float place = std::abs(asked) * kMadePerCell, first = std::floor(place);
    if (lens.is_quick() || place == first) return made(asked);
    // Slow kernels are computed at some radii and interpolated between them.
    const auto at = [&](float step) {
        return std::make_shared<const kernel::PointSpread>(made(side * step / kMadePerCell));
    };
    const kernel::Share shares[] = {{at(first), 1 - (place - first)}, {at(first + 1), place - first}};
    return kernel::mixed(shares);
}

kernel::PointSpread ScatterKernels::core(const kernel::PointSpread& whole, const Place& place) const {
    const int longest = int(std::ceil(core_end_));
    if (skirt_levels(place.level, radius_of(place)) > 0)
        return kernel::cut(whole, longest,
                           [&](float distance) { return kernel::fade(distance, core_begin_, core_end_); });
    // The kernel is scaled to make up for the light that is cut away.
    kernel::PointSpread rest = kernel::cut(whole, longest, [](float) { return 1.0f; });
    const Rgba sum = kernel::sum_of(rest);
    kernel::scale(rest, {1 / sum.r, 1 / sum.g, 1 / sum.b, 1 / sum.a});
    return rest;
}

Rgba ScatterKernels::light_of_core(const Place& place) const {
    {
        const std::lock_guard lock(mutex_);
        if (const auto known = light_of_core_.find(place); known != light_of_core_.end())
            return known->second;
    }
    const Rgba sum = kernel::sum_of(core(whole(place), place));
    const std::lock_guard lock(mutex_);
    return light_of_core_[place] = sum;
}

// The skirt: the light of the kernel outside its core.
kernel::PointSpread ScatterKernels::skirt(const kernel::PointSpread& whole, const Place& place,
                                          int skirt_of) const {
    const float share = 1 / float(1 << skirt_of);
    kernel::PointSpread cut_out = kernel::cut(whole, int(std::ceil(core_end_)), [&](float distance) {
        return 1 - kernel::fade(distance, core_begin_ * share, core_end_ * share);
    });
    const int finer = place.level - skirt_of;
    const float radius = radius_in_cells(radius_in_pixels(radius_of(place), place.level), finer);
    kernel::scale_to_rest(cut_out, light_of_core({finer, place.zone, ask(finer, 0, radius, 0, false).step}));
    return cut_out;
}

std::vector<device::KernelSource::Made> ScatterKernels::make(std::span<const device::KernelAsk> asks) const {
    std::vector<Made> made;
    const Place place{asks.front().level, asks.front().zone, asks.front().step};
    const kernel::PointSpread all = whole(place);
    for (const device::KernelAsk& ask : asks) {
        kernel::PointSpread piece;
        if (ask.piece > 0)
            piece = skirt(all, place, ask.piece);
        else if (has_skirts_)
            piece = core(all, place);
        else
            piece = {all.extent, all.weights.clone(), all.neutral};
        if (ask.piece == 0 && has_skirts_) {
            const std::lock_guard lock(mutex_);
            light_of_core_.try_emplace(place, kernel::sum_of(piece));
        }
        made.emplace_back();
        const auto keep = [&](kernel::PointSpread spread) {
            made.back().push_back(std::make_shared<const kernel::PointSpread>(std::move(spread)));
        };
        if (!ask.by_sector) {
            keep(std::move(piece));
            continue;
        }
        for (auto& sector : sectors_of(piece, inner_sectors_, outer_sectors_, place.step < 0))
            keep(std::move(sector));
    }
    return made;
}

std::size_t ScatterKernels::bytes() const {
    constexpr std::size_t kNode = 96;
    const std::lock_guard lock(mutex_);
    return sizeof(*this) + light_of_core_.size() * kNode + skirt_levels_.size() * sizeof(short) +
           reach_of_radius_.size() * sizeof(short);
}

int ScatterKernels::skirt_levels(int level, float radius) const {
    if (!has_skirts_) return 0;
    level = std::min(level, levels_ - 1);
    const int step = ask(level, 0, radius, 0, false).step;
    std::atomic<short>& known = skirt_levels_[std::size_t(level * 2 * steps_ + step + steps_)];
    if (known.load(std::memory_order_relaxed) < 0) known = short(find_skirt_levels(level, step));
    return known;
}

int ScatterKernels::skirt_levels_for(float farthest) const {
    return std::clamp(int(std::ceil(std::log2(farthest / core_end_))), 1, kMostSkirtLevels);
}

int ScatterKernels::coarsest_for(int level) const {
    int coarsest = level;
    for (int l = 0; l <= level; ++l)
        coarsest = std::max(coarsest, l + most_skirt_levels_[std::size_t(std::min(l, levels_ - 1))]);
    return coarsest;
}

// The number of levels that makes the skirt as small as a core where it is largest in the picture.
int ScatterKernels::find_skirt_levels(int level, int step) const {
    int levels = 0;
    const int centre = zones_y_ / 2 * zones_x_ + zones_x_ / 2, corner = 0;
    for (const int zone : {centre, corner}) {
        const std::vector<float> beyond = light_beyond(whole({level, zone, step}));
        if (radius_but_for(beyond, kTrace) > int(core_end_))
            levels = std::max(levels, skirt_levels_for(float(radius_but_for(beyond, kNegligible))));
        if (centre == corner) break;
    }
    return std::min(levels, most_skirt_levels_[std::size_t(level)]);
}

}  // namespace petzval::engine
