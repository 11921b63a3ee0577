/* refract_unpack_layers.frag: writes packed AOVs of the refraction to the layers' images. Pixels
 * whose refractive object is hidden by surroundings become 0. Without macros, writes the exit
 * direction; with UNPACK_LIGHT, radiance and reflectance; with UNPACK_COUNTS, the path's length and
 * reflections; with UNPACK_TRACED, layers that only ray-traced models have. */
#version 460
#include "refract/refract_packed_layers.glsl"

layout(set = 0, binding = REFRACT_PACKED_PATH) uniform usampler2D packed_path;
layout(set = 0, binding = REFRACT_DEPTH_SCENE) uniform sampler2D depth_scene;
#ifdef UNPACK_LIGHT
layout(set = 0, binding = REFRACT_PACKED_MORE) uniform usampler2D packed_light;

layout(location = 0) out vec4 out_refraction;
layout(location = 1) out vec4 out_reflection;
layout(location = 2) out float out_fresnel;
#elif defined(UNPACK_COUNTS)
layout(set = 0, binding = REFRACT_PACKED_MORE) uniform usampler2D packed_counts;

layout(location = 0) out vec4 out_path;
#elif defined(UNPACK_TRACED)
layout(set = 0, binding = REFRACT_PACKED_MORE) uniform usampler2D packed_counts;
layout(set = 0, binding = REFRACT_FIRST_OBJECT) uniform sampler2D first_object;

layout(location = 0) out float out_media;
layout(location = 1) out float out_last;
#else
layout(location = 0) out vec4 out_exit;
#endif

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    uvec4 path = texelFetch(packed_path, pixel, 0);
    bool is_hidden = refract_packed_depth(path) < texelFetch(depth_scene, pixel, 0).r;
#ifdef UNPACK_LIGHT
    uvec4 light = is_hidden ? uvec4(0u) : texelFetch(packed_light, pixel, 0);
    out_refraction = vec4(refract_packed_refraction(light), 0.0);
    out_reflection = vec4(refract_packed_reflection(light), 0.0);
    out_fresnel = uintBitsToFloat(light.w);
#elif defined(UNPACK_COUNTS)
    uvec4 counts = is_hidden ? uvec4(0u) : texelFetch(packed_counts, pixel, 0);
    out_path = vec4(uintBitsToFloat(counts.x), refract_packed_bounces(counts),
                    refract_packed_tir(counts), 0.0);
#elif defined(UNPACK_TRACED)
    uvec4 counts = is_hidden ? uvec4(0u) : texelFetch(packed_counts, pixel, 0);
    out_media = refract_packed_segments(counts);
    out_last = counts.z != 0u ? float(counts.z) : texelFetch(first_object, pixel, 0).r;
#else
    out_exit = is_hidden ? vec4(0.0) : vec4(uintBitsToFloat(path.xyz), 0.0);
#endif
}
