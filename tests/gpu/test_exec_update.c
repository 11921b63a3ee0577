/*
 * test_exec_update.c: one plan in the place of another: what is the same stays, persistent content
 * too, and nothing is left behind.
 *
 * Objects are counted through volk's pointers to Vulkan's functions, where an executor finds them.
 */
#include <string.h>

#include "tests/support/assertions.h"

#include "tests/support/feature_graphs.h"
#include "tests/support/lavapipe.h"

/* ---- counting ---- */

/* Of each kind: how many there are, and how many have been made.
 * Names of Vulkan NOLINTBEGIN(bugprone-macro-parentheses) */
#define COUNTED(row) \
    row(Image) row(ImageView) row(Buffer) row(DescriptorPool) row(DescriptorSetLayout) \
        row(PipelineLayout) row(Sampler) row(Framebuffer) row(RenderPass) row(Fence) \
            row(CommandPool) row(QueryPool) row(ShaderModule)

struct counts {
    int memory, pipelines;
#define MEMBER(object) int object;
    COUNTED(MEMBER)
};

static struct counts alive, made;

#define COUNTING(object) \
    static PFN_vkCreate##object real_create_##object; \
    static PFN_vkDestroy##object real_destroy_##object; \
\
    static VKAPI_ATTR VkResult VKAPI_CALL create_##object( \
        VkDevice device, const Vk##object##CreateInfo *info, const VkAllocationCallbacks *a, \
        Vk##object *out) \
    { \
        alive.object++; \
        made.object++; \
        return real_create_##object(device, info, a, out); \
    } \
\
    static VKAPI_ATTR void VKAPI_CALL destroy_##object(VkDevice device, Vk##object object, \
                                                       const VkAllocationCallbacks *a) \
    { \
        alive.object -= object != VK_NULL_HANDLE; \
        real_destroy_##object(device, object, a); \
    }
COUNTED(COUNTING)
/* NOLINTEND(bugprone-macro-parentheses) */

static PFN_vkAllocateMemory real_allocate;
static PFN_vkFreeMemory real_free;
static PFN_vkCreateGraphicsPipelines real_graphics;
static PFN_vkCreateComputePipelines real_compute;
static PFN_vkDestroyPipeline real_destroy_pipeline;

static VKAPI_ATTR VkResult VKAPI_CALL allocate(VkDevice device, const VkMemoryAllocateInfo *info,
                                               const VkAllocationCallbacks *a, VkDeviceMemory *out)
{
    alive.memory++;
    made.memory++;
    return real_allocate(device, info, a, out);
}

static VKAPI_ATTR void VKAPI_CALL free_memory(VkDevice device, VkDeviceMemory memory,
                                              const VkAllocationCallbacks *a)
{
    alive.memory -= memory != VK_NULL_HANDLE;
    real_free(device, memory, a);
}

static VKAPI_ATTR VkResult VKAPI_CALL graphics(VkDevice device, VkPipelineCache cache, uint32_t n,
                                               const VkGraphicsPipelineCreateInfo *infos,
                                               const VkAllocationCallbacks *a, VkPipeline *out)
{
    alive.pipelines++;
    made.pipelines++;
    return real_graphics(device, cache, n, infos, a, out);
}

static VKAPI_ATTR VkResult VKAPI_CALL compute(VkDevice device, VkPipelineCache cache, uint32_t n,
                                              const VkComputePipelineCreateInfo *infos,
                                              const VkAllocationCallbacks *a, VkPipeline *out)
{
    alive.pipelines++;
    made.pipelines++;
    return real_compute(device, cache, n, infos, a, out);
}

static VKAPI_ATTR void VKAPI_CALL destroy_pipeline(VkDevice device, VkPipeline pipeline,
                                                   const VkAllocationCallbacks *a)
{
    alive.pipelines -= pipeline != VK_NULL_HANDLE;
    real_destroy_pipeline(device, pipeline, a);
}

#define SWAP(pointer, real, counting, begin) \
    do { \
        if (begin) \
            (real) = (pointer); \
        (pointer) = (begin) ? (counting) : (real); \
    } while (0)
#define SWAP_ROW(object) \
    SWAP(vkCreate##object, real_create_##object, create_##object, begin); \
    SWAP(vkDestroy##object, real_destroy_##object, destroy_##object, begin);

/* Begins, or ends, to count what executors make that are created from now on. */
static void count_objects(bool begin)
{
    alive = made = (struct counts){ 0 };
    COUNTED(SWAP_ROW)
    SWAP(vkAllocateMemory, real_allocate, allocate, begin);
    SWAP(vkFreeMemory, real_free, free_memory, begin);
    SWAP(vkCreateGraphicsPipelines, real_graphics, graphics, begin);
    SWAP(vkCreateComputePipelines, real_compute, compute, begin);
    SWAP(vkDestroyPipeline, real_destroy_pipeline, destroy_pipeline, begin);
}

/* ---- a graph with something of everything ---- */

static const struct rg_image texels = { .name = "texels", .format = VK_FORMAT_R32_UINT };
static const struct rg_image sum = {
    .name = "sum",
    .format = VK_FORMAT_R32_UINT,
    .width = 8,
    .height = 8,
    .persistent = true,
};
static const struct rg_image drawn = {
    .name = "drawn",
    .format = VK_FORMAT_R32_UINT,
    .width = 8,
    .height = 8,
};
static const struct rg_image scratch = { .name = "scratch", .format = VK_FORMAT_R32_UINT };
static const struct rg_buffer numbers = { .name = "numbers", .size_per_texel = 4 };
static const struct rg_buffer drawn_out = FEATURE_NUMBERS("drawn out");
static const struct rg_buffer sum_out = {
    .name = "sum out",
    .size = 256,
    .memory = RG_MEMORY_READBACK,
};

static void record_rectangle(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    painted_draw(cmd, &(struct paint_push){ ALL });
}

/* Of a pipeline of its own. */
#define OTHER_CULL VK_CULL_MODE_BACK_BIT

#define NEXT(title, from, to) NEXT_BY(title, from, to, VK_CULL_MODE_NONE)
#define NEXT_BY(title, from, to, culled) \
    { \
        .name = (title), .color = RG_TARGETS({ &(to), RG_LOAD_DISCARD }), .cull = (culled), \
        .uses = RG_USES(FEATURE_SEED, \
                        { .image = &(from), .access = RG_SAMPLED, .binding = DATA_TEXELS }), \
        PAINTED_BY(record_rectangle, &next_frag), \
    }

/* sum becomes sum + seed, by way of another image; the rest is drawn beside it. */
static const struct rg_pass rows[] = {
    { .name = "fill", FEATURE_FILL(texels, numbers) },
    NEXT("next", sum, drawn),
    NEXT("back", drawn, sum),
    RUN_READ("read", sum, sum_out),
    NEXT("beside", texels, scratch),
    RUN_READ("read beside", scratch, drawn_out),
};
static const struct rg_pass other_rows[] = {
    { .name = "fill", FEATURE_FILL(scratch, numbers) },
    NEXT_BY("other", scratch, texels, OTHER_CULL),
    RUN_READ("read other", texels, drawn_out),
    NEXT("next", sum, drawn),
    NEXT("back", drawn, sum),
    RUN_READ("read", sum, sum_out),
};

static const struct run_params params = {
    .technique = RG_TECHNIQUE("test", rows),
    .outputs = { &drawn_out, &sum_out },
    .view = { 8, 8 },
    .max_view = { 16, 12 },
};

enum {
    SEED = 3
};

/* Runs a frame and checks it: `frames` of them have been added up. */
static void check_frame(struct run *run, uint32_t frames)
{
    assert_int_equal(rg_exec_begin(run->exec, &run->slot), VK_SUCCESS);
    *(struct data_seed *)run_data(run, &feature_seed) = (struct data_seed){ SEED };
    assert_int_equal(rg_exec_submit(run->exec, NULL), VK_SUCCESS);
    assert_int_equal(rg_exec_wait(run->exec, run->slot), VK_SUCCESS);
    const uint32_t *added = run_data(run, &sum_out);
    const uint32_t *beside = run_data(run, &drawn_out);
    const uint32_t width = run->params.view.width; /* 8 x 8 texels are filled */
    for (uint32_t i = 0; i < 64; i++) {
        assert_int_equal(added[i], 2 * SEED * frames);
        assert_int_equal(beside[i / 8 * width + i % 8], i + 2 * SEED);
    }
}

static struct run_params changed(unsigned way, uint32_t width, uint32_t height, bool other)
{
    struct run_params p = run_variant(&params, way);
    p.view = (VkExtent2D){ width, height };
    if (other)
        p.technique = (struct rg_technique)RG_TECHNIQUE("test", other_rows);
    return p;
}

/* ---- what cannot be ---- */

static const struct rg_image wide = {
    .name = "wide",
    .format = VK_FORMAT_R32G32B32A32_SFLOAT,
    .width = 128,
    .height = 128,
};
static const struct rg_buffer narrow = { "narrow", 16, .memory = RG_MEMORY_READBACK };
static const struct rg_pass narrow_rows[] = {
    {
        .name = "paint",
        .color = RG_TARGETS({ &wide, RG_LOAD_DISCARD }),
        PAINTED_BY(record_rectangle, &paint_frag),
    },
    RUN_READ("read", wide, narrow),
};

static void copy_beyond_a_buffer_is_refused(void **state)
{
    struct run run;
    run_open(&run, *state,
             &(struct run_params){
                 .technique = RG_TECHNIQUE("test", narrow_rows),
                 .outputs = { &narrow },
             });
    assert_int_equal(rg_exec_begin(run.exec, &run.slot), VK_SUCCESS);
    assert_int_equal(rg_exec_submit(run.exec, NULL), VK_ERROR_VALIDATION_FAILED_EXT);
    assert_int_equal(run.line_count, 1);
    assert_non_null(strstr(run.line, "262144 bytes at offset 0"));
    assert_non_null(strstr(run.line, "the 16 bytes of narrow"));
    run_close(&run);
}

static PFN_vkGetPhysicalDeviceFeatures2 real_features;

static VKAPI_ATTR void VKAPI_CALL few_features(VkPhysicalDevice physical,
                                               VkPhysicalDeviceFeatures2 *features)
{
    real_features(physical, features);
    for (VkBaseOutStructure *s = features->pNext; s; s = s->pNext) {
        if (s->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES) {
            ((VkPhysicalDeviceVulkan13Features *)s)->maintenance4 = VK_FALSE;
            ((VkPhysicalDeviceVulkan13Features *)s)->synchronization2 = VK_FALSE;
        }
    }
}

static void each_missing_feature_is_named(void **state)
{
    struct run run;
    run_compile(&run, *state, &params);
    real_features = vkGetPhysicalDeviceFeatures2;
    vkGetPhysicalDeviceFeatures2 = few_features;
    const VkResult result = run_create(&run, run.plan);
    vkGetPhysicalDeviceFeatures2 = real_features;
    assert_int_equal(result, VK_ERROR_FEATURE_NOT_PRESENT);
    assert_int_equal(run.line_count, 2);
    assert_non_null(strstr(run.line, "the feature maintenance4 of the device"));
    run_close(&run);
}

/* ---- tests ---- */

static void content_stays(void **state)
{
    for (unsigned way = 0; way < RUN_VARIANT_COUNT; way++) {
        const struct run_params first = changed(way, 8, 8, false);
        const struct run_params second = changed(way, 16, 8, true);
        struct run run;
        uint32_t frames = 0;
        run_open(&run, *state, &first);
        run_update(&run, &second); /* before any frame */
        check_frame(&run, ++frames);
        check_frame(&run, ++frames);
        run_update(&run, &first);
        check_frame(&run, ++frames);
        run_update(&run, &second);
        run_update(&run, &first); /* without a frame in between */
        check_frame(&run, ++frames);
        check_frame(&run, ++frames);
        run_close(&run);
    }
}

/* Submits a frame without waiting for it. */
static void submit_frame(struct run *run)
{
    assert_int_equal(rg_exec_begin(run->exec, &run->slot), VK_SUCCESS);
    *(struct data_seed *)run_data(run, &feature_seed) = (struct data_seed){ SEED };
    assert_int_equal(rg_exec_submit(run->exec, NULL), VK_SUCCESS);
}

/* Objects of a plan are destroyed after its last frame, and the frames of two plans, which share
 * memory, do not overlap on the device. */
static void plans_change_between_frames_in_flight(void **state)
{
    for (unsigned way = 0; way < RUN_VARIANT_COUNT; way++) {
        struct run_params plans[] = { changed(way, 8, 8, false), changed(way, 16, 8, true),
                                      changed(way, 16, 12, false) };
        struct run run;
        uint32_t frames = 0;
        count_objects(true);
        for (size_t i = 0; i < 3; i++)
            plans[i].frames_in_flight = 3;
        run_open(&run, *state, &plans[0]);
        const struct counts one_plan = alive;
        for (; frames < 20; frames++) {
            submit_frame(&run);
            run_update(&run, &plans[(frames + 1) % 3]);
        }
        run_update(&run, &plans[0]);
        assert_int_equal(rg_exec_wait_all(run.exec), VK_SUCCESS);
        assert_int_equal(alive.Image, one_plan.Image);
        assert_int_equal(alive.memory, one_plan.memory);
        /* sets of older plans keep their pools */
        assert_true(alive.DescriptorPool <= (int)run.plan->pass_count);
        check_frame(&run, frames + 1);
        run_close(&run);
        count_objects(false);
    }
}

static PFN_vkWaitForFences real_wait;

static VKAPI_ATTR VkResult VKAPI_CALL wait_without_polls(VkDevice device, uint32_t n,
                                                         const VkFence *fences, VkBool32 all,
                                                         uint64_t timeout)
{
    return timeout ? real_wait(device, n, fences, all, timeout) : VK_ERROR_OUT_OF_HOST_MEMORY;
}

/* Objects of a frame in flight stay if its fence cannot be polled. */
static void objects_stay_if_polls_fail(void **state)
{
    struct run_params first = changed(0, 8, 8, false), larger = changed(0, 16, 8, true);
    struct run run;
    first.frames_in_flight = larger.frames_in_flight = 3;
    count_objects(true);
    real_wait = vkWaitForFences;
    vkWaitForFences = wait_without_polls;
    run_open(&run, *state, &first);
    submit_frame(&run);
    const int before = alive.Image;
    made = (struct counts){ 0 };
    run_update(&run, &larger);
    assert_true(made.Image > 0);
    assert_int_equal(alive.Image, before + made.Image);
    assert_int_equal(rg_exec_wait_all(run.exec), VK_SUCCESS);
    assert_true(alive.Image < before + made.Image);
    run_close(&run);
    vkWaitForFences = real_wait;
    count_objects(false);
}

/* Within the largest view, memory and pipelines stay; with the same plan, all. */
static void what_is_the_same_stays(void **state)
{
    for (unsigned way = 0; way < RUN_VARIANT_COUNT; way++) {
        const struct run_params first = changed(way, 8, 8, false);
        const struct run_params larger = changed(way, 16, 8, false);
        const struct run_params other = changed(way, 8, 8, true);
        struct counts nothing = { 0 };
        struct run run;
        count_objects(true);
        run_open(&run, *state, &first);
        check_frame(&run, 1);
        made = nothing;
        run_update(&run, &first);
        assert_memory_equal(&made, &nothing, sizeof(made));
        run_update(&run, &larger);
        assert_int_equal(made.memory, 0);
        assert_int_equal(made.pipelines, 0);
        assert_true(made.Image > 0);
        check_frame(&run, 2);
        made = nothing;
        run_update(&run, &other);
        assert_int_equal(made.pipelines, 1); /* of the row `other` */
        run_update(&run, &first);
        run_update(&run, &other);
        assert_int_equal(made.pipelines, 1);
        check_frame(&run, 3);
        run_close(&run);
        assert_memory_equal(&alive, &nothing, sizeof(alive));
        count_objects(false);
    }
}

/* A thousand changes: of the view, within the largest one and beyond it, and of the rows. */
static void nothing_is_left(void **state)
{
    struct run run;
    count_objects(true);
    run_open(&run, *state, &params);
    const struct counts before = alive;
    for (uint32_t i = 1; i <= 1000; i++) {
        struct run_params p = changed(0, 8 * (1 + i % 2), 8, i % 3 == 0);
        p.sharing = params.sharing;
        if (i % 5 == 0)
            p.max_view = (VkExtent2D){ 32, 16 };
        run_update(&run, i == 1000 ? &params : &p);
        if (i % 100 == 99)
            check_frame(&run, i / 100 + 1);
    }
    run_update(&run, &params); /* pipelines of the plan before stay for one more */
    struct counts after = alive;
    assert_true(after.DescriptorPool <= (int)run.plan->pass_count);
    after.DescriptorPool = before.DescriptorPool;
    assert_memory_equal(&after, &before, sizeof(after));
    check_frame(&run, 11);
    run_close(&run);
    count_objects(false);
}

/* From executors that end to those that begin, also where two exist at a time. */
static void pipelines_go_to_other_executors(void **state)
{
    struct rg_pipelines *pipelines = rg_pipelines_create();
    struct run_params all = changed(0, 8, 8, true);
    struct run_params fewer = changed(0, 16, 8, false);
    struct counts nothing = { 0 };
    struct run run[2];
    assert_non_null(pipelines);
    all.pipelines = fewer.pipelines = pipelines;
    count_objects(true);
    run_open(&run[0], *state, &all);
    const int count = made.pipelines;
    assert_int_equal(count, 3); /* `next` and `back` draw alike */
    run_open(&run[1], *state, &fewer);
    assert_int_equal(made.pipelines, 2 * count - 1); /* `other` is the row that it lacks */
    run_close(&run[0]);
    run_close(&run[1]);
    for (int i = 0; i < 3; i++) {
        made = nothing;
        run_open(&run[0], *state, i == 1 ? &fewer : &all);
        assert_int_equal(made.pipelines, 0);
        check_frame(&run[0], 1);
        run_close(&run[0]);
    }
    run_open(&run[0], *state, &fewer);
    run_update(&run[0], &fewer);
    run_close(&run[0]);
    assert_int_equal(alive.pipelines, count - 1); /* that of `other` has not been used twice */
    assert_int_equal(alive.Image, 0);
    rg_pipelines_destroy(pipelines);
    assert_memory_equal(&alive, &nothing, sizeof(alive));
    count_objects(false);
}

static void measured_frames_go_on(void **state)
{
    struct run_params p = params;
    struct run run;
    p.measure = (struct rg_measure){ RG_CLOCK_EXACT, false };
    run_open(&run, *state, &p);
    check_frame(&run, 1);
    run_update(&run, &p);
    assert_int_equal(rg_exec_times(run.exec).pass_count, 0);
    check_frame(&run, 2);
    assert_int_equal(rg_exec_times(run.exec).pass_count, run.plan->pass_count);
    assert_int_equal(rg_exec_times(run.exec).measure.clock, RG_CLOCK_EXACT);
    run_close(&run);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_DEVICE(content_stays),
        ON_DEVICE(plans_change_between_frames_in_flight),
        ON_DEVICE(objects_stay_if_polls_fail),
        ON_DEVICE(what_is_the_same_stays),
        ON_DEVICE(nothing_is_left),
        ON_DEVICE(pipelines_go_to_other_executors),
        ON_DEVICE(measured_frames_go_on),
        ON_DEVICE(copy_beyond_a_buffer_is_refused),
        ON_DEVICE(each_missing_feature_is_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
