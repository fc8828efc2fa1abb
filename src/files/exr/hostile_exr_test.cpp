// Files that are broken, hostile or no files at all: one clear line, no crash, no hang, no memory.
#include "petzval/files.h"

#include "files/test_exr.h"

#include <array>
#include <cstring>
#include <ctime>
#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <OpenEXR/ImfStringAttribute.h>
#include <gtest/gtest.h>

namespace petzval {
namespace {

using test::bytes_of;
using test::quick_rgbaz;
using test::QuickPart;
using test::TemporaryFolder;
using test::write_bytes;
using test::write_quick_exr;
using testing::HasSubstr;
using testing::Not;

const Rect kWindow{0, 0, 8, 6};

void expect_refused(const std::string& path, const std::string& why, const ReadOptions& options = {}) {
    for (const auto& read : {read_frame, read_frame_header}) {
        const Result<Frame> frame = read(path, options);
        if (read == read_frame_header && frame) continue;  // a header may be sound where its pixels are not
        ASSERT_FALSE(frame) << path;
        EXPECT_EQ(frame.error().code, ErrorCode::InvalidFile);
        EXPECT_THAT(frame.error().message, HasSubstr(path));
        EXPECT_THAT(frame.error().message, HasSubstr(why));
        EXPECT_THAT(frame.error().message, Not(HasSubstr("\n")));
    }
}

std::string quick_bytes(const TemporaryFolder& folder, const std::vector<QuickPart>& parts) {
    write_quick_exr(folder / "good.exr", kWindow, parts);
    return bytes_of(folder / "good.exr");
}

std::size_t peak_memory_kib() {
    struct rusage usage = {};
    getrusage(RUSAGE_SELF, &usage);
    return std::size_t(usage.ru_maxrss);
}

TEST(HostileFile, WhatIsNoPictureIsNamedAsWhatItIs) {
    const TemporaryFolder folder;
    expect_refused(folder / "missing.exr", "No such file");
    expect_refused(folder.path(), "is a directory");
    write_bytes(folder / "empty.exr", "");
    expect_refused(folder / "empty.exr", "is empty");
    write_bytes(folder / "text.exr", "dear diary, today I rendered\n");
    expect_refused(folder / "text.exr", "is not a picture that can be read");
    ASSERT_EQ(::mkfifo((folder / "pipe.exr").c_str(), 0600), 0);
    expect_refused(folder / "pipe.exr", "not a regular file");
    expect_refused("/dev/zero", "not a regular file");
}

TEST(HostileFile, UnreadableFilesSaySo) {
    const TemporaryFolder folder;
    write_bytes(folder / "a.exr", "x");
    ::chmod((folder / "a.exr").c_str(), 0);
    const pid_t child = ::fork();
    if (child == 0) {
        // Root may read everything; nobody may not.
        if (::getuid() == 0 && ::setuid(65534) != 0) ::_exit(2);
        const Result<Frame> frame = read_frame(folder / "a.exr");
        ::_exit(!frame && frame.error().message.find("Permission denied") != std::string::npos ? 0 : 1);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
}

TEST(HostileFile, EveryTruncationOfASmallFileIsAnError) {
    const test::WithoutExrThreads quick;
    const TemporaryFolder folder;
    QuickPart tiles = quick_rgbaz();
    tiles.tile = 4;
    QuickPart left = quick_rgbaz();
    left.name = "left";
    QuickPart plain = quick_rgbaz();
    plain.compression = Imf::NO_COMPRESSION;
    for (const std::vector<QuickPart>& parts :
         {std::vector{quick_rgbaz()}, {tiles}, {left, tiles}, {plain}}) {
        std::vector<QuickPart> named = parts;
        if (named.size() > 1) named[1].name = "tiles";
        const std::string good = quick_bytes(folder, named);
        for (std::size_t length = 1; length < good.size(); ++length) {
            write_bytes(folder / "bad.exr", good.substr(0, length));
            const Result<Frame> frame = read_frame(folder / "bad.exr");
            // Only the beginning of another part's last chunk is known.
            if (frame && named.size() > 1 && length + 200 > good.size()) continue;
            ASSERT_FALSE(frame) << length << " of " << good.size();
            ASSERT_EQ(frame.error().code, ErrorCode::InvalidFile) << frame.error().message;
            ASSERT_THAT(frame.error().message, HasSubstr("bad.exr"));
        }
    }
}

TEST(HostileFile, NeitherReadingNorWritingBackAMutatedFileCrashesOrHangs) {
    const test::WithoutExrThreads quick;
    const TemporaryFolder folder;
    std::vector<std::vector<QuickPart>> files;
    for (const Imf::Compression c :
         {Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::ZIPS_COMPRESSION, Imf::PIZ_COMPRESSION,
          Imf::PXR24_COMPRESSION, Imf::B44A_COMPRESSION, Imf::DWAA_COMPRESSION}) {
        QuickPart part = quick_rgbaz();
        part.compression = c;
        part.name = "a";
        files.push_back({part});
        QuickPart tiles = part;
        tiles.tile = 4;
        tiles.name = "b";
        files.push_back({tiles, part});
    }
    files.push_back({{"",
                      "",
                      kWindow,
                      {{"Y"},
                       {"RY", Imf::HALF, [](int, int) { return 0.1; }, 2},
                       {"BY", Imf::HALF, [](int, int) { return 0.2; }, 2},
                       {"Z"}}}});
    for (const auto& parts : files) {
        const std::string good = quick_bytes(folder, parts);
        test::mutate(good, 150, [&](const std::string& bad) {
            write_bytes(folder / "bad.exr", bad);
            const std::clock_t start = std::clock();
            (void)read_frame_header(folder / "bad.exr");
            const Result<Frame> frame = read_frame(folder / "bad.exr");
            if (frame)
                (void)write_exr(folder / "out.exr", *frame);
            else
                ASSERT_THAT(frame.error().message, HasSubstr("bad.exr"));
            ASSERT_LT(double(std::clock() - start) / CLOCKS_PER_SEC, 5);
        });
    }
    EXPECT_LE(folder.files(), 3u);
}

// Replaces the value of an attribute by its name and type.
std::string with_window(std::string bytes, const std::string& name, std::array<std::int32_t, 4> window) {
    const std::size_t at = bytes.find(name + '\0' + "box2i" + '\0');
    std::memcpy(bytes.data() + at + name.size() + 1 + 6 + 4, window.data(), 16);
    return bytes;
}

TEST(HostileFile, AHugeHeaderWithoutPixelsTakesNoMemory) {
    const TemporaryFolder folder;
    const std::string good = quick_bytes(folder, {quick_rgbaz()});
    const std::size_t before = peak_memory_kib();
    write_bytes(folder / "a.exr", with_window(good, "dataWindow", {0, 0, 39999, 39999}));
    expect_refused(folder / "a.exr", "40000 x 40000 pixels, more than");
    write_bytes(folder / "a.exr", with_window(good, "dataWindow", {0, 0, 15999, 15999}));
    expect_refused(folder / "a.exr", "promises 3.1 GB of pixels");
    write_bytes(folder / "a.exr", with_window(good, "dataWindow", {-2000000000, 0, 2000000000, 0}));
    expect_refused(folder / "a.exr", "more than");
    write_bytes(folder / "a.exr", with_window(good, "displayWindow", {0, 0, 1 << 20, 1 << 20}));
    expect_refused(folder / "a.exr", "display window");
    write_bytes(folder / "a.exr", with_window(good, "dataWindow", {1 << 30, 0, (1 << 30) + 7, 5}));
    expect_refused(folder / "a.exr", "too far from pixel 0,0");
    const DeepPicture deep(1, 1, {0, 1}, {{{1, 1, 1, 1}, 2, 2}});
    ASSERT_TRUE(write_deep_exr(folder / "deep.exr", Place::whole({0, 0, 1, 1}), deep));
    write_bytes(folder / "a.exr",
                with_window(bytes_of(folder / "deep.exr"), "dataWindow", {0, 0, 15999, 15999}));
    expect_refused(folder / "a.exr", "promises 1.0 GB of pixels");
    EXPECT_LT(peak_memory_kib() - before, 50000u);
}

TEST(HostileFile, EmptyWindowsAreErrorsAndSinglePixelsAreNot) {
    const TemporaryFolder folder;
    const std::string good = quick_bytes(folder, {quick_rgbaz()});
    write_bytes(folder / "a.exr", with_window(good, "dataWindow", {0, 0, -1, -1}));
    expect_refused(folder / "a.exr", "data window is empty");
    write_bytes(folder / "a.exr", with_window(good, "displayWindow", {4, 4, 2, 9}));
    expect_refused(folder / "a.exr", "display window is empty");
    for (const Rect window : {Rect{0, 0, 1, 1}, Rect{0, 0, 1, 33}, Rect{0, 0, 33, 1}}) {
        write_quick_exr(folder / "a.exr", window, {quick_rgbaz(window)});
        const Result<Frame> frame = read_frame(folder / "a.exr");
        ASSERT_TRUE(frame) << frame.error().message;
        EXPECT_TRUE(write_exr(folder / "b.exr", *frame));
    }
}

TEST(HostileFile, AnAttributeLongerThanTheFileIsRefused) {
    const TemporaryFolder folder;
    QuickPart part = quick_rgbaz();
    part.with = [](Imf::Header& h) { h.insert("note", Imf::StringAttribute("hello")); };
    std::string bytes = quick_bytes(folder, {part});
    const std::size_t at = bytes.find(std::string("note\0string\0", 12)) + 12;
    for (const std::int32_t size : {0x7fffffff, -1, 1 << 20}) {
        std::memcpy(bytes.data() + at, &size, 4);
        write_bytes(folder / "a.exr", bytes);
        expect_refused(folder / "a.exr", "'note' is longer than the file");
    }
}

TEST(HostileFile, AFileThatIsStillBeingWrittenIsIncomplete) {
    const TemporaryFolder folder;
    std::string bytes = quick_bytes(folder, {quick_rgbaz({0, 0, 8, 64})});
    // The table of chunks follows the header, whose end is a 0 after the last attribute; zero its last entry.
    std::uint64_t first_chunk = 0;
    std::size_t table = 0;
    for (std::size_t i = 300; i + 8 < bytes.size() && !table; ++i) {
        std::memcpy(&first_chunk, bytes.data() + i, 8);
        if (first_chunk == i + std::size_t{4} * 8) table = i;  // 64 lines of ZIP are four chunks
    }
    ASSERT_NE(table, 0u);
    std::memset(bytes.data() + table + 24, 0, 8);
    write_bytes(folder / "a.exr", bytes);
    expect_refused(folder / "a.exr", "incomplete");
}

TEST(HostileFile, NamesFromAFileCannotReachTheTerminalAsControlCodes) {
    const TemporaryFolder folder;
    write_quick_exr(folder / "a.exr", kWindow, {{"", "", kWindow, {{"R"}, {"G"}, {"B"}, {"evil\033[2J\n"}}}});
    const Result<Frame> frame = read_frame(folder / "a.exr");
    ASSERT_FALSE(frame);
    EXPECT_THAT(frame.error().message, HasSubstr("evil?[2J?"));
}

TEST(HostileFile, NoDepthAndNoColourAreSaidWithWhatThereIs) {
    const TemporaryFolder folder;
    write_quick_exr(folder / "a.exr", kWindow, {{"", "", kWindow, {{"R"}, {"G"}, {"B"}, {"mask"}}}});
    expect_refused(folder / "a.exr", "no depth channel");
    ReadOptions no_depth;
    no_depth.need_depth = false;
    const Result<Frame> frame = read_frame(folder / "a.exr", no_depth);
    ASSERT_TRUE(frame);
    EXPECT_TRUE(frame->depth.empty());
    write_quick_exr(folder / "a.exr", kWindow, {{"", "", kWindow, {{"Z"}, {"mask"}}}});
    expect_refused(folder / "a.exr", "no colour");
    EXPECT_TRUE(read_frame_header(folder / "a.exr"));
}

TEST(HostileFile, AnInputReplacedByAnotherPictureIsNoticedBeforeAnythingIsWritten) {
    const TemporaryFolder folder;
    QuickPart a = quick_rgbaz(), b = quick_rgbaz();
    a.name = "a", b.name = "b";
    b.channels.resize(3);
    write_quick_exr(folder / "a.exr", kWindow, {b, a});
    const Result<Frame> frame = read_frame(folder / "a.exr");
    ASSERT_TRUE(frame);
    write_quick_exr(folder / "b.exr", kWindow, {quick_rgbaz()});
    write_bytes(folder / "a.exr", bytes_of(folder / "b.exr"));
    const Status written = write_exr(folder / "c.exr", *frame);
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().code, ErrorCode::ReadFailed) << "a shorter file: another try may succeed";
    EXPECT_EQ(folder.files(), 2u);
}

TEST(HostileFile, AnInputThatChangesBeforeItIsWrittenBackIsAnErrorAndLeavesNoFile) {
    const TemporaryFolder folder;
    write_quick_exr(folder / "a.exr", kWindow, {quick_rgbaz()});
    const Result<Frame> frame = read_frame(folder / "a.exr");
    ASSERT_TRUE(frame);
    write_bytes(folder / "a.exr", "gone");
    const Status written = write_exr(folder / "b.exr", *frame);
    ASSERT_FALSE(written);
    EXPECT_THAT(written.error().message, HasSubstr("a.exr"));
    EXPECT_EQ(folder.files(), 1u);
}

}  // namespace
}  // namespace petzval
