/*
 * whole_device.h: a device that has every feature enabled, since firn's enables only what it needs,
 * and a descriptor set of a program's own.
 */
#ifndef TESTS_WHOLE_DEVICE_H
#define TESTS_WHOLE_DEVICE_H

#include "src/gpu/gpu.h"

/* `own` is like `gpu`, with another device. */
void whole_device_open(struct gpu *own, const struct gpu *gpu);
void whole_device_close(const struct gpu *own);

/* Whether it builds acceleration structures, and shaders trace them. */
bool whole_device_has_rays(const struct gpu *gpu);

/* A storage buffer of constant words, at binding 0, for fragment and compute shaders. */
struct own_set {
    VkDescriptorSetLayout layout;
    VkDescriptorPool pool;
    VkDescriptorSet set;
    struct gpu_buffer words;
};

void own_set_make(struct own_set *own, struct gpu *gpu, const uint32_t *words, size_t size);
void own_set_free(struct own_set *own, struct gpu *gpu);

#endif
