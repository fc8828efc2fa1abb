#include "device/webgl/webgl_device.h"

#include "colour/develop_plan.h"
#include "device/failure.h"
#include "device/webgl/gather.h"
#include "device/webgl/stamp_lights.h"

#include <algorithm>
#include <string>
#include <utility>

namespace petzval::device {
namespace {

[[noreturn]] void refuse(const char* what) {
    throw Failed{
        {ErrorCode::Unsupported, std::string("session.device webgl draws no ") + what, "session.device"}};
}

class WebglDevice final : public Device {
public:
    const char* name() const override { return "webgl"; }
    std::unique_ptr<Canvas> canvas(Picture memory) const override {
        return std::make_unique<Canvas>(std::move(memory));
    }
    std::shared_ptr<const Atlas> atlas(const KernelSource& source, const KernelSet& set, Memory& memory,
                                       const Control& control) const override {
        return std::make_shared<const webgl::PageAtlas>(
            laid_out<webgl::LitKernel>(source, set, "a page", memory, control));
    }
    Work composite(const engine::ScatterPlan&, const Atlas&, Target, const Control&) const override {
        refuse("scattered light");
    }
    void gather(const engine::GatherPlan& plan, const Atlas& atlas, Target out,
                const Control&) const override {
        const View<Rgba> pixels = out.view();
        for (int y = 0; y < pixels.height(); ++y) std::fill_n(pixels.row(y), pixels.width(), Rgba{});
        webgl::hand_over_gather(plan, dynamic_cast<const webgl::PageAtlas&>(atlas));
    }
    void mix(const engine::GaussianPlan&, Target, const Control&) const override { refuse("mixed blurs"); }
    void draw_realtime(const engine::RealtimePlan&, Target, const Control&) const override {
        refuse("pass for real time");
    }
    Work add_lights(const engine::LightsPlan& plan, const Atlas& atlas, Target,
                    const Control&) const override {
        if (plan.masks.empty()) refuse("lights without masks");
        webgl::hand_over_lights(plan, dynamic_cast<const webgl::PageAtlas&>(atlas));
        return {};
    }
    bool add_glare(const glare::GlarePlan&, Canvas&, Workers&, const Passed&) const override { return false; }
    Picture highlights(Canvas&, float, Workers&) const override { return {}; }
    std::vector<std::uint16_t> develop(const colour::DevelopPlan&, Canvas&, Workers&) const override {
        return {};
    }
};

}  // namespace

const Device& webgl_device() {
    static const WebglDevice device;
    return device;
}

}  // namespace petzval::device
