/* pool_scene.c: triangle meshes and lighting of the pool: water, tiles and floating ice. */
#include "src/lab/reference/pool_scene.h"
#include <cglm/struct.h>
#include <math.h>
#include <string.h>
#include "shaders/water/wave_function.h"
#include "src/tech/frame_media.h"
#include "src/tech/water/pool_parameters.h"

enum {
    SHELL_SIDE = POOL_SCENE_GRID + 3, /* one more ring at the bottom */
    QUAD_COUNT = 5,                   /* tiled floor and four walls */
    WATER = 0,
    FLOATING_ICE = 1,
};

#define SHELL_MARGIN 0.05f /* water overlaps walls, in half sides */
#define TILE_INSET   1e-4f /* tile distance from walls, in sides */

static vec3s to_world(vec3s v)
{
    return (vec3s){ { v.x, v.z, -v.y } };
}

/* Returns a vertex of the water mesh. Border vertices are at the pool bottom to close the sides. */
static struct mesh_vertex shell_vertex(const struct pool_scene *pool_scene, uint32_t column,
                                       uint32_t row, float time)
{
    const struct pool_params *pool = &pool_scene->push.pool;
    const uint32_t x = (uint32_t)glm_clamp((float)column - 1.0f, 0.0f, POOL_SCENE_GRID);
    const uint32_t y = (uint32_t)glm_clamp((float)row - 1.0f, 0.0f, POOL_SCENE_GRID);
    const float half = 0.5f * pool->size * (1.0f + SHELL_MARGIN);
    const vec2s at = { { half * (2.0f * (float)x / POOL_SCENE_GRID - 1.0f),
                         half * (2.0f * (float)y / POOL_SCENE_GRID - 1.0f) } };
    const vec3s wave = wave_at(pool_scene->push.water, at, time);
    const bool is_below = column != x + 1 || row != y + 1;
    const float height = is_below ? -pool->depth * (1.0f + SHELL_MARGIN) : wave.z;
    return (struct mesh_vertex){
        .position = to_world((vec3s){ { at.x, at.y, height } }),
        .normal = to_world(wave_normal(wave)),
        .color = glms_vec3_one(),
    };
}

static void write_quad(uint32_t *indices, uint32_t a, uint32_t b, uint32_t c, uint32_t d)
{
    const uint32_t order[6] = { a, b, c, a, c, d };
    memcpy(indices, order, sizeof(order));
}

static bool build_shell(struct mesh *mesh, const struct pool_scene *pool_scene, float time)
{
    const uint32_t cells = SHELL_SIDE - 1, last = SHELL_SIDE - 1;
    if (!mesh_init(mesh, SHELL_SIDE * SHELL_SIDE, 6 * (cells * cells + 1)))
        return false;
    for (uint32_t i = 0; i < SHELL_SIDE * SHELL_SIDE; i++)
        mesh->vertices[i] = shell_vertex(pool_scene, i % SHELL_SIDE, i / SHELL_SIDE, time);
    for (uint32_t i = 0; i < cells * cells; i++) {
        const uint32_t a = i / cells * SHELL_SIDE + i % cells;
        write_quad(&mesh->indices[(size_t)6 * i], a, a + 1, a + SHELL_SIDE + 1, a + SHELL_SIDE);
    }
    write_quad(&mesh->indices[(size_t)6 * cells * cells], 0, last * SHELL_SIDE,
               SHELL_SIDE * SHELL_SIDE - 1, last);
    return true;
}

/* Appends the mesh of the floating ice, transformed to world space. */
static bool add_floating_ice(struct pool_scene *pool_scene, const struct mesh *ice,
                             mat4s world_from_object)
{
    struct mesh *mesh = &pool_scene->scene.model.object;
    const uint32_t first = mesh->vertex_count;
    pool_scene->objects[FLOATING_ICE].first_index = mesh->index_count;
    pool_scene->objects[FLOATING_ICE].index_count = ice->index_count;
    if (!mesh_append(mesh, ice))
        return false;
    for (uint32_t i = first; i < mesh->vertex_count; i++) {
        struct mesh_vertex *vertex = &mesh->vertices[i];
        vertex->position = glms_mat4_mulv3(world_from_object, vertex->position, 1.0f);
        vertex->normal = glms_mat4_mulv3(world_from_object, vertex->normal, 0.0f);
    }
    return true;
}

/* Adds a quad of tiles. `corners` are in pool coordinates, counter-clockwise. `uvs` are metres. */
static void add_tiles(struct mesh *mesh, const struct pool_scene *pool_scene,
                      const vec3s corners[static 4], const vec2s uvs[static 4])
{
    const vec3s n = glms_vec3_crossn(glms_vec3_sub(corners[1], corners[0]),
                                     glms_vec3_sub(corners[3], corners[0]));
    const uint32_t first = mesh->vertex_count;
    for (uint32_t k = 0; k < 4; k++)
        mesh->vertices[first + k] = (struct mesh_vertex){
            .position = to_world(corners[k]),
            .normal = to_world(n),
            .color = glms_vec3_one(),
            .uv = glms_vec2_divs(uvs[k], pool_scene->push.pool.tile),
            .material = MESH_TILES,
        };
    write_quad(&mesh->indices[mesh->index_count], first, first + 1, first + 2, first + 3);
    mesh->vertex_count += 4;
    mesh->index_count += 6;
}

/* Builds the tiled floor and the four walls, which end at the still water level. */
static bool build_tiles(struct mesh *mesh, const struct pool_scene *pool_scene)
{
    const float s = pool_scene->push.pool.size * (0.5f - TILE_INSET),
                d = -pool_scene->push.pool.depth;
    const vec3s floor_at[4] = {
        { { -s, -s, d } }, { { s, -s, d } }, { { s, s, d } }, { { -s, s, d } }
    };
    vec2s uvs[4];
    if (!mesh_init(mesh, 4 * QUAD_COUNT, 6 * QUAD_COUNT))
        return false;
    mesh->vertex_count = mesh->index_count = 0;
    for (int k = 0; k < 4; k++)
        uvs[k] = (vec2s){ { floor_at[k].x, floor_at[k].y } };
    add_tiles(mesh, pool_scene, floor_at, uvs);
    for (int side = 0; side < 4; side++) {
        const vec3s from = floor_at[(side + 1) % 4], to = floor_at[side];
        const vec3s corners[4] = {
            from, to, { { to.x, to.y, 0.0f } }, { { from.x, from.y, 0.0f } }
        };
        for (int k = 0; k < 4; k++)
            uvs[k] = (vec2s){ { side % 2 ? corners[k].y : corners[k].x, corners[k].z } };
        add_tiles(mesh, pool_scene, corners, uvs);
    }
    return true;
}

bool pool_scene_init(struct pool_scene *pool_scene, const struct scene *scene,
                     const struct settings *settings, const struct globals *globals)
{
    *pool_scene = (struct pool_scene){
        .scene = *scene,
        .bare.flags = MATERIAL_FROM_SETTINGS,
        .push = pool_push_of(settings),
    };
    struct model *model = &pool_scene->scene.model;
    model->object = model->surroundings = (struct mesh){ 0 };
    model->objects = pool_scene->objects;
    model->surroundings_object_count = 0; /* surroundings_objects do not match this mesh */
    model->object_count = scene->model.object.index_count ? 2 : 1;
    if (!model->materials)
        model->materials = &pool_scene->bare;
    pool_scene->scene.has_pool = false;
    bool done = build_shell(&model->object, pool_scene, globals->time) &&
                build_tiles(&model->surroundings, pool_scene) &&
                mesh_append(&model->surroundings, &scene->model.surroundings);
    pool_scene->objects[WATER].index_count = model->object.index_count;
    if (done && model->object_count > 1)
        done = add_floating_ice(pool_scene, &scene->model.object, globals->world_from_object);
    if (!done)
        pool_scene_finish(pool_scene);
    return done;
}

void pool_scene_finish(struct pool_scene *pool_scene)
{
    mesh_finish(&pool_scene->scene.model.object);
    mesh_finish(&pool_scene->scene.model.surroundings);
    *pool_scene = (struct pool_scene){ 0 };
}

void pool_scene_set_media(const struct pool_scene *pool_scene, const struct scene *scene,
                          const struct settings *settings, struct nested_media *media)
{
    const struct water_params *w = &pool_scene->push.water;
    const struct frame_medium outside =
        frame_medium_at(scene, settings, frame_media_count(scene) - 1);
    struct frame_medium *water = &media->all[WATER];
    *water = (struct frame_medium){
        .absorption = { { w->red, w->green, w->blue } },
        .tint = glms_vec3_one(),
        .rank = 1,
    };
    for (int c = 0; c < 3; c++)
        water->ior[c] = w->ior * outside.ior[c];
    media->is_dispersive = false;
    if (pool_scene->scene.model.object_count > 1) {
        media->all[FLOATING_ICE] = frame_medium_at(scene, settings, 0);
        media->all[FLOATING_ICE].rank = 2;
        media->is_dispersive = media->all[FLOATING_ICE].ior[0] < media->all[FLOATING_ICE].ior[2];
    }
    media->all[media->outside] = media->all[media->bubble] = outside;
    media->all[media->bubble].rank = UINT32_MAX;
}

vec3s pool_scene_transmittance(const struct pool_scene *pool_scene, float path)
{
    const struct water_params *w = &pool_scene->push.water;
    return (vec3s){ { expf(-w->red * path), expf(-w->green * path), expf(-w->blue * path) } };
}

struct radiance_sun pool_scene_light(const struct pool_scene *pool_scene,
                                     const struct globals *globals, vec3s point, vec3s n)
{
    const float half = 0.5f * pool_scene->push.pool.size;
    const float depth = fmaxf(-point.y, 0.0f);
    struct radiance_sun light = { .sky = pool_scene_transmittance(pool_scene, depth) };
    if (!(globals->sun_dir.y > 0.0f))
        return light;
    /* Snell's law at a horizontal surface divides horizontal direction components by the index. */
    const float inverse_index = 1.0f / pool_scene->push.water.ior;
    const vec3s horizontal = { { globals->sun_dir.x * inverse_index, 0.0f,
                                 globals->sun_dir.z * inverse_index } };
    const float down = sqrtf(fmaxf(1.0f - glms_vec3_norm2(horizontal), 0.0f));
    const vec3s inside = { { horizontal.x, down, horizontal.z } };
    const float ci = globals->sun_dir.y, eta = inverse_index;
    const float rs = (eta * ci - down) / (eta * ci + down);
    const float rp = (ci - eta * down) / (ci + eta * down);
    const float transmittance = 1.0f - 0.5f * (rs * rs + rp * rp);
    const vec3s entry = glms_vec3_muladds(inside, depth / down, point);
    const bool is_open = fmaxf(fabsf(entry.x), fabsf(entry.z)) <= half;
    const float incidence = fmaxf(glms_vec3_dot(n, inside) / down, 0.0f);
    if (is_open)
        light.refracted = glms_vec3_scale(pool_scene_transmittance(pool_scene, depth / down),
                                          transmittance * ci * incidence);
    light.refracted_dir = inside;
    return light;
}
