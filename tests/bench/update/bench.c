/*
 * bench.c: rg_exec_update() beside rg_exec_create(), of firn's own frames: the view changes from
 * 1024x768 to 1500x950 and back, within the largest view and without one; the rung changes, and
 * settings that change the plan.
 * Fails if the median of the ratio is above 0.25 within the largest view, or above 0.5 otherwise.
 * The executors make their imports themselves, and draw nothing.
 */
#include <stdio.h>
#include <stdlib.h>

#include "graph/rg_exec.h"
#include "src/base/clock.h"
#include "src/gpu/gpu.h"
#include "src/render/frame/compile_frame_plan.h"
#include "src/scene/scene.h"
#include "tests/support/assertions.h"

enum {
    RUN_COUNT = 25
};

struct change {
    const char *name;
    const char *refraction_models[2]; /* before and after */
    VkExtent2D views[2];
    VkExtent2D max_view; /* 0x0: none */
    double most;         /* ratio */
    const char *setting; /* after the change; NULL: the same */
};

static const struct change changes[] = {
    { "view, within the largest",
      { "paper", "paper" },
      { { 1024, 768 }, { 1500, 950 } },
      { 1500, 950 },
      0.25 },
    { "view", { "paper", "paper" }, { { 1024, 768 }, { 1500, 950 } }, { 0, 0 }, 0.5 },
    { "rung", { "paper", "bounce" }, { { 1024, 768 }, { 1024, 768 } }, { 0, 0 }, 0.5 },
    { "cracks",
      { "paper", "paper" },
      { { 1024, 768 }, { 1024, 768 } },
      { 0, 0 },
      0.5,
      "cracks.count=0" },
    { "air", { "paper", "paper" }, { { 1024, 768 }, { 1024, 768 } }, { 0, 0 }, 0.5, "air.count=0" },
    { "nothing", { "paper", "paper" }, { { 1024, 768 }, { 1024, 768 } }, { 0, 0 }, 0.25 },
};

struct side {
    struct settings settings;
    struct frame_plan frame; /* the tables */
    struct rg_plan *plan;
};

static void init_side(struct side *side, const struct change *change, int which,
                      const struct rg_device *device)
{
    side->settings = settings_default();
    if (which && change->setting)
        assert_int_equal(settings_assign(&side->settings, change->setting, SETTING_USER, NULL),
                         STATUS_OK);
    static const struct scene scene = { 0 };
    const struct frame_request request = {
        .config = { .settings = &side->settings,
                    .scene = &scene,
                    .refraction = techniques_find_refraction(change->refraction_models[which]) },
        .view = change->views[which],
        .beauty = true,
        .display = true,
        .device = device,
    };
    assert_int_equal(frame_plan_init(&side->frame, &request), STATUS_OK);
    side->plan = rg_compile(&(struct rg_compile_params){
        .techniques = side->frame.techniques,
        .technique_count = side->frame.technique_count,
        .view = request.view,
        .max_view = change->max_view,
        .outputs = side->frame.outputs,
        .output_count = side->frame.output_count,
        .imports = side->frame.imports,
        .import_count = side->frame.import_count,
        .device = device,
    });
    assert_non_null(side->plan);
    assert_int_equal(side->plan->fault_count, 0);
}

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a;
    const double y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median(double values[static RUN_COUNT])
{
    qsort(values, RUN_COUNT, sizeof(*values), compare);
    return values[RUN_COUNT / 2];
}

/* Returns whether the change is as cheap as it must be. */
static bool measure(const struct gpu *gpu, const struct rg_vulkan *vulkan,
                    const struct change *change)
{
    const struct rg_device device = rg_exec_device(vulkan);
    double fresh[RUN_COUNT], updates[RUN_COUNT], ratios[RUN_COUNT];
    struct side sides[2];
    for (int i = 0; i < 2; i++)
        init_side(&sides[i], change, i, &device);
    struct rg_exec_params params = {
        .plan = sides[0].plan,
        .instance = gpu->instance,
        .get_proc_addr = vulkan->get_proc_addr,
        .physical = gpu->physical,
        .device = gpu->device,
        .queue = gpu->queue,
        .queue_family = gpu->queue_family,
        .pipeline_cache = gpu->pipeline_cache,
        .max_anisotropy = gpu->max_anisotropy,
        .warm_up_only = true,
    };
    struct rg_exec *changed = rg_exec_create(&params, NULL);
    assert_non_null(changed);
    for (int i = 0; i < RUN_COUNT; i++) {
        params.plan = sides[(i + 1) % 2].plan;
        const double start = clock_ms();
        struct rg_exec *exec = rg_exec_create(&params, NULL);
        fresh[i] = clock_ms() - start;
        assert_non_null(exec);
        rg_exec_destroy(exec);
        const double middle = clock_ms();
        assert_int_equal(rg_exec_update(changed, &params), VK_SUCCESS);
        updates[i] = clock_ms() - middle;
        ratios[i] = updates[i] / fresh[i];
    }
    rg_exec_destroy(changed);
    for (int i = 0; i < 2; i++) {
        rg_plan_destroy(sides[i].plan);
        frame_plan_finish(&sides[i].frame);
    }
    const double ratio = median(ratios);
    printf("%s: fresh %.2f ms, update %.2f ms, ratio %.4f, at most %.2f\n", change->name,
           median(fresh), median(updates), ratio, change->most);
    return ratio <= change->most;
}

int main(void)
{
    struct gpu gpu;
    bool good = true;
    if (gpu_create(&gpu, &(struct gpu_params){ 0 }) != STATUS_OK)
        return 77;
    const struct rg_vulkan vulkan = { gpu.instance, vkGetInstanceProcAddr, gpu.physical,
                                      gpu.device };
    for (size_t i = 0; i < sizeof(changes) / sizeof(changes[0]); i++)
        good &= measure(&gpu, &vulkan, &changes[i]);
    gpu_destroy(&gpu);
    return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
