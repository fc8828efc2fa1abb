#include "engine/gather/gather_rings.h"

#include "base/bits.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace petzval::engine {
namespace {

// A disc of this radius lies within its pixel: light that is out of focus by less stays where it is.
constexpr float kWithinPixelPx = 0.5f;
constexpr int kZonesX = 9, kZonesY = 6;

std::vector<float> steps_down_from(float largest_px, float ratio) {
    std::vector<float> radii;
    for (float r = largest_px; r > kWithinPixelPx; r /= ratio) radii.push_back(r);
    return radii;
}

// Radius on a level's grid. Sharing light between cells s pixels wide and enlarging again are tents: each
// blurs by (s^2 + 1/2) / 6 px^2 per axis, and the grid's own squares by (s^2 - 1)/12 more than pixels. A
// disc's second moment is r^2/4, so the kernel's is taken smaller by that much.
double radius_in_cells(double radius_px, int level) {
    if (level == 0) return radius_px;
    const double s = std::ldexp(1.0, level);
    const double squared = radius_px * radius_px - (5 * s * s + 1) / 3;
    return std::copysign(std::sqrt(std::max(0.0, squared)) / s, radius_px);
}

}  // namespace

RingRule ring_rule(Quality quality) {
    switch (quality) {
        case Quality::Draft:
            return {.ratio = 1.3f, .full_res_px = 4, .largest_cells = 8};
        case Quality::Standard:
            return {};
        case Quality::Final:
            return {.ratio = 1.07f, .full_res_px = 12, .largest_cells = 24};
    }
    return {};
}

RingSizes::RingSizes(float nearest_px, float farthest_px, const RingRule& rule) {
    for (const float r : steps_down_from(-nearest_px, rule.ratio)) radii_px_.push_back(-r);
    const int zero_of_rings = count();
    radii_px_.push_back(0);
    const std::vector<float> far = steps_down_from(farthest_px, rule.ratio);
    radii_px_.insert(radii_px_.end(), far.rbegin(), far.rend());
    for (const float radius : radii_px_) {
        const float r = std::abs(radius);
        int level = 0;
        if (r > rule.full_res_px)
            level = std::max(1, int(std::ceil(std::log2(r / rule.largest_cells) - 1e-4f)));
        levels_.push_back(level);
    }
    put_in_order();
    const auto squared = [&](int ring) {
        const float r = std::max(std::abs(radius_px(ring)), kWithinPixelPx);
        return r * r;
    };
    for (int i = 0; i <= count(); ++i) {
        const int below = std::max(0, i - 1), above = std::min(i, count() - 1);
        const int inner = i <= zero_of_rings ? above : below, outer = i <= zero_of_rings ? below : above;
        const float apart = squared(outer) - squared(inner);
        // Beyond the largest radius there is nothing but that.
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
    const auto put = [&](int ring, bool hidden) {
        turn_of_[std::size_t(2 * ring + (hidden ? 1 : 0))] = int(turns_.size());
        turns_.push_back({ring, hidden});
    };
    const auto goes_on = [&](int ring, int beside) {
        return beside >= 0 && beside < count() && level(beside) == level(ring);
    };
    for (int ring = 0; ring < count(); ++ring) {
        put(ring, false);
        if (goes_on(ring, ring - 1)) put(ring - 1, true);
        if (!goes_on(ring, ring + 1)) put(ring, true);
    }
}

int RingSizes::levels() const { return 1 + *std::max_element(levels_.begin(), levels_.end()); }

RingSizes::Sizes RingSizes::light_of(int level) const {
    Sizes sizes{std::numeric_limits<float>::infinity(), 0};
    for (int ring = 0; ring < count(); ++ring) {
        if (this->level(ring) != level) continue;
        // As far as the rings beside it, or without end.
        for (const int beside : {ring - 1, ring + 1}) {
            const float r = beside < 0 || beside == count() ? std::numeric_limits<float>::infinity()
                                                            : std::abs(radius_px(beside));
            sizes.above_px = std::min(sizes.above_px, r), sizes.below_px = std::max(sizes.below_px, r);
        }
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
        const int level = sizes.level(ring);
        const double reach =
            lens.level(level).reach_px(std::abs(radius_in_cells(double(sizes.radius_px(ring)), level)));
        int& cells = reach_[std::size_t(level)];
        cells = std::max(cells, int(std::ceil(reach + 0.5)));
    }
}

device::KernelAsk RingKernels::ask(int ring, int zone) const {
    return {.level = sizes_.level(ring), .zone = zone, .step = bits_as<int>(sizes_.radius_px(ring))};
}

std::vector<device::KernelSource::Made> RingKernels::make(std::span<const device::KernelAsk> asks) const {
    std::vector<Made> made;
    for (const device::KernelAsk& ask : asks) {
        const int column = ask.zone % zones_.columns, row = ask.zone / zones_.columns;
        const double x = (column + 0.5) * lens_.frame.width() / zones_.columns - 0.5;
        const double y = (row + 0.5) * lens_.frame.height() / zones_.rows - 0.5;
        const double radius = radius_in_cells(double(bits_as<float>(ask.step)), ask.level);
        made.push_back({std::make_shared<const kernel::PointSpread>(
            lens_.level(ask.level).point_spread(radius, lens_.field_at(x, y)))});
    }
    return made;
}

}  // namespace petzval::engine
