/* trace_material.glsl: textured surface parameters at ray hits (C:
 * src/lab/reference/surroundings_radiance.c). */
#ifndef TRACE_MATERIAL_GLSL
#define TRACE_MATERIAL_GLSL
#include "object_material.h"
#include "trace/trace_shading.glsl"

/* Multiplies surface parameters by texels. Returns the outward normal from the normal map. The
 * normal is valid only if `is_bumpy` becomes true. */
vec3 trace_object_material(trace_hit hit, vec3 origin, vec3 dir, bool is_object,
                           inout object_material surface, out bool is_bumpy)
{
    uint material = trace_corner(BVH_CORNER_WORDS * max(hit.triangle, 0) + 1).w;
    uint row = material >> MESH_SURFACE_SHIFT;
    vec4 scales = material_texel(row, MATERIAL_ROW_SCALES);
    int iterations = is_object && scales.z > 0.0 ? int(trace.one) : 0;
    vec3 mapped_n = vec3(0.0);
    is_bumpy = false;
    while (iterations > 0) {
        iterations -= int(trace.one);
        trace_surface_point p = trace_surface_point_at(hit, origin, dir);
        lit_second_uv = p.other_uv;
        if (scales.z > 1.0)
            surface = object_material(material_texel(row, MATERIAL_ROW_EMISSION).rgb,
                                      material_texel(row, MATERIAL_ROW_FACTORS).y, scales.z - 2.0);
        vec3 base = lit_texel(textures, row, MATERIAL_BASE_COLOR, p.uv, 1.0).rgb;
        float rough = lit_texel(data_textures, row, MATERIAL_METALLIC_ROUGHNESS, p.uv, 1.0).g;
        float through = lit_texel(data_textures, row, MATERIAL_TRANSMISSION, p.uv, 1.0).r;
        vec4 texel = lit_texel(data_textures, row, MATERIAL_NORMAL, p.uv, 1.0);
        surface = object_material_of(surface, base, rough, through);
        is_bumpy = texel != vec4(1.0);
        mapped_n = trace_normal_mapped(p, p.outward, texel.rgb, scales.x);
    }
    return mapped_n;
}

#endif
