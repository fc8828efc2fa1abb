/* The pass for real time, recorded into a host's own command buffer: colour and depth that are on the GPU in,
 * the picture that a lens would have taken out, on the GPU. Part of libpetzval.so where it was built with
 * Vulkan. docs/reference/devices.md says how it is used, examples/embed_vulkan.cpp shows it, every line
 * explained.
 *
 * - Instance, device, queue, command buffers and images are the host's. What is ours is made by
 * petzval_pass_open() and petzval_pass_resize(), never by petzval_pass_record(): that allocates nothing on
 * the device, waits for nothing and submits nothing.
 * - The device needs no extension, and a feature for one format of the result alone: Vulkan 1.2, compute, 4
 * storage images and 128 invocations a group.
 * - Hold: before the pass, the host makes colour, depth and layer visible to VK_ACCESS_SHADER_READ_BIT of
 *   VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, in the layouts it names, and brings the result into
 *   VK_IMAGE_LAYOUT_GENERAL, free to be written by that stage: by barriers of its own, or by a semaphore that
 * the submission waits for at that stage.
 * - Release: after the pass, the result was written by VK_ACCESS_SHADER_WRITE_BIT of that stage, in
 *   VK_IMAGE_LAYOUT_GENERAL; no image changed its layout. The host's next barrier or semaphore goes on from
 * there.
 * - Dispatches have labels, programs and images have names, where the host enabled VK_EXT_debug_utils.
 * - What one pass records runs on queues of one family, one submission after the other: its own images serve
 *   every frame in flight, and its first barrier waits for compute work that was submitted to the queue
 * before.
 * - In a frame its place is after temporal anti-aliasing or upscaling, before motion blur, bloom and the tone
 *   curve: it takes light, and the discs of lamps flicker if lamps do.
 * - On a queue for asynchronous compute, colour and depth come over by a semaphore and, where they are
 * exclusive, a transfer of their ownership to that family; so does the result, back. Images that are
 * concurrent need the semaphore alone.
 * - A frame is five dispatches, ten if a layer is blurred, in one command buffer, which nobody cuts: where
 * systems end what takes a device seconds, as at 4K under hundreds of lamps a pixel on a small one, a host
 * draws at less resolution, or takes a smaller largest_radius_px, so that fewer lamps reach a pixel, and
 * looks at its own timestamps.
 */
#ifndef PETZVAL_VULKAN_H
#define PETZVAL_VULKAN_H

#include "petzval/petzval_c.h"

#include <vulkan/vulkan.h>

/* This is C: NOLINTBEGIN(modernize-use-using,modernize-deprecated-headers,readability-identifier-naming) */
#ifdef __cplusplus
extern "C" {
#endif

typedef struct petzval_pass petzval_pass;

typedef struct petzval_pass_settings {
    size_t size;
    PFN_vkGetInstanceProcAddr get_instance_proc_addr;
    VkInstance instance;
    VkPhysicalDevice physical_device;
    VkDevice device;
    uint32_t width, height;    /* pixels, 1…16384 */
    uint32_t frames_in_flight; /* slots, 1…16; 0: 2 */
    /* VK_FORMAT_R16G16B16A16_SFLOAT, VK_FORMAT_R32G32B32A32_SFLOAT, or VK_FORMAT_B10G11R11_UFLOAT_PACK32,
     * which drops alpha and needs the device's feature shaderStorageImageExtendedFormats enabled;
     * VK_FORMAT_UNDEFINED: the first. */
    VkFormat result_format;
    /* The host's cache for the five programs, which petzval_pass_open() makes; null: none. It may be
     * destroyed afterwards. */
    VkPipelineCache pipeline_cache;
    /* Not 0: petzval_pass_times() tells what each dispatch took. The queue's family needs timestamps. */
    int measures_times;
    /* Not 0: a frame's layer may have a depth of its own and is blurred by it. 8 bytes a pixel. */
    int blurs_layers;
    /* The host's own memory for the pass's images, as petzval_pass_needs() asks for it: `memory_size` bytes
     * from `memory_offset` on, for the largest size that the pass will have. Between frames the host may use
     * it for other things. Null: the pass takes its own. */
    VkDeviceMemory memory;
    VkDeviceSize memory_offset, memory_size;
} petzval_pass_settings;

/* What the images of a pass with these settings need. Their `memory` is not looked at. */
PETZVAL_C_API petzval_status petzval_pass_needs(const petzval_pass_settings* settings,
                                                VkMemoryRequirements* needed);

/* The ideal lens until petzval_pass_set_lens(). */
PETZVAL_C_API petzval_status petzval_pass_open(const petzval_pass_settings* settings, petzval_pass** pass);
/* Nothing that it recorded may be under way, here and when it is closed. The lens stays, made anew for pixels
 * of this size: as long as petzval_pass_set_lens() takes. The programs stay, and so does the host's
 * memory: a size that does not fit there is refused. If it fails, the pass is as it was. */
PETZVAL_C_API petzval_status petzval_pass_resize(petzval_pass* pass, uint32_t width, uint32_t height);
PETZVAL_C_API void petzval_pass_close(petzval_pass* pass);

/* Makes the shapes of the look's lens on this camera: milliseconds, for lenses with surfaces up to seconds.
 * A lens whose discs change over the frame, as a cat's eye does, has 45 shapes: 45 times as long, and 96 MB
 * of the device's memory instead of 2, as much again where the host writes until the frame after has begun.
 * From any thread, beside petzval_pass_record(): frames have the lens before until it is done. The look's
 * quality sets the taps of a disc: draft 24, standard 48, final 127. All else of a look is not used. */
PETZVAL_C_API petzval_status petzval_pass_set_lens(petzval_pass* pass, const petzval_look* look,
                                                   const petzval_camera* camera);

typedef struct petzval_pass_image {
    VkImageView view;     /* of a 2D image, its depth aspect where it is depth */
    VkImageLayout layout; /* UNDEFINED (0): VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL */
} petzval_pass_image;

/* A frame shows the picture, or a part of it to find a fault, in scene-linear light. */
typedef enum petzval_pass_view {
    PETZVAL_PASS_PICTURE = 0,
    PETZVAL_PASS_RADII =
        1, /* share of the largest radius: red in front of focus, blue behind; green in focus */
    PETZVAL_PASS_BEHIND = 2,   /* light in focus and behind it, estimated where something hides it */
    PETZVAL_PASS_IN_FRONT = 3, /* light in front of focus, premultiplied by its coverage */
    PETZVAL_PASS_LAMPS = 4,    /* what lamps add */
    PETZVAL_PASS_TILES =
        5 /* red: the largest radius in front of focus that reaches a tile; green: fine blur */
} petzval_pass_view;

typedef struct petzval_pass_frame {
    size_t size;
    VkCommandBuffer commands;  /* recording, outside of a render pass */
    uint32_t slot;             /* 0…frames_in_flight - 1; what was recorded into it before has run */
    petzval_pass_image colour; /* scene-linear, premultiplied, of any format that is sampled as floats */
    petzval_pass_image depth;
    petzval_pass_image layer; /* what is above all, as glass and smoke are: premultiplied; view null: none */
    VkImageView result;       /* of the settings' format, VK_IMAGE_USAGE_STORAGE_BIT */
    /* A depth d is so many metres away, along the axis: 1 / (depth_scale * d + depth_bias). Reversed and
     * infinite: 1 / near and 0. From `near` at 0 to `far` at 1: 1 / far - 1 / near and 1 / near. */
    double depth_scale, depth_bias;
    const petzval_camera* camera; /* of this frame; the sensor's width spans the picture */
    double pixel_aspect;          /* width / height of a pixel; 0: 1 */
    double largest_radius_px;     /* radii are cut there; 0: a twentieth of the width */
    /* The frame is this part of all images, from the top left, as a host has it that draws fewer pixels when
     * time is short; both 0: all that the pass was opened for. Radii are those of a sensor that spans it. */
    uint32_t width, height;
    /* What the host multiplies light by before its tone curve; 0: 1. Estimates of hidden light weigh it as it
     * will be seen: the result for k times the light and 1 / k here is k times as bright. */
    double exposure;
    /* Depth of the layer, as `depth` has it; needs settings.blurs_layers. The layer is then blurred like a
     * picture of its own, which takes as long again, and laid over. View null: the layer stays sharp. */
    petzval_pass_image layer_depth;
    petzval_pass_view view;
} petzval_pass_frame;

PETZVAL_C_API petzval_status petzval_pass_record(petzval_pass* pass, const petzval_pass_frame* frame);

/* Writes five milliseconds of the device, for measure, split, reach, gather and combine, of the last frame
 * recorded into a slot, its layer's included. Waits for nothing: PETZVAL_INVALID_ARGUMENT while that frame
 * has not run, or if settings.measures_times is 0. */
PETZVAL_C_API petzval_status petzval_pass_times(const petzval_pass* pass, uint32_t slot,
                                                double* milliseconds);

#ifdef __cplusplus
}
#endif
/* NOLINTEND(modernize-use-using,modernize-deprecated-headers,readability-identifier-naming) */
#endif
