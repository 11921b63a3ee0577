/*
 * bench.c: CPU time per pass of rg_compile(), rg_exec_create(), rg_exec_update() and of recording
 * a frame, for graphs of 100, 1 000 and 10 000 passes.
 *
 * Each pass draws into an image of its own and samples the image of an earlier pass. Every eighth
 * pass also samples a persistent image, which a later pass draws, and a texture that is missing and
 * replaced by a placeholder of its own. The pipeline comes from a cache. Measured with the device's
 * driver, and with one that does nothing, which leaves the graph's own time. malloc() keeps freed
 * memory, because page faults of long graphs would be measured otherwise. Fails if a pass of the
 * longest graph costs more than `limits` times as much as one of the shortest. Times are those of
 * the calling thread.
 */
#include <limits.h>
#include <malloc.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "src/gpu/gpu_internal.h"
#include "tests/support/assertions.h"
#include "tests/support/feature_graphs.h"

enum {
    EVERY = 8,
    NAME_SIZE = 24,
    BINDING_MISSING = 2,
};

struct graph {
    uint32_t pass_count;
    struct rg_image *images;  /* one per pass */
    struct rg_image *history; /* one for each EVERY passes; then missing ones */
    struct rg_target *targets;
    struct rg_use (*uses)[5];
    struct rg_pass *passes;
    char (*names)[NAME_SIZE];
    struct rg_technique technique;
    struct rg_plan *plan;
};

/* Measured operations, in the order of the output. */
enum {
    COMPILE,
    CREATE,
    UPDATE, /* to an equal plan */
    UPDATE_CHANGED /* to a plan in which every image has another size */,
    RECORD,
    DESTROY,
    MEASURED_COUNT,
};

static const char *const labels[] = { "compile",         "create", "update, equal",
                                      "update, changed", "record", "destroy" };

/* With the driver, and without. A quadratic step would give 100. What drivers free in an update and
 * at the end exceeds their caches. */
static const double limits[][MEASURED_COUNT] = { { 1.5, 1.5, 1.5, 3.0, 1.5, 4.0 },
                                                 { 1.5, 1.5, 1.5, 1.5, 1.5, 1.5 } };

/* ---- a driver that does nothing ---- */

static VkResult make_nothing(VkDevice device, const void *info, const void *allocator,
                             uint64_t *handle)
{
    static uint64_t last;
    (void)device;
    (void)info;
    (void)allocator;
    *handle = ++last;
    return VK_SUCCESS;
}

static VkResult make_no_pipeline(VkDevice device, VkPipelineCache cache, uint32_t count,
                                 const VkGraphicsPipelineCreateInfo *info,
                                 const VkAllocationCallbacks *allocator, uint64_t *pipeline)
{
    (void)cache;
    (void)count;
    return make_nothing(device, info, allocator, pipeline);
}

static VkResult allocate_nothing(VkDevice device, const void *info, uint64_t *handle)
{
    return make_nothing(device, info, NULL, handle);
}

static void need_nothing(VkDevice device, uint64_t resource, VkMemoryRequirements *needs)
{
    (void)device;
    (void)resource;
    *needs = (VkMemoryRequirements){ .size = 1, .alignment = 1, .memoryTypeBits = UINT32_MAX };
}

static VkResult do_nothing(void)
{
    return VK_SUCCESS;
}

static PFN_vkVoidFunction find_nothing(VkInstance instance, const char *name)
{
    if (strstr(name, "PhysicalDevice"))
        return vkGetInstanceProcAddr(instance, name);
    if (!strcmp(name, "vkCreateGraphicsPipelines"))
        return (PFN_vkVoidFunction)make_no_pipeline;
    if (!strncmp(name, "vkCreate", 8) || !strcmp(name, "vkAllocateMemory"))
        return (PFN_vkVoidFunction)make_nothing;
    if (!strncmp(name, "vkAllocate", 10))
        return (PFN_vkVoidFunction)allocate_nothing;
    if (strstr(name, "MemoryRequirements"))
        return (PFN_vkVoidFunction)need_nothing;
    return (PFN_vkVoidFunction)do_nothing;
}

/* ---- measurement ---- */

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void record_draw(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    static const struct paint_push push = { ALL };
    (void)frame;
    rg_cmd_push(cmd, &push, sizeof(push));
    rg_cmd_draw(cmd, 3);
}

static const struct rg_fallback black = { { 0 } };

static void fill_row(struct graph *g, uint32_t i)
{
    struct rg_use *uses = g->uses[i];
    g->images[i] = (struct rg_image){
        .name = g->names[i], .format = VK_FORMAT_R8G8B8A8_UNORM, .width = 8, .height = 8
    };
    g->targets[i] = (struct rg_target){ .image = &g->images[i], .load = RG_LOAD_DISCARD };
    if (i % EVERY == 0) {
        struct rg_image *history = &g->history[i / EVERY];
        struct rg_image *missing = &g->history[g->pass_count / EVERY + 1 + i / EVERY];
        char *names = g->names[g->pass_count + i / EVERY * 2];
        (void)snprintf(names, NAME_SIZE, "history %u", i);
        (void)snprintf(names + NAME_SIZE, NAME_SIZE, "missing %u", i);
        *missing = *history = g->images[i];
        history->name = names;
        history->persistent = true;
        missing->name = names + NAME_SIZE;
        *uses++ = (struct rg_use){ .image = history, .access = RG_SAMPLED, .binding = 1 };
        *uses++ = (struct rg_use){
            .image = missing, .access = RG_SAMPLED, .binding = BINDING_MISSING, .fallback = &black
        };
    }
    if (i % EVERY == EVERY / 2)
        g->targets[i].image = &g->history[i / EVERY];
    if (i > 0)
        *uses++ = (struct rg_use){ .image = &g->images[i - (i % EVERY == EVERY / 2 + 1 ? 2 : 1)],
                                   .access = RG_SAMPLED };
    (void)snprintf(g->names[i], NAME_SIZE, "%u", i);
    g->passes[i] = (struct rg_pass){
        .name = g->names[i],
        .color = &g->targets[i],
        .color_count = 1,
        .uses = g->uses[i],
        .vert = &triangle_vert,
        .frag = &paint_frag,
        .push_size = sizeof(struct paint_push),
        .record = record_draw,
    };
}

static void graph_init(struct graph *g, uint32_t pass_count)
{
    *g = (struct graph){ .pass_count = pass_count };
    g->images = calloc(pass_count, sizeof(*g->images));
    g->history = calloc((size_t)pass_count / EVERY * 2 + 2, sizeof(*g->history));
    g->targets = calloc(pass_count, sizeof(*g->targets));
    g->uses = calloc(pass_count, sizeof(*g->uses));
    g->passes = calloc(pass_count, sizeof(*g->passes));
    g->names = calloc((size_t)pass_count * 2, sizeof(*g->names));
    assert_true(g->images && g->history && g->targets && g->uses && g->passes && g->names);
    for (uint32_t i = 0; i < pass_count; i++)
        fill_row(g, i);
    g->technique = (struct rg_technique){ "scale", g->passes, pass_count };
}

static void graph_finish(struct graph *g)
{
    free(g->images);
    free(g->history);
    free(g->targets);
    free(g->uses);
    free(g->passes);
    free(g->names);
}

static struct rg_plan *compile(const struct graph *g, const struct rg_device *device)
{
    const struct rg_technique *technique = &g->technique;
    const struct rg_output output = { .image = &g->images[g->pass_count - 1],
                                      .access = RG_COPY_SRC };
    struct rg_plan *plan = rg_compile(&(struct rg_compile_params){
        .techniques = &technique,
        .technique_count = 1,
        .view = { 8, 8 },
        .outputs = &output,
        .output_count = 1,
        .device = device,
        .skip_shaders = true,
    });
    assert_non_null(plan);
    for (uint32_t i = 0; i < plan->fault_count && i < 3; i++) {
        char text[256];
        (void)rg_fault_text(&plan->faults[i], text, sizeof(text));
        (void)fprintf(stderr, "%s\n", text);
    }
    assert_int_equal(plan->fault_count, 0);
    assert_int_equal(plan->pass_count, g->pass_count);
    return plan;
}

/* Stores the least time so far. */
static void note(double *seconds, double start)
{
    const double taken = now() - start;
    *seconds = *seconds > 0.0 && *seconds < taken ? *seconds : taken;
}

static void measure_round(const struct rg_exec_params *base, struct graph *g,
                          const struct rg_device *device, double seconds[static MEASURED_COUNT])
{
    struct rg_exec_params params = *base;
    struct rg_plan *plans[3];
    uint32_t slot;
    for (int i = 0; i < 3; i++) {
        for (uint32_t k = 0; k < g->pass_count && i == 2; k++)
            g->images[k].width = 16;
        for (uint32_t k = 0; k < g->pass_count / EVERY + 1 && i == 2; k++)
            g->history[k].width = 16;
        const double start = now();
        plans[i] = compile(g, device);
        note(&seconds[COMPILE], start);
    }
    params.plan = plans[0];
    double start = now();
    struct rg_exec *exec = rg_exec_create(&params, NULL);
    note(&seconds[CREATE], start);
    assert_non_null(exec);
    for (int i = 1; i < 8; i++) { /* lists of objects grow in the first updates */
        params.plan = plans[i == 1 ? 1 : 1 + (i + 1) % 2];
        start = now();
        assert_int_equal(rg_exec_update(exec, &params), VK_SUCCESS);
        note(&seconds[i == 1 ? UPDATE : UPDATE_CHANGED], start);
    }
    assert_int_equal(rg_exec_begin(exec, &slot), VK_SUCCESS);
    start = now();
    assert_int_equal(rg_exec_submit(exec, NULL), VK_SUCCESS);
    note(&seconds[RECORD], start);
    assert_int_equal(rg_exec_wait(exec, slot), VK_SUCCESS);
    start = now();
    rg_exec_destroy(exec);
    note(&seconds[DESTROY], start);
    for (int i = 0; i < 3; i++)
        rg_plan_destroy(plans[i]);
}

static void measure(const struct gpu *gpu, PFN_vkGetInstanceProcAddr find, uint32_t pass_count,
                    double us[static MEASURED_COUNT])
{
    const struct rg_vulkan vulkan = { gpu->instance, vkGetInstanceProcAddr, gpu->physical,
                                      gpu->device };
    const struct rg_device device = rg_exec_device(&vulkan);
    struct rg_pipelines *pipelines = rg_pipelines_create();
    struct rg_exec_params params = { GPU_EXEC_PARAMS(gpu), .pipelines = pipelines };
    params.get_proc_addr = find;
    for (uint32_t round = 0; round < 8 + 3000 / pass_count; round++) {
        struct graph g;
        graph_init(&g, pass_count);
        measure_round(&params, &g, &device, us);
        graph_finish(&g);
    }
    rg_pipelines_destroy(pipelines);
    for (int i = 0; i < MEASURED_COUNT; i++)
        us[i] *= 1e6 / pass_count;
}

/* Measures with a driver. Returns true if all operations are within their limits. */
static bool measure_driver(const struct gpu *gpu, PFN_vkGetInstanceProcAddr find,
                           const double limit[static MEASURED_COUNT])
{
    static const uint32_t counts[] = { 100, 1000, 10000 };
    double us[3][MEASURED_COUNT] = { { 0.0 } };
    bool good = true;
    for (int i = 0; i < 3; i++)
        measure(gpu, find, counts[i], us[i]);
    for (int k = 0; k < MEASURED_COUNT; k++) {
        const double ratio = us[2][k] / us[0][k];
        printf("%-16s %7.2f %7.2f %7.2f, ratio %.2f\n", labels[k], us[0][k], us[1][k], us[2][k],
               ratio);
        good = good && ratio <= limit[k];
    }
    return good;
}

int main(void)
{
    struct gpu gpu;
    if (!mallopt(M_MMAP_THRESHOLD, 1 << 30) || !mallopt(M_TRIM_THRESHOLD, INT_MAX))
        return EXIT_FAILURE;
    if (gpu_create(&gpu, &(struct gpu_params){ 0 }) != STATUS_OK)
        return 77;
    printf("us a pass, of 100, 1 000 and 10 000 passes\n");
    bool good = measure_driver(&gpu, vkGetInstanceProcAddr, limits[0]);
    printf("without the driver\n");
    good = measure_driver(&gpu, find_nothing, limits[1]) && good;
    gpu_destroy(&gpu);
    return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
