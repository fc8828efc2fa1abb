// Compiled once per instruction set by Highway (foreach_target.h includes this file again for each).
#include "device/cpu/gather_taps.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "device/cpu/gather_taps_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace petzval::engine::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, kGatherGroup>;

// Two rows at a time, so that enough sums are under way to hide how long each takes.
template <int kRows>
HWY_INLINE void RowsOfOne(const TapJob& job, const float* in, float* out) {
    const Floats d;
    for (int x = 0; x < job.width; x += int(hn::Lanes(d))) {
        auto a = hn::Zero(d), b = hn::Zero(d);
        const float* weight = job.weights;
        for (int t = 0; t < job.taps; ++t, weight += job.weight_step) {
            const auto w = hn::Set(d, *weight);
            const float* at = in + x + job.offsets[t];
            a = hn::MulAdd(w, hn::LoadU(d, at), a);
            if constexpr (kRows == 2) b = hn::MulAdd(w, hn::LoadU(d, at + job.in_stride), b);
        }
        hn::StoreU(a, d, out + x);
        if constexpr (kRows == 2) hn::StoreU(b, d, out + job.out_stride + x);
    }
}

void GatherOne(const TapJob& job, const TapPlane& plane) {
    int y = 0;
    for (; y + 1 < job.height; y += 2)
        RowsOfOne<2>(job, plane.in + y * job.in_stride, plane.out + y * job.out_stride);
    if (y < job.height) RowsOfOne<1>(job, plane.in + y * job.in_stride, plane.out + y * job.out_stride);
}

// Four rows of two planes: eight sums under way, in no more registers than the smaller instruction sets have.
template <bool kNeutral>
HWY_INLINE void FourRows(const StepJob& job, const float* in_a, int channel_a, const float* in_b,
                         int channel_b, float* out_a, float* out_b) {
    static_assert(kGatherRows == 4);
    constexpr std::ptrdiff_t kPerRow = kNeutral ? 1 : 4;
    const Floats d;
    const int a = kNeutral ? 0 : channel_a, b = kNeutral ? 0 : channel_b;
    for (int x = 0; x < job.width; x += int(hn::Lanes(d))) {
        auto a0 = hn::Zero(d), a1 = hn::Zero(d), a2 = hn::Zero(d), a3 = hn::Zero(d);
        auto b0 = hn::Zero(d), b1 = hn::Zero(d), b2 = hn::Zero(d), b3 = hn::Zero(d);
        const float* w = job.weights;
        for (int t = 0; t < job.steps; ++t, w += kGatherRows * kPerRow) {
            const auto va = hn::LoadU(d, in_a + x + job.offsets[t]);
            const auto vb = hn::LoadU(d, in_b + x + job.offsets[t]);
            a0 = hn::MulAdd(hn::Set(d, w[a]), va, a0), b0 = hn::MulAdd(hn::Set(d, w[b]), vb, b0);
            a1 = hn::MulAdd(hn::Set(d, w[kPerRow + a]), va, a1);
            b1 = hn::MulAdd(hn::Set(d, w[kPerRow + b]), vb, b1);
            a2 = hn::MulAdd(hn::Set(d, w[2 * kPerRow + a]), va, a2);
            b2 = hn::MulAdd(hn::Set(d, w[2 * kPerRow + b]), vb, b2);
            a3 = hn::MulAdd(hn::Set(d, w[3 * kPerRow + a]), va, a3);
            b3 = hn::MulAdd(hn::Set(d, w[3 * kPerRow + b]), vb, b3);
        }
        const std::ptrdiff_t row = job.out_stride;
        hn::StoreU(a0, d, out_a + x), hn::StoreU(b0, d, out_b + x);
        hn::StoreU(a1, d, out_a + row + x), hn::StoreU(b1, d, out_b + row + x);
        hn::StoreU(a2, d, out_a + 2 * row + x), hn::StoreU(b2, d, out_b + 2 * row + x);
        hn::StoreU(a3, d, out_a + 3 * row + x), hn::StoreU(b3, d, out_b + 3 * row + x);
    }
}

void GatherTwo(const StepJob& job, const TapPlane& a, int channel_a, const TapPlane& b, int channel_b) {
    for (int y = 0; y < job.height; y += kGatherRows) {
        const std::ptrdiff_t from = y * job.in_stride, to = y * job.out_stride;
        if (job.neutral)
            FourRows<true>(job, a.in + from, channel_a, b.in + from, channel_b, a.out + to, b.out + to);
        else
            FourRows<false>(job, a.in + from, channel_a, b.in + from, channel_b, a.out + to, b.out + to);
    }
}

}  // namespace petzval::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace petzval::engine {

HWY_EXPORT(GatherOne);
HWY_EXPORT(GatherTwo);

void gather_one(const TapJob& job, const TapPlane& plane) { HWY_DYNAMIC_DISPATCH(GatherOne)(job, plane); }
void gather_two(const StepJob& job, const TapPlane& a, int channel_a, const TapPlane& b, int channel_b) {
    HWY_DYNAMIC_DISPATCH(GatherTwo)(job, a, channel_a, b, channel_b);
}

}  // namespace petzval::engine
#endif
