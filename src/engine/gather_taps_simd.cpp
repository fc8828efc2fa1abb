// Compiled once per instruction set by Highway (foreach_target.h includes this file again for each).
#include "engine/gather_taps.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/gather_taps_simd.cpp"
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

template <int kRows, bool kNeutral>
HWY_INLINE void RowsOfFour(const TapJob& job, const TapPlane* planes, int y) {
    const Floats d;
    const std::ptrdiff_t below = job.in_stride;
    for (int x = 0; x < job.width; x += int(hn::Lanes(d))) {
        const std::ptrdiff_t from = y * job.in_stride + x;
        const float *r = planes[0].in + from, *g = planes[1].in + from, *b = planes[2].in + from,
                    *m = planes[3].in + from;
        auto r0 = hn::Zero(d), g0 = hn::Zero(d), b0 = hn::Zero(d), m0 = hn::Zero(d);
        auto r1 = hn::Zero(d), g1 = hn::Zero(d), b1 = hn::Zero(d), m1 = hn::Zero(d);
        const float* weight = job.weights;
        for (int t = 0; t < job.taps; ++t, weight += job.weight_step) {
            const std::ptrdiff_t o = job.offsets[t];
            const auto w = hn::Set(d, weight[0]);
            const auto wg = kNeutral ? w : hn::Set(d, weight[1]);
            const auto wb = kNeutral ? w : hn::Set(d, weight[2]);
            const auto wm = kNeutral ? w : hn::Set(d, weight[3]);
            r0 = hn::MulAdd(w, hn::LoadU(d, r + o), r0);
            g0 = hn::MulAdd(wg, hn::LoadU(d, g + o), g0);
            b0 = hn::MulAdd(wb, hn::LoadU(d, b + o), b0);
            m0 = hn::MulAdd(wm, hn::LoadU(d, m + o), m0);
            if constexpr (kRows == 2) {
                r1 = hn::MulAdd(w, hn::LoadU(d, r + o + below), r1);
                g1 = hn::MulAdd(wg, hn::LoadU(d, g + o + below), g1);
                b1 = hn::MulAdd(wb, hn::LoadU(d, b + o + below), b1);
                m1 = hn::MulAdd(wm, hn::LoadU(d, m + o + below), m1);
            }
        }
        const std::ptrdiff_t to = y * job.out_stride + x;
        hn::StoreU(r0, d, planes[0].out + to), hn::StoreU(g0, d, planes[1].out + to);
        hn::StoreU(b0, d, planes[2].out + to), hn::StoreU(m0, d, planes[3].out + to);
        if constexpr (kRows == 2) {
            const std::ptrdiff_t next = to + job.out_stride;
            hn::StoreU(r1, d, planes[0].out + next), hn::StoreU(g1, d, planes[1].out + next);
            hn::StoreU(b1, d, planes[2].out + next), hn::StoreU(m1, d, planes[3].out + next);
        }
    }
}

template <bool kNeutral>
HWY_INLINE void FourPlanes(const TapJob& job, const TapPlane* planes) {
    int y = 0;
    for (; y + 1 < job.height; y += 2) RowsOfFour<2, kNeutral>(job, planes, y);
    if (y < job.height) RowsOfFour<1, kNeutral>(job, planes, y);
}

void GatherFour(const TapJob& job, const TapPlane* planes, bool neutral) {
    if (neutral)
        FourPlanes<true>(job, planes);
    else
        FourPlanes<false>(job, planes);
}

}  // namespace petzval::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace petzval::engine {

HWY_EXPORT(GatherOne);
HWY_EXPORT(GatherFour);

void gather_one(const TapJob& job, const TapPlane& plane) { HWY_DYNAMIC_DISPATCH(GatherOne)(job, plane); }
void gather_four(const TapJob& job, const TapPlane planes[4], bool neutral) {
    HWY_DYNAMIC_DISPATCH(GatherFour)(job, planes, neutral);
}

}  // namespace petzval::engine
#endif
