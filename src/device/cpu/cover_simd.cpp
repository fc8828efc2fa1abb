// Compiled once per instruction set by Highway (foreach_target.h includes this file again for each).
#include "device/cpu/cover.h"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "device/cpu/cover_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace petzval::device::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, CoveredCells::kSpill>;

// A box whose edges are blurred by another box, along one axis, in cells: a trapezoid.
struct Profile {
    Profile(float at, float side, float blur)
        : middle(at),
          outer(0.5f * (side + blur)),
          inner(0.5f * std::abs(side - blur)),
          peak(blur > side ? side / blur : 1.0f) {
        const float ramp = outer - inner;
        per_ramp = ramp > 1e-6f ? 0.5f / ramp : 0.0f;
    }
    float begin() const { return middle - outer; }
    float end() const { return middle + outer; }
    // Area before each place of the trapezoid from -outer to outer with its top from -inner to inner.
    template <bool kBlurred, class D>
    HWY_INLINE hn::Vec<D> Before(D d, hn::Vec<D> place) const {
        const auto none = hn::Zero(d), t = hn::Sub(place, hn::Set(d, middle));
        const auto flat = hn::Min(hn::Max(hn::Add(t, hn::Set(d, inner)), none), hn::Set(d, 2 * inner));
        if constexpr (!kBlurred) return flat;
        const auto ramp = hn::Set(d, outer - inner);
        const auto up = hn::Min(hn::Max(hn::Add(t, hn::Set(d, outer)), none), ramp);
        const auto down = hn::Min(hn::Max(hn::Sub(t, hn::Set(d, inner)), none), ramp);
        const auto slopes = hn::Mul(hn::Sub(hn::Mul(up, up), hn::Mul(down, down)), hn::Set(d, per_ramp));
        return hn::Mul(hn::Set(d, peak), hn::Add(hn::Add(slopes, flat), down));
    }
    // The share of each cell from `first` on that the trapezoid covers.
    template <bool kBlurred, class D>
    HWY_INLINE hn::Vec<D> Shares(D d, int first) const {
        const auto place = hn::Add(hn::Set(d, float(first)), hn::Iota(d, 0));
        return hn::Sub(Before<kBlurred>(d, hn::Add(place, hn::Set(d, 1.0f))), Before<kBlurred>(d, place));
    }
    float middle, outer, inner, peak, per_ramp;
};

struct Range {
    int begin, end;
    Range(const Profile& profile, int cells)
        : begin(Limited(std::floor(profile.begin()), cells)), end(Limited(std::ceil(profile.end()), cells)) {}
    static int Limited(float at, int cells) { return int(std::clamp(at, 0.0f, float(cells))); }
};

// A profile covers nothing beyond its end, so whole registers may be added.
template <bool kBlurred>
HWY_INLINE void CoverBox(const CoveredCells& cells, const Profile& across, const Profile& down,
                         float coverage) {
    const Floats d;
    const int lanes = int(hn::Lanes(d));
    const Range columns(across, cells.side), rows(down, cells.side);
    constexpr int kChunk = 64;
    float tall[kChunk + CoveredCells::kSpill];
    for (int y0 = rows.begin; y0 < rows.end; y0 += kChunk) {
        const int n = std::min(kChunk, rows.end - y0);
        for (int i = 0; i < n; i += lanes)
            hn::StoreU(hn::Mul(hn::Set(d, coverage), down.Shares<kBlurred>(d, y0 + i)), d, tall + i);
        for (int x = columns.begin; x < columns.end; x += lanes) {
            const auto wide = across.Shares<kBlurred>(d, x);
            float* out = cells.covered + y0 * cells.stride + x;
            for (int k = 0; k < n; ++k, out += cells.stride)
                hn::StoreU(hn::Add(hn::LoadU(d, out), hn::Mul(hn::Set(d, tall[k]), wide)), d, out);
        }
    }
}

// Most rectangles are no wider than a cell, and reach into one more at most.
HWY_INLINE void CoverFew(const CoveredCells& cells, float x, float y, float width, float height,
                         float coverage) {
    const float left = x - 0.5f * width, top = y - 0.5f * height;
    const float column = std::floor(left), row = std::floor(top);
    const float in_first = std::min(width, column + 1 - left), in_top = std::min(height, row + 1 - top);
    const float wide[] = {in_first, width - in_first}, tall[] = {in_top, height - in_top};
    const auto inside = [&](int at) { return unsigned(at) < unsigned(cells.side); };
    for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 2; ++i)
            if (const int cx = int(column) + i, cy = int(row) + j; inside(cx) && inside(cy))
                cells.covered[cy * cells.stride + cx] += coverage * wide[i] * tall[j];
}

void Cover(const CoveredCells& cells, std::span<const engine::SeenCaster> casters) {
    const float middle = 0.5f * float(cells.side), cells_per_radius = std::abs(cells.per_radius);
    for (const engine::SeenCaster& c : casters) {
        const float x = middle + c.u * cells.per_radius, y = middle + c.v * cells.per_radius;
        const float wide = c.wide * cells_per_radius, tall = c.tall * cells_per_radius,
                    blur = c.blur * cells_per_radius;
        if (c.blur > 0)
            CoverBox<true>(cells, {x, wide, blur}, {y, tall, blur}, c.coverage);
        else if (std::max(wide, tall) > 1)
            CoverBox<false>(cells, {x, wide, blur}, {y, tall, blur}, c.coverage);
        else
            CoverFew(cells, x, y, wide, tall, c.coverage);
    }
}

void FindOpen(std::span<const float> covered, float* HWY_RESTRICT open) {
    const Floats d;
    const std::size_t n = covered.size();
    const auto all = hn::Set(d, 1.0f);
    std::size_t i = 0;
    for (; i + hn::Lanes(d) <= n; i += hn::Lanes(d))
        hn::StoreU(hn::Sub(all, hn::Min(hn::LoadU(d, &covered[i]), all)), d, open + i);
    for (; i < n; ++i) open[i] = 1 - std::min(1.0f, covered[i]);
}

}  // namespace petzval::device::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace petzval::device {

HWY_EXPORT(Cover);
HWY_EXPORT(FindOpen);

void cover(const CoveredCells& cells, std::span<const engine::SeenCaster> casters) {
    HWY_DYNAMIC_DISPATCH(Cover)(cells, casters);
}
void find_open(std::span<const float> covered, float* open) { HWY_DYNAMIC_DISPATCH(FindOpen)(covered, open); }

}  // namespace petzval::device
#endif
