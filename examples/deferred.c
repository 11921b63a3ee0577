/*
 * deferred.c: deferred shading of boxes, with a shadow map and bloom. Usage: deferred PICTURE.ppm
 *
 * Passes: `shadow` draws the shadow map, `surfaces` the G-buffer (colour, normal, position),
 * `light` the lit image, `bright` and `down` the bloom mip chain, and `show` the tone-mapped image.
 */
#include "camera.h"
#include "example.h"

#include "deferred_bright.frag.h"
#include "deferred_down.frag.h"
#include "deferred_light.frag.h"
#include "deferred_screen.vert.h"
#include "deferred_show.frag.h"
#include "deferred_surface.frag.h"
#include "deferred_surface.vert.h"

/* ---- the scene ---- */

struct box {
    float center[3], size;
    float color[4]; /* rgb: albedo; a: emission */
};

static const struct box boxes[] = {
    { { 0, -40, 0 }, 40, { 0.6f, 0.6f, 0.6f, 0 } }, /* ground plane */
    { { -1.6f, 0.7f, 0 }, 0.7f, { 0.8f, 0.2f, 0.1f, 0 } },
    { { 1.6f, 0.7f, 0.4f }, 0.7f, { 0.1f, 0.3f, 0.8f, 0 } },
    { { 0, 0.4f, 1.4f }, 0.4f, { 1.0f, 0.8f, 0.4f, 6 } },
};

struct rg_frame {
    struct matrix clip_from_world, shadow_from_world;
};

static const struct rg_image shadow = {
    .name = "shadow", .format = VK_FORMAT_D32_SFLOAT, .width = 1024, .height = 1024
};
static const struct rg_image depth = { .name = "depth", .format = VK_FORMAT_D32_SFLOAT };
static const struct rg_image color = { .name = "color", .format = VK_FORMAT_R16G16B16A16_SFLOAT };
static const struct rg_image normal = { .name = "normal", .format = VK_FORMAT_R16G16B16A16_SFLOAT };
static const struct rg_image position = { .name = "position",
                                          .format = VK_FORMAT_R32G32B32A32_SFLOAT };
static const struct rg_image lit = { .name = "lit", .format = VK_FORMAT_R16G16B16A16_SFLOAT };
static const struct rg_image bloom = {
    .name = "bloom", .format = VK_FORMAT_R16G16B16A16_SFLOAT, .scale = 0.5f, .mips = 5
};
static const struct rg_image picture = { .name = "picture", .format = VK_FORMAT_R8G8B8A8_UNORM };
static const struct rg_buffer pixels = { .name = "pixels",
                                         .size_per_texel = 4,
                                         .memory = RG_MEMORY_READBACK };

static const struct rg_shader surface_vert =
    EXAMPLE_SHADER("deferred_surface.vert", deferred_surface_vert);
static const struct rg_shader surface_frag =
    EXAMPLE_SHADER("deferred_surface.frag", deferred_surface_frag);
static const struct rg_shader fullscreen_vert =
    EXAMPLE_SHADER("deferred_screen.vert", deferred_screen_vert);
static const struct rg_shader light_frag =
    EXAMPLE_SHADER("deferred_light.frag", deferred_light_frag);
static const struct rg_shader bright_frag =
    EXAMPLE_SHADER("deferred_bright.frag", deferred_bright_frag);
static const struct rg_shader down_frag = EXAMPLE_SHADER("deferred_down.frag", deferred_down_frag);
static const struct rg_shader show_frag = EXAMPLE_SHADER("deferred_show.frag", deferred_show_frag);

struct surface_push {
    struct matrix clip_from_world;
    struct box box;
};

static void draw_boxes(struct rg_cmd *cmd, const struct matrix *clip_from_world)
{
    struct surface_push push = { .clip_from_world = *clip_from_world };
    for (size_t i = 0; i < sizeof(boxes) / sizeof(boxes[0]); i++) {
        push.box = boxes[i];
        rg_cmd_push(cmd, &push, sizeof(push));
        rg_cmd_draw(cmd, 36);
    }
}

static void record_shadow(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    draw_boxes(cmd, &frame->shadow_from_world);
}

static void record_surfaces(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    draw_boxes(cmd, &frame->clip_from_world);
}

static void record_light(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    rg_cmd_push(cmd, &frame->shadow_from_world, sizeof(frame->shadow_from_world));
    rg_cmd_draw(cmd, 3);
}

static void record_screen(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    rg_cmd_draw(cmd, 3);
}

static void record_copy(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    rg_cmd_copy_image_to_buffer(cmd, &picture, &pixels, 0);
}

static const struct rg_sampler linear = { .linear = true };
static const struct rg_sampler chain = { .linear = true, .mips = true };

#define SCREEN(shader, function) .vert = &fullscreen_vert, .frag = &(shader), .record = (function)
#define SAMPLED(from, number) \
    { \
        .image = &(from), .access = RG_SAMPLED, .binding = (number) \
    }

static const struct rg_pass passes[] = {
    { .name = "shadow",
      .depth = { &shadow, RG_LOAD_CLEAR, { .depthStencil = { 1, 0 } } },
      .vert = &surface_vert,
      .push_size = sizeof(struct surface_push),
      .record = record_shadow },
    { .name = "surfaces",
      .color = RG_TARGETS({ &color, RG_LOAD_CLEAR }, { &normal, RG_LOAD_CLEAR },
                          { &position, RG_LOAD_CLEAR }),
      .depth = { &depth, RG_LOAD_CLEAR, { .depthStencil = { 1, 0 } } },
      .vert = &surface_vert,
      .frag = &surface_frag,
      .push_size = sizeof(struct surface_push),
      .record = record_surfaces },
    { .name = "light",
      .color = RG_TARGETS({ &lit, RG_LOAD_DISCARD }),
      .uses =
          RG_USES(SAMPLED(color, 0), SAMPLED(normal, 1), SAMPLED(position, 2), SAMPLED(shadow, 3)),
      .push_size = sizeof(struct matrix),
      SCREEN(light_frag, record_light) },
    { .name = "bright",
      .color = RG_TARGETS({ &bloom, RG_LOAD_DISCARD }),
      .uses = RG_USES({ .image = &lit, .access = RG_SAMPLED, .sampler = &linear }),
      SCREEN(bright_frag, record_screen) },
    /* one pass per mip level from 1 on; each reads the previous level */
    { .name = "down",
      .repeat = RG_PER_MIP,
      .color = RG_TARGETS({ &bloom, RG_LOAD_DISCARD, .mip = 1 }),
      .uses = RG_USES(
          { .image = &bloom, .access = RG_SAMPLED, .sampler = &linear, .range = { .each = true } }),
      SCREEN(down_frag, record_screen) },
    { .name = "show",
      .color = RG_TARGETS({ &picture, RG_LOAD_DISCARD }),
      .uses = RG_USES(SAMPLED(lit, 0),
                      { .image = &bloom, .access = RG_SAMPLED, .binding = 1, .sampler = &chain }),
      SCREEN(show_frag, record_screen) },
    { .name = "copy",
      .kind = RG_TRANSFER,
      .record = record_copy,
      .uses = RG_USES({ .image = &picture, .access = RG_COPY_SRC },
                      { .buffer = &pixels, .access = RG_COPY_DST }) },
};

int main(int argc, char **argv)
{
    const VkExtent2D view = { 320, 240 };
    const struct rg_technique technique = RG_TECHNIQUE("deferred", passes);
    const struct matrix projection = clip_from_view(0.75f);
    const struct matrix clip_from_light = { { 0.2f, 0, 0, 0, 0, 0.2f, 0, 0, 0, 0, 0.05f, 0, 0, 0, 0,
                                              1 } };
    const struct matrix view_of_eye = view_from_world((const float[]){ 0, 3, 6 });
    const struct matrix view_of_light = view_from_world((const float[]){ 5, 8, 3 });
    struct rg_frame frame = { multiply(&projection, &view_of_eye),
                              multiply(&clip_from_light, &view_of_light) };
    const struct example example = { &technique, &pixels, view, &frame, .frame_count = 1 };
    return argc == 2 ? example_run(&example, argv[1]) : 2;
}
