/* fold.c: counts the triangles on lines through a mesh. */
#include "src/scene/fold.h"
#include <cglm/struct.h>

enum {
    SIDE = 48 /* lines along each side of a rectangle */
};

/* Lines along one of the directions below, across the other two. */
struct grid {
    vec3s across[2];
    vec2s first; /* corner of the rectangle around the mesh, in these directions */
    vec2s step;  /* between lines */
    unsigned char met[SIDE * SIDE]; /* triangles on each line, 255 at most */
};

/* Perpendicular to each other, and oblique to the sides of what people make: lines along a flat
 * side that is a little uneven would meet it many times. */
static const vec3s directions[3] = {
    { { 2.0f / 7.0f, 3.0f / 7.0f, 6.0f / 7.0f } },
    { { 3.0f / 7.0f, -6.0f / 7.0f, 2.0f / 7.0f } },
    { { 6.0f / 7.0f, 2.0f / 7.0f, -3.0f / 7.0f } },
};

static vec2s place(const struct grid *grid, vec3s point)
{
    const vec2s at = { { glms_vec3_dot(grid->across[0], point),
                         glms_vec3_dot(grid->across[1], point) } };
    return at;
}

static void spread(struct grid *grid, const struct mesh *mesh)
{
    vec2s low = { { INFINITY, INFINITY } }, high = { { -INFINITY, -INFINITY } };
    for (uint32_t i = 0; i < mesh->index_count; i++) {
        const vec2s at = place(grid, mesh->vertices[mesh->indices[i]].position);
        low = glms_vec2_minv(low, at);
        high = glms_vec2_maxv(high, at);
    }
    grid->first = low;
    grid->step = glms_vec2_divs(glms_vec2_sub(high, low), (float)SIDE);
}

/* Returns twice the area of a triangle, below 0 if its corners are clockwise. */
static float area(vec2s a, vec2s b, vec2s c)
{
    return glms_vec2_cross(glms_vec2_sub(b, a), glms_vec2_sub(c, a));
}

static void meet(struct grid *grid, const vec2s *corners)
{
    const float whole = area(corners[0], corners[1], corners[2]);
    const vec2s low = glms_vec2_minv(glms_vec2_minv(corners[0], corners[1]), corners[2]);
    const vec2s high = glms_vec2_maxv(glms_vec2_maxv(corners[0], corners[1]), corners[2]);
    const vec2s from = glms_vec2_div(glms_vec2_sub(low, grid->first), grid->step);
    const vec2s to = glms_vec2_div(glms_vec2_sub(high, grid->first), grid->step);
    for (int y = (int)from.y; y <= (int)to.y && y < SIDE; y++) {
        for (int x = (int)from.x; x <= (int)to.x && x < SIDE; x++) {
            const vec2s middle = { { (float)x + 0.5f, (float)y + 0.5f } };
            const vec2s at = glms_vec2_add(grid->first, glms_vec2_mul(middle, grid->step));
            unsigned char *met = &grid->met[y * SIDE + x];
            const bool is_met = area(at, corners[0], corners[1]) * whole > 0.0f &&
                                area(at, corners[1], corners[2]) * whole > 0.0f &&
                                area(at, corners[2], corners[0]) * whole > 0.0f;
            if (is_met && *met < 255)
                (*met)++;
        }
    }
}

/* Adds the lines that meet any triangle, and those that meet more than two. */
static void count(struct grid *grid, const struct mesh *mesh, uint32_t counts[2])
{
    spread(grid, mesh);
    if (!(grid->step.x > 0.0f && grid->step.y > 0.0f))
        return;
    for (uint32_t i = 0; i + 2 < mesh->index_count; i += 3) {
        vec2s corners[3];
        for (uint32_t k = 0; k < 3; k++)
            corners[k] = place(grid, mesh->vertices[mesh->indices[i + k]].position);
        meet(grid, corners);
    }
    for (int i = 0; i < SIDE * SIDE; i++) {
        counts[0] += grid->met[i] > 0;
        counts[1] += grid->met[i] > 2;
    }
}

float mesh_fold(const struct mesh *mesh)
{
    uint32_t counts[2] = { 0, 0 };
    for (int i = 0; i < 3; i++) {
        struct grid grid = { .across = { directions[(i + 1) % 3], directions[(i + 2) % 3] } };
        count(&grid, mesh, counts);
    }
    return counts[0] ? (float)counts[1] / (float)counts[0] : 0.0f;
}
