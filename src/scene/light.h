/* light.h: a light that stands in a scene, in the terms of glTF's KHR_lights_punctual. */
#ifndef FIRN_SCENE_LIGHT_H
#define FIRN_SCENE_LIGHT_H

#include "src/scene/material.h"

enum light_kind {
    LIGHT_DIRECTIONAL, /* infinitely far away */
    LIGHT_POINT,
    LIGHT_SPOT,
    LIGHT_KIND_COUNT,
};

/*
 * A light without size. At distance d metres, its illuminance on a surface that faces it is, per
 * channel and in lux, color * intensity (directional), or color * intensity / d^2, times the
 * window of `range` and, for a spot, the cone's: 1 within the inner cone, 0 outside the outer one,
 * and between them the square of (cos a - cos outer) / (cos inner - cos outer).
 */
struct light {
    char name[MATERIAL_NAME_SIZE]; /* of the node, else of the light; "" if neither has one */
    uint32_t kind;                 /* enum light_kind */
    vec3s position;                /* world, metres; of a directional one without effect */
    vec3s direction;               /* unit; the way its light goes; of a point without effect */
    vec3s color;                   /* linear, each 0 to 65504 */
    float intensity;               /* lux (directional) or candela, 0 to 1e30 */
    float range;                   /* metres beyond which there is no light; 0: no limit */
    float inner_cone, outer_cone;  /* of a spot: angles from its axis, radians; 0 <= inner < outer
                                      <= pi / 2; of others 0 */
};

/* Returns the lights as shaders read them (shaders/lit.h), malloc'd. NULL when out of memory. */
vec4s *light_rows_make(const struct light *lights, uint32_t count);

/* Returns "directional", "point" or "spot". */
const char *light_kind_name(const struct light *light);

/* Returns whether all values are within their ranges, with positions within 1e6 metres. */
bool light_is_sound(const struct light *light);

#endif
