/* ice_above_water.frag: ice above water. Reflected rays that point down are mirrored upwards. */
#version 460
#define WATER_WITH_ICE
#include "water/pool_radiance.glsl"

layout(location = REFRACT_EYE_TO_POINT) in vec3 eye_to_point;
layout(location = REFRACT_NORMAL) in vec3 normal;
layout(location = 0) out vec4 color;

void main()
{
    vec3 point = pool_from_world(frame.eye + eye_to_point);
    vec3 e = pool_from_world(constant_orthographic != 0u ? frame.forward : eye_to_point);
    e = normalize(e);
    vec3 n = normalize(pool_from_world(normal));
    vec3 inside = optics_refract(e, n, frame.eta);
    water_ground ground =
        water_radiance_along(ice_through(water_ray(point, inside, false, vec3(1.0))));
    vec3 r = optics_reflect(e, n);
    vec3 reflection = radiance_above(point, vec3(r.xy, abs(r.z)));
    vec3 radiance = optics_compose(reflection, ground.radiance, optics_fresnel(e, n, frame.eta));
    color = vec4(min(radiance, vec3(65504.0)), 1.0); /* largest half float */
}
