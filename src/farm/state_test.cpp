#include "petzval/farm/state.h"

#include "base/temporary_folder.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

namespace petzval {
namespace {

namespace fs = std::filesystem;
using State = FarmFrame::State;

struct FarmStateTest : testing::Test {
    void SetUp() override {
        shot.folder = folder.string();
        shot.name = "job";
        shot.command = {"petzval", "defocus"};
        shot.frames = {1, 2, 3, 4};
    }
    std::string text(const char* name) const {
        std::ifstream file(folder / name);
        std::stringstream all;
        all << file.rdbuf();
        return all.str();
    }
    // A program of that name in a folder that is the whole $PATH.
    void fake(const std::string& name, const std::string& body) const {
        const fs::path program = folder / "bin" / name;
        fs::create_directories(program.parent_path());
        std::ofstream(program) << "#!/bin/sh\n" << body << "\n";
        fs::permissions(program, fs::perms::owner_all);
        setenv("PATH", program.parent_path().c_str(), 1);
    }

    const test::TemporaryFolder own;
    const fs::path folder = own.path();
    FarmShot shot;
};

std::vector<FarmFrame> frames_of_all_states() {
    std::vector<FarmFrame> frames(4);
    for (int i = 0; i < 4; ++i) frames[std::size_t(i)].frame = i + 1;
    frames[0].state = State::Complete, frames[0].seconds = 3, frames[0].record = R"({"frame":1})";
    frames[1].state = State::Failed, frames[1].why = "no depth", frames[1].may_pass = false;
    frames[2].state = State::Damaged, frames[2].seconds = 5, frames[2].peak_memory_bytes = 7;
    return frames;
}

TEST_F(FarmStateTest, ASummaryCountsStatesAndNamesFramesToTry) {
    const FarmSummary sum = farm_summary(frames_of_all_states());
    EXPECT_EQ(sum.frames.at(State::Complete), std::vector{1});
    EXPECT_EQ(sum.failures.at("no depth"), std::vector{2});
    EXPECT_EQ(sum.to_try, (std::vector{3, 4})) << "another try does not help frame 2";
    EXPECT_EQ(sum.incomplete, 3u);
    EXPECT_EQ(sum.seconds, (std::vector<double>{3, 5}));
    EXPECT_EQ(sum.slowest, 3);
    EXPECT_EQ(sum.peak_bytes, 7u);
}

TEST_F(FarmStateTest, TheTextCountsFramesByStateAndNamesFailures) {
    FarmSummary sum = farm_summary(frames_of_all_states());
    shot.frames = {1, 2, 3, 4}, shot.memory_bytes = 3u << 20;
    sum.peak_bytes = (1u << 20) + 1;
    const std::string text = farm_text(shot, sum);
    for (const char* line :
         {": 4 frames, 1-4\n", "  complete  1  1\n", "  failed    1  2\n", "frame 2: no depth\n",
          "median 5, slowest 5 (frame 3)\n", "memory: peak 2M of 3M\n"})
        EXPECT_NE(text.find(line), std::string::npos) << text;
}

TEST_F(FarmStateTest, IncompleteFramesAreCountedAndTheirCommandsNamed) {
    const FarmSummary sum = farm_summary(frames_of_all_states());
    EXPECT_EQ(farm_incomplete_text(shot, sum), "3 of 4 frames are not complete; " + shot.folder +
                                                   "/left has the commands for frames to try again");
    FarmSummary hopeless = sum;
    hopeless.to_try.clear();
    EXPECT_EQ(farm_incomplete_text(shot, hopeless), "3 of 4 frames are not complete");
    EXPECT_EQ(farm_incomplete_text(shot, {}), "");
}

TEST_F(FarmStateTest, TheRecordNamesTheJobAndEachFrame) {
    const std::string record = farm_record("farm status", shot, frames_of_all_states());
    EXPECT_NE(record.find(R"("verb":"farm status")"), std::string::npos) << record;
    EXPECT_NE(record.find("\"job\":\"" + shot.folder + "\",\"frames\":[{\"frame\":1,"), std::string::npos)
        << record;
}

TEST_F(FarmStateTest, RecordsAreMergedAndCommandsLeftForFramesToTry) {
    auto frames = frames_of_all_states();
    ASSERT_TRUE(merge_farm_records(shot, frames));
    EXPECT_EQ(text("report.jsonl"), "{\"frame\":1}\n");
    EXPECT_EQ(text("left"), shot.folder + "/run.sh 3\n" + shot.folder + "/run.sh 4\n");
    for (FarmFrame& frame : frames) frame.state = State::Complete;
    ASSERT_TRUE(merge_farm_records(shot, frames));
    EXPECT_FALSE(fs::exists(folder / "left"));
}

TEST_F(FarmStateTest, AnAnswerThatIsMissingIsNullInTheRecord) {
    const std::string record = record_of_frames(frames_of_all_states());
    EXPECT_NE(record.find(R"("frame":2,"state":"failed","output":"","error":"no depth","may_pass":false)"),
              std::string::npos)
        << record;
    EXPECT_NE(record.find(R"("process":null,"seconds":null)"), std::string::npos) << record;
}

TEST_F(FarmStateTest, SlurmGetsAJobOnceAndItsStateIsCounted) {
    EXPECT_EQ(slurm_submit(shot).error().code, ErrorCode::InvalidArgument) << "no job for Slurm";
    std::ofstream(folder / "petzval.sbatch") << "#!/bin/sh\n";
    fake("sbatch", "echo \"47;cluster\"");
    fake("squeue", "printf '47 PENDING\\n47 PENDING\\n47 RUNNING\\n8 RUNNING\\n'");
    const auto id = slurm_submit(shot, "0-1");
    ASSERT_TRUE(id) << id.error().message;
    EXPECT_EQ(*id, "47");
    EXPECT_EQ(slurm_queue(shot).value(), "2 PENDING, 1 RUNNING");
    const auto again = slurm_submit(shot);
    ASSERT_FALSE(again);
    EXPECT_NE(again.error().message.find("still in Slurm's queue"), std::string::npos);
    fake("squeue", "exit 3");
    EXPECT_EQ(slurm_queue(shot).error().code, ErrorCode::OutputFailed);
    fs::remove(folder / "bin" / "squeue");
    EXPECT_EQ(slurm_queue(shot).error().code, ErrorCode::Unsupported);
}

TEST_F(FarmStateTest, AJobIsNamedAfterItsFolderAndItsProgramMayRun) {
    EXPECT_EQ(farm_job_name("/mnt/my job.v2"), "my_job_v2");
    EXPECT_EQ(farm_job_name("/mnt/a"), "petzval_a");
    const auto path = write_farm_file(shot, {"run.sh", "#!/bin/sh\n", true});
    ASSERT_TRUE(path);
    EXPECT_EQ(*path, shot.folder + "/run.sh");
    EXPECT_NE(fs::status(*path).permissions() & fs::perms::owner_exec, fs::perms::none);
}

TEST_F(FarmStateTest, CostDecidesChunkAndMemoryUnlessTheUserGaveIt) {
    FarmShot job = farm_shot_in(shot.folder + "/./my job/");
    EXPECT_EQ(job.folder, shot.folder + "/my job");
    EXPECT_EQ(job.name, "my_job");
    job.frames = std::vector<int>(100);
    set_cost(job, 20, std::size_t(1) << 30);
    EXPECT_EQ(job.chunk, 3) << "a minute";
    EXPECT_EQ(job.memory_bytes, std::size_t(5) << 28) << "a quarter more than 1 GiB";
    set_cost(job, 1000, std::size_t(1) << 40);
    EXPECT_EQ(job.chunk, 1);
    EXPECT_EQ(job.memory_bytes, std::size_t(5) << 28) << "what is given stays";
    FarmShot small;
    small.frames = {1};
    set_cost(small, 1, 1000);
    EXPECT_EQ(small.memory_bytes, std::size_t(256) << 20) << "the least";
}

}  // namespace
}  // namespace petzval
