/* trace_dispersion.glsl: traces colour channels separately if their refractive indices differ. */
#ifndef TRACE_DISPERSION_GLSL
#define TRACE_DISPERSION_GLSL

/* Traces a pixel. With TRACE_DISPERSION, traces one path per colour channel. The green path gives
 * all results except radiance. A loop keeps drivers from inlining trace_pixel() three times. */
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
        all = i == 0 ? result : all;
        all.refraction[channel] = result.refraction[channel];
        all.reflection[channel] = result.reflection[channel];
        all.backdrop[channel] = result.backdrop[channel];
#ifdef TRACE_DENOISE
        all_denoise = i == 0 ? denoise_inputs : all_denoise;
        all_denoise.gathered[channel] = denoise_inputs.gathered[channel];
        all_denoise.throughput[channel] = denoise_inputs.throughput[channel];
#endif
    }
    result = all;
#ifdef TRACE_DENOISE
    denoise_inputs = all_denoise;
#endif
#else
    trace_pixel(eye, e, 1);
#endif
}

#endif
