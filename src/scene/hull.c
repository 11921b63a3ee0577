/* hull.c: clips polygons plane by plane (Sutherland and Hodgman 1974). */
#include "src/scene/hull.h"
#include <assert.h>
#include <cglm/struct.h>
#include <math.h>

struct hull hull_of(const struct mesh *mesh)
{
    struct hull hull;
    uint32_t plane = 0;
    for (int i = 0; i < 27; i++) {
        const int x = i % 3 - 1, y = i / 3 % 3 - 1, z = i / 9 - 1;
        const vec3s along = { { (float)x, (float)y, (float)z } };
        float most = -INFINITY;
        if (i == 13) /* the middle */
            continue;
        for (uint32_t v = 0; v < mesh->vertex_count; v++)
            most = fmaxf(most, glms_vec3_dot(mesh->vertices[v].position, along));
        hull.planes[plane++] = glms_vec4(along, most);
    }
    return hull;
}

static float beyond(const vec4s *plane, const struct mesh_vertex *corner)
{
    return glms_vec3_dot(corner->position, glms_vec3(*plane)) - plane->w;
}

/* Returns the point between two corners on the plane, whose signed distances from it, at_a and
 * at_b, have different signs. */
static struct mesh_vertex between(const struct mesh_vertex *a, float at_a,
                                  const struct mesh_vertex *b, float at_b)
{
    const float share = at_a / (at_a - at_b);
    struct mesh_vertex corner = *a;
    corner.position = glms_vec3_lerp(a->position, b->position, share);
    corner.uv = glms_vec2_lerp(a->uv, b->uv, share);
    return corner;
}

static uint32_t cut(const vec4s *plane, const struct mesh_vertex *corners, uint32_t count,
                    struct mesh_vertex *left)
{
    uint32_t left_count = 0;
    for (uint32_t i = 0; i < count; i++) {
        const struct mesh_vertex *a = &corners[i];
        const struct mesh_vertex *b = &corners[(i + 1) % count];
        const float at_a = beyond(plane, a);
        const float at_b = beyond(plane, b);
        if (!(at_a > 0.0f))
            left[left_count++] = *a;
        if ((at_a > 0.0f && at_b < 0.0f) || (at_a < 0.0f && at_b > 0.0f))
            left[left_count++] = between(a, at_a, b, at_b);
    }
    return left_count < 3 ? 0 : left_count;
}

uint32_t hull_cut(const struct hull *hull, struct mesh_vertex *corners, uint32_t count)
{
    struct mesh_vertex left[HULL_CORNER_COUNT];
    assert(count <= 4);
    for (int i = 0; i < HULL_PLANE_COUNT && count > 0; i++) {
        count = cut(&hull->planes[i], corners, count, left);
        for (uint32_t c = 0; c < count; c++)
            corners[c] = left[c];
    }
    return count;
}
