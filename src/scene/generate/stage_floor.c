/* stage_floor.c: generates a round floor whose colour fades into that of the horizon. */
#include <cglm/struct.h>
#include <math.h>
#include "src/scene/generate/generate.h"

/* Radii of the floor, in radii of the object. The colour fades between the first two. Rings grow
 * evenly up to the edge, because colours of long triangles are interpolated in visible steps. */
#define FADE_START 1.5f
#define FADE_END   8.0f
#define EDGE       300.0f

enum {
    SIDES = GENERATE_STAGE_SIDES,
    RINGS = GENERATE_STAGE_RINGS,
    FAR_RINGS = 8,                      /* from FADE_END to EDGE */
    FADE_RINGS = RINGS - 1 - FAR_RINGS, /* from FADE_START to FADE_END */
};

/* Returns the inner radius of a ring. */
static float inner_radius(uint32_t ring)
{
    if (ring == 0)
        return 0.0f;
    const float t = (float)(ring - 1);
    return t < FADE_RINGS ? FADE_START * powf(FADE_END / FADE_START, t / FADE_RINGS)
                          : FADE_END * powf(EDGE / FADE_END, (t - FADE_RINGS) / FAR_RINGS);
}

/* Returns the fraction of the horizon's colour at a radius. */
static float fade(float radius)
{
    const float t = logf(fmaxf(radius, FADE_START) / FADE_START) / logf(FADE_END / FADE_START);
    const float x = fminf(t, 1.0f);
    return x * x * (3.0f - 2.0f * x);
}

float generate_stage_fade(uint32_t ring)
{
    return 0.5f * (fade(inner_radius(ring)) + fade(inner_radius(ring + 1)));
}

static struct mesh_vertex vertex_at(const struct generate_stage *stage, float radius, uint32_t side)
{
    const float angle = 6.28318531f * (float)side / SIDES;
    const vec3s offset = { { sinf(angle) * radius, 0.0f, -cosf(angle) * radius } };
    return (struct mesh_vertex){
        .position = glms_vec3_add(stage->foot, glms_vec3_scale(offset, stage->radius)),
        .normal = { { 0.0f, 1.0f, 0.0f } },
        .color = glms_vec3_lerp(stage->near_color, stage->far_colors[side], fade(radius)),
        .uv = { { stage->uv_scale * offset.x, stage->uv_scale * offset.z } },
    };
}

static void add_triangle(struct mesh *mesh, uint32_t a, uint32_t b, uint32_t c)
{
    mesh->indices[mesh->index_count++] = a;
    mesh->indices[mesh->index_count++] = b;
    mesh->indices[mesh->index_count++] = c;
}

/* Adds the polygon of a circle's vertices. Its triangles are as large as possible: those of a fan
 * would be thin and share a point below the object, where rays would be slow. */
static void add_disc(struct mesh *mesh, uint32_t first)
{
    for (uint32_t step = 1; step < SIDES / 2; step *= 2) {
        for (uint32_t i = 0; i < SIDES; i += 2 * step)
            add_triangle(mesh, first + i, first + (i + 2 * step) % SIDES, first + i + step);
    }
}

/* Adds a ring between two circles of vertices. */
static void add_ring(struct mesh *mesh, const struct generate_stage *stage, uint32_t ring)
{
    const uint32_t inner = 2 * SIDES * ring, outer = inner + SIDES;
    for (uint32_t i = 0; i < 2 * SIDES; i++) {
        struct mesh_vertex *vertex = &mesh->vertices[inner + i];
        *vertex = vertex_at(stage, inner_radius(ring + i / SIDES), i % SIDES);
        vertex->material = (ring + 1) << MESH_SURFACE_SHIFT;
    }
    for (uint32_t side = 0; side < SIDES && ring; side++) {
        const uint32_t next = (side + 1) % SIDES;
        add_triangle(mesh, inner + side, outer + next, outer + side);
        add_triangle(mesh, inner + side, inner + next, outer + next);
    }
    if (!ring)
        add_disc(mesh, outer);
}

bool generate_stage(struct mesh *mesh, const struct generate_stage *stage)
{
    if (!mesh_init(mesh, 2 * RINGS * SIDES, 6 * SIDES * RINGS))
        return false;
    mesh->index_count = 0; /* grows as rings are added */
    for (uint32_t ring = 0; ring < RINGS; ring++)
        add_ring(mesh, stage, ring);
    return true;
}
