#include "base/user_folder.h"

#include <cstdlib>

#include <gtest/gtest.h>

namespace petzval {
namespace {

struct UserFolderTest : testing::Test {
    void SetUp() override {
        home = std::getenv("HOME") ? std::getenv("HOME") : "";
        ::setenv("HOME", "/home/me", 1);
        clear();
    }
    void TearDown() override {
        clear();
        ::setenv("HOME", home.c_str(), 1);
    }
    static void clear() {
        ::unsetenv("PETZVAL_TEST_FOLDER");
        ::unsetenv("PETZVAL_TEST_XDG");
    }
    static std::string folder() {
        return user_folder("PETZVAL_TEST_FOLDER", "PETZVAL_TEST_XDG", "/.cache", "/petzval/kernels");
    }
    std::string home;
};

TEST_F(UserFolderTest, OwnVariableWinsOverXdgAndHome) {
    EXPECT_EQ(folder(), "/home/me/.cache/petzval/kernels");
    ::setenv("PETZVAL_TEST_XDG", "/fast", 1);
    EXPECT_EQ(folder(), "/fast/petzval/kernels");
    ::setenv("PETZVAL_TEST_FOLDER", "here", 1);
    EXPECT_EQ(folder(), "here");
}

TEST_F(UserFolderTest, RelativeXdgFoldersAndEmptyVariablesAreIgnored) {
    ::setenv("PETZVAL_TEST_XDG", "fast", 1);
    ::setenv("PETZVAL_TEST_FOLDER", "", 1);
    EXPECT_EQ(folder(), "/home/me/.cache/petzval/kernels");
    ::unsetenv("HOME");
    EXPECT_EQ(folder(), "");
}

}  // namespace
}  // namespace petzval
