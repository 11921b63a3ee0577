#version 460
#extension GL_GOOGLE_include_directive : require
#include "mirror.glsl"

layout(location = 0) out vec4 point; /* at which a mirrored ray meets an object, from the eye */
layout(location = 1) out vec4 dir;   /* of the ray */

/* Finds for one of four pixels what it mirrors of the objects; a depth of 1 marks those that do. */
void main()
{
    vec2 size = vec2(textureSize(depths, 0));
    ivec2 pixel = 2 * ivec2(gl_FragCoord.xy);
    vec2 beside = (vec2(pixel) + 0.5) * ceil(0.5 * size) / size - gl_FragCoord.xy;
    vec3 from = mirror_point(pixel, ray + beside.x * dFdx(ray) + beside.y * dFdy(ray));
    vec3 along = mirrored_dir(pixel, from);
    part p = part_in_box(frame.eye + from, along);
    float share = find(p);
    point = vec4(from + mix(p.enters, p.leaves, share) * along, 0.0);
    dir = vec4(along, 0.0);
    gl_FragDepth = is_mirror(pixel) && share <= 1.0 ? 1.0 : 0.0;
}
