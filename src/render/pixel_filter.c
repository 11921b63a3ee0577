/* pixel_filter.c: sample positions within a pixel, distributed like the reconstruction filter. */
#include "src/render/pixel_filter.h"
#include <math.h>

static const double pi = 3.14159265358979323846;
static const double window_radius = 1.5; /* radius of the Blackman-Harris filter, pixels */

const char *const pixel_filter_names[PIXEL_FILTER_COUNT] = {
    [PIXEL_FILTER_BOX] = "box",
    [PIXEL_FILTER_POINT] = "point",
    [PIXEL_FILTER_BLACKMAN_HARRIS] = "blackman-harris",
};

vec2s pixel_filter_jitter(uint32_t sample)
{
    /* steps of Roberts' R2 sequence: 1 / g and 1 / g^2, where g solves g^3 = g + 1 */
    const double a[2] = { 0.7548776662466927, 0.5698402909980532 };
    vec2s jitter;
    for (int i = 0; i < 2; i++) {
        double x = 0.5 + sample * a[i];
        jitter.raw[i] = fminf((float)(x - floor(x) - 0.5), nextafterf(0.5f, 0.0f));
    }
    return jitter;
}

/*
 * Inverts the integral of the Blackman-Harris window, to importance-sample it: returns the
 * position, -1 to 1 in radii, up to which the integral from the centre is `fraction` of the whole,
 * -0.5 to 0.5. The window has four terms (Harris 1978, On the Use of Windows for Harmonic Analysis
 * with the Discrete Fourier Transform, -92 dB). It decreases away from its centre, so Newton's
 * method starts there and cannot overshoot.
 */
static double inverse_window_integral(double fraction)
{
    const double a[] = { 0.35875, 0.48829, 0.14128, 0.01168 };
    const double target = fabs(fraction) * 2.0 * a[0];
    double x = 0.0;
    for (int step = 0; step < 40; step++) {
        double sum = a[0] * x - target;
        double height = a[0];
        for (int k = 1; k < 4; k++) {
            sum += a[k] * sin(k * pi * x) / (k * pi);
            height += a[k] * cos(k * pi * x);
        }
        if (sum > -1e-7)
            break;
        x = fmin(x - sum / height, 1.0);
    }
    return copysign(x, fraction);
}

vec2s pixel_filter_offset(enum pixel_filter filter, uint32_t sample)
{
    vec2s offset = pixel_filter_jitter(sample);
    if (filter == PIXEL_FILTER_POINT)
        return (vec2s){ { 0.0f, 0.0f } };
    for (int i = 0; i < 2 && filter == PIXEL_FILTER_BLACKMAN_HARRIS; i++)
        offset.raw[i] = (float)(window_radius * inverse_window_integral((double)offset.raw[i]));
    return offset;
}
