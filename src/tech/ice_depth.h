/* ice_depth.h: how far away the ice begins and ends, for each pixel. */
#ifndef TECH_ICE_DEPTH_H
#define TECH_ICE_DEPTH_H
#include "src/tech/technique.h"

/* Depth by globals.fitted_clip_from_world, 0 near, 1 far: of the nearest front face (1: none) and
 * of the farthest back face (0: none). shaders/lib/fitted.glsl makes metres of it. */
extern const struct rg_image ice_depth_front, ice_depth_back;

/* Metres: front and back along the view's axis, thickness along the ray; 0 without ice. */
extern const struct rg_image ice_depth_layers;

/* In a row that draws by globals.fitted_clip_from_world: nothing behind the farthest back face. */
#define ICE_DEPTH_BEFORE_BACK \
    .depth = { &ice_depth_back, RG_LOAD_KEEP }, .depth_read_only = true, \
    .depth_compare = VK_COMPARE_OP_LESS_OR_EQUAL

extern const struct technique ice_depth;

#endif
