// A picture stays as it is where everything around a pixel is in focus, and no blur from in front of focus
// reaches it.
#include "petzval/scene.h"

#include "shots.h"

#include <algorithm>
#include <cmath>

namespace petzval::conformance {
namespace {

// 1 for pixels within `reach` of one whose radius is in `wanted`, by rows and columns.
template <typename Wanted>
Image<unsigned char> around(View<const float> coc_px, int reach, const Wanted& wanted) {
    Image<unsigned char> in_rows(coc_px.width(), coc_px.height()), all(coc_px.width(), coc_px.height());
    const auto spread = [reach](int at, int size, const auto& mark) {
        for (int i = std::max(0, at - reach); i < std::min(size, at + reach + 1); ++i) mark(i);
    };
    for (int y = 0; y < coc_px.height(); ++y)
        for (int x = 0; x < coc_px.width(); ++x)
            if (wanted(coc_px(x, y))) spread(x, coc_px.width(), [&](int u) { in_rows(u, y) = 1; });
    for (int y = 0; y < coc_px.height(); ++y)
        for (int x = 0; x < coc_px.width(); ++x)
            if (in_rows(x, y)) spread(y, coc_px.height(), [&](int v) { all(x, v) = 1; });
    return all;
}

float shown(float light) { return std::pow(std::clamp(light, 0.0f, 1.0f), 1 / 2.2f); }

class InFocus : public testing::TestWithParam<int> {};

TEST_P(InFocus, ThePictureStays) {
    constexpr float kInFocusPx = 0.5f;
    SceneSettings settings;
    settings.width = 320, settings.height = 180, settings.seed = std::uint64_t(GetParam());
    const Result<RenderedScene> made = render_scene("random", settings);
    ASSERT_TRUE(made.has_value());
    DefocusJob job;
    job.colour = made->colour, job.depth_m = made->depth_m;
    job.camera = made->camera;
    job.place = Place::whole(made->colour.rect());
    const Result<Plane> radii = circle_of_confusion(job);
    ASSERT_TRUE(radii.has_value());
    Image<unsigned char> blurred = around(*radii, 1, [](float c) { return std::abs(c) > kInFocusPx; });
    for (float from = kInFocusPx; from < 200; from *= 2) {
        const auto reached = around(*radii, int(2 * from) + 3, [from](float c) { return -c > from; });
        for (std::size_t i = 0; i < blurred.size(); ++i) blurred.pixels()[i] |= reached.pixels()[i];
    }
    for (const std::string engine : {"scatter", "gather"}) {
        job.engine = engine;
        const Picture result = rendered(job);
        int in_focus = 0;
        float worst = 0;
        for (int y = 0; y < result.height(); ++y)
            for (int x = 0; x < result.width(); ++x) {
                if (blurred(x, y)) continue;
                ++in_focus;
                worst = std::max(worst, std::abs(shown(result(x, y).g) - shown(made->colour(x, y).g)));
            }
        EXPECT_GT(in_focus, 1000) << engine;
        EXPECT_LT(worst, 0.2f) << engine;
    }
}

// In 300 and 303, edges in focus are lit.
INSTANTIATE_TEST_SUITE_P(Of, InFocus, testing::Values(300, 303, 319, 324));

}  // namespace
}  // namespace petzval::conformance
