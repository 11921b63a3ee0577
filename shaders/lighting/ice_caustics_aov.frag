/* ice_caustics_aov.frag: fragment shader of the sunlight AOV, with shadows and ice caustics. */
#version 460
#include "lib/sun_shadow_caustics.glsl"
#include "surroundings/surroundings.h"

layout(push_constant, scalar) uniform Push
{
    surroundings_push push;
};

layout(location = 0) in vec3 eye_to_point;
layout(location = 1) in vec3 normal;
layout(location = 0) out float sunlight;

void main()
{
    sun_shadow shadow = sun_shadow_at(push.eye + eye_to_point, normalize(normal));
    sunlight = shadow.direct * shadow.visibility + shadow.refracted.g;
}
