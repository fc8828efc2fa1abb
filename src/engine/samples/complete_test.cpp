#include "engine/samples/complete.h"

#include "base/parallel.h"
#include "engine/samples/sample_source.h"
#include "engine/samples/silhouettes/connectivity.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include <gtest/gtest.h>

namespace petzval::engine {
namespace {

constexpr int kWidth = 40, kHeight = 50;

// A near disc over a far wall, completed to the surfaces that a lens may see.
class DiscBeforeWall {
public:
    DiscBeforeWall() : colour_(kWidth, kHeight), coc_px_(kWidth, kHeight) {
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x) {
                const bool near = std::hypot(x - 20, y - 25) < 12;
                coc_px_(x, y) = near ? -9.0f : 5.0f;
                colour_(x, y) = near ? Rgba{0.2f, 0.6f, 0.1f, 1} : Rgba{0.5f, 0.4f, 0.01f * float(x + y), 1};
            }
        input_.samples.colour = colour_, input_.samples.coc_px = coc_px_, input_.lens.frame = colour_.rect();
        input_.samples.nearest_coc_px = -9, input_.samples.farthest_coc_px = 5;
    }
    CompletedPicture completed() const { return {input_, connections(coc_px_, one_thread()), {}}; }

private:
    Picture colour_;
    Plane coc_px_;
    EngineView input_;
};

bool equal(const CocSample& a, const CocSample& b) {
    return a.colour == b.colour && a.coc_px == b.coc_px && a.coc_back_px == b.coc_back_px &&
           a.empty == b.empty;
}

TEST(CompletedPicture, RowsAreThoseOfAll) {
    const DiscBeforeWall scene;
    const CompletedPicture picture = scene.completed();
    const CocSamples all = picture.all();
    EXPECT_EQ(picture.sample_count(), all.samples.size());
    EXPECT_GT(all.samples.size(), std::size_t(kWidth * kHeight));
    EXPECT_EQ(picture.largest_coc_px(), SampleSource(all).largest_coc_px());
    CocSamples rows;  // one memory for all
    for (int y0 = 0; y0 < kHeight; y0 += SampleSource::kRows) {
        const int y1 = std::min(y0 + SampleSource::kRows, kHeight);
        picture.rows(y0, y1, rows);
        ASSERT_EQ(rows.height(), y1 - y0);
        for (int y = y0; y < y1; ++y)
            for (int x = 0; x < kWidth; ++x) {
                const auto some = CocSamplesView(rows).at(x, y - y0), same = CocSamplesView(all).at(x, y);
                EXPECT_TRUE(std::equal(some.begin(), some.end(), same.begin(), same.end(), equal))
                    << x << "," << y;
            }
    }
}

TEST(CompletionModel, EveryNumberLiesInItsRangeAndHasAReason) {
    std::set<std::string> names;
    for (const CompletionNumber& n : completion_numbers()) {
        const float value = completion_model.*n.value;
        EXPECT_LE(n.least, value) << n.name;
        EXPECT_GE(n.most, value) << n.name;
        EXPECT_LT(n.least, n.most) << n.name;
        EXPECT_NE(n.off, value) << n.name << " is switched off";
        EXPECT_FALSE(std::string(n.unit).empty() || std::string(n.reason).empty()) << n.name;
        EXPECT_TRUE(names.insert(n.name).second) << n.name << " stands twice";
    }
}

}  // namespace
}  // namespace petzval::engine
