/*
 * test_exec_life.c: how an executor comes, fails and goes.
 *
 * Allocations of the program's own objects are counted and made to fail through the linker's
 * --wrap; Vulkan's functions through volk's pointers to them, where an executor finds its own (see
 * run_create). What was not given back is reported by the validation layer at the end of each test,
 * or by the leak sanitizer.
 */
#include <stdlib.h>
#include <string.h>

#include "tests/support/assertions.h"

#include "tests/support/feature_graphs.h"
#include "tests/support/lavapipe.h"

/* ---- what fails, and when ---- */

struct calls {
    uint32_t count;
    uint32_t failing; /* number of the call that fails, from 1; 0: none */
};

static struct calls allocations;
static struct calls vulkan_calls;

static bool is_due(struct calls *calls)
{
    return ++calls->count == calls->failing;
}

/* the linker's names NOLINTBEGIN(readability-identifier-naming) */
void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *memory, size_t size);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *memory, size_t size);

void *__wrap_malloc(size_t size)
{
    return is_due(&allocations) ? NULL : __real_malloc(size);
}

void *__wrap_calloc(size_t count, size_t size)
{
    return is_due(&allocations) ? NULL : __real_calloc(count, size);
}

void *__wrap_realloc(void *memory, size_t size)
{
    return is_due(&allocations) ? NULL : __real_realloc(memory, size);
}

/* NOLINTEND(readability-identifier-naming) */

/* Every function that the executor calls and that may fail: row(name, parameters, arguments). */
#define CREATE(row, object) \
    row(vkCreate##object, \
        (VkDevice device, const Vk##object##CreateInfo *info, const VkAllocationCallbacks *a, \
         Vk##object *out), \
        (device, info, a, out))
#define CREATE_PIPELINES(row, kind) \
    row(vkCreate##kind##Pipelines, \
        (VkDevice device, VkPipelineCache cache, uint32_t n, \
         const Vk##kind##PipelineCreateInfo *infos, const VkAllocationCallbacks *a, \
         VkPipeline *out), \
        (device, cache, n, infos, a, out))
#define MAPPED_RANGES(row, name) \
    row(name, (VkDevice device, uint32_t n, const VkMappedMemoryRange *ranges), (device, n, ranges))
#define FALLIBLE(row) \
    CREATE(row, Buffer) \
    CREATE(row, CommandPool) \
    CREATE(row, DescriptorPool) \
    CREATE(row, DescriptorSetLayout) \
    CREATE(row, Fence) \
    CREATE(row, Framebuffer) \
    CREATE(row, Image) \
    CREATE(row, ImageView) \
    CREATE(row, PipelineLayout) \
    CREATE(row, QueryPool) \
    CREATE(row, RenderPass) \
    CREATE(row, Sampler) \
    CREATE(row, ShaderModule) \
    CREATE_PIPELINES(row, Compute) \
    CREATE_PIPELINES(row, Graphics) \
    MAPPED_RANGES(row, vkFlushMappedMemoryRanges) \
    MAPPED_RANGES(row, vkInvalidateMappedMemoryRanges) \
    row(vkGetQueryPoolResults, \
        (VkDevice device, VkQueryPool pool, uint32_t first, uint32_t n, size_t size, void *out, \
         VkDeviceSize stride, VkQueryResultFlags flags), \
        (device, pool, first, n, size, out, stride, flags)) \
        row(vkAllocateCommandBuffers, \
            (VkDevice device, const VkCommandBufferAllocateInfo *info, VkCommandBuffer *out), \
            (device, info, out)) \
            row(vkAllocateDescriptorSets, \
                (VkDevice device, const VkDescriptorSetAllocateInfo *info, VkDescriptorSet *out), \
                (device, info, out)) row(vkAllocateMemory, \
                                         (VkDevice device, const VkMemoryAllocateInfo *info, \
                                          const VkAllocationCallbacks *a, VkDeviceMemory *out), \
                                         (device, info, a, \
                                          out)) row(vkBindBufferMemory, \
                                                    (VkDevice device, VkBuffer buffer, \
                                                     VkDeviceMemory memory, VkDeviceSize offset), \
                                                    (device, buffer, memory, offset)) \
                row(vkBindImageMemory, \
                    (VkDevice device, VkImage image, VkDeviceMemory memory, VkDeviceSize offset), \
                    (device, image, memory, offset)) \
                    row(vkMapMemory, \
                        (VkDevice device, VkDeviceMemory memory, VkDeviceSize offset, \
                         VkDeviceSize size, VkMemoryMapFlags flags, void **out), \
                        (device, memory, offset, size, flags, out)) \
                        row(vkBeginCommandBuffer, \
                            (VkCommandBuffer commands, const VkCommandBufferBeginInfo *info), \
                            (commands, info)) \
                            row(vkEndCommandBuffer, (VkCommandBuffer commands), (commands)) \
                                row(vkQueueSubmit2, \
                                    (VkQueue queue, uint32_t n, const VkSubmitInfo2 *infos, \
                                     VkFence fence), \
                                    (queue, n, infos, fence)) \
                                    row(vkResetFences, \
                                        (VkDevice device, uint32_t n, const VkFence *fences), \
                                        (device, n, fences)) \
                                        row(vkWaitForFences, \
                                            (VkDevice device, uint32_t n, const VkFence *fences, \
                                             VkBool32 all, uint64_t timeout), \
                                            (device, n, fences, all, timeout))

#define FALLIBLE_FUNCTION(name, parameters, arguments) \
    static PFN_##name real_##name; \
\
    static VKAPI_ATTR VkResult VKAPI_CALL fallible_##name parameters \
    { \
        return is_due(&vulkan_calls) ? VK_ERROR_TOO_MANY_OBJECTS : real_##name arguments; \
    }
/* as many parameters as Vulkan's have NOLINTBEGIN(readability-function-size) */
FALLIBLE(FALLIBLE_FUNCTION)

/* NOLINTEND(readability-function-size) */

/* The `failing`th call from now on fails, until let_succeed(); of executors made in between. */
static void let_fail(uint32_t failing)
{
    vulkan_calls = (struct calls){ .failing = failing };
#define INSTALL(name, parameters, arguments) \
    real_##name = (name); \
    (name) = fallible_##name;
    FALLIBLE(INSTALL)
}

static void let_succeed(void)
{
    vulkan_calls.failing = 0;
#define RESTORE(name, parameters, arguments) (name) = real_##name;
    FALLIBLE(RESTORE)
}

/* ---- a graph with something of everything ---- */

static const struct rg_image texels = { .name = "texels", .format = VK_FORMAT_R32_UINT };
static const struct rg_image drawn = {
    .name = "drawn",
    .format = VK_FORMAT_R32_UINT,
    .persistent = true,
};
static const struct rg_image depth = { .name = "depth", .format = VK_FORMAT_D32_SFLOAT };
static const struct rg_buffer numbers = { .name = "numbers", .size_per_texel = 4 };
static const struct rg_buffer kept = { .name = "kept", .size_per_texel = 4, .persistent = true };
static const struct rg_buffer nothing = { .name = "nothing", .size = 4 };

static const struct rg_buffer drawn_out = FEATURE_NUMBERS("drawn out");
static const struct rg_buffer kept_out = FEATURE_NUMBERS("kept out");

static void record_rectangle(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    painted_draw(cmd, &(struct paint_push){ ALL });
}

static const struct rg_pass rows[] = {
    { .name = "fill", FEATURE_FILL(texels, numbers) },
    {
        .name = "draw",
        .color = RG_TARGETS({ &drawn, RG_LOAD_DISCARD }),
        .depth = { &depth, RG_LOAD_CLEAR, .clear.depthStencil.depth = 1 },
        .uses = RG_USES(FEATURE_SEED,
                        { .image = &texels, .access = RG_SAMPLED, .binding = DATA_TEXELS }),
        PAINTED_BY(record_rectangle, &next_frag),
    },
    RUN_READ("read", drawn, drawn_out),
    FEATURE_COPY("keep", numbers, kept),
    FEATURE_COPY("read kept", kept, kept_out),
};

static const struct run_params params = {
    .technique = RG_TECHNIQUE("test", rows),
    .outputs = { &drawn_out, &kept_out },
    .measure = { RG_CLOCK_EXACT, true },
};

static VkResult try_frame(struct run *run)
{
    VkResult result = rg_exec_begin(run->exec, &run->slot);
    if (result != VK_SUCCESS)
        return result;
    *(struct data_seed *)run_data(run, &feature_seed) = (struct data_seed){ 5 };
    result = rg_exec_submit(run->exec, NULL);
    return result == VK_SUCCESS ? rg_exec_wait(run->exec, run->slot) : result;
}

static void check_frame(struct run *run)
{
    const uint32_t *result = run_data(run, &drawn_out);
    const uint32_t *copy = run_data(run, &kept_out);
    for (uint32_t i = 0; i < 64; i++) {
        assert_int_equal(result[i], i + 10);
        assert_int_equal(copy[i], 3 * (i + 5));
    }
}

/* ---- tests ---- */

static void check_allocations(struct gpu *gpu, const struct run_params *run_params)
{
    static const struct paint_push paints[16] = { 0 };
    struct rg_frame frame = { .rows = run_params->technique.passes, .paints = paints };
    struct run run;
    allocations.count = 0;
    run_open(&run, gpu, run_params);
    const uint32_t before = allocations.count;
    for (uint32_t number = 0; number < 6; number++) {
        frame.wanted = number % 3 != 0;
        run_frame(&run, &frame);
    }
    assert_int_equal(allocations.count, before);
    assert_true(before > 0);
    run_close(&run);
}

/* Not even the first one. */
static void frames_allocate_nothing(void **state)
{
    static const struct feature *const features[] = {
        &feature_history,   &feature_history_buffers, &feature_when,
        &feature_per_layer, &feature_resolve,         &feature_storage,
    };
    for (size_t i = 0; i < sizeof(features) / sizeof(features[0]); i++) {
        for (unsigned way = 0; way < RUN_VARIANT_COUNT; way++) {
            const struct run_params changed = run_variant(&features[i]->params, way);
            check_allocations(*state, &changed);
        }
    }
}

/* An array that cannot shrink stays as it is, without an error. */
static void every_allocation_may_fail(void **state)
{
    struct run run;
    uint32_t failing = 0;
    run_compile(&run, *state, &params);
    for (bool has_failed = true; has_failed;) {
        rg_exec_destroy(run.exec);
        run.line_count = 0;
        allocations = (struct calls){ .failing = ++failing };
        const VkResult result = run_create(&run, run.plan);
        has_failed = allocations.count >= failing;
        allocations = (struct calls){ 0 };
        assert_int_equal(run.line_count, result == VK_SUCCESS ? 0 : 1);
        if (result != VK_SUCCESS)
            assert_int_equal(result, VK_ERROR_OUT_OF_HOST_MEMORY);
    }
    /* the executor, its nine arrays, three of an image set and at least one a pass */
    assert_true(failing > 1 + 9 + 3 + 5);
    assert_int_equal(try_frame(&run), VK_SUCCESS);
    check_frame(&run);
    run_close(&run);
}

static void every_call_may_fail(struct gpu *gpu, bool render_passes)
{
    struct run_params changed = params;
    struct run run;
    VkResult result = VK_ERROR_UNKNOWN;
    changed.render_passes = render_passes;
    run_compile(&run, gpu, &changed);
    for (uint32_t failing = 1; result != VK_SUCCESS; failing++) {
        run.line_count = 0;
        let_fail(failing);
        result = run_create(&run, run.plan);
        if (result == VK_SUCCESS)
            result = try_frame(&run);
        let_succeed();
        assert_int_equal(run.line_count, result == VK_SUCCESS ? 0 : 1);
        if (result == VK_SUCCESS)
            break;
        assert_int_equal(result, VK_ERROR_TOO_MANY_OBJECTS);
        assert_non_null(strstr(run.line, "VkResult -10 from "));
        rg_exec_destroy(run.exec);
        run.exec = NULL;
    }
    assert_true(vulkan_calls.count > 50);
    check_frame(&run);
    run_close(&run);
}

static void every_vulkan_call_may_fail(void **state)
{
    every_call_may_fail(*state, false);
    every_call_may_fail(*state, true);
}

/* Whatever an update has changed by then, all of it goes with the executor. */
static void every_call_of_an_update_may_fail(void **state)
{
    struct run_params larger = params;
    VkResult result = VK_ERROR_UNKNOWN;
    larger.view = (VkExtent2D){ 16, 8 };
    for (uint32_t failing = 1; result != VK_SUCCESS; failing++) {
        struct run run;
        run_compile(&run, *state, &params);
        let_fail(0);
        assert_int_equal(run_create(&run, run.plan), VK_SUCCESS);
        assert_int_equal(try_frame(&run), VK_SUCCESS);
        vulkan_calls = (struct calls){ .failing = failing };
        result = run_try_update(&run, &larger);
        let_succeed();
        assert_int_equal(run.line_count, result == VK_SUCCESS ? 0 : 1);
        run_close(&run);
    }
    assert_true(vulkan_calls.count > 20);
}

/* Tight sizes are no device's; a driver whose own are as tight would be in its right to succeed. */
static void plan_without_device_is_refused(void **state)
{
    struct run_params changed = params;
    struct run run;
    changed.no_device = true;
    run_compile(&run, *state, &changed);
    assert_int_equal(run_create(&run, run.plan), VK_ERROR_INCOMPATIBLE_DRIVER);
    assert_int_equal(run.line_count, 1);
    assert_non_null(strstr(run.line, "a plan for another device"));
    run_close(&run);
}

/* As of a loader older than Vulkan 1.3. */
static void missing_function_is_refused(void **state)
{
    const PFN_vkQueueSubmit2 real = vkQueueSubmit2;
    struct run run;
    run_compile(&run, *state, &params);
    vkQueueSubmit2 = NULL;
    assert_int_equal(run_create(&run, run.plan), VK_ERROR_INCOMPATIBLE_DRIVER);
    vkQueueSubmit2 = real;
    assert_int_equal(run.line_count, 1);
    assert_string_equal(run.line, "VkResult -9 from vkGetInstanceProcAddr of vkQueueSubmit2");
    run_close(&run);
}

static void debug_utils_may_be_missing(void **state)
{
    const PFN_vkSetDebugUtilsObjectNameEXT name = vkSetDebugUtilsObjectNameEXT;
    const PFN_vkCmdBeginDebugUtilsLabelEXT begin = vkCmdBeginDebugUtilsLabelEXT;
    const PFN_vkCmdEndDebugUtilsLabelEXT end = vkCmdEndDebugUtilsLabelEXT;
    struct run run;
    vkSetDebugUtilsObjectNameEXT = NULL;
    vkCmdBeginDebugUtilsLabelEXT = NULL;
    vkCmdEndDebugUtilsLabelEXT = NULL;
    run_open(&run, *state, &params);
    vkSetDebugUtilsObjectNameEXT = name;
    vkCmdBeginDebugUtilsLabelEXT = begin;
    vkCmdEndDebugUtilsLabelEXT = end;
    assert_int_equal(try_frame(&run), VK_SUCCESS);
    check_frame(&run);
    run_close(&run);
}

static void missing_import_is_refused(void **state)
{
    const struct rg_import imports[] = {
        { .image = &texels, .access = RG_SAMPLED },
        { .buffer = &numbers, .access = RG_COPY_SRC },
    };
    const struct rg_pass draw[] = {
        {
            .name = "draw",
            .color = RG_TARGETS({ &drawn, RG_LOAD_DISCARD }),
            .uses = RG_USES(FEATURE_SEED,
                            { .image = &texels, .access = RG_SAMPLED, .binding = DATA_TEXELS }),
            PAINTED_BY(record_rectangle, &next_frag),
        },
        RUN_READ("read", drawn, drawn_out),
    };
    const struct rg_pass copy[] = {
        {
            .name = "copy",
            .kind = RG_TRANSFER,
            .uses = RG_USES({ .buffer = &numbers, .access = RG_COPY_SRC },
                            { .buffer = &drawn_out, .access = RG_COPY_DST }),
            .record = run_record_read,
        },
    };
    const struct rg_technique techniques[] = { RG_TECHNIQUE("draw", draw),
                                               RG_TECHNIQUE("copy", copy) };
    for (size_t i = 0; i < 2; i++) {
        struct run run;
        run_compile(&run, *state,
                    &(struct run_params){
                        .technique = techniques[i],
                        .outputs = { &drawn_out },
                        .imports = &imports[i],
                        .import_count = 1,
                    });
        run.params.import_count = 0;
        assert_int_equal(run_create(&run, run.plan), VK_ERROR_INITIALIZATION_FAILED);
        assert_int_equal(run.line_count, 1);
        assert_string_equal(run.line, i ? "VkResult -3 from the imported object of numbers"
                                        : "VkResult -3 from the imported object of texels");
        run_close(&run);
    }
}

static void shader_without_words_is_refused(void **state)
{
    static const struct rg_shader empty = { .name = "empty" };
    const struct rg_pass unwritten[] = {
        {
            .name = "draw",
            .color = RG_TARGETS({ &drawn, RG_LOAD_DISCARD }),
            .uses = RG_USES(FEATURE_SEED),
            .vert = &empty,
            .frag = &empty,
            .record = record_rectangle,
        },
        RUN_READ("read", drawn, drawn_out),
    };
    struct run run;
    run_compile(&run, *state,
                &(struct run_params){ .technique = RG_TECHNIQUE("draw", unwritten),
                                      .outputs = { &drawn_out } });
    assert_int_equal(run_create(&run, run.plan), VK_ERROR_INITIALIZATION_FAILED);
    assert_string_equal(run.line, "VkResult -3 from vkCreateShaderModule of empty");
    run_close(&run);
}

static void strangers_have_nothing(void **state)
{
    struct run run;
    run_open(&run, *state, &params);
    assert_null(rg_exec_mapped(run.exec, &nothing, 0));
    assert_null(rg_exec_mapped(run.exec, &numbers, 0));
    assert_ptr_not_equal(rg_exec_mapped(run.exec, &feature_seed, 0),
                         rg_exec_mapped(run.exec, &feature_seed, 1));
    assert_true(rg_exec_image(run.exec, &texels) != VK_NULL_HANDLE);
    assert_true(rg_exec_image(run.exec, &(struct rg_image){ .name = "?" }) == VK_NULL_HANDLE);
    run_close(&run);
    rg_exec_destroy(NULL);
}

/* ---- what becomes of targets: this driver would not show it ---- */

struct operations {
    VkAttachmentLoadOp color_load, depth_load;
    VkAttachmentStoreOp color_store, depth_store;
};

static struct operations seen;
static PFN_vkCmdBeginRendering real_begin_rendering;

static VKAPI_ATTR void VKAPI_CALL see_rendering(VkCommandBuffer commands,
                                                const VkRenderingInfo *info)
{
    seen = (struct operations){
        info->pColorAttachments[0].loadOp,
        info->pDepthAttachment->loadOp,
        info->pColorAttachments[0].storeOp,
        info->pDepthAttachment->storeOp,
    };
    real_begin_rendering(commands, info);
}

static VKAPI_ATTR VkResult VKAPI_CALL see_render_pass(VkDevice device,
                                                      const VkRenderPassCreateInfo *info,
                                                      const VkAllocationCallbacks *allocator,
                                                      VkRenderPass *render_pass)
{
    seen = (struct operations){
        info->pAttachments[0].loadOp,
        info->pAttachments[1].loadOp,
        info->pAttachments[0].storeOp,
        info->pAttachments[1].storeOp,
    };
    return real_vkCreateRenderPass(device, info, allocator, render_pass);
}

/* The colour is drawn over and read, the depth cleared and of no use afterwards. */
static void targets_are_not_kept_in_vain(void **state)
{
    for (unsigned way = 0; way < 2; way++) {
        struct run_params changed = params;
        struct run run;
        changed.render_passes = way == 1;
        seen = (struct operations){ 0 };
        real_begin_rendering = vkCmdBeginRendering;
        real_vkCreateRenderPass = vkCreateRenderPass;
        vkCmdBeginRendering = see_rendering;
        vkCreateRenderPass = see_render_pass;
        run_open(&run, *state, &changed);
        assert_int_equal(try_frame(&run), VK_SUCCESS);
        vkCmdBeginRendering = real_begin_rendering;
        vkCreateRenderPass = real_vkCreateRenderPass;
        assert_int_equal(seen.color_load, VK_ATTACHMENT_LOAD_OP_DONT_CARE);
        assert_int_equal(seen.color_store, VK_ATTACHMENT_STORE_OP_STORE);
        assert_int_equal(seen.depth_load, VK_ATTACHMENT_LOAD_OP_CLEAR);
        assert_int_equal(seen.depth_store, VK_ATTACHMENT_STORE_OP_DONT_CARE);
        run_close(&run);
    }
}

/* ---- memory that is not coherent ---- */

static PFN_vkGetPhysicalDeviceMemoryProperties real_memory_properties;

static VKAPI_ATTR void VKAPI_CALL not_coherent(VkPhysicalDevice physical,
                                               VkPhysicalDeviceMemoryProperties *properties)
{
    real_memory_properties(physical, properties);
    for (uint32_t i = 0; i < properties->memoryTypeCount; i++)
        properties->memoryTypes[i].propertyFlags &=
            ~(VkMemoryPropertyFlags)VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
}

/* One upload buffer is flushed before, two readback buffers invalidated after each frame. */
static void other_memory_is_flushed(void **state)
{
    struct run run;
    uint32_t calls[2];
    for (int way = 0; way < 2; way++) {
        real_memory_properties = vkGetPhysicalDeviceMemoryProperties;
        if (way == 1)
            vkGetPhysicalDeviceMemoryProperties = not_coherent;
        let_fail(0);
        run_open(&run, *state, &params);
        vkGetPhysicalDeviceMemoryProperties = real_memory_properties;
        vulkan_calls.count = 0;
        for (int frame = 0; frame < 3; frame++)
            assert_int_equal(try_frame(&run), VK_SUCCESS);
        calls[way] = vulkan_calls.count;
        let_succeed();
        check_frame(&run);
        run_close(&run);
    }
    assert_int_equal(calls[1], calls[0] + 3 * 3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_DEVICE(frames_allocate_nothing),     ON_DEVICE(every_allocation_may_fail),
        ON_DEVICE(every_vulkan_call_may_fail),  ON_DEVICE(plan_without_device_is_refused),
        ON_DEVICE(missing_function_is_refused), ON_DEVICE(debug_utils_may_be_missing),
        ON_DEVICE(missing_import_is_refused),   ON_DEVICE(shader_without_words_is_refused),
        ON_DEVICE(strangers_have_nothing),      ON_DEVICE(targets_are_not_kept_in_vain),
        ON_DEVICE(other_memory_is_flushed),     ON_DEVICE(every_call_of_an_update_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
