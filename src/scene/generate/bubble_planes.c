/* bubble_planes.c: generates planes of air bubbles inside ice, and their textures. */
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>
#include "src/scene/generate/generate.h"
#include "src/scene/generate/noise.h"
#include "src/scene/generate/random.h"
#include "src/scene/geometry/kdop.h"
#include "src/scene/mip_levels.h"

enum {
    LAYER_SIZE = GENERATE_AIR_LAYER_SIZE,
    LAYER_COUNT = GENERATE_AIR_LAYER_COUNT,
    OCTAVES = 3,
};

static const float off_center = 0.1f; /* maximum plane offset from the centre, in object radii */

/* Adds the two triangles of a plane. */
static void make_plane(struct mesh *mesh, uint32_t plane, mat3s axes, vec3s center, float side)
{
    static const uint32_t corners[6] = { 0, 1, 2, 2, 1, 3 };
    for (uint32_t i = 0; i < 4; i++) {
        const uint32_t row = i / 2;
        const vec2s uv = { { (float)(i % 2), (float)row } };
        const vec3s at = { { side * (2 * uv.x - 1), side * (2 * uv.y - 1), 0 } };
        mesh->vertices[4 * plane + i] = (struct mesh_vertex){
            .position = glms_vec3_add(center, glms_mat3_mulv(axes, at)),
            .normal = axes.col[2],
            .color = glms_vec3_one(),
            .uv = uv,
            .material = plane % LAYER_COUNT + 1,
        };
    }
    for (uint32_t i = 0; i < 6; i++)
        mesh->indices[6 * plane + i] = 4 * plane + corners[i];
}

bool generate_air_planes(struct mesh *mesh, struct box box, const struct generate_air *air)
{
    const float radius = box_diagonal(box) / 2;
    if (!mesh_init(mesh, 4 * air->count, 6 * air->count))
        return false;
    for (uint32_t i = 0; i < air->count; i++) {
        struct random random = random_begin(air->seed, i);
        const mat3s axes = random_rotation(&random);
        const vec3s offset = glms_vec3_scale(random_box(&random), off_center * radius);
        make_plane(mesh, i, axes, glms_vec3_add(box_center(box), offset), radius);
    }
    return true;
}

/* Appends a convex polygon as a triangle fan. */
static void add_polygon(struct mesh *mesh, const struct mesh_vertex *corners, uint32_t count)
{
    for (uint32_t i = 2; i < count; i++) {
        const uint32_t fan[3] = { 0, i - 1, i };
        for (uint32_t k = 0; k < 3; k++)
            mesh->indices[mesh->index_count++] = mesh->vertex_count + fan[k];
    }
    for (uint32_t i = 0; i < count; i++)
        mesh->vertices[mesh->vertex_count++] = corners[i];
}

bool generate_air_clip(struct mesh *planes, const struct mesh *object)
{
    static const uint32_t around[4] = { 0, 1, 3, 2 };
    const struct kdop kdop = kdop_of(object);
    const uint32_t count = planes->vertex_count / 4;
    struct mesh cut;
    if (!mesh_init(&cut, count * KDOP_CORNER_COUNT, count * 3 * (KDOP_CORNER_COUNT - 2)))
        return false;
    cut.vertex_count = cut.index_count = 0;
    for (uint32_t i = 0; i < count; i++) {
        struct mesh_vertex corners[KDOP_CORNER_COUNT];
        for (uint32_t k = 0; k < 4; k++)
            corners[k] = planes->vertices[4 * i + around[k]];
        add_polygon(&cut, corners, kdop_clip(&kdop, corners, 4));
    }
    mesh_finish(planes);
    *planes = cut;
    return true;
}

/* Returns the density of bubbles and haze: 1 in the texture's centre, 0 at its edges. */
static float density(float u, float v)
{
    const float x = 2 * u - 1;
    const float y = 2 * v - 1;
    const float rest = fmaxf(1 - x * x - y * y, 0);
    return rest * rest * rest;
}

/* Draws an antialiased disc that is more opaque towards its rim. */
static void draw_bubble(uint8_t *texels, vec2s center, float radius)
{
    const int left = (int)floorf(center.x - radius - 1);
    const int top = (int)floorf(center.y - radius - 1);
    const int width = (int)ceilf(2 * radius) + 3;
    for (int i = 0; i < width * width; i++) {
        const int x = left + i % width;
        const int y = top + i / width;
        if (x < 0 || y < 0 || x >= LAYER_SIZE || y >= LAYER_SIZE)
            continue;
        const float dx = (float)x + 0.5f - center.x;
        const float dy = (float)y + 0.5f - center.y;
        const float away = sqrtf(dx * dx + dy * dy);
        const float inside = fminf(fmaxf(radius + 0.5f - away, 0), 1);
        const float t = fminf(away / radius, 1);
        const float value = 255 * inside * (0.4f + 0.6f * t * t);
        uint8_t *texel = &texels[2 * ((size_t)y * LAYER_SIZE + (size_t)x)];
        *texel = (uint8_t)fmaxf(*texel, value);
    }
}

/* Draws at most one bubble per grid cell, with a probability equal to the density. */
static void draw_bubbles(uint8_t *texels, float frequency, float size, struct random *random)
{
    const uint32_t across = (uint32_t)ceilf(frequency);
    for (uint32_t i = 0; i < across * across; i++) {
        const uint32_t row = i / across;
        const float u = ((float)(i % across) + random_unit(random)) / frequency;
        const float v = ((float)row + random_unit(random)) / frequency;
        const float chance = random_unit(random);
        const float diameter = size * (0.5f + 0.5f * random_unit(random));
        if (chance < density(u, v))
            draw_bubble(texels, (vec2s){ { u * LAYER_SIZE, v * LAYER_SIZE } },
                        diameter / 2 * LAYER_SIZE);
    }
}

static void draw_haze(uint8_t *texels, uint32_t seed)
{
    struct noise_plane plane;
    noise_plane_init(&plane, 3, seed);
    for (int i = 0; i < LAYER_SIZE * LAYER_SIZE; i++) {
        const int row = i / LAYER_SIZE;
        const float u = ((float)(i % LAYER_SIZE) + 0.5f) / LAYER_SIZE;
        const float v = ((float)row + 0.5f) / LAYER_SIZE;
        const float thin = density(u, v);
        const float noise = thin > 0 ? noise_plane_at(&plane, 6 * u, 6 * v) : 0;
        const float haze = thin * (0.5f + 0.8f * noise);
        texels[2 * i + 1] = (uint8_t)(255 * fminf(fmaxf(haze, 0), 1));
    }
}

bool generate_air_layers(struct air_layers *layers, const struct generate_air *air)
{
    const size_t layer_size = (size_t)LAYER_SIZE * LAYER_SIZE * 2;
    const struct mip_levels mip_levels = { .side = LAYER_SIZE,
                                           .layers = LAYER_COUNT,
                                           .channels = 2 };
    *layers = (struct air_layers){ .texels = calloc(mip_levels_count(&mip_levels), 1) };
    if (!layers->texels)
        return false;
    layers->size = LAYER_SIZE;
    layers->count = LAYER_COUNT;
    for (uint32_t layer = 0; layer < LAYER_COUNT; layer++) {
        uint8_t *texels = &layers->texels[layer * layer_size];
        struct random random = random_begin(air->seed, GENERATE_AIR_MAX + layer);
        for (size_t i = 0; air->opacity && i < layer_size / 2; i++)
            texels[2 * i] = (uint8_t)(255 * air->opacity[i]);
        for (int octave = 0; octave < OCTAVES && !air->opacity; octave++)
            draw_bubbles(texels, ldexpf(air->frequency, octave), ldexpf(air->size, -octave),
                         &random);
        draw_haze(texels, air->seed * LAYER_COUNT + layer);
    }
    mip_levels_fill_bytes(layers->texels, &mip_levels);
    return true;
}
