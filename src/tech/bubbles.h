/* bubbles.h: single bubbles of air in the ice. */
#ifndef TECH_BUBBLES_H
#define TECH_BUBBLES_H
#include "src/tech/technique.h"

extern const struct rg_image bubbles_color; /* premultiplied colour; 0 without bubbles */

/* Depths of the nearest bubbles (shaders/within.glsl), if bubbles_are_bent(). */
extern const struct rg_image bubbles_depth;

/* Returns whether over.c shows them along rays that the ice's surface has bent. */
bool bubbles_are_bent(const struct technique_choice *choice);

/* An array of BUBBLES_COUNT_MAX struct bubbles_drawn in world space; the first ones, as many as
 * the scene has, are valid. */
extern const struct rg_buffer bubbles_all;

/* Fills bubbles_all, farthest first, so that later spheres may hide earlier ones but not the
 * other way around. */
void bubbles_write(void *memory, const struct frame_view *view, const struct globals *globals);

extern const struct technique bubbles;
extern const struct setting_group bubbles_settings;

struct bubbles_params {
    uint32_t count, seed; /* number of bubbles; seed of their places and sizes */
    float size;           /* longest diameter of the largest, in diagonals of the object's box */
    uint32_t shape;       /* enum generate_bubbles_shape */
    float stretch;        /* longest diameter by the shortest; not of spheres */
};

#endif
