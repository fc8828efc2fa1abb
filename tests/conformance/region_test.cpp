// A region of a frame is the crop of the whole, bit for bit, for every engine.
#include "petzval/look.h"

#include "drawers.h"

#include <functional>

namespace petzval::conformance {
namespace {

constexpr int kLargest = 9;

// Cards at many radii with lights among them.
Shot cards(int width, int height) {
    Shot shot = flat(width, height, {}, 3);
    paint_rectangles(shot.colour, 7);
    std::mt19937 random(9);
    const auto up_to = [&](int n) { return int(random() % unsigned(n)); };
    for (int i = 0; i < width * height / 3000; ++i) {
        const int x = up_to(width), y = up_to(height);
        const float coc = float(up_to(2 * kLargest + 1) - kLargest);
        shot.colour(x, y) = {60, 40, 20, 1};
        for (int v = y; v < std::min(height, y + 22); ++v)
            for (int u = x + 2; u < std::min(width, x + 15); ++u) shot.coc_px(u, v) = coc;
    }
    return shot;
}

struct Case {
    const char* name;
    std::function<void(DefocusJob&)> change;
};

std::vector<Case> cases() {
    return {{"plain", [](DefocusJob&) {}},
            {"cats_eye", [](DefocusJob& job) { job.lens.cats_eye = 0.7; }},
            {"barrel", [](DefocusJob& job) { job.lens.distortion = -0.1; }},
            {"doublet", [](DefocusJob& job) { job.lens.name = "doublet"; }},
            {"cropped", [](DefocusJob& job) {
                 const Rect data{5, 9, job.colour.width(), job.colour.height()};
                 job.colour = job.colour.part(data), job.coc_px = job.coc_px.part(data);
                 job.place.data_window = data;
             }}};
}

class Region : public EveryDrawer {};

int changed(const Picture& part, const Picture& whole, int x0, int y0) {
    int count = 0;
    for (int y = 0; y < part.height(); ++y)
        for (int x = 0; x < part.width(); ++x) count += part(x, y) != whole(x0 + x, y0 + y);
    return count;
}

TEST_P(Region, IsTheCropOfTheWhole) {
    const bool is_slow = traces() || drawer().device != "cpu";  // software drivers
    const Shot shot = is_slow ? cards(360, 310) : cards(700, 420);
    for (const Case& c : cases()) {
        DefocusJob job = drawer().job(shot);
        job.pupil_points = traces() ? 4 : 32, job.camera = {50, 36, 4, 2};
        c.change(job);
        Session session(drawer().session());
        const auto whole = session.defocus(job);
        ASSERT_TRUE(whole) << whole.error().message;
        for (const Rect& region : {Rect{300, 250, 360, 300}, Rect{-50, 300, 70, 1000}}) {
            const auto part = session.defocus(job, {.region = region});
            ASSERT_TRUE(part) << part.error().message;
            const Rect seen = region.intersected(job.place.data_window);
            ASSERT_EQ(part->image.width(), seen.width()) << c.name;
            ASSERT_EQ(part->image.height(), seen.height()) << c.name;
            EXPECT_EQ(changed(part->image, whole->image, seen.x0 - job.place.data_window.x0,
                              seen.y0 - job.place.data_window.y0),
                      0)
                << c.name << " at " << region.x0 << ", " << region.y0;
        }
    }
}

TEST_P(Region, SoItIsWithHiddenLayersAndAWholeLook) {
    Shot shot = cards(420, 300);
    shot.behind = DeepPicture::made_of(420, 300, [&](int x, int y, std::vector<DeepSample>& samples) {
        if (shot.coc_px(x, y) < 0) samples.push_back({{0.3f, 0.5f, float(x % 7) / 7, 1}, 6, 6});
    });
    DefocusJob job = drawer().job(shot);
    job.pupil_points = 32;
    Look look;
    look.engine = drawer().engine, look.pupil_points = 32, look.vignetting = true, look.lens.cats_eye = 0.4;
    job.camera = {50, 36, 2, 3};
    Session session(drawer().session());
    for (const double bloom : {0.0, 0.1}) {
        look.glare.bloom = bloom;
        const auto whole = session.take(job, look);
        for (const Rect& region : {Rect{90, 60, 130, 99}, Rect{380, 270, 410, 290}}) {
            const auto part = session.take(job, look, {.region = region});
            ASSERT_TRUE(whole && part);
            EXPECT_EQ(changed(part->image, whole->image, region.x0, region.y0), 0);
        }
    }
}

// The wider the widest disc of a frame, the more parts of it have separate kernels.
TEST(RegionOfALensThatVaries, IsDrawnAsInTheWholeWhateverLightsAreFarAway) {
    Shot shot = flat(900, 300, {0.1f, 0.1f, 0.1f, 1}, 3);
    for (int y = 0; y < 300; ++y)
        for (int x = 840; x < 900; ++x) shot.coc_px(x, y) = 24;
    for (int i = 0; i < 12; ++i) shot.colour(20 + 13 * i, 40 + 17 * i) = {90, 60, 30, 1};
    for (const char* engine : {"gather", "sprites"})
        for (const bool far_light : {false, true}) {
            if (far_light) shot.colour(880, 150) = {500, 400, 300, 1};
            DefocusJob job = shot.job(engine);
            job.lens.cats_eye = 0.7, job.camera = {50, 36, 4, 2};
            Session session;
            const auto whole = session.defocus(job),
                       part = session.defocus(job, {.region = Rect{30, 40, 150, 200}});
            ASSERT_TRUE(whole && part);
            EXPECT_EQ(changed(part->image, whole->image, 30, 40), 0) << engine << far_light;
        }
}

TEST(RegionMargin, GrowsWithTheRadiusAndARegionOutsideIsRefused) {
    const Shot shot = flat(64, 48, {0.5f, 0.5f, 0.5f, 1}, 5);
    Session session;
    const auto margin = session.region_margin_px(shot.job("scatter"));
    ASSERT_TRUE(margin);
    EXPECT_GE(*margin, 4 * 5 + 175);
    EXPECT_LE(*margin, 4 * 7 + 175);
    const auto outside = session.defocus(shot.job("scatter"), {.region = Rect{64, 0, 90, 10}});
    ASSERT_FALSE(outside);
    EXPECT_EQ(outside.error().code, ErrorCode::InvalidArgument);
}

PETZVAL_EVERY_DRAWER(Region);

}  // namespace
}  // namespace petzval::conformance
