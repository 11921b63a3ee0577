/*
 * pool_scene.h: the pool as a scene that the path tracer can intersect: a closed shell of water
 * displaced by the waves at one point in time, the tiles below it, and the floating ice.
 *
 * The shell extends into walls and floor, so that no ray can hit its sides. Its surface has
 * POOL_SCENE_GRID cells per side, with the analytic normals of the waves.
 *
 * Lighting of the tiles: sunlight comes from the photon map or, without one, is refracted at a flat
 * water surface. Sky light is that of the rasteriser, absorbed by the water above. As in the
 * rasteriser, radiance is not divided by the squared index when light leaves the water.
 */
#ifndef FIRN_REFERENCE_POOL_SCENE_H
#define FIRN_REFERENCE_POOL_SCENE_H

#include "shaders/water/water.h"
#include "src/reference/nested_media.h"
#include "src/reference/radiance.h"

enum {
    POOL_SCENE_GRID = 512
};

struct pool_scene {
    struct scene scene; /* owns the object and surroundings meshes; all else is borrowed */
    struct object objects[2];
    struct material bare;
    struct water_push push;
};

/* Builds the meshes. `globals` are those of the scene that has the pool, at the time of the waves.
 * Returns false when out of memory; *basin is then {0}. */
bool pool_scene_init(struct pool_scene *pool_scene, const struct scene *scene,
                     const struct settings *settings, const struct globals *globals);
void pool_scene_finish(struct pool_scene *pool_scene); /* accepts {0} */

/* Sets the media of water, ice and air with their priorities. `scene` is the one that has the pool.
 */
void pool_scene_set_media(const struct pool_scene *pool_scene, const struct scene *scene,
                          const struct settings *settings, struct nested_media *media);

/* Returns sunlight and sky light on a tile below a flat water surface; `n` is a unit normal. */
struct radiance_sun pool_scene_light(const struct pool_scene *pool_scene,
                                     const struct globals *globals, vec3s point, vec3s n);

/* Returns the Beer-Lambert transmittance of the water over a path of `path` metres, per channel. */
vec3s pool_scene_transmittance(const struct pool_scene *pool_scene, float path);

#endif
