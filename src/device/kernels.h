// Kernels as a plan asks for them and as a device is given them.
#pragma once

#include "kernel/model/lens_model.h"

#include <compare>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace petzval::device {

// One kernel that drawing a plan touches. What a step, a zone and a piece are is the law of its source.
struct KernelAsk {
    int level = 0;  // cells 2^level pixels wide
    int zone = 0;   // of the picture: places that share kernels
    int step = 0;   // of the signed radius
    int piece = 0;  // 0: the whole kernel or its core; n: what was cut away from the one n levels finer
    bool by_sector = false;  // one kernel for each sector of the pupil, one after the other
    friend auto operator<=>(const KernelAsk&, const KernelAsk&) = default;  // NOLINT(modernize-use-nullptr)
    // True if both are cut from one kernel of the lens.
    bool is_cut_from(const KernelAsk& other) const {
        return level == other.level && zone == other.zone && step == other.step;
    }
};

// All that drawing a plan touches: sorted, each once. A plan names a kernel by its place in here.
struct KernelSet {
    std::vector<KernelAsk> asks;
};

// Ways of drawing kernels. Stamped: many small ones on top of each other. ByPixel: few that may be wide,
// shaded pixel by pixel. Gathered: read tap by tap for every pixel of a tile. Masked: stamped, each through
// the visible part of the pupil.
enum class KernelUse { Stamped, ByPixel, Gathered, Masked };

// A source of kernels. Safe to use from many threads; a kernel depends on the ask alone.
class KernelSource {
public:
    // name: says everything that decides the kernels; those of one name are the same.
    KernelSource(std::string name, KernelUse use) : name_(std::move(name)), use_(use) {}
    virtual ~KernelSource() = default;
    KernelSource(const KernelSource&) = delete;
    KernelSource& operator=(const KernelSource&) = delete;

    // The kernels of asks that are cut from one kernel of the lens, in order: one each, or as many as there
    // are sectors.
    using Made = std::vector<std::shared_ptr<const kernel::PointSpread>>;
    virtual std::vector<Made> make(std::span<const KernelAsk> asks) const = 0;
    const std::string& name() const { return name_; }
    KernelUse use() const { return use_; }

private:
    std::string name_;
    KernelUse use_;
};

}  // namespace petzval::device
