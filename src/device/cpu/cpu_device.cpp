#include "device/cpu/cpu_device.h"

#include "device/cpu/atlas.h"
#include "device/cpu/composite.h"

namespace petzval::device {
namespace {

class CpuDevice final : public Device {
public:
    const char* name() const override { return "cpu"; }
    std::shared_ptr<const Atlas> atlas(const KernelSource& source, const KernelSet& set, Memory& memory,
                                       const Control& control) const override {
        return std::make_shared<const StampAtlas>(source, set, memory, control);
    }
    Work composite(const engine::ScatterPlan& plan, const Atlas& atlas, View<Rgba> out,
                   const Control& control) const override {
        return composite_tiles(plan, dynamic_cast<const StampAtlas&>(atlas), out, control);
    }
};

}  // namespace

const Device& cpu_device() {
    static const CpuDevice device;
    return device;
}

}  // namespace petzval::device
