// Kernels laid out for the loops of this machine.
#pragma once

#include "device/cpu/stamp.h"
#include "device/cpu/tap_kernel.h"
#include "device/device.h"

#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

namespace petzval::device {

// What one ask stands for in stamping: a kernel, or one for each sector of the pupil.
struct StampSet {
    std::vector<engine::StampKernel> kernels;
    std::size_t taps = 0, bytes = 0;  // of all of them; taps count the padding

    static std::shared_ptr<const StampSet> laid_out(const KernelSource::Made& spreads);
};

// All that was made of one source and not dropped yet. Of a Kernel are asked laid_out() and bytes.
template <typename Kernel>
class KernelTable final : public Memory::Thing {
public:
    std::shared_ptr<const Kernel> find(const KernelAsk& ask) const;
    void add(const KernelAsk& ask, std::shared_ptr<const Kernel> kernel);
    std::size_t bytes() const override;
    // Those that no atlas holds.
    void trim(std::size_t max_bytes) override;

private:
    mutable std::mutex mutex_;
    std::map<KernelAsk, std::shared_ptr<const Kernel>> kernels_;
    std::size_t bytes_ = 0;
};

// use: what the kernels are laid out for, in a word.
template <typename Kernel>
class LaidOutAtlas final : public Atlas {
public:
    LaidOutAtlas(const KernelSource& source, const KernelSet& set, const std::string& use, Memory& memory,
                 const Control& control);
    const Kernel& operator[](std::uint32_t kernel) const { return *kernels_[kernel]; }

private:
    std::vector<std::shared_ptr<const Kernel>> kernels_;  // in the order of the set
};
using StampAtlas = LaidOutAtlas<StampSet>;
using TapAtlas = LaidOutAtlas<TapKernel>;

// Complete kernels as their source keeps them.
class SpreadAtlas final : public Atlas {
public:
    SpreadAtlas(const KernelSource& source, const KernelSet& set, const Control& control);
    const kernel::PointSpread& operator[](std::uint32_t kernel) const { return *kernels_[kernel]; }

private:
    std::vector<std::shared_ptr<const kernel::PointSpread>> kernels_;  // in the order of the set
};

}  // namespace petzval::device
