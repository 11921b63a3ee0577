/* ice_depth.h: depth maps of the ice's front and back faces. */
#ifndef FIRN_TECH_ICE_ICE_DEPTH_H
#define FIRN_TECH_ICE_ICE_DEPTH_H
#include "src/tech/technique.h"

/* Depth of the nearest front face (1 without ice) and of the farthest back face (0 without ice).
 * Depth is 0 at the near plane and 1 at the far plane (metres: see linearize_depth.glsl). */
extern const struct rg_image ice_depth_front, ice_depth_back;

/* Sets up a pass's depth test to reject fragments behind the farthest back face. */
#define ICE_DEPTH_BEFORE_BACK \
    .depth = { &ice_depth_back, RG_LOAD_KEEP }, .depth_read_only = true, \
    .depth_compare = VK_COMPARE_OP_LESS_OR_EQUAL

extern const struct technique ice_depth;

#endif
