/*
 * test_wave.c: wave_function.h on a device, against vectors computed in double precision by
 * another program (tests/data/oracles.json) and against closed forms.
 */
#include <math.h>

#include "tests/support/assertions.h"

#include "src/settings/settings.h"
#include "src/tech/water/pool_parameters.h"
#include "tests/gpu/optics_ask.h"
#include "tests/support/lavapipe.h"

/* What the settings are by default, with the constants of the vectors. */
static struct water_params get_water(const json_t *oracles)
{
    const json_t *row = json_object_get(oracles, "wave_constants");
    const struct settings settings = settings_default();
    struct water_params waves = pool_push_of(&settings).water;
    waves.height = (float)get_number(row, "V");
    waves.frequency = (float)get_number(row, "W");
    waves.amplitude = (float)get_number(row, "F0");
    waves.speed = (float)get_number(row, "S");
    waves.octaves = (uint32_t)get_number(row, "octaves");
    return waves;
}

/* `rise` multiplies height and slopes of the vectors. */
static void check_wave(const struct optics_answer *got, const json_t *row, double scale,
                       double rise)
{
    const json_t *gradient = json_object_get(row, "gradient");
    for (size_t k = 0; k < 2; k++)
        CHECK_NEAR(got->wave.raw[k], rise * json_number_value(json_array_get(gradient, k)),
                   tolerance);
    CHECK_NEAR((double)got->wave.z / scale, rise * get_number(row, "height"), tolerance);
    if (rise != 1)
        return;
    check_vector(got->wave_normal, get_vector(row, "normal"));
    check_vector(got->up_ray, get_vector(row, "up_ray_out"));
}

/* At each of them as it is, three times as large, and with twice the amplitude: twice as high, of
 * the same frequency. */
static void waves_as_worked_out(void **state)
{
    enum {
        COUNT = 10,
        ASKED = 3 * COUNT,
    };
    struct optics_question asked[ASKED];
    struct optics_answer got[ASKED];
    json_t *oracles = load(ORACLES);
    const json_t *cases = get_cases(oracles, "wave", COUNT);
    for (size_t i = 0; i < ASKED; i++) {
        const json_t *row = json_array_get(cases, i / 3);
        const float scale = i % 3 == 1 ? 3 : 1;
        asked[i] = (struct optics_question){
            .at = { { scale * (float)get_number(row, "x"), scale * (float)get_number(row, "y") } },
            .time = (float)get_number(row, "time"),
            .water = get_water(oracles),
        };
        asked[i].water.scale = scale;
        asked[i].water.amplitude *= i % 3 == 2 ? 2 : 1;
    }
    ask(*state, asked, got, ASKED);
    for (size_t i = 0; i < ASKED; i++)
        check_wave(&got[i], json_array_get(cases, i / 3), i % 3 == 1 ? 3 : 1, i % 3 == 2 ? 2 : 1);
    json_decref(oracles);
}

/* A cone's tip is level; the cosine, its slope and how it moves. */
static void ends_of_waves(void **state)
{
    const struct water_params series = {
        .height = 0.01F,
        .frequency = 10,
        .amplitude = 1,
        .octaves = 5,
        .scale = 1,
        .ior = 1.333F,
    };
    const struct water_params cosine = {
        .wave = WATER_COSINE,
        .height = 0.02F,
        .frequency = 3,
        .speed = 2,
        .scale = 2,
        .ior = 1.333F,
    };
    const struct optics_question asked[] = {
        { .water = series },
        { .water = series, .at = { { 1e-9F, 0 } } },
        { .water = cosine, .at = { { 0.7F, 5 } }, .time = 0.3F },
    };
    struct optics_answer got[3];
    ask(*state, asked, got, 3);
    for (size_t i = 0; i < 2; i++) {
        assert_true(fabsf(got[i].wave.x) < 0.05F && fabsf(got[i].wave.y) < 0.05F);
        CHECK_NEAR(got[i].wave.z, 0, 1e-6);
    }
    CHECK_NEAR(got[0].wave.x, 0, 0);
    CHECK_NEAR(got[0].up_ray.z, 1, 0);
    const double phi = 3 * 0.35 - 2 * 0.3;
    CHECK_NEAR(got[2].wave.x, -0.06 * sin(phi), 1e-6);
    CHECK_NEAR(got[2].wave.y, 0, 0);
    CHECK_NEAR(got[2].wave.z, 0.04 * cos(phi), 1e-6);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(waves_as_worked_out),
        cmocka_unit_test(ends_of_waves),
    };
    return RUN_ON_DEVICE(tests);
}
