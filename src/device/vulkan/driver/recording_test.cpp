#include "device/vulkan/driver/recording.h"

#include "petzval/image.h"

#include "device/failure.h"
#include "device/vulkan/driver/test_context.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace petzval::device::vulkan {
namespace {

TEST(Recording, BringsBackWhatItTook) {
    const auto context = any_context();
    if (!context) GTEST_SKIP() << "no Vulkan device";
    std::vector<std::uint32_t> words(100000);
    std::iota(words.begin(), words.end(), 7u);
    Recording recording(*context);
    const Piece there = recording.uploaded(std::span<const std::uint32_t>(words));
    const std::size_t bytes = words.size() * sizeof(std::uint32_t);
    const std::byte* const back = recording.downloaded(there, bytes);
    recording.run();
    EXPECT_TRUE(std::equal(back, back + bytes, reinterpret_cast<const std::byte*>(words.data())));
}

// Two groups of words, one summed into the other by as many passes as asked for.
struct Sums {
    static constexpr std::uint32_t kPixels = 256;
    explicit Sums(Context& context)
        : recording(context),
          program(context.program(Shader::GlareSum)),
          light(recording.uploaded(std::span<const Rgba>(std::vector<Rgba>(kPixels)))),
          sum(context.heap().allocate(Kind::OnDevice, 4 * sizeof(Rgba))) {}
    void add() { recording.pass("sum light", program, {&light, &sum}, kPixels, {4}); }

    Recording recording;
    const Program& program;
    const Piece light, sum;
};

// Wide drafts have more than a pool of descriptors or of times holds.
TEST(Recording, HoldsAnyNumberOfPasses) {
    auto context = watched_context();
    if (!context) context = any_context();
    if (!context) GTEST_SKIP() << "no Vulkan device";
    context->time_passes();
    constexpr int kPasses = 150;
    Sums sums(*context);
    for (int i = 0; i < kPasses; ++i) sums.add();
    sums.recording.run();
    ASSERT_EQ(context->pass_times().size(), context->times_passes() ? 1u : 0u);
    for (const PassTime& pass : context->pass_times()) EXPECT_EQ(pass.runs, kPasses);
}

// The layer reports a dispatch recorded beside the others that writes the previous dispatch's target, and
// reports nothing for pass().
TEST(Recording, NoPassOverwritesWhatAnotherIsWriting) {
    for (const bool plants : {false, true}) {
        const auto context = closely_watched_context();
        if (!context) GTEST_SKIP() << "no Vulkan device, or no validation layer that sees it";
        Sums sums(*context);
        sums.add(), sums.add();
        if (plants) context->vk().vkCmdDispatch(sums.recording.commands(), 4, 1, 1);
        std::string said;
        try {
            sums.recording.run();
        } catch (const Failed& failed) {
            said = failed.error.message;
        }
        EXPECT_EQ(said.find("SYNC-HAZARD-WRITE-AFTER-WRITE") != std::string::npos, plants) << said;
    }
}

}  // namespace
}  // namespace petzval::device::vulkan
