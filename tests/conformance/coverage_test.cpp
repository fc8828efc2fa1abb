// Coverage down to nothing, and any number of samples in a pixel, as thick smoke has them.
#include "drawers.h"

namespace petzval::conformance {
namespace {

class CoverageLaw : public EveryDrawer {};

bool is_finite(const Picture& image) {
    for (std::size_t i = 0; i < image.size(); ++i) {
        const Rgba c = image.pixels()[i];
        if (!std::isfinite(c.r) || !std::isfinite(c.g) || !std::isfinite(c.b) || !std::isfinite(c.a))
            return false;
    }
    return true;
}

// A pixel of a wall whose coverage falls to zero behaves like an empty one, whether dark or luminous.
TEST_P(CoverageLaw, NextToNoneIsNone) {
    const std::vector<float> few{-5}, many{-5, 0.3f, 7, 33};
    for (const float coc : traces() ? few : many)
        for (const float light : {0.0f, 0.3f}) {
            const auto with = [&](float coverage) {
                Shot shot = flat(traces() ? 24 : 60, traces() ? 20 : 50, {0.5f, 0.4f, 0.3f, 1}, coc);
                shot.colour(12, 10) = {light, light, light, coverage};
                return picture(shot);
            };
            const Picture none = with(0);
            for (const float coverage : {1e-6f, 1e-10f, 1e-20f, 1e-30f, 1e-38f, 2e-39f, 1e-40f, 1e-45f}) {
                const Picture next_to_none = with(coverage);
                EXPECT_TRUE(is_finite(next_to_none)) << coc << " coverage " << coverage;
                EXPECT_LE(largest_difference(next_to_none, none), 1e-5)
                    << coc << " coverage " << coverage << " light " << light;
            }
        }
}

struct Smoke {
    int samples;
    float alpha;  // of each
};

// A wall behind focus, and before a part of it smoke: all at one depth, or as thick as nobody sees.
class SmokyShot {
public:
    SmokyShot(int width, int height, const std::vector<DeepSample>& smoke)
        : deep_(DeepPicture::made_of(width, height, [&](int x, int y, std::vector<DeepSample>& samples) {
              if (x >= width / 4 && x < 3 * width / 4 && y >= height / 4)
                  samples.insert(samples.end(), smoke.begin(), smoke.end());
              const float wall = x / 5 % 2 == 0 ? 0.2f : 0.6f;
              samples.push_back({{wall, 0.3f, 0.8f - wall, 1}, 4, 4});
          })) {
        flatten(deep_, colour_, coc_px_);
    }
    DefocusJob job(const std::string& engine) const {
        DefocusJob job;
        job.colour = colour_, job.coc_px = coc_px_, job.deep = &deep_;
        job.place = Place::whole(colour_.rect());
        job.engine = engine, job.pupil_points = 1024;
        return job;
    }

private:
    DeepPicture deep_;
    Picture colour_;
    Plane coc_px_;
};

// Many samples, and one sample with their sum.
TEST_P(CoverageLaw, AnyNumberOfSamplesIsWhatTheyComeTo) {
    constexpr float kFront = -6, kThick = 0.01f;  // px of radius
    const int width = traces() ? 32 : 80, height = traces() ? 24 : 60;
    const std::vector<Smoke> few{{40, 0.95f}, {300, 0.01f}, {1500, 1e-42f}},
        many{{40, 0.95f},   {60, 0.9f},    {133, 0.5f},    {200, 0.5f},    {250, 0.01f}, {300, 0.01f},
             {1000, 0.95f}, {1500, 1e-3f}, {1500, 1e-20f}, {1500, 1e-42f}, {5000, 0.5f}};
    for (const auto& [count, alpha] : traces() ? few : many) {
        std::vector<DeepSample> smoke;
        double open = 1;
        Rgba all;
        for (int i = 0; i < count; ++i) {
            const float at = kFront + kThick * float(i) / float(count), light = i % 2 ? 0.4f : 0.6f;
            smoke.push_back({{light * alpha, 0.5f * alpha, 0.2f * alpha, alpha}, at, at});
            all += float(open) * smoke.back().colour;
            open *= 1 - double(alpha);
        }
        all.a = float(1 - open);
        const Picture many = drawn(SmokyShot(width, height, smoke).job(drawer().engine));
        const Picture one = drawn(SmokyShot(width, height, {{all, kFront, kFront}}).job(drawer().engine));
        EXPECT_TRUE(is_finite(many)) << count << " of " << alpha;
        EXPECT_GE(psnr_inside(one, many, 0), traces() ? 40 : 60) << count << " of " << alpha;
    }
}

// Smoke over all of the frame and many radii: what lies where hardly any light comes from changes nothing.
TEST_P(CoverageLaw, WhatIsBehindThickSmokeIsNotSeen) {
    const int width = traces() ? 16 : 60, height = traces() ? 12 : 40;
    const std::vector<Smoke> few{{40, 0.95f}}, many{{40, 0.95f}, {60, 0.9f}, {200, 0.5f}, {1000, 0.5f}};
    for (const auto& [count, alpha] : traces() ? few : many) {
        const auto smoke = [&, count = count, alpha = alpha](int first) {
            return DeepPicture::made_of(width, height, [&](int, int, std::vector<DeepSample>& samples) {
                for (int i = 0; i < first; ++i) {
                    const float at = -9 + 12 * float(i) / float(count), light = i % 2 ? 0.4f : 0.6f;
                    samples.push_back({{light * alpha, 0.5f * alpha, 0.2f * alpha, alpha}, at, at});
                }
            });
        };
        const auto picture_of = [&](const DeepPicture& deep) {
            Picture colour;
            Plane coc_px;
            flatten(deep, colour, coc_px);
            DefocusJob job;
            job.colour = colour, job.coc_px = coc_px, job.deep = &deep;
            job.place = Place::whole(colour.rect());
            job.engine = drawer().engine, job.pupil_points = 128;
            return drawn(job);
        };
        const int seen = int(std::ceil(std::log(1e-9) / std::log(1 - double(alpha))));
        const Picture all = picture_of(smoke(count));
        EXPECT_TRUE(is_finite(all)) << count << " of " << alpha;
        EXPECT_GE(psnr_inside(picture_of(smoke(seen)), all, 0), traces() ? 35 : 60)
            << count << " of " << alpha;
    }
}

PETZVAL_EVERY_DRAWER(CoverageLaw);

double difference_of_alpha(const Picture& a, const Picture& b) {
    double squares = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        squares += std::pow(double(a.pixels()[i].a - b.pixels()[i].a), 2);
    return std::sqrt(squares / double(a.size()));
}

// A disc alone in a nearer pane: the pane dims the disc by its alpha, and hides no part of it.
TEST(Pane, HidesNoMoreThanItsAlpha) {
    constexpr int kSize = 64;
    constexpr float kPanePx = -12;
    for (const float alpha : {0.01f, 0.3f, 0.9f})
        for (const float disc_px : {0.0f, 6.0f}) {
            Shot shot = flat(kSize, kSize, {0.2f * alpha, 0.2f * alpha, 0.2f * alpha, alpha}, kPanePx);
            for (int y = 0; y < kSize; ++y)
                for (int x = 0; x < kSize; ++x)
                    if (std::hypot(float(x) - 31.5f, float(y) - 31.5f) < 10)
                        shot.colour(x, y) = {0.8f, 0.8f, 0.8f, 1}, shot.coc_px(x, y) = disc_px;
            const auto drawn = [&](const std::string& engine) {
                DefocusJob job = shot.job(engine);
                job.pupil_points = 512;
                return rendered(job);
            };
            const Picture truth = drawn("reference");
            for (const std::string engine : {"scatter", "gather", "sprites", "gaussian"})
                EXPECT_LT(difference_of_alpha(drawn(engine), truth), 0.07)
                    << engine << ", alpha " << alpha << ", disc " << disc_px;
        }
}

// Light without coverage hides nothing, so no light is estimated behind it: it would be in the picture.
TEST(Pane, GlowBeforeGlowGainsNoLight) {
    constexpr int kSize = 64;
    for (const float focus_px : {0.0f, 6.0f}) {
        Shot shot = flat(kSize, kSize, {0.4f, 0.4f, 0.4f, 0}, focus_px);
        for (int y = 0; y < kSize; ++y)
            for (int x = 0; x < kSize / 2; ++x) shot.coc_px(x, y) = focus_px - 12;
        const auto light = [&](const std::string& engine) {
            DefocusJob job = shot.job(engine);
            job.pupil_points = 512;
            const Picture image = rendered(job);
            double sum = 0;
            for (int y = 0; y < kSize; ++y)
                for (int x = kSize / 4; x < 3 * kSize / 4; ++x) sum += double(image(x, y).r);
            return sum;
        };
        for (const std::string engine : {"scatter", "gather", "sprites"})
            EXPECT_LT(light(engine), 1.02 * light("reference")) << engine << ", focus " << focus_px;
    }
}

// The same as a deep picture, which states the disc and the pane in the same pixels; then a wall of half
// coverage behind an opaque near disc.
TEST(Pane, OfADeepPictureHidesNoMoreThanItsAlpha) {
    constexpr int kSize = 64;
    const auto surface = [](float grey, float alpha, float px) {
        return DeepSample{{grey * alpha, grey * alpha, grey * alpha, alpha}, px, px};
    };
    struct Scene {
        float pane, pane_px, disc, disc_px;
    };
    for (const Scene& scene : {Scene{0.01f, -12, 1, 0},
                               {0.3f, -12, 1, 0},
                               {0.3f, -12, 1, 6},
                               {0.9f, 0, 1, 6},
                               {1, -12, 0.5f, 0}}) {
        const DeepPicture deep =
            DeepPicture::made_of(kSize, kSize, [&](int x, int y, std::vector<DeepSample>& samples) {
                const bool within = std::hypot(float(x) - 31.5f, float(y) - 31.5f) < 10;
                if (scene.pane < 1 || within) samples.push_back(surface(0.2f, scene.pane, scene.pane_px));
                if (scene.pane == 1 || within) samples.push_back(surface(0.8f, scene.disc, scene.disc_px));
            });
        Picture colour;
        Plane coc_px;
        flatten(deep, colour, coc_px);
        const auto drawn = [&](const std::string& engine) {
            DefocusJob job;
            job.colour = colour, job.coc_px = coc_px, job.deep = &deep;
            job.place = Place::whole(colour.rect());
            job.engine = engine, job.pupil_points = 512;
            return rendered(job);
        };
        const Picture truth = drawn("reference");
        for (const std::string engine : {"scatter", "gather", "sprites"})
            EXPECT_LT(difference_of_alpha(drawn(engine), truth), 0.02)
                << engine << ", pane " << scene.pane << " at " << scene.pane_px;
    }
}

}  // namespace
}  // namespace petzval::conformance
