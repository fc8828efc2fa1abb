// Compiled once per instruction set by Highway (foreach_target.h includes this file again for each).
#include "device/cpu/stamp.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "device/cpu/stamp_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace petzval::engine::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// A group of four RGBA pixels, or as much of it as one register holds.
using Floats = hn::CappedTag<float, 16>;
constexpr int kGroupFloats = 4 * StampKernel::kGroup;

// The light of one pixel, repeated over a register; of a register of one float, float number `part` of it.
template <class D>
HWY_INLINE hn::Vec<D> Repeated(D d, const Rgba& light, int part) {
    alignas(16) const float channels[4] = {light.r, light.g, light.b, light.a};
    if (hn::Lanes(d) < 4) return hn::Set(d, channels[part % 4]);
    return hn::LoadDup128(d, channels);
}

// The rows and groups of a kernel that fall on an accumulator.
struct Overlap {
    Overlap(const StampKernel& stamped, int x, int y, Accumulator& sums)
        : kernel(stamped), into(sums), top(y + stamped.extent().y0), left(x + stamped.extent().x0) {
        constexpr int kGroup = StampKernel::kGroup;
        const Rect area = into.area();
        y0 = std::max(top, area.y0), y1 = std::min(y + kernel.extent().y1, area.y1);
        // Groups that lie in the area or the spill beside it.
        into.touch({y0, y1});
        least = (area.x0 - Accumulator::kSpill - left + kGroup - 1) / kGroup;
        most = (area.x1 - left + kGroup - 1) / kGroup;
    }
    // visit(row, first group, weights from there, sums, floats) for every row with weights.
    template <typename Visit>
    HWY_INLINE void for_rows(const Visit& visit) const {
        for (int y = y0; y < y1; ++y) {
            const int k = y - top;
            const int g0 = std::max(kernel.first_group(k), least), g1 = std::min(kernel.last_group(k), most);
            if (g0 >= g1) continue;
            visit(y, g0, kernel.row(k) + std::ptrdiff_t(g0) * kGroupFloats,
                  &into.row(y)[left - into.area().x0 + g0 * StampKernel::kGroup].r, (g1 - g0) * kGroupFloats);
        }
    }
    const StampKernel& kernel;
    Accumulator& into;
    int top, left;  // row 0 and group 0 of the kernel, in pixels
    int y0, y1, least, most;
};

void StampPlain(const StampKernel& kernel, int x, int y, const Rgba& light, Accumulator& into) {
    const Floats d;
    const int lanes = int(hn::Lanes(d));
    const int passes = std::max(1, 4 / lanes);
    for (int part = 0; part < passes; ++part) {
        const auto own = Repeated(d, light, part);
        const int step = std::max(4, lanes);
        Overlap(kernel, x, y, into)
            .for_rows(
                [&](int, int, const float* HWY_RESTRICT weights, float* HWY_RESTRICT sums, int n) HWY_ATTR {
                    for (int i = part; i < n; i += step)
                        hn::StoreU(hn::MulAdd(hn::Load(d, weights + i), own, hn::LoadU(d, sums + i)), d,
                                   sums + i);
                });
    }
}

// Weights times 1 + tilt . offset, which falls below 0 within the kernel only if kClamped.
template <bool kClamped>
void StampTilted(const StampKernel& kernel, int x, int y, const Rgba& light, float tilt_x, float tilt_y,
                 Accumulator& into) {
    const Floats d;
    const int lanes = int(hn::Lanes(d));
    // Change of the weight from pixel to pixel of a group, and from group to group.
    alignas(64) static constexpr float kPixels[kGroupFloats] = {0, 0, 0, 0, 1, 1, 1, 1,
                                                                2, 2, 2, 2, 3, 3, 3, 3};
    const auto slope = hn::Set(d, tilt_x);
    const auto step = hn::Set(d, tilt_x * float(StampKernel::kGroup));
    const int from_source = kernel.extent().x0;
    Overlap(kernel, x, y, into)
        .for_rows([&](int row, int group, const float* HWY_RESTRICT weights, float* HWY_RESTRICT sums,
                      int n) HWY_ATTR {
            const float start =
                1 + tilt_y * float(row - y) + tilt_x * float(from_source + group * StampKernel::kGroup);
            for (int part = 0; part < kGroupFloats; part += lanes) {
                const auto own = Repeated(d, light, part);
                auto tilt = hn::MulAdd(slope, hn::Load(d, kPixels + part), hn::Set(d, start));
                for (int i = part; i < n; i += kGroupFloats) {
                    const auto factor = hn::Mul(own, kClamped ? hn::Max(hn::Zero(d), tilt) : tilt);
                    hn::StoreU(hn::MulAdd(hn::Load(d, weights + i), factor, hn::LoadU(d, sums + i)), d,
                               sums + i);
                    tilt = hn::Add(tilt, step);
                }
            }
        });
}

void StampOne(const StampKernel& kernel, int x, int y, const Rgba& light, float tilt_x, float tilt_y,
              Accumulator& into) {
    if (tilt_x == 0 && tilt_y == 0) return StampPlain(kernel, x, y, light, into);
    const Rect e = kernel.extent();
    const float steepest =
        std::abs(tilt_x) * float(std::max(-e.x0, e.x1)) + std::abs(tilt_y) * float(std::max(-e.y0, e.y1));
    if (steepest < 1)
        StampTilted<false>(kernel, x, y, light, tilt_x, tilt_y, into);
    else
        StampTilted<true>(kernel, x, y, light, tilt_x, tilt_y, into);
}

void StampDimmed(const StampKernel& kernel, int x, int y, const Rgba& light, const DimmedRow* rows,
                 Accumulator& into) {
    const Floats d;
    const int lanes = int(hn::Lanes(d));
    const int top = y + kernel.extent().y0;
    Overlap(kernel, x, y, into)
        .for_rows([&](int row, int group, const float* HWY_RESTRICT weights, float* HWY_RESTRICT sums,
                      int n) HWY_ATTR {
            const DimmedRow& dimmed = rows[row - top];
            if (!dimmed.first) return;
            const auto between = hn::Set(d, dimmed.between);
            const float *first = dimmed.first + std::ptrdiff_t(group) * kGroupFloats,
                        *second = dimmed.second + std::ptrdiff_t(group) * kGroupFloats;
            for (int part = 0; part < kGroupFloats; part += lanes) {
                const auto own = Repeated(d, light, part);
                for (int i = part; i < n; i += kGroupFloats) {
                    const auto a = hn::Load(d, first + i);
                    const auto share = hn::MulAdd(between, hn::Sub(hn::Load(d, second + i), a), a);
                    const auto sent = hn::Mul(hn::Load(d, weights + i), own);
                    hn::StoreU(hn::MulAdd(share, sent, hn::LoadU(d, sums + i)), d, sums + i);
                }
            }
        });
}

void Stamp(std::span<const StampKernel> kernels, int x, int y, const Rgba& light, float tilt_x, float tilt_y,
           std::span<Accumulator> into) {
    for (std::size_t i = 0; i < kernels.size(); ++i)
        StampOne(kernels[i], x, y, light, tilt_x, tilt_y, into[i]);
}

// One pixel, or as much of it as one register holds.
using OnePixel = hn::CappedTag<float, 4>;

// Weights of the four cells around a position t (0…1) between the middle two: Catmull-Rom.
inline std::array<float, 4> Cubic(float t) {
    const float t2 = t * t, t3 = t2 * t;
    return {0.5f * (-t3 + 2 * t2 - t), 0.5f * (3 * t3 - 5 * t2 + 2), 0.5f * (-3 * t3 + 4 * t2 + t),
            0.5f * (t3 - t2)};
}

// The sum of four values, `stride` floats apart, with these weights; never negative where none of them is.
template <class D>
HWY_INLINE hn::Vec<D> Interpolated(D d, const float* in, std::size_t stride, const std::array<float, 4>& w) {
    auto least = hn::Zero(d), sum = hn::Zero(d);
    for (std::size_t k = 0; k < 4; ++k) {
        const auto value = hn::LoadU(d, in + k * stride);
        sum = hn::MulAdd(hn::Set(d, w[k]), value, sum);
        least = hn::Min(least, value);
    }
    return hn::Max(sum, least);
}

void AddShares(const Rgba* HWY_RESTRICT weights, const Rgba& light, const float* HWY_RESTRICT shares,
               Rgba* HWY_RESTRICT sums, std::size_t n) {
    std::size_t begin = 0;
    // Whole registers of pixels; each pixel's share is repeated for its channels.
    const Floats d;
    const std::size_t pixels = hn::Lanes(d) / 4;
    if (pixels > 1) {
        const hn::RebindToSigned<Floats> whole;
        const auto pixel = hn::IndicesFromVec(d, hn::ShiftRight<2>(hn::Iota(whole, 0)));
        const auto own = Repeated(d, light, 0);
        for (; begin + 4 <= n; begin += pixels) {
            float* const out = &sums[begin].r;
            const auto sent = hn::Mul(hn::LoadU(d, &weights[begin].r), own);
            const auto share = hn::TableLookupLanes(hn::LoadDup128(d, shares + begin), pixel);
            hn::StoreU(hn::MulAdd(sent, share, hn::LoadU(d, out)), d, out);
        }
    }
    const OnePixel one;
    for (std::size_t k = 0; k < 4; k += hn::Lanes(one)) {
        const auto own = hn::LoadU(one, &light.r + k);
        for (std::size_t i = begin; i < n; ++i) {
            float* const out = &sums[i].r + k;
            const auto sent = hn::Mul(hn::LoadU(one, &weights[i].r + k), own);
            hn::StoreU(hn::MulAdd(sent, hn::Set(one, shares[i]), hn::LoadU(one, out)), one, out);
        }
    }
}

void AddEnlarged(const Accumulator& coarse, int level, Accumulator& fine, std::vector<float>& wide) {
    const Floats d;
    const OnePixel one;
    const int lanes = int(hn::Lanes(d));
    const Rect from = coarse.area(), to = fine.area();
    const float per_cell = 1 / float(1 << level);
    const auto place = [&](int at, int& cell) {
        const float position = (float(at) + 0.5f) * per_cell - 0.5f;
        cell = int(std::floor(position));
        return Cubic(position - float(cell));
    };
    const Rows touched = coarse.touched();
    if (touched.empty()) return;
    // A row of cells reaches two rows of cells to either side.
    const int size = 1 << level;
    const Rows rows{std::max(to.y0, (touched.begin - 2) * size), std::min(to.y1, (touched.end + 2) * size)};
    fine.touch(rows);
    // Rows are enlarged first, each coarse row once; then columns.
    const std::size_t stride = 4 * std::size_t((to.width() + 3) / 4 * 4);
    wide.resize(stride * std::size_t(from.height()));
    for (int x = to.x0; x < to.x1; ++x) {
        int cell = 0;
        const auto w = place(x, cell);
        for (int y = std::max(from.y0, touched.begin - 4); y < std::min(from.y1, touched.end + 4); ++y) {
            const float* in = &coarse.row(y)[cell - 1 - from.x0].r;
            float* out = &wide[stride * std::size_t(y - from.y0) + 4 * std::size_t(x - to.x0)];
            for (std::size_t i = 0; i < 4; i += hn::Lanes(one)) {
                hn::StoreU(Interpolated(one, in + i, 4, w), one, out + i);
            }
        }
    }
    for (int y = rows.begin; y < rows.end; ++y) {
        int cell = 0;
        const auto w = place(y, cell);
        const float* in = &wide[stride * std::size_t(cell - 1 - from.y0)];
        float* out = &fine.row(y)[0].r;
        const int n = 4 * to.width();
        for (int i = 0; i < n; i += lanes) {  // the last group may spill beyond the row, where there is room
            hn::StoreU(hn::Add(hn::LoadU(d, out + i), Interpolated(d, in + i, stride, w)), d, out + i);
        }
    }
}

const char* Name() { return hwy::TargetName(HWY_TARGET); }

}  // namespace petzval::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace petzval::engine {

HWY_EXPORT(Stamp);
HWY_EXPORT(StampDimmed);
HWY_EXPORT(AddShares);
HWY_EXPORT(AddEnlarged);
HWY_EXPORT(Name);

void stamp(std::span<const StampKernel> kernels, int x, int y, Rgba light, float tilt_x, float tilt_y,
           std::span<Accumulator> into) {
    HWY_DYNAMIC_DISPATCH(Stamp)(kernels, x, y, light, tilt_x, tilt_y, into);
}
void stamp_dimmed(const StampKernel& kernel, int x, int y, Rgba light, const DimmedRow* rows,
                  Accumulator& into) {
    HWY_DYNAMIC_DISPATCH(StampDimmed)(kernel, x, y, light, rows, into);
}
void add_shares(std::span<const Rgba> weights, Rgba light, std::span<const float> shares, Rgba* sums) {
    HWY_DYNAMIC_DISPATCH(AddShares)(weights.data(), light, shares.data(), sums, weights.size());
}
void add_enlarged(const Accumulator& coarse, int level, Accumulator& fine, std::vector<float>& scratch) {
    HWY_DYNAMIC_DISPATCH(AddEnlarged)(coarse, level, fine, scratch);
}
const char* instruction_set() { return HWY_DYNAMIC_DISPATCH(Name)(); }

}  // namespace petzval::engine
#endif
