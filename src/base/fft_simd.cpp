// Compiled once per instruction set by Highway (foreach_target.h includes this file again for each). Sums and
// products are not fused, so every instruction set makes the same bits.
#include "base/fft.h"
#include "base/fft_lanes.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "base/fft_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace petzval::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, kLanes>;
using Vector = hn::Vec<Floats>;

struct Complex {
    Vector re, im;
};
struct Signals {
    float *re, *im;
    Complex at(std::ptrdiff_t i) const { return {hn::LoadU(Floats(), re + i), hn::LoadU(Floats(), im + i)}; }
    void put(std::ptrdiff_t i, const Complex& z) const {
        hn::StoreU(z.re, Floats(), re + i), hn::StoreU(z.im, Floats(), im + i);
    }
};

void Butterfly(Complex& a, Complex& b, const Complex& turn) {
    const Complex t{hn::Sub(hn::Mul(b.re, turn.re), hn::Mul(b.im, turn.im)),
                    hn::Add(hn::Mul(b.re, turn.im), hn::Mul(b.im, turn.re))};
    b = {hn::Sub(a.re, t.re), hn::Sub(a.im, t.im)};
    a = {hn::Add(a.re, t.re), hn::Add(a.im, t.im)};
}

Complex Turn(const FftTurns& turns, int k) {
    const Floats d;
    return {hn::Set(d, turns.cos[k]), hn::Set(d, turns.sign * turns.sin[k])};
}

// Joins transforms of `half` points into transforms of twice as many.
void OneStage(const FftTurns& turns, Signals z, int count, int half) {
    const int step = turns.n / (2 * half);
    const std::ptrdiff_t apart = std::ptrdiff_t(half) * kLanes;
    for (int start = 0; start < count; start += 2 * half)
        for (int k = 0; k < half; ++k) {
            const Complex turn = Turn(turns, k * step);
            for (std::size_t l = 0; l < kLanes; l += hn::Lanes(Floats())) {
                const std::ptrdiff_t at = std::ptrdiff_t(start + k) * kLanes + std::ptrdiff_t(l);
                Complex a = z.at(at), b = z.at(at + apart);
                Butterfly(a, b, turn);
                z.put(at, a), z.put(at + apart, b);
            }
        }
}

// The same twice, with one way through memory.
void TwoStages(const FftTurns& turns, Signals z, int count, int half) {
    const int step = turns.n / (2 * half);
    const std::ptrdiff_t apart = std::ptrdiff_t(half) * kLanes;
    for (int start = 0; start < count; start += 4 * half)
        for (int k = 0; k < half; ++k) {
            const Complex first = Turn(turns, k * step), near = Turn(turns, k * step / 2),
                          far = Turn(turns, (k + half) * step / 2);
            for (std::size_t l = 0; l < kLanes; l += hn::Lanes(Floats())) {
                const std::ptrdiff_t at = std::ptrdiff_t(start + k) * kLanes + std::ptrdiff_t(l);
                Complex p = z.at(at), q = z.at(at + apart), r = z.at(at + 2 * apart),
                        s = z.at(at + 3 * apart);
                Butterfly(p, q, first), Butterfly(r, s, first);
                Butterfly(p, r, near), Butterfly(q, s, far);
                z.put(at, p), z.put(at + apart, q), z.put(at + 2 * apart, r), z.put(at + 3 * apart, s);
            }
        }
}

// All stages from `half` on, over `count` points that begin at z.
void Stages(const FftTurns& turns, Signals z, int count, int half) {
    for (; 4 * half <= count; half *= 4) TwoStages(turns, z, count, half);
    if (2 * half <= count) OneStage(turns, z, count, half);
}

void Transform(const FftTurns& turns, float* re, float* im) {
    constexpr int kPart = 64;  // points whose signals fit into the first cache
    if (turns.n <= kPart) return Stages(turns, {re, im}, turns.n, 1);
    for (std::ptrdiff_t at = 0; at < std::ptrdiff_t(turns.n) * kLanes; at += std::ptrdiff_t(kPart) * kLanes)
        Stages(turns, {re + at, im + at}, kPart, 1);
    Stages(turns, {re, im}, turns.n, kPart);
}

bool TakeColumns(const float* field, std::size_t n, float* re, float* im) {
    const Floats d;
    Vector any = hn::Zero(d);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t l = 0; l < kLanes; l += hn::Lanes(d)) {
            Vector r, m;
            hn::LoadInterleaved2(d, field + 2 * (i * n + l), r, m);
            hn::StoreU(r, d, re + i * kLanes + l);
            hn::StoreU(m, d, im + i * kLanes + l);
            any = hn::Or(any, hn::Or(hn::Abs(r), hn::Abs(m)));
        }
    return !hn::AllTrue(d, hn::Eq(any, hn::Zero(d)));
}

void PutColumns(const float* re, const float* im, std::size_t n, float scale, float* field) {
    const Floats d;
    const Vector s = hn::Set(d, scale);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t l = 0; l < kLanes; l += hn::Lanes(d))
            hn::StoreInterleaved2(hn::Mul(s, hn::LoadU(d, re + i * kLanes + l)),
                                  hn::Mul(s, hn::LoadU(d, im + i * kLanes + l)), d, field + 2 * (i * n + l));
}

}  // namespace petzval::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace petzval {

HWY_EXPORT(Transform);
HWY_EXPORT(TakeColumns);
HWY_EXPORT(PutColumns);

bool take_columns(const float* field, std::size_t n, float* re, float* im) {
    return HWY_DYNAMIC_DISPATCH(TakeColumns)(field, n, re, im);
}
void put_columns(const float* re, const float* im, std::size_t n, float scale, float* field) {
    HWY_DYNAMIC_DISPATCH(PutColumns)(re, im, n, scale, field);
}

void fft_stages(const FftTurns& turns, float* re, float* im) {
    HWY_DYNAMIC_DISPATCH(Transform)(turns, re, im);
}

}  // namespace petzval
#endif
