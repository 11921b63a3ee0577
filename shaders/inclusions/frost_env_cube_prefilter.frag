/* frost_env_cube_prefilter.frag: fragment shader that prefilters the environment cube map for
 * frost. */
#version 460
#include "inclusions/frost.h"
#include "lib/globals.glsl"

layout(push_constant, scalar) uniform Push
{
    frost_cube_push push;
};

layout(set = 0, binding = FROST_ENV_CUBE) uniform samplerCube env_cube;

layout(location = 0) out vec4 color;

const uint count = 128u;
const float golden = 2.39996323; /* golden angle, radians */
const float brightest = 16.0;    /* maximum radiance of a sample; prevents spots from the sun */

/* Computes the mean radiance that frost scatters into a direction. The slopes of its crystals are
 * GGX-distributed. A slope of angle d deflects light by (n - 1) d, with refractive index n. */
void main()
{
    vec2 ndc = gl_FragCoord.xy / float(FROST_CUBE_SIZE) * 2.0 - 1.0;
    vec3 dir = normalize(push.forward + ndc.x * push.right - ndc.y * push.up);
    vec3 u = normalize(cross(dir, abs(dir.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0)));
    vec3 v = cross(dir, u);
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < count; i++) {
        float s = (float(i) + 0.5) / float(count);
        float bend = (1.0 / frame.eta - 1.0) * atan(push.spread * sqrt(s / (1.0 - s)));
        float azimuth = golden * float(i);
        vec3 side = cos(azimuth) * u + sin(azimuth) * v;
        vec3 radiance = texture(env_cube, cos(bend) * dir + sin(bend) * side).rgb;
        sum += min(radiance, vec3(brightest));
    }
    color = vec4(sum / float(count), 1.0);
}
