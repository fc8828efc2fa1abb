// The discs as the talk describes them (M. Kawase, CEDEC 2008), each sentence a test on the radial profile.
#include "kernel/lenses/aberration_curves.h"
#include "kernel/lenses/kernel_testing.h"

#include <gtest/gtest.h>

namespace petzval::kernel {
namespace {

struct Disc {
    std::vector<Rgba> profile;  // 1: as bright as the flat disc
    float core = 0, half_way = 0;
    float ring = 0;      // brightest of the outer half
    Rgba outer_rim;      // sum of what lies outside of where luminance last exceeds 0.6
    double edge_px = 0;  // from the last 0.75 to the last 0.1 of luminance

    Disc(const std::string& name, double coc_radius_px, double f_number = 2.8, double colour = 1,
         double added_colour_mm = 0) {
        LensChoice choice;
        choice.name = name, choice.axial_colour = colour, choice.added.axial_colour_mm = added_colour_mm;
        const auto lens = lens_of(choice, full_frame(f_number));
        profile = radial_profile(lens->point_spread(coc_radius_px, {}), std::abs(coc_radius_px));
        core = profile[0].a, half_way = profile[profile.size() / 2].a;
        std::size_t body = 0, last_bright = 0, last_seen = 0;
        for (std::size_t i = 0; i < profile.size(); ++i) {
            if (i > profile.size() / 2) ring = std::max(ring, profile[i].a);
            if (profile[i].a > 0.6f) body = i;
            if (profile[i].a > 0.75f) last_bright = i;
            if (profile[i].a > 0.1f) last_seen = i;
        }
        for (std::size_t i = body + 1; i < profile.size(); ++i) outer_rim += profile[i];
        edge_px = double(last_seen - last_bright);
    }
};

bool reddish(Rgba c) { return c.r > 1.2f * c.g && c.r > 1.2f * c.b; }
bool bluish(Rgba c) { return c.b > 1.2f * c.g && c.b > 1.2f * c.r; }
bool purple(Rgba c) { return c.r > 1.5f * c.g && c.b > 1.5f * c.g; }
bool green_yellow(Rgba c) { return c.g > 1.05f * c.r && c.g > 1.5f * c.b; }

TEST(DiscCharacter, IdealIsFlat) {
    for (const double radius : {-25.0, 25.0}) {
        const Disc disc("ideal", radius);
        for (std::size_t i = 0; i + 2 < disc.profile.size(); ++i) EXPECT_NEAR(disc.profile[i].a, 1, 1e-3);
    }
}

TEST(DiscCharacter, UncorrectedNearIsABrightRingWithASharpRedRim) {
    const Disc disc("uncorrected", -30);
    EXPECT_GT(disc.ring, 1.3f * disc.core);
    EXPECT_TRUE(reddish(disc.outer_rim));
    EXPECT_LE(disc.edge_px, 3);
}

TEST(DiscCharacter, UncorrectedFarIsABrightCoreWithASoftBlueVioletRim) {
    const Disc disc("uncorrected", 30);
    EXPECT_GT(disc.core, 1.2f);
    EXPECT_GT(disc.core, 1.15f * disc.half_way);
    EXPECT_TRUE(bluish(disc.outer_rim));
    EXPECT_GE(disc.edge_px, 4);
    EXPECT_GT(disc.edge_px, Disc("uncorrected", -30).edge_px);
}

TEST(DiscCharacter, UncorrectedIsNeverQuiteSharp) {
    const auto lens = lens_named("uncorrected", 2.8);
    for (double coc = -8; coc <= 8; coc += 0.5)
        EXPECT_LT(brightest(lens->point_spread(coc, {})), 0.45) << coc;
}

TEST(DiscCharacter, UncorrectedColourTurnsPurpleAtFocus) {
    // Red and violet are both out of focus where green is in it.
    const PointSpread s = lens_named("asphere", 2.8)->point_spread(0, {});
    Rgba halo;
    for (int y = s.extent.y0; y < s.extent.y1; ++y)
        for (int x = s.extent.x0; x < s.extent.x1; ++x)
            if (x * x + y * y > 4) halo += weight_at(s, x, y);
    EXPECT_TRUE(purple(halo)) << halo.r << " " << halo.g << " " << halo.b;
}

TEST(DiscCharacter, BlueAndVioletFringesKeepTheirLight) {
    struct Case {
        const char* lens;
        double coc_px;
    };
    for (const auto& [name, coc] : {Case{"uncorrected", 30},
                                    {"uncorrected", 12},
                                    {"asphere", 28},
                                    {"asphere", 0},
                                    {"doublet", -30},
                                    {"doublet-ccd", 0},
                                    {"takumar", 12},
                                    {"asphere-singlet", 12}}) {
        const auto lens = lens_named(name);
        const PointSpread raw = lens->raw_point_spread(coc, {}), shown = lens->point_spread(coc, {});
        double of_raw = 0, of_shown = 0;
        for (int y = raw.extent.y0; y < raw.extent.y1; ++y)
            for (int x = raw.extent.x0; x < raw.extent.x1; ++x) {
                const Rgba w = weight_at(raw, x, y);
                if (w.b < 2 * std::max(w.r, w.g)) continue;
                of_raw += double(w.b), of_shown += double(weight_at(shown, x, y).b);
            }
        EXPECT_NEAR(of_shown, of_raw, 0.03 * of_raw) << name << " " << coc;
    }
}

TEST(DiscCharacter, DoubletNearHasASoftRedToVioletRimAndADarkerCentre) {
    const Disc disc("doublet", -24);
    EXPECT_LT(disc.core, 0.85f);
    EXPECT_GT(disc.half_way, disc.core);
    EXPECT_TRUE(purple(disc.outer_rim))
        << disc.outer_rim.r << " " << disc.outer_rim.g << " " << disc.outer_rim.b;
}

TEST(DiscCharacter, WithBlueALittleNearerTheDoubletsRimInFrontGoesFromPurpleToRed) {
    const Disc disc("doublet", -60, 2, 1, -0.08);
    const auto edge =
        std::find_if(disc.profile.begin() + 50, disc.profile.end(), [](Rgba c) { return c.g < 0.1f * c.r; });
    ASSERT_LT(edge + 3, disc.profile.end());
    EXPECT_TRUE(purple(edge[0])) << edge[0].r << " " << edge[0].g << " " << edge[0].b;
    EXPECT_GT(edge[1].r, 1.3f * edge[1].b);
    EXPECT_GT(edge[2].r, 2 * edge[2].b) << "and soft, further out";
    EXPECT_GT(edge[2].r, 0.03f);
}

TEST(DiscCharacter, DoubletFarHasASharpGreenYellowRimAndABrightCore) {
    const Disc disc("doublet", 24);
    EXPECT_GT(disc.core, 1.15f);
    EXPECT_TRUE(green_yellow(disc.outer_rim))
        << disc.outer_rim.r << " " << disc.outer_rim.g << " " << disc.outer_rim.b;
    EXPECT_LE(disc.edge_px, 2);
    // Wide open the rim is a bright line.
    EXPECT_GT(Disc("doublet", 30, 2).ring, 1.3f);
}

TEST(DiscCharacter, DoubletWideOpenIsADoughnutSlightlyInFrontAndAnOutlineWithAPeakSlightlyBehind) {
    const Disc front("doublet", -10, 2.8), behind("doublet", 12, 2);
    EXPECT_GT(front.ring, 1.5f * front.core);
    EXPECT_GT(behind.core, 1.5f * behind.half_way);
    EXPECT_GT(behind.ring, 1.2f * behind.half_way);
}

TEST(DiscCharacter, OvercorrectedIsSoftInFrontAndSharpBehind) {
    const Disc near("doublet-overcorrected", -28, 2), far("doublet-overcorrected", 28, 2);
    EXPECT_GT(near.core, 1.5f * near.half_way);
    EXPECT_GT(near.edge_px, 3 + far.edge_px);
    EXPECT_GT(far.ring, 1.5f * far.core);
    EXPECT_LT(brightest(lens_named("doublet-overcorrected", 2)->point_spread(0, {})), 0.35);  // soft focus
}

TEST(DiscCharacter, DoubletCcdIsTheDoubletWithMoreColour) {
    const auto colour = [](const std::string& name, double coc) {
        float most = 0;
        for (const Rgba& c : Disc(name, coc).profile) most += std::abs(c.g - 0.5f * (c.r + c.b));
        return most;
    };
    EXPECT_GT(colour("doublet-ccd", 24), 1.4f * colour("doublet", 24));
    EXPECT_GT(colour("doublet-ccd", -24), 1.4f * colour("doublet", -24));
    EXPECT_TRUE(green_yellow(Disc("doublet-ccd", 24).outer_rim));
}

TEST(DiscCharacter, TripletIsNearlyFlat) {
    for (const double radius : {-28.0, 28.0}) {
        const Disc disc("triplet", radius), doublet("doublet", radius);
        for (std::size_t i = 0; i < std::size_t(0.9 * 28); ++i) EXPECT_NEAR(disc.profile[i].a, 1, 0.12) << i;
        EXPECT_LT(std::abs(disc.core - 1), std::abs(doublet.core - 1));
    }
}

TEST(DiscCharacter, AsphereIsFlatWithARedRimInFrontAndABlueOneBehind) {
    for (const double radius : {-28.0, 28.0}) {
        const Disc disc("asphere", radius);
        EXPECT_TRUE(radius < 0 ? reddish(disc.outer_rim) : bluish(disc.outer_rim));
        for (std::size_t i = 0; i < 18; ++i) EXPECT_NEAR(disc.profile[i].a, disc.core, 0.01f);
        // Every wavelength by itself is sharp: without colour it is the ideal disc.
        EXPECT_NEAR(Disc("asphere", radius, 2.8, 0).half_way, 1, 1e-3);
    }
}

TEST(DiscCharacter, ApochromatIsNearlyNeutralAndADiffractiveElementReversesTheDoubletsRims) {
    const auto colour = [](const std::string& name) {
        float sum = 0;
        for (const Rgba& c : Disc(name, 24).profile) sum += std::abs(c.r - c.g) + std::abs(c.b - c.g);
        return sum;
    };
    EXPECT_LT(colour("apochromat"), 0.35f * colour("doublet"));
    EXPECT_TRUE(green_yellow(Disc("diffractive", -24).outer_rim));
    EXPECT_TRUE(purple(Disc("diffractive", 24).outer_rim));
}

// A thin bright line blurred by the kernel: sums over columns, and how many maxima they have.
int lines_seen(const std::string& name, double coc_radius_px, double f_number) {
    LensChoice choice;
    choice.name = name;
    const PointSpread s = lens_of(choice, full_frame(f_number))->point_spread(coc_radius_px, {});
    std::vector<float> line(std::size_t(s.weights.width()), 0);
    for (int y = 0; y < s.weights.height(); ++y)
        for (int x = 0; x < s.weights.width(); ++x) line[std::size_t(x)] += s.weights(x, y).a;
    const float least = 0.02f * *std::max_element(line.begin(), line.end());
    int maxima = 0;
    float low = 0, high = 0;
    bool rises = true;
    for (const float v : line) {
        if (rises && v > high) high = v;
        if (rises && v < high - least) ++maxima, rises = false, low = v;
        if (!rises && v < low) low = v;
        if (!rises && v > low + least) rises = true, high = v;
    }
    return maxima;
}

TEST(DiscCharacter, AThinLineBehindFocusSplitsInTwoAndInThreeWhereTheCoreIsStrong) {
    EXPECT_EQ(lines_seen("ideal", 20, 2), 1);
    EXPECT_EQ(lines_seen("doublet-overcorrected", 20, 2), 2);
    EXPECT_EQ(lines_seen("doublet", 20, 2), 3);
    EXPECT_EQ(lines_seen("doublet-overcorrected", -20, 2), 1);
}

TEST(DiscCharacter, TheUncorrectedLensSplitsALineInFront) {
    EXPECT_EQ(lines_seen("uncorrected", -20, 2), 2);
    EXPECT_EQ(lines_seen("uncorrected", 20, 2), 1);
}

// The talk: corrected for a small stop a doublet keeps its character; stopped down it loses it.
TEST(DiscCharacter, ADoubletCorrectedForF4IsAFlatterDoublet) {
    // Landing of the rim, measured from the sensor's position for this colour.
    const auto rim = [](const char* name, double f_number) {
        const CurveSampler sampler(*curve_preset(name), {.f_number = f_number, .axial_colour = 0});
        return sampler.at(587.56).samples().back() - sampler.best_focus();
    };
    EXPECT_GT(rim("doublet", 2), 0) << "beyond the sensor: far discs have the sharp rim";
    EXPECT_NEAR(rim("doublet-f4", 4), rim("doublet", 2) / 16, 0.05 * rim("doublet", 2) / 16);
    EXPECT_LT(rim("doublet", 4), 0) << "stopped down the zone towards the lens is the rim";
}

}  // namespace
}  // namespace petzval::kernel
