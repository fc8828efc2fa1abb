// More layers of one picture, drawn by one plan: what sums before the blur sums after it.
#include "petzval/session.h"

#include "shots.h"

namespace petzval::conformance {
namespace {

// Two lights that sum to a picture: a share of it by channel that changes from pixel to pixel and from
// surface to surface.
struct Lights {
    Picture key, fill;
    explicit Lights(const Shot& shot)
        : key(shot.colour.width(), shot.colour.height()), fill(key.width(), key.height()) {
        for (int y = 0; y < key.height(); ++y)
            for (int x = 0; x < key.width(); ++x) {
                const float s = shot.coc_px(x, y) < 0 ? 0.8f : 0.5f + 0.4f * std::sin(float(x + 2 * y) / 9);
                const Rgba c = shot.colour(x, y);
                key(x, y) = {s * c.r, 0.5f * s * c.g, c.b, c.a};
                fill(x, y) = c - key(x, y), fill(x, y).a = c.a;
            }
    }
};

double largest_difference(const Picture& sum, const Picture& a, const Picture& b) {
    double largest = 0;
    for (std::size_t i = 0; i < sum.size(); ++i) {
        const Rgba s = sum.pixels()[i], t = a.pixels()[i] + b.pixels()[i];
        for (const auto& [of, to] : {std::pair{t.r, s.r}, {t.g, s.g}, {t.b, s.b}})
            largest = std::max(largest, std::abs(double(of) - double(to)) / std::max(1.0, double(to)));
    }
    return largest;
}

bool same(const Picture& a, const Picture& b) {
    return a.size() == b.size() && std::equal(a.pixels(), a.pixels() + a.size(), b.pixels());
}

DefocusJob with_lights(DefocusJob job, const Lights& lights) {
    job.layers = {{lights.key}, {lights.fill}};
    return job;
}

TEST(ColourLayers, ThatSumToThePictureDoSoWhenBlurred) {
    const Shot shot = noise_at_several_depths();
    const Lights lights(shot);
    for (const char* lens : {"ideal", "doublet"})
        for (const Quality quality : {Quality::Draft, Quality::Standard}) {
            DefocusJob job = with_lights(shot.job("scatter"), lights);
            job.lens.name = lens, job.quality = quality;
            job.camera = {50, 36, 2, 3};
            const auto made = defocus(job);
            ASSERT_TRUE(made) << made.error().message;
            EXPECT_LT(largest_difference(made->image, made->layers[0], made->layers[1]), 1e-4) << lens;
            job.layers.clear();
            EXPECT_TRUE(same(made->image, rendered(job)));  // the picture knows nothing of its layers
        }
}

TEST(ColourLayers, SumToThePictureAlsoWhereTheLensDistorts) {
    Shot shot = noise_at_several_depths();
    shot.colour(40, 31) = shot.colour(41, 31) = {900, 700, 500, 1};  // in focus: cubic lines would ring
    for (std::size_t i = 0; i < shot.coc_px.size(); ++i) shot.coc_px.pixels()[i] *= 0.2f;
    const Lights lights(shot);
    for (const double amount : {0.2, -0.2}) {
        DefocusJob job = with_lights(shot.job("scatter"), lights);
        job.lens.distortion = amount, job.camera = {50, 36, 2, 3};
        const auto made = defocus(job);
        ASSERT_TRUE(made) << made.error().message;
        EXPECT_LT(largest_difference(made->image, made->layers[0], made->layers[1]), 1e-4) << amount;
    }
}

TEST(ColourLayers, SumToThePictureInEnginesThatRunThemOneByOne) {
    Shot shot = noise_at_several_depths();
    for (const int x : {30, 80, 110})
        shot.colour(x, 40) = {60, 50, 40, 1};  // points that gather draws as such
    const Lights lights(shot);
    for (const char* engine : {"gather", "gaussian"})
        for (const double distortion : {0.0, 0.1}) {
            DefocusJob job = with_lights(shot.job(engine), lights);
            job.lens.distortion = distortion, job.camera = {50, 36, 2, 3};
            const auto made = defocus(job);
            ASSERT_TRUE(made) << made.error().message;
            EXPECT_LT(largest_difference(made->image, made->layers[0], made->layers[1]), 1e-4) << engine;
            EXPECT_EQ(made->layers[0](20, 20).a, made->image(20, 20).a);
        }
}

TEST(ColourLayers, ThatAreThePictureAreItsBlurBitForBit) {
    const Shot shot = tall_with_screens();
    DefocusJob job = shot.job("scatter");
    job.layers = {{shot.colour}};
    job.max_memory_bytes = std::size_t(106) << 20;
    const auto made = defocus(job);
    ASSERT_TRUE(made) << made.error().message;
    EXPECT_TRUE(same(made->image, made->layers[0]));
}

TEST(ColourLayers, AMatteOfAllIsTheAlpha) {
    Shot shot = noise_at_several_depths();
    for (int y = 30; y < 60; ++y)
        for (int x = 100; x < 130; ++x) shot.colour(x, y) = {};
    const Picture ones(shot.colour.width(), shot.colour.height(), {1, 1, 1, 1});
    Picture alpha(ones.width(), ones.height());
    for (std::size_t i = 0; i < alpha.size(); ++i) {
        const float a = shot.colour.pixels()[i].a;
        alpha.pixels()[i] = {a, a, a, a};
    }
    DefocusJob job = shot.job("scatter");
    job.layers = {{alpha, false}};
    const auto made = defocus(job);
    ASSERT_TRUE(made) << made.error().message;
    double largest = 0;
    for (std::size_t i = 0; i < alpha.size(); ++i)
        largest = std::max(
            largest, std::abs(double(made->layers[0].pixels()[i].g) - double(made->image.pixels()[i].a)));
    EXPECT_LT(largest, 2e-5);
}

// Mattes of object ids are not filtered as the colour is.
TEST(ColourLayers, MattesStayWithinTheirRangeAndSumToOneWithTheirComplements) {
    const Shot shot = noise_at_several_depths();
    Picture matte(shot.colour.width(), shot.colour.height()), rest(matte.width(), matte.height());
    for (std::size_t i = 0; i < matte.size(); ++i) {
        const float in = shot.coc_px.pixels()[i] < 0 ? 1.0f : 0.0f, out = 1 - in;
        matte.pixels()[i] = {in, in, in, 1}, rest.pixels()[i] = {out, out, out, 1};
    }
    for (const char* engine : {"scatter", "gather", "gaussian"}) {
        DefocusJob job = shot.job(engine);
        job.layers = {{matte, false}, {rest, false}};
        const auto made = defocus(job);
        ASSERT_TRUE(made) << made.error().message;
        for (std::size_t i = 0; i < matte.size(); ++i) {
            const float of_matte = made->layers[0].pixels()[i].g, of_rest = made->layers[1].pixels()[i].g;
            ASSERT_GE(of_matte, 0) << engine;
            ASSERT_LE(of_matte, 1) << engine;
            if (job.engine == "scatter") ASSERT_NEAR(of_matte + of_rest, 1, 2e-3) << i;
        }
    }
}

TEST(ColourLayers, InFocusAreAsTheyWere) {
    Shot shot = noise_at_several_depths();
    for (std::size_t i = 0; i < shot.coc_px.size(); ++i) shot.coc_px.pixels()[i] = 0;
    const Lights lights(shot);
    const auto made = defocus(with_lights(shot.job("scatter"), lights));
    ASSERT_TRUE(made) << made.error().message;
    EXPECT_LT(
        largest_difference(lights.key, made->layers[0], Picture(shot.colour.width(), shot.colour.height())),
        1e-5);
}

TEST(ColourLayers, KeepTheirLight) {
    const Shot shot = noise_at_several_depths();
    const Lights lights(shot);
    const auto made = defocus(with_lights(shot.job("scatter"), lights));
    ASSERT_TRUE(made);
    double before = 0, after = 0;
    for (std::size_t i = 0; i < lights.key.size(); ++i)
        before += double(lights.key.pixels()[i].g), after += double(made->layers[0].pixels()[i].g);
    EXPECT_NEAR(after / before, 1, 0.05);  // the frame's edge and what edges hide are guesses
}

TEST(ColourLayers, AreCroppedAndFinishedWithThePicture) {
    const Shot shot = noise_at_several_depths();
    const Lights lights(shot);
    const Rect window{13, 9, 141, 122};
    DefocusJob job = with_lights(shot.job("scatter"), lights);
    job.colour = job.colour.part(window), job.coc_px = job.coc_px.part(window);
    for (ColourLayer& layer : job.layers) layer.colour = layer.colour.part(window);
    job.place.data_window = window;
    job.camera = {50, 36, 2, 3};
    Look look;
    look.vignetting = true;
    Session session;
    const auto made = session.take(job, look, {.region = Rect{20, 20, 90, 80}});
    ASSERT_TRUE(made) << made.error().message;
    EXPECT_EQ(made->image.width(), 70);
    EXPECT_LT(largest_difference(made->image, made->layers[0], made->layers[1]), 1e-4);
    const auto all = session.take(job, look);
    ASSERT_TRUE(all);
    EXPECT_EQ(all->layers[0](7 + 5, 11 + 5), made->layers[0](5, 5));
}

// Sodium lamps among daylight: their layer is what the lens makes of sodium, the other stays, and the picture
// is their sum still.
TEST(ColourLayers, ThatNameALampAreItsLightInThePictureToo) {
    const Shot shot = noise_at_several_depths();
    const Lights lights(shot);
    for (const char* engine : {"scatter", "gather"}) {
        DefocusJob job = with_lights(shot.job(engine), lights);
        job.lens.name = "uncorrected", job.camera = {50, 36, 2, 3};
        const auto daylight = defocus(job);
        job.layers[0].spectrum = LightSpectrum::Sodium;
        const auto made = defocus(job);
        ASSERT_TRUE(daylight && made) << (made ? "" : made.error().message);
        job.lens.light = LightSpectrum::Sodium;
        const auto sodium = defocus(job);  // which its first layer then is anyhow
        ASSERT_TRUE(sodium);
        EXPECT_TRUE(same(made->layers[0], sodium->layers[0])) << engine;
        EXPECT_TRUE(same(made->layers[1], daylight->layers[1])) << engine;
        EXPECT_FALSE(same(made->layers[0], daylight->layers[0])) << engine;
        EXPECT_LT(largest_difference(made->image, made->layers[0], made->layers[1]), 2e-4) << engine;
    }
}

TEST(ColourLayers, NameLampsOfLightAloneAndWhereThatShows) {
    const Shot shot = noise_at_several_depths();
    const Lights lights(shot);
    DefocusJob job = with_lights(shot.job("scatter"), lights);
    job.layers[0].spectrum = LightSpectrum::Neon;
    Session session;
    const auto ideal = session.take(job, Look{});
    ASSERT_FALSE(ideal);
    EXPECT_NE(ideal.error().message.find("lens.light"), std::string::npos) << ideal.error().message;
    job.lens.name = "doublet", job.camera = {50, 36, 2, 3};
    job.engine = "gaussian";
    EXPECT_FALSE(defocus(job));
    job.engine = "scatter", job.layers[0].is_light = false;
    EXPECT_FALSE(defocus(job));
}

TEST(ColourLayers, OfOtherEnginesOrSizesAreRefused) {
    const Shot shot = flat(30, 20, {1, 1, 1, 1}, 3);
    DefocusJob job = shot.job("reference");
    job.layers = {{shot.colour}};
    EXPECT_FALSE(defocus(job));
    const Picture small(10, 10);
    job = shot.job("scatter");
    job.layers = {{small}};
    EXPECT_FALSE(defocus(job));
}

}  // namespace
}  // namespace petzval::conformance
