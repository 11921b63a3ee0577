/*
 * bench.c: what the render graph adds to a frame: frames by firn (a) and by hand (b), of the same
 * shaders, targets and draws, in turn; and a yardstick, passes that fetch each texel and write it,
 * by which other days compare. Fails if both do not draw the same picture, or if the median of a/b
 * is above 1.05.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/bench/frame/by_hand.h"
#include "tests/support/assertions.h"

#include "src/base/clock.h"

enum {
    WIDTH = 1024,
    HEIGHT = 768,
    WARM_UP = 3,
    RUN_COUNT = 25,
    FETCH_COUNT = 10,
};

#define MOST 1.05

static const char *const plain[] = {
    "air.count=0",     "cracks.count=0",     "bubbles.count=0",   "light.count=0",
    "bump.strength=0", "env_cube.always=on", "env_cube.size=512",
};

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a;
    const double y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median(double *values)
{
    qsort(values, RUN_COUNT, sizeof(*values), compare);
    return values[RUN_COUNT / 2];
}

/* A frame of the renderer, waited for. */
static double time_graph(struct renderer *renderer, const struct renderer_shot *shot)
{
    const double start = clock_ms();
    assert_int_equal(renderer_draw(renderer, shot), STATUS_OK);
    assert_int_equal(renderer_wait(renderer), STATUS_OK);
    return clock_ms() - start;
}

static double time_hand(struct by_hand *by_hand)
{
    const double start = clock_ms();
    by_hand_draw(by_hand);
    return clock_ms() - start;
}

static double time_fetch(struct by_hand *by_hand)
{
    const double start = clock_ms();
    by_hand_fetch(by_hand, FETCH_COUNT);
    return clock_ms() - start;
}

/* Prints a row; returns a/b. */
static double measure(const char *name, struct renderer *renderer, const struct renderer_shot *shot,
                      struct by_hand *by_hand)
{
    double graph[RUN_COUNT], hand[RUN_COUNT], ratio[RUN_COUNT], fetch[RUN_COUNT];
    for (int run = -WARM_UP; run < RUN_COUNT; run++) {
        const size_t i = run < 0 ? 0 : (size_t)run;
        graph[i] = time_graph(renderer, shot);
        hand[i] = time_hand(by_hand);
        fetch[i] = time_fetch(by_hand);
        ratio[i] = graph[i] / hand[i];
    }
    const double a_by_b = median(ratio);
    printf("%-10s %9.2f %9.2f %9.3f %9.2f\n", name, median(graph), median(hand), a_by_b,
           median(fetch) / FETCH_COUNT);
    return a_by_b;
}

static void check_picture(const struct renderer_params *params, const struct renderer_shot *shot,
                          struct by_hand *by_hand)
{
    struct renderer_params wanted = *params;
    struct renderer *renderer;
    struct render_result result = { 0 };
    wanted.keep = false;
    wanted.display = true;
    assert_int_equal(renderer_create(&renderer, &wanted), STATUS_OK);
    assert_int_equal(renderer_render(renderer, shot, &result, NULL, NULL), STATUS_OK);
    by_hand_draw(by_hand);
    assert_memory_equal(result.rgba, by_hand_picture(by_hand), (size_t)WIDTH * HEIGHT * 4);
    render_result_finish(&result);
    renderer_destroy(renderer);
}

static double bench_scene(struct gpu *gpu, const char *name)
{
    struct settings settings = settings_default();
    struct scene scene;
    struct uploaded_scene uploaded;
    struct renderer *renderer;
    for (size_t i = 0; i < sizeof(plain) / sizeof(plain[0]); i++)
        assert_int_equal(settings_assign(&settings, plain[i], SETTING_USER, NULL), STATUS_OK);
    assert_int_equal(scene_load(&scene, &(struct scene_params){ .name = name }), STATUS_OK);
    assert_int_equal(uploaded_scene_init(&uploaded, gpu, &scene), STATUS_OK);
    const float distance = camera_framing_distance(box_diagonal(scene.box), 45.0F, WIDTH, HEIGHT);
    const struct renderer_shot shot = {
        .camera = camera_orbit(20, 12, distance, box_center(scene.box), 45.0F),
    };
    const struct renderer_params params = {
        .gpu = gpu,
        .scene = &scene,
        .uploaded = &uploaded,
        .settings = &settings,
        .refraction = techniques_find_refraction("paper"),
        .width = WIDTH,
        .height = HEIGHT,
        .keep = true,
    };
    assert_int_equal(renderer_create(&renderer, &params), STATUS_OK);
    struct by_hand *by_hand = by_hand_create(
        &(struct by_hand_params){ gpu, &scene, &uploaded, &settings, shot.camera, WIDTH, HEIGHT });
    check_picture(&params, &shot, by_hand);
    const double ratio = measure(name, renderer, &shot, by_hand);
    renderer_destroy(renderer);
    by_hand_destroy(by_hand);
    uploaded_scene_finish(&uploaded, gpu);
    scene_finish(&scene);
    return ratio;
}

int main(void)
{
    static const char *const scenes[] = { "sphere", "valley", "teapot", "room" };
    struct gpu gpu;
    bool slow = false;
    if (gpu_create(&gpu, &(struct gpu_params){ 0 }) != STATUS_OK)
        return EXIT_FAILURE;
    printf("frames of %d x %d on %s, ms, medians of %d\n\n%-10s %9s %9s %9s %9s\n", WIDTH, HEIGHT,
           gpu.properties.deviceName, RUN_COUNT, "scene", "graph", "by hand", "a/b", "a fetch");
    for (size_t i = 0; i < sizeof(scenes) / sizeof(scenes[0]); i++)
        slow |= bench_scene(&gpu, scenes[i]) > MOST;
    gpu_destroy(&gpu);
    return slow ? EXIT_FAILURE : EXIT_SUCCESS;
}
