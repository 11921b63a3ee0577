/* punctual_light.h: punctual lights, as in glTF's KHR_lights_punctual. */
#ifndef FIRN_SCENE_PUNCTUAL_LIGHT_H
#define FIRN_SCENE_PUNCTUAL_LIGHT_H

#include "src/scene/material.h"

enum light_kind {
    LIGHT_DIRECTIONAL, /* directional light, at infinity */
    LIGHT_POINT,
    LIGHT_SPOT,
    LIGHT_KIND_COUNT,
};

/* Punctual light. At distance d metres, its illuminance on a surface that faces it is, per channel
 * and in lux, color * intensity (directional) or color * intensity / d^2, times the attenuation by
 * `range` and by the spot cone. The cone's attenuation is 1 inside the inner cone, 0 outside the
 * outer cone, and in between the square of (cos a - cos outer) / (cos inner - cos outer). */
struct light {
    char name[MATERIAL_NAME_SIZE]; /* name of the node or, if that is "", of the light */
    uint32_t kind;                 /* enum light_kind */
    vec3s position;                /* world position, metres; unused if directional */
    vec3s direction;               /* unit direction of emission; unused by point lights */
    vec3s color;                   /* linear colour, each component 0 to 65504 */
    float intensity;               /* intensity in lux (directional) or candela, 0 to 1e30 */
    float range;                   /* maximum distance of illumination, metres; 0 for no limit */
    float inner_cone, outer_cone; /* spot cone half-angles, radians; 0 <= inner < outer <= pi / 2 */
};

/* Returns the GPU table of lights (shaders/brdf.h), which the caller frees; NULL without memory. */
vec4s *punctual_light_table_make(const struct light *lights, uint32_t count);

/* Returns "directional", "point" or "spot". */
const char *punctual_light_kind_name(const struct light *light);

/* Returns true if all values are in range. Coordinates may be from -1e6 to 1e6 metres. */
bool punctual_light_is_valid(const struct light *light);

#endif
