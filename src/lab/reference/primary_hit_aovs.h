/* primary_hit_aovs.h: layers (AOVs) of the primary hit of a camera ray. */
#ifndef FIRN_LAB_REFERENCE_PRIMARY_HIT_AOVS_H
#define FIRN_LAB_REFERENCE_PRIMARY_HIT_AOVS_H

#include "shaders/output/first_surface.h"
#include "src/lab/reference/embree_scene.h"
#include "src/lab/reference/reference_aov_table.h"

struct primary_hit_layers {
    const struct embree_scene *embree_scene;
    const struct radiance *radiance;
    const struct first_surface_previous *earlier; /* previous frame; NULL if nothing moves */
};

/* Fills the layers of the primary hit. Skips surfaces with alpha below 0.5, as the rasteriser does.
 * `closest` is the ray's closest hit. `forward` is the camera's view direction. */
void primary_hit_layers_fill(const struct primary_hit_layers *first,
                             const struct embree_scene_ray *ray, vec3s forward,
                             const struct embree_scene_hit *closest,
                             struct reference_ray_values *values);

/* Returns the object number of a hit, as stored in the layer `object`. */
float primary_hit_layers_object(const struct primary_hit_layers *first,
                                const struct embree_scene_hit *hit);

/* Returns the motion of a surface point since the previous frame, in pixels right and down. */
vec2s primary_hit_layers_motion(const struct primary_hit_layers *first,
                                const struct embree_scene_hit *hit);

#endif
