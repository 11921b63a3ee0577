/* ice_caustics.h: caustics and shadow of the ice in sunlight, and the shadow map. */
#ifndef FIRN_TECH_LIGHTING_ICE_CAUSTICS_H
#define FIRN_TECH_LIGHTING_ICE_CAUSTICS_H
#include "shaders/lighting/ice_caustics.h"
#include "src/tech/technique.h"

struct ice_caustics_params {
    uint32_t light; /* ICE_CAUSTICS_NONE, ... */
    float reach;    /* half map width, bounding radii */
    /* shadow: 1 if the ice blocks direct sunlight. Then only caustics light the ice's shadow. */
    uint32_t shadow;
    uint32_t ground; /* 1: surroundings shadow each other */
};

/* Upload buffers for the sun's view. */
extern const struct rg_buffer ice_caustics_globals; /* struct globals of the sun's view */
extern const struct rg_buffer ice_caustics_light;   /* struct ice_caustics_light, of the map */

/* Caustic map in the sun's view. rgb: light relative to direct sunlight; a: coverage by the ice. */
extern const struct rg_image ice_caustics_map;
extern const struct rg_image ice_caustics_ground, ice_caustics_front_depth, ice_caustics_shadow_map;

extern const struct setting_group ice_caustics_settings;

extern const struct technique ice_caustics;

/* Resource uses of passes whose shaders include lib/sun_shadow_caustics.glsl. */
extern const struct rg_use ice_caustics_uses[];

/* Write the contents of ice_caustics_globals and ice_caustics_light (technique_upload.write). */
void ice_caustics_write_globals(void *memory, const struct frame_view *view,
                                const struct globals *globals);
void ice_caustics_write_light(void *memory, const struct frame_view *view,
                              const struct globals *globals);

#endif
