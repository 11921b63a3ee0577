/*
 * test_profile.c: contents of frame profiles, except durations. How long anything takes is no
 * test's business.
 */
#include <math.h>
#include <string.h>

#include "tests/support/assertions.h"

#include "src/lab/profile/measure_frames.h"
#include "src/render/renderer_internal.h"
#include "tests/support/lavapipe.h"
#include "tests/support/picture.h"

enum {
    RUNS = 4,
    WARMUP = 2,
    SIDE = 64,
};

static void count_runs(void *user, uint32_t done, uint32_t all)
{
    uint32_t *calls = user;
    assert_int_equal(done, ++*calls);
    assert_int_equal(all, RUNS + WARMUP);
}

static void measure(struct gpu *gpu, enum rg_clock clock, struct profile *profile)
{
    const struct settings settings = picture_settings("motion.ice=20");
    struct scene scene = { 0 };
    assert_int_equal(scene_load(&scene, &(struct scene_params){ .name = "sphere" }), STATUS_OK);
    const struct profile_request request = {
        .renderer = { .gpu = gpu,
                      .scene = &scene,
                      .settings = &settings,
                      .refraction = techniques_refraction(0),
                      .width = SIDE,
                      .height = SIDE },
        .camera = camera_orbit(28, 9, 4, box_center(scene.box), 45),
        .clock = clock,
        .warmup = WARMUP,
        .run_count = RUNS,
        .time = 1,
        .time_step = 0.5,
    };
    uint32_t calls = 0;
    assert_int_equal(profile_measure(&request, profile, count_runs, &calls), STATUS_OK);
    assert_int_equal(calls, RUNS + WARMUP);
    scene_finish(&scene);
}

/* In every run the rows are the frame, and passes lie one behind the other. By timestamps, those
 * that do not run take no time. */
static void check_runs(const struct profile *p, bool by_one_clock)
{
    for (uint32_t run = 0; run < RUNS; run++) {
        double sum = 0;
        double end = 0;
        uint32_t drawn = 0;
        for (uint32_t i = 0; i < p->row_count; i++) {
            const struct profile_row *row = &p->rows[i];
            sum += row->ms[run];
            if (i >= p->pass_count)
                continue;
            assert_true(row->ms[run] >= 0);
            drawn += row->ms[run] > 0 ? 1 : 0;
            assert_true(row->begin_ms[run] >= end - 1e-9);
            assert_true(row->record_ms[run] > 0);
            end = row->begin_ms[run] + row->ms[run];
        }
        assert_true(by_one_clock ? drawn == p->pass_count : drawn > 0 && drawn < p->pass_count);
        assert_float_equal((float)(sum / p->frame[run]), 1, 1e-6F);
        assert_true(end < p->frame[run] && p->wait[run] < p->frame[run] && p->plain[run] > 0);
        assert_true(!by_one_clock || p->rows[p->row_count - 1].ms[run] > 0);
    }
}

static const struct profile_row *find_row(const struct profile *p, const char *name)
{
    for (uint32_t i = 0; i < p->row_count; i++) {
        if (!strcmp(p->rows[i].name, name))
            return &p->rows[i];
    }
    fail_msg("no row %s", name);
    return NULL;
}

static void check_frame(const struct profile *p)
{
    const struct profile_row *screen = find_row(p, "tonemap.screen");
    const struct profile_row *sky = find_row(p, "env_cube.sky");
    const struct profile_row *back = find_row(p, "ice_normal.back");
    assert_string_equal(screen->technique, "tonemap");
    assert_int_equal(screen->kind, PROFILE_RASTER);
    assert_int_equal(screen->covered, (size_t)SIDE * SIDE);
    assert_int_equal(screen->triangles, 1);
    assert_int_equal(screen->target_bytes, 4 * (size_t)SIDE * SIDE);
    assert_int_equal(screen->width, SIDE);
    assert_int_equal(sky->repetition_count, 6);
    assert_int_equal(sky[1].repetition, 1);
    assert_int_equal(back->triangles, 960);
    assert_true(back->covered > 0 && back->covered < (size_t)SIDE * SIDE);
    assert_int_equal(p->rows[p->row_count - 1].kind, PROFILE_UNATTRIBUTED);
    for (uint32_t i = 0; i < p->resident_count; i++) {
        assert_true(p->residents[i].first_pass <= p->residents[i].last_pass);
        assert_true(p->residents[i].last_pass < p->pass_count);
        assert_true(p->residents[i].offset + p->residents[i].size <= p->memory_used);
    }
    assert_true(p->resident_count > 0);
}

static void rows_are_the_frame(void **state)
{
    static const enum rg_clock clocks[] = { RG_CLOCK_EXACT, RG_CLOCK_SUBMITS };

    for (size_t i = 0; i < 2; i++) {
        struct profile profile;
        measure(*state, clocks[i], &profile);
        check_runs(&profile, clocks[i] == RG_CLOCK_SUBMITS);
        check_frame(&profile);
        profile_finish(&profile);
    }
}

/* Frames left on the device are those that come back. */
static void a_kept_frame_is_the_picture(void **state)
{
    const struct settings settings = picture_settings("motion.ice=20");
    struct scene scene = { 0 };
    struct renderer *renderer;
    struct render_result first;
    struct render_result again;
    assert_int_equal(scene_load(&scene, &(struct scene_params){ .name = "sphere" }), STATUS_OK);
    const struct renderer_shot shot = {
        .camera = camera_orbit(28, 9, 4, box_center(scene.box), 45),
    };
    assert_int_equal(
        renderer_create(&renderer,
                        &(struct renderer_params){ .gpu = *state,
                                                   .scene = &scene,
                                                   .settings = &settings,
                                                   .refraction = techniques_refraction(0),
                                                   .width = SIDE,
                                                   .height = SIDE,
                                                   .display = true,
                                                   .keep = true }),
        STATUS_OK);
    assert_true(renderer_display_image(renderer) != VK_NULL_HANDLE);
    assert_int_equal(renderer_render(renderer, &shot, &first, NULL, NULL), STATUS_OK);
    for (uint32_t i = 0; i < 3; i++)
        assert_int_equal(renderer_draw(renderer, &(struct renderer_shot){ shot.camera, (float)i }),
                         STATUS_OK);
    assert_int_equal(renderer_wait(renderer), STATUS_OK);
    assert_int_equal(renderer_render(renderer, &shot, &again, NULL, NULL), STATUS_OK);
    assert_memory_equal(first.rgba, again.rgba, (size_t)SIDE * SIDE * 4);
    render_result_finish(&first);
    render_result_finish(&again);
    renderer_destroy(renderer);
    scene_finish(&scene);
}

/* Of a view that changes, a sample is read back, and a picture that is only shown is not. */
static void a_shown_frame_stays_on_the_device(void **state)
{
    bool is_done;
    static uint16_t sample[SIDE * SIDE * 4];
    const struct settings settings = settings_default();
    const vec3s gray = { { 0.5F, 0.5F, 0.5F } };
    struct scene scene = { 0 };
    struct renderer *renderer;
    assert_int_equal(
        scene_load(&scene, &(struct scene_params){ .name = "sphere", .background = &gray }),
        STATUS_OK);
    struct renderer_shot shot = { .camera = camera_orbit(28, 9, 4, box_center(scene.box), 45) };
    assert_int_equal(
        renderer_create(&renderer,
                        &(struct renderer_params){ .gpu = *state,
                                                   .scene = &scene,
                                                   .settings = &settings,
                                                   .refraction = techniques_refraction(0),
                                                   .width = SIDE,
                                                   .height = SIDE,
                                                   .display = true,
                                                   .keep = true,
                                                   .refines = true }),
        STATUS_OK);
    assert_int_equal(renderer_refine(renderer, &shot, 0, HUGE_VAL, &is_done), STATUS_OK);
    const uint32_t slot = renderer->last_slot;
    const void *texels = renderer_read_back(&renderer->image, frame_beauty.image, slot);
    memcpy(sample, texels, sizeof(sample));
    shot.camera = camera_orbit(90, 40, 3, box_center(scene.box), 45);
    for (uint32_t i = 0; i < 2; i++) {
        assert_int_equal(renderer_draw(renderer, &shot), STATUS_OK);
        assert_int_equal(renderer_wait(renderer), STATUS_OK);
    }
    assert_int_equal(renderer->last_slot, slot);
    assert_memory_equal(texels, sample, sizeof(sample));
    assert_int_equal(renderer_refine(renderer, &shot, 0, HUGE_VAL, &is_done), STATUS_OK);
    assert_int_equal(renderer_refine(renderer, &shot, 1, HUGE_VAL, &is_done), STATUS_OK);
    assert_memory_not_equal(texels, sample, sizeof(sample));
    renderer_destroy(renderer);
    scene_finish(&scene);
}

/* Draws two samples in parts of a duration. Returns the number of parts. */
static uint32_t refine(struct renderer *renderer, const struct renderer_shot *shot, double seconds)
{
    uint32_t parts = 0;
    for (uint32_t sample = 0; sample < 2; parts++) {
        bool is_done;
        assert_int_equal(renderer_refine(renderer, shot, sample, seconds, &is_done), STATUS_OK);
        sample += is_done;
    }
    return parts;
}

static void samples_in_parts_are_those_drawn_at_once(void **state)
{
    static float whole[SIDE * SIDE];
    const struct settings settings = settings_default();
    struct scene scene = { 0 };
    struct renderer *renderer;
    bool is_done = true;
    assert_int_equal(scene_load(&scene, &(struct scene_params){ .name = "sphere" }), STATUS_OK);
    const struct renderer_shot shot = { .camera =
                                            camera_orbit(28, 9, 4, box_center(scene.box), 45) };
    assert_int_equal(
        renderer_create(&renderer,
                        &(struct renderer_params){ .gpu = *state,
                                                   .scene = &scene,
                                                   .settings = &settings,
                                                   .refraction = techniques_refraction(0),
                                                   .width = SIDE,
                                                   .height = SIDE,
                                                   .keep = true,
                                                   .refines = true,
                                                   .samples = 2 }),
        STATUS_OK);
    assert_int_equal(refine(renderer, &shot, HUGE_VAL), 2);
    const float *sums = renderer_sums(renderer)->planes[0].texels;
    memcpy(whole, sums, sizeof(whole));
    for (uint32_t parts = 1; parts < 40; parts += 19) { /* the sample is abandoned */
        for (uint32_t i = 0; i < parts; i++)
            assert_int_equal(renderer_refine(renderer, &shot, 0, 0.0, &is_done), STATUS_OK);
        assert_false(is_done);
        assert_int_equal(renderer_abandon(renderer), STATUS_OK);
    }
    assert_true(refine(renderer, &shot, 0.0) > 40);
    assert_memory_equal(renderer_sums(renderer)->planes[0].texels, whole, sizeof(whole));
    assert_int_equal(renderer_refine(renderer, &shot, 0, HUGE_VAL, &is_done), STATUS_OK);
    while (renderer->sample != SAMPLE_WEIGHTED)
        assert_int_equal(renderer_refine(renderer, &shot, 1, 0.0, &is_done), STATUS_OK);
    assert_int_equal(renderer_abandon(renderer), STATUS_OK); /* of a sample in one of the sums */
    assert_int_equal(renderer_refine(renderer, &shot, 1, 0.0, &is_done), STATUS_OK);
    assert_true(is_done);
    assert_memory_equal(renderer_sums(renderer)->planes[0].texels, whole, sizeof(whole));
    renderer_destroy(renderer);
    scene_finish(&scene);
}

/* The device is described as smaller than it is. */
static void a_picture_that_does_not_fit_is_refused(void **state)
{
    const struct gpu *real = *state;
    struct gpu gpu = *real;
    const struct settings settings = settings_default();
    struct scene scene;
    struct renderer *renderer;
    const vec3s gray = { { 0.5F, 0.5F, 0.5F } };
    const struct scene_params bare = { .name = "sphere", .background = &gray };
    assert_int_equal(scene_load(&scene, &bare), STATUS_OK);
    const struct renderer_params params = {
        .gpu = &gpu,
        .scene = &scene,
        .settings = &settings,
        .refraction = techniques_refraction(0),
        .width = SIDE,
        .height = SIDE,
        .display = true,
    };
    gpu.properties.limits.maxImageDimension2D = SIDE - 1;
    assert_int_equal(renderer_create(&renderer, &params), STATUS_USAGE);
    assert_null(renderer);

    gpu = *real;
    gpu.properties.deviceType = VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU;
    for (uint32_t i = 0; i < gpu.memory.memoryHeapCount; i++)
        gpu.memory.memoryHeaps[i].size = 1 << 20; /* less than the environment's cube */
    assert_int_equal(renderer_create(&renderer, &params), STATUS_TRY_AGAIN);
    assert_null(renderer);
    scene_finish(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_DEVICE(rows_are_the_frame),
        ON_DEVICE(a_kept_frame_is_the_picture),
        ON_DEVICE(a_shown_frame_stays_on_the_device),
        ON_DEVICE(samples_in_parts_are_those_drawn_at_once),
        ON_DEVICE(a_picture_that_does_not_fit_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
