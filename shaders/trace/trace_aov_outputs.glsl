/* trace_aov_outputs.glsl: the ray tracer's fragment outputs in the AOV pass. */
#ifndef TRACE_AOV_OUTPUTS_GLSL
#define TRACE_AOV_OUTPUTS_GLSL

layout(set = 0, binding = TRACE_FIRST_OBJECT) uniform sampler2D first_object;
#ifndef TRACE_RAYS
layout(set = 0, binding = REFRACT_DEPTH_SCENE) uniform sampler2D depth_scene;
#endif

/* Returns true if rasterised surroundings hide a point. TRACE_RAYS traces surroundings instead. */
bool trace_is_hidden(vec3 point)
{
#ifdef TRACE_RAYS
    return false;
#else
    float scene = texelFetch(depth_scene, ivec2(gl_FragCoord.xy), 0).r;
    return trace_depth(point) * 1.00001 < scene;
#endif
}

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

layout(location = REFRACT_OUT_EXIT) out vec4 out_exit;
layout(location = REFRACT_OUT_REFRACTION) out vec4 out_refraction;
layout(location = REFRACT_OUT_REFLECTION) out vec4 out_reflection;
layout(location = REFRACT_OUT_FRESNEL) out float out_fresnel;
layout(location = REFRACT_OUT_PATH) out vec4 out_path;
layout(location = TRACE_OUT_MEDIA) out float out_media;
layout(location = TRACE_OUT_LAST) out float out_last;

void main()
{
    vec3 from = primary_ray_at(ray, 0.0);
    vec3 e = normalize(primary_ray_at(ray, 1.0) - from);
    differential_of_pixel(from, e);
    trace_all_channels(refract_frame.eye + from, e);
    out_exit = vec4(0.0);
    out_refraction = vec4(0.0);
    out_reflection = vec4(0.0);
    out_fresnel = 0.0;
    out_path = vec4(0.0);
    out_media = 0.0;
    out_last = texelFetch(first_object, ivec2(gl_FragCoord.xy), 0).r;
    if (!result.is_object || trace_is_hidden(start + result.distance * e))
        return;
    float through = 1.0 - result.fresnel;
    out_exit = vec4(result.exit, 0.0);
    out_refraction = vec4(through > 0.0 ? result.refraction / through : vec3(0.0), 0.0);
    out_reflection =
        vec4(result.fresnel > 0.0 ? result.reflection / result.fresnel : vec3(0.0), 0.0);
    out_fresnel = result.fresnel;
    out_path = vec4(result.path_length, result.bounces, result.bounces > 0.0 ? 1.0 : 0.0, 0.0);
    out_media = result.segments;
    uint last = trace_last_object();
    out_last = last != 0u ? float(last) : out_last;
}

#endif
