// Noise far below what is visible moves no patch of the result: no decision hangs on the last digits of a
// colour.
#include "flicker.h"

#include <cstdint>

#include <gtest/gtest.h>

namespace petzval::flicker {
namespace {

// `seen`: the name of a scene, or "random" and its seed.
RenderedScene rendered(const std::string& seen) {
    SceneSettings settings;
    settings.width = 480, settings.height = 270;
    settings.samples = 16;
    const std::string random = "random";
    if (!seen.starts_with(random)) return std::move(render_scene(seen, settings).value());
    settings.seed = std::stoull(seen.substr(random.size()));
    return std::move(render_scene(random, settings).value());
}

// Every colour multiplied by 1 - part … 1 + part.
Picture with_noise(const Picture& picture, float part) {
    Picture noisy = picture.clone();
    std::uint32_t state = 1;
    const auto factor = [&] {
        state = state * 1664525U + 1013904223U;  // Numerical Recipes' generator
        return 1 + part * (float(state >> 8) / float(1 << 23) - 1);
    };
    for (int y = 0; y < noisy.height(); ++y)
        for (int x = 0; x < noisy.width(); ++x) {
            Rgba& c = noisy(x, y);
            c.r *= factor(), c.g *= factor(), c.b *= factor();
        }
    return noisy;
}

// The largest change of the mean of a channel over 8 x 8 pixels.
double worst_block(const Picture& a, const Picture& b) {
    constexpr int kBlock = 8;
    double worst = 0;
    for (int v = 0; v + kBlock <= a.height(); v += kBlock)
        for (int u = 0; u + kBlock <= a.width(); u += kBlock) {
            std::array<double, 3> sum{};
            for (int y = v; y < v + kBlock; ++y)
                for (int x = u; x < u + kBlock; ++x) {
                    const Rgba p = a(x, y), q = b(x, y);
                    sum[0] += double(p.r - q.r), sum[1] += double(p.g - q.g), sum[2] += double(p.b - q.b);
                }
            for (const double s : sum) worst = std::max(worst, std::abs(s) / (kBlock * kBlock));
        }
    return worst;
}

class Noise : public testing::TestWithParam<std::string> {};

TEST_P(Noise, OfATenThousandthMovesNoBlock) {
    constexpr double kLimit = 5e-4;
    const RenderedScene scene = rendered(GetParam());
    const Picture noisy = with_noise(scene.colour, 1e-4f);
    const auto expect_steady = [&](const std::string& engine, Quality quality) {
        DefocusJob job;
        job.colour = scene.colour, job.depth_m = scene.depth_m;
        job.camera = scene.camera;
        job.place = Place::whole(scene.colour.rect());
        job.engine = engine, job.quality = quality;
        const Picture without = std::move(defocus(job).value().image);
        job.colour = noisy;
        EXPECT_LT(worst_block(without, defocus(job).value().image), kLimit)
            << engine << ", quality " << int(quality);
    };
    expect_steady("scatter", Quality::Standard);
    expect_steady("scatter", Quality::Draft);
    expect_steady("gather", Quality::Standard);
}

INSTANTIATE_TEST_SUITE_P(Of, Noise,
                         testing::Values("post", "random204", "random221", "random222", "random228",
                                         "random229"),
                         [](const auto& info) { return info.param; });

}  // namespace
}  // namespace petzval::flicker
