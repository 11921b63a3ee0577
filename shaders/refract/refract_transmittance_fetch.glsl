/* refract_transmittance_fetch.glsl: reads transmittances and the opaque base's radiance from
 * images. */
#ifndef REFRACT_TRANSMITTANCE_FETCH_GLSL
#define REFRACT_TRANSMITTANCE_FETCH_GLSL
#include "refract/refract.h"

layout(set = 0, binding = REFRACT_MATERIAL_FRONT) uniform sampler2D material_front;
layout(set = 0, binding = REFRACT_MATERIAL_BACK) uniform sampler2D material_back;
layout(set = 0, binding = REFRACT_MATERIAL_BASE) uniform sampler2D material_base_light;

#ifdef REFRACT_SSR
ivec2 refract_pixel; /* pixel of the hit face */
#else
#define refract_pixel ivec2(gl_FragCoord.xy)
#endif

/* Returns the transmittance of the pixel's front face. */
vec3 refract_front_transmittance()
{
    return texelFetch(material_front, refract_pixel, 0).rgb;
}

/* Returns the transmittance of the back face, at the pixel itself instead of the exit point. */
vec3 refract_back_transmittance()
{
    return texelFetch(material_back, refract_pixel, 0).rgb;
}

vec3 refract_base_radiance()
{
    return texelFetch(material_base_light, refract_pixel, 0).rgb;
}

#endif
