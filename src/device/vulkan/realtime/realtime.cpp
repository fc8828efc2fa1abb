#include "device/vulkan/realtime/realtime.h"

#include "device/failure.h"
#include "device/vulkan/canvas.h"
#include "device/vulkan/driver/parts.h"
#include "device/vulkan/realtime/pass.h"
#include "device/vulkan/realtime/work.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace petzval::device::vulkan {
namespace {

// Rows y0…y1 - 1.
template <typename T>
std::vector<T> packed(View<const T> picture, int y0, int y1) {
    std::vector<T> values;
    values.reserve(std::size_t(picture.width()) * std::size_t(y1 - y0));
    for (int y = y0; y < y1; ++y)
        values.insert(values.end(), picture.row(y), picture.row(y) + picture.width());
    return values;
}

// State of an image: layout, stage and access of its last use.
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

// Rows that are drawn together begin on whole tiles, so that cells and tiles are those of the whole picture.
constexpr int kTile = 16;
int whole_tiles(float rows) { return int(std::ceil(rows / float(kTile))) * kTile; }

}  // namespace

// Resources of one frame size.
class RealtimeDrawer::Frame {
public:
    Frame(Context& context, std::uint32_t width, std::uint32_t height)
        : context_(context),
          width_(width),
          height_(height),
          pass_(context.opened(), context.candidate().memory,
                {.width = width,
                 .height = height,
                 .slots = 1,
                 .result = RealtimeResult::Float,
                 .is_cut = true}) {
        constexpr VkImageUsageFlags kInput = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
        colour_ = made(VK_FORMAT_R32G32B32A32_SFLOAT, kInput);
        radii_ = made(VK_FORMAT_R32_SFLOAT, kInput);
        result_ =
            made(VK_FORMAT_R32G32B32A32_SFLOAT, VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
    }

    bool is_of(std::uint32_t width, std::uint32_t height) const {
        return width == width_ && height == height_;
    }

    // Rows y0…y1 - 1 of a picture, with surrounding rows from `first` on.
    struct Strip {
        int first, y0, y1;
    };
    // Writes the strip's rows of `out`. False: cancelled.
    bool draw(const engine::RealtimePlan& plan, const Strip& strip, Target out, std::uint64_t most_work,
              const Progress& progress, bool plant) {
        pass_.set_lens(plan.lens);
        Submissions submissions(context_, "realtime", most_work);
        const RealtimeOptics optics{0, 1, plan.most_px, plan.pixel_aspect};
        const std::array<Piece, 2> sent = begin(submissions.recording(), plan, strip.first, optics);
        RealtimeWork work(pass_.tiles_x(), pass_.tiles_y(), optics);
        for (const Step step : {RealtimePass::kMeasure, RealtimePass::kSplit, RealtimePass::kReach,
                                RealtimePass::kGather, RealtimePass::kCombine}) {
            // The work of the last step is known once the lamps have been found.
            if (step == RealtimePass::kCombine) count_lamps(submissions, work);
            if (!draw_step(step, submissions, work, progress, plant)) return false;
        }
        Recording& last = submissions.recording();
        move(last.commands(), result_, kWritten, kCopiedFrom);
        const Piece made = context_.heap().allocate(Kind::OnDevice, sent[0].size());
        const VkBufferImageCopy whole = copy_of(made);
        context_.vk().vkCmdCopyImageToBuffer(last.commands(), result_.handle(), kCopiedFrom.layout,
                                             made.buffer(), 1, &whole);
        Delivery delivery(context_, out);
        delivery.rows(last, made, strip.first, strip.y0, strip.y1);
        submissions.run();
        delivery.finish();
        most_lamps_ = work.most_lamps();
        return true;
    }
    std::uint64_t most_lamps() const { return most_lamps_; }

private:
    using Step = RealtimePass::Step;

    // Returns the pieces that must live until the recording has run.
    std::array<Piece, 2> begin(Recording& recording, const engine::RealtimePlan& plan, int first,
                               const RealtimeOptics& optics) {
        const std::vector<Rgba> colours = packed<Rgba>(plan.colour, first, first + int(height_));
        const std::vector<float> radii = packed<float>(plan.coc_px, first, first + int(height_));
        std::array<Piece, 2> sent{recording.uploaded(std::span(colours)),
                                  recording.uploaded(std::span(radii))};
        recording.wait_for_uploads();
        fill(recording.commands(), sent[0], colour_), fill(recording.commands(), sent[1], radii_);
        move(recording.commands(), result_, kFresh, kWritten);
        RealtimeImages images;
        images.colour.view = colour_.view(), images.depth.view = radii_.view();
        images.result = result_.view();
        const Rect frame =
            plan.frame.empty() ? Rect{0, 0, plan.colour.width(), plan.colour.height()} : plan.frame;
        images.field = RealtimeField::whole(std::uint32_t(frame.width()), std::uint32_t(frame.height()));
        images.field.add_x = -float(frame.x0) * images.field.scale_x;
        images.field.add_y = float(first - frame.y0) * images.field.scale_y;
        pass_.begin(recording.commands(), 0, images, optics);
        return sent;
    }

    // Draws a step; work that does not fit a submission goes to the next. False: cancelled.
    bool draw_step(Step step, Submissions& submissions, const RealtimeWork& work, const Progress& progress,
                   bool plant) {
        const Groups all = pass_.groups(step);
        const auto work_of = [&](std::uint32_t x, std::uint32_t y) { return work.of_group(step, x, y); };
        for (std::size_t first = 0; first < std::size_t(all.x) * all.y;) {
            if (submissions.left() == 0) submissions.run(), submissions.begin_next();
            if (progress.cancelled()) return false;
            const Part part = part_from(first, all, submissions.left(), work_of);
            pass_.record(submissions.recording(), 0, step, part, plant);
            submissions.add(part.work);
            first += part.groups();
        }
        return true;
    }

    void count_lamps(Submissions& submissions, RealtimeWork& work) {
        const std::size_t bytes = std::size_t(pass_.tiles_x()) * pass_.tiles_y() * 4 * sizeof(std::uint32_t);
        Recording& recording = submissions.recording();
        const std::byte* const kept = recording.downloaded(pass_.lamps_kept(), bytes);
        const std::byte* const boxes = recording.downloaded(pass_.lamp_boxes(), bytes);
        submissions.run();
        work.take_lamps(reinterpret_cast<const std::uint32_t*>(kept),
                        reinterpret_cast<const std::int32_t*>(boxes));
        submissions.begin_next();
    }

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
    const std::uint32_t width_, height_;
    RealtimePass pass_;
    DeviceImage colour_, radii_, result_;
    std::uint64_t most_lamps_ = 0;
};

RealtimeDrawer::RealtimeDrawer(Context& context, const RealtimeRule& rule) : context_(context), rule_(rule) {}
RealtimeDrawer::~RealtimeDrawer() = default;

// Measured with llvmpipe of Mesa 22.3 and NVIDIA's driver 580 (docs/results/memory.md).
std::size_t RealtimeDrawer::process_bytes(std::size_t pixels) const {
    constexpr std::size_t kSoftwareDriver = std::size_t(85) << 20, kOfPixel = 88;
    constexpr std::size_t kHardwareDriver = std::size_t(115) << 20;
    if (!context_.candidate().is_software) return kHardwareDriver;
    return kSoftwareDriver + kOfPixel * std::min(pixels, rule_.most_pixels);
}

int RealtimeDrawer::passes_made() const {
    const std::lock_guard lock(mutex_);
    return passes_made_;
}

std::uint64_t RealtimeDrawer::most_lamps() const {
    const std::lock_guard lock(mutex_);
    return most_lamps_;
}

std::unique_ptr<RealtimeDrawer::Frame> RealtimeDrawer::frame_of(std::uint32_t width, std::uint32_t height) {
    {
        const std::lock_guard lock(mutex_);
        const auto known =
            std::find_if(idle_.begin(), idle_.end(), [&](const auto& f) { return f->is_of(width, height); });
        if (known != idle_.end()) {
            auto frame = std::move(*known);
            idle_.erase(known);
            return frame;
        }
        idle_.clear();  // their memory is needed more than they are
        ++passes_made_;
    }
    return std::make_unique<Frame>(context_, width, height);
}

void RealtimeDrawer::keep(std::unique_ptr<Frame> frame) {
    constexpr std::size_t kMostIdle = 2;  // the whole strips of a picture, and its last one
    const std::lock_guard lock(mutex_);
    most_lamps_ = frame->most_lamps();
    if (idle_.size() < kMostIdle) idle_.push_back(std::move(frame));
}

void RealtimeDrawer::draw(const engine::RealtimePlan& plan, Target out, const Progress& progress,
                          bool plant) {
    const int width = plan.colour.width(), height = plan.colour.height();
    const std::uint32_t most = context_.candidate().limits.maxImageDimension2D;
    if (std::uint32_t(width) > most)
        throw Failed{{ErrorCode::Unsupported,
                      context_.name() + " takes pictures of up to " + std::to_string(most) +
                          " pixels a row in real time; this one has " + std::to_string(width)}};
    // Rows that influence a row: discs of lamps; surroundings, which a tile takes from the next
    // four, and means.
    const float reach = float(engine::LampKernels::kHalf) * plan.most_px * plan.pixel_aspect + 2;
    const int halo = whole_tiles(std::min(reach, float(height))) + 5 * kTile;
    for (int y = 0; y < height;) {
        const int rows = rows_at_once(width, height, halo), end = std::min(height, y + rows);
        const int first = std::max(0, y - halo), last = std::min(height, end + halo);
        try {
            auto frame = frame_of(std::uint32_t(width), std::uint32_t(last - first));
            const bool is_drawn =
                frame->draw(plan, {first, y, end}, out, rule_.most_multiply_adds, progress, plant);
            keep(std::move(frame));
            if (!is_drawn) return;
            y = end;
        } catch (const Failed& failed) {
            while (rows_at_once(width, height, halo) >= rows)
                if (rows <= kTile || !context_.halves(failed)) throw;
        }
    }
}

// Whole tiles, or all rows there are; `halo` rows above and below them are not counted.
int RealtimeDrawer::rows_at_once(int width, int height, int halo) const {
    const auto rows_in = [width](std::size_t pixels) {
        constexpr std::size_t kMost = std::size_t(1) << 20;
        return int(std::min(pixels / std::size_t(width), kMost));
    };
    const auto whole = [halo](int rows) { return (rows - 2 * halo) / kTile * kTile; };
    const int wished = rows_in(rule_.most_pixels), left = rows_in(context_.at_once(rule_.most_pixels));
    const int most = std::min(wished, int(context_.candidate().limits.maxImageDimension2D));
    // At least as many rows as their surroundings: more memory is better than drawing every pixel many times.
    const int rows = height <= most ? height : std::max(halo, whole(most));
    const bool fits = left == wished || std::min(height, rows + 2 * halo) <= left;
    return fits ? rows : std::min(rows, std::max(kTile, whole(left)));  // one row of tiles, if need be
}

void RealtimeDrawer::let_go() {
    const std::lock_guard lock(mutex_);
    idle_.clear();
}

}  // namespace petzval::device::vulkan
