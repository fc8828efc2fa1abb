// Opens a device by its name.
#pragma once

#include "petzval/result.h"

#include "device/cpu/cpu_device.h"
#include "device/device.h"

#include <array>
#include <atomic>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace petzval {

// choice: as SessionSettings::device. Errors: InvalidArgument if no device has that name, Unsupported if it
// cannot be used.
Result<std::shared_ptr<const device::Device>> open_device(const std::string& choice);

// A picture in this device's memory.
inline std::shared_ptr<device::Canvas> canvas_of(const device::Device& device, Picture picture) {
    std::shared_ptr<device::Canvas> canvas = device.canvas(std::move(picture));
    canvas->view();
    return canvas;
}

// A device for one frame, that notes what was drawn with it. The CPU does to light what it cannot.
class NotingDevice final : public device::Device {
public:
    explicit NotingDevice(const device::Device& drawing) : device_(drawing) {}

    const char* name() const override { return device_.name(); }
    std::unique_ptr<device::Canvas> canvas(Picture memory) const override {
        return device_.canvas(std::move(memory));
    }
    std::shared_ptr<const device::Atlas> atlas(const device::KernelSource& source,
                                               const device::KernelSet& set, device::Memory& memory,
                                               const device::Control& control) const override {
        return device_.atlas(source, set, memory, control);
    }
    device::Work composite(const engine::ScatterPlan& plan, const device::Atlas& atlas, device::Target out,
                           const device::Control& control) const override {
        note();
        return device_.composite(plan, atlas, out, control);
    }
    void gather(const engine::GatherPlan& plan, const device::Atlas& atlas, device::Target out,
                const device::Control& control) const override {
        note();
        device_.gather(plan, atlas, out, control);
    }
    void mix(const engine::GaussianPlan& plan, device::Target out,
             const device::Control& control) const override {
        note();
        device_.mix(plan, out, control);
    }
    void draw_realtime(const engine::RealtimePlan& plan, device::Target out,
                       const device::Control& control) const override {
        note();
        device_.draw_realtime(plan, out, control);
    }
    std::size_t realtime_bytes(std::size_t pixels) const override { return device_.realtime_bytes(pixels); }
    device::Work add_lights(const engine::LightsPlan& plan, const device::Atlas& atlas, device::Target out,
                            const device::Control& control) const override {
        note();
        return device_.add_lights(plan, atlas, out, control);
    }

    bool add_glare(const glare::GlarePlan& plan, device::Canvas& picture, Workers& workers,
                   const device::Passed& passed) const override {
        if (!device_.add_glare(plan, picture, workers, passed))
            return device::cpu_device().add_glare(plan, picture, workers, passed);
        note();
        return true;
    }
    Picture highlights(device::Canvas& picture, float threshold, Workers& workers) const override {
        Picture bright = device_.highlights(picture, threshold, workers);
        return bright.empty() ? device::cpu_device().highlights(picture, threshold, workers)
                              : std::move(bright);
    }
    std::vector<std::uint16_t> develop(const colour::DevelopPlan& plan, device::Canvas& picture,
                                       Workers& workers) const override {
        return device_.develop(plan, picture, workers);
    }

    // The device that drew: "gpu:0 its name", or "cpu" for engines that draw without a device.
    std::string drawn_by() const;
    // The device's notes on how it drew: lines for a report.
    std::vector<std::string> said() const;

private:
    void note() const { drew_.store(true, std::memory_order_relaxed); }
    const device::Device& device_;
    mutable std::atomic<bool> drew_ = false;
};

}  // namespace petzval
