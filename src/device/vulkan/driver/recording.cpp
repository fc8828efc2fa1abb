#include "device/vulkan/driver/recording.h"

#include "device/vulkan/driver/failure.h"

#include <array>
#include <chrono>
#include <cstring>
#include <limits>

namespace petzval::device::vulkan {
namespace {

constexpr std::uint32_t kMostBuffers = 8;  // of a pass

}  // namespace

Recording::Recording(Context& context)
    : context_(context), vk_(context.vk()), times_passes_(context.times_passes()) {
    const std::string what = "commands";
    VkCommandPoolCreateInfo pool = {};
    pool.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
    pool.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
    pool.queueFamilyIndex = context.candidate().queue_family;
    check(vk_.vkCreateCommandPool(context.handle(), &pool, nullptr, &pool_), context.name(), what);
    VkCommandBufferAllocateInfo commands = {};
    commands.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
    commands.commandPool = pool_, commands.commandBufferCount = 1;
    check(vk_.vkAllocateCommandBuffers(context.handle(), &commands, &commands_), context.name(), what);
    VkFenceCreateInfo fence = {};
    fence.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
    check(vk_.vkCreateFence(context.handle(), &fence, nullptr, &fence_), context.name(), what);
    VkCommandBufferBeginInfo begin = {};
    begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    check(vk_.vkBeginCommandBuffer(commands_, &begin), context.name(), what);
}

Recording::~Recording() {
    // Memory must not go while the device still writes to it.
    if (submitted_)
        vk_.vkWaitForFences(context_.handle(), 1, &fence_, VK_TRUE,
                            std::numeric_limits<std::uint64_t>::max());
    for (const Pools& pools : pools_) {
        if (pools.queries) vk_.vkDestroyQueryPool(context_.handle(), pools.queries, nullptr);
        if (pools.sets) vk_.vkDestroyDescriptorPool(context_.handle(), pools.sets, nullptr);
    }
    if (fence_) vk_.vkDestroyFence(context_.handle(), fence_, nullptr);
    if (pool_) vk_.vkDestroyCommandPool(context_.handle(), pool_, nullptr);
}

Piece Recording::uploaded(std::span<const std::byte> bytes) { return uploaded(std::vector{bytes}); }

Piece Recording::uploaded(const std::vector<std::span<const std::byte>>& parts) {
    std::size_t bytes = 0;
    for (const auto& part : parts) bytes += part.size();
    const auto fill = [&parts](std::byte* to) {
        for (const auto& part : parts) to = std::copy(part.begin(), part.end(), to);
    };
    Piece piece = context_.heap().allocate(Kind::OnDevice, bytes);
    if (bytes == 0) return piece;
    if (std::byte* const seen = piece.mapped()) {
        fill(seen);
        return piece;
    }
    const Piece& from = staging_.emplace_back(context_.heap().allocate(Kind::ToDevice, bytes));
    fill(from.mapped());
    const VkBufferCopy copy = {from.offset(), piece.offset(), bytes};
    vk_.vkCmdCopyBuffer(commands_, from.buffer(), piece.buffer(), 1, &copy);
    return piece;
}

// Makes all earlier writes visible to later work, and prevents overwriting before reading.
void Recording::order(VkPipelineStageFlags to, VkAccessFlags access) {
    VkMemoryBarrier barrier = {};
    barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
    barrier.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT;
    barrier.dstAccessMask = access;
    vk_.vkCmdPipelineBarrier(commands_, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT,
                             to, 0, 1, &barrier, 0, nullptr, 0, nullptr);
}

// Plans are cut so that all pictures that were tested pass; a kernel of a few thousand pixels may fail.
void Recording::check_range(const Piece& piece) const {
    const std::size_t most = context_.most_range_bytes();
    if (piece.size() <= most) return;
    throw Failed{{ErrorCode::OutOfMemory, context_.name() + " binds at most " + std::to_string(most >> 20) +
                                              " MiB as one buffer, and this frame needs " +
                                              std::to_string(piece.size() >> 20) +
                                              " MiB; session.device cpu has no such limit"}};
}

Recording::Pools& Recording::pools_of_next() {
    if (passes_.size() == pools_.size() * kPassesOfPools) add_pools();
    return pools_.back();
}

void Recording::add_pools() {
    Pools& pools = pools_.emplace_back();
    const VkDescriptorPoolSize size = {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kPassesOfPools * kMostBuffers};
    VkDescriptorPoolCreateInfo sets = {};
    sets.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    sets.maxSets = kPassesOfPools, sets.poolSizeCount = 1, sets.pPoolSizes = &size;
    check(vk_.vkCreateDescriptorPool(context_.handle(), &sets, nullptr, &pools.sets), context_.name(),
          "commands");
    if (!times_passes_) return;
    VkQueryPoolCreateInfo queries = {};
    queries.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
    queries.queryType = VK_QUERY_TYPE_TIMESTAMP, queries.queryCount = kQueriesOfPools;
    check(vk_.vkCreateQueryPool(context_.handle(), &queries, nullptr, &pools.queries), context_.name(),
          "commands");
    vk_.vkCmdResetQueryPool(commands_, pools.queries, 0, kQueriesOfPools);
}

VkDescriptorSet Recording::set_for(const Program& program, std::initializer_list<const Piece*> buffers) {
    VkDescriptorSetAllocateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
    info.descriptorPool = pools_of_next().sets;
    info.descriptorSetCount = 1, info.pSetLayouts = &program.set_layout;
    VkDescriptorSet set = VK_NULL_HANDLE;
    check(vk_.vkAllocateDescriptorSets(context_.handle(), &info, &set), context_.name(), "buffers of a pass");
    std::vector<VkDescriptorBufferInfo> ranges;
    for (const Piece* piece : buffers) {
        check_range(*piece);
        ranges.push_back({piece->buffer(), piece->offset(), piece->size()});
    }
    VkWriteDescriptorSet write = {};
    write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    write.dstSet = set, write.descriptorCount = std::uint32_t(ranges.size());
    write.descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, write.pBufferInfo = ranges.data();
    vk_.vkUpdateDescriptorSets(context_.handle(), 1, &write, 0, nullptr);
    return set;
}

void Recording::pass(const char* name, const Program& program, std::initializer_list<const Piece*> buffers,
                     std::span<const std::byte> push, Groups groups, const PassWork& work) {
    VkDescriptorSet set = set_for(program, buffers);
    order(VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT);
    vk_.vkCmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, program.pipeline);
    vk_.vkCmdBindDescriptorSets(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, program.layout, 0, 1, &set, 0,
                                nullptr);
    vk_.vkCmdPushConstants(commands_, program.layout, VK_SHADER_STAGE_COMPUTE_BIT, 0,
                           std::uint32_t(push.size()), push.data());
    begin_pass(name, work);
    vk_.vkCmdDispatch(commands_, groups.x, groups.y, groups.z);
    end_pass();
}

void Recording::begin_pass(const char* name, const PassWork& work) {
    pools_of_next();
    write_time(2 * passes_.size());
    passes_.push_back({name, work});
}

void Recording::end_pass() { write_time(2 * passes_.size() - 1); }

void Recording::write_time(std::size_t query) {
    VkQueryPool queries = pools_.back().queries;
    if (queries)
        vk_.vkCmdWriteTimestamp(commands_, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, queries,
                                std::uint32_t(query % kQueriesOfPools));
}

const std::byte* Recording::downloaded(const Piece& piece, std::size_t bytes) {
    const Piece& to = staging_.emplace_back(context_.heap().allocate(Kind::FromDevice, bytes));
    copy(piece, to, bytes);
    return to.mapped();
}

void Recording::copy(const Piece& from, const Piece& to, std::size_t bytes, std::size_t from_byte,
                     std::size_t to_byte) {
    order(VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_READ_BIT | VK_ACCESS_TRANSFER_WRITE_BIT);
    const VkBufferCopy copied = {from.offset() + from_byte, to.offset() + to_byte, bytes};
    vk_.vkCmdCopyBuffer(commands_, from.buffer(), to.buffer(), 1, &copied);
}

double Recording::run() {
    order(VK_PIPELINE_STAGE_HOST_BIT, VK_ACCESS_HOST_READ_BIT);
    check(vk_.vkEndCommandBuffer(commands_), context_.name(), "commands");
    const auto start = std::chrono::steady_clock::now();
    context_.submit(commands_, fence_);
    submitted_ = true;
    check(vk_.vkWaitForFences(context_.handle(), 1, &fence_, VK_TRUE,
                              std::numeric_limits<std::uint64_t>::max()),
          context_.name(), "drawing");
    submitted_ = false;
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    context_.add_submission(seconds);
    note_times();
    if (const std::string said = context_.instance().complaints(); !said.empty())
        throw Failed{{ErrorCode::Unsupported, context_.name() + ": " + said}};
    return seconds;
}

void Recording::note_times() {
    if (!times_passes_) return;
    const double period = double(context_.candidate().limits.timestampPeriod) * 1e-9;
    std::array<std::uint64_t, 2> ticks;
    for (std::size_t i = 0; i < passes_.size(); ++i) {
        const auto first = std::uint32_t(2 * i % kQueriesOfPools);
        check(vk_.vkGetQueryPoolResults(context_.handle(), pools_[i / kPassesOfPools].queries, first, 2,
                                        sizeof ticks, ticks.data(), sizeof(std::uint64_t),
                                        VK_QUERY_RESULT_64_BIT),
              context_.name(), "timing");
        context_.add_time(passes_[i].name, double(ticks[1] - ticks[0]) * period, passes_[i].work);
    }
}

}  // namespace petzval::device::vulkan
