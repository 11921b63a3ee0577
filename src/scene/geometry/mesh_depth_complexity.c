/* mesh_depth_complexity.c: measures depth complexity along a grid of parallel lines. */
#include "src/scene/geometry/mesh_depth_complexity.h"
#include <cglm/struct.h>

enum {
    SIDE = 48,               /* lines per side of the grid */
    TESTS_MIN = 1 << 22,     /* lower bound of the limit of tests of a triangle and a line */
    TESTS_PER_TRIANGLE = 16, /* of that limit */
    HITS_MAX = 3,            /* more hits do not change the result */
};

/* Grid of parallel lines along one axis, spread over the other two. */
struct grid {
    vec3s across[2];
    vec2s first; /* minimum corner of the mesh's bounding rectangle in the `across` axes */
    vec2s step;  /* spacing of lines */
    unsigned char hits[SIDE * SIDE]; /* triangles that each line hits, at most HITS_MAX */
    uint64_t tests_left;
};

/* Orthogonal directions, oblique to the faces of man-made objects. A line parallel to a slightly
 * uneven face could hit the face many times. */
static const vec3s directions[3] = {
    { { 2.0f / 7.0f, 3.0f / 7.0f, 6.0f / 7.0f } },
    { { 3.0f / 7.0f, -6.0f / 7.0f, 2.0f / 7.0f } },
    { { 6.0f / 7.0f, 2.0f / 7.0f, -3.0f / 7.0f } },
};

static vec2s project(const struct grid *grid, vec3s point)
{
    const vec2s at = { { glms_vec3_dot(grid->across[0], point),
                         glms_vec3_dot(grid->across[1], point) } };
    return at;
}

static void fit_grid(struct grid *grid, const struct mesh *mesh)
{
    vec2s low = { { INFINITY, INFINITY } }, high = { { -INFINITY, -INFINITY } };
    for (uint32_t i = 0; i < mesh->index_count; i++) {
        const vec2s at = project(grid, mesh->vertices[mesh->indices[i]].position);
        low = glms_vec2_minv(low, at);
        high = glms_vec2_maxv(high, at);
    }
    grid->first = low;
    grid->step = glms_vec2_divs(glms_vec2_sub(high, low), (float)SIDE);
}

/* Returns twice the signed area of a triangle, negative if it is clockwise. */
static float area(vec2s a, vec2s b, vec2s c)
{
    return glms_vec2_cross(glms_vec2_sub(b, a), glms_vec2_sub(c, a));
}

/* Counts the lines that hit a triangle. Leaves it out if the limit of tests does not suffice, which
 * only thousands of triangles as large as the mesh exceed. */
static void rasterise(struct grid *grid, const vec2s *corners)
{
    const float whole = area(corners[0], corners[1], corners[2]);
    const vec2s low = glms_vec2_minv(glms_vec2_minv(corners[0], corners[1]), corners[2]);
    const vec2s high = glms_vec2_maxv(glms_vec2_maxv(corners[0], corners[1]), corners[2]);
    const vec2s from = glms_vec2_div(glms_vec2_sub(low, grid->first), grid->step);
    const vec2s to = glms_vec2_div(glms_vec2_sub(high, grid->first), grid->step);
    const uint64_t columns = (uint64_t)(to.x - from.x) + 2, rows = (uint64_t)(to.y - from.y) + 2;
    if (columns * rows > grid->tests_left)
        return;
    grid->tests_left -= columns * rows;
    for (int y = (int)from.y; y <= (int)to.y && y < SIDE; y++) {
        for (int x = (int)from.x; x <= (int)to.x && x < SIDE; x++) {
            unsigned char *hits = &grid->hits[y * SIDE + x];
            if (*hits == HITS_MAX)
                continue;
            const vec2s center = { { (float)x + 0.5f, (float)y + 0.5f } };
            const vec2s at = glms_vec2_add(grid->first, glms_vec2_mul(center, grid->step));
            const bool is_hit = area(at, corners[0], corners[1]) * whole > 0.0f &&
                                area(at, corners[1], corners[2]) * whole > 0.0f &&
                                area(at, corners[2], corners[0]) * whole > 0.0f;
            *hits = (unsigned char)(*hits + is_hit);
        }
    }
}

/* Adds the number of lines with any hit to counts[0], and with more than two hits to counts[1]. */
static void count_lines(struct grid *grid, const struct mesh *mesh, uint32_t counts[2])
{
    fit_grid(grid, mesh);
    if (!(grid->step.x > 0.0f && grid->step.y > 0.0f))
        return;
    grid->tests_left = TESTS_MIN + (uint64_t)TESTS_PER_TRIANGLE * (mesh->index_count / 3);
    for (uint32_t i = 0; i + 2 < mesh->index_count; i += 3) {
        vec2s corners[3];
        for (uint32_t k = 0; k < 3; k++)
            corners[k] = project(grid, mesh->vertices[mesh->indices[i + k]].position);
        rasterise(grid, corners);
    }
    for (int i = 0; i < SIDE * SIDE; i++) {
        counts[0] += grid->hits[i] > 0;
        counts[1] += grid->hits[i] > 2;
    }
}

float mesh_depth_complexity(const struct mesh *mesh)
{
    uint32_t counts[2] = { 0, 0 };
    for (int i = 0; i < 3; i++) {
        struct grid grid = { .across = { directions[(i + 1) % 3], directions[(i + 2) % 3] } };
        count_lines(&grid, mesh, counts);
    }
    return counts[0] ? (float)counts[1] / (float)counts[0] : 0.0f;
}
