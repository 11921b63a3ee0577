/*
 * test_exec_sync.c: the validation layer reports barriers that wait for nothing.
 *
 * Other tests trust its silence; here it has to speak. Plans are recorded through VkRenderPass
 * objects, since version 1.3.239 of the layer does not see accesses by dynamic rendering.
 */
#include <stdlib.h>
#include <string.h>

#include "tests/support/assertions.h"

#include "tests/gpu/shaders/data.h"
#include "tests/support/lavapipe.h"
#include "tests/support/rectangle_rows.h"

/* ---- graphs ---- */

static const struct rg_image first = COLOR_IMAGE("first");
static const struct rg_image second = COLOR_IMAGE("second");
static const struct rg_image third = COLOR_IMAGE("third");
static const struct rg_image depth = { .name = "depth", .format = VK_FORMAT_D32_SFLOAT };
static const struct rg_buffer out = COLOR_BUFFER("out");

#define FETCH(title, from, to) \
    { \
        .name = (title), .color = RG_TARGETS({ &(to), RG_LOAD_DISCARD }), \
        .uses = RG_USES({ .image = &(from), .access = RG_SAMPLED, .binding = PAINT_SOURCE }), \
        PAINTED_BY(painted_record, &fetch_frag), \
    }

/* The memory of the first image serves the third one again. */
static const struct rg_pass color_rows[] = {
    { .name = "paint", .color = RG_TARGETS({ &first, RG_LOAD_CLEAR }), PAINTED },
    FETCH("fetch", first, second),
    FETCH("fetch again", second, third),
    RUN_READ("read", third, out),
};

static const struct rg_pass depth_rows[] = {
    {
        .name = "paint",
        .depth = { &depth, RG_LOAD_CLEAR, .clear.depthStencil.depth = 1 },
        PAINTED_BY(painted_record, NULL),
    },
    FETCH("fetch", depth, second),
    RUN_READ("read", second, out),
};

static const struct rg_image numbers = { .name = "numbers", .format = VK_FORMAT_R32_UINT };
static const struct rg_image copied = { .name = "copied", .format = VK_FORMAT_R32_UINT };
static const struct rg_buffer list = { .name = "list", .size_per_texel = sizeof(uint32_t) };

static const struct rg_buffer seed = {
    .name = "seed",
    .size = sizeof(struct data_seed),
    .memory = RG_MEMORY_UPLOAD,
};

static void record_numbers(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    rg_cmd_dispatch(cmd, 8 / DATA_GROUP, 8 / DATA_GROUP, 1);
}

static void record_list(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    const VkBufferCopy region = { .size = 64 * sizeof(uint32_t) };
    vkCmdCopyBuffer(rg_cmd_vulkan(cmd), rg_cmd_buffer(cmd, &list), rg_cmd_buffer(cmd, &out), 1,
                    &region);
}

#define FILL(title) \
    { \
        .name = (title), .kind = RG_COMPUTE, \
        .uses = RG_USES({ .buffer = &seed, .access = RG_UNIFORM, .binding = DATA_SEED }, \
                        { .image = &numbers, .access = RG_STORAGE_WRITE, .binding = DATA_TEXELS }, \
                        { .buffer = &list, .access = RG_STORAGE_WRITE, .binding = DATA_NUMBERS }), \
        .comp = &fill_comp, .record = record_numbers, \
    }
#define COPY_LIST(title) \
    { \
        .name = (title), .kind = RG_TRANSFER, \
        .uses = RG_USES({ .buffer = &list, .access = RG_COPY_SRC }, \
                        { .buffer = &out, .access = RG_COPY_DST, .partial = true }), \
        .record = record_list, \
    }

static const struct rg_pass list_rows[] = {
    FILL("fill"),
    {
        .name = "copy",
        .kind = RG_COMPUTE,
        .uses = RG_USES({ .image = &copied, .access = RG_STORAGE_WRITE, .binding = DATA_TEXELS },
                        { .buffer = &list, .access = RG_STORAGE_READ, .binding = DATA_NUMBERS }),
        .comp = &copy_comp,
        .record = record_numbers,
    },
    RUN_READ("read", copied, out),
};

static const struct rg_pass refill_rows[] = {
    FILL("fill"),
    COPY_LIST("copy"),
    FILL("fill again"),
    COPY_LIST("copy again"),
};

/* ---- what the layer says ---- */

struct messages {
    uint32_t hazards; /* of the synchronization validation */
    uint32_t others;
};

static VKAPI_ATTR VkBool32 VKAPI_CALL count(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                            VkDebugUtilsMessageTypeFlagsEXT types,
                                            const VkDebugUtilsMessengerCallbackDataEXT *data,
                                            void *user)
{
    (void)severity;
    (void)types;
    struct messages *messages = user;
    if (data->pMessageIdName && strstr(data->pMessageIdName, "SYNC-HAZARD"))
        messages->hazards++;
    else
        messages->others++;
    return VK_FALSE;
}

/* Listens while frames of a plan run, submitted one after another without a wait. */
static struct messages run_frames(struct run *run, const struct rg_plan *plan, uint32_t frames)
{
    static const struct paint_push paints[4] = { { ALL }, { ALL }, { ALL }, { ALL } };
    const struct rg_frame frame = {
        .rows = run->params.technique.passes,
        .paints = paints,
    };
    struct messages messages = { 0 };
    VkDebugUtilsMessengerEXT messenger = VK_NULL_HANDLE;
    const VkDebugUtilsMessengerCreateInfoEXT info = {
        .sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
        .messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                           VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
        .messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT,
        .pfnUserCallback = count,
        .pUserData = &messages,
    };
    assert_int_equal(vkCreateDebugUtilsMessengerEXT(run->gpu->instance, &info, NULL, &messenger),
                     VK_SUCCESS);
    assert_int_equal(run_create(run, plan), VK_SUCCESS);
    for (uint32_t i = 0; i < frames; i++) {
        assert_int_equal(rg_exec_begin(run->exec, &run->slot), VK_SUCCESS);
        assert_int_equal(rg_exec_submit(run->exec, &frame), VK_SUCCESS);
    }
    rg_exec_destroy(run->exec);
    run->exec = NULL;
    vkDestroyDebugUtilsMessengerEXT(run->gpu->instance, messenger, NULL);
    return messages;
}

/* ---- barriers that wait for nothing ---- */

struct sync_case {
    const char *what;
    struct rg_technique technique;
    const void *resource;  /* of the barrier that waits for nothing */
    VkAccessFlags2 before; /* and the access that comes after it */
    uint32_t frames;
};

static bool is_of(const struct rg_plan *plan, const struct rg_barrier *barrier,
                  const void *resource)
{
    if (barrier->image != RG_NONE)
        return plan->images[barrier->image].image == resource;
    return plan->buffers[barrier->buffer].buffer == resource;
}

/* Clears the source of the last barrier that the case describes; the first one of a resource is
 * about the frame before. */
static void wait_for_nothing(struct rg_barrier *barriers, const struct rg_plan *plan,
                             const struct sync_case *c)
{
    for (uint32_t i = plan->barrier_count; i-- > 0;) {
        if (is_of(plan, &barriers[i], c->resource) && (barriers[i].dst_access & c->before)) {
            barriers[i].src_stages = VK_PIPELINE_STAGE_2_NONE;
            barriers[i].src_access = VK_ACCESS_2_NONE;
            return;
        }
    }
    fail_msg("%s: no such barrier", c->what);
}

static void check_case(struct gpu *gpu, const struct sync_case *c)
{
    struct run run;
    run_compile(&run, gpu,
                &(struct run_params){
                    .technique = c->technique,
                    .outputs = { &out },
                    .frames_in_flight = 2,
                    .render_passes = true,
                });
    struct messages messages = run_frames(&run, run.plan, 2);
    assert_int_equal(messages.hazards + messages.others, 0);
    assert_int_equal(gpu->message_count, 0);

    const size_t count = run.plan->barrier_count + run.plan->initial_barrier_count;
    struct rg_barrier *barriers = calloc(count, sizeof(*barriers));
    struct rg_plan plan = *run.plan;
    assert_non_null(barriers);
    memcpy(barriers, plan.barriers, count * sizeof(*barriers));
    wait_for_nothing(barriers, &plan, c);
    plan.barriers = barriers;
    messages = run_frames(&run, &plan, c->frames);
    print_message("%s: %u hazards, %u others\n", c->what, messages.hazards, messages.others);
    assert_true(messages.hazards > 0);
    assert_int_equal(messages.others, 0);
    gpu->message_count = 0;
    free(barriers);
    run_close(&run);
}

#define COLOR  RG_TECHNIQUE("color", color_rows)
#define DEPTH  RG_TECHNIQUE("depth", depth_rows)
#define LIST   RG_TECHNIQUE("list", list_rows)
#define REFILL RG_TECHNIQUE("refill", refill_rows)

static const struct sync_case cases[] = {
    { "colour write, sampled", COLOR, &first, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT, 1 },
    { "colour write, copied", COLOR, &third, VK_ACCESS_2_TRANSFER_READ_BIT, 1 },
    { "depth write, sampled", DEPTH, &depth, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT, 1 },
    { "storage buffer, read", LIST, &list, VK_ACCESS_2_SHADER_STORAGE_READ_BIT, 1 },
    { "copied, storage write", REFILL, &list, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT, 1 },
    { "the frame before", DEPTH, &depth, VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT, 2 },
};

static void layer_sees_missing_waits(void **state)
{
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++)
        check_case(*state, &cases[i]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_DEVICE(layer_sees_missing_waits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
