/* surroundings_sky.frag: fragment shader of the background: radiance of the environment. */
#version 460
#include "lib/environment_radiance.glsl"
#include "surroundings/surroundings.h"

layout(push_constant, scalar) uniform Push
{
    surroundings_push push;
};

layout(set = 0, binding = SURROUNDINGS_ENVIRONMENT) uniform sampler2D environment;

layout(location = 0) in vec3 dir;
layout(location = 0) out vec4 color;

/* Returns the mean of 4 x 4 lookups, one texel of the blurred mip level apart. A single lookup
 * would show that level's texels. */
vec3 blurred_radiance(vec3 dir)
{
    float texel = 6.2831853 / float(textureSize(environment, 0).x) * exp2(push.background_lod);
    vec3 right = texel * normalize(push.right), up = texel * normalize(push.up);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < 16; i++) {
        vec2 at = vec2(i & 3, i >> 2) - 1.5;
        vec3 tap = normalize(dir + at.x * right + at.y * up);
        sum += environment_radiance(environment, tap, push.background_lod);
    }
    return sum / 16.0;
}

void main()
{
    if (constant_backdrop != GLOBALS_BACKDROP_ENVIRONMENT && push.inverse == 0u) {
        bool is_backdrop = constant_backdrop == GLOBALS_BACKDROP_COLOR;
        color = is_backdrop ? vec4(frame.background_color, 1.0) : vec4(0.0);
        return;
    }
    vec3 radiance = push.background_lod > push.environment_lod
                        ? blurred_radiance(normalize(dir))
                        : environment_radiance(environment, normalize(dir), push.environment_lod);
    color = vec4(radiance, push.inverse != 0u ? 0.0 : 1.0);
}
