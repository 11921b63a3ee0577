/* test_air.c: planar layers of fine bubbles in ice (air planes): their density rises towards the
 * centre, they are clipped to the ice, and they are lit. */
#include <math.h>
#include <stdlib.h>

#include "src/file/half_float.h"
#include "tests/support/assertions.h"
#include "tests/support/lavapipe.h"
#include "tests/support/picture.h"

enum {
    SIZE = 256,
};

static const float distance = 4;

static void open_scene(struct scene *scene, const char *name, uint32_t count, uint32_t seed)
{
    const struct scene_params params = {
        .name = name,
        .air = { .count = count, .seed = seed, .size = 0.01F, .frequency = 24 },
    };
    assert_int_equal(scene_load(scene, &params), STATUS_OK);
}

static struct picture_request request_of(const struct scene *scene, float azimuth, float elevation)
{
    return (struct picture_request){
        .scene = scene,
        .camera = camera_orbit(azimuth, elevation, distance, box_center(scene->box), 40),
        .width = SIZE,
        .height = SIZE,
        .layers =
            picture_layer_bit("air") | picture_layer_bit("thickness") | picture_layer_bit("exit"),
    };
}

/* Mean opacity in rings around the sphere's middle, by the sine of the angle of incidence. */
static void density_rises_towards_the_middle(void **state)
{
    static const float views[][2] = { { 0, 0 }, { 100, 40 }, { 220, -50 } };
    struct scene scene;
    open_scene(&scene, "sphere", 19, 1);
    struct picture_stage stage;
    const struct picture_request first = request_of(&scene, 0, 0);
    picture_begin(&stage, *state, &first);
    for (size_t v = 0; v < 3; v++) {
        const struct picture_request request = request_of(&scene, views[v][0], views[v][1]);
        struct render_result result = picture_take(&stage, &request);
        const float *alpha = image_find(&result.image, "air.A");
        const struct vec eye = vec_from(request.camera.eye);
        double sums[4] = { 0 };
        size_t counts[4] = { 0 };
        for (size_t i = 0; i < (size_t)SIZE * SIZE; i++) {
            const double b = vec_norm(vec_cross(eye, picture_pixel_ray(&request, i)));
            if (b >= 1)
                continue;
            sums[(size_t)(4 * b)] += (double)alpha[i];
            counts[(size_t)(4 * b)]++;
        }
        for (size_t r = 0; r < 4; r++) {
            sums[r] /= (double)counts[r];
            print_message("%.3f\n", sums[r]);
            assert_true(!r || sums[r] < 0.9 * sums[r - 1]);
        }
        assert_true(sums[0] > 0.3 && sums[0] < 0.95);
        render_result_finish(&result);
    }
    picture_end(&stage);
    scene_finish(&scene);
}

/* As many planes as there can be; the scenes' corners are far from their middles. */
static void clipped_to_the_ice(void **state)
{
    for (const struct scene_builtin *object = scene_builtins; object->name && object->generate;
         object++) {
        struct scene scene;
        open_scene(&scene, object->name, GENERATE_AIR_MAX, 1);
        const struct picture_request request = request_of(&scene, 30, 20);
        struct render_result result = picture_render(*state, &request);
        const float *alpha = image_find(&result.image, "air.A");
        const float *thickness = image_find(&result.image, "thickness.Z");
        size_t seen = 0;
        for (size_t i = 0; i < (size_t)SIZE * SIZE; i++) {
            assert_true(alpha[i] >= 0.0F && alpha[i] <= 1.0F);
            assert_true(alpha[i] == 0.0F || thickness[i] > 0.0F);
            seen += alpha[i] > 0.0F;
        }
        assert_true(seen > 1000);
        render_result_finish(&result);
        scene_finish(&scene);
    }
}

/* Nothing but one plane as wide as the sphere, square to the z axis. */
static void set_plane(struct scene *scene, float z)
{
    static const uint32_t corners[6] = { 0, 1, 2, 2, 1, 3 };
    mesh_finish(&scene->inclusions.air);
    assert_true(mesh_init(&scene->inclusions.air, 4, 6));
    for (uint32_t i = 0; i < 6; i++)
        scene->inclusions.air.indices[i] = corners[i];
    for (uint32_t i = 0; i < 4; i++) {
        const vec2s uv = { { (float)(i % 2), i < 2 ? 0 : 1 } };
        scene->inclusions.air.vertices[i] = (struct mesh_vertex){
            .position = { { 2 * uv.x - 1, 1 - 2 * uv.y, z } },
            .normal = { { 0, 0, 1 } },
            .uv = uv,
            .material = 1,
        };
    }
}

/* A plane behind the sphere, one through it, one before it: only the middle one is seen. */
static void clipped_in_depth(void **state)
{
    struct scene scene;
    open_scene(&scene, "sphere", 1, 1);
    double sums[3] = { 0 };
    for (size_t k = 0; k < 3; k++) {
        set_plane(&scene, 1.02F * ((float)k - 1));
        const struct picture_request request = request_of(&scene, 0, 0);
        struct render_result result = picture_render(*state, &request);
        const float *alpha = image_find(&result.image, "air.A");
        for (size_t i = 0; i < (size_t)SIZE * SIZE; i++)
            sums[k] += (double)alpha[i];
        render_result_finish(&result);
    }
    assert_true(sums[1] > 100.0);
    assert_true(sums[0] <= 0.0 && sums[2] <= 0.0);
    scene_finish(&scene);
}

/* The most opaque pixel of a plane through the middle that is turned from the view's axis. */
static float seen_at(struct picture_stage *stage, float azimuth)
{
    const struct picture_request request = request_of(stage->request.scene, azimuth, 0);
    struct render_result result = picture_take(stage, &request);
    const float *alpha = image_find(&result.image, "air.A");
    float most = 0;
    for (size_t i = 0; i < (size_t)SIZE * SIZE; i++)
        most = fmaxf(most, alpha[i]);
    render_result_finish(&result);
    return most;
}

/* From behind as from before; hardly edge on. */
static void fades_edge_on(void **state)
{
    struct scene scene;
    struct picture_stage stage;
    open_scene(&scene, "sphere", 1, 1);
    set_plane(&scene, 0);
    const struct picture_request request = request_of(&scene, 0, 0);
    picture_begin(&stage, *state, &request);
    const float before = seen_at(&stage, 0);
    assert_true(before > 0.2F);
    CHECK_NEAR(seen_at(&stage, 180), before, 0.05);
    assert_true(seen_at(&stage, 87) < 0.3F * before);
    picture_end(&stage);
    scene_finish(&scene);
}

/* Checks the radiance of the air; returns the mean opacity on the ice. */
static double check_light(struct gpu *gpu, const struct scene *scene,
                          const struct settings *settings, struct vec light)
{
    struct picture_request request = request_of(scene, 0, 0);
    request.settings = settings;
    struct render_result result = picture_render(gpu, &request);
    const float *alpha = image_find(&result.image, "air.A");
    const struct picture_layer color = picture_layer(&result.image, "air");
    double sum = 0;
    size_t count = 0;
    for (size_t i = 0; i < (size_t)SIZE * SIZE; i++) {
        const double a = (double)alpha[i];
        CHECK_NEAR(vec_difference(picture_at(color, i), vec_scale(light, a)), 0, 4e-3);
        sum += a;
        count += picture_is_object(picture_layer(&result.image, "exit"), i);
    }
    render_result_finish(&result);
    return sum / (double)count;
}

/* 1 above 45 degrees of latitude, which is 1 - cos 45 of the half sphere. */
static void use_bright_cap(struct scene *scene)
{
    picture_use_directions(scene, 64);
    for (size_t i = 0; i < (size_t)64 * 32 * 4; i++)
        scene->background.environment.texels[i] =
            half_from_float(i < (size_t)64 * 8 * 4 ? 1.0F : 0.0F);
}

static void lit_from_all_sides(void **state)
{
    struct scene scene;
    open_scene(&scene, "sphere", 19, 1);
    const struct settings dark = picture_settings("sky.strength=0");
    assert_true(check_light(*state, &scene, &dark, (struct vec){ 0, 0, 0 }) > 0.1);
    /* the mean of the sky's two halves, and half the sun */
    const struct vec sky = { 0.31 + 0.5, 0.345 + 0.5 * 0.93, 0.4 + 0.5 * 0.8 };
    const struct settings sun = picture_settings("sky.sun_strength=1");
    assert_true(check_light(*state, &scene, &sun, sky) > 0.1);
    use_bright_cap(&scene);
    scene.background.kind = SCENE_ENVIRONMENT;
    const double cap = (1 - sqrt(0.5)) / 2 * 2; /* of the upper half, twice of the whole */
    assert_true(check_light(*state, &scene, NULL, vec_scale((struct vec){ 1, 1, 1 }, cap / 2)) >
                0.1);
    scene.background.kind = SCENE_COLOR;
    scene.background.color = (vec3s){ { 0.25F, 0.5F, 0.75F } };
    assert_true(check_light(*state, &scene, NULL, vec_from(scene.background.color)) > 0.1);
    scene_finish(&scene);
}

/* Bubbles and haze can be set apart, and both switched off. */
static void strengths(void **state)
{
    static const char *const assignments[] = { "air.strength=0", "air.haze=0", "air.strength=0.7" };
    struct scene scene;
    open_scene(&scene, "sphere", 19, 1);
    scene.background.kind = SCENE_COLOR;
    scene.background.color = (vec3s){ { 0.5F, 0.5F, 0.5F } };
    const struct vec gray = { 0.5, 0.5, 0.5 };
    const double usual = check_light(*state, &scene, NULL, gray);
    double shares[3];
    for (size_t i = 0; i < 3; i++) {
        const struct settings settings = picture_settings(assignments[i]);
        shares[i] = check_light(*state, &scene, &settings, gray) / usual;
    }
    assert_true(shares[0] > 0.05 && shares[0] < 0.95);
    assert_true(shares[1] > 0.05 && shares[1] < 0.95);
    assert_true(shares[2] > 1.1);
    struct settings none = picture_settings("air.strength=0");
    assert_int_equal(settings_assign(&none, "air.haze=0", SETTING_USER, NULL), STATUS_OK);
    assert_true(check_light(*state, &scene, &none, gray) <= 0.0);
    scene_finish(&scene);
}

static void over_the_ice(void **state)
{
    const struct settings settings = picture_settings("air.count=0");
    struct scene scene;
    open_scene(&scene, "valley", 19, 1);
    struct picture_request request = request_of(&scene, 30, 20);
    struct render_result with = picture_render(*state, &request);
    request.settings = &settings;
    struct render_result without = picture_render(*state, &request);
    const float *alpha = image_find(&with.image, "air.A");
    size_t count = 0;
    for (size_t i = 0; i < (size_t)SIZE * SIZE; i++) {
        const struct vec was = picture_at(picture_layer(&without.image, ""), i);
        const struct vec added = picture_at(picture_layer(&with.image, "air"), i);
        const struct vec is = picture_at(picture_layer(&with.image, ""), i);
        const double limit = 2e-3 * (1 + vec_norm(was));
        if (picture_is_object(picture_layer(&with.image, "exit"), i))
            CHECK_NEAR(vec_difference(is, vec_add(added, 1 - (double)alpha[i], was)), 0, limit);
        else
            CHECK_NEAR(vec_difference(is, was), 0, 0);
        count += alpha[i] > 0.1F;
        assert_true(picture_at(picture_layer(&without.image, "air"), i).x <= 0.0);
    }
    assert_true(count > 1000);
    render_result_finish(&with);
    render_result_finish(&without);
    scene_finish(&scene);
}

/* The same planes in another order give the same picture. */
static void order_does_not_count(void **state)
{
    struct scene scene;
    open_scene(&scene, "sphere", 19, 1);
    const struct picture_request request = request_of(&scene, 30, 20);
    struct render_result a = picture_render(*state, &request);
    uint32_t *indices = scene.inclusions.air.indices;
    for (uint32_t i = 0; i < scene.inclusions.air.index_count / 2; i++) {
        const uint32_t other = scene.inclusions.air.index_count - 1 - i;
        const uint32_t swapped = indices[i];
        indices[i] = indices[other];
        indices[other] = swapped;
    }
    struct render_result b = picture_render(*state, &request);
    const struct picture_layer first = picture_layer(&a.image, "air");
    const struct picture_layer second = picture_layer(&b.image, "air");
    for (size_t i = 0; i < (size_t)SIZE * SIZE; i++)
        CHECK_NEAR(vec_difference(picture_at(first, i), picture_at(second, i)), 0, 4e-3);
    render_result_finish(&a);
    render_result_finish(&b);
    scene_finish(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(density_rises_towards_the_middle),
        cmocka_unit_test(clipped_to_the_ice),
        cmocka_unit_test(clipped_in_depth),
        cmocka_unit_test(fades_edge_on),
        cmocka_unit_test(lit_from_all_sides),
        cmocka_unit_test(strengths),
        cmocka_unit_test(over_the_ice),
        cmocka_unit_test(order_does_not_count),
    };
    return RUN_ON_DEVICE(tests);
}
