// Pictures drawn by the pass for real time: uploaded, drawn, downloaded.
#pragma once

#include "device/device.h"
#include "device/vulkan/driver/context.h"
#include "engine/gather/realtime_plan.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

namespace petzval::device::vulkan {

// Work drawn at once. Larger pictures are drawn in strips of rows, each with the surrounding rows that
// influence it.
struct RealtimeRule {
    std::size_t most_pixels = std::size_t(9) << 20;        // a little more than 4K, about 100 bytes each
    std::uint64_t most_multiply_adds = ~std::uint64_t(0);  // of a submission, besides what a Pace allows
};

// The pass, its programs, images and memory are kept from frame to frame of one size. Safe to use from many
// threads; `context` outlives this.
class RealtimeDrawer {
public:
    explicit RealtimeDrawer(Context& context, const RealtimeRule& rule = {});
    ~RealtimeDrawer();
    RealtimeDrawer(const RealtimeDrawer&) = delete;
    RealtimeDrawer& operator=(const RealtimeDrawer&) = delete;

    // Writes all of `out`, unless cancelled. Throws Failed. plant: as in RealtimePass::record().
    void draw(const engine::RealtimePlan& plan, Target out, const Progress& progress = {},
              bool plant = false);
    // Memory of this process that draw() takes for so many pixels, as Device::realtime_bytes() counts it.
    std::size_t process_bytes(std::size_t pixels) const;
    int passes_made() const;
    // In the last frame, or its last strip: the most lamps that a tile looks at.
    std::uint64_t most_lamps() const;
    // Releases the memory kept for the next frame.
    void let_go();

private:
    class Frame;
    int rows_at_once(int width, int height, int halo) const;
    std::unique_ptr<Frame> frame_of(std::uint32_t width, std::uint32_t height);
    void keep(std::unique_ptr<Frame> frame);

    Context& context_;
    const RealtimeRule rule_;
    mutable std::mutex mutex_;  // of what follows
    std::vector<std::unique_ptr<Frame>> idle_;
    int passes_made_ = 0;
    std::uint64_t most_lamps_ = 0;
};

}  // namespace petzval::device::vulkan
