#include "base/whole_file.h"

#include "base/temporary_folder.h"

#include <cerrno>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

namespace petzval {
namespace {

TEST(WholeFile, IsReadToOneByteMoreThanAsked) {
    const test::TemporaryFolder folder;
    const std::string path = folder / "text.txt";
    const std::string text(50000, 'x');
    std::ofstream(path) << text;
    EXPECT_EQ(*text_of_file(path, 1 << 20), text);
    EXPECT_EQ(*text_of_file(path, text.size()), text);
    EXPECT_EQ(text_of_file(path, 99)->size(), 100u);
}

TEST(WholeFile, ThatIsMissingIsWrongInput) {
    const auto text = text_of_file("/nowhere/look.json", 99);
    ASSERT_FALSE(text);
    EXPECT_EQ(text.error().code, ErrorCode::InvalidFile);
    EXPECT_EQ(text.error().message, "/nowhere/look.json: cannot be read: No such file or directory");
}

// A kernel's file that answers every read at its start with EIO.
TEST(WholeFile, ThatTheSystemFailsToReadMayBeReadLater) {
    const auto text = text_of_file("/proc/self/mem", 99);
    ASSERT_FALSE(text);
    EXPECT_EQ(text.error().code, ErrorCode::ReadFailed);
    EXPECT_EQ(text.error().message, "/proc/self/mem: cannot be read: Input/output error");
}

TEST(WholeFile, IsTriedAgainAfterErrorsThatPass) {
    for (const int passing : {EIO, ESTALE, EMFILE, ENOMEM, ETIMEDOUT})
        EXPECT_EQ(unreadable("a", passing).code, ErrorCode::ReadFailed) << passing;
    for (const int lasting : {ENOENT, EACCES, EISDIR, ELOOP})
        EXPECT_EQ(unreadable("a", lasting).code, ErrorCode::InvalidFile) << lasting;
}

}  // namespace
}  // namespace petzval
