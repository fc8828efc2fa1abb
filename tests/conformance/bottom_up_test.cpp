// Half of all hosts hold the bottom row first: a view with a negative stride is as good as any.
#include "petzval/develop.h"
#include "petzval/glare.h"

#include "shots.h"

namespace petzval::conformance {
namespace {

// The rows of an image from the last to the first, and a view that turns them round again.
template <typename T>
class BottomUp {
public:
    explicit BottomUp(const Image<T>& image) : rows_(image.width(), image.height()) {
        for (int y = 0; y < image.height(); ++y)
            std::copy_n(image.row(y), image.width(), rows_.row(image.height() - 1 - y));
    }
    View<const T> view() const {
        return {rows_.row(rows_.height() - 1), rows_.width(), rows_.height(), -rows_.width()};
    }

private:
    Image<T> rows_;
};

TEST(BottomUp, EveryEngineGivesTheSameBits) {
    Shot shot = noise_at_several_depths();
    shot.colour(20, 20).g = std::numeric_limits<float>::quiet_NaN();  // and the repair of a broken pixel
    const BottomUp<Rgba> colour(shot.colour);
    const BottomUp<float> coc_px(shot.coc_px);
    for (const std::string& engine : engine_names()) {
        DefocusJob job = shot.job(engine);
        job.pupil_points = 64;
        const Picture top_down = rendered(job);
        job.colour = colour.view(), job.coc_px = coc_px.view();
        EXPECT_EQ(largest_difference(top_down, rendered(job)), 0) << engine;
    }
}

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
