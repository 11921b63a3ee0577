/* test_cracks_reflectance.c: reflectance of cracks, against sums of complex amplitudes. */
#include <complex.h>
#include <math.h>

#include "shaders/inclusions/cracks_reflectance.h"
#include "tests/support/assertions.h"

static const double pi = 3.14159265358979323846;
static const double index_of_ice = 1.31;
static const double critical = 0.868; /* radians */

/* Returns what a gap reflects by Airy's sum, r (1 - p) / (1 - r r p), p that of a way there and
 * back in the gap; below the critical angle, r is that of unpolarised light. */
static double airy(double angle, double width, double wavelength)
{
    const double n = index_of_ice;
    const double complex inside = csqrt(1 - n * n * sin(angle) * sin(angle));
    const double complex way = 4 * pi * width / wavelength * inside;
    const double complex p = cexp(csqrt(-1) * way);
    double complex r[2];
    double sum = 0;
    for (int k = 0; k < 2; k++) {
        const double c = k ? cos(angle) / n : n * cos(angle);
        r[k] = (c - inside) / (c + inside);
    }
    if (angle < critical)
        r[0] = r[1] = sqrt(0.5 * (creal(r[0]) * creal(r[0]) + creal(r[1]) * creal(r[1])));
    for (int k = 0; k < 2; k++)
        sum += 0.5 * pow(cabs(r[k] * (1 - p) / (1 - r[k] * r[k] * p)), 2);
    return sum;
}

/* Returns its mean over fringes. */
static double mean_of(double angle)
{
    const double along = cos(asin(index_of_ice * sin(angle)));
    double sum = 0;
    for (int k = 0; k < 64; k++)
        sum += airy(angle, (k + 0.5) / 128 / along, 1) / 64;
    return sum;
}

/* Thin gaps reflect colours, which fade in wider ones, and light tunnels through them. */
static void test_law(void **state)
{
    static const double angles[] = { 0, 0.1, 0.5, 0.8, 0.9, 1.1 };
    static const double widths[] = { 0, 0.05, 0.1, 0.3, 0.7, 2 };
    static const double wavelengths[] = { 0.61, 0.55, 0.465 };
    (void)state;
    for (int i = 0; i < 6 * 6; i++) {
        const double angle = angles[i / 6], width = widths[i % 6];
        const vec3s found =
            cracks_reflectance((float)cos(angle), (float)index_of_ice, (float)width);
        const double coloured = exp(-width * width / 2.25);
        for (int k = 0; k < 3; k++) {
            const double exact = airy(angle, width, wavelengths[k]);
            const double wide = angle < critical ? mean_of(angle) : exact;
            CHECK_NEAR(found.raw[k], wide + (exact - wide) * coloured, 1e-5);
        }
    }
}

/* Wide gaps reflect 2 R / (1 + R). */
static void test_wide_gaps(void **state)
{
    const vec3s straight = cracks_reflectance(1, (float)index_of_ice, 50);
    const vec3s total = cracks_reflectance(0.6f, (float)index_of_ice, 50);
    const double side = pow(0.31 / 2.31, 2);
    (void)state;
    for (int k = 0; k < 3; k++) {
        CHECK_NEAR(straight.raw[k], 2 * side / (1 + side), 1e-6);
        CHECK_NEAR(total.raw[k], 1, 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_law),
        cmocka_unit_test(test_wide_gaps),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
