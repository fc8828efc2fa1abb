// Depth that a renderer filtered like colour gives almost the picture that exact depth gives.
#include "petzval/scene.h"

#include "shots.h"

namespace petzval::conformance {
namespace {

class AntialiasedDepth : public testing::TestWithParam<int> {};

TEST_P(AntialiasedDepth, IsAlmostAsGoodAsExactDepth) {
    SceneSettings settings;
    settings.width = 320, settings.height = 180, settings.samples = 16;
    settings.seed = std::uint64_t(GetParam());
    const Result<RenderedScene> exact = render_scene("random", settings);
    settings.depth_is_mean = true;
    const Result<RenderedScene> filtered = render_scene("random", settings);
    ASSERT_TRUE(exact.has_value() && filtered.has_value());
    for (const std::string engine : {"scatter", "gather"}) {
        DefocusJob job;
        job.engine = engine;
        job.colour = exact->colour, job.depth_m = exact->depth_m;
        job.camera = exact->camera;
        job.place = Place::whole(exact->colour.rect());
        const Picture wanted = rendered(job);
        job.depth_m = filtered->depth_m;
        const double by_itself = compare(wanted.view(), rendered(job).view())->psnr_srgb;
        job.depth_edges = DepthEdges::Keep;
        const double kept = compare(wanted.view(), rendered(job).view())->psnr_srgb;
        EXPECT_GT(by_itself, 37) << engine;
        EXPECT_GT(by_itself, kept + 2) << engine;
    }
}

// In 318, hair is thinner than a pixel.
INSTANTIATE_TEST_SUITE_P(Of, AntialiasedDepth, testing::Values(301, 303, 318));

}  // namespace
}  // namespace petzval::conformance
