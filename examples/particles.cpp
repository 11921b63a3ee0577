// particles.cpp: particle fountain simulated and drawn by the GPU alone (C++20). The CPU never
// reads the number of live particles, which controls an indirect draw. Usage: particles PICTURE.ppm
#include "example.h"

#include "particles.frag.h"
#include "particles.vert.h"
#include "particles_move.comp.h"
#include "particles_reset.comp.h"

struct rg_frame {
    float time; // seconds
};

static const uint32_t count = 4096;

static const rg_image picture = { .name = "picture", .format = VK_FORMAT_R8G8B8A8_UNORM };
static const rg_buffer particles = { .name = "particles", .size = count * 32, .persistent = true };
static const rg_buffer alive = { .name = "alive", .size = count * 4 };
static const rg_buffer draw = { .name = "draw", .size = sizeof(VkDrawIndirectCommand) };
static const rg_buffer pixels = { .name = "pixels",
                                  .size_per_texel = 4,
                                  .memory = RG_MEMORY_READBACK };

static const rg_shader reset_comp = EXAMPLE_SHADER("particles_reset.comp", particles_reset_comp);
static const rg_shader move_comp = EXAMPLE_SHADER("particles_move.comp", particles_move_comp);
static const rg_shader draw_vert = EXAMPLE_SHADER("particles.vert", particles_vert);
static const rg_shader draw_frag = EXAMPLE_SHADER("particles.frag", particles_frag);

static void record_reset(rg_cmd *cmd, const rg_frame *)
{
    rg_cmd_dispatch(cmd, 1, 1, 1);
}

static void record_move(rg_cmd *cmd, const rg_frame *frame)
{
    rg_cmd_push(cmd, &frame->time, sizeof(frame->time));
    rg_cmd_dispatch(cmd, count / 64, 1, 1);
}

static void record_draw(rg_cmd *cmd, const rg_frame *)
{
    rg_cmd_draw_indirect(cmd, &draw, 0);
}

static void record_copy(rg_cmd *cmd, const rg_frame *)
{
    rg_cmd_copy_image_to_buffer(cmd, &picture, &pixels, 0);
}

static const rg_pass passes[] = {
    { .name = "reset",
      .kind = RG_COMPUTE,
      .uses = RG_USES({ .buffer = &draw, .access = RG_STORAGE_WRITE, .binding = 2 }),
      .comp = &reset_comp,
      .record = record_reset },
    { .name = "move",
      .kind = RG_COMPUTE,
      .uses = RG_USES({ .buffer = &particles, .access = RG_STORAGE_READ_WRITE, .binding = 0 },
                      { .buffer = &alive, .access = RG_STORAGE_WRITE, .binding = 1 },
                      { .buffer = &draw, .access = RG_STORAGE_READ_WRITE, .binding = 2 }),
      .comp = &move_comp,
      .push_size = sizeof(float),
      .record = record_move },
    { .name = "draw",
      .color = RG_TARGETS({ .image = &picture, .load = RG_LOAD_CLEAR, .blend = RG_BLEND_ADD }),
      .uses = RG_USES({ .buffer = &particles,
                        .access = RG_STORAGE_READ,
                        .binding = 0,
                        .stages = VK_SHADER_STAGE_VERTEX_BIT },
                      { .buffer = &alive,
                        .access = RG_STORAGE_READ,
                        .binding = 1,
                        .stages = VK_SHADER_STAGE_VERTEX_BIT },
                      { .buffer = &draw, .access = RG_INDIRECT }),
      .vert = &draw_vert,
      .frag = &draw_frag,
      .record = record_draw },
    { .name = "copy",
      .kind = RG_TRANSFER,
      .uses = RG_USES({ .image = &picture, .access = RG_COPY_SRC },
                      { .buffer = &pixels, .access = RG_COPY_DST }),
      .record = record_copy },
};

static void advance(rg_exec *, uint32_t, rg_frame *frame)
{
    frame->time += 1.0f / 60.0f;
}

int main(int argc, char **argv)
{
    const rg_technique technique = RG_TECHNIQUE("particles", passes);
    rg_frame frame = {};
    const example example = { &technique, &pixels, { 320, 240 }, &frame, 120, advance };
    return argc == 2 ? example_run(&example, argv[1]) : 2;
}
