/* refract_dress.glsl: surface transmittance and opaque base colour, from images of ice_normal.c. */
#ifndef REFRACT_DRESS_GLSL
#define REFRACT_DRESS_GLSL
#include "refract.h"

layout(set = 0, binding = REFRACT_DRESS_FRONT) uniform sampler2D dress_front;
layout(set = 0, binding = REFRACT_DRESS_BACK) uniform sampler2D dress_back;
layout(set = 0, binding = REFRACT_DRESS_SHINE) uniform sampler2D dress_shine;

#ifdef REFRACT_MIRRORED
ivec2 refract_pixel; /* image pixel of the face that the ray hits; set by main() */
#else
#define refract_pixel ivec2(gl_FragCoord.xy)
#endif

/* Returns the transmittance of the pixel's front face. */
vec3 refract_dress_front()
{
    return texelFetch(dress_front, refract_pixel, 0).rgb;
}

/* Returns the transmittance of the pixel's back face, for models that do not know the exit point.
 */
vec3 refract_dress_back()
{
    return texelFetch(dress_back, refract_pixel, 0).rgb;
}

vec3 refract_dress_shine()
{
    return texelFetch(dress_shine, refract_pixel, 0).rgb;
}

#endif
