#include "device/vulkan/vulkan_device.h"

#include "base/parallel.h"
#include "device/vulkan/add_lights.h"
#include "device/vulkan/canvas.h"
#include "device/vulkan/composite.h"
#include "device/vulkan/develop.h"
#include "device/vulkan/driver/recording.h"
#include "device/vulkan/gather.h"
#include "device/vulkan/glare.h"
#include "device/vulkan/mix.h"
#include "device/vulkan/realtime/realtime.h"
#include "device/vulkan/stamp_lights.h"
#include "device/vulkan/stars.h"
#include "engine/lights/plan.h"

#include <chrono>
#include <map>
#include <mutex>
#include <utility>

namespace petzval::device {
namespace vulkan {
namespace {

class VulkanDevice final : public Device {
public:
    explicit VulkanDevice(std::shared_ptr<Context> context)
        : context_(std::move(context)),
          name_(context_->name() + " " + context_->candidate().name),
          realtime_(*context_) {
        context_->lets_go_by([this] { realtime_.let_go(); });
    }

    const char* name() const override { return name_.c_str(); }
    std::unique_ptr<Canvas> canvas(Picture memory) const override {
        return std::make_unique<DeviceCanvas>(*context_, std::move(memory));
    }
    std::shared_ptr<const Atlas> atlas(const KernelSource& source, const KernelSet& set, Memory& memory,
                                       const Control& control) const override {
        if (source.use() == KernelUse::ByPixel) return kept_by_source(source, set, control);
        return std::make_shared<const PackedAtlas>(
            laid_out<PackedSet>(source, set, "programs of a device", memory, control));
    }
    Work composite(const engine::ScatterPlan& plan, const Atlas& atlas, Target out,
                   const Control& control) const override {
        return composite_tiles(*context_, plan, dynamic_cast<const PackedAtlas&>(atlas), out, control);
    }
    void gather(const engine::GatherPlan& plan, const Atlas& atlas, Target out,
                const Control& control) const override {
        gather_tiles(*context_, plan, dynamic_cast<const PackedAtlas&>(atlas), out, control);
    }
    void mix(const engine::GaussianPlan& plan, Target out, const Control& control) const override {
        mix_blurs(*context_, plan, out, control);
    }
    void draw_realtime(const engine::RealtimePlan& plan, Target out, const Control& control) const override {
        realtime_.draw(plan, out, control.progress);
    }
    std::size_t realtime_bytes(std::size_t pixels) const override { return realtime_.process_bytes(pixels); }
    Work add_lights(const engine::LightsPlan& plan, const Atlas& atlas, Target out,
                    const Control& control) const override {
        const auto& packed = dynamic_cast<const PackedAtlas&>(atlas);
        return plan.masks.empty() ? add_planned_lights(*context_, plan, packed, out, control)
                                  : stamp_planned_lights(*context_, plan, packed, out, control);
    }

    bool add_glare(const glare::GlarePlan& plan, Canvas& picture, Workers&, const Passed&) const override {
        return add_planned_glare(*context_, plan, dynamic_cast<DeviceCanvas&>(picture));
    }
    Picture highlights(Canvas& picture, float threshold, Workers&) const override {
        const Size size{std::uint32_t(picture.width()), std::uint32_t(picture.height())};
        try {
            const Piece* const sent = dynamic_cast<DeviceCanvas&>(picture).sent();
            return sent ? highlights_at_home(*context_, *sent, size, threshold) : Picture();
        } catch (const Failed& failed) {
            if (failed.error.code != ErrorCode::OutOfMemory) throw;
            return {};  // nothing was done to the picture
        }
    }
    std::vector<std::uint16_t> develop(const colour::DevelopPlan& plan, Canvas& picture,
                                       Workers& workers) const override {
        return developed(*context_, plan, dynamic_cast<DeviceCanvas&>(picture), workers);
    }

    Context& context() const { return *context_; }

private:
    // Few kernels, that may be large: they are not kept twice.
    static std::shared_ptr<const Atlas> kept_by_source(const KernelSource& source, const KernelSet& set,
                                                       const Control& control) {
        std::vector<std::shared_ptr<const PackedSet>> sets(set.asks.size());
        parallel_for(int(sets.size()), control.workers, [&](int i) {
            if (!control.progress.cancelled())
                sets[std::size_t(i)] =
                    PackedSet::laid_out(source.make({&set.asks[std::size_t(i)], 1}).front());
        });
        return std::make_shared<const PackedAtlas>(std::move(sets));
    }

    std::shared_ptr<Context> context_;
    const std::string name_;
    mutable RealtimeDrawer realtime_;
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

Result<std::shared_ptr<const Device>> open_vulkan(std::size_t number) {
    static std::mutex mutex;
    static std::map<std::size_t, std::weak_ptr<const Device>> opened;
    const std::lock_guard lock(mutex);
    if (auto known = opened[number].lock()) return known;
    auto instance = vulkan::Instance::open();
    if (!instance) return instance.error();
    auto context = vulkan::Context::open(std::move(*instance), number);
    if (!context) return context.error();
    std::shared_ptr<const Device> device = std::make_shared<const vulkan::VulkanDevice>(std::move(*context));
    opened[number] = device;
    return device;
}

namespace {

vulkan::Context& context_of(const Device& device) {
    return dynamic_cast<const vulkan::VulkanDevice&>(device).context();
}

}  // namespace

std::vector<std::string> said_by(const Device& device) {
    const auto* drawn = dynamic_cast<const vulkan::VulkanDevice*>(&device);
    return drawn ? drawn->context().said() : std::vector<std::string>();
}

void start_timing(const Device& device) { context_of(device).time_passes(); }

std::vector<PassTime> pass_times(const Device& device) { return context_of(device).pass_times(); }

double longest_submission_s(const Device& device) { return context_of(device).longest_s(); }

double copied_bytes_per_s(const Device& device) {
    constexpr std::size_t kBytes = std::size_t(128) << 20;
    vulkan::Context& context = context_of(device);
    const auto from = context.heap().allocate(vulkan::Kind::OnDevice, kBytes),
               to = context.heap().allocate(vulkan::Kind::OnDevice, kBytes);
    constexpr int kWarmUp = 2, kRuns = 5;
    double seconds = 0;
    for (int i = 0; i < kWarmUp + kRuns; ++i) {
        vulkan::Recording recording(context);
        recording.copy(from, to, kBytes);
        const auto start = std::chrono::steady_clock::now();
        recording.run();
        if (i >= kWarmUp)
            seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }
    return 2.0 * kRuns * double(kBytes) / seconds;
}

}  // namespace petzval::device
