/* blur.c: separable Gaussian blur in compute shaders. Usage: blur PICTURE.ppm */
#include "example.h"

#include "blur.comp.h"
#include "disc.comp.h"

static const struct rg_image disc = { "disc", VK_FORMAT_R8G8B8A8_UNORM };
static const struct rg_image half_blurred = { "half blurred", VK_FORMAT_R8G8B8A8_UNORM };
static const struct rg_image blurred = { "blurred", VK_FORMAT_R8G8B8A8_UNORM };
static const struct rg_buffer pixels = { "pixels", 0, 4, RG_MEMORY_READBACK };
static const struct rg_shader disc_shader = EXAMPLE_SHADER("disc.comp", disc_comp);
static const struct rg_shader blur_shader = EXAMPLE_SHADER("blur.comp", blur_comp);

static void dispatch(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    const VkExtent2D size = rg_cmd_extent(cmd);
    const int along_y = rg_cmd_pass(cmd)->uses[0].image == &half_blurred;
    const int step[2] = { !along_y, along_y };
    (void)frame;
    if (rg_cmd_pass(cmd)->push_size)
        rg_cmd_push(cmd, step, sizeof(step));
    rg_cmd_dispatch(cmd, (size.width + 7) / 8, (size.height + 7) / 8, 1);
}

static void copy(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    rg_cmd_copy_image_to_buffer(cmd, &blurred, &pixels, 0);
}

#define BLUR(title, from, to) \
    { \
        .name = title, .kind = RG_COMPUTE, .comp = &blur_shader, .push_size = 8, \
        .record = dispatch, \
        .uses = RG_USES({ .image = &from, .access = RG_SAMPLED, .binding = 0 }, \
                        { .image = &to, .access = RG_STORAGE_WRITE, .binding = 1 }) \
    }

static const struct rg_pass passes[] = {
    { .name = "disc",
      .kind = RG_COMPUTE,
      .comp = &disc_shader,
      .record = dispatch,
      .uses = RG_USES({ .image = &disc, .access = RG_STORAGE_WRITE, .binding = 1 }) },
    BLUR("blur along x", disc, half_blurred),
    BLUR("blur along y", half_blurred, blurred),
    { .name = "copy",
      .kind = RG_TRANSFER,
      .record = copy,
      .uses = RG_USES({ .image = &blurred, .access = RG_COPY_SRC },
                      { .buffer = &pixels, .access = RG_COPY_DST }) },
};

int main(int argc, char **argv)
{
    const struct rg_technique technique = RG_TECHNIQUE("blur", passes);
    const struct example example = { &technique, &pixels, { 256, 256 }, .frame_count = 1 };
    return argc == 2 ? example_run(&example, argv[1]) : 2;
}
