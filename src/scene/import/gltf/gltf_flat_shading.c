/* gltf_flat_shading.c: flat normals of primitives without the attribute NORMAL (glTF 2.0,
 * 3.7.2.1). */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/scene/import/gltf/gltf.h"

/* Replaces the values of vertices by those of corners. Returns false when out of memory. */
static bool split_values(float **values, size_t width, const struct gltf_primitive *primitive)
{
    if (!*values)
        return true;
    float *split = malloc(primitive->index_count * width * sizeof(*split));
    for (size_t i = 0; split && i < primitive->index_count; i++)
        memcpy(&split[width * i], &(*values)[width * primitive->indices[i]],
               width * sizeof(*split));
    if (!split)
        return false;
    free(*values);
    *values = split;
    return true;
}

bool gltf_split_corners(struct gltf_primitive *primitive)
{
    bool done = split_values(&primitive->positions, 3, primitive) &&
                split_values(&primitive->colors, 4, primitive) &&
                split_values(&primitive->uvs, 2, primitive) &&
                split_values(&primitive->other_uvs, 2, primitive) &&
                split_values(&primitive->joints, 4, primitive) &&
                split_values(&primitive->weights, 4, primitive);
    for (uint32_t i = 0; done && i < primitive->target_count; i++) {
        done = split_values(&primitive->targets[i].positions, 3, primitive);
        free(primitive->targets[i].normals);
        primitive->targets[i].normals = NULL;
    }
    free(primitive->tangents);
    primitive->tangents = NULL;
    for (uint32_t i = 0; done && i < primitive->index_count; i++)
        primitive->indices[i] = i;
    primitive->vertex_count = done ? primitive->index_count : primitive->vertex_count;
    return done;
}

/* Writes the unit normal of a triangle to its three corners; 0 if the triangle has no area. */
static void write_normal(const float *corners, float *normals)
{
    double sides[2][3], normal[3], sum = 0;
    for (size_t k = 0; k < 3; k++) {
        sides[0][k] = (double)corners[3 + k] - (double)corners[k];
        sides[1][k] = (double)corners[6 + k] - (double)corners[k];
    }
    for (size_t k = 0; k < 3; k++) {
        const size_t u = (k + 1) % 3, v = (k + 2) % 3;
        normal[k] = sides[0][u] * sides[1][v] - sides[0][v] * sides[1][u];
        sum += normal[k] * normal[k];
    }
    for (size_t i = 0; i < 9; i++)
        normals[i] = sum > 0 ? (float)(normal[i % 3] / sqrt(sum)) : 0;
}

float *gltf_flat_normals(const float *positions, uint32_t vertex_count)
{
    float *normals = malloc(((size_t)vertex_count + 1) * 3 * sizeof(*normals));
    for (size_t i = 0; normals && i + 2 < vertex_count; i += 3)
        write_normal(&positions[3 * i], &normals[3 * i]);
    return normals;
}
