// What the pass for real time has to do, so that it can be cut.
#pragma once

#include "device/vulkan/realtime_pass.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace petzval::device::vulkan {

// Multiply-adds that a group of each step takes, and what takes as long: estimates, to be set right by a
// Pace.
class RealtimeWork {
public:
    RealtimeWork(std::size_t tiles_x, std::size_t tiles_y, const RealtimeOptics& optics);

    // Once step kReach has run: what is in the pass's lamps_kept() and lamp_boxes(). Until then there are
    // none.
    void take_lamps(const std::uint32_t* kept, const std::int32_t* boxes);
    std::uint64_t of_group(RealtimePass::Step step, std::uint32_t x, std::uint32_t y) const;

private:
    const std::size_t tiles_x_, tiles_y_;
    std::uint64_t tiles_around_ = 0;       // that a tile looks at
    std::vector<std::uint64_t> of_lamps_;  // of a group, by tile
};

}  // namespace petzval::device::vulkan
