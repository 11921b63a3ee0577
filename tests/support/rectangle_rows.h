/* rectangle_rows.h: passes that draw one rectangle each, and exact comparison of texels. */
#ifndef TESTS_SUPPORT_RECTANGLE_ROWS_H
#define TESTS_SUPPORT_RECTANGLE_ROWS_H

#include "tests/gpu/shaders/paint.h"
#include "tests/gpu/test_shaders.h"
#include "tests/support/run_graph.h"

/* Frame data of these passes: paints[i] is the rectangle of rows[i]. */
struct rg_frame {
    const struct rg_pass *rows;
    const struct paint_push *paints;
    struct rg_mesh mesh;
    VkDescriptorSet set; /* descriptor set for the test's own record functions */
    bool wanted;         /* true if conditional passes run */
    uint32_t left_out;   /* bit mask of repetitions that do not run */
    uint32_t *asked;     /* counts evaluations of conditions; may be NULL */
};

/* An RGBA32F image (name, then other members), and a readback buffer for it. */
#define COLOR_IMAGE(...) \
    { \
        .format = VK_FORMAT_R32G32B32A32_SFLOAT, .name = __VA_ARGS__, \
    }
#define COLOR_BUFFER(title) \
    { \
        .name = (title), .size_per_texel = 4 * sizeof(float), .memory = RG_MEMORY_READBACK \
    }

/* Members of a pass that draws its rectangle. */
#define PAINTED PAINTED_BY(painted_record, &paint_frag)
#define PAINTED_BY(record_function, fragment_shader) \
    .vert = &paint_vert, .frag = (fragment_shader), .push_size = sizeof(struct paint_push), \
    .record = (record_function)
rg_record_fn painted_record;
/* draws each repetition nearer, and adds its number, from 1, to red */
rg_record_fn painted_record_number;
rg_when_fn painted_when;

/* The source image of fetch.frag, and a pass that copies an image with this shader. */
#define PAINTED_SOURCE(from) \
    { \
        .image = &(from), .access = RG_SAMPLED, .binding = PAINT_SOURCE \
    }
#define PAINTED_FETCH(title, from, to) \
    { \
        .name = (title), .color = RG_TARGETS({ &(to), RG_LOAD_DISCARD }), \
        .uses = RG_USES(PAINTED_SOURCE(from)), PAINTED_BY(painted_record, &fetch_frag), \
    }

void painted_draw(struct rg_cmd *cmd, const struct paint_push *paint);

/* Members of a struct paint_push that cover all or half of the target. */
#define ALL       .from = { { -1, -1 } }, .to = { { 1, 1 } }
#define LEFT_HALF .from = { { -1, -1 } }, .to = { { 0, 1 } }
#define TOP_HALF  .from = { { -1, -1 } }, .to = { { 1, 0 } }

/* Calls run_variants() for an array of passes; members of run_params may follow `check`. */
#define PAINTED_VARIANTS(state, table, rectangles, check, ...) \
    run_variants(*(state), \
                 &(struct run_params){ \
                     .technique = RG_TECHNIQUE("test", table), \
                     __VA_ARGS__, \
                 }, \
                 &(struct rg_frame){ .rows = (table), .paints = (rectangles) }, check)

/* A sequence of frames drawn with one graph. */
struct painted_series {
    uint32_t count;
    /* Sets up frame `number`; its upload buffers may be written in this call. */
    void (*begin)(struct run *run, uint32_t number, struct rg_frame *frame);
    void (*check)(struct run *run, uint32_t number); /* called when the frame is complete */
};

/* Runs the frames in garbage-filled memory; waits for a frame only when its slot is reused. */
void painted_series(struct gpu *gpu, const struct run_params *params,
                    const struct painted_series *series);

/* Runs painted_series() in each of the four variants of run_variants(). */
void painted_series_variants(struct gpu *gpu, const struct run_params *params,
                             const struct painted_series *series);

vec4s painted_color(float r, float g, float b, float a);

/* Fail unless the texels read back are exactly equal to `color`. */
void painted_check(struct run *run, const struct rg_buffer *buffer, uint32_t index, vec4s color);
void painted_check_all(struct run *run, const struct rg_buffer *buffer, uint32_t count,
                       vec4s color);

#endif
