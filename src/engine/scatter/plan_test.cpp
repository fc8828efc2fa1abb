// Plans of scatter, tested without drawing.
#include "engine/scatter/plan.h"

#include "engine/samples/complete_testing.h"
#include "engine/scatter/scatter_kernels.h"
#include "kernel/lenses/make_lens.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <gtest/gtest.h>

namespace petzval::engine {
namespace {

// A picture with its radii, and the other inputs of its plan.
class Planned {
public:
    Planned(int width, int height, const LensChoice& choice = {}, Quality quality = Quality::Standard)
        : colour_(width, height, Rgba{0.5f, 0.5f, 0.5f, 1}), coc_px_(width, height) {
        for (int level = 0; level < 6; ++level) {
            const int shift = level;
            const kernel::Mount mount{
                {50, 36, 1.4, 2}, std::max(1, width >> shift), std::max(1, height >> shift)};
            lenses_.push_back(std::move(kernel::make_lens(choice, mount)).value());
        }
        input_.lens.levels = lenses_;
        input_.lens.field_centre_x = 0.5 * width, input_.lens.field_centre_y = 0.5 * height;
        input_.lens.field_per_px = 2 / std::hypot(width, height);
        input_.options.quality = quality;
    }
    // coc(x, y)
    template <typename Coc>
    Planned& with_radii(const Coc& coc) {
        for (int y = 0; y < coc_px_.height(); ++y)
            for (int x = 0; x < coc_px_.width(); ++x) coc_px_(x, y) = coc(x, y);
        return *this;
    }
    Picture& colour() { return colour_; }
    const ScatterKernels& kernels() const { return *kernels_; }
    const ScatterPlan& plan() { return plan(colour_.rect()); }
    const ScatterPlan& plan(const Rect& rows) {
        return plan(rows, [](LevelRule&) {});
    }
    // change(rule): what is planned by otherwise than this quality is.
    template <typename Change>
    const ScatterPlan& plan(const Rect& rows, const Change& change) {
        input_.samples.colour = colour_, input_.samples.coc_px = coc_px_, input_.lens.frame = colour_.rect();
        const auto [low, high] = std::minmax_element(coc_px_.pixels(), coc_px_.pixels() + coc_px_.size());
        input_.samples.nearest_coc_px = std::min(0.0f, *low),
        input_.samples.farthest_coc_px = std::max(0.0f, *high);
        input_.services.progress = &progress_;
        LevelRule rule = level_rule(input_);
        change(rule);
        kernels_ = std::make_unique<ScatterKernels>(input_.lens, rule);
        const SampleSet set = complete_samples(input_);
        plan_ = make_plan(input_, set.samples, set.connected, rows, 0, rule, *kernels_);
        return plan_;
    }

private:
    Picture colour_;
    Plane coc_px_;
    std::vector<std::unique_ptr<const kernel::LensModel>> lenses_;
    Progress progress_;
    EngineView input_;
    std::unique_ptr<ScatterKernels> kernels_;
    ScatterPlan plan_;
};

LensChoice doublet() {
    LensChoice choice;
    choice.name = "doublet";
    return choice;
}

LensChoice cats_eye() {
    LensChoice choice;
    choice.cats_eye = 0.8;
    return choice;
}

// visit(tile, layer, run, arrival), each in the plan's order.
template <typename Visit>
void for_arrivals(const ScatterPlan& plan, const Visit& visit) {
    for (std::size_t t = 0; t + 1 < plan.tiles.size(); ++t)
        for (std::size_t l = plan.tiles[t].first_layer; l < plan.tiles[t + 1].first_layer; ++l)
            for (std::size_t r = plan.layers[l].first_run; r < plan.layers[l + 1].first_run; ++r)
                for (std::size_t a = plan.runs[r].first_arrival; a < plan.runs[r + 1].first_arrival; ++a)
                    visit(plan.tiles[t], plan.layers[l], plan.runs[r], a);
}

const Source& source_of(const ScatterPlan& plan, const LevelRun& run, std::size_t arrival) {
    return plan.levels[std::size_t(run.level)].sources[plan.arrivals[arrival].source];
}

// Light in front of focus left, behind it right, with a noise of radii.
float two_surfaces(int x, int y) { return (x < 90 ? -14.0f : 9.0f) + 0.4f * float((3 * x + 5 * y) % 7); }

TEST(ScatterPlan, EveryAskIsUsedAndEveryArrivalHasItsAsk) {
    for (const LensChoice& lens : {LensChoice{}, doublet(), cats_eye()})
        for (const Quality quality : {Quality::Draft, Quality::Standard, Quality::Final}) {
            Planned planned(180, 130, lens, quality);
            const ScatterPlan& plan = planned.with_radii(two_surfaces).plan();
            EXPECT_TRUE(std::is_sorted(plan.kernels.asks.begin(), plan.kernels.asks.end()));
            std::vector<int> used(plan.kernels.asks.size(), 0);
            for_arrivals(plan, [&](const Tile& tile, const TileLayer&, const LevelRun& run, std::size_t a) {
                const std::uint32_t kernel = plan.arrivals[a].kernel;
                ASSERT_LT(kernel, used.size());
                ++used[kernel];
                const device::KernelAsk& ask = plan.kernels.asks[kernel];
                const Source& s = source_of(plan, run, a);
                EXPECT_EQ(ask, planned.kernels().ask(run.level, ask.zone, s.radius, s.skirt_of(),
                                                     tile.sectors > 1));
            });
            EXPECT_EQ(std::count(used.begin(), used.end(), 0), 0);
            EXPECT_GT(used.size(), 10U);
        }
}

// Sum of a cell over all layers.
struct CellSum {
    double area = 0, light = 0, radius = 0, tilt = 0, off = 0;
    void add(const Source& s) {
        const double a = double(s.light.a);
        area += a, light += double(s.light.g), radius += a * double(s.radius), tilt += a * double(s.tilt_x);
        off += a * double(s.off_x);
    }
};

std::map<std::pair<int, int>, CellSum> cells_of(const SourceArray& level) {
    std::map<std::pair<int, int>, CellSum> cells;
    for (const Source& s : level.sources) cells[{s.x, s.y()}].add(s);
    return cells;
}

// Slanted on both sides of a silhouette, blurred by 0 to 25 px; every pixel of another grey.
TEST(ScatterPlan, SquaresOfADraftAreTheirPixels) {
    constexpr int kWidth = 179, kHeight = 133;  // squares end before the border, or would reach beyond it
    Planned planned(kWidth, kHeight, {}, Quality::Draft);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const float grey = 0.1f + 0.05f * float((7 * x + 3 * y) % 10);
            planned.colour()(x, y) = {grey, grey, grey, 1};
        }
    planned.with_radii([](int x, int y) { return (x < 90 ? -8 : 2) + 0.1f * float(x) + 0.05f * float(y); });
    const auto levels = [&](bool squares) {
        const auto change = [squares](LevelRule& rule) { rule.gathers_squares = squares; };
        return planned.plan({0, 0, kWidth, kHeight}, change).levels;
    };
    const auto of_squares = levels(true), of_pixels = levels(false);
    ASSERT_EQ(of_squares.size(), of_pixels.size());
    ASSERT_GE(of_squares.size(), 4U);
    for (std::size_t l = 0; l < of_squares.size(); ++l) {
        const auto pixels = cells_of(of_pixels[l]);
        for (const auto& [cell, sum] : cells_of(of_squares[l])) {
            const CellSum expected = pixels.at(cell);
            const double a = sum.area, b = expected.area;
            EXPECT_NEAR(a, b, 0.04);  // of a square all is shared between levels alike
            if (b < 0.1) continue;
            EXPECT_NEAR(sum.light / a, expected.light / b, 0.01) << l << testing::PrintToString(cell);
            EXPECT_NEAR(sum.radius / a, expected.radius / b, 0.03) << l << testing::PrintToString(cell);
            EXPECT_NEAR(sum.tilt / a, expected.tilt / b, 0.003) << l << testing::PrintToString(cell);
            if (b < 0.99) continue;  // of others pixels are shared between levels each on its own
            EXPECT_NEAR(sum.off / a, expected.off / b, 0.03) << l << testing::PrintToString(cell);
        }
    }
}

TEST(ScatterPlan, TilesCoverTheRowsOnce) {
    Planned planned(150, 140);
    const Rect rows{0, 64, 150, 140};
    const ScatterPlan& plan = planned.with_radii(two_surfaces).plan(rows);
    Image<int> covered(150, 140, 0);
    for (std::size_t t = 0; t + 1 < plan.tiles.size(); ++t) {
        const Rect& r = plan.tiles[t].pixels;
        for (int y = r.y0; y < r.y1; ++y)
            for (int x = r.x0; x < r.x1; ++x) ++covered(x, y);
    }
    for (int y = 0; y < 140; ++y)
        for (int x = 0; x < 150; ++x) EXPECT_EQ(covered(x, y), rows.contains(x, y) ? 1 : 0) << x << ", " << y;
}

TEST(ScatterPlan, LayersComeNearestFirstAndHoldOneLayerEach) {
    Planned planned(180, 130);
    const ScatterPlan& plan = planned.with_radii(two_surfaces).plan();
    for (std::size_t t = 0; t + 1 < plan.tiles.size(); ++t) {
        int before = std::numeric_limits<int>::min();
        for (std::size_t l = plan.tiles[t].first_layer; l < plan.tiles[t + 1].first_layer; ++l) {
            std::set<int> light, emptiness;
            for (std::size_t r = plan.layers[l].first_run; r < plan.layers[l + 1].first_run; ++r)
                for (std::size_t a = plan.runs[r].first_arrival; a < plan.runs[r + 1].first_arrival; ++a)
                    (r < plan.layers[l].first_empty_run ? light : emptiness)
                        .insert(source_of(plan, plan.runs[r], a).layer);
            ASSERT_LE(light.size(), 1U);
            ASSERT_LE(emptiness.size(), 1U);
            ASSERT_FALSE(light.empty() && emptiness.empty());
            const int layer = light.empty() ? *emptiness.begin() : *light.begin();
            EXPECT_GT(layer, before);
            before = layer;
        }
    }
}

TEST(ScatterPlan, WiderRadiiGoToCoarserLevels) {
    for (const float radius : {3.0f, 11.0f, 30.0f}) {
        Planned planned(160, 120);
        const ScatterPlan& plan = planned.with_radii([&](int, int) { return radius; }).plan();
        std::size_t finest = 0;
        while (plan.levels[finest].sources.empty()) ++finest;
        EXPECT_EQ(finest, std::size_t(std::ceil(plan.rule.position(radius)))) << radius;
        for (std::size_t l = 0; l < plan.levels.size(); ++l)
            for (const Source& s : plan.levels[l].sources)
                EXPECT_LE(std::abs(s.radius), plan.rule.largest_radius());
    }
}

TEST(ScatterPlan, SourcesTakeUpTheAreaOfThePictureOnce) {
    Planned planned(160, 128);
    const ScatterPlan& plan = planned.with_radii([](int x, int) { return 0.2f * float(x); }).plan();
    double area = 0;
    for (std::size_t l = 0; l < plan.levels.size(); ++l)
        for (const Source& s : plan.levels[l].sources)
            if (s.skirt_of() == 0 && s.x >= 0 && (s.x << l) < 160 && s.y() >= 0 && (s.y() << l) < 128)
                area += double(s.light.a) * double(1 << (2 * l));
    EXPECT_NEAR(area / (160 * 128), 1, 0.002);
}

TEST(ScatterPlan, RowsOfSourcesAscendAndKnowTheirRow) {
    Planned planned(150, 90, doublet());
    const ScatterPlan& plan = planned.with_radii(two_surfaces).plan();
    for (const SourceArray& level : plan.levels) {
        EXPECT_EQ(level.first.back(), level.sources.size());
        for (int y = level.area.y0; y < level.area.y1; ++y) {
            int before = std::numeric_limits<int>::min();
            for (const Source& s : level.row(y)) {
                EXPECT_EQ(s.y(), y);
                EXPECT_GE(s.x, before);
                before = s.x;
            }
        }
    }
}

// Devices find the part of a level's sources that a run needs by its first and last arrival.
TEST(ScatterPlan, SourcesOfARunAscend) {
    Planned planned(180, 130, doublet());
    const ScatterPlan& plan = planned.with_radii(two_surfaces).plan();
    for (std::size_t r = 0; r + 1 < plan.runs.size(); ++r)
        for (std::size_t a = plan.runs[r].first_arrival + 1; a < plan.runs[r + 1].first_arrival; ++a)
            EXPECT_GE(plan.arrivals[a].source, plan.arrivals[a - 1].source);
}

TEST(ScatterPlan, OneSurfaceHasOneBudgetAndTwoBehindEachOtherOneForEachSector) {
    Planned one(128, 128), two(128, 128), draft(128, 128, {}, Quality::Draft);
    for (const Tile& tile : one.with_radii([](int, int) { return 9.0f; }).plan().tiles)
        EXPECT_EQ(tile.sectors, 1);
    const auto& plan = two.with_radii([](int x, int) { return x < 64 ? -9.0f : 9.0f; }).plan();
    for (std::size_t t = 0; t + 1 < plan.tiles.size(); ++t)
        EXPECT_EQ(plan.tiles[t].sectors, LevelRule{}.sectors());
    for (const Tile& tile : draft.with_radii([](int x, int) { return x < 64 ? -9.0f : 9.0f; }).plan().tiles)
        EXPECT_EQ(tile.sectors, 1);
}

TEST(ScatterPlan, SharesOfTheZonesOfASourceSumToOne) {
    LensChoice lens = cats_eye();
    lens.coma = 5;
    Planned planned(180, 130, lens);
    const ScatterPlan& plan = planned.with_radii([](int, int) { return 0.5f; }).plan();
    ASSERT_EQ(plan.shares.size(), plan.arrivals.size());
    std::map<std::pair<const Tile*, std::uint32_t>, double> sums;
    std::size_t most = 0;
    std::map<std::pair<const Tile*, std::uint32_t>, std::size_t> counts;
    for_arrivals(plan, [&](const Tile& tile, const TileLayer&, const LevelRun& run, std::size_t a) {
        if (run.level > 0) return;
        sums[{&tile, plan.arrivals[a].source}] += double(plan.shares[a]);
        most = std::max(most, ++counts[{&tile, plan.arrivals[a].source}]);
    });
    for (const auto& [source, sum] : sums) ASSERT_NEAR(sum, 1, 1e-5);
    EXPECT_EQ(most, 4U);
    EXPECT_TRUE(Planned(64, 64).plan().shares.empty()) << "one zone: all of each source's light";
}

}  // namespace
}  // namespace petzval::engine
