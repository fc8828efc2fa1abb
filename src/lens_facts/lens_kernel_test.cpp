#include "petzval/lens_kernel.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace petzval {
namespace {

LensMount mount() {
    LensMount m;
    m.camera = {.focal_length_mm = 50, .sensor_width_mm = 36, .f_number = 2, .focus_distance_m = 0};
    return m;
}

LensChoice named(const std::string& name) {
    LensChoice choice;
    choice.name = name;
    return choice;
}

double green(const Picture& picture) {
    double sum = 0;
    for (std::size_t i = 0; i < picture.size(); ++i) sum += double(picture.pixels()[i].g);
    return sum;
}

TEST(LensPointSpread, StandsInTheMiddleOfAnOddSquareAndSumsToOne) {
    for (const char* name : {"ideal", "doublet", "triplet-cooke"}) {
        LensMount m = mount();
        m.camera.f_number = 4;
        const auto disc = lens_point_spread(named(name), m, -9, 0.3, 0.2);
        ASSERT_TRUE(disc) << name;
        EXPECT_EQ(disc->weights.width() % 2, 1);
        EXPECT_EQ(disc->weights.width(), disc->weights.height());
        EXPECT_NEAR(green(disc->weights), 1, 1e-5) << name;
        EXPECT_EQ(disc->lost_share, 0);
    }
}

TEST(LensPointSpread, ASmallPictureSaysWhatItLeavesOut) {
    const auto disc = lens_point_spread(named("ideal"), mount(), 20, 0, 0, 20);
    ASSERT_TRUE(disc);
    EXPECT_EQ(disc->weights.width(), 21);
    EXPECT_NEAR(disc->lost_share, 1 - 21.0 * 21 / (3.14159265 * 400), 1e-3);
}

TEST(LargestDisc, HoldsTheDiscAtEveryPlaceAndRadius) {
    for (const char* name : {"ideal", "doublet", "uncorrected", "triplet-cooke", "petzval-laikin"}) {
        const auto lens = Lens::open(named(name));
        ASSERT_TRUE(lens) << name;
        LensMount m;
        m.camera = own_camera(*lens).value();
        for (const double radius : {-12.0, 0.0, 0.4, 12.0}) {
            const int most = largest_disc_px(*lens, m, radius).value();
            EXPECT_EQ(most % 2, 1);
            for (const double field : {0.0, 0.5, 1.0})
                EXPECT_LE(lens_point_spread(*lens, m, radius, field).value().needed_px, most)
                    << name << " " << radius << " " << field;
        }
        BokehTextureSettings settings;
        settings.columns = 8, settings.largest_coc_px = 12;
        EXPECT_LE(bokeh_texture(*lens, m, settings).value().energy.height(),
                  most_texture_rows(*lens, m, settings).value())
            << name;
    }
}

// The smallest of 14 radii is 64 / 13^2 px, and its tile covers 4 px. The largest's tile covers 64 / 0.35 px.
TEST(LensAtlas, KnowsTheSideOfItsLargestKernel) {
    for (const char* name : {"ideal", "doublet", "triplet-cooke"}) {
        LensMount m = mount();
        m.camera.f_number = 4;
        const Lens lens = Lens::open(named(name)).value();
        int needed = 0;
        const auto draw = [&](double coc_px, double finer) {
            LensMount fine = m;
            fine.width_px = int(m.width_px * finer), fine.height_px = int(m.height_px * finer);
            for (const double field : {0.0, 0.5, 1.0})
                needed =
                    std::max(needed, lens_point_spread(lens, fine, coc_px * finer, field).value().needed_px);
        };
        draw(64.0 / 169, 31.0 / 4);
        draw(64, 31 * 0.35 / 64);
        const int most = lens_atlas_disc_px(lens, m).value();
        EXPECT_LE(needed, most) << name;
        EXPECT_GE(2 * needed, most) << name;
    }
}

TEST(LensAtlas, OfRingsIsOfARoundPupilAndSquarePixels) {
    const auto refused = [](const auto& set, int zones) {
        LensChoice choice;
        set(choice);
        const Status fine = check(LensAtlasSettings{.zones = zones}, choice);
        return fine ? "" : fine.error().field;
    };
    const auto blades = [](LensChoice& c) { c.aperture.blades = 5; };
    EXPECT_EQ(refused(blades, 2), "lens.blades");
    EXPECT_EQ(refused(blades, 1), "");
    EXPECT_EQ(refused([](LensChoice& c) { c.aperture.squeeze = 2; }, 2), "lens.squeeze");
    EXPECT_EQ(refused([](LensChoice& c) { c.barn_doors.top = 1; }, 2), "lens.barn_doors");
    EXPECT_EQ(refused([](LensChoice& c) { c.texture.image = std::make_shared<Plane>(3, 3); }, 2),
              "lens.aperture_image");
    EXPECT_EQ(refused([](LensChoice& c) { c.kernel_images.near = std::make_shared<Picture>(3, 3); }, 2),
              "lens.kernel_image");
    EXPECT_EQ(refused([](LensChoice& c) { c.texture.dust = 0.5; }, 2), "lens.dust");
    EXPECT_EQ(refused([](LensChoice& c) { c.texture.scratches = 0.5; }, 2), "lens.scratches");
    EXPECT_EQ(refused([](LensChoice& c) { c.cats_eye = 0.5, c.texture.onion_rings = 1; }, 64), "");
    EXPECT_EQ(refused([](LensChoice&) {}, 65), "atlas.zones");

    LensChoice choice;
    blades(choice);
    EXPECT_EQ(lens_atlas(Lens::open(choice).value(), mount()).error().field, "lens.blades");
    choice = {};
    choice.name = "schneider-anamorphic";
    EXPECT_EQ(lens_atlas(Lens::open(choice).value(), mount()).error().field, "lens.name");
    LensMount wide = mount();
    wide.pixel_aspect = 2;
    EXPECT_EQ(lens_atlas(Lens::open({}).value(), wide).error().field, "mount.pixel_aspect");
}

TEST(LensPointSpread, RawKeepsTheNegativesOfSaturatedFringes) {
    const auto least = [](bool raw) {
        float low = 0;
        const auto disc = lens_point_spread(named("uncorrected"), mount(), -20, 0, 0, 0, raw);
        for (std::size_t i = 0; i < disc->weights.size(); ++i)
            low = std::min(
                {low, disc->weights.pixels()[i].r, disc->weights.pixels()[i].g, disc->weights.pixels()[i].b});
        return low;
    };
    EXPECT_LT(least(true), 0);
    EXPECT_EQ(least(false), 0);
}

TEST(LensPointSpread, RefusesNumbersThatMakeNoPicture) {
    EXPECT_FALSE(lens_point_spread(named("ideal"), mount(), std::nan("")));
    EXPECT_FALSE(lens_point_spread(named("ideal"), mount(), 1e9));
    EXPECT_FALSE(lens_point_spread(named("ideal"), mount(), 5, 2, 0));
    EXPECT_FALSE(lens_point_spread(named("ideal"), mount(), 5, 0, 0, -3));
    EXPECT_FALSE(lens_point_spread(named("no such lens"), mount(), 5));
}

TEST(BokehTexture, ColumnsAreTheProfilesOfDiscsDenseNearFocus) {
    const auto texture =
        bokeh_texture(named("doublet"), mount(), {.columns = 65, .largest_coc_px = 32, .rows_per_px = 1});
    ASSERT_TRUE(texture);
    ASSERT_EQ(texture->coc_radius_px.size(), 65u);
    EXPECT_EQ(texture->coc_radius_px.front(), -32);
    EXPECT_EQ(texture->coc_radius_px.back(), 32);
    EXPECT_EQ(texture->coc_radius_px[32], 0);
    EXPECT_LT(texture->coc_radius_px[33], 0.05);
    const auto disc = lens_point_spread(named("doublet"), mount(), 32);
    const int middle = disc->weights.width() / 2;
    for (int v = 0; v < middle; ++v)
        EXPECT_EQ(texture->energy(64, v), disc->weights(middle + v, middle)) << v;
}

// Drawn of rings of light, and of a mesh over the pupil.
TEST(BokehTexture, AColumnOfATracedLensIsTheRowOfItsDisc) {
    for (const char* name : {"tessar", "triplet-cooke", "double-gauss"})
        for (const bool raw : {false, true}) {
            const auto lens = Lens::open(named(name));
            ASSERT_TRUE(lens) << name;
            LensMount m;
            m.camera = own_camera(*lens).value();
            const auto texture =
                bokeh_texture(*lens, m, {.columns = 3, .largest_coc_px = 40, .rows_per_px = 1, .raw = raw});
            ASSERT_TRUE(texture) << texture.error().message;
            for (const int u : {0, 2}) {
                const auto disc = lens_point_spread(*lens, m, u == 0 ? -40 : 40, 0, 0, 0, raw);
                const int middle = disc->weights.width() / 2;
                double off = 0, all = 0;  // of light, summed over rings
                for (int v = 0; v < std::min(middle, texture->energy.height()); ++v) {
                    const Rgba there = disc->weights(middle + v, middle), d = texture->energy(u, v) - there;
                    off += double(std::abs(d.r) + std::abs(d.g) + std::abs(d.b)) * (v + 0.5);
                    all += double(there.r + there.g + there.b) * (v + 0.5);
                }
                EXPECT_LT(off / all, 0.02) << name << " column " << u << (raw ? " raw" : "");
            }
        }
}

TEST(BokehTexture, EndsWhenNobodyWantsIt) {
    int asked = 0;
    const auto ended =
        bokeh_texture(named("doublet"), mount(),
                      {.columns = 64, .threads = 1, .progress = [&](double) { return ++asked < 3; }});
    ASSERT_FALSE(ended);
    EXPECT_EQ(ended.error().code, ErrorCode::Cancelled);
    EXPECT_EQ(asked, 3);
    EXPECT_FALSE(bokeh_texture(named("doublet"), mount(), {.columns = 64, .cancelled = [] { return true; }}));
}

TEST(BokehTexture, TheViewBringsEveryColumnNearOne) {
    const auto texture = bokeh_texture(named("uncorrected"), mount(), {.columns = 513, .largest_coc_px = 20});
    for (int u = 0; u < 513; ++u) {
        float most = 0;
        for (int v = 0; v < texture->view.height(); ++v)
            most = std::max({most, texture->view(u, v).r, texture->view(u, v).g, texture->view(u, v).b});
        EXPECT_GT(most, 0.5) << u;
        EXPECT_LT(most, 2) << u;
    }
}

TEST(BokehTexture, FinerRowsShowTheSameLight) {
    const auto coarse =
        bokeh_texture(named("doublet"), mount(), {.columns = 3, .largest_coc_px = 30, .rows_per_px = 1});
    const auto fine =
        bokeh_texture(named("doublet"), mount(), {.columns = 3, .largest_coc_px = 30, .rows_per_px = 4});
    EXPECT_NEAR(fine->energy.height(), 4 * coarse->energy.height(), 8);
    for (int v = 0; v < 20; ++v)
        EXPECT_NEAR(fine->energy(2, 4 * v).g, coarse->energy(2, v).g, 0.03f * coarse->energy(2, 10).g) << v;
}

TEST(BokehTexture, IsOfTheRoundApertureOnTheAxisWhateverTheBlades) {
    LensChoice bladed = named("doublet");
    bladed.aperture.blades = 5, bladed.cats_eye = 0.7;
    const auto a = bokeh_texture(bladed, mount(), {.columns = 9, .largest_coc_px = 20});
    const auto b = bokeh_texture(named("doublet"), mount(), {.columns = 9, .largest_coc_px = 20});
    for (int u = 0; u < 9; ++u) EXPECT_EQ(a->energy(u, 5), b->energy(u, 5));
}

TEST(BokehVolume, BeginsWhereTheOwnBlurOfTheLensFitsASlice) {
    for (const int slices : {5, 32}) {
        const Lens lens = Lens::open(named("doublet")).value();
        const LensMount mount{.camera = own_camera(lens).value()};
        const auto volume = bokeh_volume(lens, mount, {.slices = slices, .side_px = 32}).value();
        for (const Picture& slice : volume.slices) {
            double light = 0;
            for (std::size_t k = 0; k < slice.size(); ++k) light += double(slice.pixels()[k].g);
            EXPECT_NEAR(light, 1, 0.02) << slices;
        }
        EXPECT_NEAR(volume.coc_radius_px.back(), 64, 64.0 / slices * 2);
    }
}

TEST(BokehVolume, HoldsTheDiscsOfBladesTurnedInFrontOfFocus) {
    LensChoice choice;
    choice.aperture.blades = 5;
    choice.aperture.rotation_deg = 90;
    const Lens lens = Lens::open(choice).value();
    const LensMount mount{.camera = own_camera(lens).value()};
    const auto volume = bokeh_volume(lens, mount, {.slices = 8, .side_px = 64}).value();
    ASSERT_EQ(volume.slices.size(), 8u);
    for (std::size_t i = 0; i < 8; ++i) {
        const Picture& slice = volume.slices[i];
        EXPECT_EQ(slice.width(), 65);
        double light = 0;
        for (std::size_t k = 0; k < slice.size(); ++k) light += double(slice.pixels()[k].g);
        EXPECT_NEAR(light, 1, 1e-3) << i;
        // In front of focus the pentagon is that behind it, turned by 180 degrees.
        const Picture& twin = volume.slices[7 - i];
        EXPECT_DOUBLE_EQ(volume.coc_radius_px[7 - i], -volume.coc_radius_px[i]);
        double difference = 0, upright = 0;
        for (int y = 0; y < 65; ++y)
            for (int x = 0; x < 65; ++x) {
                difference += double(std::abs(slice(x, y).g - twin(64 - x, 64 - y).g));
                upright += double(std::abs(slice(x, y).g - twin(x, y).g));
            }
        EXPECT_LT(difference, 0.01) << i;
        EXPECT_GT(upright, 0.1) << i;
    }
    EXPECT_FALSE(bokeh_volume(lens, mount, {.slices = 1}));
    EXPECT_FALSE(bokeh_volume(lens, mount, {.side_px = 9000}));
    EXPECT_FALSE(bokeh_volume(lens, mount, {.largest_coc_px = -1}));
}

}  // namespace
}  // namespace petzval
