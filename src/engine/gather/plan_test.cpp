// Plans of gather, tested without drawing.
#include "engine/gather/plan.h"

#include "kernel/lenses/make_lens.h"
#include "kernel/model/pieces.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>

#include <gtest/gtest.h>

namespace petzval::engine {
namespace {

constexpr int kWidth = 640, kHeight = 384;  // 5 x 3 tiles

class Planned {
public:
    explicit Planned(const LensChoice& choice = {}, double f_number = 1.4) {
        for (int level = 0; level < 6; ++level) {
            const kernel::Mount mount{{50, 36, f_number, 2}, kWidth >> level, kHeight >> level};
            lenses_.push_back(std::move(kernel::make_lens(choice, mount)).value());
        }
        input_.lens.levels = lenses_;
        input_.lens.field_centre_x = 0.5 * kWidth, input_.lens.field_centre_y = 0.5 * kHeight;
        input_.lens.field_per_px = 2 / std::hypot(kWidth, kHeight);
        input_.lens.frame = colour_.rect();
    }
    void put(const Rect& pixels, float coc_px) {
        for (int y = pixels.y0; y < pixels.y1; ++y)
            for (int x = pixels.x0; x < pixels.x1; ++x) coc_px_(x, y) = coc_px;
        input_.samples.nearest_coc_px = std::min(input_.samples.nearest_coc_px, coc_px);
        input_.samples.farthest_coc_px = std::max(input_.samples.farthest_coc_px, coc_px);
    }
    RingSizes sizes() const {
        return {input_.samples.nearest_coc_px, input_.samples.farthest_coc_px, ring_rule(Quality::Standard),
                input_.lens, true};
    }
    RingKernels kernels() const { return {input_.lens, sizes()}; }
    GatherPlan plan() {
        input_.samples.colour = colour_, input_.samples.coc_px = coc_px_;
        return plan_gather(input_, colour_.rect(), 0, sizes(), kernels());
    }

private:
    Picture colour_{kWidth, kHeight, Rgba{0.5f, 0.5f, 0.5f, 1}};
    Plane coc_px_{kWidth, kHeight};
    std::vector<std::unique_ptr<const kernel::LensModel>> lenses_;
    EngineView input_;
};

// Wide open, this lens spreads light of objects in focus over 60 px and more.
LensChoice wide_open() {
    LensChoice lens;
    lens.name = "doublet";
    return lens;
}

TEST(GatherPlan, TilesThatNoBlurReachesStayAsTheyWere) {
    Planned shot;
    shot.put({10, 10, 60, 60}, 8);
    const GatherPlan plan = shot.plan();
    ASSERT_EQ(plan.tiles.size(), 15u);
    for (const GatherPlan::Tile& tile : plan.tiles)
        EXPECT_EQ(tile.is_sharp, tile.pixels.x0 >= 256 || tile.pixels.y0 >= 256) << tile.pixels.x0;
}

TEST(GatherPlan, NoTileStaysSharpUnderALensThatBlursWhatIsInFocus) {
    Planned shot(wide_open(), 0.7);
    shot.put({10, 10, 60, 60}, 8);
    for (const GatherPlan::Tile& tile : shot.plan().tiles) EXPECT_FALSE(tile.is_sharp) << tile.pixels.x0;
}

TEST(GatherPlan, RingsHaveTheirKernelsInTheZonesThatTheyLightAndNowhereElse) {
    LensChoice cats_eye;
    cats_eye.cats_eye = 0.8;
    Planned shot(cats_eye);
    shot.put({0, 0, 640, 384}, 3);
    shot.put({500, 300, 560, 340}, 40);
    const GatherPlan plan = shot.plan();
    ASSERT_EQ(plan.zones.count(), 54);
    const int wide = plan.sizes.mix(40).outer;
    int with = 0;
    for (int row = 0; row < plan.zones.rows; ++row)
        for (int column = 0; column < plan.zones.columns; ++column) {
            const int zone = row * plan.zones.columns + column;
            const bool is_lit = column >= plan.zones.column_of(500) && column <= plan.zones.column_of(559) &&
                                row >= plan.zones.row_of(300) && row <= plan.zones.row_of(339);
            EXPECT_EQ(plan.kernel(wide, zone) < plan.kernels.asks.size(), is_lit) << column << ", " << row;
            with += is_lit;
            for (int ring = 0; ring < plan.sizes.count(); ++ring) {
                const bool is_coarse = plan.sizes.level(ring) > 0;
                EXPECT_TRUE(is_coarse || plan.kernel(ring, zone) < plan.kernels.asks.size());
            }
        }
    EXPECT_GT(with, 0);
    EXPECT_TRUE(std::is_sorted(plan.kernels.asks.begin(), plan.kernels.asks.end()));
}

TEST(GatherPlan, NoKernelHasMoreThanSoManyTapsHoweverWideItIs) {
    Planned shot(wide_open(), 0.7);
    shot.put({0, 0, 640, 384}, 0.2f);
    shot.put({100, 100, 300, 300}, 40);
    shot.put({300, 100, 400, 300}, -9);
    const GatherPlan plan = shot.plan();
    const RingKernels kernels = shot.kernels();
    const RingRule rule = ring_rule(Quality::Standard);
    int skirts = 0;
    for (const device::KernelAsk& ask : plan.kernels.asks) {
        const auto made = kernels.make({&ask, 1});
        const kernel::PointSpread& piece = *made.front().front();
        const float most = rule.core_end(ask.level) + 1;
        EXPECT_LE(float(std::max({-piece.extent.x0, -piece.extent.y0, piece.extent.x1, piece.extent.y1})),
                  most + 1)
            << "level " << ask.level << ", piece " << ask.piece;
        skirts += ask.piece > 0;
    }
    EXPECT_GT(skirts, 0);
}

TEST(GatherPlan, ACoreAndItsSkirtHoldAllOfTheLight) {
    for (const double f_number : {0.7, 0.9, 1.0, 1.2, 1.4, 1.6, 1.8, 2.0}) {
        Planned shot(wide_open(), f_number);
        shot.put({0, 0, 640, 384}, 12);
        const GatherPlan plan = shot.plan();
        const RingKernels kernels = shot.kernels();
        int with_skirt = 0;
        for (int ring = 0; ring < plan.sizes.count(); ++ring) {
            if (plan.sizes.skirt_level(ring) == 0) continue;
            ++with_skirt;
            Rgba sum;
            for (const bool skirt : {false, true}) {
                const device::KernelAsk ask = kernels.ask(ring, 0, skirt);
                sum += kernel::sum_of(*kernels.make({&ask, 1}).front().front());
            }
            for (const float channel : {sum.r, sum.g, sum.b, sum.a})
                EXPECT_NEAR(channel, 1, 1e-4) << plan.sizes.radius_px(ring) << " px at f/" << f_number;
        }
        EXPECT_TRUE(f_number > 1 || with_skirt > 0);
    }
}

TEST(GatherPlan, LightInFocusHasItsSkirtToo) {
    Planned shot(wide_open(), 0.7);
    shot.put({0, 0, 640, 384}, 0);
    shot.put({500, 300, 600, 380}, 30);
    const GatherPlan plan = shot.plan();
    const RingSizes& sizes = plan.sizes;
    const int sharp = sizes.mix(0).inner, level = sizes.skirt_level(sharp);
    ASSERT_EQ(sizes.radius_px(sharp), 0);
    ASSERT_GT(level, 0);
    float covered = 0;
    for (const CellLight& light : plan.levels[std::size_t(level - 1)].at(100 >> level, 100 >> level))
        if (sizes.is_skirt(light.entry) && sizes.ring_of_entry(light.entry) == sharp)
            covered += light.covered;
    EXPECT_NEAR(covered, 1, 1e-4);
}

// Groups of rings are combined level by level: the group behind would give a surface's other part to the sky.
TEST(GatherPlan, NoSourceIsSharedBetweenLevels) {
    Planned shot;
    shot.put({0, 0, 100, 100}, -70);
    shot.put({500, 300, 600, 380}, 40);
    const RingSizes sizes = shot.sizes();
    ASSERT_GT(sizes.levels(), 2);
    for (float coc_px = -70; coc_px <= 40; coc_px += 0.05f)
        for (const bool hidden : {false, true}) {
            std::set<int> levels;
            float all = 0;
            sizes.hand_out(coc_px, hidden, [&](int turn, float share) {
                levels.insert(sizes.level_of_turn(turn)), all += share;
            });
            ASSERT_EQ(levels.size(), 1U) << coc_px;
            EXPECT_TRUE(sizes.light_of(*levels.begin()).contains(coc_px)) << coc_px;
            EXPECT_NEAR(all, 1, 1e-6) << coc_px;
        }
}

// Radii are 40 px divided by 1.15 again and again. 24 px are 12 cells of 2 px, so cells change at the first
// larger radius, 26.3 px. The last three finer rings have 26.3, 22.9 and 19.9 px; the next one has 17.3 px.
TEST(GatherPlan, LightBehindFocusIsInTheSeamOfTheNextLevel) {
    Planned shot;
    shot.put({0, 0, 100, 100}, -40);
    shot.put({500, 300, 600, 380}, 40);
    const RingSizes sizes = shot.sizes();
    const auto in_seam = [&](float coc_px) {
        float share = 0;
        sizes.hand_out_to_seam(coc_px, [&](int turn, float s) {
            EXPECT_TRUE(sizes.turns()[std::size_t(turn)].is_seam);
            EXPECT_TRUE(sizes.light_of(sizes.level_of_turn(turn)).contains(coc_px)) << coc_px;
            if (sizes.level_of_turn(turn) == 2) share += s;
        });
        return share;
    };
    const float change_px = 40 / std::pow(1.15f, 3.0f);
    EXPECT_NEAR(in_seam(0.99f * change_px), 1, 1e-6);
    EXPECT_NEAR(in_seam(1.01f * change_px), 0, 1e-6);
    EXPECT_NEAR(in_seam(change_px / 1.32f), 1, 1e-6);
    EXPECT_NEAR(in_seam(change_px / 1.53f), 0, 1e-6);
    EXPECT_EQ(in_seam(-0.99f * change_px), 0);
}

TEST(GatherPlan, RingsOfOneRadiusShareAKernelWhateverLiesBeside) {
    Planned far, both;
    far.put({0, 0, 640, 384}, 30);
    both.put({0, 0, 640, 384}, 30);
    both.put({0, 0, 100, 100}, -17);
    const GatherPlan one = far.plan(), other = both.plan();
    const std::set<device::KernelAsk> known(other.kernels.asks.begin(), other.kernels.asks.end());
    for (const device::KernelAsk& ask : one.kernels.asks) EXPECT_TRUE(known.contains(ask));
}

}  // namespace
}  // namespace petzval::engine
