/* present.c: draws over the whole window: unfiltered, unless the picture has another size. */
#include "src/view/present.h"
#include <math.h>
#include <string.h>
#include "shaders/embedded.h"
#include "shaders/present.h"
#include "src/tech/frame.h"
#include "src/tech/tonemap.h"

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

#define PICTURE(picture) \
    RG_USES({ .image = &(picture), \
              .access = RG_SAMPLED, \
              .binding = PRESENT_PICTURE, \
              .sampler = &frame_linear })

static const struct rg_pass passes[PRESENT_PASS_COUNT] = {
    {
        .name = "present.scaled",
        .color = RG_TARGETS({ &present_window, RG_LOAD_DISCARD }),
        .uses = PICTURE(frame_display),
        .vert = &screen_vert,
        .frag = &present_scaled_frag,
        .push_size = sizeof(struct present_push),
        .record = record_scaled,
    },
    {
        .name = "present.screen",
        .color = RG_TARGETS({ &present_window, RG_LOAD_KEEP }),
        .uses = PICTURE(frame_display),
        .vert = &screen_vert,
        .frag = &present_frag,
        .push_size = sizeof(struct present_push),
        .record = record_left,
        .when = is_exact,
    },
    {
        .name = "present.split",
        .color = RG_TARGETS({ &present_window, RG_LOAD_KEEP }),
        .uses = PICTURE(present_right),
        .vert = &screen_vert,
        .frag = &present_frag,
        .push_size = sizeof(struct present_push),
        .record = record_right,
        .when = is_split,
    },
    {
        .name = "present.split_scaled",
        .color = RG_TARGETS({ &present_window, RG_LOAD_KEEP }),
        .uses = PICTURE(present_right),
        .vert = &screen_vert,
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

/* Draws columns of the shown picture. */
static void record(struct rg_cmd *cmd, const struct present_push *push, uint32_t from, uint32_t to)
{
    if (from >= to)
        return;
    rg_cmd_scissor(cmd, (VkRect2D){ { (int32_t)(push->x + from), (int32_t)push->y },
                                    { to - from, push->height } });
    rg_cmd_push(cmd, push, sizeof(*push));
    rg_cmd_draw(cmd, 3);
}

static void record_left(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    struct present_push push = frame->window->present;
    const uint32_t to = push.line < push.width ? push.line : push.width;
    push.line = PRESENT_NO_LINE;
    record(cmd, &push, 0, to);
}

/* The picture has the shape of its part of the window, or something around it. */
static bool is_boxed(const struct window_frame *w)
{
    const VkExtent2D room = w->layout.picture.extent;
    return room.width != w->present.width || room.height != w->present.height;
}

/* What is around the picture, too: on llvmpipe a pass on an image as large as the window takes
 * 2 ms, even if it draws nothing. Where the picture is exact, that is all. */
static void record_scaled(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    struct present_push push = frame->window->present;
    if (!is_boxed(frame->window)) {
        if (!is_exact(frame, 0))
            record_left(cmd, frame);
        return;
    }
    push.line = PRESENT_NO_LINE;
    rg_cmd_scissor(cmd, frame->window->layout.picture);
    rg_cmd_push(cmd, &push, sizeof(push));
    rg_cmd_draw(cmd, 3);
}

static void record_right(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    struct present_push push = frame->window->present;
    push.texel_columns = frame->window->right_columns;
    push.texel_rows = frame->window->right_rows;
    record(cmd, &push, push.line, push.width);
}

static bool has_size(const struct rg_frame *frame, uint32_t columns, uint32_t rows)
{
    return frame->window->present.width == columns && frame->window->present.height == rows;
}

static bool is_exact(const struct rg_frame *frame, uint32_t repetition)
{
    const struct present_push *p = &frame->window->present;
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
    .help = "presentation of the picture in a window",
    .parts = { { PHASE_DISPLAY, SCENE_OF_ANY, .graph = RG_TECHNIQUE("present", passes) } },
};

struct present_push present_fit(VkRect2D view, VkExtent2D picture, double divider)
{
    const VkExtent2D room = view.extent;
    struct present_push push = { .line = PRESENT_NO_LINE };
    double scale = fmin((double)room.width / picture.width, (double)room.height / picture.height);
    push.width = (uint32_t)fmin(fmax(picture.width * scale + 0.5, 1.0), room.width);
    push.height = (uint32_t)fmin(fmax(picture.height * scale + 0.5, 1.0), room.height);
    push.x = (uint32_t)view.offset.x + (room.width - push.width) / 2;
    push.y = (uint32_t)view.offset.y + (room.height - push.height) / 2;
    push.texel_columns = picture.width;
    push.texel_rows = picture.height;
    push.part = (vec2s){ { 1.0f / (float)push.width, 1.0f / (float)push.height } };
    if (divider >= 0.0)
        push.line = (uint32_t)(divider * push.width + 0.5);
    return push;
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
