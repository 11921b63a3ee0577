/*
 * test_exec_sync.c: the validation layer sees what goes wrong where a plan's barriers are damaged.
 *
 * Other tests trust its silence; here it has to speak. Plans are recorded through VkRenderPass
 * objects; what the layer's version 1.3.239 does not see is in the table too, marked blind.
 */
#include <string.h>

#include "tests/support/assertions.h"

#include "tests/gpu/shaders/data.h"
#include "tests/support/lavapipe.h"
#include "tests/support/plan_mutation.h"
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

static const struct rg_pass again_rows[] = {
    { .name = "paint", .color = RG_TARGETS({ &first, RG_LOAD_CLEAR }), PAINTED },
    FETCH("fetch", first, second),
    {
        .name = "paint again",
        .color = RG_TARGETS({ &first, RG_LOAD_KEEP }),
        .uses = RG_USES({ .image = &second, .access = RG_SAMPLED, .binding = PAINT_SOURCE }),
        PAINTED_BY(painted_record, &fetch_frag),
    },
    RUN_READ("read", first, out),
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

static const struct rg_pass storage_rows[] = {
    FILL("fill"),
    {
        .name = "add",
        .kind = RG_COMPUTE,
        .uses =
            RG_USES({ .image = &numbers, .access = RG_STORAGE_READ, .binding = DATA_TEXELS },
                    { .buffer = &list, .access = RG_STORAGE_READ_WRITE, .binding = DATA_NUMBERS }),
        .comp = &add_comp,
        .record = record_numbers,
    },
    COPY_LIST("copy"),
};

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

/* ---- damage ---- */

struct damage_case {
    const char *what;
    struct rg_technique technique;
    const void *resource;  /* of the barrier that is damaged */
    VkAccessFlags2 before; /* and what it comes before */
    const char *damage;    /* see plan_mutation.c */
    uint32_t frames;       /* 0 means 1 */
    bool dynamic;          /* recorded with dynamic rendering */
    bool layout;           /* breaks a rule about layouts too */
    bool blind;            /* version 1.3.239 of the layer says nothing */
    bool blind_since;      /* later versions may say nothing; 1.4.309 does not */
};

static bool is_of(const struct rg_plan *plan, const struct rg_barrier *barrier,
                  const void *resource)
{
    if (barrier->image != RG_NONE)
        return plan->images[barrier->image].image == resource;
    return plan->buffers[barrier->buffer].buffer == resource;
}

/* The last one: the first one of a resource is about the frame before. */
static uint32_t find_barrier(const struct rg_plan *plan, const struct damage_case *c)
{
    for (uint32_t i = plan->barrier_count; i-- > 0;) {
        if (is_of(plan, &plan->barriers[i], c->resource) &&
            (plan->barriers[i].dst_access & c->before))
            return i;
    }
    fail_msg("%s: no such barrier", c->what);
    return 0;
}

static size_t find_damage(const char *name)
{
    for (size_t i = 0; i < plan_mutation_count(); i++) {
        if (!strcmp(plan_mutation_name(i), name))
            return i;
    }
    fail_msg("no damage %s", name);
    return 0;
}

static bool is_old_layer(void)
{
    VkLayerProperties layers[64];
    uint32_t layer_count = 64;
    (void)vkEnumerateInstanceLayerProperties(&layer_count, layers);
    for (uint32_t i = 0; i < layer_count; i++) {
        if (!strcmp(layers[i].layerName, "VK_LAYER_KHRONOS_validation"))
            return layers[i].specVersion <= VK_MAKE_API_VERSION(0, 1, 3, 239);
    }
    fail_msg("no validation layer");
    return false;
}

static void check_case(struct gpu *gpu, const struct damage_case *c)
{
    struct plan_mutant copy;
    struct run_tables tables;
    struct run run;
    const uint32_t frames = c->frames ? c->frames : 1;
    run_compile(&run, gpu,
                &(struct run_params){
                    .technique = c->technique,
                    .outputs = { &out },
                    .frames_in_flight = 2,
                    .sharing = RG_SHARE_LEAST_MEMORY,
                    .render_passes = !c->dynamic,
                });
    struct messages messages = run_frames(&run, run.plan, 2);
    assert_int_equal(messages.hazards + messages.others, 0);
    assert_int_equal(gpu->message_count, 0);

    const uint32_t barrier = find_barrier(run.plan, c);
    uint32_t next = barrier;
    run_tables_init(&tables, &run.params, NULL);
    assert_true(
        plan_mutation_init(&copy, run.plan, &tables.compile, find_damage(c->damage), &next));
    assert_int_equal(next, barrier + 1);
    messages = run_frames(&run, &copy.plan, frames);
    print_message("%s: %u hazards, %u others\n", c->what, messages.hazards, messages.others);
    assert_int_equal(gpu->message_count, messages.hazards + messages.others);
    if (c->layout)
        assert_true(messages.others > 0);
    else
        assert_int_equal(messages.others, 0);
    if (c->blind && is_old_layer())
        assert_int_equal(messages.hazards, 0);
    else if (!c->blind && !(c->blind_since && !is_old_layer()))
        assert_true(messages.hazards > 0);
    gpu->message_count = 0;
    plan_mutation_finish(&copy);
    run_close(&run);
}

#define COLOR  RG_TECHNIQUE("color", color_rows)
#define AGAIN  RG_TECHNIQUE("again", again_rows)
#define DEPTH  RG_TECHNIQUE("depth", depth_rows)
#define STORE  RG_TECHNIQUE("storage", storage_rows)
#define LIST   RG_TECHNIQUE("list", list_rows)
#define REFILL RG_TECHNIQUE("refill", refill_rows)

/*
 * The blind ones, as seen: a draw with dynamic rendering is no access at all for the layer; a
 * write after a write of the same kind by shaders is passed over, and a descriptor that may write
 * counts as no more than that; a wrong layout is another rule's; what the host reads is not known
 * to it.
 */
static const struct damage_case cases[] = {
    { "colour write, sampled", COLOR, &first, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT, "no_source" },
    { "the same, not available", COLOR, &first, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
      "no_source_access" },
    { "the same, for another stage", COLOR, &first, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
      "wrong_destination" },
    { "colour write, copied", COLOR, &third, VK_ACCESS_2_TRANSFER_READ_BIT, "no_source" },
    { "sampled, colour write", AGAIN, &first, VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT, "no_source" },
    { "depth write, sampled", DEPTH, &depth, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT, "no_source" },
    { "storage buffer, read", LIST, &list, VK_ACCESS_2_SHADER_STORAGE_READ_BIT, "drop_barrier" },
    { "storage image, read", STORE, &numbers, VK_ACCESS_2_SHADER_STORAGE_READ_BIT, "drop_barrier" },
    { "storage buffer, copied", STORE, &list, VK_ACCESS_2_TRANSFER_READ_BIT, "drop_barrier" },
    { "copied, storage write", REFILL, &list, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
      "drop_barrier" },
    { "copy, copied over", REFILL, &out, VK_ACCESS_2_TRANSFER_WRITE_BIT, "drop_barrier" },
    { "shared memory", COLOR, &third, VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT, "no_source",
      .blind_since = true },
    { "the frame before", DEPTH, &depth, VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT,
      "no_source", .frames = 2 },
    { "no barrier at all", COLOR, &first, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT, "drop_barrier",
      .layout = true },
    { "wrong layout", COLOR, &first, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT, "wrong_new_layout",
      .layout = true, .blind = true },
    { "dynamic", COLOR, &first, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT, "no_source", .dynamic = true,
      .blind = true },
    { "storage buffer, read and written", STORE, &list, VK_ACCESS_2_SHADER_STORAGE_READ_BIT,
      "drop_barrier", .blind = true },
    { "host read", COLOR, &out, VK_ACCESS_2_HOST_READ_BIT, "drop_barrier", .blind = true },
};

static void layer_sees_damage(void **state)
{
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++)
        check_case(*state, &cases[i]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_DEVICE(layer_sees_damage),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
