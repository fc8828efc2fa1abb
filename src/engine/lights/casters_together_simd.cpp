// Compiled once per instruction set by Highway (foreach_target.h includes this file again for each). The law
// is written with operators, which registers of unknown length do not have: those machines take the next
// best.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#include "engine/lights/casters_together.h"
#include "laws/casters.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/lights/casters_together_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace petzval::engine::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, 16>;
using V = hn::Vec<Floats>;

struct Casters {
    V x, y, size, coc_px, coverage, right_px, down_px;
};
struct Seen {
    V u, v, wide, tall, blur, coverage;
};

using laws::kCasterOverlapPx;
using laws::kOneSquarePx;
using laws::kOpaqueCaster;
#define LAW_NUMBER V
#define LAW_TRUTH hn::Mask<Floats>
#define LAW_FUNCTION HWY_INLINE
#define LAW_CHANGES V&
#define LAW_OF(x) hn::Set(Floats(), x)
#define LAW_LESS(a, b) hn::Lt(a, b)
#define LAW_SAME(a, b) hn::Eq(a, b)
#define LAW_BOTH(a, b) hn::And(a, b)
#define LAW_NOT(a) hn::Not(a)
#define LAW_WHERE(c, a, b) hn::IfThenElse(c, a, b)
#define LAW_LEAST(a, b) hn::Min(a, b)
#define LAW_MOST(a, b) hn::Max(a, b)
#define LAW_CASTER const Casters&
#define LAW_VIEWPOINT const Viewpoint&
#define LAW_EDGES const OpenSides&
#define LAW_SEEN Seen&
#include "laws/seen_caster.inc"

std::size_t See(const CastersTogether& near, const Viewpoint& view, const OpenSides& edges, float pupil_end,
                SeenCaster* HWY_RESTRICT out) {
    const Floats d;
    constexpr std::size_t kMostLanes = 16;
    alignas(64) std::array<float, 4 * kMostLanes> places;
    alignas(64) std::array<float, 2 * kMostLanes> shades;
    std::size_t written = 0;
    for (std::size_t i = 0; i < near.size(); i += hn::Lanes(d)) {
        Casters casters;
        hn::LoadInterleaved4(d, near.first_halves() + CastersTogether::kHalf * i, casters.x, casters.y,
                             casters.size, casters.coc_px);
        hn::LoadInterleaved4(d, near.second_halves() + CastersTogether::kHalf * i, casters.coc_px,
                             casters.coverage, casters.right_px, casters.down_px);
        Seen seen;
        const auto sees = hn::And(law_sees(casters, view, edges, pupil_end, seen),
                                  hn::FirstN(d, std::min(hn::Lanes(d), near.size() - i)));
        std::uint64_t bits = 0;
        hn::StoreMaskBits(d, sees, reinterpret_cast<std::uint8_t*>(&bits));
        if (bits == 0) continue;
        hn::StoreInterleaved4(seen.u, seen.v, seen.wide, seen.tall, d, places.data());
        hn::StoreInterleaved2(seen.blur, seen.coverage, d, shades.data());
        for (; bits != 0; bits &= bits - 1) {
            const auto k = std::size_t(std::countr_zero(bits));
            const float *const place = &places[4 * k], *const shade = &shades[2 * k];
            out[written++] = {place[0], place[1], place[2], place[3], shade[0], shade[1]};
        }
    }
    return written;
}

}  // namespace petzval::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace petzval::engine {

HWY_EXPORT(See);

std::size_t CastersTogether::seen_from(const Viewpoint& view, const OpenSides& edges, float pupil_end,
                                       SeenCaster* out) const {
    return HWY_DYNAMIC_DISPATCH(See)(*this, view, edges, pupil_end, out);
}

}  // namespace petzval::engine
#endif
