/*
 * materials.c: a deferred frame with many pipelines in one pass. Usage: materials PICTURE.ppm
 *
 * Passes: `cascades` draws the layers of the shadow map, `surfaces` the G-buffer by one pipeline of
 * the program per material, `light` the lit image with hardware PCF, `smoke` soft particles that
 * test the depth which they sample, and `show` the image for the CPU.
 */
#include "camera.h"
#include "example.h"
#include "pipeline.h"

#include "deferred_screen.vert.h"
#include "deferred_surface.vert.h"
#include "materials_light.frag.h"
#include "materials_show.frag.h"
#include "materials_smoke.frag.h"
#include "materials_smoke.vert.h"
#include "materials_surface.frag.h"

enum {
    MATERIAL_COUNT = 8,
    CASCADE_COUNT = 3, /* each covers three times the width of the one before */
};

struct box {
    float center[3], size;
    float color[4];
};

struct rg_frame {
    struct matrix clip_from_world, shadow_from_world; /* of cascade 0 */
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
static const struct rg_image picture = { .name = "picture", .format = VK_FORMAT_R8G8B8A8_UNORM };
static const struct rg_buffer pixels = { .name = "pixels",
                                         .size_per_texel = 4,
                                         .memory = RG_MEMORY_READBACK };

static const struct rg_sampler shadow_sampler = {
    .linear = true,
    .compare = VK_COMPARE_OP_LESS_OR_EQUAL,
    .border = true,
    .border_color = VK_BORDER_COLOR_FLOAT_OPAQUE_WHITE,
};

#define SHADER(code) EXAMPLE_SHADER(#code, code)
static const struct rg_shader surface_vert = SHADER(deferred_surface_vert);
static const struct rg_shader screen_vert = SHADER(deferred_screen_vert);
static const struct rg_shader light_frag = SHADER(materials_light_frag);
static const struct rg_shader smoke_vert = SHADER(materials_smoke_vert);
static const struct rg_shader smoke_frag = SHADER(materials_smoke_frag);
static const struct rg_shader show_frag = SHADER(materials_show_frag);

struct surface_push {
    struct matrix clip_from_world;
    struct box box;
};

static VkPipeline pipelines[MATERIAL_COUNT];

/* Draws the ground and two rows of boxes, each with its pipeline if `has_materials`. */
static void draw_boxes(struct rg_cmd *cmd, const struct matrix *clip_from_world, bool has_materials)
{
    struct surface_push push = { *clip_from_world, { { 0, -40, 0 }, 40, { 0.5f, 0.5f, 0.5f } } };
    for (int i = 0; i <= MATERIAL_COUNT; i++) {
        if (has_materials)
            rg_cmd_bind_pipeline(cmd, pipelines[i % MATERIAL_COUNT]);
        rg_cmd_push(cmd, &push, sizeof(push));
        rg_cmd_draw(cmd, 36);
        push.box =
            (struct box){ { 1.7f * (float)(i % 4) - 2.55f, 0.5f, i < 4 ? 0.9f : -1.1f }, 0.5f };
        for (int k = 0; k < 3; k++)
            push.box.color[k] = 0.5f + 0.4f * cosf(0.8f * (float)i + 2.1f * (float)k);
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

static void record_screen(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    if (rg_cmd_pass(cmd)->push_size)
        rg_cmd_push(cmd, &frame->shadow_from_world, sizeof(frame->shadow_from_world));
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

static const struct rg_pass passes[] = {
    { .name = "cascades",
      .repeat = RG_PER_LAYER,
      .depth = { &cascades, RG_LOAD_CLEAR, { .depthStencil = { 1, 0 } } },
      .vert = &surface_vert,
      .depth_bias = { .constant = 2, .slope = 3 },
      .push_size = sizeof(struct surface_push),
      .record = record_cascade },
    { .name = "surfaces", /* the record function binds pipelines */
      .color = RG_TARGETS({ &color, RG_LOAD_CLEAR }, { &normal, RG_LOAD_CLEAR },
                          { &position, RG_LOAD_CLEAR }),
      .depth = { &depth, RG_LOAD_CLEAR, { .depthStencil = { 1, 0 } } },
      .push_size = sizeof(struct surface_push),
      .record = record_surfaces },
    { .name = "light",
      .color = RG_TARGETS({ &lit, RG_LOAD_DISCARD }),
      .uses = RG_USES(
          SAMPLED(color, 0), SAMPLED(normal, 1), SAMPLED(position, 2),
          { .image = &cascades, .access = RG_SAMPLED, .binding = 3, .sampler = &shadow_sampler }),
      .vert = &screen_vert,
      .frag = &light_frag,
      .push_size = sizeof(struct matrix),
      .record = record_screen },
    { .name = "smoke", /* tests the depth that it samples */
      .color = RG_TARGETS({ &lit, .blend = RG_BLEND_OVER }),
      .depth = { &depth },
      .depth_read_only = true,
      .uses = RG_USES(SAMPLED(depth, 0)),
      .vert = &smoke_vert,
      .frag = &smoke_frag,
      .push_size = sizeof(struct matrix),
      .record = record_smoke },
    { .name = "show",
      .color = RG_TARGETS({ &picture, RG_LOAD_DISCARD }),
      .uses = RG_USES(SAMPLED(lit, 0)),
      .vert = &screen_vert,
      .frag = &show_frag,
      .record = record_screen },
    { .name = "copy",
      .kind = RG_TRANSFER,
      .record = record_copy,
      .uses = RG_USES({ .image = &picture, .access = RG_COPY_SRC },
                      { .buffer = &pixels, .access = RG_COPY_DST }) },
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

int main(int argc, char **argv)
{
    const struct rg_technique technique = RG_TECHNIQUE("materials", passes);
    const struct matrix projection = clip_from_view(0.75f);
    const struct matrix clip_from_light = { { 0.4f, 0, 0, 0, 0, 0.4f, 0, 0, 0, 0, 0.03f, 0, 0, 0, 0,
                                              1 } };
    const struct matrix view_of_eye = view_from_world((const float[]){ 0.6f, 3.2f, 4.6f });
    const struct matrix view_of_light = view_from_world((const float[]){ 5, 8, 3 });
    struct rg_frame frame = { multiply(&projection, &view_of_eye),
                              multiply(&clip_from_light, &view_of_light) };
    const struct example example = { &technique, &pixels, { 320, 240 },   &frame,
                                     1,          NULL,    make_pipelines, destroy_pipelines };
    return argc == 2 ? example_run(&example, argv[1]) : 2;
}
