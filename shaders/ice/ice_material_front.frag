#version 460
#extension GL_GOOGLE_include_directive : require
#include "ice/ice_material.glsl"

layout(location = 0) out vec4 front; /* xyz: outward unit normal, world; w: 1 */
layout(location = 1) out float depth;
layout(location = 2) out vec4 shading; /* xyz: shading normal, world; w: Fresnel reflectance */
layout(location = 3) out vec4 material_front; /* rgb: transmittance of the surface; a: roughness */
layout(location = 4) out vec4 material_base_light; /* radiance of the opaque diffuse base */

/* Returns the radiance of the opaque diffuse base. */
vec3 ice_material_base_radiance(vec3 n, vec3 to_eye)
{
    vec3 albedo = color * lit_base(push.row, push.layer, uv, 1.0).rgb;
    lit_surface s = lit_surface_of(albedo, 0.0, 1.0, vec3(0.0), 0.0);
    vec3 sun = sky_sun();
    vec3 light = lit_diffuse(n) + sun * max(dot(n, frame.sun_dir), 0.0);
    return albedo * light + lit_by_lights(s, frame.eye + eye_to_point, n, to_eye);
}

void main()
{
    vec3 bent;
    object_material own = ice_material_at(bent);
    vec3 e = primary_ray_dir(eye_to_point);
    bent = bump_facing(bent, normalize(normal), e);
    front = vec4(bent, 1.0);
    depth = gl_FragCoord.z;
    shading = vec4(bent, fresnel_paper);
    material_front = vec4(own.tint * (1.0 - own.opacity), own.roughness);
    material_base_light = vec4(own.opacity * ice_material_base_radiance(bent, -e), 1.0);
}
