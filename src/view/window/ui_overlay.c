/* ui_overlay.c: passes that draw the user interface over the swapchain image, as textured
 * triangles. Colours are meant to be blended sRGB-encoded. If the swapchain format encodes sRGB on
 * write, blending is linear and half-transparent panels look slightly lighter. */
#include "src/view/window/ui_overlay.h"
#include <string.h>
#include "shaders/embedded.h"
#include "shaders/output/ui_overlay.h"
#include "src/tech/frame_resources.h"
#include "src/view/window/overlay_draw_list.h"
#include "src/view/window/present_pass.h"

static rg_record_fn record_panels, record_copy, record_commands;
static rg_when_fn are_old, are_kept, has_commands;

static const struct rg_image panels = {
    .name = "overlay.panels",
    .format = VK_FORMAT_B8G8R8A8_UNORM,
    .persistent = true,
};

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

static const struct rg_use copy_uses[] = {
    { .image = &panels, .access = RG_COPY_SRC },
    { .image = &present_window, .access = RG_COPY_DST, .partial = true },
    { 0 },
};

static const struct rg_pass passes[OVERLAY_PASS_COUNT] = {
    [OVERLAY_PANELS] = {
        .name = "overlay.panels",
        .color = RG_TARGETS({ &panels, RG_LOAD_CLEAR, .blend = RG_BLEND_OVER }),
        .uses = uses,
        .vert = &ui_overlay_vert,
        .frag = &ui_overlay_frag,
        .vertices = &layout,
        .push_size = sizeof(struct overlay_push),
        .record = record_panels,
        .when = are_old,
    },
    [OVERLAY_COPY] = {
        .name = "overlay.copy",
        .kind = RG_TRANSFER,
        .uses = copy_uses,
        .record = record_copy,
        .when = are_kept,
    },
    [OVERLAY_COMMANDS] = {
        .name = "overlay.direct",
        .color = RG_TARGETS({ &present_window, RG_LOAD_KEEP, .blend = RG_BLEND_OVER }),
        .uses = uses,
        .vert = &ui_overlay_vert,
        .frag = &ui_overlay_frag,
        .vertices = &layout,
        .push_size = sizeof(struct overlay_push),
        .record = record_commands,
        .when = has_commands,
    },
};

static bool are_kept(const struct rg_frame *frame, uint32_t repetition)
{
    (void)repetition;
    return frame->window->caches_panels && frame->window->overlay;
}

static bool are_old(const struct rg_frame *frame, uint32_t repetition)
{
    return are_kept(frame, repetition) && frame->window->panels_are_outdated;
}

/* Returns the index of the first draw command that the cached panel image does not contain. */
static uint32_t first_command(const struct rg_frame *frame)
{
    return are_kept(frame, 0) ? frame->window->overlay->docked_count : 0;
}

static bool has_commands(const struct rg_frame *frame, uint32_t repetition)
{
    const struct overlay_draw_list *list = frame->window->overlay;
    (void)repetition;
    return list && first_command(frame) < list->command_count;
}

static void draw(struct rg_cmd *cmd, const struct overlay_draw_list *list, uint32_t first,
                 uint32_t end)
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
    for (uint32_t i = first; i < end; i++) {
        const struct overlay_draw_command *part = &list->commands[i];
        rg_cmd_scissor(cmd, (VkRect2D){ { part->left, part->top }, { part->width, part->height } });
        rg_cmd_draw_mesh_part(cmd, &mesh, part->first_index, part->index_count);
    }
}

static void record_panels(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    draw(cmd, frame->window->overlay, 0, frame->window->overlay->docked_count);
}

static void record_commands(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    draw(cmd, frame->window->overlay, first_command(frame), frame->window->overlay->command_count);
}

/* Copies each docked panel from the cached image to the same position in the swapchain image. */
static void record_copy(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    const struct window_layout *l = &frame->window->layout;
    const VkRect2D docked[] = { l->bar, l->panel, l->strip, l->status };
    for (size_t i = 0; i < sizeof(docked) / sizeof(docked[0]); i++) {
        const VkImageSubresourceLayers color = { VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1 };
        const VkOffset3D at = { docked[i].offset.x, docked[i].offset.y, 0 };
        const VkExtent3D extent = { docked[i].extent.width, docked[i].extent.height, 1 };
        const VkImageCopy region = { color, at, color, at, extent };
        if (!extent.width || !extent.height)
            continue;
        vkCmdCopyImage(rg_cmd_vulkan(cmd), rg_cmd_image(cmd, frame->window->panels),
                       VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                       rg_cmd_image(cmd, frame->window->window_image),
                       VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
    }
}

const struct technique overlay = {
    .name = "overlay",
    .pass_groups = { { PHASE_DISPLAY, SCENE_OF_ANY, .graph = RG_TECHNIQUE("overlay", passes) } },
    .help = "panels over the image",
};

void overlay_tables_init(struct overlay_tables *tables, const struct rg_image *window, bool copies)
{
    const size_t first = copies ? OVERLAY_PANELS : OVERLAY_COMMANDS;
    memcpy(tables->passes, passes, sizeof(passes));
    memcpy(tables->copy_uses, copy_uses, sizeof(copy_uses));
    tables->panels = panels;
    tables->panels.format = window->format;
    for (size_t i = 0; i < OVERLAY_PASS_COUNT; i++) {
        if (i == OVERLAY_COPY)
            continue;
        tables->targets[i] = passes[i].color[0];
        tables->targets[i].image = i == OVERLAY_PANELS ? &tables->panels : window;
        tables->passes[i].color = &tables->targets[i];
    }
    tables->copy_uses[0].image = &tables->panels;
    tables->copy_uses[1].image = window;
    tables->passes[OVERLAY_COPY].uses = tables->copy_uses;
    tables->technique =
        (struct rg_technique){ "overlay", &tables->passes[first], OVERLAY_PASS_COUNT - first };
}
