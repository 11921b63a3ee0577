/* ice_material_front.frag: fragment shader that writes the G-buffer of textured ice's front faces
 * and the radiance of the ice's opaque base. */
#version 460
#include "ice/ice_textured.glsl"

layout(location = 0) out vec4 front; /* outward unit normal, world; w: 1 */
layout(location = 1) out float depth;
layout(location = 2) out vec4 shading;        /* shading normal, world; w: Fresnel reflectance */
layout(location = 3) out vec4 material_front; /* surface transmittance; a: roughness */
layout(location = 4) out vec4 material_base_light; /* radiance of the opaque diffuse base */

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
    vec3 mapped_n;
    object_material material = ice_material_at(mapped_n);
    vec3 e = primary_ray_dir(eye_to_point);
    mapped_n = bump_facing(mapped_n, normalize(normal), e);
    front = vec4(mapped_n, 1.0);
    depth = gl_FragCoord.z;
    shading = vec4(mapped_n, fresnel_paper);
    material_front = vec4(material.tint * (1.0 - material.opacity), material.roughness);
    material_base_light = vec4(material.opacity * ice_material_base_radiance(mapped_n, -e), 1.0);
}
