#include "petzval/shot.h"

#include "files/test_exr.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <gmock/gmock.h>
#include <limits>
#include <sys/stat.h>

#include <gtest/gtest.h>

namespace petzval {
namespace {

using test::TemporaryFolder;
using test::write_bytes;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr Rect kFrame{0, 0, 32, 20}, kPiece{4, 5, 24, 15};

// Grey, 4 m away, a lamp 10 m away in its middle; data windows inside of the frame.
void write_picture(const std::string& path, const Rect& window = kPiece, float depth = 4,
                   const FoundCamera& camera = {}) {
    const int width = window.width(), height = window.height();
    const Plane colour(width, height, 0.2f), alpha(width, height, 1);
    Plane z(width, height, depth), red(width, height, 0.2f);
    red(width / 2, height / 2) = 50, z(width / 2, height / 2) = 2.5f * depth;
    WriteOptions options;
    options.camera = camera;
    ASSERT_TRUE(write_exr_planes(
        path, {kFrame, window}, {{"R", red}, {"G", colour}, {"B", colour}, {"A", alpha}, {"Z", z}}, options));
}

FoundCamera file_camera() {
    FoundCamera camera;
    camera.focal_length_mm = FoundNumber{50, ""};
    camera.sensor_width_mm = FoundNumber{36, ""};
    camera.f_number = FoundNumber{4, ""};
    camera.focus_distance_m = FoundNumber{2, ""};
    return camera;
}

class Shots : public testing::Test {
protected:
    Shots() {
        write_picture(folder / "in.exr", kPiece, 4, file_camera());
        source.path = folder / "in.exr";
    }
    Shot read() {
        auto shot = read_shot(source);
        EXPECT_TRUE(shot) << shot.error().message;
        return shot ? std::move(*shot) : Shot{};
    }
    std::string refusal(ErrorCode code) {
        const auto shot = read_shot(source);
        if (shot) return "was read";
        EXPECT_EQ(shot.error().code, code) << shot.error().message;
        return shot.error().message;
    }

    TemporaryFolder folder;
    ShotSource source;
};

DepthSettings of_kind(DepthKind kind) {
    DepthSettings depth;
    depth.kind = kind;
    return depth;
}

float depth_of(const Shot& shot, int x, int y) { return std::get<DepthMetres>(shot.depth).plane(x, y); }

TEST_F(Shots, DepthIsMetresOrRadiiAndNeverBoth) {
    source.depth.unit_scale_m = 0.01;
    Shot shot = read();
    ASSERT_FALSE(shot.has_radii());
    EXPECT_FLOAT_EQ(depth_of(shot, 0, 0), 0.04f);
    EXPECT_FALSE(has_radii(*rendered(shot)));

    source.depth = of_kind(DepthKind::CocPx);
    shot = read();
    ASSERT_TRUE(shot.has_radii());
    EXPECT_FLOAT_EQ(std::get<RadiiPx>(shot.depth).plane(0, 0), 4);
    EXPECT_TRUE(has_radii(*rendered(shot)));
    EXPECT_EQ(depth_or_radii(*rendered(shot)).width(), kPiece.width());
    EXPECT_TRUE(to_frame(std::move(shot)).depth.empty());  // radii are never written as Z
}

TEST_F(Shots, SettingsThatContradictAreNamedByField) {
    source.depth.kind = DepthKind::Device;
    EXPECT_THAT(refusal(ErrorCode::InvalidArgument), HasSubstr("depth.range"));
    source.depth = of_kind(DepthKind::Planar);
    source.depth.range_near = 1, source.depth.range_far = 2;
    EXPECT_THAT(refusal(ErrorCode::InvalidArgument), HasSubstr("depth.range"));
    source.depth = of_kind(DepthKind::CocPx);
    source.depth.unit_scale_m = 2;
    EXPECT_THAT(refusal(ErrorCode::InvalidArgument), HasSubstr("depth.unit_scale_m"));
    source.depth = of_kind(DepthKind::Ray);
    write_picture(source.path);  // without its camera
    EXPECT_THAT(refusal(ErrorCode::InvalidArgument), HasSubstr("camera.focal_length_mm"));
}

TEST_F(Shots, AnApertureMayBeGivenByItsDiameter) {
    source.camera.aperture_diameter_mm = 12.5;
    EXPECT_DOUBLE_EQ(read().camera.f_number->value, 50 / 12.5) << "the file's focal length";
    source.camera.focal_length_mm = 100;
    EXPECT_DOUBLE_EQ(rendered(read())->camera.f_number, 100 / 12.5) << "the user's";
    source.camera.f_number = 8;
    EXPECT_THAT(refusal(ErrorCode::InvalidArgument), HasSubstr("camera.aperture_diameter_mm"));
    source.camera.f_number.reset(), source.camera.wide_open = true;
    EXPECT_THAT(refusal(ErrorCode::InvalidArgument), HasSubstr("camera.f_number"));
    write_picture(source.path);  // without its camera
    source.camera = {};
    source.camera.aperture_diameter_mm = 25;
    EXPECT_THAT(refusal(ErrorCode::InvalidArgument), HasSubstr("give camera.focal_length_mm"));
}

TEST(Focus, IsChosenInOneWay) {
    const CameraChoice none, far{.focus_distance_m = 3};
    const PixelPosition pixel{4, 2};
    const WorldPoint point{0, 0, -1};
    EXPECT_TRUE(check_focus(none, {}, {}));
    EXPECT_TRUE(check_focus(far, {}, {}));
    EXPECT_TRUE(check_focus(none, pixel, {}));
    EXPECT_EQ(check_focus(far, pixel, {}).error().message,
              "camera.focus_distance_m and focus.at contradict each other; give one");
    EXPECT_EQ(check_focus(far, {}, point).error().field, "camera.focus_distance_m");
    EXPECT_EQ(check_focus(none, pixel, point).error().message,
              "focus.at and focus.point contradict each other; give one");
}

TEST_F(Shots, TheUsersNumbersWinOverTheFiles) {
    source.camera.f_number = 1.4;
    const Shot shot = read();
    EXPECT_DOUBLE_EQ(shot.camera.f_number->value, 1.4);
    EXPECT_EQ(shot.camera.f_number->origin, "camera.f_number");
    EXPECT_DOUBLE_EQ(shot.camera_of_file.f_number->value, 4);
    EXPECT_DOUBLE_EQ(shot.camera.focal_length_mm->value, 50);
    EXPECT_DOUBLE_EQ(rendered(shot)->camera.f_number, 1.4);
}

TEST_F(Shots, MissingNumbersAreNamedTogetherUnlessRadiiAreGiven) {
    write_picture(source.path);
    source.camera = {.focal_length_mm = 50, .sensor_width_mm = 36};
    const auto job = rendered(read());
    ASSERT_FALSE(job);
    EXPECT_EQ(job.error().message,
              "no f-number and no focus distance; give camera.f_number and camera.focus_distance_m");
    source.depth.kind = DepthKind::CocPx;
    EXPECT_TRUE(rendered(read()));
}

TEST(ShotCamera, AFieldOfViewStandsForTheNumberThatIsMissing) {
    FoundCamera file;
    file.horizontal_fov_deg = FoundNumber{90, "header"};
    // tan 45 degrees = 1 = s / 2f
    EXPECT_NEAR(merged_camera(file, {.focal_length_mm = 20}).sensor_width_mm->value, 40, 1e-9);
    EXPECT_NEAR(merged_camera(file, {.sensor_width_mm = 36}).focal_length_mm->value, 18, 1e-9);
    EXPECT_FALSE(merged_camera(file, {}).focal_length_mm);
}

TEST(ShotCamera, ADistanceInSceneUnitsBecomesMetres) {
    FoundCamera file;
    file.focus_distance_m = FoundNumber{250, "header", true};
    EXPECT_DOUBLE_EQ(merged_camera(file, {}, 0.01).focus_distance_m->value, 2.5);
    EXPECT_DOUBLE_EQ(merged_camera(file, {.focus_distance_m = 3}, 0.01).focus_distance_m->value, 3);
}

TEST(ShotCamera, FieldOfViewAndPositionFollowFromTheFile) {
    FoundCamera camera;
    EXPECT_FALSE(field_of_view_deg(camera) || position_of(camera));
    camera.horizontal_fov_deg = FoundNumber{40, "file"};
    EXPECT_EQ(field_of_view_deg(camera)->value, 40);
    camera.focal_length_mm = FoundNumber{18, ""};
    camera.sensor_width_mm = FoundNumber{36, ""};
    EXPECT_DOUBLE_EQ(field_of_view_deg(camera)->value, 90) << "2 atan(36 / 2 / 18)";
    // Turned by 90 degrees about y after a move by (-1, -2, -3).
    camera.camera_from_world = {0, 0, -1, 0, 0, 1, 0, 0, 1, 0, 0, 0, -3, -2, 1, 1};
    const auto at = position_of(camera);
    ASSERT_TRUE(at);
    EXPECT_EQ(at->x, 1);
    EXPECT_EQ(at->y, 2);
    EXPECT_EQ(at->z, 3);
}

TEST_F(Shots, HiddenLayersAreCutToThePicturesWindow) {
    write_picture(folder / "hidden.exr", kPiece, 8);
    source.behind = folder / "hidden.exr";
    const Shot same = read();
    EXPECT_EQ(same.behind.width(), kPiece.width());
    EXPECT_FLOAT_EQ(same.behind.at(0, 0)[0].depth, 8);
    write_picture(source.behind, kFrame, 8);
    const Shot cut = read();
    EXPECT_EQ(cut.behind.width(), kPiece.width());
    EXPECT_FLOAT_EQ(cut.behind.at(0, 0)[0].depth, 8);
    EXPECT_THAT(cut.detected, testing::Contains(HasSubstr("only the part inside")));
    write_picture(source.behind, {0, 0, kPiece.x0, kPiece.y0});
    EXPECT_THAT(refusal(ErrorCode::InvalidFile),
                testing::AllOf(HasSubstr("shot.behind"), HasSubstr("must overlap")));
}

TEST_F(Shots, APlateThatIsHardlyThatOfThePictureIsDoubted) {
    // A card 1 m away hides the middle of a wall.
    const auto write = [&](const std::string& path, bool has_card, float wall_m, float light) {
        const auto is_card = [has_card](int x) { return has_card && x >= 20 && x < 30; };
        const auto colour = [=](int x, int) { return is_card(x) ? 0.9f : light + 0.01f * float(x % 7); };
        test::write_quick_exr(path, {0, 0, 48, 32},
                              {{"",
                                "",
                                {0, 0, 48, 32},
                                {{"R", Imf::FLOAT, colour},
                                 {"G", Imf::FLOAT, colour},
                                 {"B", Imf::FLOAT, colour},
                                 {"Z", Imf::FLOAT, [=](int x, int) { return is_card(x) ? 1 : wall_m; }}}}});
    };
    write(folder / "card.exr", true, 8, 0.3f);
    write(folder / "wall.exr", false, 8, 0.3f);
    write(folder / "wall_cm.exr", false, 800, 0.3f);
    write(folder / "dark.exr", false, 8, 0.05f);
    const auto warnings = [&](const char* picture, const char* plate) {
        source.path = folder / picture;
        source.behind = folder / plate;
        return read().warnings;
    };
    using testing::Contains;
    EXPECT_THAT(warnings("card.exr", "wall.exr"), testing::Each(testing::Not(HasSubstr("plate:"))));
    EXPECT_THAT(warnings("wall.exr", "card.exr"), Contains(HasSubstr("are the two files swapped?")));
    EXPECT_THAT(warnings("card.exr", "card.exr"), Contains(HasSubstr("shows nothing behind")));
    EXPECT_THAT(warnings("card.exr", "wall_cm.exr"), Contains(HasSubstr("at 100 times its depth")));
    EXPECT_THAT(warnings("card.exr", "dark.exr"), Contains(HasSubstr("another frame or exposure?")));
}

TEST_F(Shots, MergedPicturesCoverTheUnionAndTheNearerHides) {
    write_picture(folder / "near.exr", {0, 0, 10, 8}, 1);
    source.merge = {folder / "near.exr"};
    const Shot shot = read();
    EXPECT_EQ(shot.place.data_window, (Rect{0, 0, 24, 15}));
    EXPECT_EQ(shot.deep.at(5, 6).size(), 2u);
    EXPECT_FLOAT_EQ(depth_of(shot, 5, 6), 1);
    EXPECT_FLOAT_EQ(depth_of(shot, 12, 9), 4);
    EXPECT_FLOAT_EQ(shot.depth_report.nearest_m, 1);
}

TEST_F(Shots, AMatteOutsideOfThePictureIsAWarning) {
    write_picture(folder / "matte.exr", {0, 0, 3, 3}, 1);
    source.holdout = folder / "matte.exr";
    const Shot shot = read();
    EXPECT_TRUE(shot.holdout.empty());
    EXPECT_THAT(shot.warnings, testing::Contains(HasSubstr("holds nothing")));
}

TEST_F(Shots, FocusIsOnWhatAPixelShows) {
    Shot shot = read();
    ASSERT_TRUE(focus_on_pixel(shot, {14, 10}));  // the lamp
    EXPECT_DOUBLE_EQ(shot.camera.focus_distance_m->value, 10);
    EXPECT_EQ(shot.camera.focus_distance_m->origin, "focus.at 14,10");
    const Status outside = focus_on_pixel(shot, {3, 10});
    ASSERT_FALSE(outside);
    EXPECT_THAT(outside.error().message, HasSubstr("columns 4 to 23 and rows 5 to 14"));
    source.depth.kind = DepthKind::CocPx;
    shot = read();
    EXPECT_FALSE(focus_on_pixel(shot, {14, 10}));
}

TEST_F(Shots, ADistanceIsTheMedianOfWhatIsSeenAround) {
    Shot shot = read();
    Plane& depth = std::get<DepthMetres>(shot.depth).plane;
    const Rect &data = shot.place.data_window, &display = shot.place.display_window;
    const int x = 14 + display.x0 - data.x0, y = 10 + display.y0 - data.y0;
    const float around[] = {2, 3, 100, INFINITY, INFINITY, 2, 3, INFINITY, 3};
    for (int i = 0; i < 9; ++i) depth(x - 1 + i % 3, y - 1 + i / 3) = around[i];
    EXPECT_EQ(**distance_around_m(shot, {14, 10}, 1), 3);
    EXPECT_FALSE(distance_around_m(shot, {14, 10}, 0)->has_value()) << "a miss";
    EXPECT_FALSE(distance_around_m(shot, {3, 10}, 1)) << "outside";
}

TEST_F(Shots, FocusIsOnAPointOfTheWorld) {
    source.depth.unit_scale_m = 0.01;
    Shot shot = read();
    EXPECT_FALSE(focus_on_point(shot, {0, 0, 1}));
    // The camera stands at z = 100 units and looks along +z.
    shot.camera.camera_from_world = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -100, 1};
    ASSERT_TRUE(focus_on_point(shot, {7, 8, 350}));
    EXPECT_DOUBLE_EQ(shot.camera.focus_distance_m->value, 2.5);
    EXPECT_FALSE(focus_on_point(shot, {7, 8, 100}));
    const std::size_t before = shot.warnings.size();
    ASSERT_TRUE(focus_on_point(shot, {7, 8, 0}));
    EXPECT_DOUBLE_EQ(shot.camera.focus_distance_m->value, 1);
    EXPECT_EQ(shot.warnings.size(), before + 1);
}

TEST_F(Shots, OverscanGrowsSidesInsideOfTheFrameAndAllThatBelongsToThem) {
    write_picture(source.path, {4, 0, 32, 15}, 4, file_camera());
    write_bytes(folder / "lights.csv", "x,y,depth,r,g,b\n10.5,7.5,3,1,1,1\n");
    source.lights = folder / "lights.csv";
    Shot shot = read();
    EXPECT_FLOAT_EQ(shot.lights[0].x, 6.5f);
    ASSERT_TRUE(*grow_empty_sides(shot, 3));
    EXPECT_EQ(shot.place.data_window, (Rect{1, 0, 32, 18}));
    EXPECT_EQ(shot.colour(0, 0), Rgba{});
    EXPECT_FLOAT_EQ(depth_of(shot, 0, 17), 4);
    EXPECT_FLOAT_EQ(shot.lights[0].x, 9.5f);  // the same place of the frame
    EXPECT_FLOAT_EQ(shot.lights[0].y, 7.5f);
    shot.place.data_window = shot.place.display_window;
    EXPECT_FALSE(*grow_empty_sides(shot, 3));
}

TEST_F(Shots, LightReachesAsFarAsItsLargestRadius) {
    Shot shot = read();
    Look look;
    look.coc.far_scale = 10;
    const auto radii = circle_of_confusion(*rendered(shot), look);
    const double largest = double(*std::max_element(radii->pixels(), radii->pixels() + radii->size()));
    ASSERT_GT(largest, 1);
    EXPECT_EQ(*reach_px(shot, look), int(std::ceil(largest)) + 1);
    look.lens.aperture.squeeze = 2;
    EXPECT_EQ(*reach_px(shot, look), int(std::ceil(2 * largest)) + 1);
}

TEST_F(Shots, LightsComeBackAsTheyWereWritten) {
    std::vector<LightPoint> points(2);
    points[0] = {1.25f, 2.5f, 0.1f, 0.2f, 0.3f, 4.4f};
    points[1] = {-7, 1e-8f, 1e20f, 0, 3, std::numeric_limits<float>::infinity(), 0, 2, LightSpectrum::Led};
    write_bytes(folder / "lights.csv", lights_text(points, {"two", "of them"}));
    const auto read = read_lights(folder / "lights.csv", {});
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_TRUE(read->has_depth);
    ASSERT_EQ(read->points.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
        const LightPoint &a = points[i], &b = read->points[i];
        EXPECT_THAT((std::array{b.x, b.y, b.depth_m, b.r, b.g, b.b, b.diameter_px}),
                    ElementsAre(a.x, a.y, a.depth_m, a.r, a.g, a.b, a.diameter_px));
        EXPECT_EQ(a.spectrum, b.spectrum);
    }
}

TEST_F(Shots, LightsSayWhatTheirLightIsMadeOf) {
    write_bytes(folder / "lights.csv",
                "x,y,coc,r,g,b,spectrum\n1,1,3,1,1,1,sodium\n1,1,3,1,1,1, neon \n1,1,3,1,1,1,\n");
    const auto read = read_lights(folder / "lights.csv", {});
    ASSERT_TRUE(read) << read.error().message;
    ASSERT_EQ(read->points.size(), 3u);
    EXPECT_EQ(read->points[0].spectrum, LightSpectrum::Sodium);
    EXPECT_EQ(read->points[1].spectrum, LightSpectrum::Neon);
    EXPECT_EQ(read->points[2].spectrum, std::nullopt);
    write_bytes(folder / "lights.csv", "x,y,coc,r,g,b,spectrum\n1,1,3,1,1,1,candle\n");
    const auto unknown = read_lights(folder / "lights.csv", {});
    ASSERT_FALSE(unknown);
    EXPECT_THAT(unknown.error().message,
                HasSubstr("lights.csv:2: 'candle' in column spectrum is not one of"));
}

TEST_F(Shots, LightsByDepthAndRadiiDoNotFit) {
    write_bytes(folder / "lights.csv", "x,y,depth,r,g,b\n1,1,3,1,1,1\n");
    source.lights = folder / "lights.csv";
    source.depth.kind = DepthKind::CocPx;
    EXPECT_THAT(refusal(ErrorCode::InvalidFile), HasSubstr("coc"));
}

TEST_F(Shots, APipeOfLightsIsRefusedAndNotWaitedFor) {
    source.lights = folder / "pipe";
    ASSERT_EQ(::mkfifo(source.lights.c_str(), 0600), 0);
    EXPECT_THAT(refusal(ErrorCode::InvalidFile), HasSubstr("not a regular file"));
}

TEST_F(Shots, ReadingEndsWhenNobodyWantsIt) {
    write_picture(folder / "near.exr", kPiece, 1);
    source.merge = {folder / "near.exr"};
    const auto told = read_shot(source, {.progress = [](double share) { return share > 0.9; }});
    ASSERT_FALSE(told);
    EXPECT_EQ(told.error().code, ErrorCode::Cancelled);
    const auto asked = read_shot(source, {.cancelled = [] { return true; }});
    ASSERT_FALSE(asked);
    EXPECT_EQ(asked.error().code, ErrorCode::Cancelled);
}

TEST_F(Shots, ReadingEndsWithinAFile) {
    write_picture(source.path, {0, 0, 400, 2000});
    std::atomic<int> asked = 0;
    ASSERT_TRUE(read_shot(source, {.cancelled = [&] { return ++asked < 0; }}));
    EXPECT_GT(asked, 50);
    asked = 0;
    source.read.threads = 1;
    const auto shot = read_shot(source, {.cancelled = [&] { return ++asked > 20; }});
    ASSERT_FALSE(shot);
    EXPECT_EQ(shot.error().code, ErrorCode::Cancelled);
}

TEST_F(Shots, APngIsLeftBetweenRowsWhenReadingIsCancelled) {
    PngPixels grey{32, 400, 1, 8, std::vector<std::uint16_t>(std::size_t(32 * 400), 9)};
    ASSERT_TRUE(write_png(folder / "in.png", grey));
    ShotSource png;
    png.path = folder / "in.png", png.read.need_depth = false;
    std::atomic<int> asked = 0;
    ASSERT_TRUE(read_shot(png, {.cancelled = [&] { return ++asked < 0; }}));
    EXPECT_GT(asked, 400);
    const auto shot = read_shot(png, {.cancelled = [&, until = asked + 100] { return ++asked > until; }});
    ASSERT_FALSE(shot);
    EXPECT_EQ(shot.error().code, ErrorCode::Cancelled);
}

TEST_F(Shots, APictureIsTakenOfWhatWasRead) {
    source.camera.f_number = 0.5;
    const Shot shot = read();
    const auto lent = rendered(shot);
    ASSERT_TRUE(lent) << lent.error().message;
    const auto taken = Session().take(*lent, Look{});
    ASSERT_TRUE(taken) << taken.error().message;
    EXPECT_TRUE(shot.place.fits(taken->image.width(), taken->image.height()));
    EXPECT_LT(taken->image(10, 5).r, 50);  // the lamp is out of focus
}

TEST_F(Shots, PicturesOfALookAreReadIntoItsLens) {
    ASSERT_TRUE(write_png(folder / "hole.png", {2, 1, 1, 8, {0, 255}}));
    Look look;
    look.aperture_image = folder / "hole.png", look.kernel_image_far = source.path;
    ASSERT_TRUE(read_lens_images(look));
    EXPECT_THAT((std::array{(*look.lens.texture.image)(0, 0), (*look.lens.texture.image)(1, 0)}),
                ElementsAre(0, 1));
    EXPECT_EQ(look.lens.kernel_images.far->width(), kPiece.width());
    look.aperture_image = folder / "none.png";
    const Status missing = read_lens_images(look);
    ASSERT_FALSE(missing);
    EXPECT_THAT(missing.error().message, HasSubstr("lens.aperture_image"));
}

}  // namespace
}  // namespace petzval
