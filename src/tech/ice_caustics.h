/* ice_caustics.h: the sun's light that comes through the ice, on what lies around it. */
#ifndef TECH_ICE_CAUSTICS_H
#define TECH_ICE_CAUSTICS_H
#include "shaders/ice_caustics.h"
#include "src/tech/technique.h"

struct ice_caustics_params {
    uint32_t light;  /* ICE_CAUSTICS_NONE ... */
    float reach;     /* half width of the map, radii of the object's bounding sphere */
    uint32_t shadow; /* 1: what the ice covers gets only what goes through it */
};

/* Of the host, each frame: what the sun's view of the ice has for globals, and the map's place. */
extern const struct rg_buffer ice_caustics_globals; /* struct globals */
extern const struct rg_buffer ice_caustics_light;   /* struct ice_caustics_light */

/* In that view: 1 is the sun's own light (rgb); cover of the ice (a) */
extern const struct rg_image ice_caustics_map;
extern const struct rg_image ice_caustics_ground, ice_caustics_front_depth;

extern const struct setting_group ice_caustics_settings;

extern const struct technique ice_caustics;

/* The uses of rows whose shaders include lib/ice_shine.glsl; ends at {0}. */
extern const struct rg_use ice_caustics_uses[];

/* What fills the two buffers (struct technique_upload). */
void ice_caustics_write_globals(void *memory, const struct frame_view *view,
                                const struct globals *globals);
void ice_caustics_write_light(void *memory, const struct frame_view *view,
                              const struct globals *globals);

#endif
