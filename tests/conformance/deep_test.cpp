// Deep pictures through the engines: volumes, elements with nothing behind them, hold-outs.
#include "shots.h"

namespace petzval::conformance {
namespace {

// A shot whose samples are all known: a function of the pixel gives them, nearest first, radii as depths.
struct DeepShot {
    DeepPicture deep, holdout;
    Picture colour;
    Plane coc_px;

    template <typename SamplesAt>
    static DeepPicture picture(int width, int height, const SamplesAt& samples_at) {
        return DeepPicture::made_of(width, height, [&](int x, int y, std::vector<DeepSample>& samples) {
            for (const DeepSample& s : samples_at(x, y)) samples.push_back(s);
        });
    }
    template <typename SamplesAt>
    static DeepShot make(int width, int height, const SamplesAt& samples_at) {
        DeepShot shot;
        shot.deep = picture(width, height, samples_at);
        flatten(shot.deep, shot.colour, shot.coc_px);
        for (std::size_t i = 0; i < shot.coc_px.size(); ++i)
            if (!std::isfinite(shot.coc_px.pixels()[i])) shot.coc_px.pixels()[i] = 0;
        return shot;
    }
    DefocusJob job(const std::string& engine) const {
        DefocusJob job;
        job.colour = colour, job.coc_px = coc_px;
        job.deep = &deep;
        job.holdout = holdout.empty() ? nullptr : &holdout;
        job.place = Place::whole(colour.rect());
        job.engine = engine;
        job.pupil_points = 1024;
        return job;
    }
};

using Samples = std::vector<DeepSample>;

DeepSample surface(Rgba colour, float coc_px) { return {colour, coc_px, coc_px}; }

const char* const kExact[] = {"scatter", "reference"};

TEST(Deep, InFocusAPictureLooksAsItDoesFromTheFront) {
    std::mt19937 random(11);
    std::uniform_real_distribution<float> value(0.3f, 0.7f);
    const DeepShot shot = DeepShot::make(24, 20, [&](int, int) {
        Samples samples;
        for (int i = 0; i < 4; ++i) {
            const float a = i == 3 ? 1 : value(random);
            samples.push_back(surface({a * value(random), a * value(random), a * value(random), a}, 0));
        }
        return samples;
    });
    EXPECT_LT(largest_difference(rendered(shot.job("scatter")), shot.colour), 1e-5);
    EXPECT_GE(psnr_inside(rendered(shot.job("reference")), shot.colour, 0), 40);  // rays that hit or miss
}

// Ragged objects of any coverage beside emptiness, bright and dark, a few hundredths of a pixel of radius
// apart as things far behind focus are: what each ray meets is what lies in its own pixel.
TEST(Deep, WhereNothingIsBlurredAPictureIsItsFlattening) {
    std::mt19937 random(5);
    const auto value = [&](float low, float high) {
        return std::uniform_real_distribution<float>(low, high)(random);
    };
    const float coverages[] = {0.02f, 0.3f, 0.7f, 0.98f, 1, 1};
    const DeepShot shot = DeepShot::make(60, 40, [&](int x, int y) {
        Samples samples;
        const bool inside = (x / 9 + y / 7) % 2 == 0;
        for (int i = 0, n = inside ? 1 + int(random() % 4) : 0; i < n; ++i) {
            const float a = coverages[random() % 6], light = a * (random() % 20 == 0 ? 30.0f : 1.0f);
            samples.push_back(surface({light * value(0, 1), light * value(0, 1), light * value(0, 1), a},
                                      0.012f * float(i) + value(0, 0.01f)));
        }
        return samples;
    });
    for (const char* engine : {"scatter", "reference", "gather"}) {
        const Picture image = rendered(shot.job(engine));
        double largest = 0;  // relative: one of the lights is 30
        for (std::size_t i = 0; i < image.size(); ++i) {
            const Rgba a = image.pixels()[i], b = shot.colour.pixels()[i], d = a - b;
            for (const float v : {d.r, d.g, d.b, d.a})
                largest = std::max(largest, double(std::abs(v)) / (1 + double(luminance(b))));
        }
        EXPECT_LT(largest, 1e-4) << engine;
    }
}

TEST(Deep, ConstantFogBeforeAConstantWallStaysWhatItIsAtAnyBlur) {
    const Rgba fog{0.3f, 0.32f, 0.35f, 0.6f}, wall{0.8f, 0.4f, 0.1f, 1}, expected = fog + 0.4f * wall;
    const auto constant = [&](int width, int height, float nearest, float farthest) {
        return DeepShot::make(width, height, [&](int, int) {
            return Samples{{fog, nearest, farthest}, surface(wall, farthest + 2)};
        });
    };
    const Picture wide = rendered(constant(120, 100, -22, 17).job("scatter"));
    EXPECT_LT(largest_difference(wide, Picture(120, 100, expected)), 2e-3);
    // The reference meets fog by chance.
    const Picture traced = rendered(constant(24, 20, -4, 3).job("reference"));
    Rgba mean;
    for (std::size_t i = 0; i < traced.size(); ++i) mean += traced.pixels()[i] * (1 / float(traced.size()));
    EXPECT_NEAR(mean.r, expected.r, 2e-3);
    EXPECT_NEAR(mean.b, expected.b, 2e-3);
}

TEST(Deep, ThinFogAloneKeepsItsLightAndItsAlpha) {
    // A block of fog in an empty frame, from in front of focus to behind it.
    const DeepShot shot = DeepShot::make(70, 60, [&](int x, int y) {
        return x >= 20 && x < 50 && y >= 20 && y < 40 ? Samples{{{0.02f, 0.03f, 0.04f, 0.05f}, -9, 14}}
                                                      : Samples{};
    });
    const Picture image = rendered(shot.job("scatter"));
    double alpha = 0, green = 0;
    for (std::size_t i = 0; i < image.size(); ++i)
        alpha += double(image.pixels()[i].a), green += double(image.pixels()[i].g);
    EXPECT_NEAR(alpha, 600 * 0.05, 0.3);
    EXPECT_NEAR(green, 600 * 0.03, 0.2);
    EXPECT_EQ(image(2, 2), Rgba{});
}

TEST(Deep, AnElementWithNothingBehindItFadesOutAtItsEdge) {
    for (const float coc : {-10.0f, 7.0f, 25.0f}) {
        const DeepShot shot = DeepShot::make(140, 120, [&](int x, int y) {
            return x >= 35 && x < 105 && y >= 25 && y < 95 ? Samples{surface({0.5f, 0.25f, 0.75f, 1}, coc)}
                                                           : Samples{};
        });
        const Picture image = rendered(shot.job("scatter"));
        EXPECT_GE(psnr_inside(rendered(shot.job("reference")), image, 0), 45) << coc;
        EXPECT_NEAR(image(35, 60).a, 0.5 + 1 / (M_PI * std::abs(double(coc))), 0.015) << coc;
        for (std::size_t i = 0; i < image.size(); ++i)
            EXPECT_NEAR(image.pixels()[i].r, 0.5 * double(image.pixels()[i].a), 2e-3);
    }
}

TEST(Deep, SamplesWithoutCoverageHideNothing) {
    const auto element = [](bool with_nothing_in_front) {
        return DeepShot::make(64, 64, [=](int x, int y) {
            if (x >= 20 && x < 44 && y >= 20 && y < 44) return Samples{surface({0.6f, 0.3f, 0.9f, 1}, 6)};
            return with_nothing_in_front ? Samples{surface({}, -15)} : Samples{};
        });
    };
    for (const char* engine : {"scatter", "gather", "reference"})
        EXPECT_EQ(
            largest_difference(rendered(element(true).job(engine)), rendered(element(false).job(engine))), 0)
            << engine;
}

TEST(Deep, AFullSceneWithoutHiddenSamplesGetsNoHolesAtItsSilhouettes) {
    const DeepShot shot = DeepShot::make(120, 80, [&](int x, int y) {
        const bool near = x >= 40 && x < 80 && y >= 20 && y < 60;
        return Samples{near ? surface({0.2f, 0.5f, 0.2f, 1}, -15) : surface({0.6f, 0.6f, 0.7f, 1}, 0)};
    });
    const Picture image = rendered(shot.job("scatter"));
    for (std::size_t i = 0; i < image.size(); ++i) EXPECT_NEAR(image.pixels()[i].a, 1, 1e-3);
}

TEST(Deep, HiddenSamplesAreSeenPastADefocusedEdgeAsTheReferenceSeesThem) {
    Picture texture(140, 100);
    paint_rectangles(texture, 8);
    const DeepShot shot = DeepShot::make(140, 100, [&](int x, int y) {
        Samples samples;
        if (x < 70) samples.push_back(surface({0.1f, 0.15f, 0.1f, 1}, -12));
        samples.push_back(surface(texture(x, y), 2));
        return samples;
    });
    EXPECT_GE(psnr_inside(rendered(shot.job("reference")), rendered(shot.job("scatter")), 16), 43);
}

// Three sets of blades that lean, each four or five intervals of radius behind the one before, and a bright
// wall behind focus: which part of the lens each takes decides what is seen between them.
TEST(Deep, BladesBehindEachOtherHideWhatTheReferenceSaysTheyDo) {
    const DeepShot shot = DeepShot::make(64, 52, [&](int x, int y) {
        Samples samples;
        const auto blade = [&](int lean, int apart, float coc_px) {
            const int at = (4 * x + lean * y) % (4 * apart);
            const float dark = at < 8 ? 0.03f : 0.12f;
            if (at < 16) samples.push_back(surface({dark, 2 * dark, dark, 1}, coc_px));
        };
        blade(3, 13, -9), blade(2, 11, -5), blade(1, 7, 0);
        samples.push_back(surface({0.8f, 0.9f, 1, 1}, 7));
        return samples;
    });
    DefocusJob truth = shot.job("reference");
    truth.pupil_points = 256;
    EXPECT_GE(psnr_inside(rendered(truth), rendered(shot.job("scatter")), 10), 34);  // 31.9 with four sectors
}

TEST(Deep, VolumesMatchTheReference) {
    // Fog thicker to the right, a dark bar inside it, a texture behind.
    Picture texture(60, 44);
    paint_rectangles(texture, 9);
    const DeepShot shot = DeepShot::make(60, 44, [&](int x, int y) {
        const float a = 0.2f + 0.5f * float(x) / 60;
        Samples samples{{{0.5f * a, 0.5f * a, 0.6f * a, a}, -5, 2}};
        if (y >= 20 && y < 27) samples.push_back(surface({0.05f, 0.05f, 0.05f, 1}, -2));
        samples.push_back(surface(texture(x, y), 4));
        return samples;
    });
    DefocusJob traced = shot.job("reference");
    traced.pupil_points = 512;
    EXPECT_GE(psnr_inside(rendered(traced), rendered(shot.job("scatter")), 6), 36);
}

DeepShot held_shot(float holdout_coc) {
    Picture texture(100, 80);
    paint_rectangles(texture, 10);
    texture(70, 40) = {800, 700, 500, 1};  // a highlight, its disc crosses the matte's edge
    DeepShot shot =
        DeepShot::make(100, 80, [&](int x, int y) { return Samples{surface(texture(x, y), 12)}; });
    shot.holdout = DeepShot::picture(100, 80, [&](int x, int) {
        return x < 64 ? Samples{surface({0, 0, 0, 0.75f}, holdout_coc)} : Samples{};
    });
    return shot;
}

TEST(Deep, AHoldoutInFrontTakesItsShareAndItsEdgeStaysSharp) {
    for (const char* engine : kExact) {
        DeepShot shot = held_shot(-20);
        const Picture held = rendered(shot.job(engine));
        shot.holdout = {};
        const Picture free = rendered(shot.job(engine));
        for (int y = 0; y < 80; ++y)
            for (int x = 0; x < 100; ++x) {
                const float kept = x < 64 ? 0.25f : 1;
                EXPECT_NEAR(held(x, y).g, kept * free(x, y).g, 1e-4f * (1 + free(x, y).g))
                    << engine << " " << x;
                EXPECT_NEAR(held(x, y).a, kept * free(x, y).a, 1e-5) << engine << " " << x;
            }
    }
}

TEST(Deep, AHoldoutBehindEverythingChangesNothing) {
    for (const char* engine : kExact) {
        DeepShot shot = held_shot(12);  // at the picture's own depth: not in front of it
        const Picture held = rendered(shot.job(engine));
        shot.holdout = {};
        EXPECT_LT(largest_difference(held, rendered(shot.job(engine))), 2e-5) << engine;
    }
}

TEST(Deep, AHoldoutBetweenTwoSurfacesHoldsOnlyTheFartherOne) {
    DeepShot shot = DeepShot::make(120, 80, [&](int x, int) {
        Samples samples;
        if (x < 60) samples.push_back(surface({0.5f, 0, 0, 1}, -9));
        samples.push_back(surface({0, 0.5f, 0, 1}, 6));
        return samples;
    });
    shot.holdout = DeepShot::picture(120, 80, [](int, int) { return Samples{surface({0, 0, 0, 1}, 0)}; });
    const Picture held = rendered(shot.job("scatter")), truth = rendered(shot.job("reference"));
    for (int x = 20; x < 100; ++x) {
        EXPECT_EQ(held(x, 40).g, 0);
        EXPECT_NEAR(held(x, 40).r, truth(x, 40).r, 6e-3);
        EXPECT_NEAR(held(x, 40).a, 2 * double(held(x, 40).r), 1e-4);
    }
}

TEST(Deep, AHoldoutThatASlopePassesThroughMatchesTheReference) {
    DeepShot shot = DeepShot::make(160, 90, [&](int x, int y) {
        return Samples{
            surface({0.4f + 0.002f * float(x), 0.5f, 0.3f + 0.004f * float(y), 1}, 0.15f * float(x - 80))};
    });
    shot.holdout = DeepShot::picture(160, 90, [](int, int y) {
        return y > 30 && y < 60 ? Samples{surface({0, 0, 0, 1}, 4)} : Samples{};
    });
    EXPECT_GE(psnr_inside(rendered(shot.job("reference")), rendered(shot.job("scatter")), 14), 35);
}

TEST(Deep, EnginesWithoutHoldoutsSaySo) {
    const DeepShot shot = held_shot(-20);
    const auto report = defocus(shot.job("gather"));
    ASSERT_FALSE(report.has_value());
    EXPECT_EQ(report.error().code, ErrorCode::InvalidArgument);
    EXPECT_NE(report.error().message.find("holdout"), std::string::npos);
}

TEST(Deep, StripsThreadsAndHoldoutsTogetherGiveTheSameBits) {
    DeepShot shot = DeepShot::make(64, 700, [](int x, int y) {
        return Samples{{{0.1f, 0.2f, 0.1f, 0.3f}, -4, -1},
                       surface({0.4f, 0.01f * float(x), 0.5f, 1}, y % 90 < 40 ? 3.0f : 7.0f)};
    });
    shot.holdout = DeepShot::picture(64, 700, [](int x, int) {
        return x < 40 ? Samples{surface({0, 0, 0, 0.75f}, 3)} : Samples{};
    });
    DefocusJob one = shot.job("scatter"), strips = shot.job("scatter");
    one.threads = 1, strips.workers = &three_threads();
    const Picture whole = rendered(one);
    strips.max_memory_bytes = 1;  // says what it takes at least: strips as narrow as they come
    const auto refused = defocus(strips);
    ASSERT_FALSE(refused);
    strips.max_memory_bytes = named_bytes(refused.error());
    EXPECT_EQ(largest_difference(whole, rendered(strips)), 0);
}

TEST(Deep, ManySamplesAndWildOnesStayFiniteAndBounded) {
    std::mt19937 random(12);
    const DeepShot shot = DeepShot::make(7, 5, [&](int x, int y) {
        Samples samples;
        const int count = x == 4 && y == 2 ? 100000 : int(random() % 10);
        for (int i = 0; i < count; ++i) {
            const float front = -30 + 60 * float(i) / float(count);
            samples.push_back({{0.01f, 0.02f, 1e-3f, 0.02f}, front, front + float(random() % 20)});
        }
        samples.push_back({{std::nanf(""), 1e30f, -2, 7}, 30, 20});
        return samples;
    });
    for (const char* engine : kExact) {
        DefocusJob job = shot.job(engine);
        job.pupil_points = 16;
        job.place.display_window = job.place.data_window.grown(1);  // nothing beyond
        const Picture image = rendered(job);
        for (std::size_t i = 0; i < image.size(); ++i)
            for (const float v : {image.pixels()[i].r, image.pixels()[i].g, image.pixels()[i].b})
                EXPECT_TRUE(std::isfinite(v)) << engine;
    }
}

// A floor of one colour crosses a change of level, and ends at column 48. The sky beyond is known behind it.
// Rays that pass its end come no nearer than its radius; columns 32 to 37 see nothing but floor.
TEST(Deep, GatherShowsNoSkyThroughAFloorThatGoesOutOfFocus) {
    const Rgba floor{0.1f, 0.1f, 0.1f, 1};
    for (const float slope : {0.02f, 0.06f, 0.12f}) {
        const DeepShot shot = DeepShot::make(64, 120, [&](int x, int y) {
            Samples samples;
            if (x < 48) samples.push_back(surface(floor, 6.5f + slope * float(60 - y)));
            samples.push_back(surface({1, 1, 1, 1}, 20));
            return samples;
        });
        const Picture image = rendered(shot.job("gather"));
        float most = 0;
        for (int y = 40; y < 80; ++y)
            for (int x = 32; x < 38; ++x) most = std::max(most, image(x, y).g);
        EXPECT_LT(most, 0.12f) << slope;
    }
}

// A renderer's file ends each pixel at its first opaque sample. A card before a wall.
TEST(Deep, WhatAnOpaqueSampleHidesIsEstimatedAsInAFlatPicture) {
    constexpr int kWidth = 120, kHeight = 60;
    constexpr Rect kCard{40, 0, 70, kHeight};
    const auto wall = [](int x) {
        const float light = 0.6f + 0.3f * std::sin(0.05f * float(x));
        return surface({light, 0.2f, 1 - light, 1}, 5);
    };
    const DeepSample card = surface({0.1f, 0.3f, 0.1f, 1}, -6);
    const auto shot = [&](bool states_all) {
        return DeepShot::make(kWidth, kHeight, [&](int x, int y) {
            if (!kCard.contains(x, y)) return Samples{wall(x)};
            return states_all ? Samples{card, wall(x)} : Samples{card};
        });
    };
    const DeepShot ends = shot(false), whole = shot(true);
    const Picture truth = rendered(whole.job("reference"));
    for (const auto& [engine, gained] : {std::pair{"scatter", 3.0}, {"gather", -1.0}}) {
        DefocusJob job = ends.job(engine), flat = ends.job(engine);
        flat.deep = nullptr;
        const double estimated = psnr_inside(truth, rendered(job), 12);
        EXPECT_GT(estimated, psnr_inside(truth, rendered(flat), 12) - 0.5) << engine;
        job.fill = Fill::Off;
        EXPECT_GT(estimated, psnr_inside(truth, rendered(job), 12) + gained) << engine;
    }
}

// A card with mixed sides before a wall, and a lamp beside it.
TEST(Deep, OfOneOpaqueSampleInEachPixelIsDrawnAsAFlatPicture) {
    Shot flat_shot = flat(110, 70, {}, 6);
    paint_rectangles(flat_shot.colour, 17);
    for (int v = 30; v < 32; ++v)
        for (int u = 62; u < 64; ++u) flat_shot.colour(u, v) = {80, 70, 50, 1};
    const Rgba card{0.1f, 0.3f, 0.2f, 1};
    for (int y = 0; y < 70; ++y)
        for (int x = 40; x <= 60; ++x) {
            const float part = x == 40 || x == 60 ? 0.4f : 1.0f;
            flat_shot.colour(x, y) = part * card + (1 - part) * flat_shot.colour(x, y);
            if (part == 1) flat_shot.coc_px(x, y) = -5;
        }
    const DeepPicture deep = DeepShot::picture(110, 70, [&](int x, int y) {
        return Samples{surface(flat_shot.colour(x, y), flat_shot.coc_px(x, y))};
    });
    // gather draws given samples in finer steps of radius.
    for (const auto& [engine, least] : {std::pair{"scatter", 60.0}, {"gather", 40.0}}) {
        DefocusJob job = flat_shot.job(engine);
        const Picture expected = rendered(job);
        job.deep = &deep;
        EXPECT_GT(psnr_inside(expected, rendered(job), 0), least) << engine;
    }
}

}  // namespace
}  // namespace petzval::conformance
