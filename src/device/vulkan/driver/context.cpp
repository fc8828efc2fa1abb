#include "device/vulkan/driver/context.h"

#include "device/vulkan/driver/failure.h"

#include <algorithm>
#include <fstream>
#include <sys/resource.h>
#include <unistd.h>
#include <utility>

namespace petzval::device::vulkan {
namespace {

// A driver in software compiles its programs in this process, and its compiler ends the process if addresses
// run out: llvmpipe of Mesa 22.3 crashed under ulimit -v of 450 to 800 MB, of which 300 MB were taken.
bool has_room_for_a_compiler() {
    constexpr std::uint64_t kLeast = std::uint64_t(512) << 20;
    rlimit most{};
    if (::getrlimit(RLIMIT_AS, &most) != 0 || most.rlim_cur == RLIM_INFINITY) return true;
    std::uint64_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    return std::uint64_t(most.rlim_cur) >= kLeast + pages * std::uint64_t(::sysconf(_SC_PAGESIZE));
}

}  // namespace

Result<std::shared_ptr<Context>> Context::open(std::shared_ptr<Instance> instance, std::size_t number) {
    const Candidate& candidate = instance->candidates()[number];
    if (!candidate.lacks.empty())
        return Error{ErrorCode::Unsupported, candidate.name + " does not have " + candidate.lacks};
    if (candidate.is_software && !has_room_for_a_compiler())
        return Error{ErrorCode::OutOfMemory,
                     candidate.name + " needs 512M of address space, and ulimit -v leaves less"};
    std::shared_ptr<Context> context(new Context(std::move(instance), candidate));
    if (const Status created = context->create(number); !created) return created.error();
    return context;
}

Status Context::create(std::size_t number) {
    opened_.name = "gpu:" + std::to_string(number);
    vk_ = instance_->functions();
    opened_.device = start_device(vk_, candidate_);
    if (!opened_.device) return Error{ErrorCode::Unsupported, candidate_.name + " does not start"};
    find_functions(vk_, opened_.device);
    opened_.vk = &vk_;
    vk_.vkGetDeviceQueue(opened_.device, candidate_.queue_family, 0, &queue_);
    heap_ = std::make_unique<Heap>(opened_, candidate_.memory);
    return Done{};
}

Context::~Context() {
    if (!opened_.device) return;
    for (const auto& [key, program] : programs_) destroy_program(opened_, program);
    heap_.reset();
    vk_.vkDestroyDevice(opened_.device, nullptr);
}

const Program& Context::program(Shader shader, std::uint32_t variant) {
    const std::lock_guard lock(mutex_);
    const std::pair key(shader, variant);
    const auto known = programs_.find(key);
    if (known != programs_.end()) return known->second;
    return programs_.emplace(key, make_program(opened_, shader, variant)).first->second;
}

void Context::submit(VkCommandBuffer commands, VkFence fence) {
    VkSubmitInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
    info.commandBufferCount = 1, info.pCommandBuffers = &commands;
    const std::lock_guard lock(mutex_);
    check(vk_.vkQueueSubmit(queue_, 1, &info, fence), name(), "drawing");
}

std::uint64_t Context::most_work(const std::string& passes) const {
    const std::lock_guard lock(mutex_);
    const auto known = paces_.find(passes);
    return known == paces_.end() ? Pace().most() : known->second.most();
}

void Context::note_work(const std::string& passes, std::uint64_t multiply_adds, double seconds) {
    const std::lock_guard lock(mutex_);
    paces_[passes].took(multiply_adds, seconds);
}

bool Context::halves(const Failed& failed) {
    constexpr int kMostHalvings = 16;
    if (failed.error.code != ErrorCode::OutOfMemory || halvings_ >= kMostHalvings) return false;
    ++halvings_;
    if (let_go_) let_go_();
    heap_->trim();
    say(name() +
        " has too little memory left for pieces of a frame this large; it draws smaller pieces from now on");
    return true;
}

void Context::say(const std::string& what) {
    const std::lock_guard lock(mutex_);
    if (std::find(said_.begin(), said_.end(), what) == said_.end()) said_.push_back(what);
}

std::vector<std::string> Context::said() {
    const std::lock_guard lock(mutex_);
    return std::exchange(said_, {});
}

void Context::time_passes() {
    const std::lock_guard lock(mutex_);
    times_passes_ = true, times_.clear(), longest_s_ = 0;
}

bool Context::times_passes() const {
    const std::lock_guard lock(mutex_);
    return times_passes_ && candidate_.timestamp_bits > 0;
}

void Context::add_time(const std::string& pass, double seconds, const PassWork& work) {
    const std::lock_guard lock(mutex_);
    PassTime& time = times_[pass];
    time.pass = pass, ++time.runs, time.seconds += seconds;
    time.work.bytes += work.bytes, time.work.multiply_adds += work.multiply_adds;
}

void Context::add_submission(double seconds) {
    const std::lock_guard lock(mutex_);
    longest_s_ = std::max(longest_s_, seconds);
}

double Context::longest_s() const {
    const std::lock_guard lock(mutex_);
    return longest_s_;
}

std::vector<PassTime> Context::pass_times() const {
    const std::lock_guard lock(mutex_);
    std::vector<PassTime> times;
    for (const auto& [name, time] : times_) times.push_back(time);
    return times;
}

}  // namespace petzval::device::vulkan
