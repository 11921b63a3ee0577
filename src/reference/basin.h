/*
 * basin.h: a pool as a scene for rays: a closed shell of water with the waves of one time, tiles
 * below it, and the ice that floats in it.
 *
 * The shell reaches into walls and floor, so that no ray meets its sides. Its surface has
 * BASIN_GRID cells a side, with the normals of the waves.
 *
 * Light on tiles: the sun's is that of photons, or as through water at rest; the sky's is that of
 * the rasteriser, absorbed by the water above. As there, radiance is not divided by the squared
 * index where light leaves the water.
 */
#ifndef FIRN_REFERENCE_BASIN_H
#define FIRN_REFERENCE_BASIN_H

#include "shaders/water.h"
#include "src/reference/media.h"
#include "src/reference/radiance.h"

enum {
    BASIN_GRID = 512
};

struct basin {
    struct scene scene; /* owns its meshes of object and surroundings; the rest is borrowed */
    struct object objects[2];
    struct material bare;
    struct water_push push;
};

/* `globals` are those of the scene with the pool, at the time of its waves. Returns false when out
 * of memory; *basin is then {0}. */
bool basin_init(struct basin *basin, const struct scene *scene, const struct settings *settings,
                const struct globals *globals);
void basin_finish(struct basin *basin); /* {0} is fine */

/* Sets the media of water, ice and air. `scene` is the one with the pool. */
void basin_set_media(const struct basin *basin, const struct scene *scene,
                     const struct settings *settings, struct media *media);

/* Returns the sun's and the sky's light on tiles below water at rest; n is unit. */
struct radiance_sun basin_light(const struct basin *basin, const struct globals *globals,
                                vec3s point, vec3s n);

/* Returns the share of the sky's light that reaches a point below water at rest. */
vec3s basin_passed(const struct basin *basin, float path);

#endif
