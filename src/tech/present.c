/* present.c: draws over the whole window, unfiltered: its pixels are the picture's. */
#include "src/tech/present.h"
#include <string.h>
#include "shaders/embedded.h"
#include "shaders/present.h"
#include "src/frame.h"
#include "src/tech/tonemap.h"

static rg_record_fn record_screen;

const struct rg_image present_window = {
    .name = "present.window",
    .format = VK_FORMAT_B8G8R8A8_UNORM,
};

static const struct rg_pass passes[PRESENT_PASS_COUNT] = {
    {
        .name = "present.screen",
        .color[0] = { &present_window, RG_LOAD_DISCARD },
        .uses =
            RG_USES({ .image = &tonemap_color, .access = RG_SAMPLED, .binding = PRESENT_PICTURE }),
        .vert = &screen_vert,
        .frag = &present_frag,
        .push_size = sizeof(struct present_push),
        .record = record_screen,
    },
};

static void record_screen(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    rg_cmd_push(cmd, &frame->present, sizeof(frame->present));
    rg_cmd_draw(cmd, 3);
}

const struct technique present = {
    .graph = RG_TECHNIQUE("present", passes),
    .help = "the picture in a window",
};

void present_tables_init(struct present_tables *tables, VkFormat format)
{
    tables->window = present_window;
    tables->window.format = format;
    memcpy(tables->passes, passes, sizeof(passes));
    for (size_t i = 0; i < PRESENT_PASS_COUNT; i++)
        tables->passes[i].color[0].image = &tables->window;
    tables->technique = (struct rg_technique)RG_TECHNIQUE("present", tables->passes);
}
