/*
 * materials.c: a deferred frame with many pipelines in one pass, as C17 or C++20 (materials.cpp).
 * Usage: materials PICTURE.ppm
 *
 * Passes: `cascades` draws the layers of the shadow map, `surfaces` the G-buffer by one pipeline of
 * the program per material, `light` the lit image with hardware PCF, `smoke` soft particles that
 * test the depth which they sample, `blend` averages the frames (temporal antialiasing), and `show`
 * makes the image for the CPU. The history is what `blend` drew in the last frame, without a copy.
 */
#include "camera.h"
#include "example.h"
#include "pipeline.h"

#include "deferred_screen.vert.h"
#include "deferred_surface.vert.h"
#include "materials_blend.frag.h"
#include "materials_light.frag.h"
#include "materials_show.frag.h"
#include "materials_smoke.frag.h"
#include "materials_smoke.vert.h"
#include "materials_surface.frag.h"

enum {
    MATERIAL_COUNT = 8,
    CASCADE_COUNT = 3, /* each covers three times the width of the one before */
    FRAME_COUNT = 16,
};

struct box {
    float center[3], size;
    float color[4];
};

struct rg_frame {
    struct matrix clip_from_world, shadow_from_world; /* of cascade 0 */
    struct matrix still, previous; /* clip_from_world of this and the previous frame, unmoved */
    uint32_t number;
};

static const struct rg_image cascades = { .name = "cascades",
                                          .format = VK_FORMAT_D32_SFLOAT,
                                          .width = 512,
                                          .height = 512,
                                          .layers = CASCADE_COUNT };
static const struct rg_image depth = { .name = "depth", .format = VK_FORMAT_D32_SFLOAT };
static const struct rg_image color = { .name = "color", .format = VK_FORMAT_R16G16B16A16_SFLOAT };
static const struct rg_image normal = { .name = "normal", .format = VK_FORMAT_R16G16B16A16_SFLOAT };
static const struct rg_image position = { .name = "position",
                                          .format = VK_FORMAT_R32G32B32A32_SFLOAT };
static const struct rg_image lit = { .name = "lit", .format = VK_FORMAT_R16G16B16A16_SFLOAT };
static const struct rg_image blended = { .name = "blended",
                                         .format = VK_FORMAT_R16G16B16A16_SFLOAT };
static const struct rg_image history = { .name = "history",
                                         .format = VK_FORMAT_R16G16B16A16_SFLOAT,
                                         .previous = &blended };
static const struct rg_image picture = { .name = "picture", .format = VK_FORMAT_R8G8B8A8_UNORM };
static const struct rg_buffer pixels = { .name = "pixels",
                                         .size_per_texel = 4,
                                         .memory = RG_MEMORY_READBACK };

static const struct rg_sampler shadow_sampler = {
    .linear = true,
    .border = true,
    .border_color = VK_BORDER_COLOR_FLOAT_OPAQUE_WHITE,
    .compare = VK_COMPARE_OP_LESS_OR_EQUAL,
};
static const struct rg_sampler history_sampler = { .linear = true };

#define SHADER(code) EXAMPLE_SHADER(#code, code)
static const struct rg_shader surface_vert = SHADER(deferred_surface_vert);
static const struct rg_shader screen_vert = SHADER(deferred_screen_vert);
static const struct rg_shader light_frag = SHADER(materials_light_frag);
static const struct rg_shader blend_frag = SHADER(materials_blend_frag);
static const struct rg_shader smoke_vert = SHADER(materials_smoke_vert);
static const struct rg_shader smoke_frag = SHADER(materials_smoke_frag);
static const struct rg_shader show_frag = SHADER(materials_show_frag);

struct surface_push {
    struct matrix clip_from_world;
    struct box box;
};

struct blend_push {
    struct matrix previous;
    float weight; /* of the new frame */
};

static VkPipeline pipelines[MATERIAL_COUNT];

static struct box box_of(int i)
{
    struct box box = { { 1.7f * (float)(i % 4) - 2.55f, 0.5f, i < 4 ? 0.9f : -1.1f }, 0.5f, { 0 } };
    for (int k = 0; k < 3; k++)
        box.color[k] = 0.5f + 0.4f * cosf(0.8f * (float)i + 2.1f * (float)k);
    return box;
}

/* Draws the ground and two rows of boxes, each with its pipeline if `has_materials`. */
static void draw_boxes(struct rg_cmd *cmd, const struct matrix *clip_from_world, bool has_materials)
{
    struct surface_push push = { *clip_from_world, { { 0, -40, 0 }, 40, { 0.5f, 0.5f, 0.5f, 0 } } };
    for (int i = 0; i <= MATERIAL_COUNT; i++) {
        if (has_materials)
            rg_cmd_bind_pipeline(cmd, pipelines[i % MATERIAL_COUNT]);
        rg_cmd_push(cmd, &push, sizeof(push));
        rg_cmd_draw(cmd, 36);
        push.box = box_of(i);
    }
}

static void record_cascade(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    struct matrix clip = frame->shadow_from_world;
    for (int i = 0; i < 16; i++)
        clip.m[i] /= i % 4 < 2 ? powf(3.0f, (float)rg_cmd_repetition(cmd)) : 1.0f;
    draw_boxes(cmd, &clip, false);
}

static void record_surfaces(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    draw_boxes(cmd, &frame->clip_from_world, true);
}

static void record_light(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    rg_cmd_push(cmd, &frame->shadow_from_world, sizeof(frame->shadow_from_world));
    rg_cmd_draw(cmd, 3);
}

static void record_blend(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    const struct blend_push push = { frame->previous, frame->number ? 0.1f : 1.0f };
    rg_cmd_push(cmd, &push, sizeof(push));
    rg_cmd_draw(cmd, 3);
}

static void record_show(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    rg_cmd_draw(cmd, 3);
}

static void record_smoke(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    rg_cmd_push(cmd, &frame->clip_from_world, sizeof(frame->clip_from_world));
    rg_cmd_draw(cmd, 6 * 40);
}

static void record_copy(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    rg_cmd_copy_image_to_buffer(cmd, &picture, &pixels, 0);
}

#define SAMPLED(from, number) \
    { \
        .image = &(from), .access = RG_SAMPLED, .binding = (number) \
    }

#define CLEARED(to) \
    { \
        .image = &(to), .load = RG_LOAD_CLEAR \
    }

static const struct rg_pass passes[] = {
    { .name = "cascades",
      .depth = { .image = &cascades, .load = RG_LOAD_CLEAR, .clear = { .depthStencil = { 1, 0 } } },
      .vert = &surface_vert,
      .push_size = sizeof(struct surface_push),
      .record = record_cascade,
      .repeat = RG_PER_LAYER,
      .depth_bias = { .constant = 2, .slope = 3 } },
    { .name = "surfaces", /* the record function binds pipelines */
      .color = RG_TARGETS(CLEARED(color), CLEARED(normal), CLEARED(position)),
      .depth = { .image = &depth, .load = RG_LOAD_CLEAR, .clear = { .depthStencil = { 1, 0 } } },
      .push_size = sizeof(struct surface_push),
      .record = record_surfaces },
    { .name = "light",
      .color = RG_TARGETS({ .image = &lit, .load = RG_LOAD_DISCARD }),
      .uses = RG_USES(
          SAMPLED(color, 0), SAMPLED(normal, 1), SAMPLED(position, 2),
          { .image = &cascades, .access = RG_SAMPLED, .binding = 3, .sampler = &shadow_sampler }),
      .vert = &screen_vert,
      .frag = &light_frag,
      .push_size = sizeof(struct matrix),
      .record = record_light },
    { .name = "smoke", /* tests the depth that it samples */
      .color = RG_TARGETS({ .image = &lit, .blend = RG_BLEND_OVER }),
      .depth = { .image = &depth },
      .uses = RG_USES(SAMPLED(depth, 0)),
      .vert = &smoke_vert,
      .frag = &smoke_frag,
      .push_size = sizeof(struct matrix),
      .record = record_smoke,
      .depth_read_only = true },
    { .name = "blend",
      .color = RG_TARGETS({ .image = &blended, .load = RG_LOAD_DISCARD }),
      .uses = RG_USES(
          SAMPLED(lit, 0), SAMPLED(position, 1),
          { .image = &history, .access = RG_SAMPLED, .binding = 2, .sampler = &history_sampler }),
      .vert = &screen_vert,
      .frag = &blend_frag,
      .push_size = sizeof(struct blend_push),
      .record = record_blend },
    { .name = "show",
      .color = RG_TARGETS({ .image = &picture, .load = RG_LOAD_DISCARD }),
      .uses = RG_USES(SAMPLED(blended, 0)),
      .vert = &screen_vert,
      .frag = &show_frag,
      .record = record_show },
    { .name = "copy",
      .kind = RG_TRANSFER,
      .uses = RG_USES({ .image = &picture, .access = RG_COPY_SRC },
                      { .buffer = &pixels, .access = RG_COPY_DST }),
      .record = record_copy },
};

static bool make_pipelines(VkDevice device, const struct rg_exec *exec)
{
    static const struct rg_shader frag = SHADER(materials_surface_frag);
    for (uint32_t i = 0; i < MATERIAL_COUNT; i++) {
        pipelines[i] = pipeline_create(device, exec, &passes[1], &surface_vert, &frag, i);
        if (!pipelines[i])
            return false;
    }
    return true;
}

static void destroy_pipelines(VkDevice device)
{
    for (int i = 0; i < MATERIAL_COUNT; i++)
        vkDestroyPipeline(device, pipelines[i], NULL);
}

/* Returns digit-reversed `i` in a base, from 0 to 1: positions of samples within a pixel. */
static float reversed(uint32_t i, uint32_t base)
{
    float scale = 1.0f, sum = 0.0f;
    for (; i; i /= base)
        sum += (float)(i % base) * (scale /= (float)base);
    return sum;
}

/* Moves the camera, and the image by less than a pixel. */
static void advance(struct rg_exec *exec, uint32_t slot, struct rg_frame *frame)
{
    static uint32_t frames;
    const float angle = 0.13f + 0.004f * ((float)frames - (FRAME_COUNT - 1));
    const float eye[] = { 4.64f * sinf(angle), 3.2f, 4.64f * cosf(angle) };
    const float light[] = { 5, 8, 3 };
    const struct matrix clip_from_light = { { 0.4f, 0, 0, 0, 0, 0.4f, 0, 0, 0, 0, 0.03f, 0, 0, 0, 0,
                                              1 } };
    const struct matrix view = view_from_world(eye), view_of_light = view_from_world(light);
    struct matrix projection = clip_from_view(0.75f);
    (void)exec;
    (void)slot;
    frame->previous = frame->still;
    frame->still = multiply(&projection, &view);
    projection.m[8] = 2.0f * (reversed(frames + 1, 2) - 0.5f) / 320;
    projection.m[9] = 2.0f * (reversed(frames + 1, 3) - 0.5f) / 240;
    frame->clip_from_world = multiply(&projection, &view);
    frame->shadow_from_world = multiply(&clip_from_light, &view_of_light);
    frame->number = frames++;
}

int main(int argc, char **argv)
{
    const struct rg_technique technique = RG_TECHNIQUE("materials", passes);
    struct rg_frame frame = EXAMPLE_ZERO;
    const struct example example = { &technique,  &pixels, { 320, 240 },   &frame,
                                     FRAME_COUNT, advance, make_pipelines, destroy_pipelines };
    return argc == 2 ? example_run(&example, argv[1]) : 2;
}
