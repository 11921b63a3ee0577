/*
 * pool_scene.h: meshes of the pool for the path tracer: a closed shell of water displaced by the
 * waves, the tiles below it, and the floating ice.
 *
 * The shell extends into walls and floor, so that no ray can hit its sides. Its surface has
 * POOL_SCENE_GRID cells per side, with the analytic normals of the waves.
 *
 * Tiles are lit by sunlight of the photon map or, without one, sunlight refracted at a flat water
 * surface, and by the rasteriser's sky light, absorbed by the water above. As in the rasteriser,
 * radiance is not divided by the squared index when light leaves the water.
 */
#ifndef FIRN_LAB_REFERENCE_POOL_SCENE_H
#define FIRN_LAB_REFERENCE_POOL_SCENE_H

#include "shaders/water/water.h"
#include "src/lab/reference/nested_media.h"
#include "src/lab/reference/surroundings_radiance.h"

enum {
    POOL_SCENE_GRID = 512
};

struct pool_scene {
    struct scene scene; /* owns object and surroundings meshes only */
    struct object objects[2];
    struct material bare;
    struct water_push push;
};

/* Builds the pool's meshes from `scene`, with the waves at globals->time. If out of memory, returns
 * false and zeroes *pool_scene. */
bool pool_scene_init(struct pool_scene *pool_scene, const struct scene *scene,
                     const struct settings *settings, const struct globals *globals);
void pool_scene_finish(struct pool_scene *pool_scene); /* accepts {0} */

/* Sets media and priorities of water, ice and air. `scene` is the scene of pool_scene_init(). */
void pool_scene_set_media(const struct pool_scene *pool_scene, const struct scene *scene,
                          const struct settings *settings, struct nested_media *media);

/* Returns the effect of a flat water surface on sunlight and sky light at a tile of normal `n`. */
struct radiance_sun pool_scene_light(const struct pool_scene *pool_scene,
                                     const struct globals *globals, vec3s point, vec3s n);

/* Returns the water's Beer-Lambert transmittance per channel over `path` metres. */
vec3s pool_scene_transmittance(const struct pool_scene *pool_scene, float path);

#endif
