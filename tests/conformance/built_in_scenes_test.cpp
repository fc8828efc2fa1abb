// Hidden layers must help: the built-in scenes with and without them.
#include "petzval/scene.h"

#include "shots.h"

namespace petzval::conformance {
namespace {

class BuiltInScene : public testing::TestWithParam<std::string> {};

// Most objects are thinner than a pixel at this size, and few pixels show a single surface.
TEST_P(BuiltInScene, IsNoWorseWithHiddenLayers) {
    SceneSettings settings;
    settings.width = 96, settings.height = 54, settings.samples = 64, settings.truth_samples = 32;
    settings.want_truth = settings.want_layers = true;
    const Result<RenderedScene> made = render_scene(GetParam(), settings);
    ASSERT_TRUE(made.has_value());
    DefocusJob job;
    job.colour = made->colour, job.depth_m = made->depth_m;
    job.camera = made->camera;
    job.place = Place::whole(made->colour.rect());
    job.engine = "scatter";
    const double alone = psnr_inside(made->truth, rendered(job), 0);
    job.behind = &made->layers;
    EXPECT_GT(psnr_inside(made->truth, rendered(job), 0), alone - 0.05);
}

INSTANTIATE_TEST_SUITE_P(Of, BuiltInScene,
                         testing::Values("fence", "table", "bars", "tori", "cubes", "cutouts"),
                         [](const auto& info) { return info.param; });

}  // namespace
}  // namespace petzval::conformance
