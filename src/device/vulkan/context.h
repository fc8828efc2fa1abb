// One device that was opened: its memory, its programs, its queue.
#pragma once

#include "device/vulkan/heap.h"
#include "device/vulkan/instance.h"
#include "device/vulkan/pass_time.h"
#include "device/vulkan/pipeline.h"

#include <cstdint>
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
    // number: place in instance->candidates(). Errors: Unsupported (what of the floor it lacks, or why it
    // does not start).
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

    // Passes are timed from here on.
    void time_passes();
    bool times_passes() const;
    void add_time(const std::string& pass, double seconds, std::uint64_t bytes);
    std::vector<PassTime> pass_times() const;

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
    mutable std::mutex mutex_;  // of all below, and of the queue
    std::map<std::pair<Shader, std::uint32_t>, Program> programs_;
    std::map<std::string, PassTime> times_;
    bool times_passes_ = false;
};

}  // namespace petzval::device::vulkan
