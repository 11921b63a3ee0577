/*
 * surface_light.h: the light of an equirectangular environment on surfaces (shaders/lit.h).
 *
 * A table for directions and roughness: the environment averaged over what microfacets reflect that
 * are seen along their normal (Karis 2013), and over the hemisphere by Lambert's cosine. It is of
 * the picture as it is stored: environment.turn is left to those who look it up.
 */
#ifndef FIRN_SCENE_SURFACE_LIGHT_H
#define FIRN_SCENE_SURFACE_LIGHT_H

#include "src/scene/environment.h"

/* Returns the table of what surfaces reflect of an even environment: LIT_SPLIT_SIDE times as many
 * pairs of halves, malloc'd. NULL when out of memory. */
uint16_t *surface_split_make(void);

/* Returns LIT_LAYERS pictures of LIT_WIDTH times LIT_HEIGHT texels of half RGBA, malloc'd. NULL
 * when out of memory. */
uint16_t *surface_light_make(const struct environment *environment);

/* Returns a cone from which most of the light of a table comes: its axis, unit, and the cosine of
 * its angle; (0, 0, 0, 1) if there is none that is much brighter than the rest. It is turned with
 * the environment. `table`: of surface_light_make(); may be NULL. */
vec4s surface_light_guide(const struct environment *environment, const uint16_t *table);

#endif
