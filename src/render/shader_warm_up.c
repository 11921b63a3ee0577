/* shader_warm_up.c: compiles shaders in parallel threads, each with its own logical device. */
#include "src/render/shader_warm_up.h"
#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include "src/base/parallel.h"
#include "src/gpu/gpu.h"
#include "src/render/lavapipe_tuning.h"
#include "src/settings/settings.h"
#include "src/tech/frame_resources.h"
#include "src/tech/techniques.h"

enum {
    THREAD_COUNT_MAX = 3, /* more threads save no time */
};

struct warm_up {
    const struct gpu *gpu;
    struct compiled_frame_params described;
    struct settings settings;
    struct rg_frame frame;
    struct rg_mesh *meshes; /* meshes of the techniques */
    atomic_int next;        /* next pass; below 0: done */
    struct parallel_threads threads;
};

static void compile_passes(struct warm_up *warm_up, const struct gpu_secondary_device *secondary)
{
    struct rg_exec_params params = warm_up->described.params;
    VkResult result;
    params.device = secondary->device;
    params.queue = secondary->queue;
    struct rg_exec *exec = rg_exec_create(&params, &result);
    for (int pass = 0; result == VK_SUCCESS && pass >= 0;) {
        pass = atomic_fetch_sub(&warm_up->next, 1);
        if (pass >= 0)
            result = rg_exec_warm_up(exec, &warm_up->frame, (uint32_t)pass);
    }
    rg_exec_destroy(exec);
}

/* Gives the lowest priority to this thread and to the driver threads that it starts. The renderer
 * and Mesa's low-priority thread for the shader cache then run first. */
static void lower_priority(void)
{
    (void)pthread_setschedparam(pthread_self(), SCHED_OTHER, &(struct sched_param){ 0 });
    (void)setpriority(PRIO_PROCESS, 0, 19); /* on Linux, 0 is this thread */
}

static void *run_thread(void *user)
{
    struct warm_up *warm_up = user;
    struct gpu_secondary_device secondary;
    lower_priority();
    if (!gpu_secondary_device_create(&secondary, warm_up->gpu))
        return NULL;
    compile_passes(warm_up, &secondary);
    gpu_secondary_device_destroy(&secondary);
    return NULL;
}

/* Fills in executor parameters. Every mesh in the warm-up frame is a single triangle. */
static void describe(struct warm_up *warm_up, const struct compiled_frame *compiled_frame,
                     const struct renderer_params *params)
{
    const struct rg_mesh mesh = { .index_count = 3 };
    for (size_t i = 0; i < techniques_count; i++)
        warm_up->meshes[i] = mesh;
    compiled_frame_describe(&warm_up->described, compiled_frame, params);
    warm_up->gpu = params->gpu;
    warm_up->settings = *params->settings;
    warm_up->frame = (struct rg_frame){
        .settings = &warm_up->settings,
        .scene = params->scene,
        .object = mesh,
        .surroundings = mesh,
        .meshes = warm_up->meshes,
        .due = { true, true },
    };
    struct rg_exec_params *exec = &warm_up->described.params;
    exec->pipeline_cache = VK_NULL_HANDLE;
    exec->pipelines = NULL; /* not shared between devices */
    exec->frames_in_flight = 1;
    exec->measured = false;
    exec->warm_up_only = true;
    exec->log = NULL;
    atomic_init(&warm_up->next, (int)compiled_frame->frame->plan->pass_count - 1);
}

static bool is_enabled(void)
{
    const char *value = getenv("FIRN_WARM_UP");
    return !value || strcmp(value, "off") != 0;
}

struct warm_up *shader_warm_up_begin(const struct compiled_frame *compiled_frame,
                                     const struct renderer_params *params)
{
    const struct gpu *gpu = params->gpu;
    const uint32_t cores = parallel_core_count();
    if (!lavapipe_tuning_is_cpu(gpu) || gpu->validated || params->replace || !is_enabled())
        return NULL;
    struct warm_up *warm_up = cores > 1 ? calloc(1, sizeof(*warm_up)) : NULL;
    if (!warm_up)
        return NULL;
    warm_up->meshes = calloc(techniques_count, sizeof(*warm_up->meshes));
    if (!warm_up->meshes) {
        free(warm_up);
        return NULL;
    }
    describe(warm_up, compiled_frame, params);
    parallel_start(&warm_up->threads, cores > THREAD_COUNT_MAX ? THREAD_COUNT_MAX : cores - 1,
                   run_thread, warm_up);
    return warm_up;
}

void shader_warm_up_end(struct warm_up *warm_up)
{
    if (!warm_up)
        return;
    atomic_store(&warm_up->next, -1); /* no further pass */
    parallel_join(&warm_up->threads);
    free(warm_up->meshes);
    free(warm_up);
}
