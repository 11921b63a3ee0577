/* cracks.vert: vertex shader of cracks. If CRACKS_UNCLIPPED is defined, near and far planes are not
 * fitted to the object. Push constants become flat varyings, because lavapipe's fragment shaders
 * fetch each float of a uniform again for each pixel (Mesa 22.3). */
#version 460
#include "inclusions/cracks.h"
#include "lib/object_pose.glsl"

layout(push_constant, scalar) uniform Push
{
    cracks_shading shading;
};

layout(location = MESH_POSITION) in vec3 position;
layout(location = MESH_NORMAL) in vec3 normal;
layout(location = MESH_COLOR) in vec3 color;

layout(location = CRACKS_POSITION) out vec3 out_position;
layout(location = CRACKS_NORMAL) out vec3 out_normal;
layout(location = CRACKS_EYE_TO_POINT) out vec3 out_eye_to_point;
layout(location = CRACKS_OPEN) out float out_open;
layout(location = CRACKS_LIGHTS) flat out vec4 out_lights[GLOBALS_LIGHT_COUNT];
layout(location = CRACKS_SHADING) flat out cracks_shading out_shading;
layout(location = CRACKS_ETA) flat out float out_eta;

void main()
{
    vec3 eye = pose_to_object(frame.eye);
#ifdef CRACKS_UNCLIPPED
    mat4 clip_from_world = frame.clip_from_world;
#else
    mat4 clip_from_world = frame.fitted_clip_from_world;
#endif
    gl_Position = clip_from_world * vec4(pose_object(position), 1.0);
    out_position = position / frame.radius;
    out_normal = normal;
    out_eye_to_point = position - eye;
    out_open = CRACKS_SQUARED_GAP(color);
    for (int i = 0; i < GLOBALS_LIGHT_COUNT; i++)
        out_lights[i] = vec4(pose_to_object(frame.lights[i].xyz) - eye, frame.lights[i].w);
    out_shading = shading;
    out_eta = frame.highlight.fresnel != 0u ? frame.outside_in_air / frame.eta : 0.0;
}
