#include "files/wording.h"

#include <gtest/gtest.h>

namespace petzval {
namespace {

TEST(Unreadable, IsNoDamageWhereADecoderHasNoMemory) {
    for (const char* said :
         {"Failed to allocate memory for scanline buffers", "Insufficient memory (case 4)", "Out of memory",
          "insufficient memory", "malloc(8) failed", "No space for data buffer at scanline 3"}) {
        const Error error = unreadable("in.exr", said);
        EXPECT_EQ(error.code, ErrorCode::OutOfMemory) << said;
        EXPECT_EQ(error.message, std::string("in.exr: no memory left to read it: ") + said);
    }
}

TEST(Unreadable, IsDamageWhereAFileAsksForMoreThanItMay) {
    for (const char* said :
         {"Memory allocation of 8 bytes is beyond the 4 byte limit defined in open options",
          "unknown chunk exceeds memory limits", "it ends too early"})
        EXPECT_EQ(unreadable("in.tif", said).code, ErrorCode::InvalidFile) << said;
}

}  // namespace
}  // namespace petzval
