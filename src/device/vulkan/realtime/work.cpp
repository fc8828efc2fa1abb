#include "device/vulkan/realtime/work.h"

#include "engine/gather/realtime_plan.h"

#include <algorithm>
#include <bit>

namespace petzval::device::vulkan {
namespace {

constexpr std::uint64_t kInvocations = 64;  // of a group

}  // namespace

RealtimeWork::RealtimeWork(std::size_t tiles_x, std::size_t tiles_y, const RealtimeOptics& optics)
    : tiles_x_(tiles_x), tiles_y_(tiles_y), of_lamps_(tiles_x_ * tiles_y_) {
    // The same rule as in shaders/realtime_reach.comp.
    const auto across = [](float radius_px) {
        return 2 * std::uint64_t((float(engine::LampKernels::kHalf) * radius_px + 2) / 16 + 1) + 1;
    };
    tiles_around_ = across(optics.most_px) * across(optics.most_px * optics.aspect);
}

void RealtimeWork::take_lamps(const std::uint32_t* kept, const std::int32_t* boxes) {
    constexpr std::uint64_t kOfLamp = 600, kOfTile = 80;
    // Sum over all tiles above and on the left.
    const std::size_t across = tiles_x_ + 1;
    std::vector<std::uint64_t> sums(across * (tiles_y_ + 1));
    for (std::size_t y = 0; y < tiles_y_; ++y)
        for (std::size_t x = 0; x < tiles_x_; ++x) {
            const std::uint32_t* const cells = kept + 4 * (y * tiles_x_ + x);
            const std::size_t i = y * across + x;
            sums[i + across + 1] = sums[i + 1] + sums[i + across] - sums[i] +
                                   std::uint64_t(std::popcount(cells[0]) + std::popcount(cells[1]));
        }
    for (std::size_t tile = 0; tile < of_lamps_.size(); ++tile, boxes += 4) {
        if (boxes[3] == 0) continue;
        const auto x0 = std::size_t(boxes[0]), y0 = std::size_t(boxes[1]);
        const std::size_t x1 = x0 + std::size_t(boxes[2]), y1 = y0 + std::size_t(boxes[3] / boxes[2]);
        const std::uint64_t lamps =
            sums[y1 * across + x1] - sums[y0 * across + x1] - sums[y1 * across + x0] + sums[y0 * across + x0];
        most_lamps_ = std::max(most_lamps_, lamps);
        of_lamps_[tile] = kInvocations * kOfLamp * lamps + kOfTile * (x1 - x0) * (y1 - y0);
    }
}

std::uint64_t RealtimeWork::of_group(RealtimePass::Step step, std::uint32_t x, std::uint32_t y) const {
    switch (step) {
        case RealtimePass::kMeasure:
            return kInvocations * 40;
        case RealtimePass::kSplit:
            return kInvocations * 2000;
        case RealtimePass::kReach:
            return kInvocations * 16 * tiles_around_;
        case RealtimePass::kGather:
            return kInvocations * 20000;
        default:
            return kInvocations * 5000 + of_lamps_[y / 2 * tiles_x_ + x / 2];
    }
}

}  // namespace petzval::device::vulkan
