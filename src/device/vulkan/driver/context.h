// One device that was opened: its memory, its programs, its queue.
#pragma once

#include "device/failure.h"
#include "device/vulkan/driver/heap.h"
#include "device/vulkan/driver/instance.h"
#include "device/vulkan/driver/pace.h"
#include "device/vulkan/driver/pass_time.h"
#include "device/vulkan/driver/pipeline.h"

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace petzval::device::vulkan {

// Safe to use from many threads.
class Context {
public:
    // Opens a device. number: place in instance->candidates(). Errors: Unsupported (the missing part of the
    // floor, or the reason why it does not start).
    static Result<std::shared_ptr<Context>> open(std::shared_ptr<Instance> instance, std::size_t number);
    ~Context();
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    const Functions& vk() const { return vk_; }
    VkDevice handle() const { return opened_.device; }
    const Opened& opened() const { return opened_; }
    const std::string& name() const { return opened_.name; }  // "gpu:0"
    const Candidate& candidate() const { return candidate_; }
    std::size_t most_range_bytes() const { return candidate_.limits.maxStorageBufferRange; }
    Heap& heap() { return *heap_; }
    Instance& instance() { return *instance_; }
    // Made when first asked for. Throws Failed.
    const Program& program(Shader shader, std::uint32_t variant = 0);
    void submit(VkCommandBuffer commands, VkFence fence);

    // most_work(): multiply-adds of the next submission of these passes. note_work(): the seconds that one
    // took.
    std::uint64_t most_work(const std::string& passes) const;
    void note_work(const std::string& passes, std::uint64_t multiply_adds, double seconds);
    // Amount drawn at once; the limit is halved each time memory runs out.
    std::size_t at_once(std::size_t most) const { return std::max<std::size_t>(1, most >> halvings_); }
    // Handles exhausted memory: releases kept memory and halves the amount drawn at once, which said()
    // reports. False: something else failed, or halving no longer helps.
    bool halves(const Failed& failed);
    // Function that releases memory kept for later frames; it is called when memory runs out. Set it before
    // anything is drawn.
    void lets_go_by(std::function<void()> let_go) { let_go_ = std::move(let_go); }
    // A line for said(), once.
    void say(const std::string& what);
    // Messages for the user about the drawing of frames, since the last call.
    std::vector<std::string> said();

    // Passes are timed from here on.
    void time_passes();
    bool times_passes() const;
    void add_time(const std::string& pass, double seconds, const PassWork& work);
    std::vector<PassTime> pass_times() const;
    // The longest submission since then.
    void add_submission(double seconds);
    double longest_s() const;

private:
    Context(std::shared_ptr<Instance> instance, Candidate candidate)
        : instance_(std::move(instance)), candidate_(std::move(candidate)) {}
    Status create(std::size_t number);

    std::shared_ptr<Instance> instance_;
    const Candidate candidate_;
    Functions vk_;
    Opened opened_;
    VkQueue queue_ = VK_NULL_HANDLE;
    std::unique_ptr<Heap> heap_;
    std::function<void()> let_go_;
    mutable std::mutex mutex_;  // of all below, and of the queue
    std::map<std::pair<Shader, std::uint32_t>, Program> programs_;
    std::map<std::string, PassTime> times_;
    double longest_s_ = 0;
    std::map<std::string, Pace> paces_;
    std::vector<std::string> said_;
    std::atomic<int> halvings_{0};
    bool times_passes_ = false;
};

}  // namespace petzval::device::vulkan
