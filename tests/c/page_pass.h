/* A host's two functions around the real-time pass, made of the blocks of its page. */
#ifndef PETZVAL_TEST_PAGE_PASS_H
#define PETZVAL_TEST_PAGE_PASS_H

#include "petzval/vulkan.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Null: the pass did not open. */
petzval_pass* page_opened(VkInstance instance, VkPhysicalDevice physical_device, VkDevice device,
                          uint32_t width, uint32_t height);
/* near_m: the near plane of reversed depth. */
petzval_status page_recorded(petzval_pass* pass, VkCommandBuffer commands, uint32_t number,
                             VkImageView colour, VkImageView depth, VkImageView result, double near_m);

#ifdef __cplusplus
}
#endif
#endif
