/* rectangle_rows.c: passes that draw one rectangle each, and exact comparison of texels. */
#include "tests/support/rectangle_rows.h"
#include <string.h>

#include "tests/support/assertions.h"

void painted_draw(struct rg_cmd *cmd, const struct paint_push *paint)
{
    rg_cmd_push(cmd, paint, sizeof(*paint));
    rg_cmd_draw(cmd, 6);
}

void painted_record(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    painted_draw(cmd, &frame->paints[rg_cmd_pass(cmd) - frame->rows]);
}

void painted_record_number(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    struct paint_push paint = frame->paints[rg_cmd_pass(cmd) - frame->rows];
    paint.color.x += (float)(rg_cmd_repetition(cmd) + 1);
    paint.depth = 0.5F - 0.0625F * (float)rg_cmd_repetition(cmd);
    painted_draw(cmd, &paint);
}

bool painted_when(const struct rg_frame *frame, uint32_t repetition)
{
    if (frame->asked)
        ++*frame->asked;
    return frame->wanted && !(frame->left_out & 1u << repetition);
}

/* ---- series ---- */

static PFN_vkAllocateMemory allocate_memory;
static const struct gpu *filled;

/* Mock of vkAllocateMemory that fills host-visible memory with garbage, which is 48.6 as floats. */
static VKAPI_ATTR VkResult VKAPI_CALL allocate_garbage(VkDevice device,
                                                       const VkMemoryAllocateInfo *info,
                                                       const VkAllocationCallbacks *callbacks,
                                                       VkDeviceMemory *memory)
{
    void *bytes;
    VkResult result = allocate_memory(device, info, callbacks, memory);
    if (result != VK_SUCCESS || !(filled->memory.memoryTypes[info->memoryTypeIndex].propertyFlags &
                                  VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT))
        return result;
    assert_int_equal(vkMapMemory(device, *memory, 0, VK_WHOLE_SIZE, 0, &bytes), VK_SUCCESS);
    memset(bytes, 0x42, (size_t)info->allocationSize);
    vkUnmapMemory(device, *memory);
    return VK_SUCCESS;
}

void painted_series(struct gpu *gpu, const struct run_params *params,
                    const struct painted_series *series)
{
    struct run run;
    const uint32_t slots = params->frames_in_flight ? params->frames_in_flight : 2;
    filled = gpu;
    allocate_memory = vkAllocateMemory;
    vkAllocateMemory = allocate_garbage;
    run_open(&run, gpu, params);
    vkAllocateMemory = allocate_memory;
    for (uint32_t number = 0; number < series->count + slots; number++) {
        struct rg_frame frame = { .rows = params->technique.passes };
        run.slot = number % slots;
        if (number < series->count)
            assert_int_equal(rg_exec_begin(run.exec, &run.slot), VK_SUCCESS);
        else
            assert_int_equal(rg_exec_wait(run.exec, run.slot), VK_SUCCESS);
        assert_int_equal(run.slot, number % slots);
        if (number >= slots)
            series->check(&run, number - slots);
        if (number >= series->count)
            continue;
        series->begin(&run, number, &frame);
        assert_int_equal(rg_exec_submit(run.exec, &frame), VK_SUCCESS);
    }
    run_close(&run);
}

void painted_series_variants(struct gpu *gpu, const struct run_params *params,
                             const struct painted_series *series)
{
    for (unsigned variant = 0; variant < RUN_VARIANT_COUNT; variant++) {
        const struct run_params changed = run_variant(params, variant);
        painted_series(gpu, &changed, series);
    }
}

/* ---- texels ---- */

vec4s painted_color(float r, float g, float b, float a)
{
    return (vec4s){ { r, g, b, a } };
}

void painted_check(struct run *run, const struct rg_buffer *buffer, uint32_t index, vec4s color)
{
    const float *texel = (const float *)run_data(run, buffer) + (size_t)4 * index;
    for (size_t i = 0; i < 4; i++) {
        if (texel[i] < color.raw[i] || texel[i] > color.raw[i] || texel[i] != texel[i])
            print_error("%s: texel %u, channel %zu\n", buffer->name, index, i);
        assert_float_equal(texel[i], color.raw[i], 0);
    }
}

void painted_check_all(struct run *run, const struct rg_buffer *buffer, uint32_t count, vec4s color)
{
    for (uint32_t i = 0; i < count; i++)
        painted_check(run, buffer, i, color);
}
