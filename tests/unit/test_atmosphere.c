/* test_atmosphere.c: the sky against another program's figures, the sun against its integral. */
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>
#include "src/scene/environment/atmosphere.h"
#include "tests/support/assertions.h"

#define PI 3.14159265358979

enum {
    RINGS = 48,
    TURNS = 48
};

/* 500 m above ground of albedo 0.3; turbidity 2; irradiance of the sun above the air 1. */
static const struct row {
    float elevation; /* of the sun, degrees */
    float level[3];  /* sky's irradiance on level ground / pi */
    float zenith[3];
    float opposite[3]; /* 2 degrees up, opposite the sun */
    float aside[3];    /* 2 degrees up, 90 degrees from the sun */
} rows[] = {
    { 5,
      { 0.0080F, 0.0088F, 0.0117F },
      { 0.0028F, 0.0040F, 0.0071F },
      { 0.0212F, 0.0148F, 0.0085F },
      { 0.0161F, 0.0119F, 0.0078F } },
    { 10,
      { 0.0122F, 0.0152F, 0.0211F },
      { 0.0037F, 0.0061F, 0.0116F },
      { 0.0302F, 0.0276F, 0.0213F },
      { 0.0234F, 0.0218F, 0.0181F } },
    { 20,
      { 0.0181F, 0.0248F, 0.0366F },
      { 0.0053F, 0.0094F, 0.0187F },
      { 0.0410F, 0.0445F, 0.0433F },
      { 0.0338F, 0.0367F, 0.0366F } },
    { 35,
      { 0.0232F, 0.0335F, 0.0519F },
      { 0.0079F, 0.0141F, 0.0278F },
      { 0.0508F, 0.0588F, 0.0636F },
      { 0.0455F, 0.0523F, 0.0568F } },
    { 60,
      { 0.0278F, 0.0417F, 0.0669F },
      { 0.0191F, 0.0294F, 0.0502F },
      { 0.0601F, 0.0712F, 0.0807F },
      { 0.0593F, 0.0697F, 0.0787F } },
};

/* Figures have four digits. */
static void check_near(vec3s color, const float expected[static 3], double share)
{
    for (size_t i = 0; i < 3; i++)
        CHECK_NEAR(color.raw[i], expected[i], share * (double)expected[i] + 5e-5);
}

static vec3s direction(double elevation, double azimuth)
{
    return (vec3s){ { (float)(cos(elevation) * cos(azimuth)), (float)sin(elevation),
                      (float)(cos(elevation) * sin(azimuth)) } };
}

static vec3s level(const struct atmosphere *atmosphere, vec3s sun)
{
    double sum[3] = { 0 };
    for (int ring = 0; ring < RINGS; ring++) {
        const double elevation = asin(sqrt((ring + 0.5) / RINGS)); /* even in their cosine */
        for (int turn = 0; turn < TURNS; turn++) {
            const vec3s dir = direction(elevation, 2 * PI * (turn + 0.5) / TURNS);
            const vec3s light = atmosphere_radiance(atmosphere, 0.5F, dir, sun);
            for (size_t i = 0; i < 3; i++)
                sum[i] += (double)light.raw[i] / (RINGS * TURNS);
        }
    }
    return (vec3s){ { (float)sum[0], (float)sum[1], (float)sum[2] } };
}

/* Optical depth of the air from 500 m up, by a fine midpoint rule, for each colour. */
static void sun_is_as_its_integral(const struct atmosphere *atmosphere, double elevation)
{
    static const double air[3] = { 0.005802, 0.013558, 0.0331 }, haze[3] = { 0.76, 1, 1.34 },
                        ozone[3] = { 0.00065, 0.001881, 0.000085 };
    const double ground = 6360, r = ground + 0.5, up = sin(elevation), end = 6460;
    const double length = sqrt(r * r * (up * up - 1) + end * end) - r * up;
    double depth[3] = { 0 };
    for (int i = 0; i < 4000; i++) {
        const double share = (i + 0.5) / 4000, t = length * share * share;
        const double step = 2 * length * share / 4000;
        const double height = sqrt(r * r + t * t + 2 * r * up * t) - ground;
        for (int c = 0; c < 3; c++)
            depth[c] += step * (air[c] * exp(-height / 8) +
                                haze[c] * 20.4 * 0.003996 / 0.9 * exp(-height / 1.2) +
                                ozone[c] * fmax(0, 1 - fabs(height - 25) / 15));
    }
    const vec3s sun = atmosphere_transmittance(atmosphere, 0.5F, (float)up);
    for (int c = 0; c < 3; c++)
        CHECK_NEAR(sun.raw[c], exp(-depth[c]), 0.02 * exp(-depth[c]));
}

static void night(void **state)
{
    struct atmosphere *atmosphere = malloc(sizeof(*atmosphere));
    (void)state;
    assert_non_null(atmosphere);
    atmosphere_make(atmosphere, 1, 0);
    const vec3s below = { { 0, -1, 0 } }, up = { { 0, 1, 0 } };
    CHECK_NEAR(atmosphere_transmittance(atmosphere, 0, -0.1F).y, 0, 0);
    CHECK_NEAR(glms_vec3_max(atmosphere_radiance(atmosphere, 0.5F, up, below)), 0, 1e-6);
    /* in space there is nothing above */
    CHECK_NEAR(glms_vec3_max(atmosphere_radiance(atmosphere, 100, up, up)), 0, 1e-6);
    CHECK_NEAR(atmosphere_transmittance(atmosphere, 100, 1).z, 1, 1e-4);
    free(atmosphere);
}

static void table(void **state)
{
    struct atmosphere *atmosphere = malloc(sizeof(*atmosphere));
    (void)state;
    assert_non_null(atmosphere);
    atmosphere_make(atmosphere, 2, 0.3F);
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        const double up = (double)rows[i].elevation * PI / 180, low = 2 * PI / 180;
        const vec3s sun = direction(up, 0);
        sun_is_as_its_integral(atmosphere, up);
        /* an integral of integrals: steps ten times as fine change it by 4 % */
        check_near(level(atmosphere, sun), rows[i].level, 0.1);
        check_near(atmosphere_radiance(atmosphere, 0.5F, direction(PI / 2, 0), sun), rows[i].zenith,
                   0.05);
        check_near(atmosphere_radiance(atmosphere, 0.5F, direction(low, PI), sun), rows[i].opposite,
                   0.05);
        check_near(atmosphere_radiance(atmosphere, 0.5F, direction(low, PI / 2), sun),
                   rows[i].aside, 0.05);
    }
    free(atmosphere);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(table), cmocka_unit_test(night) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
