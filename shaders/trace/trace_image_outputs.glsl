/* trace_image_outputs.glsl: the ray tracer's fragment outputs for the image. */
#ifndef TRACE_IMAGE_OUTPUTS_GLSL
#define TRACE_IMAGE_OUTPUTS_GLSL

layout(location = REFRACT_OUT_COLOR) out vec4 color;
layout(location = REFRACT_OUT_HIGHLIGHT) out float highlight;
#ifdef TRACE_DENOISE
layout(location = TRACE_OUT_LIGHT) out vec4 gathered;
layout(location = TRACE_OUT_THROUGHPUT) out vec4 out_throughput;
layout(location = TRACE_OUT_POSITION) out vec4 out_position;
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
    color = vec4(result.refraction + result.reflection, 1.0);
    highlight = result.is_ground ? -1.0 : highlight_radiance(e, eye_to_point, result.normal);
    gl_FragDepth = result.distance > 0.0 ? trace_depth(start + result.distance * e) : 1.0;
    if (result.is_ground) /* prevents the background from overdrawing the ground */
        gl_FragDepth = min(gl_FragDepth * 1.0001, 1.0);
}

#endif
