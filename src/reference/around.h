/*
 * around.h: what lies around the object, as background.c draws it, ray by ray.
 *
 * Formulas and constants are those of shaders/sky.h and shaders/background.h. Pictures are looked
 * up between their four nearest texels; nothing but samples smooths them.
 */
#ifndef FIRN_REFERENCE_AROUND_H
#define FIRN_REFERENCE_AROUND_H

#include "shaders/globals.h"
#include "src/scene/scene.h"

struct around {
    const struct scene *scene;     /* borrowed */
    const struct globals *globals; /* the same */
    float linear[256];             /* of the textures' bytes */
};

struct around around_of(const struct scene *scene, const struct globals *globals);

/* Linear texel of a material's texture; white where it has none. */
vec4s around_texel(const struct around *around, uint32_t material, vec2s uv);

/* Radiance from infinitely far away; `dir` is unit. */
vec3s around_sky(const struct around *around, vec3s dir);

/* Radiance of the surroundings' surface that a ray along `dir` meets: its vertices blended, its
 * normal (unit, of either side) as it stands in the world. */
vec3s around_surface(const struct around *around, const struct mesh_vertex *surface, vec3s dir);

#endif
