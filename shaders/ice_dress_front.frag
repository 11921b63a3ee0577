#version 460
#extension GL_GOOGLE_include_directive : require
#include "ice_dress.glsl"

layout(location = 0) out vec4 front; /* xyz: outward unit normal, world; w: 1 */
layout(location = 1) out float depth;
layout(location = 2) out vec4 shading;     /* xyz: shading normal, world; w: Fresnel reflectance */
layout(location = 3) out vec4 dress_front; /* rgb: transmittance of the surface; a: roughness */
layout(location = 4) out vec4 dress_shine; /* radiance of the opaque diffuse base */

/* Returns the radiance of the opaque diffuse base. */
vec3 ice_dress_matt(vec3 n, vec3 to_eye)
{
    vec3 albedo = color * lit_base(push.row, push.layer, uv, 1.0).rgb;
    lit_surface s = lit_surface_of(albedo, 0.0, 1.0, vec3(0.0), 0.0);
    vec3 sun = sky_sun();
    vec3 light = lit_matt(n) + sun * max(dot(n, frame.sun_dir), 0.0);
    return albedo * light + lit_by_lights(s, frame.eye + eye_to_point, n, to_eye);
}

void main()
{
    vec3 bent;
    dress own = ice_dress_at(bent);
    vec3 e = view_dir(eye_to_point);
    bent = bump_facing(bent, normalize(normal), e);
    front = vec4(bent, 1.0);
    depth = gl_FragCoord.z;
    shading = vec4(bent, fresnel_paper);
    dress_front = vec4(own.tint * (1.0 - own.shine), own.roughness);
    dress_shine = vec4(own.shine * ice_dress_matt(bent, -e), 1.0);
}
