/* present_pass.c: passes that draw the rendered image into the swapchain image, 1:1 or scaled. */
#include "src/view/window/present_pass.h"
#include <math.h>
#include <string.h>
#include "shaders/embedded.h"
#include "shaders/output/present.h"
#include "src/file/srgb.h"
#include "src/tech/frame_resources.h"
#include "src/tech/output/tonemap.h"

static rg_record_fn record_scaled, record_left, record_right;
static rg_when_fn is_exact, is_split, is_split_scaled;

const struct rg_image present_window = {
    .name = "present.window",
    .format = VK_FORMAT_B8G8R8A8_UNORM,
};

const struct rg_image present_right = {
    .name = "present.right",
    .format = VK_FORMAT_R8G8B8A8_UNORM,
};

#define SOURCE(source) \
    RG_USES({ .image = &(source), \
              .access = RG_SAMPLED, \
              .binding = PRESENT_IMAGE, \
              .sampler = &frame_linear })

static const struct rg_pass passes[PRESENT_PASS_COUNT] = {
    {
        .name = "present.scaled",
        .color = RG_TARGETS({ &present_window, RG_LOAD_DISCARD }),
        .uses = SOURCE(frame_display),
        .vert = &present_vert,
        .frag = &present_scaled_frag,
        .push_size = sizeof(struct present_push),
        .record = record_scaled,
    },
    {
        .name = "present.exact",
        .color = RG_TARGETS({ &present_window, RG_LOAD_KEEP }),
        .uses = SOURCE(frame_display),
        .vert = &present_vert,
        .frag = &present_frag,
        .push_size = sizeof(struct present_push),
        .record = record_left,
        .when = is_exact,
    },
    {
        .name = "present.split",
        .color = RG_TARGETS({ &present_window, RG_LOAD_KEEP }),
        .uses = SOURCE(present_right),
        .vert = &present_vert,
        .frag = &present_frag,
        .push_size = sizeof(struct present_push),
        .record = record_right,
        .when = is_split,
    },
    {
        .name = "present.split_scaled",
        .color = RG_TARGETS({ &present_window, RG_LOAD_KEEP }),
        .uses = SOURCE(present_right),
        .vert = &present_vert,
        .frag = &present_scaled_frag,
        .push_size = sizeof(struct present_push),
        .record = record_right,
        .when = is_split_scaled,
    },
};

static bool has_line(const struct rg_frame *frame)
{
    return frame->window->present.line != PRESENT_NO_LINE;
}

static void push(struct rg_cmd *cmd, const struct present_area *area)
{
    const VkExtent2D window = rg_cmd_extent(cmd);
    const vec2s center = { { (float)window.width / 2.0f, (float)window.height / 2.0f } };
    const struct present_push pushed = {
        .uv_from_clip = { { center.x / (float)area->width, center.y / (float)area->height } },
        .uv_of_center = { { (center.x - (float)area->x) / (float)area->width,
                            (center.y - (float)area->y) / (float)area->height } },
        .x = area->x,
        .y = area->y,
    };
    rg_cmd_push(cmd, &pushed, sizeof(pushed));
}

/* Returns the window rectangle of columns `from` to `to` of the displayed image. */
static VkRect2D columns(const struct present_area *area, uint32_t from, uint32_t to)
{
    to = to < area->width ? to : area->width;
    return (VkRect2D){ { (int32_t)(area->x + from), (int32_t)area->y },
                       { to > from ? to - from : 0, area->height } };
}

static void draw(struct rg_cmd *cmd, const struct present_area *area, VkRect2D part)
{
    if (!part.extent.width || !part.extent.height)
        return;
    rg_cmd_scissor(cmd, part);
    push(cmd, area);
    rg_cmd_draw(cmd, 3);
}

/* Fills a rectangle of the window with an sRGB-encoded colour, 0xRRGGBB. */
static void fill(struct rg_cmd *cmd, const struct rg_frame *frame, VkRect2D part, uint32_t color)
{
    VkClearAttachment clear = { .aspectMask = VK_IMAGE_ASPECT_COLOR_BIT };
    const VkClearRect rect = { part, 0, 1 };
    if (!part.extent.width || !part.extent.height)
        return;
    for (size_t c = 0; c < 3; c++) {
        const float encoded = (float)(color >> (16 - 8 * c) & 255) / 255.0f;
        clear.clearValue.color.float32[c] =
            frame->window->encodes_srgb ? srgb_decode(encoded) : encoded;
    }
    clear.clearValue.color.float32[3] = 1.0f;
    vkCmdClearAttachments(rg_cmd_vulkan(cmd), 1, &clear, 1, &rect);
}

static void record_left(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    const struct present_area *area = &frame->window->present;
    draw(cmd, area, columns(area, 0, area->line));
}

/* Draws the margins around an image that does not fill its area of the window. */
static void surround(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    const struct present_area *p = &frame->window->present;
    const VkRect2D *room = &frame->window->layout.image;
    const uint32_t left = p->x - (uint32_t)room->offset.x;
    const uint32_t above = p->y - (uint32_t)room->offset.y;
    const VkRect2D parts[] = {
        { room->offset, { left, room->extent.height } },
        { { (int32_t)(p->x + p->width), room->offset.y },
          { room->extent.width - left - p->width, room->extent.height } },
        { room->offset, { room->extent.width, above } },
        { { room->offset.x, (int32_t)(p->y + p->height) },
          { room->extent.width, room->extent.height - above - p->height } },
    };
    for (size_t i = 0; i < sizeof(parts) / sizeof(parts[0]); i++)
        fill(cmd, frame, parts[i], p->surround);
}

/* Draws the margins. If the left image is scaled, draws it too. Both share one pass, because on
 * llvmpipe each pass over a window-sized image costs time, even if it draws nothing. */
static void record_scaled(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    surround(cmd, frame);
    if (!is_exact(frame, 0))
        record_left(cmd, frame);
}

/* Draws the right image and the divider. */
static void record_right(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    const struct present_area *area = &frame->window->present;
    draw(cmd, area, columns(area, area->line, area->width));
    fill(cmd, frame, columns(area, area->line, area->line + 1), 0xffffff);
    fill(cmd, frame, columns(area, area->line + 1, area->line + 2), 0);
}

static bool has_size(const struct rg_frame *frame, uint32_t columns, uint32_t rows)
{
    return frame->window->present.width == columns && frame->window->present.height == rows;
}

static bool is_exact(const struct rg_frame *frame, uint32_t repetition)
{
    const struct present_area *p = &frame->window->present;
    (void)repetition;
    return has_size(frame, p->texel_columns, p->texel_rows);
}

static bool is_split(const struct rg_frame *frame, uint32_t repetition)
{
    const struct window_frame *w = frame->window;
    (void)repetition;
    return has_line(frame) && has_size(frame, w->right_columns, w->right_rows);
}

static bool is_split_scaled(const struct rg_frame *frame, uint32_t repetition)
{
    return has_line(frame) && !is_split(frame, repetition);
}

const struct technique present = {
    .name = "present",
    .help = "presentation of the image in a window",
    .pass_groups = { { PHASE_DISPLAY, SCENE_OF_ANY, .graph = RG_TECHNIQUE("present", passes) } },
};

struct present_area present_fit(VkRect2D view, VkExtent2D image, double divider)
{
    const VkExtent2D room = view.extent;
    struct present_area area = { .line = PRESENT_NO_LINE };
    double scale = fmin((double)room.width / image.width, (double)room.height / image.height);
    area.width = (uint32_t)fmin(fmax(image.width * scale + 0.5, 1.0), room.width);
    area.height = (uint32_t)fmin(fmax(image.height * scale + 0.5, 1.0), room.height);
    area.x = (uint32_t)view.offset.x + (room.width - area.width) / 2;
    area.y = (uint32_t)view.offset.y + (room.height - area.height) / 2;
    area.texel_columns = image.width;
    area.texel_rows = image.height;
    if (divider >= 0.0)
        area.line = (uint32_t)(divider * area.width + 0.5);
    return area;
}

void present_tables_init(struct present_tables *tables, VkFormat format)
{
    tables->window = present_window;
    tables->window.format = format;
    memcpy(tables->passes, passes, sizeof(passes));
    for (size_t i = 0; i < PRESENT_PASS_COUNT; i++) {
        tables->targets[i] = passes[i].color[0];
        tables->targets[i].image = &tables->window;
        tables->passes[i].color = &tables->targets[i];
    }
    tables->technique = (struct rg_technique)RG_TECHNIQUE("present", tables->passes);
}
