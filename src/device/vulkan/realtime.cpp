#include "device/vulkan/realtime.h"

#include "device/failure.h"
#include "device/vulkan/realtime_pass.h"
#include "device/vulkan/recording.h"

#include <algorithm>
#include <string>
#include <vector>

namespace petzval::device::vulkan {
namespace {

template <typename T>
std::vector<T> packed(View<const T> picture) {
    std::vector<T> values;
    values.reserve(std::size_t(picture.width()) * std::size_t(picture.height()));
    for (int y = 0; y < picture.height(); ++y)
        values.insert(values.end(), picture.row(y), picture.row(y) + picture.width());
    return values;
}

// Where an image is at, and what was last done with it.
struct At {
    VkImageLayout layout;
    VkPipelineStageFlags stage;
    VkAccessFlags access;
};
constexpr At kFresh{VK_IMAGE_LAYOUT_UNDEFINED, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, 0},
    kCopiedTo{VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_PIPELINE_STAGE_TRANSFER_BIT,
              VK_ACCESS_TRANSFER_WRITE_BIT},
    kRead{VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
          VK_ACCESS_SHADER_READ_BIT},
    kWritten{VK_IMAGE_LAYOUT_GENERAL, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_WRITE_BIT},
    kCopiedFrom{VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_PIPELINE_STAGE_TRANSFER_BIT,
                VK_ACCESS_TRANSFER_READ_BIT};

class Frame {
public:
    Frame(Context& context, const engine::RealtimePlan& plan)
        : context_(context),
          plan_(plan),
          width_(std::uint32_t(plan.colour.width())),
          height_(std::uint32_t(plan.colour.height())) {
        const std::uint32_t most = context.candidate().limits.maxImageDimension2D;
        if (std::max(width_, height_) > most)
            throw Failed{{ErrorCode::Unsupported, context.name() + " takes pictures of up to " +
                                                      std::to_string(most) + " pixels a side in real time"}};
        constexpr VkImageUsageFlags kInput = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
        colour_ = made(VK_FORMAT_R32G32B32A32_SFLOAT, kInput);
        radii_ = made(VK_FORMAT_R32_SFLOAT, kInput);
        result_ =
            made(VK_FORMAT_R32G32B32A32_SFLOAT, VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
    }

    void draw(View<Rgba> out, bool plant) {
        RealtimeSettings settings;
        settings.width = width_, settings.height = height_, settings.has_float_result = true;
        RealtimePass pass(context_.opened(), context_.candidate().memory, settings);
        pass.set_lens(plan_.lens);
        Recording recording(context_);
        const std::vector<Rgba> colours = packed<Rgba>(plan_.colour);
        const std::vector<float> radii = packed<float>(plan_.coc_px);
        const Piece colour = recording.uploaded(std::span(colours)),
                    radius = recording.uploaded(std::span(radii));
        recording.wait_for_uploads();
        fill(recording.commands(), colour, colour_), fill(recording.commands(), radius, radii_);
        move(recording.commands(), result_, kFresh, kWritten);
        RealtimeImages images;
        images.colour.view = colour_.view(), images.depth.view = radii_.view();
        images.result = result_.view();
        pass.record(recording.commands(), 0, images, {0, 1, plan_.most_px, plan_.pixel_aspect}, plant);
        move(recording.commands(), result_, kWritten, kCopiedFrom);
        const std::size_t bytes = colours.size() * sizeof(Rgba);
        const Piece made = context_.heap().allocate(Kind::OnDevice, bytes);
        const VkBufferImageCopy whole = copy_of(made);
        context_.vk().vkCmdCopyImageToBuffer(recording.commands(), result_.handle(), kCopiedFrom.layout,
                                             made.buffer(), 1, &whole);
        const auto* from = reinterpret_cast<const Rgba*>(recording.downloaded(made, bytes));
        recording.run();
        for (int y = 0; y < out.height(); ++y, from += width_) std::copy_n(from, width_, out.row(y));
    }

private:
    DeviceImage made(VkFormat format, VkImageUsageFlags usage) const {
        ImageKind kind;
        kind.format = format, kind.width = width_, kind.height = height_, kind.usage = usage;
        return {context_.opened(), context_.candidate().memory, kind};
    }
    VkBufferImageCopy copy_of(const Piece& piece) const {
        VkBufferImageCopy copy = {};
        copy.bufferOffset = piece.offset();
        copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
        copy.imageExtent = {width_, height_, 1};
        return copy;
    }
    void move(VkCommandBuffer commands, const DeviceImage& image, const At& from, const At& to) const {
        VkImageMemoryBarrier barrier = {};
        barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER;
        barrier.srcAccessMask = from.access, barrier.dstAccessMask = to.access;
        barrier.oldLayout = from.layout, barrier.newLayout = to.layout;
        barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
        barrier.image = image.handle();
        barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
        context_.vk().vkCmdPipelineBarrier(commands, from.stage, to.stage, 0, 0, nullptr, 0, nullptr, 1,
                                           &barrier);
    }
    void fill(VkCommandBuffer commands, const Piece& from, const DeviceImage& image) const {
        move(commands, image, kFresh, kCopiedTo);
        const VkBufferImageCopy whole = copy_of(from);
        context_.vk().vkCmdCopyBufferToImage(commands, from.buffer(), image.handle(), kCopiedTo.layout, 1,
                                             &whole);
        move(commands, image, kCopiedTo, kRead);
    }

    Context& context_;
    const engine::RealtimePlan& plan_;
    const std::uint32_t width_, height_;
    DeviceImage colour_, radii_, result_;
};

}  // namespace

void draw_realtime(Context& context, const engine::RealtimePlan& plan, View<Rgba> out, bool plant) {
    Frame(context, plan).draw(out, plant);
}

}  // namespace petzval::device::vulkan
