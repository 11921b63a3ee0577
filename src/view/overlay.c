/*
 * overlay.c: triangles with the texels of a font and of pictures, blended over the window.
 *
 * Colours are blended as they are encoded, as interfaces are designed; where the window encodes
 * what is written, in linear light: half-transparent panels then look a little lighter.
 */
#include "src/view/overlay.h"
#include <string.h>
#include "shaders/embedded.h"
#include "shaders/overlay.h"
#include "src/tech/frame.h"
#include "src/view/overlay_list.h"
#include "src/view/present.h"

static rg_record_fn record_parts;

const struct rg_image overlay_font = {
    .name = "overlay.font",
    .format = VK_FORMAT_R8G8B8A8_UNORM,
    .width = 1,
    .height = 1,
};

const struct rg_buffer overlay_vertices = {
    .name = "overlay.vertices",
    .size = OVERLAY_VERTEX_COUNT * sizeof(struct overlay_vertex),
    .memory = RG_MEMORY_UPLOAD,
};

const struct rg_buffer overlay_indices = {
    .name = "overlay.indices",
    .size = OVERLAY_INDEX_COUNT * sizeof(uint32_t),
    .memory = RG_MEMORY_UPLOAD,
};

static const VkVertexInputAttributeDescription attributes[] = {
    {
        .location = OVERLAY_POSITION,
        .format = VK_FORMAT_R32G32_SFLOAT,
        .offset = offsetof(struct overlay_vertex, x),
    },
    {
        .location = OVERLAY_UV,
        .format = VK_FORMAT_R32G32_SFLOAT,
        .offset = offsetof(struct overlay_vertex, u),
    },
    {
        .location = OVERLAY_COLOR,
        .format = VK_FORMAT_R8G8B8A8_UNORM,
        .offset = offsetof(struct overlay_vertex, color),
    },
};

static const struct rg_vertex_layout layout = {
    .stride = sizeof(struct overlay_vertex),
    .attribute_count = sizeof(attributes) / sizeof(attributes[0]),
    .attributes = attributes,
};

static const struct rg_use uses[] = {
    {
        .image = &overlay_font,
        .access = RG_SAMPLED,
        .binding = OVERLAY_FONT,
        .sampler = &frame_linear,
    },
    { .buffer = &overlay_vertices, .access = RG_VERTEX },
    { .buffer = &overlay_indices, .access = RG_INDEX },
    { 0 },
};

static const struct rg_pass passes[OVERLAY_PASS_COUNT] = {
    {
        .name = "overlay.parts",
        .color = RG_TARGETS({ &present_window, RG_LOAD_KEEP, .blend = RG_BLEND_OVER }),
        .uses = uses,
        .vert = &overlay_vert,
        .frag = &overlay_frag,
        .vertices = &layout,
        .push_size = sizeof(struct overlay_push),
        .record = record_parts,
    },
};

static void record_parts(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    const VkExtent2D extent = rg_cmd_extent(cmd);
    const struct overlay_push push = {
        .clip_from_pixel = { { 2.0f / (float)extent.width, 2.0f / (float)extent.height } },
    };
    const struct rg_mesh mesh = {
        .vertices = rg_cmd_buffer(cmd, &overlay_vertices),
        .indices = rg_cmd_buffer(cmd, &overlay_indices),
    };
    rg_cmd_push(cmd, &push, sizeof(push));
    for (uint32_t i = 0; frame->window->overlay && i < frame->window->overlay->part_count; i++) {
        const struct overlay_part *part = &frame->window->overlay->parts[i];
        rg_cmd_scissor(cmd, (VkRect2D){ { part->left, part->top }, { part->width, part->height } });
        rg_cmd_draw_mesh_part(cmd, &mesh, part->first_index, part->index_count);
    }
}

const struct technique overlay = {
    .name = "overlay",
    .parts = { { PHASE_DISPLAY, SCENE_OF_ANY, .graph = RG_TECHNIQUE("overlay", passes) } },
    .help = "panels over the picture",
};

void overlay_tables_init(struct overlay_tables *tables, const struct rg_image *window)
{
    memcpy(tables->passes, passes, sizeof(passes));
    for (size_t i = 0; i < OVERLAY_PASS_COUNT; i++) {
        tables->targets[i] = passes[i].color[0];
        tables->targets[i].image = window;
        tables->passes[i].color = &tables->targets[i];
    }
    tables->technique = (struct rg_technique)RG_TECHNIQUE("overlay", tables->passes);
}
