/* caustic_map.c: runs a caustics method's passes on the device, and reads the caustic map back. */
#include "tests/support/caustic_map.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "tests/support/assertions.h"

#include "src/tech/frame_resources.h"
#include "src/tech/water/caustics.h"
#include "src/tech/water/pool_parameters.h"
#include "tests/support/run_graph.h"

enum {
    ROWS_MAX = 8,
};

static const double pi = 3.14159265358979323846;

static const struct rg_buffer texels_out = {
    .name = "texels out",
    .size = (VkDeviceSize)CAUSTIC_MAP_COUNT * 2,
    .memory = RG_MEMORY_READBACK,
};
static const struct rg_pass read_row = RUN_READ("read", caustics_light, texels_out);

static double from_half(uint16_t half)
{
    const int exponent = half >> 10 & 31;
    const double fraction = (half & 1023) / 1024.0;
    assert_true(exponent < 31); /* neither infinity nor NaN */
    return (half & 0x8000 ? -1 : 1) *
           (exponent ? ldexp(1 + fraction, exponent - 15) : ldexp(fraction, -14));
}

static struct settings settings_of_params(const struct caustic_map_params *params)
{
    struct settings settings = settings_default();
    char method[64];
    (void)snprintf(method, sizeof(method), "caustics.method=%s", params->method);
    assert_int_equal(settings_assign(&settings, method, SETTING_USER, NULL), STATUS_OK);
    for (size_t i = 0; params->assignments[i]; i++)
        assert_int_equal(settings_assign(&settings, params->assignments[i], SETTING_USER, NULL),
                         STATUS_OK);
    return settings;
}

static double now_ms(void)
{
    struct timespec t;
    (void)clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec * 1e3 + (double)t.tv_nsec * 1e-6;
}

/* Runs one frame. Returns its host time in milliseconds, from begin to completion. */
static double run_once(struct run *run, const struct rg_frame *frame, const struct globals *globals)
{
    const double start = now_ms();
    assert_int_equal(rg_exec_begin(run->exec, &run->slot), VK_SUCCESS);
    memcpy(run_data(run, &frame_globals), globals, sizeof(*globals));
    assert_int_equal(rg_exec_submit(run->exec, frame), VK_SUCCESS);
    assert_int_equal(rg_exec_wait(run->exec, run->slot), VK_SUCCESS);
    return now_ms() - start;
}

static void run_method(struct gpu *gpu, const struct settings *settings,
                       const struct globals *globals, uint32_t run_count, struct light_map *map)
{
    static const struct scene scene = { .has_pool = true };
    const struct technique_config config = { .settings = settings, .scene = &scene };
    const struct rg_technique technique = caustics.pass_groups[0].make_passes(&config, NULL);
    const struct rg_frame frame = { .settings = settings };
    struct rg_pass rows[ROWS_MAX];
    struct run run;
    const size_t count = technique.pass_count;
    assert_true(count > 0);
    assert_true(count < ROWS_MAX);
    memcpy(rows, technique.passes, count * sizeof(rows[0]));
    rows[count] = read_row;
    run_open(&run, gpu,
             &(struct run_params){
                 .technique = { "caustics", rows, count + 1 },
                 .outputs = { &texels_out },
             });
    map->ms = run_once(&run, &frame, globals);
    for (uint32_t i = 1; i < run_count; i++)
        map->ms = fmin(map->ms, run_once(&run, &frame, globals));
    const uint16_t *halves = run_data(&run, &texels_out);
    for (size_t i = 0; i < CAUSTIC_MAP_COUNT; i++)
        map->texels[i] = (float)from_half(halves[i]);
    run_close(&run);
}

struct light_map caustic_map_trace(struct gpu *gpu, const struct caustic_map_params *params)
{
    const struct settings settings = settings_of_params(params);
    const struct water_push push = pool_push_of(&settings);
    const double elevation = params->elevation * pi / 180;
    const struct globals globals = {
        .sun_dir = { { (float)cos(elevation), (float)sin(elevation), 0 } },
    };
    const double sine = cos(elevation) / (double)push.water.ior;
    struct light_map map = {
        .texels = calloc(CAUSTIC_MAP_COUNT, sizeof(float)),
        .size = (double)push.pool.size,
        .depth = (double)push.pool.depth,
    };
    assert_non_null(map.texels);
    map.shift_x = -sine / sqrt(1 - sine * sine) * map.depth;
    map.lower[0] = -map.size / 2 - 0.15 * map.depth + fmin(map.shift_x, 0);
    map.lower[1] = -map.size / 2 - 0.15 * map.depth;
    map.texel[0] = (map.size + 0.3 * map.depth + fabs(map.shift_x)) / CAUSTIC_MAP_SIZE;
    map.texel[1] = (map.size + 0.3 * map.depth) / CAUSTIC_MAP_SIZE;
    run_method(gpu, &settings, &globals, params->run_count, &map);
    for (size_t i = 0; i < CAUSTIC_MAP_COUNT; i++)
        map.total += (double)map.texels[i] * map.texel[0] * map.texel[1] / (map.size * map.size);
    return map;
}

double caustic_map_position(const struct light_map *map, size_t axis, size_t index)
{
    return map->lower[axis] + ((double)index + 0.5) * map->texel[axis];
}
