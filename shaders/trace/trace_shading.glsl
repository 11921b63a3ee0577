/* trace_shading.glsl: shading of surroundings at ray hits: material, sun, environment, lights. */
#ifndef TRACE_SHADING_GLSL
#define TRACE_SHADING_GLSL
#define LIT_NO_DERIVATIVES
/* photon tracing itself generates the map that sun_shadow_caustics.glsl reads */
#ifndef TRACE_PHOTONS
#include "lib/sun_shadow_caustics.glsl"
#endif
#include "lib/brdf_shading.glsl"
#include "mesh_layout.h"
#include "trace/trace_bvh.glsl"

/* Interpolated vertex attributes at a hit on surroundings. */
struct trace_surface_point {
    vec3 position, normal; /* world-space position and unit normal, which faces the ray */
    vec3 outward;          /* the interpolated vertex normal, not flipped */
    vec3 color;
    vec2 uv, other_uv;
    vec4 tangent;            /* unit tangent, with handedness in w; 0 if there is none */
    vec3 u_dir, minus_v_dir; /* derivatives of position by u, -v */
    uint material;
    float ior; /* refractive index of the medium in front of the surface, relative to the outside */
};

/* Diffuse and specular lobes of a shaded surface, for traced lighting. */
struct trace_lobes {
    vec3 diffuse, specular;            /* diffuse albedo and specular reflectance */
    vec3 unoccluded_diffuse, mirrored; /* unoccluded diffuse and specular lighting */
    vec3 normal, top;                  /* normals of diffuse base and specular layer */
    float roughness;
    bool is_lit;
};

trace_lobes lobes;          /* lobes at the last trace_shade() */
float sun_visibility = 1.0; /* the sun's visibility at the surface */
float sun_spread = 0.0;     /* sun's minimum specular lobe width */

/* Reads optional vertex attributes of a hit. Sets `side_1` and `side_2` to the triangle's edges in
 * the normal map's texture coordinates. */
void trace_vertex_extra(inout trace_surface_point p, trace_hit hit, int surface, bool has_extra,
                        inout vec2 side_1, inout vec2 side_2)
{
    p.other_uv = p.uv;
    p.tangent = vec4(0.0);
    if (!trace_has(TRACE_HAS_EXTRAS))
        return;
    int at = has_extra ? surface + BVH_SURFACE_WORDS : 0;
    vec3 bary = vec3(1.0 - hit.u - hit.v, hit.u, hit.v);
    vec4 t0 = uintBitsToFloat(trace_corner(at));
    vec4 t1 = uintBitsToFloat(trace_corner(at + 1));
    vec4 t2 = uintBitsToFloat(trace_corner(at + 2));
    vec4 uv = uintBitsToFloat(trace_corner(at + 3));
    vec2 uv_2 = uintBitsToFloat(trace_corner(at + 4)).xy;
    if (!has_extra)
        return;
    uint row = p.material >> MESH_SURFACE_SHIFT;
    vec4 v = material_texel(row, MATERIAL_ROW_TEXTURES + 2 * MATERIAL_NORMAL + 1);
    p.tangent = bary.x * t0 + bary.y * t1 + bary.z * t2;
    p.tangent.xyz = trace_posed(p.tangent.xyz, hit.bvh);
    p.other_uv = uv.xy + hit.u * (uv.zw - uv.xy) + hit.v * (uv_2 - uv.xy);
    if (v.w >= float(MATERIAL_OTHER_SET)) {
        side_1 = uv.zw - uv.xy;
        side_2 = uv_2 - uv.xy;
    }
}

trace_surface_point trace_surface_point_at(trace_hit hit, vec3 origin, vec3 dir)
{
    int at = BVH_CORNER_WORDS * hit.triangle;
    vec4 n0 = uintBitsToFloat(trace_corner(at));
    vec4 n1 = uintBitsToFloat(trace_corner(at + 1));
    vec4 n2 = uintBitsToFloat(trace_corner(at + 2));
    int surface = int(floatBitsToUint(n2.w) & ~BVH_CONTACT_MASK);
    vec4 c0 = uintBitsToFloat(trace_corner(surface));
    vec4 c1 = uintBitsToFloat(trace_corner(surface + 1));
    vec4 c2 = uintBitsToFloat(trace_corner(surface + 2));
    vec4 rest = uintBitsToFloat(trace_corner(surface + 3));
    vec3 bary = vec3(1.0 - hit.u - hit.v, hit.u, hit.v);
    vec2 uv_0 = vec2(c0.w, c1.w), side_1 = vec2(c2.w, rest.x) - uv_0, side_2 = rest.yz - uv_0;
    trace_surface_point p;
    p.position = origin + hit.t * dir;
    p.normal = bary.x * n0.xyz + bary.y * n1.xyz + bary.z * n2.xyz;
    p.normal = normalize(trace_posed(p.normal, hit.bvh));
    p.outward = p.normal;
    p.normal *= dot(p.normal, dir) > 0.0 ? -1.0 : 1.0;
    p.color = bary.x * c0.xyz + bary.y * c1.xyz + bary.z * c2.xyz;
    p.uv = uv_0 + hit.u * side_1 + hit.v * side_2;
    p.material = floatBitsToUint(n1.w);
    p.ior = 1.0;
    /* The stored matrix rows are dual to the triangle's edges. Cross products recover the edges. */
    at = BVH_TRIANGLE_WORDS * hit.triangle;
    vec3 row_0 = uintBitsToFloat(trace_row(at)).xyz;
    vec3 row_1 = uintBitsToFloat(trace_row(at + 1)).xyz;
    vec3 row_2 = uintBitsToFloat(trace_row(at + 2)).xyz;
    float volume = dot(row_0, cross(row_1, row_2));
    vec3 edge_1 = cross(row_1, row_2) / volume, edge_2 = cross(row_2, row_0) / volume;
    bool has_extra = (floatBitsToUint(rest.w) & 1u) != 0u;
    trace_vertex_extra(p, hit, surface, has_extra, side_1, side_2);
    float handedness = sign(side_1.x * side_2.y - side_2.x * side_1.y);
    p.u_dir = trace_posed(handedness * (edge_1 * side_2.y - edge_2 * side_1.y), hit.bvh);
    p.minus_v_dir = trace_posed(-handedness * (edge_2 * side_1.x - edge_1 * side_2.x), hit.bvh);
    return p;
}

/* Returns normal `n`, on either side of the surface, perturbed by the normal map. */
vec3 trace_normal_mapped(trace_surface_point p, vec3 n, vec3 texel, float scale)
{
    vec3 u_dir = p.u_dir, minus_v_dir = p.minus_v_dir;
    if (trace_has(TRACE_HAS_EXTRAS) && p.tangent.w != 0.0) {
        u_dir = p.tangent.xyz;
        minus_v_dir = normal_map_bitangent(n, p.outward, p.tangent);
    }
    return normal_map_by_axes(n, texel, scale, u_dir, minus_v_dir);
}

/* Returns the sunlight on a surface that faces the sun, as radiance of a white diffuse surface.
 * Sets `through` to the part that objects refract. If `is_base` (opaque base), ignores shadows. */
vec3 trace_sun(trace_surface_point p, bool is_base, out vec3 through)
{
    through = vec3(0.0);
    float visibility = trace_has(TRACE_HAS_DIFFUSE_LIGHT) && !is_base ? sun_visibility : 1.0;
#ifndef TRACE_PHOTONS
    if (trace_has(TRACE_HAS_SUN_MAPS) && !is_base) {
        sun_shadow shadow = sun_shadow_at(p.position, p.outward);
        visibility = trace_has(TRACE_HAS_DIFFUSE_LIGHT) ? visibility : shadow.visibility;
        through = sky_sun() * shadow.refracted;
        return sky_sun() * shadow.direct * visibility + through;
    }
#endif
    return sky_sun() * visibility;
}

/* Returns the radiance of a diffuse surface without material, or of an object's opaque base. */
vec3 trace_diffuse(trace_surface_point p, vec3 to_eye, vec3 albedo, bool is_base)
{
    vec3 through;
    vec3 sun = trace_sun(p, is_base, through) * max(dot(p.normal, frame.sun_dir), 0.0);
    if (constant_lit == 0u || (p.material & MESH_UNLIT) != 0u)
        return albedo * (1.0 + through * max(dot(p.normal, frame.sun_dir), 0.0));
    vec3 ambient = trace_has(TRACE_HAS_MATERIALS) ? lit_diffuse(p.normal) : sky_ambient(p.normal);
    lobes = trace_lobes(albedo, vec3(0.0), ambient, ambient, p.normal, p.normal, 1.0, !is_base);
    if (!trace_has(TRACE_HAS_MATERIALS))
        return albedo * (trace_has(TRACE_HAS_SUN_MAPS | TRACE_HAS_DIFFUSE_LIGHT)
                             ? sky_ambient(p.normal) + sun
                             : sky_light(p.normal));
    lit_surface s = lit_surface_of(albedo, 0.0, 1.0, vec3(0.0), 0.0);
    return albedo * (lit_diffuse(p.normal) + sun) + lit_by_lights(s, p.position, p.normal, to_eye);
}

/* Returns the fraction of light that passes through an alpha-blended or alpha-tested surface. */
float trace_alpha_transmittance_of(uint row, float alpha)
{
    vec4 factors = material_texel(row, MATERIAL_ROW_FACTORS);
    float kind = material_texel(row, MATERIAL_ROW_F0).w;
    alpha *= factors.w;
    if (kind == float(MATERIAL_KIND_BLENDED))
        return 1.0 - alpha;
    float cutoff = material_texel(row, MATERIAL_ROW_EMISSION).w;
    return kind == float(MATERIAL_KIND_CUTOUT) && alpha < cutoff ? 1.0 : 0.0;
}

/* Returns the fraction of light that passes through the surface at a hit. */
float trace_alpha_transmittance(trace_surface_point p)
{
    uint row = p.material >> MESH_SURFACE_SHIFT;
    uint layer = p.material & MESH_TEXTURE_MASK;
    lit_second_uv = p.other_uv;
    if (!trace_has(TRACE_HAS_MATERIALS)) {
        vec3 at = vec3(p.uv, float(max(layer, 1u) - 1u));
        bool is_cut = constant_textured != 0u && layer != 0u && (p.material & MESH_CUTOUT) != 0u;
        return is_cut && textureLod(textures, at, 0.0).a < 0.5 ? 1.0 : 0.0;
    }
    return trace_alpha_transmittance_of(row, lit_base(row, layer, p.uv, 1.0).a);
}

/* Returns a surface's radiance with its clear coat; `base` is the radiance without it. Updates
 * `lobes`. `unhidden` is the occlusion factor. */
vec3 trace_coated(lit_material m, trace_surface_point p, vec3 dir, vec3 base, vec3 unhidden,
                  vec3 sun, float spread)
{
    lit_coat c = lit_coat_of(m, p.position, p.normal, -dir, 0.0, sun, spread);
    lobes.diffuse *= 1.0 - c.reflectance;
    lobes.specular *= 1.0 - c.reflectance;
    vec3 reflected = c.reflectance * unhidden;
    if (lit_coat_is_stronger(c.reflectance, lobes.specular)) {
        lobes.specular = reflected;
        lobes.mirrored = c.environment;
        lobes.top = p.normal;
        lobes.roughness = m.coat_roughness;
    }
    return (1.0 - c.reflectance) * base + reflected * c.environment + c.direct;
}

/* Returns a surface's radiance; sets `passing` to the transmitted fraction of light. */
vec3 trace_shade(trace_surface_point p, vec3 dir, bool is_base, out float passing)
{
    uint row = p.material >> MESH_SURFACE_SHIFT;
    uint layer = p.material & MESH_TEXTURE_MASK;
    passing = 0.0;
    lobes.is_lit = false;
    lit_second_uv = p.other_uv;
    if (!trace_has(TRACE_HAS_MATERIALS)) {
        vec4 texel = vec4(1.0);
        if (constant_textured != 0u) {
            texel = textureLod(textures, vec3(p.uv, float(max(layer, 1u) - 1u)), 0.0);
            texel = layer != 0u ? texel : vec4(1.0);
        }
        passing = (p.material & MESH_CUTOUT) != 0u && texel.a < 0.5 ? 1.0 : 0.0;
        return trace_diffuse(p, -dir, p.color * texel.rgb, is_base);
    }
    vec4 base = lit_base(row, layer, p.uv, 1.0);
    vec3 albedo = p.color * base.rgb;
    if (trace_has(TRACE_HAS_HOLES))
        passing = trace_alpha_transmittance_of(row, base.a);
    if (is_base || (p.material & MESH_UNLIT) != 0u)
        return trace_diffuse(p, -dir, albedo, is_base);
    lit_material m = lit_material_at(row, p.uv, 1.0, albedo, p.ior);
    lit_surface s = m.surface;
    if (lit_is_shadow_catcher(row))
        s.diffuse = lit_catcher_albedo(p.normal, environment_radiance(environment, dir, 0.0));
    vec3 n = p.normal;
    if (m.normal_texel != vec4(1.0))
        n = trace_normal_mapped(p, n, m.normal_texel.rgb, m.scales.x);
    vec3 top = m.scales.w > 0.0 ? p.normal : n;
    float n_dot_v = clamp(dot(top, -dir), 0.0, 1.0);
    vec2 split = lit_split(s.roughness, n_dot_v);
    vec3 mirrored = lit_specular(reflect(dir, top), s.roughness, 0.0),
         unoccluded_diffuse = lit_diffuse(n);
    vec3 ambient = lit_by_environment(s, split, mirrored, unoccluded_diffuse);
    /* traced rays replace the occlusion texture */
    vec3 unhidden = vec3(trace_has(TRACE_HAS_DIFFUSE_LIGHT) ? 1.0 : m.occlusion);
    lobes = trace_lobes(lit_by_environment(s, split, vec3(0.0), unhidden),
                        lit_by_environment(s, split, unhidden, vec3(0.0)), unoccluded_diffuse,
                        mirrored, n, top, s.roughness, true);
    vec3 through;
    float spread = max(frame.sun_spread, sun_spread);
    vec3 sun = trace_sun(p, false, through);
    vec3 light = ambient * unhidden + sun * lit_by_light_on(s, top, n, -dir, frame.sun_dir, spread);
    light += lit_by_lights_on(s, p.position, top, n, -dir) + m.emission;
    return lit_has_coats() && m.coat > 0.0 ? trace_coated(m, p, dir, light, unhidden, sun, spread)
                                           : light;
}

#endif
