/* bubbles.h: individual air bubbles in the ice. */
#ifndef FIRN_TECH_INCLUSIONS_BUBBLES_H
#define FIRN_TECH_INCLUSIONS_BUBBLES_H
#include "src/tech/technique.h"

extern const struct rg_image bubbles_color; /* premultiplied colour; 0 without bubbles */

/* Returns true if the refraction model intersects bubbles along refracted rays. */
bool bubbles_are_traced(const struct technique_config *config);

/* Fills bubbles_bvh (refract_bounce.h). */
void bubbles_write_bvh(void *memory, const struct frame_view *view, const struct globals *globals);

/* Array of struct bubbles_drawn in world space; the first scene->bubbles.count are valid. */
extern const struct rg_buffer bubbles_all;

/* Fills bubbles_all back to front, so that nearer bubbles are blended over farther ones. */
void bubbles_write(void *memory, const struct frame_view *view, const struct globals *globals);

extern const struct technique bubbles;
extern const struct setting_group bubbles_settings;

struct bubbles_params {
    uint32_t count, seed; /* maximum number; random seed */
    float size;           /* largest diameter, relative to object diagonal */
    uint32_t shape;       /* enum generate_bubbles_shape */
    float stretch;        /* longest by shortest diameter */
};

#endif
