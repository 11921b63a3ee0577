/* bubbles.vert: vertex shader of billboards of spherical bubbles. */
#version 460
#include "inclusions/bubbles.h"
#include "lib/globals.glsl"
#include "lib/specialization_constants.glsl"

layout(set = 0, binding = BUBBLES_DRAWN, scalar) readonly buffer Drawn
{
    bubbles_drawn spheres[];
};

layout(location = 0) out vec3 out_eye_to_point;
layout(location = 1) flat out vec3 out_eye_to_center;
layout(location = 2) flat out float out_radius;

/* Draws a camera-facing square that covers the sphere's outline. The square is degenerate if the
 * camera is inside the sphere. */
void main()
{
    const vec2 corners[] = { vec2(-1, -1), vec2(1, -1), vec2(-1, 1),
                             vec2(-1, 1),  vec2(1, -1), vec2(1, 1) };
    bubbles_drawn sphere = spheres[gl_VertexIndex / 6];
    vec2 corner = corners[gl_VertexIndex % 6];
    vec3 axis = sphere.center - frame.eye;
    float d2 = dot(axis, axis);
    float r2 = sphere.radius * sphere.radius;
    float side = d2 > r2 ? sphere.radius * sqrt(d2 / (d2 - r2)) : 0.0;
    vec3 other = axis.y * axis.y < 0.5 * d2 ? vec3(0, 1, 0) : vec3(1, 0, 0);
    vec3 right = normalize(cross(axis, other));
    vec3 up = normalize(cross(right, axis));
    if (constant_orthographic != 0u) {
        other = abs(frame.forward.y) < 0.7 ? vec3(0, 1, 0) : vec3(1, 0, 0);
        right = normalize(cross(frame.forward, other));
        up = cross(right, frame.forward);
        side = sphere.radius;
    }
    out_eye_to_point = axis + side * (corner.x * right + corner.y * up);
    out_eye_to_center = axis;
    out_radius = sphere.radius;
    gl_Position = frame.clip_from_world * vec4(frame.eye + out_eye_to_point, 1.0);
}
