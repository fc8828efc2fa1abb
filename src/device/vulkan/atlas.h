// Kernels as the device's programs read them.
#pragma once

#include "device/laid_out.h"
#include "device/vulkan/driver/recording.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace petzval::device::vulkan {

// The answer to one ask: a kernel, or one for each sector of the pupil.
struct PackedSet {
    struct Kernel {
        Rect extent;  // of its light alone
        bool neutral = true;
        std::size_t first = 0;  // in weights
        std::size_t taps() const { return std::size_t(extent.width()) * std::size_t(extent.height()); }
    };
    std::vector<Kernel> kernels;
    std::vector<float> weights;  // row by row; one per tap where neutral, else r, g, b, a; each begins a four
    std::size_t taps = 0, bytes = 0;

    static std::shared_ptr<const PackedSet> laid_out(const KernelSource::Made& spreads);
};

// Some of an atlas's kernels, on the device.
//
// words: for each kernel of the atlas the number of its first record (of those that are not there, anything);
// from `records` on records of three words: corner (x, y as 16 bits each), size (likewise), and where its
// weights begin, in fours, with bit 31 set where one weight stands for all channels.
struct KernelsOnDevice {
    Piece words, weights;
    std::uint32_t records = 0;
};

class PackedAtlas final : public Atlas {
public:
    explicit PackedAtlas(std::vector<std::shared_ptr<const PackedSet>> sets);

    const PackedSet& operator[](std::uint32_t kernel) const { return *sets_[kernel]; }
    std::size_t size() const { return sets_.size(); }
    std::size_t weight_bytes() const { return weight_bytes_; }  // of all
    // Uploads the kernels with these numbers, which are sorted. The result is valid once the recording has
    // run.
    KernelsOnDevice uploaded(std::span<const std::uint32_t> kernels, Recording& recording) const;

private:
    std::vector<std::shared_ptr<const PackedSet>> sets_;
    std::size_t weight_bytes_ = 0;
};

}  // namespace petzval::device::vulkan
