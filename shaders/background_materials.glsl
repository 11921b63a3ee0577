/* background_materials.glsl: main() of surroundings with materials; with BACKGROUND_SHINE, with the
 * ice's caustics and shadow; with BACKGROUND_EXTRA, with struct mesh_extra of the vertices; with
 * BACKGROUND_MIRROR, with what is mirrored apart from the picture that shows it. */
#include "background.h"
#include "lib/contact.glsl"
#include "lib/lit.glsl"
#include "lib/octahedron.glsl"
#include "lib/see_through.glsl"
#include "mesh.h"

layout(push_constant, scalar) uniform Push
{
    background_push push;
};

layout(location = 0) in vec3 eye_to_point;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 base_color;
layout(location = 3) in vec2 uv;
layout(location = 4) flat in uint material;
#ifdef BACKGROUND_EXTRA
layout(location = 5) in vec2 other_uv;
layout(location = 6) in vec4 tangent;
#endif
layout(location = 0) out vec4 color;
#ifdef BACKGROUND_MIRROR
layout(location = BACKGROUND_OUT_SURFACE) out vec4 out_surface;
layout(location = BACKGROUND_OUT_GLOSSY) out vec4 out_glossy;
#endif

/* Returns a vector along the ray that sees the point. */
vec3 seen_along()
{
    return constant_orthographic != 0u && push.inverse == 0u ? push.forward : eye_to_point;
}

#ifdef BACKGROUND_SHINE
#include "lib/ice_shine.glsl"
#endif

/* Returns the side of a square as large as a pixel on the surface, by the pixel's longer side, but
 * at least 1/2. */
float square_blur()
{
    vec2 x = dFdx(uv), y = dFdy(uv);
    float longer = max(dot(x, x), dot(y, y));
    float area = abs(x.x * y.y - x.y * y.x);
    return longer > 0.0 ? clamp(sqrt(area / longer), 0.5, 1.0) : 1.0;
}

/* Returns the light of the sun, as lit.h counts it, and what of it is that of caustics. */
vec3 sun_light(out vec3 through)
{
    through = vec3(0.0);
#ifdef BACKGROUND_SHINE
    ice_shine shine = ice_shine_at(push.eye + eye_to_point, normalize(normal));
    through = sky_sun() * shine.through;
    return sky_sun() * (shine.own * shine.open) + through;
#else
    return sky_sun();
#endif
}

void main()
{
#ifdef BACKGROUND_EXTRA
    lit_other_uv = other_uv;
    lit_tangent = tangent;
#endif
    uint row = material >> MESH_SURFACE_SHIFT;
    float tiled = constant_tiled != 0u ? exp2(frame.lod_bias) : 1.0;
    float blur = push.inverse != 0u ? square_blur() : tiled;
    vec4 factors = material_texel(row, MATERIAL_ROW_FACTORS);
    vec4 reflectance = material_texel(row, MATERIAL_ROW_F0);
    vec4 emission = material_texel(row, MATERIAL_ROW_EMISSION);
    vec4 scales = material_texel(row, MATERIAL_ROW_SCALES);
    vec4 base = lit_base(row, material & MESH_TEXTURE_MASK, uv, blur);
    vec4 rough = lit_texel(numbers, row, MATERIAL_USE_METALLIC_ROUGHNESS, uv, blur);
    vec4 bent = lit_texel(numbers, row, MATERIAL_USE_NORMAL, uv, blur);
    float open = lit_texel(numbers, row, MATERIAL_USE_OCCLUSION, uv, blur).r;
    vec3 glow = lit_texel(textures, row, MATERIAL_USE_EMISSION, uv, blur).rgb * emission.rgb;
    float specular = lit_texel(numbers, row, MATERIAL_USE_SPECULAR, uv, blur).a * factors.z;
    vec3 f0 = lit_texel(textures, row, MATERIAL_USE_SPECULAR_COLOR, uv, blur).rgb * reflectance.rgb;

    vec3 albedo = base_color * base.rgb;
    float alpha = push.inverse != 0u ? 1.0 / length(eye_to_point) : 1.0;
    vec3 to_eye = -normalize(seen_along());
    vec3 n = normalize(normal);
    n = dot(n, to_eye) < 0.0 ? -n : n;
    vec3 top = n; /* of the surface that mirrors; n is that of the matt base */
    if (bent != vec4(1.0))
        n = LIT_BEND(row, n, normal, bent.rgb, scales.xy, eye_to_point, uv);
    top = scales.w > 0.0 ? top : n;
    vec3 mirrored = reflect(-to_eye, top);
    float lod = lit_mirror_lod(mirrored, push.environment_lod);
    if (is_hole(base.a * factors.w, reflectance.w, emission.w, row))
        discard;
    vec3 through;
    vec3 sun = sun_light(through);
#ifdef BACKGROUND_MIRROR
    out_surface = out_glossy = vec4(0.0);
#endif
    if ((material & MESH_UNLIT) != 0u) {
        color = vec4(albedo * (1.0 + through * max(dot(n, frame.sun_dir), 0.0)), alpha);
        return;
    }
    lit_surface s = lit_surface_of(albedo, factors.x * rough.b, factors.y * rough.g, f0, specular);
    float n_dot_v = clamp(dot(top, to_eye), 0.0, 1.0);
    lit_shares shares = lit_shares_of(s, lit_split(s.roughness, n_dot_v));
    vec3 glossy = shares.glossy * lit_glossy(mirrored, s.roughness, lod);
    vec3 on_matt = lit_matt(n), matt = shares.matt * on_matt;
    contact_shade(s, shares, push.eye + eye_to_point, n, on_matt, matt, glossy);
    sun *= lit_by_light_on(s, top, n, to_eye, frame.sun_dir, frame.sun_spread);
    vec3 lit = lit_by_lights_on(s, push.eye + eye_to_point, top, n, to_eye);
    open = mix(1.0, open, scales.y);
    color = vec4((glossy + matt) * open + sun + lit + glow, alpha);
#ifdef BACKGROUND_MIRROR
    float share = dot(shares.glossy, vec3(1.0 / 3.0));
    out_surface = vec4(octahedron_of(top), s.roughness, share * open);
    out_glossy = vec4(glossy * open, 0.0);
#endif
}
