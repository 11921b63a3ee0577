/* ssr.frag: fragment shader that adds screen-space reflections to the image. */
#version 460
#include "surroundings/ssr.glsl"

layout(set = 0, binding = SSR_OBJECTS) uniform sampler2D objects;
layout(set = 0, binding = SSR_SPECULAR) uniform sampler2D speculars;
layout(set = 0, binding = SSR_REFRACTED) uniform sampler2D refracted;

layout(location = 0) out vec4 color; /* additively blended */

const float cone = 0.8;           /* tangent of a reflection lobe's half-angle at GGX alpha 1 */
const float fade_border = 0.04;   /* width of the fade at image edges, relative to the image */
const float fade_roughness = 0.4; /* roughness at which reflections begin to fade out */
const float sharp = 2.0;          /* footprint in pixels up to which refracted colours are used */

/* Returns the objects' premultiplied colour at `t` along the segment. Narrow reflection lobes show
 * refraction. Wide lobes show the image, blurred to the lobe's footprint. */
vec4 hit_color(segment p, float t, float roughness)
{
    vec4 clip = mix(p.from, p.to, t);
    float ray_length = mix(p.t_enter, p.t_leave, t);
    float distance = view_depth(frame.clip_from_world, clip.z / clip.w);
    float pixel = push.pixel * (constant_orthographic != 0u ? 1.0 : distance);
    vec2 uv = image_uv(clip);
    vec2 to_edge = min(uv, 1.0 - uv) / fade_border;
    float fade = clamp(min(to_edge.x, to_edge.y), 0.0, 1.0);
    fade *= 1.0 - smoothstep(fade_roughness, MATERIAL_ROUGH, roughness);
    float footprint = 2.0 * cone * roughness * roughness * ray_length / pixel;
    vec4 image = textureLod(objects, uv, log2(max(footprint, 1.0)));
    vec4 refracted_color =
        textureLod(refracted, 0.5 * gl_FragCoord.xy / vec2(textureSize(refracted, 0)), 0.0);
    float blend = refracted_color.a > 0.0 ? clamp(2.0 - footprint / sharp, 0.0, 1.0) : 0.0;
    image.rgb = mix(image.rgb, image.a * refracted_color.rgb / max(refracted_color.a, 1e-3), blend);
    return fade * image;
}

/* Returns a factor that fades out reflections at the scissored area's edges inside the image. */
float inside_area()
{
    vec2 to_min = gl_FragCoord.xy - push.area_min, to_max = push.area_max - gl_FragCoord.xy;
    vec2 at = min(to_min, to_max) / push.area_edge;
    return clamp(min(at.x, at.y), 0.0, 1.0);
}

vec3 reflection_on(ivec2 pixel, vec3 eye_to_point)
{
    vec4 surface = texelFetch(surfaces, pixel, 0);
    segment p = segment_in_box(frame.eye + eye_to_point, reflected_dir(pixel, eye_to_point));
    float t = intersect(p);
    if (t > 1.0)
        return vec3(0.0);
    vec4 image = inside_area() * hit_color(p, t, surface.z);
    return surface.w * image.rgb - image.a * texelFetch(speculars, pixel, 0).rgb;
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec3 image = reflection_on(pixel, ssr_surface_point(pixel, ray));
    color = is_reflective(pixel) ? vec4(image, 0.0) : vec4(0.0); /* other pixels are undefined */
}
