// Estimates the work of the real-time pass, so that it can be cut into submissions.
#pragma once

#include "device/vulkan/realtime/pass.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace petzval::device::vulkan {

// Multiply-adds of a group in each step, or an equivalent time: estimates that a Pace corrects.
class RealtimeWork {
public:
    RealtimeWork(std::size_t tiles_x, std::size_t tiles_y, const RealtimeOptics& optics);

    // Takes the contents of the pass's lamps_kept() and lamp_boxes(), once step kReach has run. Until then
    // there are no lamps.
    void take_lamps(const std::uint32_t* kept, const std::int32_t* boxes);
    // The most lamps that any tile's box holds.
    std::uint64_t most_lamps() const { return most_lamps_; }
    std::uint64_t of_group(RealtimePass::Step step, std::uint32_t x, std::uint32_t y) const;

private:
    const std::size_t tiles_x_, tiles_y_;
    std::uint64_t most_lamps_ = 0;
    std::uint64_t tiles_around_ = 0;       // that a tile looks at
    std::vector<std::uint64_t> of_lamps_;  // of a group, by tile
};

}  // namespace petzval::device::vulkan
