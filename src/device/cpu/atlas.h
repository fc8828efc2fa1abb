// Kernels laid out for the loops of this machine.
#pragma once

#include "device/cpu/stamp.h"
#include "device/device.h"

#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

namespace petzval::device {

// What one ask stands for: a kernel, or one for each sector of the pupil.
struct StampSet {
    std::vector<engine::StampKernel> kernels;
    std::size_t taps = 0, bytes = 0;  // of all of them; taps count the padding
};

// All that was made of one source and not dropped yet.
class StampTable final : public Memory::Thing {
public:
    std::shared_ptr<const StampSet> find(const KernelAsk& ask) const;
    void add(const KernelAsk& ask, std::shared_ptr<const StampSet> kernels);
    std::size_t bytes() const override;
    // Those that no atlas holds.
    void trim(std::size_t max_bytes) override;

private:
    mutable std::mutex mutex_;
    std::map<KernelAsk, std::shared_ptr<const StampSet>> kernels_;
    std::size_t bytes_ = 0;
};

class StampAtlas final : public Atlas {
public:
    StampAtlas(const KernelSource& source, const KernelSet& set, Memory& memory, const Control& control);
    const StampSet& operator[](std::uint32_t kernel) const { return *kernels_[kernel]; }

private:
    std::vector<std::shared_ptr<const StampSet>> kernels_;  // in the order of the set
};

// Complete kernels as their source keeps them.
class SpreadAtlas final : public Atlas {
public:
    SpreadAtlas(const KernelSource& source, const KernelSet& set, const Control& control);
    const kernel::PointSpread& operator[](std::uint32_t kernel) const { return *kernels_[kernel]; }

private:
    std::vector<std::shared_ptr<const kernel::PointSpread>> kernels_;  // in the order of the set
};

}  // namespace petzval::device
