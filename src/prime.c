/* prime.c: threads, each with a device and an executor without content. */
#include "src/prime.h"
#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>
#include "src/frame.h"
#include "src/frame_cube.h"
#include "src/gpu/gpu.h"
#include "src/settings.h"

enum {
    THREAD_COUNT_MAX = 3, /* more find nothing left */
};

struct prime {
    const struct gpu *gpu;
    struct stage_exec described;
    struct settings settings;
    struct rg_frame frame;
    atomic_int next; /* pass; below 0: all are done, or it is over */
    pthread_t threads[THREAD_COUNT_MAX];
    uint32_t thread_count;
};

static void prime_passes(struct prime *prime, const struct gpu_twin *twin)
{
    struct rg_exec_params params = prime->described.params;
    VkResult result;
    params.device = twin->device;
    params.queue = twin->queue;
    struct rg_exec *exec = rg_exec_create(&params, &result);
    for (int pass = 0; result == VK_SUCCESS && pass >= 0;) {
        pass = atomic_fetch_sub(&prime->next, 1);
        if (pass >= 0)
            result = rg_exec_warm_up(exec, &prime->frame, (uint32_t)pass);
    }
    rg_exec_destroy(exec);
}

/*
 * This thread, and those that the driver makes for it, take what nobody else wants. So the picture
 * is not held up; and Mesa's own thread that writes the cache, which comes last on every machine,
 * has its turn before all is compiled.
 */
static void step_back(void)
{
    (void)pthread_setschedparam(pthread_self(), SCHED_OTHER, &(struct sched_param){ 0 });
    (void)setpriority(PRIO_PROCESS, 0, 19); /* on Linux, 0 is this thread */
}

static void *work(void *user)
{
    struct prime *prime = user;
    struct gpu_twin twin;
    step_back();
    if (!gpu_twin_create(&twin, prime->gpu))
        return NULL;
    prime_passes(prime, &twin);
    gpu_twin_destroy(&twin);
    return NULL;
}

/* Everything has three indices. */
static void describe(struct prime *prime, const struct stage *stage,
                     const struct renderer_params *params)
{
    const struct rg_mesh mesh = { .index_count = 3 };
    stage_describe(&prime->described, stage, params);
    prime->gpu = params->gpu;
    prime->settings = *params->settings;
    prime->frame = (struct rg_frame){
        .settings = &prime->settings,
        .object = mesh,
        .surroundings = mesh,
        .cracks = mesh,
        .air = mesh,
        .bubble_count = 1,
        .faces_due = FRAME_CUBE_ALL,
    };
    struct rg_exec_params *exec = &prime->described.params;
    exec->pipeline_cache = VK_NULL_HANDLE;
    exec->frames_in_flight = 1;
    exec->measured = false;
    exec->warm_up_only = true;
    exec->log = NULL;
    atomic_init(&prime->next, (int)stage->frame.plan->pass_count - 1);
}

static bool is_wanted(void)
{
    const char *value = getenv("FIRN_WARM_UP");
    return !value || strcmp(value, "off") != 0;
}

struct prime *prime_begin(const struct stage *stage, const struct renderer_params *params)
{
    const struct gpu *gpu = params->gpu;
    const long cores = sysconf(_SC_NPROCESSORS_ONLN);
    if (gpu->properties.deviceType != VK_PHYSICAL_DEVICE_TYPE_CPU || gpu->validated ||
        params->replace || !is_wanted())
        return NULL;
    struct prime *prime = cores > 1 ? calloc(1, sizeof(*prime)) : NULL;
    if (!prime)
        return NULL;
    describe(prime, stage, params);
    const uint32_t most = cores > THREAD_COUNT_MAX ? THREAD_COUNT_MAX : (uint32_t)cores - 1;
    while (prime->thread_count < most &&
           !pthread_create(&prime->threads[prime->thread_count], NULL, work, prime))
        prime->thread_count++;
    return prime;
}

void prime_end(struct prime *prime)
{
    if (!prime)
        return;
    atomic_store(&prime->next, -1); /* no further pass */
    for (uint32_t i = 0; i < prime->thread_count; i++)
        pthread_join(prime->threads[i], NULL);
    free(prime);
}
