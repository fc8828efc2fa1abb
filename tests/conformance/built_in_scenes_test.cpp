// The built-in scenes with and without hidden layers, which must help, and in other units of light.
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

Picture times(const Picture& picture, float factor) {
    Picture scaled(picture.width(), picture.height());
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x) {
            const Rgba c = picture(x, y);
            scaled(x, y) = {factor * c.r, factor * c.g, factor * c.b, c.a};
        }
    return scaled;
}

// Renderers write light in any unit: a dim room as 0.001, a street in the sun as 10 000 cd/m2.
TEST_P(BuiltInScene, IsBlurredAlikeInAnyUnitOfLight) {
    SceneSettings settings;
    settings.width = 96;
    settings.height = 54;
    settings.samples = 64;
    const Result<RenderedScene> made = render_scene(GetParam(), settings);
    ASSERT_TRUE(made.has_value());
    for (const std::string engine : {"scatter", "gather", "sprites", "gaussian"}) {
        const auto blurred = [&](float unit) {
            const Picture colour = times(made->colour, unit);
            DefocusJob job;
            job.colour = colour;
            job.depth_m = made->depth_m;
            job.camera = made->camera;
            job.place = Place::whole(colour.rect());
            job.engine = engine;
            return times(rendered(job), 1 / unit);
        };
        const Picture usual = blurred(1);
        for (const float unit : {1.0f / 1024, 1024.0f})
            EXPECT_GT(psnr_inside(usual, blurred(unit), 0), 120) << engine << ", unit " << unit;
    }
}

INSTANTIATE_TEST_SUITE_P(Of, BuiltInScene,
                         testing::Values("fence", "table", "bars", "tori", "cubes", "cutouts"),
                         [](const auto& info) { return info.param; });

}  // namespace
}  // namespace petzval::conformance
