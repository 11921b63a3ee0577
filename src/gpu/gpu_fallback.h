/* gpu_fallback.h: bundled CPU driver for machines without a usable Vulkan device. */
#ifndef FIRN_GPU_GPU_FALLBACK_H
#define FIRN_GPU_GPU_FALLBACK_H

#include <stdbool.h>

/* Reserves space for VK_ADD_DRIVER_FILES in the environment, with an empty value, if a bundled
 * driver is installed and the variable has no value. Call it before other threads run: only its
 * value changes afterwards. */
void gpu_fallback_prepare(void);

/* Returns true if there is a bundled driver that is not in use. */
bool gpu_fallback_is_ready(void);

/* Makes the Vulkan loader use the bundled driver for instances that are created later. */
void gpu_fallback_use(void);

#endif
