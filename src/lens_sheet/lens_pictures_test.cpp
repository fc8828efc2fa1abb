#include "petzval/lens_facts.h"
#include "petzval/lens_report.h"

#include "base/temporary_folder.h"

#include <algorithm>
#include <filesystem>

#include <gtest/gtest.h>

namespace petzval {
namespace {

Lens opened(const std::string& name) {
    LensChoice choice;
    choice.name = name;
    return Lens::open(choice).value();
}

TEST(MountedOn, NumbersThatAreNotGivenAreTheLensesOwn) {
    const Lens lens = opened("tessar");
    const Camera own = own_camera(lens).value();
    CameraChoice choice;
    const LensMount usual = mounted_on(lens, choice, 1600).value();
    EXPECT_EQ(usual.camera.focal_length_mm, own.focal_length_mm);
    EXPECT_EQ(usual.camera.sensor_width_mm, own.sensor_width_mm);
    EXPECT_EQ(usual.height_px, 900) << "9/16 of the width";
    choice.focal_length_mm = 80;
    choice.aperture_diameter_mm = 10;
    const LensMount scaled = mounted_on(lens, choice, 1600, 1200).value();
    EXPECT_EQ(scaled.camera.f_number, 8) << "80 mm / 10 mm";
    EXPECT_EQ(scaled.camera.sensor_width_mm, own.sensor_width_mm);
    EXPECT_EQ(scaled.height_px, 1200);
}

TEST(LensMemory, TooLargePicturesAreRefusedAndNoLimitRefusesNothing) {
    const Lens lens = opened("doublet");
    const LensMount mount = mounted_on(lens, {}, 1920).value();
    constexpr std::size_t kLittle = 1 << 20;
    const auto refused = [](const Status& fits) {
        return !fits && fits.error().code == ErrorCode::OutOfMemory;
    };
    EXPECT_TRUE(refused(lens_disc_fits(lens, mount, 500, 0, kLittle)));
    EXPECT_TRUE(refused(lens_disc_fits(lens, mount, 500, 21, kLittle))) << "the kernel is made whole";
    EXPECT_TRUE(lens_disc_fits(lens, mount, 500, 0, 0));
    EXPECT_TRUE(lens_disc_fits(lens, mount, 5, 0, kLittle));
    BokehTextureSettings texture;
    texture.columns = 4096;
    EXPECT_TRUE(refused(bokeh_texture_fits(lens, mount, texture, kLittle)));
    EXPECT_TRUE(bokeh_texture_fits(lens, mount, texture, 0));
    BokehVolumeSettings volume;
    volume.slices = 4;
    volume.side_px = 32;
    EXPECT_TRUE(bokeh_volume_fits(volume, kLittle)) << "4 x 33 x 33 x 50 bytes";
    volume.side_px = 128;
    EXPECT_TRUE(refused(bokeh_volume_fits(volume, kLittle))) << "4 x 129 x 129 x 50 bytes";
}

TEST(LensViewFileTest, OneFileIsSeenThroughEachLens) {
    const test::TemporaryFolder folder;
    Frame frame;
    frame.place = Place::whole({0, 0, 32, 16});
    frame.colour = Picture(32, 16, Rgba{0.5f, 0.5f, 0.5f, 1});
    frame.depth = Plane(32, 16, 3);
    ASSERT_TRUE(write_exr(folder / "in.exr", frame));
    LensViewFile file{.source = {.path = folder / "in.exr"}};
    file.source.camera.focal_length_mm = 50;
    file.source.camera.sensor_width_mm = 36;
    file.source.camera.f_number = 1;
    file.focus_pixel = PixelPosition{4, 4};
    file.sheet.lenses = {"doublet", "tessar"};
    file.sheet.cell_width_px = 32;
    file.sheet.columns = 2;
    file.sheet.captions = false;
    file.output = folder / "sheet.png";
    std::vector<std::string> said;
    const auto warn = [&](const std::string& line) { said.push_back(line); };
    const Status done = write_lens_view_sheet(file, {}, warn);
    ASSERT_TRUE(done) << done.error().message;
    EXPECT_GE(read_png(file.output)->width, 64);
    const auto is_of_tessar = [](const std::string& line) { return line.starts_with("tessar: opens to"); };
    EXPECT_TRUE(std::any_of(said.begin(), said.end(), is_of_tessar)) << "f/1 is wider than the lens";
    file.sheet.lenses = {"none"};
    EXPECT_FALSE(write_lens_view_sheet(file, {}, warn));
}

TEST(LensPicture, IsWrittenInBothFormatsWithItsRecord) {
    const test::TemporaryFolder folder;
    LensPictureFile file;
    file.look.lens.name = "doublet";
    file.picture = LensDiscSettings{.coc_radius_px = 6, .size_px = 9};
    for (const char* name : {"disc.exr", "disc.png"}) {
        file.output = folder / name;
        bool was_drawn = false;
        const auto made = make_lens_picture(file, [&](const LensPictureMade& drawn) {
            was_drawn = true;
            EXPECT_FALSE(std::filesystem::exists(file.output)) << "said before it is written";
            EXPECT_NE(drawn.warning.find("outside of disc.size_px 9"), std::string::npos) << drawn.warning;
        });
        ASSERT_TRUE(made) << made.error().message;
        EXPECT_TRUE(was_drawn);
        EXPECT_TRUE(std::filesystem::exists(file.output));
        EXPECT_NE(made->record.find("\"verb\":\"lens psf\""), std::string::npos) << made->record;
        EXPECT_NE(made->record.find("\"size\":9"), std::string::npos) << made->record;
    }
    file.output = folder / "volume.exr";
    file.picture = BokehVolumeSettings{.slices = 2, .side_px = 16};
    const auto volume = make_lens_picture(file);
    ASSERT_TRUE(volume);
    EXPECT_NE(volume->record.find("\"verb\":\"lens volume\""), std::string::npos);
}

TEST(LensPicture, AnAtlasOrAReportThatDoesNotFitIsRefused) {
    constexpr std::size_t kMebibyte = 1 << 20;
    const auto atlas = [](const char* name, int zones, std::size_t mebibytes) {
        const Lens lens = opened(name);
        return lens_atlas_fits(lens, mounted_on(lens, {}, 1920).value(), {.zones = zones},
                               mebibytes * kMebibyte);
    };
    EXPECT_TRUE(atlas("ideal", 64, 6)) << "64 x 14 x 31 x 31 x 4 bytes and 2.5 MiB";
    EXPECT_EQ(atlas("ideal", 64, 5).error().code, ErrorCode::OutOfMemory);
    EXPECT_TRUE(atlas("ideal", 1, 3));
    EXPECT_TRUE(atlas("petzval-portrait", 1, 12));
    EXPECT_EQ(atlas("petzval-portrait", 1, 8).error().code, ErrorCode::OutOfMemory) << "its kernels";
    EXPECT_TRUE(lens_report_fits(0)) << "no limit";
    EXPECT_TRUE(lens_report_fits(60 * kMebibyte));
    EXPECT_EQ(lens_report_fits(59 * kMebibyte).error().code, ErrorCode::OutOfMemory);
}

TEST(LensPicture, OfTheMiddleRefusesWhatShowsOnlyAwayFromIt) {
    LensPictureFile file;
    file.look.lens.name = "doublet";
    file.look.lens.coma = 1;
    file.output = "never.exr";
    file.picture = LensDiscSettings{};
    EXPECT_EQ(check(file).error().field, "lens.coma");
    EXPECT_EQ(make_lens_picture(file).error().field, "lens.coma");
    file.picture = BokehVolumeSettings{};
    EXPECT_FALSE(check(file));
    file.picture = LensDiscSettings{.field_x = 0.5};
    EXPECT_TRUE(check(file));
}

TEST(LensAtlasFiles, AreWrittenWithTheirRecord) {
    const test::TemporaryFolder folder;
    LensAtlasFiles files;
    files.look.lens.name = "ideal";
    files.atlas.zones = 1;
    files.folder = folder / "new/atlas";
    const Error no{ErrorCode::OutputFailed, "no"};
    EXPECT_EQ(make_lens_atlas(files, [&] { return Status(no); }).error().message, "no");
    EXPECT_FALSE(std::filesystem::exists(outputs_of(files)[1]));
    const auto made = make_lens_atlas(files, [&] {
        EXPECT_TRUE(std::filesystem::is_directory(files.folder));
        return Status(Done{});
    });
    ASSERT_TRUE(made) << made.error().message;
    EXPECT_NE(made->record.find("\"verb\":\"lens atlas\""), std::string::npos) << made->record;
    EXPECT_NE(made->record.find("radii_px"), std::string::npos);
    const std::vector<std::string> outputs = outputs_of(files);
    ASSERT_EQ(outputs.size(), 2u);
    EXPECT_TRUE(outputs[0].ends_with("atlas.json"));
    EXPECT_TRUE(std::filesystem::exists(outputs[0]));
    EXPECT_EQ(std::filesystem::file_size(outputs[1]), 4u * kAtlasRadii * kAtlasTileSide * kAtlasTileSide);
}

TEST(LensAtlasFiles, OfRingsAreOfRoundPupilsAndOneZoneIsTheMiddle) {
    const test::TemporaryFolder folder;
    LensAtlasFiles files;
    files.folder = folder / "atlas";
    files.look.lens.aperture.blades = 5;
    EXPECT_EQ(make_lens_atlas(files).error().field, "lens.blades");
    files.atlas.zones = 1;
    EXPECT_TRUE(check(files));
    files.look.lens.cats_eye = 0.5;
    EXPECT_EQ(check(files).error().field, "lens.cats_eye");
    files.look = {}, files.atlas.zones = 65;
    EXPECT_EQ(check(files).error().field, "atlas.zones");
    files.atlas.zones = 1, files.max_memory_bytes = 1 << 10;
    EXPECT_EQ(make_lens_atlas(files).error().code, ErrorCode::OutOfMemory);
    EXPECT_FALSE(std::filesystem::exists(files.folder));
}

TEST(LensBufferFile, HasAVectorForEachNumberOfThePage) {
    const test::TemporaryFolder folder;
    LensBufferFile file;
    file.look.lens.name = "ideal";
    file.output = folder / "lens.bin";
    const auto made = make_lens_buffer(file);
    ASSERT_TRUE(made) << made.error().message;
    EXPECT_NE(made->record.find("\"verb\":\"lens buffer\""), std::string::npos) << made->record;
    EXPECT_NE(made->record.find("\"taps\":48"), std::string::npos);
    EXPECT_EQ(std::filesystem::file_size(file.output), 16u * (1 + 264 + 101592));
    file.overwrite = false;
    EXPECT_EQ(make_lens_buffer(file).error().code, ErrorCode::OutputFailed);
    file.overwrite = true, file.max_memory_bytes = 1 << 10;
    EXPECT_EQ(make_lens_buffer(file).error().code, ErrorCode::OutOfMemory);
}

TEST(LensReportFiles, OfOneLensIsAPageAndOfSeveralAFolder) {
    const test::TemporaryFolder folder;
    LensReportFiles files{.lenses = {"ideal"}};
    EXPECT_EQ(outputs_of(files).value(), std::vector<std::string>{"ideal.html"}) << "in the current folder";
    files.output = "sheet.xhtml";
    EXPECT_EQ(outputs_of(files).value(), std::vector<std::string>{"sheet.xhtml"});
    files.lenses.emplace_back("doublet");
    EXPECT_EQ(check(files).error().field, "report.output") << "two pages in one file";
    files.output = folder / "sheets";
    const auto outputs = outputs_of(files).value();
    ASSERT_EQ(outputs.size(), 5u);
    EXPECT_EQ(outputs[1], folder / "sheets/doublet.html");
    EXPECT_EQ(outputs[4], folder / "sheets/index.html");
    files.lenses = {};
    EXPECT_EQ(outputs_of(files).value().size(), lens_list().size() + 3);
    files.output = "";
    EXPECT_EQ(check(files).error().field, "report.output");
}

TEST(LensReportFiles, AreWrittenWithTheirRecordIfTheyMayBe) {
    const test::TemporaryFolder folder;
    LensReportFiles files{.lenses = {"ideal"}, .output = folder / "new/sheets"};
    const Error no{ErrorCode::OutputFailed, "no"};
    EXPECT_EQ(make_lens_report(files, [&] { return Status(no); }).error().message, "no");
    const std::string page = outputs_of(files).value().front();
    EXPECT_FALSE(std::filesystem::exists(page));
    const auto made = make_lens_report(files);
    ASSERT_TRUE(made) << made.error().message;
    EXPECT_TRUE(std::filesystem::exists(page));
    EXPECT_NE(made->record.find("\"verb\":\"lens report\",\"input\":\"ideal\""), std::string::npos)
        << made->record;
    files.max_memory_bytes = 1 << 10;
    EXPECT_EQ(make_lens_report(files).error().code, ErrorCode::OutOfMemory);
    files.max_memory_bytes = 0, files.output = folder / "other", files.lenses = {"no such lens"};
    EXPECT_FALSE(make_lens_report(files));
    EXPECT_FALSE(std::filesystem::exists(files.output)) << "a misspelt name makes no folder";
}

TEST(LensPicture, NothingIsWrittenForALensOrAFormatThatIsNone) {
    const test::TemporaryFolder folder;
    LensPictureFile file;
    file.look.lens.name = "no such lens";
    file.output = folder / "disc.exr";
    EXPECT_FALSE(make_lens_picture(file));
    file.look.lens.name = "doublet";
    file.output = folder / "disc.txt";
    EXPECT_FALSE(make_lens_picture(file));
    file.output = folder / "disc.exr";
    file.max_memory_bytes = 1 << 10;
    EXPECT_EQ(make_lens_picture(file).error().code, ErrorCode::OutOfMemory);
    EXPECT_FALSE(std::filesystem::exists(folder / "disc.exr"));
}

}  // namespace
}  // namespace petzval
