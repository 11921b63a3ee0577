/* trace_colors.glsl: dispersion: traces red, green and blue separately if their indices differ. */
#ifndef TRACE_COLORS_GLSL
#define TRACE_COLORS_GLSL

/* Traces a pixel. With TRACE_COLORS one path per colour channel; everything except radiance is
 * taken from green, the first. The loop contains a single call, because drivers inline each one. */
void trace_colors(vec3 eye, vec3 e)
{
#ifdef TRACE_COLORS
    trace_seen all;
#ifdef TRACE_SMOOTH
    trace_smooth all_smooth;
#endif
    for (int i = 0; i < 3; i++) {
        int channel = i == 0 ? 1 : 2 * (i - 1);
        trace_pixel(eye, e, channel);
        all = i == 0 ? seen : all;
        all.refraction[channel] = seen.refraction[channel];
        all.reflection[channel] = seen.reflection[channel];
#ifdef TRACE_SMOOTH
        all_smooth = i == 0 ? matt : all_smooth;
        all_smooth.gathered[channel] = matt.gathered[channel];
        all_smooth.share[channel] = matt.share[channel];
#endif
    }
    seen = all;
#ifdef TRACE_SMOOTH
    matt = all_smooth;
#endif
#else
    trace_pixel(eye, e, 1);
#endif
}

#endif
