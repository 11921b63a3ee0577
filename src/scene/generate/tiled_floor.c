/* tiled_floor.c: generates a level floor of pale tiles, surrounded by a single-coloured plane. */
#include "src/scene/generate/generate.h"

#include <cglm/struct.h>

enum {
    TILES = 48, /* tiles along each side */
};

static const vec3s pale = { { 0.36F, 0.34F, 0.31F } };
static const vec3s dark = { { 0.25F, 0.24F, 0.23F } };
static const float tile = 0.28F; /* tile width, in diagonals of the object's box */
static const float extent = 100; /* half width of the floor, in diagonals of the object's box */

/* Adds a horizontal rectangle between the corners `from` and (x, z). */
static void add_square(struct mesh *mesh, vec3s from, float x, float z, vec3s color)
{
    static const uint32_t order[6] = { 0, 2, 1, 0, 3, 2 };
    const vec3s corners[4] = {
        from,
        { { x, from.y, from.z } },
        { { x, from.y, z } },
        { { from.x, from.y, z } },
    };
    for (uint32_t i = 0; i < 4; i++)
        mesh->vertices[mesh->vertex_count + i] = (struct mesh_vertex){
            .position = corners[i],
            .normal = { { 0, 1, 0 } },
            .color = color,
        };
    for (uint32_t i = 0; i < 6; i++)
        mesh->indices[mesh->index_count + i] = mesh->vertex_count + order[i];
    mesh->vertex_count += 4;
    mesh->index_count += 6;
}

static void add_tiles(struct mesh *mesh, vec3s corner, float side)
{
    for (uint32_t row = 0; row < TILES; row++) {
        for (uint32_t column = 0; column < TILES; column++) {
            const vec3s from = {
                { corner.x + (float)column * side, corner.y, corner.z + (float)row * side },
            };
            add_square(mesh, from, from.x + side, from.z + side, (row + column) % 2 ? dark : pale);
        }
    }
}

/* Adds four rectangles around the square of tiles, which has the half width `inner`. */
static void add_border(struct mesh *mesh, vec3s center, float inner, float outer)
{
    const float x = center.x;
    const float y = center.y;
    const float z = center.z;
    const vec3s color = glms_vec3_lerp(pale, dark, 0.5F);
    add_square(mesh, (vec3s){ { x - outer, y, z - outer } }, x + outer, z - inner, color);
    add_square(mesh, (vec3s){ { x - outer, y, z + inner } }, x + outer, z + outer, color);
    add_square(mesh, (vec3s){ { x - outer, y, z - inner } }, x - inner, z + inner, color);
    add_square(mesh, (vec3s){ { x + inner, y, z - inner } }, x + outer, z + inner, color);
}

bool generate_floor(struct mesh *mesh, struct box object)
{
    const uint32_t count = TILES * TILES + 4;
    const float diagonal = box_diagonal(object);
    const float side = tile * (diagonal > 0 ? diagonal : 1);
    const float inner = side * TILES / 2;
    vec3s center = box_center(object);
    center.y = object.min.y;
    if (!mesh_init(mesh, 4 * count, 6 * count))
        return false;
    mesh->vertex_count = mesh->index_count = 0; /* grow as tiles are added */
    add_tiles(mesh, (vec3s){ { center.x - inner, center.y, center.z - inner } }, side);
    add_border(mesh, center, inner, extent * side / tile);
    return true;
}
