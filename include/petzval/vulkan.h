/* The real-time pass, recorded into a host's own command buffer. It reads colour and depth on the GPU and
 * writes the picture that a lens would have taken, on the GPU. Part of libpetzval.so if built with Vulkan.
 * docs/reference/devices.md explains its use; examples/embed_vulkan.cpp is a complete host, every line
 * explained.
 *
 * - Instance, device, queue, command buffers and images belong to the host. petzval_pass_open() and
 *   petzval_pass_resize() make the pass's own objects. petzval_pass_record() allocates nothing on the device,
 *   waits for nothing and submits nothing.
 * - The device needs Vulkan 1.2, compute, 4 storage images and 128 invocations per group. It needs no
 *   extension, and a feature only for one format of the result.
 * - Before the pass, the host makes colour, depth and layer visible to VK_ACCESS_SHADER_READ_BIT of
 *   VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT in the layouts that it names. It brings the result into
 *   VK_IMAGE_LAYOUT_GENERAL, ready to be written by that stage. It does so by barriers, or by a semaphore
 * that the submission waits for at that stage.
 * - After the pass, the result was written by VK_ACCESS_SHADER_WRITE_BIT of that stage, in
 *   VK_IMAGE_LAYOUT_GENERAL; no image changed its layout. The host's next barrier or semaphore continues from
 *   there.
 * - If the host enabled VK_EXT_debug_utils, dispatches have labels, and programs and images have names.
 * - Commands of one pass run on queues of one family, one submission after the other. All frames in flight
 * use the same images, and the first barrier waits for compute work submitted to the queue before.
 * - The pass belongs after temporal anti-aliasing or upscaling, and before motion blur, bloom and the tone
 *   curve: it needs linear light, and the discs of lamps flicker if the lamps do.
 * - On a queue for asynchronous compute, a semaphore passes colour and depth to the pass and the result back.
 *   Exclusive images also need a transfer of ownership to that family; concurrent images do not.
 * - A frame is five dispatches, ten if a layer is blurred, in one command buffer that is never cut. Some
 *   systems end work that takes seconds, as 4K with hundreds of lamps per pixel does on a small device. A
 *   host should watch its timestamps, and reduce its resolution, or largest_radius_px, so that fewer lamps
 *   reach a pixel.
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
    /* The host's cache for the five programs that petzval_pass_open() makes; null: none. It may be destroyed
     * after that call. */
    VkPipelineCache pipeline_cache;
    /* Not 0: petzval_pass_times() returns the time of each dispatch. The queue's family needs timestamps. */
    int measures_times;
    /* Not 0: a frame's layer may have its own depth and is blurred by it. Takes 8 bytes per pixel. */
    int blurs_layers;
    /* The host's memory for the pass's images, as petzval_pass_needs() requires: `memory_size` bytes from
     * `memory_offset` on, for the largest size that the pass will have. Between frames the host may use it
     * for other purposes. Null: the pass allocates memory. */
    VkDeviceMemory memory;
    VkDeviceSize memory_offset, memory_size;
} petzval_pass_settings;

/* The memory that the images of a pass with these settings need. Their member `memory` is ignored. */
PETZVAL_C_API petzval_status petzval_pass_needs(const petzval_pass_settings* settings,
                                                VkMemoryRequirements* needed);

/* The ideal lens until petzval_pass_set_lens(). */
PETZVAL_C_API petzval_status petzval_pass_open(const petzval_pass_settings* settings, petzval_pass** pass);
/* All commands that the pass recorded must have finished, here and when it is closed. The lens is made again
 * for this pixel size, which takes as long as petzval_pass_set_lens(). The programs and the host's memory are
 * kept: a size that does not fit that memory is refused. If the call fails, the pass is unchanged. */
PETZVAL_C_API petzval_status petzval_pass_resize(petzval_pass* pass, uint32_t width, uint32_t height);
PETZVAL_C_API void petzval_pass_close(petzval_pass* pass);

/* Makes the shapes of the look's lens on this camera. It takes milliseconds, or up to seconds for lenses with
 * surfaces. A lens whose discs change over the frame, such as a cat's eye, has 45 shapes: 45 times as long,
 * and 64, 73 or 102 MB of the device's memory (draft, standard, final) instead of 1.4, 1.6 or 2.3, with as
 * much host-visible memory until the frame after has begun. May be called from any thread, also during
 * petzval_pass_record(): frames use the previous lens until it is done. The look's quality sets the taps of a
 * disc: draft 24, standard 48, final 127. Other fields of the look are not used. */
PETZVAL_C_API petzval_status petzval_pass_set_lens(petzval_pass* pass, const petzval_look* look,
                                                   const petzval_camera* camera);

typedef struct petzval_pass_image {
    VkImageView view;     /* of a 2D image, its depth aspect where it is depth */
    VkImageLayout layout; /* UNDEFINED (0): VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL */
} petzval_pass_image;

/* The output of a frame: the picture, or an intermediate buffer for debugging, in scene-linear light. */
typedef enum petzval_pass_view {
    PETZVAL_PASS_PICTURE = 0,
    PETZVAL_PASS_RADII =
        1, /* share of the largest radius: red in front of focus, blue behind; green in focus */
    PETZVAL_PASS_BEHIND = 2,   /* light in focus and behind it, estimated where it is hidden */
    PETZVAL_PASS_IN_FRONT = 3, /* light in front of focus, premultiplied by its coverage */
    PETZVAL_PASS_LAMPS = 4,    /* light of the lamps */
    PETZVAL_PASS_TILES =
        5 /* red: the largest radius in front of focus that reaches a tile; green: fine blur */
} petzval_pass_view;

typedef struct petzval_pass_frame {
    size_t size;
    VkCommandBuffer commands;  /* recording, outside of a render pass */
    uint32_t slot;             /* 0…frames_in_flight - 1; its earlier commands must have finished */
    petzval_pass_image colour; /* scene-linear, premultiplied, of any format that is sampled as floats */
    petzval_pass_image depth;
    petzval_pass_image layer; /* the top layer, such as glass or smoke, premultiplied; view null: none */
    VkImageView result;       /* of the settings' format, VK_IMAGE_USAGE_STORAGE_BIT */
    /* A depth d is 1 / (depth_scale * d + depth_bias) metres away, along the axis. Reversed and infinite: 1 /
     * near and 0. From `near` at 0 to `far` at 1: 1 / far - 1 / near and 1 / near. */
    double depth_scale, depth_bias;
    const petzval_camera* camera; /* of this frame; the sensor's width spans the picture */
    double pixel_aspect;          /* width / height of a pixel; 0: 1 */
    double largest_radius_px;     /* radii are cut there; 0: a twentieth of the width */
    /* The frame is this part of all images, from the top left, for hosts with dynamic resolution; both 0: the
     * full size of the pass. The sensor's width spans this part. */
    uint32_t width, height;
    /* The host's factor on light before its tone curve; 0: 1. Estimates of hidden light are weighted by
     * displayed brightness: k times the light with 1 / k here gives a result k times as bright. */
    double exposure;
    /* Depth of the layer, in the form of `depth`; needs settings.blurs_layers. The layer is then blurred like
     * a separate picture, which takes as long again, and composited on top. View null: the layer stays sharp.
     * */
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
