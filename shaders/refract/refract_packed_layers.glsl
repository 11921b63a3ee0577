/* refract_packed_layers.glsl: AOVs of a refracted path, packed into three colour targets of the
 * pass that draws the image. refract_unpack_layers.frag writes them to the layers' own images. */
#ifndef REFRACT_PACKED_LAYERS_GLSL
#define REFRACT_PACKED_LAYERS_GLSL
#include "refract/refract.h"

struct refract_layers {
    float depth; /* depth-buffer value of the front surface; 0 if there is none */
    vec3 exit;
    vec3 refraction, reflection;
    float fresnel, path;
    uint bounces, tir, segments;
    uint last; /* number of the last object hit; 0 if it is the first surface's */
};

uint refract_pack_counts(refract_layers layers)
{
    return min(layers.bounces, 0xfffu) | min(layers.segments, 0xfffu) << 12 | layers.tir << 24;
}

#ifdef REFRACT_PACKED_LAYERS
#ifdef TRACE_DENOISE
#define REFRACT_OUT_FIRST REFRACT_OUT_PACKED_DENOISE
#else
#define REFRACT_OUT_FIRST REFRACT_OUT_PACKED
#endif
layout(location = REFRACT_OUT_FIRST) out uvec4 out_packed_path;
layout(location = REFRACT_OUT_FIRST + 1) out uvec4 out_packed_light;
layout(location = REFRACT_OUT_FIRST + 2) out uvec4 out_packed_counts;

void refract_write_layers(refract_layers layers)
{
    vec3 refraction = layers.refraction, reflection = layers.reflection;
    out_packed_path = uvec4(floatBitsToUint(layers.exit), floatBitsToUint(layers.depth));
    out_packed_light =
        uvec4(packHalf2x16(refraction.rg), packHalf2x16(vec2(refraction.b, reflection.r)),
              packHalf2x16(reflection.gb), floatBitsToUint(layers.fresnel));
    out_packed_counts =
        uvec4(floatBitsToUint(layers.path), refract_pack_counts(layers), layers.last, 0u);
}
#else
float refract_packed_depth(uvec4 path)
{
    return uintBitsToFloat(path.w);
}

vec3 refract_packed_refraction(uvec4 light)
{
    return vec3(unpackHalf2x16(light.x), unpackHalf2x16(light.y).x);
}

vec3 refract_packed_reflection(uvec4 light)
{
    return vec3(unpackHalf2x16(light.y).y, unpackHalf2x16(light.z));
}

float refract_packed_bounces(uvec4 counts)
{
    return float(counts.y & 0xfffu);
}

float refract_packed_segments(uvec4 counts)
{
    return float(counts.y >> 12 & 0xfffu);
}

float refract_packed_tir(uvec4 counts)
{
    return float(counts.y >> 24);
}
#endif

#endif
