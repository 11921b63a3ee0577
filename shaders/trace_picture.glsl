/* trace_picture.glsl: main() of the pass that writes the ray-traced image. */
#ifndef TRACE_PICTURE_GLSL
#define TRACE_PICTURE_GLSL

layout(location = REFRACT_OUT_COLOR) out vec4 color;
layout(location = REFRACT_OUT_HIGHLIGHT) out float highlight;
#ifdef TRACE_SMOOTH
layout(location = TRACE_OUT_GATHERED) out vec4 gathered;
layout(location = TRACE_OUT_SHARE) out vec4 share;
layout(location = TRACE_OUT_PLACE) out vec4 place;
#endif

void main()
{
    vec3 from = view_at(ray, 0.0);
    vec3 e = normalize(view_at(ray, 1.0) - from);
    footprint_of_pixel(from, e);
    trace_colors(refract_frame.eye + from, e);
    if (!seen.is_object)
        discard;
    vec3 eye_to_point = from + seen.distance * e;
#ifdef TRACE_SMOOTH
    float is_due = smooth_is_due() ? 1.0 : 0.0;
    gathered = vec4(matt.gathered, is_due * dot(matt.share, vec3(1.0 / 3.0)));
    share = vec4(matt.share, 0.0);
    place = matt.place;
#endif
    color = vec4(seen.refraction + seen.reflection, 1.0);
    highlight = seen.is_ground ? -1.0 : surface_highlight(e, eye_to_point, seen.normal);
    gl_FragDepth = seen.distance > 0.0 ? trace_depth(start + seen.distance * e) : 1.0;
    if (seen.is_ground) /* keeps the rasterised background from drawing over it */
        gl_FragDepth = min(gl_FragDepth * 1.0001, 1.0);
}

#endif
