// A dispatch in parts, each as much as a device is given at once.
#pragma once

#include "device/vulkan/driver/context.h"
#include "device/vulkan/driver/recording.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace petzval::device::vulkan {

// A part of one row of groups, or whole rows.
struct Part {
    std::uint32_t x = 0, y = 0, width = 0, height = 0;
    std::uint64_t work = 0;
    std::size_t groups() const { return std::size_t(width) * height; }
};

// Groups from `first` on, in the order of rows: as many as `most` allows, at least one. work_of(x, y):
// multiply-adds of a group. Requires: first < all.x * all.y.
template <typename WorkOf>
Part part_from(std::size_t first, const Groups& all, std::uint64_t most, const WorkOf& work_of) {
    Part part{std::uint32_t(first % all.x), std::uint32_t(first / all.x), 0, 1, 0};
    for (std::uint32_t x = part.x; x < all.x; ++x) {
        const std::uint64_t work = work_of(x, part.y);
        if (x > part.x && part.work + work > most) return part;
        part.work += work, ++part.width;
    }
    if (part.x > 0) return part;
    for (std::uint32_t y = part.y + 1; y < all.y; ++y) {
        std::uint64_t work = 0;
        for (std::uint32_t x = 0; x < all.x && part.work + work <= most; ++x) work += work_of(x, y);
        if (part.work + work > most) break;
        part.work += work, ++part.height;
    }
    return part;
}

// Recordings that run one after the other, each with as much as the device does in its time. Throws Failed.
class Submissions {
public:
    // passes: whose pace it is. most: multiply-adds of one, whatever the pace.
    Submissions(Context& context, const char* passes, std::uint64_t most)
        : context_(context), passes_(passes), most_(most) {
        recording_.emplace(context_);
    }
    Recording& recording() { return *recording_; }
    // Remaining capacity; 0: the submission is full.
    std::uint64_t left() const {
        const std::uint64_t most = std::min(most_, context_.most_work(passes_));
        return work_ < most ? most - work_ : 0;
    }
    void add(std::uint64_t work) { work_ += work; }
    // Ends the current recording(); its results can still be read.
    void run() {
        context_.note_work(passes_, work_, recording_->run());
        work_ = 0;
    }
    void begin_next() { recording_.emplace(context_); }

private:
    Context& context_;
    const char* const passes_;
    const std::uint64_t most_;
    std::uint64_t work_ = 0;
    std::optional<Recording> recording_;
};

}  // namespace petzval::device::vulkan
