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

void main()
{
    if (constant_backdrop != GLOBALS_BACKDROP_ENVIRONMENT && push.inverse == 0u) {
        bool is_backdrop = constant_backdrop == GLOBALS_BACKDROP_COLOR;
        color = is_backdrop ? vec4(frame.background_color, 1.0) : vec4(0.0);
        return;
    }
    vec3 radiance = environment_radiance(environment, normalize(dir), push.environment_lod);
    color = vec4(radiance, push.inverse != 0u ? 0.0 : 1.0);
}
