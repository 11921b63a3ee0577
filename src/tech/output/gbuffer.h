/* gbuffer.h: G-buffer: normal, depth and object of the visible surface. */
#ifndef FIRN_TECH_OUTPUT_GBUFFER_H
#define FIRN_TECH_OUTPUT_GBUFFER_H
#include "shaders/output/gbuffer.h"
#include "src/tech/technique.h"

/* xyz: unit, outward, world-space normal, or 0; w: view-space depth, metres, or GBUFFER_NOTHING */
extern const struct rg_image gbuffer_normal;
extern const struct rg_image gbuffer_object; /* object number; 0: no surface */
extern const struct rg_image gbuffer_depth;  /* reversed depth of surroundings and object */
extern const struct technique gbuffer;

#endif
