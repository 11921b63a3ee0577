/* ice_caustics.h: the sun's light that passes through the ice, on the surroundings. */
#ifndef TECH_ICE_CAUSTICS_H
#define TECH_ICE_CAUSTICS_H
#include "shaders/ice_caustics.h"
#include "src/tech/technique.h"

struct ice_caustics_params {
    uint32_t light;  /* ICE_CAUSTICS_NONE ... */
    float reach;     /* half width of the map, radii of the object's bounding sphere */
    uint32_t shadow; /* 1: the ice casts a shadow, which only light that it transmits reaches */
    uint32_t ground; /* 1: surroundings cast shadows on each other */
};

/* Upload buffers: the globals of the sun's view of the ice, and the position of the map. */
extern const struct rg_buffer ice_caustics_globals; /* struct globals */
extern const struct rg_buffer ice_caustics_light;   /* struct ice_caustics_light */

/* The light map, as seen from the sun. rgb: light relative to the sun's direct light; a: cover of
 * the ice. */
extern const struct rg_image ice_caustics_map;
extern const struct rg_image ice_caustics_ground, ice_caustics_front_depth, ice_caustics_shade;

extern const struct setting_group ice_caustics_settings;

extern const struct technique ice_caustics;

/* The uses of rows whose shaders include lib/ice_shine.glsl; the list ends at {0}. */
extern const struct rg_use ice_caustics_uses[];

/* Fill the two buffers (struct technique_upload). */
void ice_caustics_write_globals(void *memory, const struct frame_view *view,
                                const struct globals *globals);
void ice_caustics_write_light(void *memory, const struct frame_view *view,
                              const struct globals *globals);

#endif
