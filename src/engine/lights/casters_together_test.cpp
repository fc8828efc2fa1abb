#include "engine/lights/casters_together.h"

#include "base/parallel.h"
#include "laws/casters.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <span>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

namespace petzval::engine {
namespace {

using laws::kCasterOverlapPx;
using laws::kOneSquarePx;
using laws::kOpaqueCaster;
// NOLINTBEGIN(cppcoreguidelines-macro-usage)
#define LAW_NUMBER float
#define LAW_TRUTH bool
#define LAW_FUNCTION inline
#define LAW_CHANGES float&
#define LAW_OF(x) (x)
#define LAW_LESS(a, b) ((a) < (b))
#define LAW_SAME(a, b) ((a) == (b))
#define LAW_BOTH(a, b) ((a) && (b))
#define LAW_NOT(a) (!(a))
#define LAW_WHERE(c, a, b) ((c) ? (a) : (b))
#define LAW_LEAST(a, b) std::min(a, b)
#define LAW_MOST(a, b) std::max(a, b)
#define LAW_CASTER const Caster&
#define LAW_VIEWPOINT const Viewpoint&
#define LAW_EDGES const OpenSides&
#define LAW_SEEN SeenCaster&
// NOLINTEND(cppcoreguidelines-macro-usage)
#include "laws/seen_caster.inc"

constexpr float kPupilEnd = 1.1f;
constexpr int kSide = 64;

auto members(const SeenCaster& c) { return std::tie(c.u, c.v, c.wide, c.tall, c.blur, c.coverage); }

// Around (20, 24), on both sides of focus; some lie beside a light there, and some are of its surface.
std::vector<Caster> random_casters(std::size_t n) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> share(0, 1);
    std::vector<Caster> casters;
    for (std::size_t i = 0; i < n; ++i) {
        const float size = float(1 << int(4 * share(random))), middle = 0.5f * (size - 1);
        casters.push_back({8 + std::floor(24 * share(random)) + middle,
                           12 + std::floor(24 * share(random)) + middle, size,
                           5.95f - 30 * share(random) * share(random), std::min(1.0f, 1.5f * share(random)),
                           share(random) - 0.5f, share(random) - 0.5f});
        if (i % 9 == 0) casters.back() = {20, 24, 1, 5.5f, 0.5f, 0, 0};
        if (i % 11 == 0) casters.back().coc_px = 5.9f;
    }
    return casters;
}

TEST(CastersTogether, AreSeenAsEachAlone) {
    LightsPlan plan;
    plan.picture = {14, 16, 28, 32};  // many casters cross its edges
    plan.open_edges = {true, true, true, true};
    const OpenSides edges(plan);
    const std::vector<Caster> casters = random_casters(CastersTogether::kMost);
    for (const Viewpoint& view : {Viewpoint{20, 24, 6, 1, 0, true}, Viewpoint{20, 24, 6, 1, 0, false},
                                  Viewpoint{20.5f, 23.5f, 6, 4, 0, false}, Viewpoint{9, 14, 6, 1, 0, false}})
        for (const std::size_t n : {std::size_t(0), std::size_t(1), std::size_t(37), casters.size()}) {
            CastersTogether together;
            ASSERT_EQ(together.add(std::span(casters).first(n)), n);
            std::vector<SeenCaster> found(CastersTogether::kMost), expected;
            found.resize(together.seen_from(view, edges, kPupilEnd, found.data()));
            for (std::size_t i = 0; i < n; ++i)
                if (SeenCaster seen; law_sees(casters[i], view, edges, kPupilEnd, seen))
                    expected.push_back(seen);
            ASSERT_EQ(found.size(), expected.size());
            if (n == casters.size()) {
                EXPECT_GT(found.size(), n / 8) << "most casters are not seen";
                EXPECT_LT(found.size(), n * 7 / 8) << "most casters are seen";
            }
            for (std::size_t i = 0; i < found.size(); ++i) EXPECT_EQ(members(found[i]), members(expected[i]));
        }
}

TEST(CastersTogether, TakeNoMoreThanTheyHaveRoomFor) {
    const std::vector<Caster> casters = random_casters(CastersTogether::kMost);
    CastersTogether together;
    EXPECT_EQ(together.add(std::span(casters).first(100)), 100u);
    EXPECT_EQ(together.add(casters), CastersTogether::kMost - 100);
    EXPECT_EQ(together.size(), CastersTogether::kMost);
    EXPECT_EQ(together.add(casters), 0u);
}

// More casters than are compared at a time, from several rows of blocks.
TEST(CastersTogether, NoneIsLostBetweenRanges) {
    CocSamples all;
    all.width = kSide;
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            all.first.push_back(all.samples.size());
            const float coc_px = (x + y) % 2 == 0 ? -8.0f : -9.0f;  // too different to be merged
            all.samples.push_back({{0, 0, 0, 1}, coc_px, coc_px});
        }
    all.first.push_back(all.samples.size());
    const ShadowCasters casters(all, one_thread());
    LightsPlan plan;
    plan.casters = &casters, plan.picture = {0, 0, kSide, kSide};
    const Viewpoint view{31, 31, 12, 1, 0.02f};
    std::vector<SeenCaster> expected;
    for (const CasterRange& range : near_casters(plan, view))
        for (const Caster& c : casters.of_row(range.view, range.row).subspan(range.first, range.count))
            if (SeenCaster seen; law_sees(c, view, OpenSides(plan), pupil_end(plan, view), seen))
                expected.push_back(seen);
    const std::vector<SeenCaster> found = seen_casters(plan, view);
    ASSERT_GT(found.size(), 2 * CastersTogether::kMost);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) ASSERT_EQ(members(found[i]), members(expected[i]));
}

}  // namespace
}  // namespace petzval::engine
