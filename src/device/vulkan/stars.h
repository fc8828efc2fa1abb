// Stars of highlights on the device: what device/cpu/glare/streaks.h and device/cpu/glare/convolve.h do.
#pragma once

#include "device/vulkan/driver/recording.h"
#include "glare/plan.h"

namespace petzval::device::vulkan {

// A picture on the device, in rows.
struct Size {
    std::uint32_t width = 0, height = 0;
    std::size_t pixels() const { return std::size_t(width) * height; }
    std::size_t bytes() const { return pixels() * sizeof(Rgba); }
    Size halved() const { return {width / 2, height / 2}; }
};

// The star of a picture, all of it (as an amount of 1). Requires: plan.star > 0. Throws Failed.
Piece drawn_star(Context& context, const glare::GlarePlan& plan, const Piece& picture, Size size);

// Light above a threshold, in host memory.
Picture highlights_at_home(Context& context, const Piece& picture, Size size, float threshold);

// Bytes of its largest piece of memory.
std::size_t largest_star_bytes(const glare::GlarePlan& plan);

}  // namespace petzval::device::vulkan
