/*
 * radiance.h: radiance of the object's surroundings along a ray, as background.c draws them.
 *
 * Formulas and constants are those of shaders/sky.h and shaders/background.h. Textures are filtered
 * bilinearly; only the samples of a pixel antialias them.
 */
#ifndef FIRN_REFERENCE_RADIANCE_H
#define FIRN_REFERENCE_RADIANCE_H

#include "shaders/globals.h"
#include "src/scene/scene.h"

struct radiance {
    const struct scene *scene;     /* borrowed */
    const struct globals *globals; /* borrowed */
    float linear[256];             /* linear values of the textures' bytes */
};

struct radiance radiance_of(const struct scene *scene, const struct globals *globals);

/* Returns the linear texel of a material's texture, or white if it has none. */
vec4s radiance_texel(const struct radiance *radiance, uint32_t material, vec2s uv);

/* Returns the radiance of the sky, environment or background colour; `dir` is unit. */
vec3s radiance_sky(const struct radiance *radiance, vec3s dir);

/* Returns the radiance of a surface of the surroundings that a ray along `dir` intersects.
 * `surface` has the interpolated vertices, with a unit normal of either side in the world. */
vec3s radiance_surface(const struct radiance *radiance, const struct mesh_vertex *surface,
                       vec3s dir);

#endif
