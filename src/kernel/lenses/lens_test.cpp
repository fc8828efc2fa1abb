#include "petzval/lens.h"

#include "base/temporary_folder.h"
#include "kernel/lenses/kernel_testing.h"
#include "kernel/lenses/opened_lens.h"
#include "lens_files/shelf.h"

#include <filesystem>
#include <fstream>
#include <set>
#include <sys/stat.h>

#include <gtest/gtest.h>

namespace petzval::kernel {
namespace {

namespace fs = std::filesystem;

LensChoice named(const std::string& name) {
    LensChoice choice;
    choice.name = name;
    return choice;
}

Lens opened(const LensChoice& choice) { return Lens::open(choice).value(); }

class LensFileTest : public testing::Test {
protected:
    void write(std::string_view text) const { std::ofstream(path_) << text; }
    static std::string_view shelf_text(const std::string& name) {
        for (const lens_files::ShelfItem& item : lens_files::shelf())
            if (item.name == name) return item.text;
        return {};
    }
    const test::TemporaryFolder folder_;
    const std::string path_ = folder_ / "lens.json";
};

TEST_F(LensFileTest, OnceOpenedALensNeedsItsFileNoMore) {
    write(shelf_text("tessar"));
    const Lens lens = opened(named(path_));
    const PointSpread before = (*make_lens(lens, full_frame(4)))->point_spread(9, {0.3, 0.2});
    fs::remove(path_);
    EXPECT_EQ(largest_difference((*make_lens(lens, full_frame(4)))->point_spread(9, {0.3, 0.2}), before), 0);
    EXPECT_EQ((*make_lens_levels(lens, full_frame(4), 3)).size(), 3u);
    LensChoice blades = lens.choice();
    blades.aperture.blades = 5;
    const auto again = lens.with(blades);
    ASSERT_TRUE(again.has_value()) << again.error().message;
    EXPECT_NE(again->key(), lens.key());
    EXPECT_TRUE(make_lens(*again, full_frame(4)).has_value());
    EXPECT_FALSE(Lens::open(lens.choice()));
}

TEST_F(LensFileTest, TheKeyOfAFileIsOfItsContent) {
    write(shelf_text("tessar"));
    const std::string one = opened(named(path_)).key();
    EXPECT_EQ(opened(named(path_)).key(), one);
    write(shelf_text("takumar"));
    EXPECT_NE(opened(named(path_)).key(), one);
}

TEST_F(LensFileTest, APipeIsRefusedWithoutWaitingForIt) {
    ASSERT_EQ(mkfifo(path_.c_str(), 0600), 0);
    const auto lens = Lens::open(named(path_));
    ASSERT_FALSE(lens);
    EXPECT_EQ(lens.error().code, ErrorCode::InvalidFile);
    EXPECT_NE(lens.error().message.find("regular file"), std::string::npos) << lens.error().message;
    EXPECT_FALSE(Lens::open(named("/dev/zero")));
}

TEST(Lens, AnUnknownNameIsAnsweredWithThoseNearIt) {
    const auto lens = Lens::open(named("tessart"));
    ASSERT_FALSE(lens);
    EXPECT_EQ(lens.error().code, ErrorCode::InvalidArgument);
    EXPECT_NE(lens.error().message.find("tessar,"), std::string::npos) << lens.error().message;
}

TEST(Lens, KindsAreTold) {
    EXPECT_EQ(opened(named("ideal")).kind(), LensModelKind::Ideal);
    EXPECT_EQ(opened(named("doublet")).kind(), LensModelKind::Curves);
    EXPECT_EQ(opened(named("tessar")).kind(), LensModelKind::Prescription);
    EXPECT_TRUE(opened(named("doublet")).is_drawn());
    EXPECT_EQ(prescription_of(opened(named("doublet"))), nullptr);
    EXPECT_EQ(curves_of(opened(named("tessar"))), nullptr);
}

TEST(Lens, WhatDoesNotDependOnTheFocusMakesTheSameKernelsAtAnyFocus) {
    for (const char* name : {"ideal", "doublet", "asphere", "tessar", "petzval-portrait"}) {
        const Lens lens = opened(named(name));
        Mount near = full_frame(4), far = near;
        near.camera.focus_distance_m = 1, far.camera.focus_distance_m = 30;
        const PointSpread a = (*make_lens(lens, near))->point_spread(12, {0.4, 0.3});
        const PointSpread b = (*make_lens(lens, far))->point_spread(12, {0.4, 0.3});
        const bool same = a.extent == b.extent && largest_difference(a, b) == 0;
        EXPECT_EQ(same, !lens.depends_on_focus()) << name;
        EXPECT_EQ(lens_key(lens, near) == lens_key(lens, far), !lens.depends_on_focus()) << name;
    }
}

using Change = void (*)(LensChoice&, Mount&);
constexpr Change kChanges[] = {
    [](LensChoice& c, Mount&) { c.name = "triplet"; },
    [](LensChoice& c, Mount&) { c.aperture.blades = 5; },
    [](LensChoice& c, Mount&) { c.aperture.rotation_deg = 5; },
    [](LensChoice& c, Mount&) { c.aperture.curvature = 0.5; },
    [](LensChoice& c, Mount&) { c.aperture.squeeze = 2; },
    [](LensChoice& c, Mount&) { c.aperture.round_at_f_number = 2; },
    [](LensChoice& c, Mount&) { c.cats_eye = 0.5; },
    [](LensChoice& c, Mount&) {
        c.barrel = {{10, 5}};
    },
    [](LensChoice& c, Mount&) {
        c.barrel = {{10, 6}};
    },
    [](LensChoice& c, Mount&) { c.barn_doors.left = 0.2; },
    [](LensChoice& c, Mount&) { c.barn_doors.right = 0.2; },
    [](LensChoice& c, Mount&) { c.barn_doors.top = 0.2; },
    [](LensChoice& c, Mount&) { c.barn_doors.bottom = 0.2; },
    [](LensChoice& c, Mount&) { c.texture.dust = 0.2; },
    [](LensChoice& c, Mount&) { c.texture.scratches = 0.2; },
    [](LensChoice& c, Mount&) { c.texture.onion_rings = 0.2; },
    [](LensChoice& c, Mount&) { c.texture.seed = 2; },
    [](LensChoice& c, Mount&) { c.texture.image = std::make_shared<Plane>(2, 2, 0.5f); },
    [](LensChoice& c, Mount&) { c.texture.image = std::make_shared<Plane>(2, 2, 0.6f); },
    [](LensChoice& c, Mount&) {
        c.kernel_images.far = std::make_shared<Picture>(2, 2, Rgba{1, 1, 1, 1});
    },
    [](LensChoice& c, Mount&) {
        c.kernel_images.far = std::make_shared<Picture>(2, 2, Rgba{1, 1, 0.5f, 1});
    },
    [](LensChoice& c, Mount&) { c.focus_mode = FocusMode::Paraxial; },
    [](LensChoice& c, Mount&) { c.focus_shift_mm = 0.1; },
    [](LensChoice& c, Mount&) { c.spherical = 0; },
    [](LensChoice& c, Mount&) { c.axial_colour = 0; },
    [](LensChoice& c, Mount&) { c.name = "tessar", c.lateral_colour = 0; },
    [](LensChoice& c, Mount&) { c.added.spherical_waves = 1; },
    [](LensChoice& c, Mount&) { c.added.spherical_waves = 1, c.added.at_f_number = 3; },
    [](LensChoice& c, Mount&) { c.added.axial_colour_mm = 0.1; },
    [](LensChoice& c, Mount&) { c.added.field_curvature_mm = 0.1; },
    [](LensChoice& c, Mount&) { c.added.lateral_colour_percent = 0.1; },
    [](LensChoice& c, Mount&) { c.coma = 0.1; },
    [](LensChoice& c, Mount&) { c.astigmatism = 0.1; },
    [](LensChoice& c, Mount&) { c.distortion = 0.1; },
    [](LensChoice& c, Mount&) { c.wavelengths = 40; },
    [](LensChoice& c, Mount&) { c.light = LightSpectrum::Neon; },
    [](LensChoice& c, Mount&) { c.wave = true; },
    [](LensChoice&, Mount& m) { m.camera.focal_length_mm = 51; },
    [](LensChoice&, Mount& m) { m.camera.sensor_width_mm = 35; },
    [](LensChoice&, Mount& m) { m.camera.f_number = 2.1; },
    [](LensChoice& c, Mount&) { c.name = "tessar"; },
    [](LensChoice& c, Mount& m) { c.name = "tessar", m.camera.focus_distance_m = 3; },
    [](LensChoice&, Mount& m) { m.display_width_px = 1921; },
    [](LensChoice&, Mount& m) { m.display_height_px = 1081; },
    [](LensChoice&, Mount& m) { m.pixel_aspect = 2; },
    [](LensChoice& c, Mount&) { c.name = "ideal"; },
    [](LensChoice& c, Mount& m) { c.name = "ideal", m.pixel_aspect = 2; },
    [](LensChoice& c, Mount&) {
        c.name = "ideal", c.barrel = {{10, 5}};
    },
    [](LensChoice& c, Mount& m) {
        c.name = "ideal", c.barrel = {{10, 5}}, m.camera.f_number = 2.1;
    },
    [](LensChoice& c, Mount&) { c.name = "ideal", c.coma = 1; },
    [](LensChoice& c, Mount&) { c.name = "ideal", c.added.spherical_waves = 1; },
    [](LensChoice& c, Mount& m) {
        c.name = "ideal", c.added.spherical_waves = 1, m.camera.focal_length_mm = 51;
    },
    [](LensChoice& c, Mount& m) { c.name = "ideal", c.coma = 1, m.camera.focal_length_mm = 51; },
};

TEST(LensKey, EverythingThatChangesKernelsChangesTheKey) {
    const Mount mount = full_frame();
    const LensChoice plain = named("doublet");
    const auto key = [](const LensChoice& choice, const Mount& m) { return lens_key(opened(choice), m); };
    std::set<std::string> keys{key(plain, mount)};
    EXPECT_EQ(keys.begin()->size(), 32u);
    EXPECT_TRUE(keys.contains(key(plain, mount))) << "the same lens, the same key";
    for (std::size_t i = 0; i < std::size(kChanges); ++i) {
        LensChoice choice = plain;
        Mount changed = mount;
        kChanges[i](choice, changed);
        EXPECT_TRUE(keys.insert(key(choice, changed)).second) << "change " << i;
    }
}

TEST(LensKey, AFlatDiscIsTheSameOnEveryCamera) {
    const Mount one = full_frame(2);
    Mount other = full_frame(4, 960);
    other.camera.focal_length_mm = 85, other.camera.focus_distance_m = 9;
    LensChoice bladed = named("ideal");
    bladed.aperture.blades = 6, bladed.cats_eye = 0.4;
    for (const LensChoice& choice : {named("ideal"), bladed}) {
        const Lens lens = opened(choice);
        EXPECT_EQ(lens_key(lens, one), lens_key(lens, other));
        EXPECT_EQ(largest_difference((*make_lens(lens, one))->point_spread(7, {0.4, 0.1}),
                                     (*make_lens(lens, other))->point_spread(7, {0.4, 0.1})),
                  0);
    }
}

}  // namespace
}  // namespace petzval::kernel
