#include "device/vulkan/vulkan_device.h"

#include "device/vulkan/composite.h"

#include <map>
#include <mutex>
#include <utility>

namespace petzval::device {
namespace vulkan {
namespace {

class VulkanDevice final : public Device {
public:
    VulkanDevice(std::shared_ptr<Context> context, const Device& otherwise)
        : context_(std::move(context)),
          otherwise_(otherwise),
          name_(context_->name() + " " + context_->candidate().name) {}

    const char* name() const override { return name_.c_str(); }
    bool has(Verb verb) const override { return verb == Verb::Composite; }
    std::shared_ptr<const Atlas> atlas(const KernelSource& source, const KernelSet& set, Memory& memory,
                                       const Control& control) const override {
        if (source.use() != KernelUse::Stamped) return otherwise_.atlas(source, set, memory, control);
        return std::make_shared<const PackedAtlas>(
            laid_out<PackedSet>(source, set, "programs of a device", memory, control));
    }
    Work composite(const engine::ScatterPlan& plan, const Atlas& atlas, View<Rgba> out,
                   const Control& control) const override {
        return composite_tiles(*context_, plan, dynamic_cast<const PackedAtlas&>(atlas), out, control);
    }
    void gather(const engine::GatherPlan& plan, const Atlas& atlas, View<Rgba> out,
                const Control& control) const override {
        otherwise_.gather(plan, atlas, out, control);
    }
    void mix(const engine::GaussianPlan& plan, View<Rgba> out, const Control& control) const override {
        otherwise_.mix(plan, out, control);
    }
    Work add_lights(const engine::LightsPlan& plan, const Atlas& atlas, View<Rgba> out,
                    const Control& control) const override {
        return otherwise_.add_lights(plan, atlas, out, control);
    }

private:
    std::shared_ptr<Context> context_;
    const Device& otherwise_;
    const std::string name_;
};

}  // namespace
}  // namespace vulkan

Result<std::vector<VulkanChoice>> vulkan_choices() {
    const auto instance = vulkan::Instance::open();
    if (!instance) return instance.error();
    std::vector<VulkanChoice> choices;
    for (const vulkan::Candidate& c : (*instance)->candidates())
        choices.push_back({c.name, c.is_software, c.lacks});
    return choices;
}

Result<std::shared_ptr<const Device>> open_vulkan(std::size_t number, const Device& otherwise) {
    static std::mutex mutex;
    static std::map<std::size_t, std::weak_ptr<const Device>> opened;
    const std::lock_guard lock(mutex);
    if (auto known = opened[number].lock()) return known;
    auto instance = vulkan::Instance::open();
    if (!instance) return instance.error();
    auto context = vulkan::Context::open(std::move(*instance), number);
    if (!context) return context.error();
    std::shared_ptr<const Device> device =
        std::make_shared<const vulkan::VulkanDevice>(std::move(*context), otherwise);
    opened[number] = device;
    return device;
}

}  // namespace petzval::device
