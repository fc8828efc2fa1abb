#include "engine/gather/gather_rings.h"

#include "base/bits.h"
#include "kernel/model/pieces.h"
#include "kernel/model/radius_on_grid.h"
#include "laws/surfaces.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace petzval::engine {
namespace {

using laws::kWithinPixelPx;
constexpr int kZonesX = 9, kZonesY = 6;

std::vector<float> steps_down_from(float largest_px, float ratio) {
    std::vector<float> radii;
    for (float r = largest_px; r > kWithinPixelPx; r /= ratio) radii.push_back(r);
    return radii;
}

// Radius on a level's grid. Sharing light between cells s pixels wide and enlarging again are tents: each
// blurs by (s^2 + 1/2) / 6 px^2 per axis, and the grid's own squares by s^2/12. A disc's second moment is
// r^2/4, so the kernel's is taken smaller by that much.
double radius_in_cells(const LensOnPicture& lens, double radius_px, int level) {
    if (level == 0) return kernel::radius_on_grid(radius_px, kernel::blurs_in_focus(lens.level(0)));
    const double s = std::ldexp(1.0, level);
    const double squared = radius_px * radius_px - (5 * s * s + 2) / 3;
    return std::copysign(std::sqrt(std::max(0.0, squared)) / s, radius_px);
}

// The largest offset of any weight of a ring's kernel, in cells of a level.
double reach_in_cells(const LensOnPicture& lens, float radius_px, int level) {
    return lens.level(level).reach_px(std::abs(radius_in_cells(lens, double(radius_px), level))) + 0.5;
}

// The size that decides how coarse a ring's cells are: its radius, or more where aberrations spread its light
// wider. Light that they spread much wider is skirt.
float size_of(const LensOnPicture& lens, float radius_px) {
    constexpr float kWidest = 1.5f;  // times the radius
    const float radius = std::abs(radius_px), reach = float(lens.level(0).reach_px(double(radius)));
    constexpr float kOwnPx = 1;  // lenses without aberrations reach so far beyond it
    return std::clamp(reach - kOwnPx, radius, kWidest * radius);
}

// The level on which the skirt of a kernel is gathered; 0: it has none.
int skirt_level_of(const LensOnPicture& lens, const RingRule& rule, float radius_px, int level) {
    if (reach_in_cells(lens, radius_px, level) <= double(rule.core_end(level)) + 1) return 0;
    const int coarsest = int(lens.levels.size()) - 1;
    int coarser = level + 1;
    while (coarser < coarsest && reach_in_cells(lens, radius_px, coarser) > double(rule.core_end(coarser)))
        ++coarser;
    return coarser <= coarsest ? coarser : 0;
}

}  // namespace

RingRule ring_rule(Quality quality) {
    switch (quality) {
        case Quality::Draft:
            return {.ratio = 1.3f, .full_res_px = 4, .largest_cells = 8, .full_res_core = 6};
        case Quality::Standard:
            return {};
        case Quality::Final:
            return {.ratio = 1.07f, .full_res_px = 12, .largest_cells = 24, .full_res_core = 16};
    }
    return {};
}

RingSizes::RingSizes(float nearest_px, float farthest_px, const RingRule& rule, const LensOnPicture& lens,
                     bool has_seams)
    : rule_(rule), has_seams_(has_seams) {
    const auto level_of = [&](float r) {
        if (r <= rule.full_res_px) return 0;
        return std::max(1, int(std::ceil(std::log2(size_of(lens, r) / rule.largest_cells) - 1e-4f)));
    };
    const auto add = [&](float radius, int level) {
        radii_px_.push_back(radius), levels_.push_back(level);
        skirt_levels_.push_back(skirt_level_of(lens, rule, radius, level));
    };
    // Two rings have one radius where the level changes, so that no light is shared between levels.
    const std::vector<float> near = steps_down_from(-nearest_px, rule.ratio);
    for (std::size_t i = 0; i < near.size(); ++i) {
        const int level = level_of(near[i]), next = i + 1 < near.size() ? level_of(near[i + 1]) : 0;
        add(-near[i], level);
        if (next != level) add(-near[i], next);
    }
    const int zero_of_rings = count();
    add(0, 0);
    std::vector<float> far = steps_down_from(farthest_px, rule.ratio);
    for (; !far.empty(); far.pop_back()) {
        const int level = level_of(far.back()), last = levels_.back();
        if (last != level) add(far.back(), last);
        add(far.back(), level);
    }
    put_in_order();
    const auto squared = [&](int ring) {
        const float r = radius_px(ring);
        return r * r;
    };
    for (int i = 0; i <= count(); ++i) {
        const int below = std::max(0, i - 1), above = std::min(i, count() - 1);
        const int inner = i <= zero_of_rings ? above : below, outer = i <= zero_of_rings ? below : above;
        const float apart = squared(outer) - squared(inner);
        // Larger radii than the last ring's belong to that ring alone.
        intervals_.push_back({inner, outer, apart > 0 ? squared(inner) : -1, apart > 0 ? 1 / apart : 1e30f});
    }
    constexpr int kSteps = 4096;
    const float width_px = radii_px_.back() - radii_px_.front();
    steps_per_px_ = width_px > 0 ? kSteps / width_px : 0;
    for (int i = 0; i <= kSteps; ++i) {
        const float start = radii_px_.front() + width_px * (float(i) - 0.01f) / kSteps;
        starts_.push_back(
            std::uint16_t(std::lower_bound(radii_px_.begin(), radii_px_.end(), start) - radii_px_.begin()));
    }
}

void RingSizes::put_in_order() {
    turn_of_.resize(2 * std::size_t(count()));
    seam_of_.assign(std::size_t(count()), -1);
    const auto put = [&](int ring, bool hidden) {
        turn_of_[std::size_t(2 * ring + (hidden ? 1 : 0))] = int(turns_.size());
        turns_.push_back({ring, hidden});
    };
    const auto put_seam = [&](int first) {
        for_each_in_seam(first, [&](int ring) { seam_of_[std::size_t(ring)] = int(turns_.size()); });
        turns_.push_back({.ring = first, .hidden = false, .is_seam = true});
    };
    const auto goes_on = [&](int ring, int beside) {
        return beside >= 0 && beside < count() && level(beside) == level(ring);
    };
    for (int ring = 0; ring < count(); ++ring) {
        put(ring, false);
        if (goes_on(ring, ring - 1)) put(ring - 1, true);
        if (!goes_on(ring, ring + 1)) put(ring, true);
        const int first = ring - kSeamRings + 1;
        if (first > 0 && level(first) == level(ring) && has_seam(first)) put_seam(first);
    }
}

int RingSizes::levels() const {
    return 1 + std::max(*std::max_element(levels_.begin(), levels_.end()),
                        *std::max_element(skirt_levels_.begin(), skirt_levels_.end()));
}

RingSizes::Sizes RingSizes::light_of(int level) const {
    Sizes sizes{std::numeric_limits<float>::infinity(), 0};
    for (int ring = 0; ring < count(); ++ring) {
        if (this->level(ring) != level && (level == 0 || skirt_level(ring) != level)) continue;
        if (radius_px(ring) == 0) sizes.above_px = -1;  // light in focus belongs to it
        // A ring extends to the next radii beside it, the outermost without end.
        for (const int step : {-1, 1}) {
            int beside = ring + step;
            if (beside >= 0 && beside < count() && radius_px(beside) == radius_px(ring)) beside += step;
            const float r = beside < 0 || beside == count() ? std::numeric_limits<float>::infinity()
                                                            : std::abs(radius_px(beside));
            sizes.above_px = std::min(sizes.above_px, r), sizes.below_px = std::max(sizes.below_px, r);
        }
        if (has_seam(ring))
            for_each_in_seam(
                ring, [&](int finer) { sizes.above_px = std::min(sizes.above_px, radius_px(finer - 1)); });
    }
    return sizes;
}

RingKernels::RingKernels(const LensOnPicture& lens, const RingSizes& sizes)
    : KernelSource("gather", device::KernelUse::Gathered),
      lens_(lens.from(lens.frame.x0, lens.frame.y0)),
      sizes_(sizes),
      reach_(std::size_t(sizes.levels()), 0) {
    zones_.frame = lens_.frame;
    if (lens.level(0).varies_over_field()) zones_.columns = kZonesX, zones_.rows = kZonesY;
    for (int ring = 0; ring < sizes.count(); ++ring) {
        const int level = sizes.level(ring), coarser = sizes.skirt_level(ring);
        const auto note = [&](int of_level, double most) {
            const double reach = std::min(most, reach_in_cells(lens, sizes.radius_px(ring), of_level));
            int& cells = reach_[std::size_t(of_level)];
            cells = std::max(cells, int(std::ceil(reach)));
        };
        note(level, coarser > 0 ? double(sizes.rule().core_end(level)) : 1e9);
        if (coarser > 0) note(coarser, 1e9);
    }
}

device::KernelAsk RingKernels::ask(int ring, int zone, bool skirt) const {
    const int own = sizes_.level(ring), level = skirt ? sizes_.skirt_level(ring) : own;
    return {.level = level, .zone = zone, .step = bits_as<int>(sizes_.radius_px(ring)), .piece = level - own};
}

kernel::PointSpread RingKernels::whole(int level, int zone, float radius_px) const {
    const int column = zone % zones_.columns, row = zone / zones_.columns;
    const double x = (column + 0.5) * lens_.frame.width() / zones_.columns - 0.5;
    const double y = (row + 0.5) * lens_.frame.height() / zones_.rows - 0.5;
    return lens_.level(level).point_spread(radius_in_cells(lens_, double(radius_px), level),
                                           lens_.field_at(x, y));
}

kernel::PointSpread RingKernels::core(int level, int zone, float radius_px) const {
    kernel::PointSpread all = whole(level, zone, radius_px);
    const RingRule& rule = sizes_.rule();
    if (skirt_level_of(lens_, rule, radius_px, level) == 0) return all;
    const float begin = rule.core_begin(level), end = rule.core_end(level);
    return kernel::cut(all, int(end), [&](float distance) { return kernel::fade(distance, begin, end); });
}

std::vector<device::KernelSource::Made> RingKernels::make(std::span<const device::KernelAsk> asks) const {
    std::vector<Made> made;
    for (const device::KernelAsk& ask : asks) {
        const float radius_px = bits_as<float>(ask.step);
        kernel::PointSpread piece;
        if (ask.piece == 0) {
            piece = core(ask.level, ask.zone, radius_px);
        } else {
            const int own = ask.level - ask.piece;
            const float share = 1 / float(1 << ask.piece), begin = share * sizes_.rule().core_begin(own),
                        end = share * sizes_.rule().core_end(own);
            constexpr int kAll = 1 << 20;
            piece = kernel::cut(whole(ask.level, ask.zone, radius_px), kAll,
                                [&](float distance) { return 1 - kernel::fade(distance, begin, end); });
            kernel::scale_to_rest(piece, kernel::sum_of(core(own, ask.zone, radius_px)));
        }
        made.push_back({std::make_shared<const kernel::PointSpread>(std::move(piece))});
    }
    return made;
}

}  // namespace petzval::engine
