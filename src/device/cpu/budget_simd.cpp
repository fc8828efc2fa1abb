// Compiled once per instruction set by Highway (foreach_target.h includes this file again for each). The law
// is written with operators, which registers of unknown length do not have: those machines take the next
// best.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#include "device/cpu/budget.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "device/cpu/budget_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace petzval::engine::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, 16>;
using OnePixel = hn::CappedTag<float, 4>;  // or as much of it as one register holds
using V = hn::Vec<Floats>;

using laws::kAnotherSurface;
using laws::kNextLayer;
#define LAW_NUMBER V
#define LAW_FUNCTION HWY_INLINE
#define LAW_CHANGES V&
#define LAW_OF(x) hn::Set(Floats(), x)
#define LAW_WHERE(x, a, b) hn::IfThenElse(hn::Gt(x, hn::Zero(Floats())), a, b)
#define LAW_LEAST(a, b) hn::Min(a, b)
#define LAW_MOST(a, b) hn::Max(a, b)
#include "laws/lens_left.inc"

// LensLeft::take for the pixels at which light arrives. Returns the area that they take, and the further area
// that they might take.
struct Shares {
    V area, more;
};
HWY_INLINE Shares Take(Floats d, V arrives, int at_layer, const Budget::Left<float>& left,
                       std::int32_t* HWY_RESTRICT layers) {
    const hn::Rebind<std::int32_t, Floats> signed_d;
    const hn::Rebind<std::uint32_t, Floats> unsigned_d;
    const auto arrived = hn::Gt(arrives, hn::Zero(d));
    const auto old_layer = hn::Load(signed_d, layers);
    const auto old_before = hn::Load(d, left.before), old_own = hn::Load(d, left.own),
               old_beside = hn::Load(d, left.beside), old_more = hn::Load(d, left.more);

    // Gaps longer than the one to another surface count as exactly that one.
    const auto apart = hn::BitCast(unsigned_d, hn::Sub(hn::Set(signed_d, at_layer), old_layer));
    const auto gap = hn::ConvertTo(
        d, hn::BitCast(signed_d, hn::Min(apart, hn::Set(unsigned_d, std::uint32_t(kAnotherSurface)))));
    V before = old_before, own = old_own, beside = old_beside;
    law_meet(before, own, gap);
    const V of_own = at_layer == kEmptyLayer ? law_of_what_is_left(before, arrives) : arrives;
    V area, more;
    law_take(before, own, beside, arrives, of_own, area, more);

    hn::Store(hn::IfThenElse(arrived, before, old_before), d, left.before);
    hn::Store(hn::IfThenElse(arrived, own, old_own), d, left.own);
    hn::Store(hn::IfThenElse(arrived, beside, old_beside), d, left.beside);
    hn::Store(hn::IfThenElse(arrived, hn::Add(old_more, more), old_more), d, left.more);
    hn::Store(hn::IfThenElse(hn::RebindMask(signed_d, arrived), hn::Set(signed_d, at_layer), old_layer),
              signed_d, layers);
    return {hn::IfThenElseZero(arrived, hn::Div(area, arrives)),
            hn::IfThenElseZero(arrived, hn::Div(more, arrives))};
}

HWY_INLINE void AddShare(const Rgba& light, float share, Rgba& sum) {
    const OnePixel one;
    const float* const in = &light.r;
    float* const out = &sum.r;
    for (std::size_t k = 0; k < 4; k += hn::Lanes(one))
        hn::StoreU(hn::MulAdd(hn::Set(one, share), hn::LoadU(one, in + k), hn::LoadU(one, out + k)), one,
                   out + k);
}

// Alphas of the first n pixels; 0 for others.
HWY_INLINE V AlphasOf(Floats d, const Rgba* HWY_RESTRICT pixels, int n) {
    if (n == int(hn::Lanes(d))) {
        V r, g, b, a;
        hn::LoadInterleaved4(d, &pixels->r, r, g, b, a);
        return a;
    }
    HWY_ALIGN float alphas[16] = {};
    for (int i = 0; i < n; ++i) alphas[i] = pixels[i].a;
    return hn::Load(d, alphas);
}

void TakeRow(const Rgba* HWY_RESTRICT light, const Rgba* HWY_RESTRICT emptiness, int layer,
             Rgba* HWY_RESTRICT sum, Rgba* HWY_RESTRICT more, Budget::Left<float> left,
             std::int32_t* HWY_RESTRICT layers, int n) {
    const Floats d;
    const int lanes = int(hn::Lanes(d));
    for (int x = 0; x < n; x += lanes) {
        const int here = std::min(lanes, n - x);
        HWY_ALIGN float areas[16], mores[16];
        auto all = AlphasOf(d, light + x, here);
        if (emptiness) all = hn::Add(all, AlphasOf(d, emptiness + x, here));
        if (hn::AllFalse(d, hn::Gt(all, hn::Zero(d)))) continue;
        const Shares taken =
            Take(d, all, layer, {left.before + x, left.own + x, left.beside + x, left.more + x}, layers + x);
        hn::Store(taken.area, d, areas);
        hn::Store(taken.more, d, mores);
        for (int i = 0; i < here; ++i)
            if (areas[i] != 0) AddShare(light[x + i], areas[i], sum[x + i]);
        if (hn::AllFalse(d, hn::Gt(taken.more, hn::Zero(d)))) continue;
        for (int i = 0; i < here; ++i)
            if (mores[i] > 0) AddShare(light[x + i], mores[i], more[x + i]);
    }
}

bool AllSpent(Budget::Left<const float> left, float least, int n) {
    const Floats d;
    for (int x = 0; x < n; x += int(hn::Lanes(d))) {
        const auto free = law_free(hn::Load(d, left.before + x), hn::Load(d, left.own + x));
        const auto in_row = hn::FirstN(d, std::size_t(std::min(int(hn::Lanes(d)), n - x)));
        if (!hn::AllFalse(d, hn::And(in_row, hn::Not(hn::Lt(free, hn::Set(d, least)))))) return false;
    }
    return true;
}

// LensLeft::share_of_more and taken.
void AddGiven(const Rgba* HWY_RESTRICT sum, const Rgba* HWY_RESTRICT more, Budget::Left<const float> left,
              Rgba* HWY_RESTRICT light, float* HWY_RESTRICT taken, int n) {
    const Floats d;
    const int lanes = int(hn::Lanes(d));
    for (int x = 0; x < n; x += lanes) {
        const auto free = law_free(hn::Load(d, left.before + x), hn::Load(d, left.own + x));
        const auto noted = hn::Load(d, left.more + x);
        const auto share = law_share_of_more(free, hn::Load(d, left.beside + x), noted);
        const auto area = law_taken(free, share, noted);
        hn::StoreU(hn::Add(hn::LoadU(d, taken + x), area), d, taken + x);
        HWY_ALIGN float shares[16];
        hn::Store(share, d, shares);
        for (int i = 0; i < std::min(lanes, n - x); ++i) light[x + i] += sum[x + i] + more[x + i] * shares[i];
    }
}

}  // namespace petzval::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace petzval::engine {

HWY_EXPORT(TakeRow);
HWY_EXPORT(AllSpent);
HWY_EXPORT(AddGiven);

void Budget::start(int width, int height) {
    const int padded = whole_registers(width);
    if (width != width_ || height != height_) {
        width_ = width, height_ = height;
        sum_ = Picture::uninitialised(width, height), more_ = Picture::uninitialised(width, height);
        for (Plane* plane : {&before_, &own_, &beside_, &area_of_more_})
            *plane = Plane::uninitialised(padded, height);
        layer_ = Image<std::int32_t>::uninitialised(padded, height);
    }
    const LensLeft all;
    std::fill_n(sum_.pixels(), sum_.size(), Rgba{});
    std::fill_n(more_.pixels(), more_.size(), Rgba{});
    std::fill_n(before_.pixels(), before_.size(), all.before);
    std::fill_n(own_.pixels(), own_.size(), all.own);
    std::fill_n(beside_.pixels(), beside_.size(), all.beside);
    std::fill_n(area_of_more_.pixels(), area_of_more_.size(), all.more);
    std::fill_n(layer_.pixels(), layer_.size(), all.layer);
}

void Budget::take(int y, const Rgba* light, const Rgba* emptiness, int layer, Rgba* sum, Rgba* more) {
    HWY_DYNAMIC_DISPATCH(TakeRow)
    (light, emptiness, layer, sum, more, {before_.row(y), own_.row(y), beside_.row(y), area_of_more_.row(y)},
     layer_.row(y), width_);
}

bool Budget::is_spent(float least) const {
    for (int y = 0; y < height_; ++y)
        if (!HWY_DYNAMIC_DISPATCH(AllSpent)({before_.row(y), own_.row(y), nullptr, nullptr}, least, width_))
            return false;
    return true;
}

void Budget::add_to(int y, Rgba* light, float* taken) const {
    HWY_DYNAMIC_DISPATCH(AddGiven)
    (sum_.row(y), more_.row(y), {before_.row(y), own_.row(y), beside_.row(y), area_of_more_.row(y)}, light,
     taken, width_);
}

}  // namespace petzval::engine
#endif
