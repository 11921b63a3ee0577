#version 460
#extension GL_GOOGLE_include_directive : require
#include "mirror.glsl"

layout(set = 0, binding = MIRROR_SEEN) uniform sampler2D seen;
layout(set = 0, binding = MIRROR_GLOSSY) uniform sampler2D glossies;
layout(set = 0, binding = MIRROR_REFRACTED) uniform sampler2D refracted;

layout(location = 0) out vec4 color; /* is added */

const float cone = 0.8;         /* tangent of a reflection's half angle, for a width of 1 */
const float edge_share = 0.04;  /* of the picture: the image fades near its edges */
const float smooth_least = 0.4; /* roughness from which on the image fades */
const float sharp = 2.0;        /* pixels that a reflection is wide and shows what is refracted */

/* Returns what a ray meets of the objects after a share of its part, premultiplied: the mean of as
 * many pixels as its reflection is wide, or what a sharp one sees by refraction. */
vec4 met(part p, float after, float roughness)
{
    vec4 clip = mix(p.from, p.to, after);
    float far = mix(p.enters, p.leaves, after);
    float distance = view_distance(frame.clip_from_world, clip.z / clip.w);
    float pixel = push.pixel * (constant_orthographic != 0u ? 1.0 : distance);
    vec2 uv = picture_uv(clip);
    vec2 to_edge = min(uv, 1.0 - uv) / edge_share;
    float fade = clamp(min(to_edge.x, to_edge.y), 0.0, 1.0);
    fade *= 1.0 - smoothstep(smooth_least, MATERIAL_ROUGH, roughness);
    float wide = 2.0 * cone * roughness * roughness * far / pixel;
    vec4 image = textureLod(seen, uv, log2(max(wide, 1.0)));
    vec4 own = textureLod(refracted, 0.5 * gl_FragCoord.xy / vec2(textureSize(refracted, 0)), 0.0);
    float share = own.a > 0.0 ? clamp(2.0 - wide / sharp, 0.0, 1.0) : 0.0;
    image.rgb = mix(image.rgb, image.a * own.rgb / max(own.a, 1e-3), share);
    return fade * image;
}

/* Returns 1 in the middle of the area that is drawn, 0 at its edges in the picture. */
float inside_area()
{
    vec2 to_min = gl_FragCoord.xy - push.area_min, to_max = push.area_max - gl_FragCoord.xy;
    vec2 at = min(to_min, to_max) / push.area_edge;
    return clamp(min(at.x, at.y), 0.0, 1.0);
}

vec3 image_on(ivec2 pixel, vec3 eye_to_point)
{
    vec4 surface = texelFetch(surfaces, pixel, 0);
    part p = part_in_box(frame.eye + eye_to_point, mirrored_dir(pixel, eye_to_point));
    float share = find(p);
    if (share > 1.0)
        return vec3(0.0);
    vec4 image = inside_area() * met(p, share, surface.z);
    return surface.w * image.rgb - image.a * texelFetch(glossies, pixel, 0).rgb;
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec3 image = image_on(pixel, mirror_point(pixel, ray));
    color = is_mirror(pixel) ? vec4(image, 0.0) : vec4(0.0); /* the rest is undefined */
}
