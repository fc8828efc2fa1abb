// Compiled once per instruction set by Highway (foreach_target.h includes this file again for each).
#include "engine/samples/textures/repeats.h"

#include <algorithm>
#include <cstddef>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/samples/textures/repeats_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace petzval::engine::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, 16>;

// Offsets side by side, as many as a register holds: sums over all that is held against others, one after
// the other, so that they round alike on every machine.
void SumPairs(const float* HWY_RESTRICT values, const float* HWY_RESTRICT known, const std::size_t* held,
              std::size_t count, std::ptrdiff_t offset, Pairs* pairs, std::size_t offsets) {
    const Floats d;
    auto products = hn::Zero(d), squares = hn::Zero(d), both = hn::Zero(d);
    for (std::size_t i = 0; i < count; ++i) {
        const auto own = hn::Set(d, values[held[i]]);
        const std::size_t moved = std::size_t(std::ptrdiff_t(held[i]) + offset);
        const auto other = hn::LoadU(d, values + moved), is_known = hn::LoadU(d, known + moved);
        products = hn::Add(products, hn::Mul(own, other));
        squares = hn::Add(squares, hn::Add(hn::Mul(is_known, hn::Mul(own, own)), hn::Mul(other, other)));
        both = hn::Add(both, is_known);
    }
    alignas(64) float p[16], s[16], n[16];
    hn::Store(products, d, p), hn::Store(squares, d, s), hn::Store(both, d, n);
    for (std::size_t k = 0; k < std::min(offsets, hn::Lanes(d)); ++k) pairs[k] = {p[k], s[k], n[k]};
}
std::size_t OffsetsAtOnce() { return hn::Lanes(Floats()); }

}  // namespace petzval::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace petzval::engine {

HWY_EXPORT(SumPairs);
HWY_EXPORT(OffsetsAtOnce);

std::vector<Pairs> pairs_of(const Details& piece) {
    constexpr int kStep = 3;
    std::vector<std::size_t> held;
    for (int y = 0; y < piece.inner; y += kStep)
        for (int x = y / kStep % kStep; x < piece.inner; x += kStep)
            if (const std::size_t at = piece.at(piece.farthest + x, piece.farthest + y); piece.known[at] > 0)
                held.push_back(at);
    const std::size_t row = std::size_t(2 * piece.farthest + 1),
                      at_once = HWY_DYNAMIC_DISPATCH(OffsetsAtOnce)();
    std::vector<Pairs> pairs(row * std::size_t(piece.farthest + 1));
    for (int y = 0; y <= piece.farthest; ++y)
        for (std::size_t i = 0; i < row; i += at_once) HWY_DYNAMIC_DISPATCH(SumPairs)
    (piece.values.data(), piece.known.data(), held.data(), held.size(),
     std::ptrdiff_t(y) * piece.stride + std::ptrdiff_t(i) - piece.farthest,
     pairs.data() + std::size_t(y) * row + i, row - i);
    return pairs;
}

}  // namespace petzval::engine
#endif
