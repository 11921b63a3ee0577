/* trace_dispersion.glsl: dispersion: traces red, green and blue separately if their indices
 * differ. */
#ifndef TRACE_DISPERSION_GLSL
#define TRACE_DISPERSION_GLSL

/* Traces a pixel. With TRACE_DISPERSION one path per colour channel; everything except radiance is
 * taken from green, the first. The loop contains a single call, because drivers inline each one. */
void trace_all_channels(vec3 eye, vec3 e)
{
#ifdef TRACE_DISPERSION
    trace_result all;
#ifdef TRACE_DENOISE
    trace_denoise_inputs all_denoise;
#endif
    for (int i = 0; i < 3; i++) {
        int channel = i == 0 ? 1 : 2 * (i - 1);
        trace_pixel(eye, e, channel);
        all = i == 0 ? seen : all;
        all.refraction[channel] = seen.refraction[channel];
        all.reflection[channel] = seen.reflection[channel];
#ifdef TRACE_DENOISE
        all_denoise = i == 0 ? matt : all_denoise;
        all_denoise.gathered[channel] = matt.gathered[channel];
        all_denoise.share[channel] = matt.share[channel];
#endif
    }
    seen = all;
#ifdef TRACE_DENOISE
    matt = all_denoise;
#endif
#else
    trace_pixel(eye, e, 1);
#endif
}

#endif
