/* refract_fullscreen.vert: full-screen triangle for refraction models that shade each pixel. With
 * REFRACT_FULLSCREEN_WITH_MEAN, also computes the mean radiance of the environment. */
#version 460
#define REFRACT_FULLSCREEN_VERTEX
#define HIGHLIGHT_VERTEX
#include "lib/primary_ray.glsl"
#include "lighting/highlight.glsl"
#include "refract/refract_uniforms.glsl"

layout(location = REFRACT_VIEW_RAY) out vec3 out_view_ray;

#ifdef REFRACT_FULLSCREEN_WITH_MEAN
layout(set = 0, binding = REFRACT_ENV_CUBE) uniform samplerCube env_cube;
layout(location = REFRACT_FULLSCREEN_MEAN) flat out vec3 out_mean;
layout(location = REFRACT_FULLSCREEN_MEAN, component = 3) flat out float out_nearest; /* 1/m */

const uint mean_count = 256u;
const float mean_golden = 2.39996323; /* golden angle, radians */
const float mean_brightest = 16.0;    /* maximum radiance; limits sparse sun samples */

/* Computes the cube map's mean radiance and nearest distance from directions along a spiral. */
void mean_compute()
{
    vec3 sum = vec3(0.0);
    float nearest = 0.0;
    for (uint i = 0u; i < mean_count; i++) {
        float y = 1.0 - (2.0 * float(i) + 1.0) / float(mean_count);
        float angle = mean_golden * float(i);
        vec2 xz = sqrt(1.0 - y * y) * vec2(cos(angle), sin(angle));
        vec4 texel = textureLod(env_cube, vec3(xz.x, y, xz.y), 0.0);
        sum += min(texel.rgb, vec3(mean_brightest));
        nearest = max(nearest, texel.a);
    }
    out_mean = sum / float(mean_count);
    out_nearest = nearest;
}
#endif

/* Draws a full-screen triangle behind all faces, so that the depth test finds pixels with faces. */
void main()
{
    vec2 corner = vec2(gl_VertexIndex == 1 ? 3.0 : -1.0, gl_VertexIndex == 2 ? 3.0 : -1.0);
    gl_Position = vec4(corner, 0.0, 1.0);
    out_view_ray = primary_ray(corner);
    highlight_write_varyings();
    refract_frame_write();
#ifdef REFRACT_FULLSCREEN_WITH_MEAN
    mean_compute();
#endif
}
