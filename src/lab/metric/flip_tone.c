/* flip_tone.c: tone curves and exposure range of HDR-FLIP. */
#include "src/lab/metric/flip_tone.h"
#include <cglm/struct.h>
#include <math.h>

const char *const flip_curve_names[FLIP_CURVE_COUNT + 1] = {
    [FLIP_ACES] = "aces",
    [FLIP_HABLE] = "hable",
    [FLIP_REINHARD] = "reinhard",
};

/* Coefficients of Hable's filmic tone curve, with white point W. */
#define HABLE_A  0.15
#define HABLE_B  0.50
#define HABLE_C  0.10
#define HABLE_D  0.20
#define HABLE_E  0.02
#define HABLE_F  0.30
#define HABLE_W  11.2
#define HABLE_N2 (HABLE_A * HABLE_F - HABLE_A * HABLE_E)
#define HABLE_N1 (HABLE_C * HABLE_B * HABLE_F - HABLE_B * HABLE_E)
#define HABLE_D2 (HABLE_A * HABLE_F)
#define HABLE_D1 (HABLE_B * HABLE_F)
#define HABLE_D0 (HABLE_D * HABLE_F * HABLE_F)
#define HABLE_MAX \
    ((HABLE_N2 * HABLE_W + HABLE_N1) * HABLE_W / \
     ((HABLE_D2 * HABLE_W + HABLE_D1) * HABLE_W + HABLE_D0))

/* Coefficients of rational tone curves (n2 x^2 + n1 x) / (d2 x^2 + d1 x + d0). */
static const struct {
    double n2, n1, d2, d1, d0;
} curves[FLIP_CURVE_COUNT] = {
    /* x is premultiplied by 0.6 */
    [FLIP_ACES] = { 0.36 * 2.51, 0.6 * 0.03, 0.36 * 2.43, 0.6 * 0.59, 0.14 },
    [FLIP_HABLE] = { 4 * HABLE_N2 / HABLE_MAX, 2 * HABLE_N1 / HABLE_MAX, 4 * HABLE_D2, 2 * HABLE_D1,
                     HABLE_D0 },
    [FLIP_REINHARD] = { 0.0, 1.0, 0.0, 1.0, 1.0 },
};

float flip_tone_luminance(vec3s linear)
{
    return 0.2126f * linear.x + 0.7152f * linear.y + 0.0722f * linear.z;
}

static float apply(enum flip_curve curve, float x)
{
    const float above = ((float)curves[curve].n2 * x + (float)curves[curve].n1) * x;
    const float below =
        ((float)curves[curve].d2 * x + (float)curves[curve].d1) * x + (float)curves[curve].d0;
    return fminf(above / below, 1.0f);
}

vec3s flip_tone(enum flip_curve curve, vec3s linear)
{
    if (curve == FLIP_REINHARD) {
        const float scale = 1.0f / (1.0f + flip_tone_luminance(linear));
        return glms_vec3_minv(glms_vec3_scale(linear, scale), glms_vec3_one());
    }
    return (vec3s){ { apply(curve, linear.x), apply(curve, linear.y), apply(curve, linear.z) } };
}

double flip_tone_inverse(enum flip_curve curve, double shown)
{
    const double a = curves[curve].n2 - shown * curves[curve].d2;
    const double b = curves[curve].n1 - shown * curves[curve].d1;
    const double c = -shown * curves[curve].d0;
    if (a == 0.0)
        return -c / b;
    const double half = 0.5 * b / a;
    return -half + sqrt(half * half - c / a);
}

struct flip_exposures flip_tone_exposures(enum flip_curve curve, double luminance_max,
                                          double median)
{
    struct flip_exposures exposures = { .count = 2 };
    if (luminance_max > 0.0 && median > 0.0) {
        const double bright = flip_tone_inverse(curve, 0.85);
        exposures.first = log2(bright / luminance_max);
        exposures.last = log2(bright / median);
        exposures.count = (uint32_t)fmax(ceil(exposures.last - exposures.first), 2.0);
    }
    return exposures;
}
