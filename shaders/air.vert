#version 460
#extension GL_GOOGLE_include_directive : require
#include "air.h"
#include "lib/constants.glsl"
#include "lib/pose.glsl"
#include "lib/sky.glsl"

layout(set = 0, binding = AIR_ENVIRONMENT) uniform sampler2D environment;

layout(location = MESH_POSITION) in vec3 position;
layout(location = MESH_NORMAL) in vec3 normal;
layout(location = MESH_UV) in vec2 uv;
layout(location = MESH_MATERIAL) in uint material;

layout(location = 0) out vec3 out_uv; /* z: the layer */
layout(location = 1) out vec3 out_light;
layout(location = 2) out vec3 out_eye_to_point;
layout(location = 3) out vec3 out_normal;

/* Mean radiance of the environment picture, by solid angle. */
vec3 mean_environment()
{
    int lod = max(textureQueryLevels(environment) - 4, 0);
    ivec2 size = textureSize(environment, lod);
    vec4 sum = vec4(0.0);
    for (int y = 0; y < size.y; y++) {
        float weight = sin((float(y) + 0.5) / float(size.y) * 3.14159265);
        for (int x = 0; x < size.x; x++)
            sum += weight * vec4(texelFetch(environment, ivec2(x, y), lod).rgb, 1.0);
    }
    return sum.rgb / sum.w;
}

/* What white matter sends out that scatters light so often that it forgets where it came from. */
vec3 scattered()
{
    if (constant_background == GLOBALS_COLOR)
        return frame.background_color;
    if (constant_background == GLOBALS_ENVIRONMENT)
        return mean_environment();
    return 0.5 * (sky_light(frame.sun_dir) + sky_light(-frame.sun_dir));
}

void main()
{
    vec3 point = pose_object(position);
    gl_Position = frame.fitted_clip_from_world * vec4(point, 1.0);
    out_eye_to_point = point - frame.eye;
    out_normal = pose_object_normal(normal);
    out_uv = vec3(uv, float((material & MESH_TEXTURE_MASK) - 1u));
    out_light = scattered();
}
