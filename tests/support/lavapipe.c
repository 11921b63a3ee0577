/* lavapipe.c: a device for tests. */
#include "tests/support/lavapipe.h"
#include <stdlib.h>

const struct gpu_params lavapipe_params = { .device = "llvmpipe", .validate = true };

void lavapipe_environment(void)
{
    unsetenv("XDG_CACHE_HOME");
    unsetenv("HOME");
    setenv("VK_LAYER_ENABLES", "VALIDATION_CHECK_ENABLE_SYNCHRONIZATION_VALIDATION_QUEUE_SUBMIT",
           1);
}

int lavapipe_open(void **state)
{
    lavapipe_environment();
    struct gpu *gpu = calloc(1, sizeof(*gpu));
    *state = gpu;
    return gpu && gpu_create(gpu, &lavapipe_params) == STATUS_OK && gpu->validated ? 0 : -1;
}

int lavapipe_close(void **state)
{
    struct gpu *gpu = *state;
    gpu_destroy(gpu);
    const uint32_t message_count = gpu->message_count;
    free(gpu);
    return message_count == 0 ? 0 : -1;
}
