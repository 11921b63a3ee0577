/*
 * culling.c: culls cubes on the GPU, draws those that are visible, and reads their number back
 * without waiting, as C17 or C++20 (culling.cpp). Usage: culling PICTURE.ppm
 *
 * Passes: `reset` fills the draw command, `cull` counts the visible cubes into it and lists them,
 * `draw` draws them indirectly, `count` and `copy` copy the number and the image to readback
 * buffers. A frame's number is read when its slot is used again, two frames later; by then the
 * device has finished the frame.
 */
#include "camera.h"
#include "example.h"

#include "culling.frag.h"
#include "culling.vert.h"
#include "culling_cull.comp.h"

enum {
    CUBE_COUNT = 4096,
    SLOT_COUNT = 2, /* default of rg_exec_params.frames_in_flight */
};

struct rg_frame {
    struct matrix clip_from_world;
    uint32_t number;
};

static const struct rg_image depth = { .name = "depth", .format = VK_FORMAT_D32_SFLOAT };
static const struct rg_image picture = { .name = "picture", .format = VK_FORMAT_R8G8B8A8_UNORM };
static const struct rg_buffer draw = { .name = "draw", .size = sizeof(VkDrawIndirectCommand) };
static const struct rg_buffer visible = { .name = "visible", .size = 4 * CUBE_COUNT };
static const struct rg_buffer count = { .name = "count", .size = 4, .memory = RG_MEMORY_READBACK };
static const struct rg_buffer pixels = { .name = "pixels",
                                         .size_per_texel = 4,
                                         .memory = RG_MEMORY_READBACK };

static const struct rg_shader cull_comp = EXAMPLE_SHADER("culling_cull.comp", culling_cull_comp);
static const struct rg_shader draw_vert = EXAMPLE_SHADER("culling.vert", culling_vert);
static const struct rg_shader draw_frag = EXAMPLE_SHADER("culling.frag", culling_frag);

static void record_reset(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    rg_cmd_fill_buffer(cmd, &draw, 0, 4, 36); /* vertices of a cube */
    rg_cmd_fill_buffer(cmd, &draw, 4, 12, 0); /* instances, first vertex, first instance */
}

static void record_cull(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    rg_cmd_push(cmd, &frame->clip_from_world, sizeof(frame->clip_from_world));
    rg_cmd_dispatch(cmd, CUBE_COUNT / 64, 1, 1);
}

static void record_draw(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    rg_cmd_push(cmd, &frame->clip_from_world, sizeof(frame->clip_from_world));
    rg_cmd_draw_indirect(cmd, &draw, 0);
}

static void record_count(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    const VkBufferCopy instances = { .srcOffset = 4, .size = 4 };
    (void)frame;
    vkCmdCopyBuffer(rg_cmd_vulkan(cmd), rg_cmd_buffer(cmd, &draw), rg_cmd_buffer(cmd, &count), 1,
                    &instances);
    rg_cmd_copy_image_to_buffer(cmd, &picture, &pixels, 0);
}

static const struct rg_pass passes[] = {
    { .name = "reset",
      .kind = RG_TRANSFER,
      .uses = RG_USES({ .buffer = &draw, .access = RG_COPY_DST }),
      .record = record_reset },
    { .name = "cull",
      .kind = RG_COMPUTE,
      .uses = RG_USES({ .buffer = &draw, .access = RG_STORAGE_READ_WRITE, .binding = 0 },
                      { .buffer = &visible, .access = RG_STORAGE_WRITE, .binding = 1 }),
      .comp = &cull_comp,
      .push_size = sizeof(struct matrix),
      .record = record_cull },
    { .name = "draw",
      .color = RG_TARGETS({ .image = &picture,
                            .load = RG_LOAD_CLEAR,
                            .clear = { .color = { .float32 = { 0.1f, 0.1f, 0.2f } } } }),
      .depth = { .image = &depth, .load = RG_LOAD_CLEAR, .clear = { .depthStencil = { 1, 0 } } },
      .uses = RG_USES({ .buffer = &draw, .access = RG_INDIRECT },
                      { .buffer = &visible,
                        .access = RG_STORAGE_READ,
                        .binding = 1,
                        .stages = VK_SHADER_STAGE_VERTEX_BIT }),
      .vert = &draw_vert,
      .frag = &draw_frag,
      .push_size = sizeof(struct matrix),
      .record = record_draw },
    { .name = "count",
      .kind = RG_TRANSFER,
      .uses = RG_USES({ .buffer = &draw, .access = RG_COPY_SRC },
                      { .image = &picture, .access = RG_COPY_SRC },
                      { .buffer = &count, .access = RG_COPY_DST },
                      { .buffer = &pixels, .access = RG_COPY_DST }),
      .record = record_count },
};

/* Orbits the camera, and prints the count of the frame that used the slot before. */
static void advance(struct rg_exec *exec, uint32_t slot, struct rg_frame *frame)
{
    const float angle = 0.02f * (float)frame->number;
    const float eye[3] = { 3.0f * sinf(angle), 1, 3.0f * cosf(angle) };
    const struct matrix projection = clip_from_view(0.75f);
    const struct matrix view = view_from_world(eye);
    frame->clip_from_world = multiply(&projection, &view);
    if (frame->number >= SLOT_COUNT)
        printf("frame %u: %u of %u cubes\n", frame->number - SLOT_COUNT,
               *(const uint32_t *)rg_exec_mapped(exec, &count, slot), CUBE_COUNT);
    frame->number++;
}

int main(int argc, char **argv)
{
    const struct rg_technique technique = RG_TECHNIQUE("culling", passes);
    struct rg_frame frame = EXAMPLE_ZERO;
    const struct example example = { &technique, &pixels, { 320, 240 }, &frame,
                                     20,         advance, NULL,         NULL };
    return argc == 2 ? example_run(&example, argv[1]) : 2;
}
