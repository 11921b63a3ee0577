/* synthetic_frame.c: graphs shaped like real frames. */
#include <assert.h>
#include <stdio.h>
#include <stdlib.h>
#include "tests/bench/graph/synthetic.h"

enum {
    ROUND_PASSES = 9, /* of a round, and with the faces of a cube: */
    CUBE_FACES = 6,
    WIDTH = 1920,
    HEIGHT = 1080,
    SHADOW_SIZE = 2048,
    CUBE_SIZE = 256,
};

struct maker {
    struct synthetic *graph;
    uint32_t pass_count; /* so far */
    uint32_t picture;    /* of the round before; SYNTHETIC_NONE: there is none */
};

static uint32_t add_image(struct maker *m, uint32_t width, uint32_t height, uint32_t texel_size)
{
    uint32_t index = m->graph->image_count++;
    struct synthetic_image *image = &m->graph->images[index];
    *image = (struct synthetic_image){ .width = width, .height = height, .texel_size = texel_size };
    image->size = (uint64_t)width * height * texel_size;
    snprintf(image->name, sizeof(image->name), index ? "r%u" : "shown", index);
    return index;
}

static uint32_t add_depth(struct maker *m, uint32_t width, uint32_t height)
{
    uint32_t index = add_image(m, width, height, 4);
    m->graph->images[index].depth = true;
    return index;
}

/* A raster pass without targets so far. */
static struct synthetic_pass *add_pass(struct maker *m)
{
    struct synthetic_pass *pass = &m->graph->passes[m->pass_count];
    *pass = (struct synthetic_pass){ .live = true, .raster = true };
    snprintf(pass->name, sizeof(pass->name), "p%u", m->pass_count++);
    return pass;
}

static void reads(struct synthetic_pass *pass, uint32_t image)
{
    if (image != SYNTHETIC_NONE)
        pass->reads[pass->read_count++] = image;
}

static void writes(struct synthetic_pass *pass, uint32_t image)
{
    pass->writes[pass->write_count++] = image;
}

static void writes_depth(struct synthetic_pass *pass, uint32_t image)
{
    writes(pass, image);
    pass->has_depth = true;
}

/* A pass that draws one image from others; returns it. */
static uint32_t add_effect(struct maker *m, uint32_t divisor, uint32_t from, uint32_t also)
{
    struct synthetic_pass *pass = add_pass(m);
    uint32_t to = add_image(m, WIDTH / divisor, HEIGHT / divisor, 8);
    reads(pass, from);
    reads(pass, also);
    writes(pass, to);
    return to;
}

static uint32_t add_shadow(struct maker *m)
{
    uint32_t shadow = add_depth(m, SHADOW_SIZE, SHADOW_SIZE);
    writes_depth(add_pass(m), shadow);
    return shadow;
}

static uint32_t add_cube(struct maker *m)
{
    uint32_t cube = add_image(m, CUBE_SIZE, CUBE_SIZE, 8);
    uint32_t depth = add_depth(m, CUBE_SIZE, CUBE_SIZE);
    m->graph->images[cube].cube = true;
    m->graph->images[cube].size *= CUBE_FACES;
    for (uint32_t face = 0; face < CUBE_FACES; face++) {
        struct synthetic_pass *pass = add_pass(m);
        pass->repetition = face;
        writes(pass, cube);
        writes_depth(pass, depth);
    }
    return cube;
}

static void add_round(struct maker *m, bool with_cube)
{
    uint32_t shadow = add_shadow(m);
    uint32_t cube = with_cube ? add_cube(m) : SYNTHETIC_NONE;
    uint32_t depth = add_depth(m, WIDTH, HEIGHT);
    uint32_t colors[] = { add_image(m, WIDTH, HEIGHT, 4), add_image(m, WIDTH, HEIGHT, 8),
                          add_image(m, WIDTH, HEIGHT, 4) };
    uint32_t lit = add_image(m, WIDTH, HEIGHT, 8);
    for (uint32_t draw = 0; draw < 2; draw++) {
        struct synthetic_pass *pass = add_pass(m);
        pass->keeps = pass->conditional = draw;
        if (!draw)
            reads(pass, m->picture);
        for (uint32_t i = 0; i < 3; i++)
            writes(pass, colors[i]);
        writes_depth(pass, depth);
    }
    struct synthetic_pass *light = add_pass(m);
    for (uint32_t i = 0; i < 3; i++)
        reads(light, colors[i]);
    reads(light, shadow);
    reads(light, cube);
    writes(light, lit);
    struct synthetic_pass *transparent = add_pass(m);
    transparent->keeps = transparent->conditional = transparent->tests_depth = true;
    reads(transparent, cube);
    reads(transparent, depth);
    writes(transparent, lit);
    uint32_t half = add_effect(m, 2, lit, SYNTHETIC_NONE);
    uint32_t quarter = add_effect(m, 4, half, SYNTHETIC_NONE);
    add_effect(m, 1, lit, depth);
    m->graph->passes[m->pass_count - 1].live = false; /* for debugging: nothing reads it */
    m->picture = add_effect(m, 1, lit, quarter);
}

bool synthetic_frame_init(struct synthetic *graph, uint32_t pass_count)
{
    assert(pass_count);
    *graph = (struct synthetic){
        .pass_count = pass_count,
        .passes = calloc(pass_count, sizeof(*graph->passes)),
        .images = calloc((size_t)pass_count * SYNTHETIC_MAX_WRITES + 1, sizeof(*graph->images)),
    };
    struct maker m = { .graph = graph, .picture = SYNTHETIC_NONE };
    if (!graph->passes || !graph->images) {
        synthetic_finish(graph);
        return false;
    }
    add_image(&m, WIDTH, HEIGHT, 4); /* shown */
    for (uint32_t left = pass_count - 1; left >= ROUND_PASSES; left = pass_count - 1 - m.pass_count)
        add_round(&m, left >= ROUND_PASSES + CUBE_FACES);
    while (m.pass_count + 1 < pass_count)
        m.picture = add_effect(&m, 1, m.picture, SYNTHETIC_NONE);
    struct synthetic_pass *present = add_pass(&m);
    reads(present, m.picture);
    writes(present, 0);
    for (uint32_t i = 0; i < pass_count; i++) {
        graph->access_count += graph->passes[i].read_count + graph->passes[i].write_count;
        graph->live_count += graph->passes[i].live;
    }
    return true;
}
