#include "files/output_file.h"

#include "petzval/files.h"

#include "files/test_exr.h"

#include <array>
#include <csignal>
#include <filesystem>
#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

namespace petzval {
namespace {

using test::bytes_of;
using test::TemporaryFolder;
using test::write_bytes;
using testing::HasSubstr;

Frame small_frame(int size) {
    Frame frame;
    frame.place = Place::whole({0, 0, size, size});
    frame.colour = Picture(size, size);
    for (std::size_t i = 0; i < frame.colour.size(); ++i)
        frame.colour.pixels()[i] = {float(i * 7919 % 1009), float(i * 104729 % 997), float(i % 13), 1};
    return frame;
}

TEST(OutputFile, NothingIsThereBeforeCommitAndNothingBesideItAfterwards) {
    const TemporaryFolder folder;
    write_bytes(folder / "a", "old");
    {
        auto file = OutputFile::create(folder / "a", true);
        ASSERT_TRUE(file);
        ASSERT_TRUE((*file)->write_at(0, "newer", 5));
        EXPECT_EQ(bytes_of(folder / "a"), "old");
        EXPECT_EQ(folder.files(), 2u);
        ASSERT_TRUE((*file)->commit());
    }
    EXPECT_EQ(bytes_of(folder / "a"), "newer");
    EXPECT_EQ(folder.files(), 1u);
}

TEST(OutputFile, AnAbandonedFileLeavesNoTrace) {
    const TemporaryFolder folder;
    write_bytes(folder / "a", "old");
    {
        auto file = OutputFile::create(folder / "a", true);
        ASSERT_TRUE((*file)->write_at(0, "new", 3));
    }
    EXPECT_EQ(bytes_of(folder / "a"), "old");
    EXPECT_EQ(folder.files(), 1u);
}

TEST(OutputFile, AFileThatAppearedMeanwhileIsNotOverwrittenWhenItMayNotBe) {
    const TemporaryFolder folder;
    auto file = OutputFile::create(folder / "a", false);
    ASSERT_TRUE(file);
    write_bytes(folder / "a", "theirs");
    const Status committed = (*file)->commit();
    ASSERT_FALSE(committed);
    EXPECT_EQ(committed.error().code, ErrorCode::OutputFailed);
    EXPECT_EQ(bytes_of(folder / "a"), "theirs");
}

TEST(OutputFile, ALinkIsFollowedAndTheRightsOfTheOldFileAreKept) {
    const TemporaryFolder folder;
    write_bytes(folder / "real", "old");
    ::chmod((folder / "real").c_str(), 0640);
    std::filesystem::create_symlink(folder / "real", folder / "link");
    auto file = OutputFile::create(folder / "link", true);
    ASSERT_TRUE((*file)->write_at(0, "new", 3) && (*file)->commit());
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
    EXPECT_EQ(bytes_of(folder / "real"), "new");
    struct stat status = {};
    ::stat((folder / "real").c_str(), &status);
    EXPECT_EQ(status.st_mode & 0777, 0640u);
}

TEST(OutputFile, PlacesThatCannotBeWrittenAreErrorsThatNameThem) {
    const TemporaryFolder folder;
    for (const std::string& path : {folder.path(), folder / "no/such/folder/a.exr", std::string("/dev/null"),
                                    std::string("/proc/a.exr"), std::string()}) {
        const auto file = OutputFile::create(path, true);
        ASSERT_FALSE(file) << path;
        EXPECT_EQ(file.error().code, ErrorCode::OutputFailed);
        EXPECT_THAT(file.error().message, HasSubstr(path));
    }
    struct stat status = {};
    ASSERT_EQ(::stat("/dev/null", &status), 0);
    EXPECT_TRUE(S_ISCHR(status.st_mode));
}

TEST(OutputFile, ThroughALinkToNothingTheFileIsWrittenWhereItPoints) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "there");
    std::filesystem::create_symlink("there/new", folder / "link");
    std::filesystem::create_symlink(folder / "link", folder / "second");
    auto file = OutputFile::create(folder / "second", true);
    ASSERT_TRUE(file && (*file)->write_at(0, "new", 3) && (*file)->commit());
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "second"));
    EXPECT_EQ(bytes_of(folder / "there/new"), "new");
}

TEST(OutputFile, ALinkToItselfOrIntoNoFolderIsNeitherFollowedNorReplaced) {
    const TemporaryFolder folder;
    std::filesystem::create_symlink(folder / "circle", folder / "circle");
    std::filesystem::create_symlink(folder / "no/such", folder / "astray");
    for (const auto& [name, says] : {std::pair{"circle", "leads to itself"}, {"astray", "No such"}}) {
        const auto file = OutputFile::create(folder / name, true);
        ASSERT_FALSE(file);
        EXPECT_THAT(file.error().message, HasSubstr(says));
        EXPECT_TRUE(std::filesystem::is_symlink(folder / name));
    }
    EXPECT_EQ(folder.files(), 2u);
}

TEST(OutputFile, WhatADeadProcessLeftIsRemovedAndWhatALivingOneWritesIsNot) {
    const TemporaryFolder folder;
    const TemporaryFolder elsewhere;
    write_bytes(folder / ".a.exr.999999-0.unfinished", "left");
    for (const char* theirs : {".a.unfinished", "a.1-2.unfinished", ".a.x-2.unfinished", "b.exr"})
        write_bytes(folder / theirs, "theirs");
    std::filesystem::create_symlink(elsewhere.path(), folder / ".l.1-1.unfinished");
    int from_child[2], to_child[2];
    ASSERT_TRUE(::pipe(from_child) == 0 && ::pipe(to_child) == 0);
    const pid_t child = ::fork();
    char byte = 0;
    if (child == 0) {
        const auto file = OutputFile::create(folder / "c.exr", true);
        if (::write(from_child[1], "x", 1) != 1 || ::read(to_child[0], &byte, 1) != 1) ::_exit(1);
        ::_exit(file && (*file)->commit() ? 0 : 1);
    }
    ASSERT_EQ(::read(from_child[0], &byte, 1), 1);
    EXPECT_FALSE(std::filesystem::exists(folder / ".a.exr.999999-0.unfinished"));  // the child saw to it
    write_bytes(folder / ".d.exr.999999-1.unfinished", "left");
    {
        const auto file = OutputFile::create(folder / "e.exr", true);
        EXPECT_FALSE(std::filesystem::exists(folder / ".d.exr.999999-1.unfinished"));
    }
    ASSERT_EQ(::write(to_child[1], "x", 1), 1);
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
    EXPECT_TRUE(std::filesystem::exists(folder / "c.exr"));
    EXPECT_EQ(folder.files(), 6u);
    for (const int end : {from_child[0], from_child[1], to_child[0], to_child[1]}) ::close(end);
}

TEST(Outputs, NeverReplaceAnInputOrEachOther) {
    const TemporaryFolder folder;
    write_bytes(folder / "in", "in");
    std::filesystem::create_symlink(folder / "in", folder / "link");
    std::filesystem::create_hard_link(folder / "in", folder / "twin");
    for (const char* name : {"in", "link", "twin"}) {
        const Status fine = check_outputs({folder / name}, {folder / "in"});
        ASSERT_FALSE(fine) << name;
        EXPECT_THAT(fine.error().message, HasSubstr("would replace the input"));
    }
    const Status twice = check_outputs({folder / "new", folder.path() + "/./new"}, {});
    ASSERT_FALSE(twice);
    EXPECT_THAT(twice.error().message, HasSubstr("would replace the output"));
    std::filesystem::create_symlink(folder / "new", folder / "to new");
    EXPECT_FALSE(check_outputs({folder / "new", folder / "to new"}, {}));
    EXPECT_TRUE(check_outputs({folder / "new", "-", "", "-"}, {folder / "in", "-"}));
    EXPECT_TRUE(check_outputs({"-.exr", ""}, {"-"}));
    EXPECT_FALSE(check_outputs({"-.exr", "-"}, {}));
    EXPECT_TRUE(check_outputs({folder / "new"}, {"new"}));  // a word that is not a file
}

TEST(Outputs, PlacesThatCannotBeWrittenAreKnownBeforehand) {
    const TemporaryFolder folder;
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
    std::filesystem::create_symlink(folder / "link", folder / "link");
    for (const std::string& path : {folder.path(), folder / "no/a.exr", folder / "pipe", folder / "link"}) {
        const Status fine = check_outputs({path}, {});
        ASSERT_FALSE(fine) << path;
        EXPECT_EQ(fine.error().code, ErrorCode::OutputFailed);
        EXPECT_THAT(fine.error().message, HasSubstr(path));
        EXPECT_FALSE(write_text(path, "text")) << path;
    }
    EXPECT_EQ(folder.files(), 2u);
}

// A limit on the size of files stands for a full disk: writes fail half-way with the same kind of error.
class FullDisk {
public:
    explicit FullDisk(rlim_t bytes) {
        ::signal(SIGXFSZ, SIG_IGN);
        getrlimit(RLIMIT_FSIZE, &before_);
        const struct rlimit limit = {bytes, before_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FullDisk() { setrlimit(RLIMIT_FSIZE, &before_); }
    FullDisk(const FullDisk&) = delete;
    FullDisk& operator=(const FullDisk&) = delete;

private:
    struct rlimit before_ = {};
};

TEST(OutputFile, AFullDiskLeavesTheOldFileAndNothingElse) {
    const TemporaryFolder folder;
    const Frame frame = small_frame(300);
    ASSERT_TRUE(write_exr(folder / "in.exr", frame));
    ReadOptions no_depth;
    no_depth.need_depth = false;
    WriteOptions raw;
    raw.compression = "none";
    const Result<Frame> carried = read_frame(folder / "in.exr", no_depth);
    ASSERT_TRUE(carried);
    for (const char* name : {"a.exr", "b.exr", "c.exr", "d.exr", "e.png"}) write_bytes(folder / name, "old");
    const DeepPicture deep(1, 1, {0, 9999}, std::vector<DeepSample>(9999, {{1, 2, 3, 1}, 1, 2}));
    const Plane plane(300, 300, 1);
    PngPixels png{300, 300, 3, 16, {}};
    for (unsigned i = 0; i < 300 * 300 * 3; ++i) png.samples.push_back(std::uint16_t(i * 40503));
    for (const rlim_t bytes : {1u, 100u, 1200u}) {
        const FullDisk full(bytes);
        const std::array failures{
            write_exr(folder / "a.exr", frame), write_exr(folder / "b.exr", *carried),
            write_exr_planes(folder / "c.exr", {{0, 0, 9, 9}, frame.place.data_window}, {{"Z", plane}}, raw),
            write_deep_exr(folder / "d.exr", Place::whole({0, 0, 1, 1}), deep, raw),
            write_png(folder / "e.png", png)};
        for (const Status& failure : failures) {
            ASSERT_FALSE(failure);
            EXPECT_EQ(failure.error().code, ErrorCode::OutputFailed) << failure.error().message;
            EXPECT_THAT(failure.error().message, HasSubstr("File too large"));
        }
    }
    for (const char* name : {"a.exr", "b.exr", "c.exr", "d.exr", "e.png"})
        EXPECT_EQ(bytes_of(folder / name), "old");
    EXPECT_EQ(folder.files(), 6u);
}

TEST(OutputFile, AFolderIsMadeWithItsParentsUnlessAFileIsInItsPlace) {
    const TemporaryFolder folder;
    const std::string deep = folder / "a/b/c";
    EXPECT_TRUE(make_folder(deep));
    EXPECT_TRUE(make_folder(deep));
    EXPECT_TRUE(std::filesystem::is_directory(deep));
    ASSERT_TRUE(write_text(folder / "file", "text"));
    EXPECT_EQ(make_folder(folder / "file").error().code, ErrorCode::OutputFailed);
    EXPECT_EQ(make_folder(folder / "file/below").error().code, ErrorCode::OutputFailed);
}

TEST(OutputFile, ASignalHandlerCanRemoveWhatIsNotFinished) {
    const TemporaryFolder folder;
    const pid_t child = ::fork();
    if (child == 0) {
        ::signal(SIGTERM, [](int) {
            remove_unfinished_outputs();
            ::_exit(143);
        });
        auto a = OutputFile::create(folder / "a.exr", true), b = OutputFile::create(folder / "b.exr", true);
        if (!a || !b || folder.files() != 2) ::_exit(1);
        ::raise(SIGTERM);
        ::_exit(2);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 143);
    EXPECT_EQ(folder.files(), 0u);
}

}  // namespace
}  // namespace petzval
