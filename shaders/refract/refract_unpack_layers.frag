/* refract_unpack_layers.frag: writes packed AOVs of the refraction to the layers' images. Pixels
 * whose refractive object is hidden by surroundings become 0. With REFRACT_TRACED, writes the layers
 * that only models that trace rays have. */
#version 460
#include "refract/refract_packed_layers.glsl"

layout(set = 0, binding = REFRACT_PACKED_PATH) uniform usampler2D packed_path;
layout(set = 0, binding = REFRACT_PACKED_LIGHT) uniform usampler2D packed_light;
layout(set = 0, binding = REFRACT_PACKED_COUNTS) uniform usampler2D packed_counts;
layout(set = 0, binding = REFRACT_DEPTH_SCENE) uniform sampler2D depth_scene;

#ifdef REFRACT_TRACED
layout(set = 0, binding = REFRACT_FIRST_OBJECT) uniform sampler2D first_object;

layout(location = REFRACT_OUT_MEDIA) out float out_media;
layout(location = REFRACT_OUT_LAST) out float out_last;
#else
layout(location = REFRACT_OUT_EXIT) out vec4 out_exit;
layout(location = REFRACT_OUT_REFRACTION) out vec4 out_refraction;
layout(location = REFRACT_OUT_REFLECTION) out vec4 out_reflection;
layout(location = REFRACT_OUT_FRESNEL) out float out_fresnel;
layout(location = REFRACT_OUT_PATH) out vec4 out_path;
#endif

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    refract_layers layers =
        refract_unpack(texelFetch(packed_path, pixel, 0), texelFetch(packed_light, pixel, 0),
                       texelFetch(packed_counts, pixel, 0));
    if (layers.depth < texelFetch(depth_scene, pixel, 0).r)
        layers = refract_unpack(uvec4(0u), uvec4(0u), uvec4(0u));
#ifdef REFRACT_TRACED
    float first = texelFetch(first_object, pixel, 0).r;
    out_media = float(layers.segments);
    out_last = layers.last != 0u ? float(layers.last) : first;
#else
    out_exit = vec4(layers.exit, 0.0);
    out_refraction = vec4(layers.refraction, 0.0);
    out_reflection = vec4(layers.reflection, 0.0);
    out_fresnel = layers.fresnel;
    out_path = vec4(layers.path, float(layers.bounces), float(layers.tir), 0.0);
#endif
}
