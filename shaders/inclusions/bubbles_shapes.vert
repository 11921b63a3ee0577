/* bubbles_shapes.vert: vertex shader of billboards of ellipsoidal and capsule-shaped bubbles. */
#version 460
#include "inclusions/bubbles.h"
#include "lib/globals.glsl"
#include "lib/specialization_constants.glsl"

layout(set = 0, binding = BUBBLES_DRAWN, scalar) readonly buffer Drawn
{
    bubbles_drawn drawn[];
};

layout(location = 0) out vec3 out_eye_to_point;
layout(location = 1) flat out vec3 out_eye_to_center;
layout(location = 2) flat out float out_radius;
layout(location = 3) flat out vec4 out_axis; /* xyz: unit; w: stretch */
layout(location = 4) flat out float out_is_capsule;

/* Draws a camera-facing rectangle that covers the bubble's outline, along the bubble's axis. If the
 * camera is inside the bubble's bounding sphere, the rectangle is degenerate. */
void main()
{
    const vec2 corners[] = { vec2(-1, -1), vec2(1, -1), vec2(-1, 1),
                             vec2(-1, 1),  vec2(1, -1), vec2(1, 1) };
    bubbles_drawn bubble = drawn[gl_VertexIndex / 6];
    vec2 corner = corners[gl_VertexIndex % 6];
    vec3 to = bubble.center - frame.eye;
    vec3 view = constant_orthographic != 0u ? frame.forward : normalize(to);
    vec3 right = bubble.axis - dot(bubble.axis, view) * view;
    if (dot(right, right) < 1e-4)
        right = cross(view, view.y * view.y < 0.5 ? vec3(0, 1, 0) : vec3(1, 0, 0));
    right = normalize(right);
    vec3 up = cross(right, view);
    float reach = bubble.radius + max(bubble.stretch, 0.0);
    float d2 = dot(to, to), r2 = reach * reach;
    float is_outside = d2 > r2 ? 1.0 : 0.0;
    float d = sqrt(d2);
    vec2 sides =
        vec2(reach * sqrt(d2 / max(d2 - r2, 1e-30)), bubble.radius * d / max(d - reach, 1e-30));
    sides.y = min(sides.y, sides.x);
    if (constant_orthographic != 0u)
        sides = vec2(reach, bubble.radius);
    sides *= is_outside;
    out_eye_to_point = to + sides.x * corner.x * right + sides.y * corner.y * up;
    out_eye_to_center = to;
    out_radius = bubble.radius;
    out_axis = vec4(bubble.axis, bubble.stretch);
    out_is_capsule = float(bubble.is_capsule);
    gl_Position = frame.clip_from_world * vec4(frame.eye + out_eye_to_point, 1.0);
}
