/* bubbles.h: bindings of bubbles*.{vert,frag}, which also use ice_depth.h and refract.h. */
#ifndef SHADERS_INCLUSIONS_BUBBLES_H
#define SHADERS_INCLUSIONS_BUBBLES_H
#include "abi.h"

#define BUBBLES_ENV_CUBE 1  /* environment cube map, as REFRACT_ENV_CUBE */
#define BUBBLES_CRACKS   6  /* image cracks.hits, read by bubbles_light.glsl */
#define BUBBLES_DRAWN    20 /* storage buffer of bubbles_drawn, sorted back to front */

#define BUBBLES_COUNT_MAX 4096

/* Bubble in world space; src/scene/bubble_intersect.h has the object-space counterpart, struct
 * bubble. */
struct bubbles_drawn {
    vec3s center;  /* metres */
    float radius;  /* perpendicular to the axis */
    vec3s axis;    /* unit; unused for spheres */
    float stretch; /* half the bubble's length along the axis, minus `radius`; 0 for a sphere */
    uint32_t is_capsule;
};

#define BUBBLES_NODES_MAX (2 * BUBBLES_COUNT_MAX)

/* Kinds of nodes, in the two lowest bits of bubbles_node.link. */
#define BUBBLES_NODE_BOX       0 /* bounding box of the nodes up to the link */
#define BUBBLES_NODE_ELLIPSOID 1
#define BUBBLES_NODE_CAPSULE   2
#define BUBBLES_NODE_KIND      3 /* mask */
#define BUBBLES_NODE_SHIFT     2

#define BUBBLES_NODE_TEXELS 2 /* texels of a node in the texel buffer */

/* Node of the BVH of bubbles, in world space and depth-first order. The first node is a box. */
struct bubbles_node {
    vec3s center;
    uint32_t link; /* index of the next node if a ray misses this one, and the kind */
    vec3s axis;    /* unit axis times radius; box: half its size */
    float stretch; /* as in bubbles_drawn; unused for boxes */
};

#endif
