/* lavapipe.c: opens the Vulkan device for tests, with validation and environment set up. */
#include "tests/support/lavapipe.h"
#include <assert.h>
#include <stdlib.h>

static const char *other_device(void)
{
    return getenv("FIRN_TEST_DEVICE");
}

struct gpu_params lavapipe_params(void)
{
    const char *device = other_device();
    return (struct gpu_params){ .device = device ? device : "llvmpipe", .validate = true };
}

void lavapipe_environment(void)
{
    unsetenv("XDG_CACHE_HOME");
    unsetenv("HOME");
    setenv("VK_LAYER_ENABLES", "VALIDATION_CHECK_ENABLE_SYNCHRONIZATION_VALIDATION_QUEUE_SUBMIT",
           1);
    setenv("VK_LAYER_SYNCVAL_SHADER_ACCESSES_HEURISTIC", "1",
           1);           /* newer validation layers need this to be enabled */
    if (!other_device()) /* saves a third of the loading time */
        setenv("VK_LOADER_DRIVERS_SELECT", "*lvp*", 1);
}

static int open_device(void **state)
{
    struct gpu *gpu = calloc(1, sizeof(*gpu));
    const struct gpu_params params = lavapipe_params();
    *state = gpu;
    return gpu && gpu_create(gpu, &params) == STATUS_OK && gpu->validated ? 0 : -1;
}

int lavapipe_open(void **state)
{
    lavapipe_environment();
    return open_device(state);
}

int lavapipe_open_for_timelines(void **state)
{
    lavapipe_environment();
    unsetenv("VK_LAYER_ENABLES");
    return open_device(state);
}

int lavapipe_close(void **state)
{
    struct gpu *gpu = *state;
    gpu_destroy(gpu);
    const uint32_t message_count = gpu->message_count;
    free(gpu);
    return message_count == 0 ? 0 : -1;
}

static int check_messages(void **state)
{
    struct gpu *gpu = *state;
    const uint32_t message_count = gpu->message_count;
    gpu->message_count = 0;
    return message_count == 0 ? 0 : -1;
}

int lavapipe_run(const struct CMUnitTest *tests, size_t count)
{
    struct CMUnitTest on_device[16];
    void *gpu = NULL;
    assert(count <= sizeof(on_device) / sizeof(on_device[0]));
    if (lavapipe_open(&gpu) != 0)
        return (int)count;
    for (size_t i = 0; i < count; i++) {
        on_device[i] = tests[i];
        on_device[i].initial_state = gpu;
        on_device[i].teardown_func = check_messages;
    }
    const int failed = _cmocka_run_group_tests("tests", on_device, count, NULL, NULL);
    return failed + (lavapipe_close(&gpu) != 0);
}
