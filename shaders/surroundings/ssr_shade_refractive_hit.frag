/* ssr_shade_refractive_hit.frag: fragment shader of refraction in objects that reflected rays hit
 * (ssr.c). */
#version 460
#define REFRACT_BOUNCE
#define REFRACT_EXITS
#define REFRACT_NEAREST
#define REFRACT_FULLSCREEN
#define REFRACT_SSR
#include "refract/refract_main.glsl"
#include "surroundings/ssr.h"

layout(set = 0, binding = SSR_HIT_POINT) uniform sampler2D points;
layout(set = 0, binding = SSR_HIT_DIR) uniform sampler2D dirs;

layout(location = 0) out vec4 refracted; /* premultiplied alpha */

/* Shades a reflected ray at the object it hits, with the refraction model of primary rays. If the
 * ray hits a face from behind, the result is empty. Such a ray has passed a face before, which the
 * depth maps lack, because only faces visible to the camera are in them. */
void main()
{
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec3 e = normalize(texelFetch(dirs, at, 0).xyz);
    eye_to_point = texelFetch(points, at, 0).xyz;
    ivec2 pixel =
        ivec2(refract_uv(refract_clip(refract_front_point())) * vec2(textureSize(shading, 0)));
#ifdef REFRACT_MATERIAL
    refract_pixel = pixel;
#endif
    normal = texelFetch(shading, pixel, 0).xyz;
    fresnel_paper = optics_fresnel_paper(e, normal);
    refract_result r = refract_shade(e, normal);
    vec3 color = optics_compose(r.reflection, r.refraction, r.fresnel);
    bool hits_front = dot(normal, e) < 0.0;
    refracted = hits_front ? vec4(min(color, vec3(SSR_RADIANCE_MAX)), 1.0) : vec4(0.0);
}
