// Steps after the blur, on pictures stored bottom row first.
#include "bottom_up.h"

#include "petzval/develop.h"
#include "petzval/glare.h"

#include "shots.h"

namespace petzval::conformance {
namespace {

TEST(BottomUp, GlareFalloffAndDevelopGiveTheSameBits) {
    Shot shot = flat(96, 64, {0.2f, 0.3f, 0.1f, 1}, 0);
    paint_noise(shot.colour, 3);
    shot.colour(30, 20) = {500, 400, 300, 1};
    const BottomUp<Rgba> flipped(shot.colour);
    const Camera camera{.focal_length_mm = 50, .sensor_width_mm = 36, .f_number = 2, .focus_distance_m = 3};
    GlareSettings glare;
    glare.bloom = glare.star = glare.ghosts = glare.veil = 0.1;
    glare.lens.aperture.blades = 6, glare.camera = camera;
    EXPECT_EQ(largest_difference(*add_glare(shot.colour, glare), *add_glare(flipped.view(), glare)), 0);
    EXPECT_EQ(largest_difference(*add_glare(shot.colour, {}), *add_glare(flipped.view(), {})), 0);
    const FalloffSettings falloff{.camera = camera};
    EXPECT_EQ(largest_difference(*add_falloff(shot.colour, falloff), *add_falloff(flipped.view(), falloff)),
              0);
    EXPECT_EQ(develop(shot.colour), develop(flipped.view()));
    const auto shown = add_falloff(shot.colour, falloff);
    EXPECT_EQ(compare(shot.colour, *shown)->ssim_lin, compare(flipped.view(), *shown)->ssim_lin);
}

}  // namespace
}  // namespace petzval::conformance
