#include "device/cpu/cpu_device.h"

#include "colour/develop_plan.h"
#include "device/cpu/atlas.h"
#include "device/cpu/composite.h"
#include "device/cpu/gather.h"
#include "device/cpu/glare/glare.h"
#include "device/cpu/lights/add_lights.h"
#include "device/cpu/lights/stamp_lights.h"
#include "device/cpu/mix.h"
#include "device/failure.h"
#include "engine/lights/plan.h"

#include <utility>

namespace petzval::device {
namespace {

class CpuDevice final : public Device {
public:
    const char* name() const override { return "cpu"; }
    std::unique_ptr<Canvas> canvas(Picture memory) const override {
        return std::make_unique<Canvas>(std::move(memory));
    }
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
    Work composite(const engine::ScatterPlan& plan, const Atlas& atlas, Target out,
                   const Control& control) const override {
        return composite_tiles(plan, dynamic_cast<const StampAtlas&>(atlas), out.view(), control);
    }
    void gather(const engine::GatherPlan& plan, const Atlas& atlas, Target out,
                const Control& control) const override {
        gather_tiles(plan, dynamic_cast<const TapAtlas&>(atlas), out.view(), control);
    }
    void mix(const engine::GaussianPlan& plan, Target out, const Control& control) const override {
        mix_blurs(plan, out.view(), control);
    }
    void draw_realtime(const engine::RealtimePlan&, Target, const Control&) const override {
        throw Failed{{ErrorCode::Unsupported, "job.engine realtime needs a GPU: set session.device gpu",
                      "job.engine"}};
    }
    Work add_lights(const engine::LightsPlan& plan, const Atlas& atlas, Target out,
                    const Control& control) const override {
        if (!plan.masks.empty())
            return stamp_planned_lights(plan, dynamic_cast<const StampAtlas&>(atlas), out.view(), control);
        return add_planned_lights(plan, dynamic_cast<const SpreadAtlas&>(atlas), out.view(), control);
    }
    bool add_glare(const glare::GlarePlan& plan, Canvas& picture, Workers& workers,
                   const Passed& passed) const override {
        add_planned_glare(plan, picture.view(), workers, passed);
        return true;
    }
    Picture highlights(Canvas& picture, float threshold, Workers& workers) const override {
        return device::highlights(picture.view(), threshold, workers);
    }
    std::vector<std::uint16_t> develop(const colour::DevelopPlan& plan, Canvas& picture,
                                       Workers& workers) const override {
        return colour::develop(picture.view(), plan, workers);
    }
};

}  // namespace

const Device& cpu_device() {
    static const CpuDevice device;
    return device;
}

}  // namespace petzval::device
