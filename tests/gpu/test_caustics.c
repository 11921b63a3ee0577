/*
 * test_caustics.c: light on the pool's floor against closed forms.
 *
 * Below a surface z = A cos k x, with light from straight above, the focal depth is
 * h_f = n / ((n - 1) A k^2); where rays do not yet cross, light is 1 / (1 - h / h_f) below crests
 * and 1 / (1 + h / h_f) below troughs: vectors in tests/data/oracles.json. Those hold for small
 * slopes.
 */
#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tests/support/check.h"

#include "src/frame.h"
#include "src/tech/caustics.h"
#include "src/tech/water.h"
#include "tests/support/lavapipe.h"
#include "tests/support/run_graph.h"

enum {
    SIZE = CAUSTICS_SIZE,
    TEXEL_COUNT = SIZE * SIZE,
    ROWS_MAX = 8,
};

static const double pi = 3.14159265358979323846;

/* The light of a pool, and where it lies. */
struct map {
    float *texels;
    double size, depth;    /* of the pool */
    double lower[2];       /* corner of the map, pool coordinates */
    double texel[2];       /* lengths of a texel's sides, metres */
    double shift_x, total; /* of the light on the floor; light over what enters the pool */
};

struct light {
    const char *method;
    double elevation;               /* of the sun, which stands on +x; degrees */
    const char *const *assignments; /* end at NULL */
};

static const struct rg_buffer texels_out = {
    .name = "texels out",
    .size = (VkDeviceSize)TEXEL_COUNT * 2,
    .memory = RG_MEMORY_READBACK,
};
static const struct rg_pass read_row = RUN_READ("read", caustics_light, texels_out);

static double from_half(uint16_t half)
{
    const int exponent = half >> 10 & 31;
    const double fraction = (half & 1023) / 1024.0;
    assert_true(exponent < 31); /* a number */
    return (half & 0x8000 ? -1 : 1) *
           (exponent ? ldexp(1 + fraction, exponent - 15) : ldexp(fraction, -14));
}

static struct settings settings_of_light(const struct light *light)
{
    struct settings settings = settings_default();
    char method[64];
    (void)snprintf(method, sizeof(method), "caustics.method=%s", light->method);
    assert_int_equal(settings_set(&settings, method), STATUS_OK);
    for (size_t i = 0; light->assignments[i]; i++)
        assert_int_equal(settings_set(&settings, light->assignments[i]), STATUS_OK);
    return settings;
}

/* Runs the rows of a method, and one that brings the map back. */
static void run_method(struct gpu *gpu, const struct settings *settings,
                       const struct globals *globals, float *texels)
{
    const struct technique *technique = caustics_find(settings);
    struct rg_pass rows[ROWS_MAX];
    struct run run;
    assert_non_null(technique);
    const size_t count = technique->graph.pass_count;
    assert_true(count < ROWS_MAX);
    memcpy(rows, technique->graph.passes, count * sizeof(rows[0]));
    rows[count] = read_row;
    run_open(&run, gpu,
             &(struct run_params){
                 .technique = { "caustics", rows, count + 1 },
                 .outputs = { &texels_out },
             });
    assert_int_equal(rg_exec_begin(run.exec, &run.slot), VK_SUCCESS);
    memcpy(run_data(&run, &frame_globals), globals, sizeof(*globals));
    const struct rg_frame frame = { .settings = settings };
    assert_int_equal(rg_exec_submit(run.exec, &frame), VK_SUCCESS);
    assert_int_equal(rg_exec_wait(run.exec, run.slot), VK_SUCCESS);
    const uint16_t *halves = run_data(&run, &texels_out);
    for (size_t i = 0; i < TEXEL_COUNT; i++)
        texels[i] = (float)from_half(halves[i]);
    run_close(&run);
}

/* The caller frees its texels. */
static struct map trace(struct gpu *gpu, const struct light *light)
{
    const struct settings settings = settings_of_light(light);
    const struct water_push push = water_push_of(&settings);
    const double elevation = light->elevation * pi / 180;
    const struct globals globals = {
        .sun_dir = { { (float)cos(elevation), (float)sin(elevation), 0 } },
    };
    const double sine = cos(elevation) / (double)push.water.ior;
    struct map map = {
        .texels = calloc(TEXEL_COUNT, sizeof(float)),
        .size = (double)push.pool.size,
        .depth = (double)push.pool.depth,
    };
    assert_non_null(map.texels);
    map.shift_x = -sine / sqrt(1 - sine * sine) * map.depth;
    map.lower[0] = -map.size / 2 - 0.15 * map.depth + fmin(map.shift_x, 0);
    map.lower[1] = -map.size / 2 - 0.15 * map.depth;
    map.texel[0] = (map.size + 0.3 * map.depth + fabs(map.shift_x)) / SIZE;
    map.texel[1] = (map.size + 0.3 * map.depth) / SIZE;
    run_method(gpu, &settings, &globals, map.texels);
    for (size_t i = 0; i < TEXEL_COUNT; i++)
        map.total += (double)map.texels[i] * map.texel[0] * map.texel[1] / (map.size * map.size);
    return map;
}

static double place(const struct map *map, size_t axis, size_t index)
{
    return map->lower[axis] + ((double)index + 0.5) * map->texel[axis];
}

/* Mean light from x_0 to x_1, at the middle of the pool along y; by whole texels. */
static double mean(const struct map *map, double x_0, double x_1)
{
    double sum = 0;
    size_t count = 0;
    for (size_t y = SIZE / 8; y < SIZE - SIZE / 8; y++) {
        for (size_t x = 0; x < SIZE; x++) {
            if (place(map, 0, x) < x_0 || place(map, 0, x) > x_1)
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
                                  "caustics.cone=3",
                                  "caustics.directions=192",
                                  "caustics.photons=8000000",
                                  NULL };
    const double length = 2 * pi / c->wavenumber;
    (void)snprintf(words[0], sizeof(words[0]), "water.height=%.9g", c->amplitude);
    (void)snprintf(words[1], sizeof(words[1]), "water.frequency=%.9g", c->wavenumber);
    (void)snprintf(words[2], sizeof(words[2]), "water.ior=%.9g", c->index * 1.0003);
    (void)snprintf(words[3], sizeof(words[3]), "pool.depth=%.9g", c->depth);
    (void)snprintf(words[4], sizeof(words[4]), "pool.size=%.9g", 4 * length);
    struct map map = trace(gpu, &(struct light){ method, 90, assignments });
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
        for (size_t m = 0; m < 3; m++)
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
    struct map map = trace(gpu, &(struct light){ "backtrace", 90, assignments });
    double sum = 0;
    for (int i = 0; i < 10000; i++)
        sum += bell(turned(0.02 * 2 * pi * sin(2 * pi * i / 10000), published)) / 10000;
    for (size_t i = 0; i < SIZE; i++) {
        const double x = place(&map, 0, i);
        const double texel = (double)map.texels[SIZE / 2 * SIZE + i];
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

/* Below level water light is even, and where it ends the sun says. Away from the ends by as much as
 * the sun's image is wide. */
static void check_level(struct gpu *gpu, const char *method, double noise)
{
    const char *const assignments[] = { "water.height=0", "caustics.sun=1", "caustics.cone=2",
                                        "caustics.directions=64", NULL };
    struct map map = trace(gpu, &(struct light){ method, 50, assignments });
    double sum = 0;
    size_t lit = 0;
    for (size_t i = 0; i < TEXEL_COUNT; i++) {
        const double x = fabs(place(&map, 0, i % SIZE) - map.shift_x);
        const double y = fabs(place(&map, 1, i / SIZE));
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
    CHECK_NEAR(map.total, 1, 5e-3);
    free(map.texels);
}

static void below_level_water(void **state)
{
    check_level(*state, "area", 0);
    check_level(*state, "backtrace", 0);
    check_level(*state, "naive", 5e-3);
    check_level(*state, "gather", 5e-3);
}

/* All light that enters reaches the floor, however the waves throw it about. */
static void no_light_is_lost(void **state)
{
    static const char *const assignments[] = { NULL };
    static const double elevations[] = { 90, 60, 35 };
    for (size_t i = 0; i < 3; i++) {
        struct map area = trace(*state, &(struct light){ "area", elevations[i], assignments });
        struct map naive = trace(*state, &(struct light){ "naive", elevations[i], assignments });
        print_message("sun at %g: area %.4f, naive %.4f\n", elevations[i], area.total, naive.total);
        CHECK_NEAR(area.total, naive.total, 0.01);
        CHECK_NEAR(area.total, 1, 0.02);
        free(area.texels);
        free(naive.texels);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_DEVICE(below_a_cosine),
        ON_DEVICE(backtrace_as_it_is_meant),
        ON_DEVICE(below_level_water),
        ON_DEVICE(no_light_is_lost),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
