#include "device/cpu/cpu_device.h"

#include "device/cpu/add_lights.h"
#include "device/cpu/atlas.h"
#include "device/cpu/composite.h"
#include "device/cpu/gather.h"
#include "device/cpu/glare.h"
#include "device/cpu/mix.h"
#include "device/cpu/stamp_lights.h"
#include "device/failure.h"
#include "engine/lights/plan.h"

namespace petzval::device {
namespace {

class CpuDevice final : public Device {
public:
    const char* name() const override { return "cpu"; }
    std::shared_ptr<const Atlas> atlas(const KernelSource& source, const KernelSet& set, Memory& memory,
                                       const Control& control) const override {
        switch (source.use()) {
            case KernelUse::ByPixel:
                return std::make_shared<const SpreadAtlas>(source, set, control);
            case KernelUse::Gathered:
                return std::make_shared<const TapAtlas>(
                    laid_out<TapKernel>(source, set, "gathering", memory, control));
            case KernelUse::Stamped:
            case KernelUse::Masked:
                break;
        }
        return std::make_shared<const StampAtlas>(
            laid_out<StampSet>(source, set, "stamping", memory, control));
    }
    Work composite(const engine::ScatterPlan& plan, const Atlas& atlas, View<Rgba> out,
                   const Control& control) const override {
        return composite_tiles(plan, dynamic_cast<const StampAtlas&>(atlas), out, control);
    }
    void gather(const engine::GatherPlan& plan, const Atlas& atlas, View<Rgba> out,
                const Control& control) const override {
        gather_tiles(plan, dynamic_cast<const TapAtlas&>(atlas), out, control);
    }
    void mix(const engine::GaussianPlan& plan, View<Rgba> out, const Control& control) const override {
        mix_blurs(plan, out, control);
    }
    void draw_realtime(const engine::RealtimePlan&, View<Rgba>) const override {
        throw Failed{{ErrorCode::Unsupported,
                      "job.engine realtime is drawn by a GPU alone: session.device gpu", "job.engine"}};
    }
    Work add_lights(const engine::LightsPlan& plan, const Atlas& atlas, View<Rgba> out,
                    const Control& control) const override {
        if (!plan.masks.empty())
            return stamp_planned_lights(plan, dynamic_cast<const StampAtlas&>(atlas), out, control);
        return add_planned_lights(plan, dynamic_cast<const SpreadAtlas&>(atlas), out, control);
    }
    bool add_glare(const glare::GlarePlan& plan, View<Rgba> picture, Workers& workers) const override {
        add_planned_glare(plan, picture, workers);
        return true;
    }
};

}  // namespace

const Device& cpu_device() {
    static const CpuDevice device;
    return device;
}

}  // namespace petzval::device
