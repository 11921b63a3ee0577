/*
 * radiance.h: what lies around the object, as background.c draws it, ray by ray.
 *
 * Formulas and constants are those of shaders/sky.h and shaders/background.h. Pictures are looked
 * up between their four nearest texels; nothing but samples smooths them.
 */
#ifndef FIRN_REFERENCE_RADIANCE_H
#define FIRN_REFERENCE_RADIANCE_H

#include "shaders/globals.h"
#include "src/scene/scene.h"

struct radiance {
    const struct scene *scene;     /* borrowed */
    const struct globals *globals; /* the same */
    float linear[256];             /* of the textures' bytes */
};

struct radiance radiance_of(const struct scene *scene, const struct globals *globals);

/* Linear texel of a material's texture; white where it has none. */
vec4s radiance_texel(const struct radiance *radiance, uint32_t material, vec2s uv);

/* Radiance from infinitely far away; `dir` is unit. */
vec3s radiance_sky(const struct radiance *radiance, vec3s dir);

/* Radiance of the surroundings' surface that a ray along `dir` meets: its vertices blended, its
 * normal (unit, of either side) as it stands in the world. */
vec3s radiance_surface(const struct radiance *radiance, const struct mesh_vertex *surface,
                       vec3s dir);

#endif
