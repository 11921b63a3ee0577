/* refract_dress.glsl: what passes an object's surface, and what the surface itself shows, in
 * ice_normal.c's images. */
#ifndef REFRACT_DRESS_GLSL
#define REFRACT_DRESS_GLSL
#include "refract.h"

layout(set = 0, binding = REFRACT_DRESS_FRONT) uniform sampler2D dress_front;
layout(set = 0, binding = REFRACT_DRESS_BACK) uniform sampler2D dress_back;
layout(set = 0, binding = REFRACT_DRESS_SHINE) uniform sampler2D dress_shine;

#ifdef REFRACT_MIRRORED
ivec2 refract_pixel; /* of the picture, in which the face is that a ray meets; set by main() */
#else
#define refract_pixel ivec2(gl_FragCoord.xy)
#endif

/* Returns the share of light that passes the front face of a pixel. */
vec3 refract_dress_front()
{
    return texelFetch(dress_front, refract_pixel, 0).rgb;
}

/* Returns that of the back face behind it: where a rung does not know where light leaves. */
vec3 refract_dress_back()
{
    return texelFetch(dress_back, refract_pixel, 0).rgb;
}

vec3 refract_dress_shine()
{
    return texelFetch(dress_shine, refract_pixel, 0).rgb;
}

#endif
