/* materials_surface.frag: a G-buffer by one of eight materials, chosen by a constant. */
#version 460

layout(constant_id = 0) const uint material = 0;
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 color;
layout(location = 0) out vec4 color_out;
layout(location = 1) out vec4 normal_out;
layout(location = 2) out vec4 position_out;

void main()
{
    const vec3 at = 8.0 * position + 0.3;
    const float patterns[] = {
        1.0,                                             /* plain */
        step(0.5, fract(0.5 * (at.x + at.y))),           /* stripes */
        step(0.5, fract(0.5 * at.y)),                    /* rings */
        mod(dot(floor(at), vec3(1.0)), 2.0),             /* checks */
        smoothstep(0.3, 0.4, length(fract(at) - 0.5)),   /* dots */
        0.5 + 0.5 * sin(2.0 * at.y),                     /* waves */
        fract(sin(dot(floor(at), vec3(3, 5, 7))) * 99.), /* noise */
        step(0.15, min(fract(at.x + at.z), fract(at.y))) /* bricks */
    };
    color_out = vec4(color.rgb * mix(0.35, 1.0, patterns[material]), 0.0);
    normal_out = vec4(normalize(cross(dFdy(position), dFdx(position))), 1.0);
    position_out = vec4(position, 1.0);
}
