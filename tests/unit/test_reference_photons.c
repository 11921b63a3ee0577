/*
 * test_reference_photons.c: caustics of the sun in the reference renderer, against closed forms: a
 * slab, a ball's focus, the shadow's edge.
 */
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>

#include "tests/support/assertions.h"
#include "tests/support/picture.h"
#include "tests/support/reference_ray.h"

static const double ratio = 1.3091 / 1.0003;

enum {
    SIDE = 80, /* pixels */
    PIXELS = SIDE * SIDE,
};

/* ---- scenes ---- */

/* Adds a white floor at a height. */
static void add_floor(struct scene *scene, float height)
{
    struct mesh *floor = &scene->model.surroundings;
    assert_true(mesh_init(floor, 3, 3));
    for (uint32_t i = 0; i < 3; i++) {
        floor->vertices[i] = (struct mesh_vertex){
            .position = { { i == 1 ? 4000 : -1000, height, i == 2 ? 4000 : -1000 } },
            .normal = { { 0, 1, 0 } },
            .color = glms_vec3_one(),
        };
        floor->indices[i] = 2 - i;
    }
}

/* A slab 20 m across, over a floor at 0. */
static struct scene slab_scene(void)
{
    static const uint32_t corners[2][6] = { { 0, 2, 1, 1, 2, 3 }, { 0, 1, 2, 1, 3, 2 } };
    static const float least[3] = { -10, 1, -10 }, most[3] = { 10, 1.25F, 10 };
    struct scene scene = { 0 };
    struct mesh *box = &scene.model.object;
    assert_true(mesh_init(box, 24, 36));
    for (uint32_t i = 0; i < 24; i++) {
        const uint32_t axis = i / 8, u = (axis + 1) % 3, v = (axis + 2) % 3;
        const bool is_far = i / 4 % 2;
        struct mesh_vertex *vertex = &box->vertices[i];
        vertex->normal.raw[axis] = is_far ? 1 : -1;
        vertex->position.raw[axis] = is_far ? most[axis] : least[axis];
        vertex->position.raw[u] = i % 2 ? most[u] : least[u];
        vertex->position.raw[v] = i / 2 % 2 ? most[v] : least[v];
    }
    for (uint32_t i = 0; i < 36; i++)
        box->indices[i] = 4 * (i / 6) + corners[i / 6 % 2][i % 6];
    scene.box = mesh_box(box);
    add_floor(&scene, 0);
    return scene;
}

/* Looks straight down at the floor, `half` metres to each side. */
static struct render_result look_down(const struct scene *scene, const struct settings *settings,
                                      float eye, float half, uint32_t threads)
{
    const struct reference_request request = {
        .scene = scene,
        .settings = settings,
        .width = SIDE,
        .height = SIDE,
        .linear = true,
        .threads = threads,
    };
    const float height = eye - scene->model.surroundings.vertices[0].position.y;
    const struct renderer_shot shot = { .camera = {
                                            .eye = { { 0, eye, 0 } },
                                            .target = { { 0, eye - 1, -1e-4F } },
                                            .fov_deg = 2 * atanf(half / height) * 57.29578F,
                                        } };
    return reference_ray_render_image(&request, &shot);
}

/* Returns the mean of pixels within a distance of the middle, metres. */
static double mean_within(const struct render_result *result, double half, double distance)
{
    const float *red = image_find(&result->image, "R");
    double sum = 0;
    int count = 0;
    for (int i = 0; i < PIXELS; i++) {
        const double x = half * (2 * (i % SIDE + 0.5) / SIDE - 1);
        const double y = half * (2 * (floor((double)i / SIDE) + 0.5) / SIDE - 1);
        const bool is_within = hypot(x, y) < distance;
        sum += is_within ? (double)red[i] : 0;
        count += is_within;
    }
    return sum / count;
}

/* ---- a slab ---- */

/* Below a slab the sun's light is what both its faces let pass, (1 - R) / (1 + R), less what the
 * ice absorbs; without photons it is not changed. */
static void test_slab(void **state)
{
    static const char *const elevations[] = { "sky.sun_elevation=30", "sky.sun_elevation=80" };
    static const double degrees[] = { 60, 10 };
    struct scene scene = slab_scene();
    (void)state;
    for (int i = 0; i < 2; i++) {
        const struct settings lit = SETTINGS(elevations[i], "ice_caustics.light=sun",
                                             "reference.photons=300000", "absorb.red=0.5");
        const struct settings open = SETTINGS(elevations[i], "absorb.red=0.5");
        const struct settings dark =
            SETTINGS(elevations[i], "sky.sun_strength=0", "absorb.red=0.5");
        const struct settings *const all[] = { &lit, &open, &dark };
        double means[3];
        for (int k = 0; k < 3; k++) {
            struct render_result result = look_down(&scene, all[k], 0.9F, 1.5F, 0);
            means[k] = mean_within(&result, 1.5, 9);
            render_result_finish(&result);
        }
        const double angle = degrees[i] * REFERENCE_RAY_PI / 180;
        const double r = reference_ray_fresnel(angle, 1.0003, 1.3091);
        const double kept = exp(-0.5 * 0.25 / sqrt(1 - pow(sin(angle) / ratio, 2)));
        const double passing = (1 - r) * (1 - r) * kept / (1 - r * r * kept * kept);
        CHECK_NEAR((means[0] - means[2]) / (means[1] - means[2]) / passing, 1, 0.01);
    }
    scene_finish(&scene);
}

/* ---- a ball ---- */

/* Returns the light within a distance of a ball's axis, on a plane so far from its middle: what
 * enters at all distances b from the axis, which both refractions turn towards it. */
static double focussed(double plane, double distance)
{
    const int steps = 20000;
    double sum = 0;
    for (int i = 0; i < steps; i++) {
        const double b = (i + 0.5) / steps;
        const double turn = 2 * (asin(b) - asin(b / ratio));
        const double r = reference_ray_fresnel(asin(b), 1.0003, 1.3091);
        const double at = (b - plane * sin(turn)) / cos(turn);
        sum += fabs(at) < distance ? 2 * b * (1 - r) * (1 - r) / steps : 0;
    }
    return sum / (distance * distance);
}

/* The focus of a ball is where the law of refraction puts it, and as bright. */
static void test_ball(void **state)
{
    static const double planes[] = { 1.5, 2 };
    (void)state;
    for (int i = 0; i < 2; i++) {
        struct scene scene = picture_sphere_scene(glms_vec3_zero(), 20000);
        const char *const up = "sky.sun_elevation=89.9";
        const struct settings lit =
            SETTINGS(up, "ice_caustics.light=sun", "caustics.sun=0.01", "reference.photons=400000");
        const struct settings open = SETTINGS(up);
        const struct settings dark = SETTINGS(up, "sky.sun_strength=0");
        const struct settings *const all[] = { &lit, &open, &dark };
        double near[3], wide[3];
        add_floor(&scene, -(float)planes[i]);
        for (int k = 0; k < 3; k++) {
            struct render_result result = look_down(&scene, all[k], -1.1F, 0.6F, 0);
            near[k] = mean_within(&result, 0.6, 0.2);
            wide[k] = mean_within(&result, 0.6, 0.5);
            render_result_finish(&result);
        }
        CHECK_NEAR((near[0] - near[2]) / (near[1] - near[2]) / focussed(planes[i], 0.2), 1, 0.02);
        CHECK_NEAR((wide[0] - wide[2]) / (wide[1] - wide[2]) / focussed(planes[i], 0.5), 1, 0.01);
        scene_finish(&scene);
    }
}

/* ---- the shadow ---- */

/* Beside the shadow the sun shines as without ice; without ice_caustics.shadow it does everywhere,
 * and no photons are neither light nor shadow. The same bytes for any number of threads. */
static void test_shadow(void **state)
{
    struct scene scene = picture_sphere_scene((vec3s){ { 0, 3, 0 } }, 960);
    const struct settings open = SETTINGS("sky.sun_elevation=45");
    const struct settings none =
        SETTINGS("sky.sun_elevation=45", "ice_caustics.light=sun", "reference.photons=0");
    const struct settings black = SETTINGS("sky.sun_elevation=45", "ice_caustics.light=sun",
                                           "absorb.red=100", "reference.photons=4000");
    const struct settings added =
        SETTINGS("sky.sun_elevation=45", "ice_caustics.light=sun", "ice_caustics.shadow=off",
                 "absorb.red=100", "reference.photons=4000");
    const struct settings *const all[] = { &open, &none, &black, &added, &black };
    struct render_result results[5];
    int hidden = 0;
    (void)state;
    add_floor(&scene, 0);
    for (int k = 0; k < 5; k++)
        results[k] = look_down(&scene, all[k], 1.5F, 5, k < 4 ? 3 : 1);
    const float *reds[5];
    for (int k = 0; k < 5; k++)
        reds[k] = image_find(&results[k].image, "R");
    assert_memory_equal(reds[0], reds[1], PIXELS * sizeof(float));
    for (int i = 0; i < PIXELS; i++) {
        assert_true(reds[2][i] <= reds[3][i] && reds[0][i] <= reds[3][i]);
        hidden += reds[2][i] < 0.7F * reds[0][i];
    }
    /* the shadow of a ball on level ground: an ellipse, as wide as the ball and longer by the sun's
     * height; what the ball's face reflects is the rest */
    CHECK_NEAR(hidden * 100.0 / PIXELS, REFERENCE_RAY_PI / sin(REFERENCE_RAY_PI / 4), 0.6);
    assert_memory_equal(reds[2], reds[4], PIXELS * sizeof(float));
    for (int k = 0; k < 5; k++)
        render_result_finish(&results[k]);
    scene_finish(&scene);
}

/* ---- progress ---- */

struct watch {
    uint32_t calls, done;
};

static bool stop_at_second(void *user, uint32_t done, uint32_t all)
{
    struct watch *watch = user;
    (void)all;
    watch->done = done;
    return ++watch->calls < 2;
}

/* Who stops a picture need not wait for its photons. */
static void test_stopped(void **state)
{
    struct scene scene = slab_scene();
    const struct settings lit = SETTINGS("ice_caustics.light=sun", "reference.photons=20000");
    const struct reference_request request = {
        .scene = &scene,
        .settings = &lit,
        .width = SIDE,
        .height = SIDE,
        .linear = true,
        .threads = 1,
    };
    const struct renderer_shot shot = { .camera = { .eye = { { 0, 9, 1 } }, .fov_deg = 40 } };
    struct render_result result = { 0 };
    struct reference *reference;
    struct watch watch = { 0 };
    (void)state;
    assert_int_equal(reference_create(&reference, &request), STATUS_OK);
    assert_int_equal(reference_render(reference, &shot, &result, stop_at_second, &watch),
                     STATUS_FAILED);
    assert_int_equal(watch.calls, 2);
    assert_int_equal(watch.done, 0);
    assert_int_equal(result.image.plane_count, 0);
    reference_destroy(reference);
    scene_finish(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_slab),
        cmocka_unit_test(test_ball),
        cmocka_unit_test(test_shadow),
        cmocka_unit_test(test_stopped),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
