// Compiled once per instruction set by Highway (foreach_target.h includes this file again for each).
#include "engine/stamp.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/stamp_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace petzval::engine::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// A group of four RGBA pixels, or as much of it as one register holds.
using Floats = hn::CappedTag<float, 16>;
constexpr int kGroupFloats = 4 * StampKernel::kGroup;

// The light of one pixel, repeated over a register.
struct Light {
    alignas(64) float values[kGroupFloats];
    explicit Light(Rgba c) {
        for (int i = 0; i < kGroupFloats; i += 4)
            values[i] = c.r, values[i + 1] = c.g, values[i + 2] = c.b, values[i + 3] = c.a;
    }
};

void StampPlain(const StampKernel& kernel, int x, int y, const Rgba& light, Accumulator& into) {
    const Floats d;
    const int lanes = int(hn::Lanes(d));
    const Light repeated(light);
    const Rect e = kernel.extent(), area = into.area();
    const int y0 = std::max(y + e.y0, area.y0), y1 = std::min(y + e.y1, area.y1);
    const int left = x + e.x0;  // pixel of group 0
    // Groups that lie in the area or the spill beside it.
    const int least = (area.x0 - Accumulator::kSpill - left + StampKernel::kGroup - 1) / StampKernel::kGroup;
    const int most = (area.x1 - left + StampKernel::kGroup - 1) / StampKernel::kGroup;
    for (int row_y = y0; row_y < y1; ++row_y) {
        const int k = row_y - y - e.y0;
        const int g0 = std::max(kernel.first_group(k), least), g1 = std::min(kernel.last_group(k), most);
        if (g0 >= g1) continue;
        const float* HWY_RESTRICT weights = kernel.row(k) + std::ptrdiff_t(g0) * kGroupFloats;
        float* HWY_RESTRICT sums = &into.row(row_y)[left - area.x0 + g0 * StampKernel::kGroup].r;
        const int n = (g1 - g0) * kGroupFloats;
        for (int i = 0; i < n; i += lanes)
            hn::StoreU(hn::MulAdd(hn::Load(d, weights + i), hn::Load(d, repeated.values + i % kGroupFloats),
                                  hn::LoadU(d, sums + i)),
                       d, sums + i);
    }
}

void StampTilted(const StampKernel& kernel, int x, int y, const Rgba& light, float tilt_x, float tilt_y,
                 Accumulator& into) {
    const Floats d;
    const int lanes = int(hn::Lanes(d));
    const Light repeated(light);
    const Rect e = kernel.extent(), area = into.area();
    const int y0 = std::max(y + e.y0, area.y0), y1 = std::min(y + e.y1, area.y1);
    const int left = x + e.x0;
    const int least = (area.x0 - Accumulator::kSpill - left + StampKernel::kGroup - 1) / StampKernel::kGroup;
    const int most = (area.x1 - left + StampKernel::kGroup - 1) / StampKernel::kGroup;
    // tilt_x times the pixel's place in its group.
    alignas(64) float ramp[kGroupFloats];
    for (int i = 0; i < kGroupFloats; ++i) {
        const int pixel = i / 4;
        ramp[i] = tilt_x * float(pixel);
    }
    for (int row_y = y0; row_y < y1; ++row_y) {
        const int k = row_y - y - e.y0;
        const int g0 = std::max(kernel.first_group(k), least), g1 = std::min(kernel.last_group(k), most);
        const float row_tilt = 1 + tilt_y * float(row_y - y);
        for (int g = g0; g < g1; ++g) {
            const float* HWY_RESTRICT weights = kernel.row(k) + std::ptrdiff_t(g) * kGroupFloats;
            float* HWY_RESTRICT sums = &into.row(row_y)[left - area.x0 + g * StampKernel::kGroup].r;
            const auto start = hn::Set(d, row_tilt + tilt_x * float(e.x0 + g * StampKernel::kGroup));
            for (int i = 0; i < kGroupFloats; i += lanes) {
                const auto tilt = hn::Max(hn::Zero(d), hn::Add(start, hn::Load(d, ramp + i)));
                const auto tilted = hn::Mul(hn::Load(d, repeated.values + i), tilt);
                hn::StoreU(hn::MulAdd(hn::Load(d, weights + i), tilted, hn::LoadU(d, sums + i)), d, sums + i);
            }
        }
    }
}

void Stamp(const StampKernel& kernel, int x, int y, const Rgba& light, float tilt_x, float tilt_y,
           Accumulator& into) {
    if (tilt_x == 0 && tilt_y == 0)
        StampPlain(kernel, x, y, light, into);
    else
        StampTilted(kernel, x, y, light, tilt_x, tilt_y, into);
}

// One pixel, or as much of it as one register holds.
using OnePixel = hn::CappedTag<float, 4>;

// Weights of the four cells around a position t (0…1) between the middle two: Catmull-Rom.
inline std::array<float, 4> Cubic(float t) {
    const float t2 = t * t, t3 = t2 * t;
    return {0.5f * (-t3 + 2 * t2 - t), 0.5f * (3 * t3 - 5 * t2 + 2), 0.5f * (-3 * t3 + 4 * t2 + t),
            0.5f * (t3 - t2)};
}

void AddEnlarged(const Accumulator& coarse, int level, Accumulator& fine) {
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
    // Rows are enlarged first, each coarse row once; then columns.
    const std::size_t stride = 4 * std::size_t((to.width() + 3) / 4 * 4);
    thread_local std::vector<float> wide;
    wide.resize(stride * std::size_t(from.height()));
    for (int x = to.x0; x < to.x1; ++x) {
        int cell = 0;
        const auto w = place(x, cell);
        for (int y = from.y0; y < from.y1; ++y) {
            const float* in = &coarse.row(y)[cell - 1 - from.x0].r;
            float* out = &wide[stride * std::size_t(y - from.y0) + 4 * std::size_t(x - to.x0)];
            for (std::size_t i = 0; i < 4; i += hn::Lanes(one)) {
                auto sum = hn::Mul(hn::Set(one, w[0]), hn::LoadU(one, in + i));
                for (std::size_t k = 1; k < 4; ++k)
                    sum = hn::MulAdd(hn::Set(one, w[k]), hn::LoadU(one, in + 4 * k + i), sum);
                hn::StoreU(sum, one, out + i);
            }
        }
    }
    for (int y = to.y0; y < to.y1; ++y) {
        int cell = 0;
        const auto w = place(y, cell);
        const float* in = &wide[stride * std::size_t(cell - 1 - from.y0)];
        float* out = &fine.row(y)[0].r;
        const int n = 4 * to.width();
        for (int i = 0; i < n; i += lanes) {  // the last group may spill beyond the row, where there is room
            auto sum = hn::Mul(hn::Set(d, w[0]), hn::LoadU(d, in + i));
            for (std::size_t k = 1; k < 4; ++k)
                sum = hn::MulAdd(hn::Set(d, w[k]), hn::LoadU(d, in + k * stride + std::size_t(i)), sum);
            hn::StoreU(hn::Add(hn::LoadU(d, out + i), sum), d, out + i);
        }
    }
}

void TakeBudget(const Rgba* HWY_RESTRICT layer, Rgba* HWY_RESTRICT sum, float* HWY_RESTRICT free, int n) {
    const OnePixel one;
    for (int i = 0; i < n; ++i) {
        const float arrives = layer[i].a;
        if (arrives <= 0) continue;
        const float taken = std::min(arrives, free[i]);
        const auto share = hn::Set(one, taken / arrives);
        const float* in = &layer[i].r;
        float* out = &sum[i].r;
        for (std::size_t k = 0; k < 4; k += hn::Lanes(one))
            hn::StoreU(hn::MulAdd(share, hn::LoadU(one, in + k), hn::LoadU(one, out + k)), one, out + k);
        free[i] -= taken;
    }
}

const char* Name() { return hwy::TargetName(HWY_TARGET); }

}  // namespace petzval::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace petzval::engine {

HWY_EXPORT(Stamp);
HWY_EXPORT(AddEnlarged);
HWY_EXPORT(TakeBudget);
HWY_EXPORT(Name);

void stamp(const StampKernel& kernel, int x, int y, Rgba light, float tilt_x, float tilt_y,
           Accumulator& into) {
    HWY_DYNAMIC_DISPATCH(Stamp)(kernel, x, y, light, tilt_x, tilt_y, into);
}
void add_enlarged(const Accumulator& coarse, int level, Accumulator& fine) {
    HWY_DYNAMIC_DISPATCH(AddEnlarged)(coarse, level, fine);
}
void take_budget(const Rgba* layer, Rgba* sum, float* free, int n) {
    HWY_DYNAMIC_DISPATCH(TakeBudget)(layer, sum, free, n);
}
const char* instruction_set() { return HWY_DYNAMIC_DISPATCH(Name)(); }

}  // namespace petzval::engine
#endif
