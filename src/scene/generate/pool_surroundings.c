/* pool_surroundings.c: generates a pool's dry walls, coping and paving, and floating ice. */
#include "shaders/water/water.h"
#include "src/scene/generate/generate.h"

#include <cglm/struct.h>

static const vec3s stone = { { POOL_STONE } };
static const vec3s paving = { { 0.400F, 0.385F, 0.360F } };
static const float coping = 0.3F;      /* width of the coping, metres */
static const float submerged = 0.917F; /* submerged fraction of floating ice (density ratio) */
static const float paved = 2000;       /* half width of the paving, metres */

/* Adds a quad with corners in counter-clockwise order around its normal. */
static void add_quad(struct mesh *mesh, uint32_t *count, const vec3s corners[4], vec3s color)
{
    static const uint32_t order[6] = { 0, 1, 2, 0, 2, 3 };
    const uint32_t first = 4 * *count;
    const vec3s normal = glms_vec3_crossn(glms_vec3_sub(corners[1], corners[0]),
                                          glms_vec3_sub(corners[2], corners[0]));
    for (uint32_t i = 0; i < 4; i++)
        mesh->vertices[first + i] = (struct mesh_vertex){
            .position = corners[i],
            .normal = normal,
            .color = color,
        };
    for (uint32_t i = 0; i < 6; i++)
        mesh->indices[6 * *count + i] = first + order[i];
    ++*count;
}

/* Returns (x, height, y) rotated by quarter turns about the vertical axis. */
static vec3s rotated(uint32_t quarters, float x, float height, float y)
{
    const vec3s at[4] = {
        { { x, height, y } },
        { { y, height, -x } },
        { { -x, height, -y } },
        { { -y, height, x } },
    };
    return at[quarters];
}

/* Adds a horizontal frame between two concentric squares with these half widths. */
static void add_frame(struct mesh *mesh, uint32_t *count, float inner, float outer, vec3s color)
{
    for (uint32_t q = 0; q < 4; q++) {
        const vec3s corners[4] = {
            rotated(q, -inner, POOL_RIM, inner),
            rotated(q, -outer, POOL_RIM, outer),
            rotated(q, outer, POOL_RIM, outer),
            rotated(q, inner, POOL_RIM, inner),
        };
        add_quad(mesh, count, corners, color);
    }
}

static void add_walls(struct mesh *mesh, uint32_t *count, float half, float depth)
{
    for (uint32_t q = 0; q < 4; q++) {
        const vec3s corners[4] = {
            rotated(q, -half, POOL_RIM, half),
            rotated(q, half, POOL_RIM, half),
            rotated(q, half, -depth, half),
            rotated(q, -half, -depth, half),
        };
        add_quad(mesh, count, corners, stone);
    }
}

bool generate_pool(struct mesh *mesh, const struct generate_pool *pool)
{
    const float half = 0.5F * pool->size;
    uint32_t count = 0;
    if (!mesh_init(mesh, 12 * 4, 12 * 6))
        return false;
    add_walls(mesh, &count, half, pool->depth);
    add_frame(mesh, &count, half, half + coping, stone);
    add_frame(mesh, &count, half + coping, paved, paving);
    return true;
}

bool generate_floating_ice(struct mesh *mesh, const struct generate_pool *pool, uint32_t triangles)
{
    if (!generate_ice_cube(mesh, triangles))
        return false;
    mesh_fit(mesh, pool->ice);
    const struct box box = mesh_box(mesh);
    const float height = box.max.y - box.min.y;
    for (uint32_t i = 0; i < mesh->vertex_count; i++)
        mesh->vertices[i].position.y -= box.min.y + submerged * height;
    return true;
}
