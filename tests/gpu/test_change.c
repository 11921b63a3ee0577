/*
 * test_change.c: a renderer that is changed to other params draws images bit-identical to those of
 * a new one, and leaks nothing: other size, refraction model, plan settings, sample count, and
 * back.
 */
#include <stdlib.h>
#include <string.h>

#include "tests/support/assertions.h"
#include "tests/support/lavapipe.h"
#include "tests/support/picture.h"

enum {
    SIZE = 32
};

/* What a request asks for, and the setting in it. */
struct wish {
    const char *refraction, *setting;
    uint32_t width, samples;
    bool display;
};

static const struct wish wishes[] = {
    { "paper", "light.count=0", SIZE, 1, false },
    { "paper", "light.count=0", 3 * SIZE / 2, 1, false },
    { "one-sided", "env_cube.dynamic=off", SIZE, 2, true },
    { "bounce", "light.count=1", SIZE, 1, true },
    { "paper", "light.count=0", SIZE, 1, false },
};

enum {
    WISH_COUNT = sizeof(wishes) / sizeof(wishes[0])
};

static void check_same(const struct render_result *a, const struct render_result *b)
{
    const size_t count = (size_t)a->image.width * a->image.height;
    assert_int_equal(a->image.width, b->image.width);
    assert_int_equal(a->image.plane_count, b->image.plane_count);
    for (uint32_t p = 0; p < a->image.plane_count; p++)
        assert_memory_equal(image_find(&a->image, a->image.planes[p].name),
                            image_find(&b->image, a->image.planes[p].name), count * sizeof(float));
    assert_int_equal(!a->rgba, !b->rgba);
    if (a->rgba)
        assert_memory_equal(a->rgba, b->rgba, 4 * count);
}

static void changed_renderers_draw_as_new_ones(void **state)
{
    struct scene scene = picture_sphere_scene((vec3s){ { 0, 0, 0 } }, 960);
    struct settings settings[WISH_COUNT];
    struct picture_stage stage;
    picture_use_directions(&scene, 64);
    for (uint32_t i = 0; i < WISH_COUNT; i++) {
        settings[i] = picture_settings(wishes[i].setting);
        const struct picture_request request = {
            .scene = &scene,
            .settings = &settings[i],
            .refraction = wishes[i].refraction,
            .camera = { .eye = { { 0, 0, 3 } }, .fov_deg = 50 },
            .width = wishes[i].width,
            .height = SIZE,
            .samples = wishes[i].samples,
            .display = wishes[i].display,
        };
        if (i == 0)
            picture_begin(&stage, *state, &request);
        else
            picture_change(&stage, &request);
        struct render_result changed = picture_take(&stage, &request);
        struct render_result fresh = picture_render(*state, &request);
        check_same(&changed, &fresh);
        render_result_finish(&changed);
        render_result_finish(&fresh);
    }
    picture_end(&stage);
    scene_finish(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(changed_renderers_draw_as_new_ones),
    };
    return RUN_ON_DEVICE(tests);
}
