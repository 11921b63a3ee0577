/*
 * test_caustics.c: caustics on the pool's floor, against closed forms. Below a surface z = A cos k
 * x, with light from straight above, the focal depth is h_f = n / ((n - 1) A k^2); where rays do
 * not yet cross, light is 1 / (1 - h / h_f) below crests and 1 / (1 + h / h_f) below troughs:
 * vectors in tests/data/oracles.json. Those hold for small slopes.
 */
#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "tests/support/assertions.h"

#include "tests/support/caustic_map.h"
#include "tests/support/lavapipe.h"

enum {
    SIZE = CAUSTIC_MAP_SIZE,
};

static const double pi = 3.14159265358979323846;

/* Mean light from x_0 to x_1, at the middle of the pool along y; by whole texels. */
static double mean(const struct light_map *map, double x_0, double x_1)
{
    double sum = 0;
    size_t count = 0;
    for (size_t y = SIZE / 8; y < SIZE - SIZE / 8; y++) {
        for (size_t x = 0; x < SIZE; x++) {
            if (caustic_map_position(map, 0, x) < x_0 || caustic_map_position(map, 0, x) > x_1)
                continue;
            sum += (double)map->texels[y * SIZE + x];
            count++;
        }
    }
    assert_true(count > 0);
    return sum / (double)count;
}

/* ---- the cosine ---- */

struct cosine {
    double amplitude, wavenumber, index, depth, crest, trough;
};

static double get_number(const json_t *row, const char *name)
{
    const json_t *number = json_object_get(row, name);
    assert_true(json_is_number(number));
    return json_number_value(number);
}

static struct cosine get_cosine(const json_t *row)
{
    return (struct cosine){
        .amplitude = get_number(row, "amplitude"),
        .wavenumber = get_number(row, "wavenumber"),
        .index = get_number(row, "index"),
        .depth = get_number(row, "depth_over_focal") * get_number(row, "focal_depth"),
        .crest = get_number(row, "crest"),
        .trough = get_number(row, "trough"),
    };
}

/* Below crests at x = 0 and 1, the trough between them, and the whole wave. */
static void check_cosine(struct gpu *gpu, const char *method, const struct cosine *c)
{
    char words[5][64];
    const char *assignments[] = { words[0],
                                  words[1],
                                  words[2],
                                  words[3],
                                  words[4],
                                  "water.wave=cosine",
                                  "water.scale=1",
                                  "caustics.sun=1",
                                  "caustics.cone=2.4",
                                  "caustics.directions=96",
                                  "caustics.photons=2000000",
                                  NULL };
    const double length = 2 * pi / c->wavenumber;
    (void)snprintf(words[0], sizeof(words[0]), "water.height=%.9g", c->amplitude);
    (void)snprintf(words[1], sizeof(words[1]), "water.frequency=%.9g", c->wavenumber);
    (void)snprintf(words[2], sizeof(words[2]), "water.ior=%.9g", c->index * 1.0003);
    (void)snprintf(words[3], sizeof(words[3]), "pool.depth=%.9g", c->depth);
    (void)snprintf(words[4], sizeof(words[4]), "pool.size=%.9g", 4 * length);
    struct light_map map =
        caustic_map_trace(gpu, &(struct caustic_map_params){ method, 90, assignments });
    const double near = 0.02 * length;
    const double crest = (mean(&map, -near, near) + mean(&map, length - near, length + near)) / 2;
    const double trough = mean(&map, length / 2 - near, length / 2 + near);
    const double whole = mean(&map, -length / 2, length / 2);
    print_message("%s: crest %.4f of %.4f, trough %.4f of %.4f, mean %.4f, all %.4f\n", method,
                  crest, c->crest, trough, c->trough, whole, map.total);
    CHECK_NEAR(crest / c->crest, 1, 0.03);
    CHECK_NEAR(trough / c->trough, 1, 0.03);
    CHECK_NEAR(whole, 1, 0.01);
    CHECK_NEAR(map.total, 1, 0.01);
    free(map.texels);
}

static void below_a_cosine(void **state)
{
    static const char *const physical[] = { "area", "gather", "naive" };
    json_error_t error;
    json_t *oracles = json_load_file(ORACLES, 0, &error);
    const json_t *cases = json_object_get(oracles, "caustic_cosine");
    assert_int_equal(json_array_size(cases), 3);
    for (size_t i = 0; i < 3; i++) {
        const struct cosine c = get_cosine(json_array_get(cases, i));
        for (size_t m = 0; m < (i == 0 ? 3 : 1); m++) /* the others need millions of photons */
            check_cosine(*state, physical[m], &c);
    }
    json_decref(oracles);
}

/* ---- backtrace ---- */

/* The light of a ray that leaves at an angle to the sun straight above, a bell 4 degrees wide. */
static double bell(double angle)
{
    const double away = 2 * sin(angle / 2) / (4 * pi / 180);
    return exp(-away * away);
}

/* By Snell's law a surface of slope s, seen from straight below, turns the ray by an angle ... */
static double turned(double slope, bool published)
{
    const double tilt = atan(slope);
    return published ? tilt : asin(1.333 / 1.0003 * sin(tilt)) - tilt;
}

static void check_backtrace(struct gpu *gpu, bool published)
{
    const char *const assignments[] = {
        "water.wave=cosine",
        "water.scale=1",
        "water.height=0.02",
        "water.frequency=6.2831853",
        "pool.size=4",
        "pool.depth=0.5",
        published ? "caustics.slope=published" : "caustics.slope=snell",
        NULL,
    };
    struct light_map map =
        caustic_map_trace(gpu, &(struct caustic_map_params){ "backtrace", 90, assignments });
    double sum = 0;
    for (int i = 0; i < 10000; i++)
        sum += bell(turned(0.02 * 2 * pi * sin(2 * pi * i / 10000), published)) / 10000;
    for (size_t i = 0; i < SIZE; i++) {
        const double x = caustic_map_position(&map, 0, i);
        const double texel = (double)map.texels[(size_t)SIZE / 2 * SIZE + i];
        const double expected = bell(turned(0.02 * 2 * pi * sin(2 * pi * x), published)) / sum;
        if (fabs(x) < 1.99) /* as much as a texel of the map that is half in the pool */
            CHECK_NEAR(texel / expected, 1, 6e-3);
        else if (fabs(x) > 2.01)
            CHECK_NEAR(texel, 0, 0);
    }
    CHECK_NEAR(map.total, 1, 1e-3);
    free(map.texels);
}

static void backtrace_as_it_is_meant(void **state)
{
    check_backtrace(*state, false);
    check_backtrace(*state, true);
}

/* ---- level water, waves ---- */

/* Width of the rim's shadow on level water; the sun is above one side. */
static double shade(double elevation)
{
    return 0.2 / tan(elevation * pi / 180);
}

/* Below level water light is even, on floor and wall, and where it ends the sun says. Away from the
 * ends by as much as the sun's image is wide. */
static void check_level(struct gpu *gpu, const char *method, double noise)
{
    const char *const assignments[] = { "water.height=0", "caustics.sun=1", "caustics.cone=2",
                                        "caustics.directions=24", NULL };
    struct light_map map =
        caustic_map_trace(gpu, &(struct caustic_map_params){ method, 50, assignments });
    double sum = 0;
    size_t lit = 0;
    for (size_t i = 0; i < CAUSTIC_MAP_COUNT; i++) {
        const double middle = map.shift_x - shade(50) / 2;
        const double x = fabs(caustic_map_position(&map, 0, i % SIZE) - middle) + shade(50) / 2;
        const double y = fabs(caustic_map_position(&map, 1, i / SIZE));
        const double light = (double)map.texels[i];
        if (fmax(x, y) > map.size / 2 + 0.04)
            CHECK_NEAR(light, 0, 0);
        if (fmax(x, y) > map.size / 2 - 0.04)
            continue;
        if (noise == 0)
            CHECK_NEAR(light, 1, 3e-3);
        sum += light;
        lit++;
    }
    CHECK_NEAR(map.shift_x, -0.66, 0.01); /* else this tells nothing */
    CHECK_NEAR(sum / (double)lit, 1, fmax(noise, 2e-3));
    CHECK_NEAR(map.total, 1 - shade(50) / map.size, 5e-3);
    free(map.texels);
}

static void below_level_water(void **state)
{
    check_level(*state, "area", 0);
    check_level(*state, "backtrace", 0);
    check_level(*state, "naive", 5e-3);
    check_level(*state, "gather", 5e-3);
}

/* All light that enters reaches the ground, however the waves throw it about. */
static void no_light_is_lost(void **state)
{
    static const char *const assignments[] = { NULL };
    static const double elevations[] = { 90, 60, 35 };
    for (size_t i = 0; i < 3; i++) {
        struct light_map area = caustic_map_trace(
            *state, &(struct caustic_map_params){ "area", elevations[i], assignments });
        struct light_map naive = caustic_map_trace(
            *state, &(struct caustic_map_params){ "naive", elevations[i], assignments });
        print_message("sun at %g: area %.4f, naive %.4f\n", elevations[i], area.total, naive.total);
        CHECK_NEAR(area.total, naive.total, 0.01);
        CHECK_NEAR(area.total, 1 - shade(elevations[i]) / area.size, 0.02);
        free(area.texels);
        free(naive.texels);
    }
}

/* Waves so short that triangles become slivers. */
static void slivers_give_no_negative_light(void **state)
{
    static const char *const assignments[] = { "water.scale=0.1", "pool.depth=0.5", NULL };
    static const double elevations[] = { 15, 35, 55 };
    for (size_t i = 0; i < 3; i++) {
        struct light_map map = caustic_map_trace(
            *state, &(struct caustic_map_params){ "area", elevations[i], assignments, 1 });
        for (size_t t = 0; t < CAUSTIC_MAP_COUNT; t++)
            assert_true(map.texels[t] >= 0.0F);
        free(map.texels);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(below_a_cosine),
        cmocka_unit_test(backtrace_as_it_is_meant),
        cmocka_unit_test(below_level_water),
        cmocka_unit_test(no_light_is_lost),
        cmocka_unit_test(slivers_give_no_negative_light),
    };
    return RUN_ON_DEVICE(tests);
}
