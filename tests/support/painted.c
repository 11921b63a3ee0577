/* painted.c: rows that draw a rectangle each, and what they leave in the texels. */
#include "tests/support/painted.h"

#include "tests/support/check.h"

void painted_draw(struct rg_cmd *cmd, const struct paint_push *paint)
{
    rg_cmd_push(cmd, paint, sizeof(*paint));
    rg_cmd_draw(cmd, 6);
}

void painted_record(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    painted_draw(cmd, &frame->paints[rg_cmd_pass(cmd) - frame->rows]);
}

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
