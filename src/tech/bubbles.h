/* bubbles.h: single bubbles of air in the ice. */
#ifndef TECH_BUBBLES_H
#define TECH_BUBBLES_H
#include "src/tech/technique.h"

extern const struct rg_image bubbles_color; /* premultiplied; 0 where there is none */

/* BUBBLES_COUNT_MAX of struct bubbles_sphere in the world, of which as many are there as the scene
 * has. */
extern const struct rg_buffer bubbles_spheres;

/* Writes them, farthest first: none can hide one that comes after it. */
void bubbles_write(void *memory, const struct frame_view *view, const struct globals *globals);

extern const struct technique bubbles;
extern const struct setting_group bubbles_settings;

struct bubbles_params {
    uint32_t count, seed; /* of bubbles; of their places and sizes */
    float size;           /* diameter of the largest, in diagonals of the object's box */
};

#endif
