/* trace_image_outputs.glsl: the ray tracer's fragment outputs for the image and, with
 * REFRACT_PACKED_LAYERS, for its AOVs. */
#ifndef TRACE_IMAGE_OUTPUTS_GLSL
#define TRACE_IMAGE_OUTPUTS_GLSL

layout(location = REFRACT_OUT_COLOR) out vec4 color;
layout(location = REFRACT_OUT_HIGHLIGHT) out float highlight;
#ifdef TRACE_DENOISE
layout(location = TRACE_OUT_LIGHT) out vec4 gathered;
layout(location = TRACE_OUT_THROUGHPUT) out vec4 out_throughput;
layout(location = TRACE_OUT_POSITION) out vec4 out_position;
#endif
#ifdef REFRACT_PACKED_LAYERS
#include "refract/refract_packed_layers.glsl"

/* Returns the number of the refracted path's last object, or 0 if the path hits only one object. */
uint trace_last_object()
{
#ifndef TRACE_RAYS
    trace_start from = trace_start(escaped_end.origin, escaped_end.dir, 0.0, 1e30, -1, false,
                                   trace_surroundings_mask);
    trace_hit hit = trace_nearest_hit(from, escaped_end.throughput != vec3(0.0));
    if (hit.triangle >= 0)
        return trace_object_number(hit.triangle);
#endif
    return result.last;
}

/* Writes the AOVs. A path that begins at surroundings has none. */
void trace_write_layers(vec3 first_point)
{
    float through = 1.0 - result.fresnel;
    refract_layers layers;
    layers.depth = result.is_ground        ? 0.0
                   : result.distance > 0.0 ? min(trace_depth(first_point) * 1.00001, 1.0)
                                           : 1.0;
    layers.exit = result.exit;
    layers.refraction = through > 0.0 ? result.refraction / through : vec3(0.0);
    layers.reflection = result.fresnel > 0.0 ? result.reflection / result.fresnel : vec3(0.0);
    layers.fresnel = result.fresnel;
    layers.path = result.path_length;
    layers.bounces = uint(result.bounces);
    layers.tir = layers.bounces > 0u ? 1u : 0u;
    layers.segments = uint(result.segments);
    layers.last = trace_last_object();
    refract_write_layers(layers);
}
#endif

void main()
{
    vec3 from = primary_ray_at(ray, 0.0);
    vec3 e = normalize(primary_ray_at(ray, 1.0) - from);
    differential_of_pixel(from, e);
    trace_all_channels(refract_frame.eye + from, e);
    if (!result.is_object)
        discard;
    vec3 eye_to_point = from + result.distance * e;
#ifdef TRACE_DENOISE
    float is_sampled = denoise_is_sampled() ? 1.0 : 0.0;
    gathered =
        vec4(denoise_inputs.gathered, is_sampled * dot(denoise_inputs.throughput, vec3(1.0 / 3.0)));
    out_throughput = vec4(denoise_inputs.throughput, 0.0);
    out_position = denoise_inputs.position;
#endif
    color = vec4(result.refraction + result.reflection, optics_alpha(result.backdrop));
    highlight = result.is_ground ? -1.0 : highlight_radiance(e, eye_to_point, result.normal);
    gl_FragDepth = result.distance > 0.0 ? trace_depth(start + result.distance * e) : 1.0;
#ifdef REFRACT_PACKED_LAYERS
    trace_write_layers(start + result.distance * e);
#endif
    if (result.is_ground) /* prevents the background from overdrawing the ground */
        gl_FragDepth = min(gl_FragDepth * 1.0001, 1.0);
}

#endif
