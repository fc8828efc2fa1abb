// Compiled once per instruction set by Highway (foreach_target.h includes this file again for each).
#include "kernel/draw/ray_map.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernel/draw/ray_map_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace petzval::kernel::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::CappedTag<double, 8>;
using Vector = hn::Vec<Doubles>;

// Sum over i and j of c x^i y^j with j even (odd: the part that y multiplies), i + j <= kRayMapDegree, in the
// order of PupilPowers: Horner in x within Horner in y squared.
Vector Polynomial(const double* c, std::size_t terms, int first_power, Vector x, Vector y_squared) {
    const Doubles d;
    Vector sum = hn::Zero(d);
    // Rows of powers of y from the highest down; their coefficients stand at the end.
    const int last = kRayMapDegree - (kRayMapDegree - first_power) % 2;
    for (int j = last; j >= first_power; j -= 2) {
        const std::size_t count = std::size_t(kRayMapDegree - j + 1);
        terms -= count;
        Vector row = hn::Set(d, c[terms + count - 1]);
        for (std::size_t i = count - 1; i-- > 0;) row = hn::MulAdd(row, x, hn::Set(d, c[terms + i]));
        sum = hn::MulAdd(sum, y_squared, row);
    }
    return sum;
}

// Calls `use` with every group of points: x, y and the index of the first; groups are padded with zeros.
template <typename Use>
void InGroups(const Point* pupil, std::size_t count, const Use& use) {
    const Doubles d;
    const std::size_t lanes = hn::Lanes(d);
    alignas(64) double xs[8], ys[8];
    for (std::size_t i = 0; i < count; i += lanes) {
        for (std::size_t k = 0; k < lanes; ++k) {
            const Point p = i + k < count ? pupil[i + k] : Point{};
            xs[k] = p.x, ys[k] = p.y;
        }
        use(hn::Load(d, xs), hn::Load(d, ys), i);
    }
}

void Land(const Displacement& map, const Point* pupil, std::size_t count, Point* landed) {
    const Doubles d;
    alignas(64) double along[8], across[8];
    InGroups(pupil, count, [&](Vector x, Vector y, std::size_t first) {
        const Vector y_squared = hn::Mul(y, y);
        hn::Store(Polynomial(map.along.data(), map.along.size(), 0, x, y_squared), d, along);
        hn::Store(hn::Mul(y, Polynomial(map.across.data(), map.across.size(), 1, x, y_squared)), d, across);
        for (std::size_t k = 0; k < hn::Lanes(d) && first + k < count; ++k)
            landed[first + k] = {along[k], across[k]};
    });
}

void ValuesAt(const double* polynomial, const Point* pupil, std::size_t count, double* values) {
    const Doubles d;
    alignas(64) double group[8];
    InGroups(pupil, count, [&](Vector x, Vector y, std::size_t first) {
        hn::Store(Polynomial(polynomial, kEvenTerms, 0, x, hn::Mul(y, y)), d, group);
        for (std::size_t k = 0; k < hn::Lanes(d) && first + k < count; ++k) values[first + k] = group[k];
    });
}

}  // namespace petzval::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace petzval::kernel {

HWY_EXPORT(Land);
HWY_EXPORT(ValuesAt);

void land(const Displacement& map, std::span<const Point> pupil, Point* landed) {
    HWY_DYNAMIC_DISPATCH(Land)(map, pupil.data(), pupil.size(), landed);
    if (!map.is_skew) return;
    Displacement others;  // with along and across exchanged
    others.along = map.across_even;
    others.across = map.along_odd;
    std::vector<Point> added(pupil.size());
    HWY_DYNAMIC_DISPATCH(Land)(others, pupil.data(), pupil.size(), added.data());
    for (std::size_t i = 0; i < added.size(); ++i) landed[i] = landed[i] + Point{added[i].y, added[i].x};
}

void lights_at(const RayMap& map, std::span<const Point> pupil, double* lights) {
    if (map.offset_mm.is_skew) {
        Displacement both;
        both.along = map.light;
        both.across = map.light_odd;
        std::vector<Point> parts(pupil.size());
        HWY_DYNAMIC_DISPATCH(Land)(both, pupil.data(), pupil.size(), parts.data());
        for (std::size_t i = 0; i < parts.size(); ++i) lights[i] = parts[i].x + parts[i].y;
    } else {
        HWY_DYNAMIC_DISPATCH(ValuesAt)(map.light.data(), pupil.data(), pupil.size(), lights);
    }
    for (std::size_t i = 0; i < pupil.size(); ++i) lights[i] = std::max(0.0, lights[i]);
}

}  // namespace petzval::kernel
#endif
