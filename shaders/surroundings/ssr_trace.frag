/* ssr_trace.frag: fragment shader that traces reflected rays for ssr_shade_refractive_hit.frag. */
#version 460
#include "surroundings/ssr.glsl"

layout(location = 0) out vec4 point; /* hit point of the reflected ray, relative to the camera */
layout(location = 1) out vec4 dir;   /* direction of the reflected ray */

/* Traces the reflected ray of one pixel in four. Writes depth 1 where the ray hits an object. */
void main()
{
    vec2 size = vec2(textureSize(depths, 0));
    ivec2 pixel = 2 * ivec2(gl_FragCoord.xy);
    vec2 offset = (vec2(pixel) + 0.5) * ceil(0.5 * size) / size - gl_FragCoord.xy;
    vec3 from = ssr_surface_point(pixel, ray + offset.x * dFdx(ray) + offset.y * dFdy(ray));
    vec3 along = reflected_dir(pixel, from);
    segment p = segment_in_box(frame.eye + from, along);
    float t = intersect(p);
    point = vec4(from + mix(p.t_enter, p.t_leave, t) * along, 0.0);
    dir = vec4(along, 0.0);
    gl_FragDepth = is_reflective(pixel) && t <= 1.0 ? 1.0 : 0.0;
}
