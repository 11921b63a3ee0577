/* kdop.c: k-DOP construction, and polygon clipping plane by plane (Sutherland and Hodgman 1974). */
#include "src/scene/geometry/kdop.h"
#include <assert.h>
#include <cglm/struct.h>
#include <math.h>

struct kdop kdop_of(const struct mesh *mesh)
{
    struct kdop kdop;
    uint32_t plane = 0;
    for (int i = 0; i < 27; i++) {
        const int x = i % 3 - 1, y = i / 3 % 3 - 1, z = i / 9 - 1;
        const vec3s dir = { { (float)x, (float)y, (float)z } };
        float most = -INFINITY;
        if (i == 13) /* skips the zero vector */
            continue;
        for (uint32_t v = 0; v < mesh->vertex_count; v++)
            most = fmaxf(most, glms_vec3_dot(mesh->vertices[v].position, dir));
        kdop.planes[plane++] = glms_vec4(dir, most);
    }
    return kdop;
}

static float distance(const vec4s *plane, const struct mesh_vertex *corner)
{
    return glms_vec3_dot(corner->position, glms_vec3(*plane)) - plane->w;
}

/* Returns the vertex where the edge from a to b crosses the plane. `at_a` and `at_b` are the signed
 * distances of a and b from the plane, with opposite signs. */
static struct mesh_vertex edge_point(const struct mesh_vertex *a, float at_a,
                                     const struct mesh_vertex *b, float at_b)
{
    const float t = at_a / (at_a - at_b);
    struct mesh_vertex corner = *a;
    corner.position = glms_vec3_lerp(a->position, b->position, t);
    corner.uv = glms_vec2_lerp(a->uv, b->uv, t);
    return corner;
}

static uint32_t clip_plane(const vec4s *plane, const struct mesh_vertex *corners, uint32_t count,
                           struct mesh_vertex *clipped)
{
    uint32_t clipped_count = 0;
    for (uint32_t i = 0; i < count; i++) {
        const struct mesh_vertex *a = &corners[i];
        const struct mesh_vertex *b = &corners[(i + 1) % count];
        const float at_a = distance(plane, a);
        const float at_b = distance(plane, b);
        if (!(at_a > 0.0f))
            clipped[clipped_count++] = *a;
        if ((at_a > 0.0f && at_b < 0.0f) || (at_a < 0.0f && at_b > 0.0f))
            clipped[clipped_count++] = edge_point(a, at_a, b, at_b);
    }
    return clipped_count < 3 ? 0 : clipped_count;
}

uint32_t kdop_clip(const struct kdop *kdop, struct mesh_vertex *corners, uint32_t count)
{
    struct mesh_vertex clipped[KDOP_CORNER_COUNT];
    assert(count <= 4);
    for (int i = 0; i < KDOP_PLANE_COUNT && count > 0; i++) {
        count = clip_plane(&kdop->planes[i], corners, count, clipped);
        for (uint32_t c = 0; c < count; c++)
            corners[c] = clipped[c];
    }
    return count;
}
