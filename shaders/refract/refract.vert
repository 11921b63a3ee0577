/* refract.vert: vertex shader of the ice's front faces, with Seipel and Nivfors's Fresnel term. */
#version 460
#define HIGHLIGHT_VERTEX
#include "lib/object_pose.glsl"
#include "lib/optics.glsl"
#include "lib/primary_ray.glsl"
#include "lib/specialization_constants.glsl"
#include "lighting/highlight.glsl"
#include "refract/refract.h"

layout(location = MESH_POSITION) in vec3 position;
layout(location = MESH_NORMAL) in vec3 normal;

layout(location = REFRACT_EYE_TO_POINT) out vec3 out_eye_to_point;
layout(location = REFRACT_NORMAL) out vec3 out_normal;
layout(location = REFRACT_FRESNEL) out float out_fresnel;

#ifdef REFRACT_BUMP
layout(location = MESH_UV) in vec2 uv;
layout(location = REFRACT_BUMP_AT) out vec3 out_bump_at;
layout(location = REFRACT_BUMP_WORLD_FROM_OBJECT) flat out mat3 out_bump_world_from_object;
layout(location = REFRACT_BUMP_SLOPE) flat out float out_bump_slope;
#endif
#ifdef REFRACT_PER_VERTEX
layout(location = REFRACT_REFLECTED) out vec3 out_reflected;
layout(location = REFRACT_REFRACTED) out vec3 out_refracted[3];
#endif

void main()
{
    /* `precise` makes all passes compute exactly equal depths for a face */
    precise vec3 point = pose_object(position);
    precise vec4 clip = frame.clip_from_world * vec4(point, 1.0);
    gl_Position = clip;
    out_eye_to_point = point - frame.eye;
    out_normal = pose_object_normal(normal);
    out_fresnel = optics_fresnel_paper(primary_ray_dir(out_eye_to_point), out_normal);
    highlight_write_varyings();
#ifdef REFRACT_BUMP
    out_bump_world_from_object = mat3(frame.world_from_object);
    out_bump_at = transpose(out_bump_world_from_object) * (point - frame.center) * frame.bump_scale;
    if (constant_bump_uv != 0u)
        out_bump_at = vec3(uv * frame.bump_scale, 0.0);
    out_bump_slope = frame.bump_strength;
#endif
#ifdef REFRACT_PER_VERTEX
    vec3 e = primary_ray_dir(out_eye_to_point);
    out_reflected = optics_reflect(e, out_normal);
    for (int channel = 0; channel < 3; channel++)
        out_refracted[channel] = optics_refract(e, out_normal, frame.etas[channel]);
#endif
}
