// The pass for real time (docs/explain/real-time.md), recorded into somebody's command buffer.
#pragma once

#include "device/vulkan/driver/image.h"
#include "device/vulkan/driver/parts.h"
#include "device/vulkan/driver/pipeline.h"
#include "engine/gather/realtime_plan.h"

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

namespace petzval::device::vulkan {

enum class RealtimeResult { Half, Float, Packed };  // rgba16f, rgba32f, r11f_g11f_b10f

struct RealtimeSettings {
    std::uint32_t width = 0, height = 0;  // pixels
    std::uint32_t slots = 1;              // frames that may be in flight
    RealtimeResult result = RealtimeResult::Half;
    bool is_cut = false;                     // frames are recorded in parts
    bool is_timed = false;                   // by timestamps around each step
    bool blurs_layers = false;               // frames may have a layer with a depth of its own
    VkPipelineCache cache = VK_NULL_HANDLE;  // for programs; outlives their making alone
    LentMemory lent = {};                    // for images
};

// A signed radius, in pixels, is add_px + per_depth_px * depth.
struct RealtimeOptics {
    float add_px = 0, per_depth_px = 0, most_px = 0, aspect = 1;
};

// Share of the way from the first zone to the last at the point p of an image, in pixels: scale * p + add.
struct RealtimeField {
    float scale_x = 0, scale_y = 0, add_x = 0, add_y = 0;
    static RealtimeField whole(std::uint32_t width, std::uint32_t height) {
        return {1 / float(width), 1 / float(height), 0, 0};
    }
};

// A view shows a part of the picture instead of it: petzval/vulkan.h says how each looks.
enum class RealtimeView : std::uint32_t { Picture, Radii, Behind, InFront, Lamps, Tiles };

struct RealtimeImages {
    struct Input {
        VkImageView view = VK_NULL_HANDLE;
        VkImageLayout layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    };
    Input colour, depth, layer;           // layer: null: none
    Input layer_depth;                    // null: the layer is sharp. Requires: settings.blurs_layers
    VkImageView result = VK_NULL_HANDLE;  // in VK_IMAGE_LAYOUT_GENERAL
    // The part of them that is a frame, from the top left; 0: as large as the settings say.
    std::uint32_t width = 0, height = 0;
    float exposure = 1;  // estimates weigh light times this
    RealtimeField field;
    RealtimeView view = RealtimeView::Picture;
};

// The programs of a pass, which serve frames of any size. Throws Failed.
class RealtimePrograms {
public:
    // opened.vk outlives this.
    RealtimePrograms(Opened opened, const RealtimeSettings& settings);
    ~RealtimePrograms();
    RealtimePrograms(const RealtimePrograms&) = delete;
    RealtimePrograms& operator=(const RealtimePrograms&) = delete;
    enum Step { kMeasure, kSplit, kReach, kGather, kCombine, kSteps };
    const Program& operator[](Step step) const { return steps_[step]; }
    // The programs of a blurred layer, whose image has halves.
    const Program& of_layer(Step step) const {
        return step == kCombine && combine_layer_.pipeline ? combine_layer_ : steps_[step];
    }

private:
    void destroy();
    const Opened opened_;
    std::array<Program, kSteps> steps_;
    Program combine_layer_;  // null where layers are not blurred, or frames have halves too
};

// Everything is made at once and kept. Throws Failed.
class RealtimePass {
public:
    // opened.vk outlives this. programs: of a pass with the same settings, whatever its size; null: made.
    // Requires: width and height 1…16384, slots 1…16.
    RealtimePass(const Opened& opened, const VkPhysicalDeviceMemoryProperties& memory,
                 const RealtimeSettings& settings, std::shared_ptr<const RealtimePrograms> programs = {});
    ~RealtimePass();
    // Memory that the images of such a pass need together. Throws Failed.
    static VkMemoryRequirements needs(const Opened& opened, const RealtimeSettings& settings);
    RealtimePass(const RealtimePass&) = delete;
    RealtimePass& operator=(const RealtimePass&) = delete;

    // Sets the lens of later recordings and takes memory for it. From any thread. Throws Failed.
    void set_lens(std::shared_ptr<const engine::RealtimeLens> lens);
    // Allocates nothing, waits for nothing. Requires: what was recorded into this slot before has run; all
    // that is recorded runs on one queue; the inputs are visible to reads of compute shaders, and the result
    // may be written by them.
    void record(VkCommandBuffer commands, std::uint32_t slot, const RealtimeImages& images,
                const RealtimeOptics& optics);

    // The same in parts, in any number of submissions: begin(), then all parts of each step in turn. The bits
    // do not depend on them.
    using Step = RealtimePrograms::Step;
    using enum RealtimePrograms::Step;
    void begin(VkCommandBuffer commands, std::uint32_t slot, const RealtimeImages& images,
               const RealtimeOptics& optics);
    // Requires: settings.is_cut. `plant` leaves out a barrier, to see that it is missed.
    void record(Recording& recording, std::uint32_t slot, Step step, const Part& part, bool plant = false);
    Groups groups(Step step) const { return groups_of(step, settings_.width, settings_.height, 0); }
    // Ticks of the device that each step of the slot's last frame took. False: it has not run yet, or nothing
    // was recorded. Requires: settings.is_timed.
    bool ticks(std::uint32_t slot, std::array<std::uint64_t, kSteps>& taken) const;
    const std::shared_ptr<const RealtimePrograms>& programs() const { return programs_; }
    // Lamps after step kReach: per tile, row by row, its cells with lamps (two words of four), and the first
    // and last column and row of the tiles whose lamps reach it.
    const Piece& lamps_kept() const { return kept_; }
    const Piece& lamp_boxes() const { return boxes_; }
    std::uint32_t tiles_x() const { return (settings_.width + 15) / 16; }
    std::uint32_t tiles_y() const { return (settings_.height + 15) / 16; }

private:
    struct Push {
        std::int32_t width = 0, height = 0, tiles_x = 0, tiles_y = 0;
        RealtimeOptics optics;
        std::uint32_t has_layer = 0;
        float exposure = 1;
        RealtimeField field;
        RealtimeView view = RealtimeView::Picture;
    };
    static_assert(sizeof(Push) == 60, "as shaders/realtime.glsl has it");
    struct Slot;
    struct Loaded {
        std::shared_ptr<const engine::RealtimeLens> lens;
        std::optional<Piece> written;     // by the host; empty once its copy has run
        Piece on_device;                  // what programs read
        const Slot* copied_in = nullptr;  // the slot whose recording copies it; null: none yet
    };
    struct Slot {
        std::array<VkDescriptorSet, kSteps> sets = {};
        Push push;
        std::shared_ptr<Loaded> lens;  // of its last frame
        bool is_timed = false;         // its timestamps were recorded
        bool is_of_layer = false;      // draws the layers of another slot's frames
        bool has_layer = false;        // its last frame had one to blur
    };

    // Groups of a frame of this size, where cells so many pixels outside of it are read.
    Groups groups_of(Step step, std::uint32_t width, std::uint32_t height, std::uint32_t rim_px) const;
    void make();
    void destroy();
    void make_sampler(VkFilter filter, VkSampler& sampler) const;
    void make_sets();
    const Program& program(const Slot& slot, Step step) const;
    void make_queries();
    void write_time(VkCommandBuffer commands, std::uint32_t slot, std::uint32_t place) const;
    void write_own(const Slot& slot) const;
    void write_given(const Slot& slot, const RealtimeImages& images) const;
    void write_image(VkDescriptorSet set, std::uint32_t binding, VkDescriptorType type,
                     const VkDescriptorImageInfo& info) const;
    void write_buffer(VkDescriptorSet set, std::uint32_t binding, const Piece& piece) const;
    void take_lens(VkCommandBuffer commands, Slot& slot);
    void write_lens(const Slot& slot) const;
    void record_steps(VkCommandBuffer commands, std::uint32_t slot, const RealtimeImages& images,
                      const RealtimeOptics& optics);
    bool add_ticks(std::uint32_t slot, std::array<std::uint64_t, kSteps>& taken) const;
    void bind(VkCommandBuffer commands, const Slot& slot, Step step, bool plant);
    std::uint64_t least_bytes(Step step) const;
    void order(VkCommandBuffer commands, VkPipelineStageFlags from, VkAccessFlags written,
               VkPipelineStageFlags to) const;

    const Opened opened_;
    const Functions& vk_;
    const VkPhysicalDeviceMemoryProperties memory_;
    const RealtimeSettings settings_;
    Heap heap_;
    DeviceImage cells_, gathered_, layer_;
    Piece surroundings_, tiles_, lamps_, cell_lamps_, reach_, boxes_, kept_;
    VkSampler nearest_ = VK_NULL_HANDLE, linear_ = VK_NULL_HANDLE;
    std::shared_ptr<const RealtimePrograms> programs_;
    VkDescriptorPool pool_ = VK_NULL_HANDLE;
    VkQueryPool queries_ = VK_NULL_HANDLE;  // kSteps + 1 a slot; null: not timed
    std::vector<Slot> slots_;               // of frames; then, if settings_.blurs_layers, of their layers
    std::mutex mutex_;                      // of the next line
    std::shared_ptr<Loaded> chosen_;
};

}  // namespace petzval::device::vulkan
