#include "device/vulkan/realtime/pass.h"

#include "device/vulkan/driver/failure.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <string>
#include <utility>

namespace petzval::device::vulkan {
namespace {

constexpr VkDescriptorType kSampled = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                           kStored = VK_DESCRIPTOR_TYPE_STORAGE_IMAGE,
                           kBuffer = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
constexpr std::uint32_t kGroup = 8;   // invocations along a side
constexpr std::uint32_t kLevels = 4;  // of cells
constexpr std::array kNames{"measure", "split", "reach", "gather", "combine"};

Shader shader_of(std::size_t step, RealtimeResult result) {
    constexpr std::array kCombine{Shader::RealtimeCombine16, Shader::RealtimeCombine32,
                                  Shader::RealtimeCombine11};
    const std::array shaders{Shader::RealtimeMeasure, Shader::RealtimeSplit, Shader::RealtimeReach,
                             Shader::RealtimeGather, kCombine[std::size_t(result)]};
    return shaders[step];
}

// The images of a pass: cells, what is gathered, and the blurred layer.
std::vector<ImageKind> kinds_of(const RealtimeSettings& settings) {
    ImageKind kind;
    kind.width = (settings.width + 2 * kGroup - 1) / (2 * kGroup) * kGroup;
    kind.height = (settings.height + 2 * kGroup - 1) / (2 * kGroup) * kGroup;
    kind.usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
    kind.is_array = true;
    kind.layers = 5;
    kind.levels = kLevels;
    std::vector<ImageKind> kinds{kind};
    kind.layers = 3;
    kind.levels = 1;
    kinds.push_back(kind);
    kind.layers = 1;
    kind.is_array = false;
    kind.width = settings.width;
    kind.height = settings.height;
    if (settings.blurs_layers) kinds.push_back(kind);
    return kinds;
}

// For tools that show a host's frames; nothing where the host did not enable VK_EXT_debug_utils.
void name(const Opened& opened, VkObjectType type, std::uint64_t object, const std::string& said) {
    if (!opened.vk->vkSetDebugUtilsObjectNameEXT) return;
    VkDebugUtilsObjectNameInfoEXT info = {};
    info.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT;
    info.objectType = type, info.objectHandle = object, info.pObjectName = said.c_str();
    opened.vk->vkSetDebugUtilsObjectNameEXT(opened.device, &info);
}
template <typename Handle>
std::uint64_t word_of(Handle handle) {
    return reinterpret_cast<std::uint64_t>(handle);
}

}  // namespace

RealtimePrograms::RealtimePrograms(Opened opened, const RealtimeSettings& settings)
    : opened_(std::move(opened)) {
    const VkPipelineCreateFlags flags = settings.is_cut ? VK_PIPELINE_CREATE_DISPATCH_BASE_BIT : 0;
    try {
        for (std::size_t step = 0; step < kNames.size(); ++step) {
            steps_[step] = make_program(opened_, shader_of(step, settings.result), 0, flags, settings.cache);
            name(opened_, VK_OBJECT_TYPE_PIPELINE, word_of(steps_[step].pipeline),
                 std::string("petzval ") + kNames[step]);
        }
        if (settings.blurs_layers && settings.result != RealtimeResult::Half)
            combine_layer_ = make_program(opened_, Shader::RealtimeCombine16, 0, flags, settings.cache);
    } catch (...) {
        destroy();
        throw;
    }
}

RealtimePrograms::~RealtimePrograms() { destroy(); }

void RealtimePrograms::destroy() {
    for (const Program& program : steps_) destroy_program(opened_, program);
    destroy_program(opened_, combine_layer_);
}

RealtimePass::RealtimePass(const Opened& opened, const VkPhysicalDeviceMemoryProperties& memory,
                           const RealtimeSettings& settings, std::shared_ptr<const RealtimePrograms> programs)
    : opened_(opened),
      vk_(*opened.vk),
      memory_(memory),
      settings_(settings),
      heap_(opened, memory, std::size_t(1) << 20),
      programs_(std::move(programs)),
      slots_(std::size_t(settings.slots) * (settings.blurs_layers ? 2 : 1)) {
    for (std::size_t i = settings.slots; i < slots_.size(); ++i) slots_[i].is_of_layer = true;
    try {
        make();
    } catch (...) {
        destroy();
        throw;
    }
}

RealtimePass::~RealtimePass() { destroy(); }

VkMemoryRequirements RealtimePass::needs(const Opened& opened, const RealtimeSettings& settings) {
    VkMemoryRequirements all = {0, 1, ~0u};
    for (const ImageKind& kind : kinds_of(settings)) {
        const VkMemoryRequirements one = DeviceImage::needs(opened, kind);
        all.size = (all.size + one.alignment - 1) / one.alignment * one.alignment + one.size;
        all.alignment = std::max(all.alignment, one.alignment);
        all.memoryTypeBits &= one.memoryTypeBits;
    }
    return all;
}

void RealtimePass::make() {
    LentMemory lent = settings_.lent;
    const std::vector<ImageKind> kinds = kinds_of(settings_);
    cells_ = DeviceImage(opened_, memory_, kinds[0], &lent);
    gathered_ = DeviceImage(opened_, memory_, kinds[1], &lent);
    if (settings_.blurs_layers) layer_ = DeviceImage(opened_, memory_, kinds[2], &lent);
    const std::size_t tiles = std::size_t(tiles_x()) * tiles_y();
    surroundings_ = heap_.allocate(Kind::OnDevice, tiles * 2 * sizeof(float));
    tiles_ = heap_.allocate(Kind::OnDevice, tiles * 4 * sizeof(float));
    lamps_ = heap_.allocate(Kind::OnDevice, tiles * 4 * sizeof(std::uint32_t));
    cell_lamps_ = heap_.allocate(Kind::OnDevice, tiles * kGroup * kGroup * 4 * sizeof(std::uint32_t));
    reach_ = heap_.allocate(Kind::OnDevice, tiles * 4 * sizeof(float));
    boxes_ = heap_.allocate(Kind::OnDevice, tiles * 4 * sizeof(std::int32_t));
    kept_ = heap_.allocate(Kind::OnDevice, tiles * 4 * sizeof(std::uint32_t));
    make_sampler(VK_FILTER_NEAREST, nearest_);
    make_sampler(VK_FILTER_LINEAR, linear_);
    if (!programs_) programs_ = std::make_shared<const RealtimePrograms>(opened_, settings_);
    name(opened_, VK_OBJECT_TYPE_IMAGE, word_of(cells_.handle()), "petzval cells");
    name(opened_, VK_OBJECT_TYPE_IMAGE, word_of(gathered_.handle()), "petzval gathered");
    make_sets();
    if (settings_.is_timed) make_queries();
}

void RealtimePass::make_sampler(VkFilter filter, VkSampler& sampler) const {
    VkSamplerCreateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
    info.magFilter = info.minFilter = filter;
    info.mipmapMode =
        filter == VK_FILTER_LINEAR ? VK_SAMPLER_MIPMAP_MODE_LINEAR : VK_SAMPLER_MIPMAP_MODE_NEAREST;
    info.addressModeU = info.addressModeV = info.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    info.maxLod = VK_LOD_CLAMP_NONE;
    check(vk_.vkCreateSampler(opened_.device, &info, nullptr, &sampler), opened_.name, "a sampler");
}

void RealtimePass::make_sets() {
    const auto slots = std::uint32_t(slots_.size());
    std::array<VkDescriptorPoolSize, 3> sizes{{{kSampled, 0}, {kStored, 0}, {kBuffer, 0}}};
    for (std::size_t step = 0; step < kSteps; ++step)
        for (const VkDescriptorType type : words_of(shader_of(step, settings_.result)).bindings)
            for (VkDescriptorPoolSize& size : sizes)
                if (size.type == type) size.descriptorCount += slots;
    VkDescriptorPoolCreateInfo pool = {};
    pool.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    pool.maxSets = kSteps * slots;
    pool.poolSizeCount = std::uint32_t(sizes.size()), pool.pPoolSizes = sizes.data();
    check(vk_.vkCreateDescriptorPool(opened_.device, &pool, nullptr, &pool_), opened_.name, "descriptors");
    std::array<VkDescriptorSetLayout, kSteps> layouts = {};
    VkDescriptorSetAllocateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
    info.descriptorPool = pool_, info.descriptorSetCount = kSteps, info.pSetLayouts = layouts.data();
    for (Slot& slot : slots_) {
        for (std::size_t i = 0; i < kSteps; ++i) layouts[i] = program(slot, Step(i)).set_layout;
        check(vk_.vkAllocateDescriptorSets(opened_.device, &info, slot.sets.data()), opened_.name,
              "descriptors");
        write_own(slot);
    }
}

void RealtimePass::make_queries() {
    VkQueryPoolCreateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
    info.queryType = VK_QUERY_TYPE_TIMESTAMP;
    info.queryCount = (kSteps + 1) * std::uint32_t(slots_.size());
    check(vk_.vkCreateQueryPool(opened_.device, &info, nullptr, &queries_), opened_.name, "timestamps");
}

// place: 0 before all steps, k after the k-th.
void RealtimePass::write_time(VkCommandBuffer commands, std::uint32_t slot, std::uint32_t place) const {
    if (queries_)
        vk_.vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, queries_,
                                slot * (kSteps + 1) + place);
}

bool RealtimePass::ticks(std::uint32_t slot, std::array<std::uint64_t, kSteps>& taken) const {
    taken = {};
    return add_ticks(slot, taken) && (!slots_[slot].has_layer || add_ticks(slot + settings_.slots, taken));
}

bool RealtimePass::add_ticks(std::uint32_t slot, std::array<std::uint64_t, kSteps>& taken) const {
    if (!slots_[slot].is_timed) return false;
    std::array<std::uint64_t, kSteps + 1> at = {};
    const VkResult found =
        vk_.vkGetQueryPoolResults(opened_.device, queries_, slot * (kSteps + 1), kSteps + 1, sizeof at,
                                  at.data(), sizeof at[0], VK_QUERY_RESULT_64_BIT);
    if (found == VK_NOT_READY) return false;
    check(found, opened_.name, "timestamps");
    for (std::size_t i = 0; i < kSteps; ++i) taken[i] += at[i + 1] - at[i];
    return true;
}

void RealtimePass::destroy() {
    if (queries_) vk_.vkDestroyQueryPool(opened_.device, queries_, nullptr);
    if (pool_) vk_.vkDestroyDescriptorPool(opened_.device, pool_, nullptr);
    for (VkSampler sampler : {nearest_, linear_})
        if (sampler) vk_.vkDestroySampler(opened_.device, sampler, nullptr);
}

void RealtimePass::write_image(VkDescriptorSet set, std::uint32_t binding, VkDescriptorType type,
                               const VkDescriptorImageInfo& info) const {
    VkWriteDescriptorSet write = {};
    write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    write.dstSet = set, write.dstBinding = binding, write.descriptorCount = 1;
    write.descriptorType = type, write.pImageInfo = &info;
    vk_.vkUpdateDescriptorSets(opened_.device, 1, &write, 0, nullptr);
}

void RealtimePass::write_buffer(VkDescriptorSet set, std::uint32_t binding, const Piece& piece) const {
    const VkDescriptorBufferInfo info = {piece.buffer(), piece.offset(), piece.size()};
    VkWriteDescriptorSet write = {};
    write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    write.dstSet = set, write.dstBinding = binding, write.descriptorCount = 1;
    write.descriptorType = kBuffer, write.pBufferInfo = &info;
    vk_.vkUpdateDescriptorSets(opened_.device, 1, &write, 0, nullptr);
}

void RealtimePass::write_own(const Slot& slot) const {
    constexpr VkImageLayout kLayout = VK_IMAGE_LAYOUT_GENERAL;
    write_buffer(slot.sets[kMeasure], 1, surroundings_);
    for (std::uint32_t level = 0; level < kLevels; ++level)
        write_image(slot.sets[kSplit], 2 + level, kStored, {VK_NULL_HANDLE, cells_.level(level), kLayout});
    write_buffer(slot.sets[kSplit], 6, tiles_);
    write_buffer(slot.sets[kSplit], 7, surroundings_);
    write_buffer(slot.sets[kSplit], 8, lamps_);
    write_buffer(slot.sets[kSplit], 9, cell_lamps_);
    write_buffer(slot.sets[kReach], 0, tiles_);
    write_buffer(slot.sets[kReach], 1, reach_);
    write_buffer(slot.sets[kReach], 2, lamps_);
    write_buffer(slot.sets[kReach], 3, boxes_);
    write_buffer(slot.sets[kReach], 4, kept_);
    write_buffer(slot.sets[kReach], 5, cell_lamps_);
    write_image(slot.sets[kGather], 0, kSampled, {linear_, cells_.view(), kLayout});
    write_buffer(slot.sets[kGather], 2, reach_);
    write_image(slot.sets[kGather], 3, kStored, {VK_NULL_HANDLE, gathered_.view(), kLayout});
    write_image(slot.sets[kCombine], 3, kSampled, {linear_, gathered_.view(), kLayout});
    write_image(slot.sets[kCombine], 1, kSampled, {linear_, cells_.view(), kLayout});
    write_buffer(slot.sets[kCombine], 6, kept_);
    write_buffer(slot.sets[kCombine], 7, boxes_);
    write_buffer(slot.sets[kCombine], 8, reach_);
    write_buffer(slot.sets[kCombine], 9, cell_lamps_);
}

void RealtimePass::write_given(const Slot& slot, const RealtimeImages& images) const {
    const auto sampled = [this](const RealtimeImages::Input& input) {
        return VkDescriptorImageInfo{nearest_, input.view, input.layout};
    };
    write_image(slot.sets[kMeasure], 0, kSampled, sampled(images.colour));
    for (const Step step : {kSplit, kCombine})
        write_image(slot.sets[step], 0, kSampled, sampled(images.colour));
    write_image(slot.sets[kSplit], 1, kSampled, sampled(images.depth));
    // Frames without a layer bind the colour instead, because something must be bound.
    write_image(slot.sets[kCombine], 2, kSampled, sampled(images.layer.view ? images.layer : images.colour));
    write_image(slot.sets[kCombine], 4, kStored, {VK_NULL_HANDLE, images.result, VK_IMAGE_LAYOUT_GENERAL});
}

void RealtimePass::set_lens(std::shared_ptr<const engine::RealtimeLens> lens) {
    {
        const std::lock_guard lock(mutex_);
        if (chosen_ && chosen_->lens == lens) return;
    }
    const auto loaded = std::make_shared<Loaded>();
    loaded->written = heap_.allocate(Kind::ToDevice, lens->bytes());
    loaded->on_device = heap_.allocate(Kind::OnDevice, lens->bytes());
    std::memcpy(loaded->written->mapped(), lens->fours.data(), lens->bytes());
    loaded->lens = std::move(lens);
    const std::lock_guard lock(mutex_);
    chosen_ = loaded;
}

void RealtimePass::write_lens(const Slot& slot) const {
    write_buffer(slot.sets[kGather], 1, slot.lens->on_device);
    write_buffer(slot.sets[kCombine], 5, slot.lens->on_device);
}

// Bytes of its images and buffers, each once. Cached reads (the lens's shapes) and buffers that only lamps
// need are not included.
std::uint64_t RealtimePass::least_bytes(Step step) const {
    const std::uint64_t pixels = std::uint64_t(settings_.width) * settings_.height,
                        tiles = std::uint64_t(tiles_x()) * tiles_y(), cells = tiles * kGroup * kGroup;
    const std::uint64_t colour = settings_.result == RealtimeResult::Float ? 16 : 8, depth = 4, texel = 8;
    // Four layers of the finest level; a quarter, a sixteenth and a 64th of them of the others.
    const std::uint64_t all_cells = cells * 4 * texel * 85 / 64, gathered = cells * 3 * texel;
    const std::uint64_t radii = cells * texel;
    switch (step) {
        case kMeasure:
            return pixels * colour + tiles * 8;
        case kSplit:
            return pixels * (colour + depth) + all_cells + radii + tiles * (8 + 16 + 16);
        case kReach:
            return tiles * (16 + 16 + 16 + 16 + 16);
        case kGather:
            return all_cells + gathered + tiles * 16;
        default:
            return pixels * (colour + colour) + radii + gathered + tiles * (16 + 16 + 16);
    }
}

void RealtimePass::order(VkCommandBuffer commands, VkPipelineStageFlags from, VkAccessFlags written,
                         VkPipelineStageFlags to) const {
    VkMemoryBarrier barrier = {};
    barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
    barrier.srcAccessMask = written;
    barrier.dstAccessMask = to == VK_PIPELINE_STAGE_TRANSFER_BIT
                                ? VK_ACCESS_TRANSFER_WRITE_BIT
                                : VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT;
    vk_.vkCmdPipelineBarrier(commands, from, to, 0, 1, &barrier, 0, nullptr, 0, nullptr);
}

// Waits, on the device, for the frame before: its images are free again, and the lens is copied if it
// changed.
void RealtimePass::take_lens(VkCommandBuffer commands, Slot& slot) {
    constexpr VkPipelineStageFlags kCompute = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT;
    {
        const std::lock_guard lock(mutex_);
        slot.lens = chosen_;
    }
    Loaded& loaded = *slot.lens;
    if (loaded.copied_in == &slot) {
        if (loaded.written) loaded.written.reset(), heap_.trim();
    } else if (!loaded.copied_in) {
        order(commands, kCompute, 0, VK_PIPELINE_STAGE_TRANSFER_BIT);
        const VkBufferCopy copy = {loaded.written->offset(), loaded.on_device.offset(), loaded.lens->bytes()};
        vk_.vkCmdCopyBuffer(commands, loaded.written->buffer(), loaded.on_device.buffer(), 1, &copy);
        loaded.copied_in = &slot;
    }
    write_lens(slot);
    const std::array own{cells_.handle(), gathered_.handle(), layer_.handle()};
    std::array<VkImageMemoryBarrier, 3> fresh = {};
    const std::uint32_t images = slot.is_of_layer ? 3 : 2;
    for (std::size_t i = 0; i < images; ++i) {
        fresh[i].sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER;
        fresh[i].dstAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
        fresh[i].oldLayout = VK_IMAGE_LAYOUT_UNDEFINED, fresh[i].newLayout = VK_IMAGE_LAYOUT_GENERAL;
        fresh[i].srcQueueFamilyIndex = fresh[i].dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
        fresh[i].image = own[i];
        fresh[i].subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, VK_REMAINING_MIP_LEVELS, 0,
                                     VK_REMAINING_ARRAY_LAYERS};
    }
    vk_.vkCmdPipelineBarrier(commands, kCompute, kCompute, 0, 0, nullptr, 0, nullptr, images, fresh.data());
    order(commands, VK_PIPELINE_STAGE_TRANSFER_BIT | kCompute,
          VK_ACCESS_TRANSFER_WRITE_BIT | VK_ACCESS_SHADER_WRITE_BIT, kCompute);
}

void RealtimePass::begin(VkCommandBuffer commands, std::uint32_t slot, const RealtimeImages& images,
                         const RealtimeOptics& optics) {
    take_lens(commands, slots_[slot]);
    write_given(slots_[slot], images);
    slots_[slot].push = {std::int32_t(images.width ? images.width : settings_.width),
                         std::int32_t(images.height ? images.height : settings_.height),
                         std::int32_t(tiles_x()),
                         std::int32_t(tiles_y()),
                         optics,
                         images.layer.view ? 1u : 0u,
                         images.exposure,
                         images.field,
                         images.view};
}

// A frame smaller than the images has tiles around it that continue its border, as far as anything reads
// them. So the programs need not know where the images end.
Groups RealtimePass::groups_of(Step step, std::uint32_t width, std::uint32_t height,
                               std::uint32_t rim_px) const {
    const auto up = [](std::uint32_t count, std::uint32_t of) { return (count + of - 1) / of; };
    const auto with_rim = [&](std::uint32_t rim) {
        return Groups{std::min(tiles_x(), up(width + rim, 2 * kGroup)),
                      std::min(tiles_y(), up(height + rim, 2 * kGroup))};
    };
    constexpr std::uint32_t kWindow = 4 * 2 * kGroup;  // pixels: tiles that `split` measures around its own
    switch (step) {
        case kMeasure:
            return with_rim(rim_px + kWindow);
        case kSplit:
            return with_rim(rim_px);
        case kReach:
            return {up(tiles_x() * tiles_y(), 64)};
        case kGather:
            return with_rim(2);  // `combine` interpolates between cells
        default:
            return {up(width, kGroup), up(height, kGroup)};
    }
}

void RealtimePass::bind(VkCommandBuffer commands, const Slot& slot, Step step, bool plant) {
    if (step > 0 && !(plant && step == kGather))
        order(commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_WRITE_BIT,
              VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT);
    const Program& run = program(slot, step);
    vk_.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, run.pipeline);
    vk_.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, run.layout, 0, 1, &slot.sets[step],
                                0, nullptr);
    vk_.vkCmdPushConstants(commands, run.layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof slot.push,
                           &slot.push);
}

const Program& RealtimePass::program(const Slot& slot, Step step) const {
    return slot.is_of_layer ? programs_->of_layer(step) : (*programs_)[step];
}

void RealtimePass::record(VkCommandBuffer commands, std::uint32_t slot, const RealtimeImages& images,
                          const RealtimeOptics& optics) {
    RealtimeImages frame = images;
    slots_[slot].has_layer = images.layer.view && images.layer_depth.view;
    if (slots_[slot].has_layer) {
        RealtimeImages layer = images;
        layer.colour = images.layer;
        layer.depth = images.layer_depth;
        layer.layer = layer.layer_depth = {};
        layer.result = layer_.view();
        layer.view = RealtimeView::Picture;
        record_steps(commands, slot + settings_.slots, layer, optics);
        frame.layer = {layer_.view(), VK_IMAGE_LAYOUT_GENERAL};
    }
    record_steps(commands, slot, frame, optics);
}

void RealtimePass::record_steps(VkCommandBuffer commands, std::uint32_t slot, const RealtimeImages& images,
                                const RealtimeOptics& optics) {
    begin(commands, slot, images, optics);
    const Push& push = slots_[slot].push;
    // Pixels that discs, kernels of lamps and means of cells reach.
    const auto rim_px =
        std::uint32_t(float(engine::LampKernels::kHalf) * optics.most_px * std::max(1.0f, optics.aspect)) +
        4 * kGroup;
    if (queries_) {
        vk_.vkCmdResetQueryPool(commands, queries_, slot * (kSteps + 1), kSteps + 1);
        slots_[slot].is_timed = true;
    }
    write_time(commands, slot, 0);
    const bool has_labels = vk_.vkCmdBeginDebugUtilsLabelEXT && vk_.vkCmdEndDebugUtilsLabelEXT;
    for (const Step step : {kMeasure, kSplit, kReach, kGather, kCombine}) {
        const std::string said = std::string("petzval ") + kNames[step];
        VkDebugUtilsLabelEXT label = {};
        label.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT, label.pLabelName = said.c_str();
        if (has_labels) vk_.vkCmdBeginDebugUtilsLabelEXT(commands, &label);
        bind(commands, slots_[slot], step, false);
        const Groups all = groups_of(step, std::uint32_t(push.width), std::uint32_t(push.height), rim_px);
        vk_.vkCmdDispatch(commands, all.x, all.y, 1);
        write_time(commands, slot, step + 1);
        if (has_labels) vk_.vkCmdEndDebugUtilsLabelEXT(commands);
    }
}

void RealtimePass::record(Recording& recording, std::uint32_t slot, Step step, const Part& part, bool plant) {
    const Groups all = groups(step);
    bind(recording.commands(), slots_[slot], step, plant);
    recording.begin_pass(kNames[step], {least_bytes(step) * part.groups() / (std::size_t(all.x) * all.y), 0});
    // Debian's synchronisation validation does not look at dispatches with a base: the first part is one
    // without.
    if (part.x == 0 && part.y == 0)
        vk_.vkCmdDispatch(recording.commands(), part.width, part.height, 1);
    else
        vk_.vkCmdDispatchBase(recording.commands(), part.x, part.y, 0, part.width, part.height, 1);
    recording.end_pass();
}

}  // namespace petzval::device::vulkan
