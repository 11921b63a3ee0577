/*
 * painted.h: rows that draw a rectangle each, and the texels expected of them.
 */
#ifndef TESTS_PAINTED_H
#define TESTS_PAINTED_H

#include "tests/gpu/shaders/paint.h"
#include "tests/gpu/test_shaders.h"
#include "tests/support/run_graph.h"

/* A row's rectangle has the row's index. */
struct rg_frame {
    const struct rg_pass *rows;
    const struct paint_push *paints;
    struct rg_mesh mesh;
    VkDescriptorSet set; /* of the test's own */
    bool wanted;         /* whether conditional rows run, */
    uint32_t left_out;   /* but for these of their repetitions, a bit each */
    uint32_t *asked;     /* counts how often they were asked; may be NULL */
};

/* Of four floats a texel: name, then other members. */
#define COLOR_IMAGE(...) \
    { \
        .format = VK_FORMAT_R32G32B32A32_SFLOAT, .name = __VA_ARGS__, \
    }
#define COLOR_BUFFER(title) \
    { \
        .name = (title), .size_per_texel = 4 * sizeof(float), .memory = RG_MEMORY_READBACK \
    }

/* What makes a row draw its rectangle. */
#define PAINTED PAINTED_BY(painted_record, &paint_frag)
#define PAINTED_BY(record_function, fragment_shader) \
    .vert = &paint_vert, .frag = (fragment_shader), .push_size = sizeof(struct paint_push), \
    .record = (record_function)
rg_record_fn painted_record;
rg_record_fn painted_record_number; /* adds the number of the repetition, from 1, to the first
                                       channel; each nearer than the last */
rg_when_fn painted_when;

/* A row's use that such a shader fetches from, and a row that copies an image so. */
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

/* Parts of the target, for a struct paint_push. */
#define ALL       .from = { { -1, -1 } }, .to = { { 1, 1 } }
#define LEFT_HALF .from = { { -1, -1 } }, .to = { { 0, 1 } }
#define TOP_HALF  .from = { { -1, -1 } }, .to = { { 1, 0 } }

/* run_everywhere() for a table of rows; what follows `check` are members of run_params. */
#define PAINTED_EVERYWHERE(state, table, rectangles, check, ...) \
    run_everywhere(*(state), \
                   &(struct run_params){ \
                       .technique = RG_TECHNIQUE("test", table), \
                       __VA_ARGS__, \
                   }, \
                   &(struct rg_frame){ .rows = (table), .paints = (rectangles) }, check)

/* Frames that a graph draws one after another. */
struct painted_series {
    uint32_t count;
    /* What frame `number` is told; its upload buffers may be written now. */
    void (*begin)(struct run *run, uint32_t number, struct rg_frame *frame);
    void (*check)(struct run *run, uint32_t number); /* when it is finished */
};

/* Runs them in memory full of garbage, waiting for a frame only where its slot is wanted again. */
void painted_series(struct gpu *gpu, const struct run_params *params,
                    const struct painted_series *series);

/* The same in the four ways of run_everywhere(). */
void painted_series_everywhere(struct gpu *gpu, const struct run_params *params,
                               const struct painted_series *series);

vec4s painted_color(float r, float g, float b, float a);

/* Texels that were read back, exactly. */
void painted_check(struct run *run, const struct rg_buffer *buffer, uint32_t index, vec4s color);
void painted_check_all(struct run *run, const struct rg_buffer *buffer, uint32_t count,
                       vec4s color);

#endif
