/*
 * all_features_device.h: a device with every supported feature enabled (firn's own device has only
 * those that it needs), and an application descriptor set.
 */
#ifndef TESTS_SUPPORT_ALL_FEATURES_DEVICE_H
#define TESTS_SUPPORT_ALL_FEATURES_DEVICE_H

#include "src/gpu/gpu.h"

/* Creates a device with all supported features in `own`, which is otherwise a copy of `gpu`. */
void all_features_device_open(struct gpu *own, const struct gpu *gpu);
void all_features_device_close(const struct gpu *own);

/* Returns true if the device supports acceleration structures and ray queries. */
bool all_features_device_has_rays(const struct gpu *gpu);

/* Descriptor set: a constant storage buffer at binding 0, for fragment and compute shaders. */
struct own_set {
    VkDescriptorSetLayout layout;
    VkDescriptorPool pool;
    VkDescriptorSet set;
    struct gpu_buffer words;
};

void own_set_create(struct own_set *own, struct gpu *gpu, const uint32_t *words, size_t size);
void own_set_destroy(struct own_set *own, struct gpu *gpu);

#endif
