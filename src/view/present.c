/* present.c: draws over the whole window: unfiltered, unless the picture has another size. */
#include "src/view/present.h"
#include <math.h>
#include <string.h>
#include "shaders/embedded.h"
#include "shaders/present.h"
#include "src/tech/frame.h"
#include "src/tech/tonemap.h"

static rg_record_fn record_screen, record_right;
static rg_when_fn is_split;

const struct rg_image present_window = {
    .name = "present.window",
    .format = VK_FORMAT_B8G8R8A8_UNORM,
};

const struct rg_image present_right = {
    .name = "present.right",
    .format = VK_FORMAT_R8G8B8A8_UNORM,
};

static const struct rg_pass passes[PRESENT_PASS_COUNT] = {
    {
        .name = "present.screen",
        .color = RG_TARGETS({ &present_window, RG_LOAD_DISCARD }),
        .uses = RG_USES({ .image = &frame_display,
                          .access = RG_SAMPLED,
                          .binding = PRESENT_PICTURE,
                          .sampler = &frame_linear }),
        .vert = &present_vert,
        .frag = &present_frag,
        .push_size = sizeof(struct present_push),
        .record = record_screen,
    },
    {
        .name = "present.split",
        .color = RG_TARGETS({ &present_window, RG_LOAD_KEEP }),
        .uses = RG_USES({ .image = &present_right,
                          .access = RG_SAMPLED,
                          .binding = PRESENT_PICTURE,
                          .sampler = &frame_linear }),
        .vert = &present_vert,
        .frag = &present_frag,
        .push_size = sizeof(struct present_push),
        .record = record_right,
        .when = is_split,
    },
};

static void record_screen(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    struct present_push push = frame->window->present;
    push.line = PRESENT_NO_LINE;
    push.left = -1.0f;
    rg_cmd_push(cmd, &push, sizeof(push));
    rg_cmd_draw(cmd, 3);
}

static bool is_split(const struct rg_frame *frame, uint32_t repetition)
{
    (void)repetition;
    return frame->window->present.line != PRESENT_NO_LINE;
}

static void record_right(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    struct present_push push = frame->window->present;
    push.texel_columns = frame->window->right_columns;
    push.texel_rows = frame->window->right_rows;
    push.left = 2.0f * (float)(push.x + push.line) / (float)rg_cmd_extent(cmd).width - 1.0f;
    rg_cmd_push(cmd, &push, sizeof(push));
    rg_cmd_draw(cmd, 3);
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
