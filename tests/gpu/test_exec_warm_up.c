/*
 * test_exec_warm_up.c: executors without content, whose passes draw nowhere; and how many pipelines
 * they have.
 *
 * All memory that one allocates is filled with garbage and looked at again, which drivers of the
 * CPU allow.
 */
#include <string.h>

#include "tests/support/assertions.h"

#include "src/render/lavapipe_tuning.h"
#include "tests/support/feature_graphs.h"
#include "tests/support/lavapipe.h"

/* ---- memory ---- */

enum {
    ALLOCATION_COUNT_MAX = 16,
    GARBAGE = 0x42,
};

static struct {
    unsigned char *bytes[ALLOCATION_COUNT_MAX];
    size_t sizes[ALLOCATION_COUNT_MAX];
    uint32_t count;
} allocated;

static VKAPI_ATTR VkResult VKAPI_CALL allocate(VkDevice device, const VkMemoryAllocateInfo *info,
                                               const VkAllocationCallbacks *callbacks,
                                               VkDeviceMemory *memory)
{
    const VkResult result = vkAllocateMemory(device, info, callbacks, memory);
    void *bytes;
    if (result != VK_SUCCESS)
        return result;
    assert_int_equal(vkMapMemory(device, *memory, 0, VK_WHOLE_SIZE, 0, &bytes), VK_SUCCESS);
    memset(bytes, GARBAGE, (size_t)info->allocationSize);
    vkUnmapMemory(device, *memory); /* the bytes stay where they are */
    assert_true(allocated.count < ALLOCATION_COUNT_MAX);
    allocated.bytes[allocated.count] = bytes;
    allocated.sizes[allocated.count++] = (size_t)info->allocationSize;
    return VK_SUCCESS;
}

/* Allocations that are not as they were. */
static uint32_t count_written(void)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < allocated.count; i++) {
        size_t at = 0;
        while (at < allocated.sizes[i] && allocated.bytes[i][at] == GARBAGE)
            at++;
        count += at < allocated.sizes[i];
    }
    return count;
}

static uint32_t pipeline_count;

static VKAPI_ATTR VkResult VKAPI_CALL create_pipelines(VkDevice device, VkPipelineCache cache,
                                                       uint32_t count,
                                                       const VkGraphicsPipelineCreateInfo *infos,
                                                       const VkAllocationCallbacks *callbacks,
                                                       VkPipeline *pipelines)
{
    pipeline_count += count;
    return vkCreateGraphicsPipelines(device, cache, count, infos, callbacks, pipelines);
}

static VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL find(VkInstance instance, const char *name)
{
    if (!strcmp(name, "vkAllocateMemory"))
        return (PFN_vkVoidFunction)allocate;
    if (!strcmp(name, "vkCreateGraphicsPipelines"))
        return (PFN_vkVoidFunction)create_pipelines;
    return vkGetInstanceProcAddr(instance, name);
}

/* ---- a graph ---- */

static const struct rg_image given = COLOR_IMAGE("given");
static const struct rg_image seen = COLOR_IMAGE("seen");
static const struct rg_image layers = COLOR_IMAGE("layers", .layers = 3);
static const struct rg_image absent = COLOR_IMAGE("absent");
static const struct rg_fallback white = { { 1, 1, 1, 1 } };
static const struct rg_image kept = COLOR_IMAGE("kept", .persistent = true);
static const struct rg_image depth = { .name = "depth", .format = VK_FORMAT_D32_SFLOAT };
static const struct rg_buffer seen_out = COLOR_BUFFER("seen out");
static const struct rg_buffer kept_out = COLOR_BUFFER("kept out");

static uint32_t drawn; /* bit i: row i */

static void note(const struct rg_cmd *cmd, const struct rg_frame *frame)
{
    drawn |= 1u << (rg_cmd_pass(cmd) - frame->rows);
}

static void record_rectangle(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    note(cmd, frame);
    rg_cmd_scissor(cmd, (VkRect2D){ .extent = rg_cmd_extent(cmd) });
    painted_draw(cmd, &(struct paint_push){ .color = { { 1, 2, 3, 4 } }, ALL });
}

/* There are no buffers: a triangle of zeros stands in. */
static void record_mesh(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    note(cmd, frame);
    rg_cmd_push(cmd, &(struct paint_push){ ALL }, sizeof(struct paint_push));
    rg_cmd_draw_mesh(cmd, &frame->mesh);
}

static void record_nothing(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    note(cmd, frame);
}

enum {
    SEE,
    LAYERS,
    UNWANTED,
    MESH,
    FALL_BACK,
    NOT_DRAWN,
};

static const struct rg_pass rows[] = {
    [SEE] = {
        .name = "see",
        .color = RG_TARGETS({ &seen, RG_LOAD_CLEAR }),
        .uses = RG_USES(PAINTED_SOURCE(given)),
        PAINTED_BY(record_rectangle, &fetch_frag),
    },
    [LAYERS] = {
        .name = "layers",
        .color = RG_TARGETS({ &layers, RG_LOAD_CLEAR }),
        .repeat = RG_PER_LAYER,
        PAINTED_BY(record_rectangle, &paint_frag),
    },
    [UNWANTED] = {
        .name = "unwanted",
        .color = RG_TARGETS({ &kept, RG_LOAD_KEEP }),
        .when = painted_when,
        PAINTED_BY(record_rectangle, &paint_frag),
    },
    [MESH] = {
        .name = "mesh",
        .color = RG_TARGETS({ &kept, RG_LOAD_KEEP }),
        .depth = { &depth, RG_LOAD_CLEAR, .clear.depthStencil.depth = 1 },
        .uses = RG_USES(PAINTED_SOURCE(layers)),
        .vert = &paint_mesh_vert,
        .frag = &fetch_layer_frag,
        .vertices = &feature_indirect_vertices,
        .push_size = sizeof(struct paint_push),
        .record = record_mesh,
    },
    [FALL_BACK] = {
        .name = "fall back",
        .color = RG_TARGETS({ &kept, RG_LOAD_KEEP }),
        .uses = RG_USES({ .image = &absent, .access = RG_SAMPLED, .binding = PAINT_SOURCE,
                          .fallback = &white }),
        .front = VK_FRONT_FACE_CLOCKWISE, /* so that it does not draw as `see` does */
        PAINTED_BY(record_rectangle, &fetch_frag),
    },
    [NOT_DRAWN] = {
        .name = "not drawn",
        .kind = RG_TRANSFER,
        .uses = RG_USES({ .image = &seen, .access = RG_COPY_SRC },
                        { .buffer = &seen_out, .access = RG_COPY_DST }),
        .record = record_nothing,
    },
    RUN_READ("read kept", kept, kept_out),
};

/* ---- the test ---- */

static struct rg_exec *make_warm_up(const struct run *run, const struct gpu_secondary_device *twin)
{
    VkResult result;
    struct rg_exec *exec = rg_exec_create(
        &(struct rg_exec_params){
            .plan = run->plan,
            .instance = run->gpu->instance,
            .get_proc_addr = find,
            .physical = run->gpu->physical,
            .device = twin->device,
            .queue = twin->queue,
            .queue_family = run->gpu->queue_family,
            .frames_in_flight = 1,
            .import_count = 1, /* and no imports: they do not count */
            .warm_up_only = true,
        },
        &result);
    assert_int_equal(result, VK_SUCCESS);
    return exec;
}

static void passes_draw_nowhere(void **state)
{
    static const struct rg_import import = {
        .image = &given,
        .access = RG_SAMPLED,
        .extent = { FEATURE_SIZE, FEATURE_SIZE },
    };
    const struct run_params params = {
        .technique = RG_TECHNIQUE("test", rows),
        .outputs = { &seen_out, &kept_out },
        .imports = &import,
        .import_count = 1,
    };
    const struct rg_frame frame = { .rows = rows, .mesh.index_count = 3000 };
    struct gpu_secondary_device twin;
    struct run run;
    if (!lavapipe_tuning_is_cpu(*state)) {
        print_message("skipped: the memory of a GPU cannot be read\n");
        skip();
    }
    run_compile(&run, *state, &params);
    assert_true(gpu_secondary_device_create(&twin, run.gpu));
    allocated.count = 0;
    pipeline_count = drawn = 0;
    struct rg_exec *exec = make_warm_up(&run, &twin);
    assert_int_equal(count_written(), 1); /* the triangle of zeros */
    assert_int_equal(pipeline_count, 4);  /* LAYERS and UNWANTED draw alike */
    for (uint32_t round = 0; round < 2; round++) {
        for (uint32_t pass = run.plan->pass_count; pass-- > 0;)
            assert_int_equal(rg_exec_warm_up(exec, &frame, pass), VK_SUCCESS);
    }
    assert_int_equal(drawn, 1u << SEE | 1u << LAYERS | 1u << MESH | 1u << FALL_BACK);
    assert_int_equal(count_written(), 1);
    rg_exec_destroy(exec);
    gpu_secondary_device_destroy(&twin);
    run_close(&run);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_DEVICE(passes_draw_nowhere),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
