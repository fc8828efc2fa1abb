#include "petzval/farm/jobs.h"
#include "petzval/files.h"
#include "petzval/session.h"

#include "base/temporary_folder.h"

#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

namespace petzval {
namespace {

namespace fs = std::filesystem;

struct WriteJobTest : testing::Test {
    void SetUp() override {
        Frame frame;
        frame.place = Place::whole({0, 0, 16, 8});
        frame.colour = Picture(16, 8, Rgba{0.5f, 0.5f, 0.5f, 1});
        frame.depth = Plane(16, 8, 3);
        for (const char* name : {"in.0003.exr", "in.0001.exr", "in.0002.exr"})
            ASSERT_TRUE(write_exr(folder / name, frame));
        job.folder = folder / "jobs/night";
        job.command = {"petzval", "defocus", "in.####.exr"};
        job.settings.source.path = folder / "in.####.exr";
        job.settings.source.camera = {
            .focal_length_mm = 50, .sensor_width_mm = 36, .f_number = 2, .focus_distance_m = 1};
        job.settings.output = folder / "out.####.exr";
        host.say = [this](Say, const std::string& line) { said.push_back(line); };
    }
    std::string text(const std::string& name) const {
        std::ifstream file(folder / ("jobs/night/" + name));
        std::stringstream all;
        all << file.rdbuf();
        return all.str();
    }

    const test::TemporaryFolder folder;
    Session session;
    FarmJob job;
    FrameLoopHost host;
    std::vector<std::string> said;
};

TEST_F(WriteJobTest, MeasuresTheMiddleFrameAndWritesTheFilesOfTheSystem) {
    const Status done = write_farm_job(session, job, nullptr, host);
    ASSERT_TRUE(done) << done.error().message;
    ASSERT_EQ(said.size(), 4u) << "the cost, and three files";
    EXPECT_TRUE(said[0].starts_with("frame 2: ")) << said[0];
    EXPECT_TRUE(said[0].ends_with("3 frames per process"))
        << "a small frame takes far less than 20 s: " << said[0];
    EXPECT_NE(text("shot.json").find("\"frames\": \"1-3\""), std::string::npos) << text("shot.json");
    EXPECT_NE(fs::status(folder / "jobs/night/run.sh").permissions() & fs::perms::owner_exec,
              fs::perms::none);
    EXPECT_FALSE(fs::exists(folder / "jobs/night/measured.0002.exr"));
    EXPECT_FALSE(fs::exists(folder / "out.0002.exr"));
}

TEST_F(WriteJobTest, AGivenChunkIsKeptAndNothingIsMeasured) {
    job.chunk = 2;
    ASSERT_TRUE(write_farm_job(session, job, nullptr, host));
    EXPECT_EQ(said.size(), 3u);
    EXPECT_NE(text("shot.json").find("\"seconds_per_frame\": 0.0"), std::string::npos) << text("shot.json");
    EXPECT_NE(text("shot.json").find("\"chunk\": 2"), std::string::npos) << text("shot.json");
}

TEST_F(WriteJobTest, AFolderThatCannotBeMadeAndAShotWithoutFramesAreErrors) {
    std::ofstream(folder / "jobs") << "a file";
    const Status no_folder = write_farm_job(session, job, nullptr, host);
    ASSERT_FALSE(no_folder);
    EXPECT_EQ(no_folder.error().code, ErrorCode::OutputFailed);
    EXPECT_TRUE(no_folder.error().message.starts_with("farm.folder " + job.folder + ": "))
        << no_folder.error().message;
    job.settings.source.path = folder / "none.####.exr";
    EXPECT_FALSE(write_farm_job(session, job, nullptr, host));
    EXPECT_TRUE(said.empty());
}

}  // namespace
}  // namespace petzval
