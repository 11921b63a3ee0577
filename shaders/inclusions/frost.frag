/* frost.frag: fragment shader of frost on the ice's surface, blended over the image. */
#version 460
#include "inclusions/frost.h"
#include "lib/globals.glsl"
#include "lib/procedural_sky.glsl"
#include "lib/specialization_constants.glsl"
#include "lighting/bump_map_sampling.glsl"
#include "refract/refract.h"

layout(push_constant, scalar) uniform Push
{
    frost_push push;
};

layout(set = 0, binding = FROST_CUBE) uniform samplerCube blurred;
layout(set = 0, binding = FROST_EXIT) uniform sampler2D exit_dir;

layout(location = REFRACT_EYE_TO_POINT) in vec3 eye_to_point;
layout(location = REFRACT_NORMAL) in vec3 normal;

layout(location = 0) out vec4 color; /* premultiplied alpha */

/* Returns the irradiance from the procedural sky or, if there is none, the blurred cube map. */
vec3 light_on(vec3 n)
{
    if (constant_background == GLOBALS_SKY)
        return sky_light(n);
    return texture(blurred, n).rgb;
}

/* Blends the blurred view through thin frost with the white diffuse surface of thick frost. */
void main()
{
    vec3 n = normalize(normal);
    vec2 mask = bump_mask_here(n);
    float opacity = push.amount * (1.0 - mask.r) * mask.g;
    vec3 behind = texture(blurred, texelFetch(exit_dir, ivec2(gl_FragCoord.xy), 0).xyz).rgb;
    color = vec4(opacity * mix(behind, light_on(n), opacity), opacity);
}
