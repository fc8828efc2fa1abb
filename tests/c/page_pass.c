/* The blocks of docs/explain/real-time.md, pasted into functions as a host in C99 would have them. */
#include "page_pass.h"

#include <stddef.h>

petzval_pass* page_opened(VkInstance instance, VkPhysicalDevice physical_device, VkDevice device, uint32_t width,
                          uint32_t height) {
    petzval_pass* pass = NULL;
#include "block0.c"
    return status == PETZVAL_OK ? pass : NULL;
}

petzval_status page_recorded(petzval_pass* pass, VkCommandBuffer commands, uint32_t number, VkImageView colour,
                             VkImageView depth, VkImageView result, double near_m) {
    petzval_status status = PETZVAL_OK;
#include "block1.c"
    return status;
}
