/* ice_depth.h: depth of the ice's front and back faces in each pixel. */
#ifndef TECH_ICE_DEPTH_H
#define TECH_ICE_DEPTH_H
#include "src/tech/technique.h"

/* Depth by globals.fitted_clip_from_world, 0 near, 1 far, of the nearest front face (1: none) and
 * of the farthest back face (0: none). shaders/lib/fitted.glsl converts it to metres. */
extern const struct rg_image ice_depth_front, ice_depth_back;

/* The layers: depth of front and back along the view's axis and thickness along the ray, metres; 0
 * without ice. */
extern const struct rg_image ice_depth_layers;

/* Fields of a row that draws by globals.fitted_clip_from_world: its depth test rejects fragments
 * behind the farthest back face. */
#define ICE_DEPTH_BEFORE_BACK \
    .depth = { &ice_depth_back, RG_LOAD_KEEP }, .depth_read_only = true, \
    .depth_compare = VK_COMPARE_OP_LESS_OR_EQUAL

extern const struct technique ice_depth;

#endif
