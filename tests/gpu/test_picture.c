/*
 * test_picture.c: images have the right orientation, no holes and no seams, and are reproducible.
 */
#include <stdlib.h>
#include <string.h>

#include "tests/support/assertions.h"

#include "shaders/output/tonemap.h"
#include "src/render/sample_accumulation.h"
#include "src/tech/output/tonemap.h"
#include "tests/support/lavapipe.h"
#include "tests/support/picture.h"

static const char *const refraction_models[] = { "paper", "one-sided" };

static size_t pixel_count(const struct picture_request *request)
{
    return (size_t)request->width * request->height;
}

/* ---- every layer of every object ---- */

/* Pixels of a layer that hold what they must not: faults are counted, not asserted one by one. */
static size_t count_no_numbers(const struct image *image)
{
    size_t count = 0;
    for (uint32_t p = 0; p < image->plane_count; p++) {
        for (size_t i = 0; i < (size_t)image->width * image->height; i++)
            count += isfinite(image->planes[p].texels[i]) ? 0 : 1;
    }
    return count;
}

static bool is_black(struct vec color)
{
    return !(color.x > 0 && color.y > 0 && color.z > 0);
}

/* On the object; elsewhere the layers are empty. */
static size_t count_faults(const struct image *image, const char *name, bool is_light)
{
    const struct picture_layer exit = picture_layer(image, "exit");
    const struct picture_layer layer = picture_layer(image, name);
    size_t count = 0;
    for (size_t i = 0; i < (size_t)image->width * image->height; i++) {
        const struct vec v = picture_at(layer, i);
        if (picture_is_object(exit, i))
            count += is_light ? is_black(v) : fabs(vec_norm(v) - 1) > 2e-3;
    }
    return count;
}

static double object_share(const struct image *image)
{
    const struct picture_layer exit = picture_layer(image, "exit");
    size_t count = 0;
    for (size_t i = 0; i < (size_t)image->width * image->height; i++)
        count += picture_is_object(exit, i);
    return (double)count / image->width / image->height;
}

static void check_no_holes(struct gpu *gpu, const struct scene *scene, const char *refraction)
{
    const struct picture_request request = {
        .scene = scene,
        .refraction = refraction,
        .camera = camera_orbit(28, 9, 4.5F, box_center(scene->box), 45),
        .width = 128,
        .height = 96,
        .layers = PICTURE_ALL_LAYERS,
    };
    struct render_result result = picture_render(gpu, &request);
    const struct picture_layer beauty = picture_layer(&result.image, "");
    const float *fresnel = image_find(&result.image, "fresnel.Z");
    size_t fault_count = count_no_numbers(&result.image);
    for (size_t i = 0; i < pixel_count(&request); i++) {
        fault_count += is_black(picture_at(beauty, i));
        fault_count += !(fresnel[i] >= 0 && fresnel[i] <= 1);
    }
    assert_int_equal(fault_count, 0);
    assert_int_equal(count_faults(&result.image, "exit", false), 0);
    assert_int_equal(count_faults(&result.image, "N", false), 0);
    assert_int_equal(count_faults(&result.image, "back.N", false), 0);
    assert_int_equal(count_faults(&result.image, "refraction", true), 0);
    assert_int_equal(count_faults(&result.image, "reflection", true), 0);
    const double share = object_share(&result.image);
    assert_true(share > 0.05 && share < 0.5);
    render_result_finish(&result);
}

static void load(struct scene *scene, const char *name, const vec3s *background)
{
    const struct scene_params params = { .name = name, .background = background };
    assert_int_equal(scene_load(scene, &params), STATUS_OK);
}

/* Each object before the sky; the first one before everything. */
static void no_pixel_is_black_or_no_number(void **state)
{
    const vec3s blue = { { 0.2F, 0.5F, 0.8F } };
    for (const struct scene_builtin *object = scene_builtins; object->name && object->generate;
         object++) {
        const int last = object == scene_builtins ? SCENE_ENVIRONMENT : SCENE_SKY;
        for (int kind = SCENE_SKY; kind <= last; kind++) {
            struct scene scene;
            load(&scene, object->name, kind == SCENE_SKY ? NULL : &blue);
            if (kind == SCENE_ENVIRONMENT)
                picture_use_directions(&scene, 256);
            for (size_t r = 0; r < 2; r++)
                check_no_holes(*state, &scene, refraction_models[r]);
            scene_finish(&scene);
        }
    }
}

/* ---- directions ---- */

static struct vec reflected(struct vec e, struct vec n)
{
    return vec_add(e, -2 * vec_dot(e, n), n);
}

/* A jump between neighbours on the sphere, but for its rim, is a seam of the cube. */
static double largest_jump(const struct picture_request *request, const struct image *image,
                           const char *name, vec3s center)
{
    const struct picture_layer layer = picture_layer(image, name);
    const struct vec to_center = vec_add(vec_from(center), -1, vec_from(request->camera.eye));
    double largest = 0;
    for (size_t i = 0; i + request->width + 1 < pixel_count(request); i++) {
        const struct vec e = picture_pixel_ray(request, i);
        if (vec_norm(vec_cross(to_center, e)) > 0.9)
            continue;
        const struct vec here = picture_at(layer, i);
        largest = fmax(largest, vec_difference(here, picture_at(layer, i + 1)));
        largest = fmax(largest, vec_difference(here, picture_at(layer, i + request->width)));
    }
    return largest;
}

/* What a sphere far from the origin shows is what lies in the directions it looks. */
static void check_lookups(struct gpu *gpu, const struct scene *scene, vec3s center,
                          const char *refraction)
{
    const struct picture_request request = {
        .scene = scene,
        .refraction = refraction,
        .camera = camera_orbit(200, -15, 4, center, 35),
        .width = 192,
        .height = 144,
        .layers = picture_layer_bit("exit") | picture_layer_bit("N") |
                  picture_layer_bit("refraction") | picture_layer_bit("reflection"),
    };
    struct render_result result = picture_render(gpu, &request);
    const struct picture_layer exit = picture_layer(&result.image, "exit");
    const struct picture_layer normal = picture_layer(&result.image, "N");
    const struct picture_layer refracted = picture_layer(&result.image, "refraction");
    const struct picture_layer reflection = picture_layer(&result.image, "reflection");
    for (size_t i = 0; i < pixel_count(&request); i++) {
        if (!picture_is_object(exit, i))
            continue;
        const struct vec out = picture_at(exit, i);
        const struct vec back = reflected(picture_pixel_ray(&request, i), picture_at(normal, i));
        CHECK_NEAR(vec_difference(picture_at(refracted, i), picture_direction_color(out)), 0, 4e-3);
        CHECK_NEAR(vec_difference(picture_at(reflection, i), picture_direction_color(back)), 0,
                   4e-3);
    }
    assert_true(largest_jump(&request, &result.image, "refraction", center) < 0.04);
    assert_true(largest_jump(&request, &result.image, "reflection", center) < 0.08);
    render_result_finish(&result);
}

static void lookups_have_no_seams(void **state)
{
    const vec3s center = { { 5, -3, 11 } };
    for (int far = 0; far < 2; far++) {
        struct scene scene = picture_sphere_scene(center, 4000);
        if (far)
            picture_use_directions(&scene, 512);
        else
            picture_add_directions(&scene, center, 30);
        for (size_t r = 0; r < 2; r++)
            check_lookups(*state, &scene, center, refraction_models[r]);
        scene_finish(&scene);
    }
}

/*
 * Also over the seam on +Z, where the picture's left and right edges meet, and at the poles, of
 * which it lacks half a texel. Its texels are large: a seam would be seen.
 */
static void environment_stands_still_behind(void **state)
{
    static const vec3s targets[] = {
        { { 1, 0, 0 } },  { { -1, 0.5F, 0 } }, { { 0, 1, 0 } },
        { { 0, -1, 0 } }, { { 0, 0, 1 } },     { { 0.2F, -0.3F, -1 } },
    };
    struct scene scene = picture_sphere_scene((vec3s){ { 0, 50, 0 } }, 20);
    scene.model.object.index_count = 0; /* nothing in the way */
    picture_use_directions(&scene, 64);
    struct picture_request request = {
        .scene = &scene,
        .camera = { .target = targets[0], .up = { { 0, 0.6F, 0.8F } }, .fov_deg = 80 },
        .width = 65, /* odd: a pixel looks straight at the target */
        .height = 49,
    };
    struct picture_stage stage;
    picture_begin(&stage, *state, &request);
    for (size_t t = 0; t < sizeof(targets) / sizeof(targets[0]); t++) {
        request.camera.target = targets[t];
        struct render_result result = picture_take(&stage, &request);
        const struct picture_layer beauty = picture_layer(&result.image, "");
        for (size_t i = 0; i < pixel_count(&request); i++) {
            const struct vec e = picture_pixel_ray(&request, i);
            const struct vec color = picture_direction_color(e);
            CHECK_NEAR(vec_difference(picture_at(beauty, i), color), 0,
                       fabs(e.y) > 0.998 ? 0.03 : 4e-3);
        }
        render_result_finish(&result);
    }
    picture_end(&stage);
    scene_finish(&scene);
}

/* ---- the right way round ---- */

/* A red square to the right, a green one above, seen from the origin towards -Z. */
static void up_is_up_and_right_is_right(void **state)
{
    static const struct picture_quad right = {
        { { 1, 0.5F, -5 } }, { { 1, 0, 0 } }, { { 0, -1, 0 } }, { { 1, 0, 0 } }, MESH_UNLIT,
    };
    static const struct picture_quad above = {
        { { -0.5F, 2, -5 } }, { { 1, 0, 0 } }, { { 0, -1, 0 } }, { { 0, 1, 0 } }, MESH_UNLIT,
    };
    struct scene scene = picture_sphere_scene((vec3s){ { 0, 0, 20 } }, 20);
    scene.background.kind = SCENE_COLOR;
    picture_add_quad(&scene, &right);
    picture_add_quad(&scene, &above);
    const struct picture_request request = {
        .scene = &scene,
        .camera = { .target = { { 0, 0, -1 } }, .fov_deg = 60 },
        .width = 128,
        .height = 96,
        .display = true,
    };
    struct render_result result = picture_render(*state, &request);
    const struct picture_layer beauty = picture_layer(&result.image, "");
    for (size_t i = 0; i < pixel_count(&request); i++) {
        const struct vec e = picture_pixel_ray(&request, i);
        const double x = -5 * e.x / e.z;
        const double y = -5 * e.y / e.z;
        const struct vec color = { x > 1 && x < 2 && fabs(y) < 0.5, y > 1 && y < 2 && fabs(x) < 0.5,
                                   0 };
        CHECK_NEAR(vec_difference(picture_at(beauty, i), color), 0, 1e-3);
        assert_int_equal(result.rgba[4 * i] > 128, color.x > 0);
        assert_int_equal(result.rgba[4 * i + 1] > 128, color.y > 0);
    }
    render_result_finish(&result);
    scene_finish(&scene);
}

static void sky_is_above_and_sun_where_it_is_set(void **state)
{
    struct settings settings = picture_settings("sky.sun_azimuth=140");
    assert_int_equal(settings_assign(&settings, "sky.sun_elevation=20", SETTING_USER, NULL),
                     STATUS_OK);
    const vec3s eye = { { 0, 40, 0 } };
    struct scene scene = picture_sphere_scene((vec3s){ { 0, 0, 0 } }, 20);
    const struct picture_request request = {
        .scene = &scene,
        .settings = &settings,
        .camera = {
            .eye = eye,
            .target = camera_orbit(140, 20, 1, eye, 60).eye,
            .fov_deg = 60,
        },
        .width = 129,
        .height = 97,
    };
    struct render_result result = picture_render(*state, &request);
    const float *blue = image_find(&result.image, "B");
    const float *green = image_find(&result.image, "G");
    size_t brightest = 0;
    for (size_t i = 0; i < pixel_count(&request); i++)
        brightest = green[i] > green[brightest] ? i : brightest;
    assert_int_equal(brightest, (size_t)48 * request.width + 64);
    assert_true(green[brightest] > 10);
    for (size_t x = 0; x < request.width; x++) {
        assert_true(blue[x] > 0.5F);                              /* 50 degrees up */
        assert_true(blue[(size_t)96 * request.width + x] < 0.5F); /* 10 degrees down */
    }
    render_result_finish(&result);
    scene_finish(&scene);
}

/* ---- samples ---- */

/* Where a sample of a pixel looks. */
static struct vec sample_ray(const struct picture_request *request, size_t i, uint32_t sample)
{
    const vec2s jitter = pixel_filter_jitter(sample);
    const size_t column = i % request->width;
    const size_t row = i / request->width;
    return picture_ray(request, (double)column + 0.5 + (double)jitter.x,
                       (double)row + 0.5 + (double)jitter.y);
}

/* Right of a slanted edge in the plane z = -5; -1 too close to it to say. */
static int inside(struct vec e)
{
    const double x = -5 * e.x / e.z;
    const double y = -5 * e.y / e.z;
    const double from_edge = x - (3 * (20 - y) / 40 - 1.4);
    return fabs(from_edge) < 1e-4 ? -1 : from_edge > 0;
}

/* -1 if that of any sample is not known. */
static double share_inside(const struct picture_request *request, size_t i)
{
    int count = 0;
    for (uint32_t s = 0; s < request->samples; s++) {
        const int is_inside = inside(sample_ray(request, i, s));
        if (is_inside < 0)
            return -1;
        count += is_inside;
    }
    return (double)count / request->samples;
}

static void edges_show_the_share_of_samples(void **state)
{
    static const struct picture_quad half_plane = {
        { { -1.4F, 20, -5 } }, { { 40, 0, 0 } }, { { 3, -40, 0 } }, { { 1, 1, 1 } }, MESH_UNLIT,
    };
    struct scene scene = picture_sphere_scene((vec3s){ { 0, 0, 20 } }, 20);
    scene.background.kind = SCENE_COLOR;
    picture_add_quad(&scene, &half_plane);
    const struct picture_request request = {
        .scene = &scene,
        .camera = { .target = { { 0, 0, -1 } }, .fov_deg = 60 },
        .width = 128,
        .height = 96,
        .samples = 4,
    };
    struct render_result result = picture_render(*state, &request);
    const float *red = image_find(&result.image, "R");
    size_t mixed = 0;
    for (size_t i = 0; i < pixel_count(&request); i++) {
        const double share = share_inside(&request, i);
        if (share >= 0)
            CHECK_NEAR(red[i], share, 1e-3);
        mixed += share > 0 && share < 1;
    }
    assert_true(mixed > 50);
    render_result_finish(&result);
    scene_finish(&scene);
}

/* Large pixels, so that a jitter the wrong way is seen in a smooth picture. */
static void environment_is_jittered_alike(void **state)
{
    struct scene scene = picture_sphere_scene((vec3s){ { 0, 0, 20 } }, 20);
    picture_use_directions(&scene, 64);
    const struct picture_request request = {
        .scene = &scene,
        .camera = { .target = { { 0.3F, 0, -1 } }, .fov_deg = 100 },
        .width = 24,
        .height = 18,
        .samples = 2,
    };
    struct render_result result = picture_render(*state, &request);
    const struct picture_layer beauty = picture_layer(&result.image, "");
    for (size_t i = 0; i < pixel_count(&request); i++) {
        struct vec mean = { 0 };
        for (uint32_t s = 0; s < request.samples; s++) {
            const struct vec e = sample_ray(&request, i, s);
            mean = vec_add(mean, 1.0 / request.samples, picture_direction_color(e));
        }
        CHECK_NEAR(vec_difference(picture_at(beauty, i), mean), 0, 6e-3);
    }
    render_result_finish(&result);
    scene_finish(&scene);
}

/* ---- the same again ---- */

static void check_same(const struct picture_request *request, const struct render_result *a,
                       const struct render_result *b)
{
    for (uint32_t p = 0; p < b->image.plane_count; p++) {
        const struct image_plane *plane = &b->image.planes[p];
        const float *other = image_find(&a->image, plane->name);
        assert_non_null(other);
        assert_memory_equal(plane->texels, other, pixel_count(request) * sizeof(float));
    }
    if (b->rgba)
        assert_memory_equal(b->rgba, a->rgba, pixel_count(request) * 4);
}

static void check_repeatable(struct gpu *gpu, const char *refraction, uint32_t samples)
{
    const struct settings still = picture_settings("env_cube.dynamic=off");
    struct scene scene;
    load(&scene, "valley", NULL);
    struct picture_request request = {
        .scene = &scene,
        .refraction = refraction,
        .camera = camera_orbit(28, 9, 4.5F, box_center(scene.box), 45),
        .width = 128,
        .height = 96,
        .samples = samples,
        .layers = PICTURE_ALL_LAYERS,
        .display = true,
    };
    struct render_result first = picture_render(gpu, &request);
    struct picture_request others[5] = { request, request, request, request, request };
    others[1].sharing = RG_SHARE_NOTHING;
    others[2].settings = &still;
    others[3].layers = 0;
    others[4].display = false;
    others[4].layers = picture_layer_bit("exit");
    for (size_t k = 0; k < 5; k++) {
        struct render_result other = picture_render(gpu, &others[k]);
        check_same(&request, &first, &other);
        render_result_finish(&other);
    }
    render_result_finish(&first);
    scene_finish(&scene);
}

static void nothing_changes_by_itself(void **state)
{
    check_repeatable(*state, "paper", 1);
    check_repeatable(*state, "one-sided", 2);
}

/* The second picture of a renderer finds the images of the first. */
static void renderer_forgets_earlier_views(void **state)
{
    struct scene scene;
    load(&scene, "teapot", NULL);
    const struct settings still = picture_settings("env_cube.dynamic=off");
    const struct picture_request request = {
        .scene = &scene,
        .settings = &still,
        .camera = camera_orbit(28, 9, 4.5F, box_center(scene.box), 45),
        .width = 128,
        .height = 96,
        .layers = PICTURE_ALL_LAYERS,
    };
    struct picture_request other_side = request;
    other_side.camera = camera_orbit(200, 30, 3, box_center(scene.box), 45);
    other_side.time = 5;
    struct picture_stage stage;
    struct render_result first = picture_render(*state, &request);
    picture_begin(&stage, *state, &request);
    struct render_result again = picture_take(&stage, &other_side);
    render_result_finish(&again);
    again = picture_take(&stage, &request);
    check_same(&request, &first, &again);
    render_result_finish(&again);
    render_result_finish(&first);
    picture_end(&stage);
    scene_finish(&scene);
}

/* Layers that are no light are those of the pixels' centres. */
static void geometry_is_not_averaged(void **state)
{
    static const char *const planes[] = { "Z",        "N.X",      "N.Y",     "N.Z",    "P.X",
                                          "P.Y",      "P.Z",      "exit.X",  "exit.Y", "exit.Z",
                                          "back.N.X", "back.N.Y", "back.N.Z" };
    struct scene scene;
    load(&scene, "valley", NULL);
    struct picture_request request = {
        .scene = &scene,
        .camera = camera_orbit(28, 9, 4.5F, box_center(scene.box), 45),
        .width = 64,
        .height = 48,
        .layers = PICTURE_ALL_LAYERS,
    };
    struct render_result one = picture_render(*state, &request);
    request.samples = 3;
    struct render_result three = picture_render(*state, &request);
    for (size_t p = 0; p < sizeof(planes) / sizeof(planes[0]); p++)
        assert_memory_equal(image_find(&one.image, planes[p]), image_find(&three.image, planes[p]),
                            pixel_count(&request) * sizeof(float));
    render_result_finish(&one);
    render_result_finish(&three);
    scene_finish(&scene);
}

/* ---- 8 bits ---- */

/* Khronos PBR Neutral tone mapper, 2024. */
static struct vec neutral(struct vec c)
{
    const double low = fmin(c.x, fmin(c.y, c.z));
    const double offset = low < 0.08 ? low - 6.25 * low * low : 0.04;
    const struct vec one = { 1, 1, 1 };
    c = vec_add(c, -offset, one);
    const double peak = fmax(c.x, fmax(c.y, c.z));
    if (peak < 0.76)
        return c;
    const double new_peak = 1 - 0.24 * 0.24 / (peak + 0.24 - 0.76);
    const double g = 1 - 1 / (0.15 * (peak - new_peak) + 1);
    return vec_add(vec_scale(c, (1 - g) * new_peak / peak), g * new_peak, one);
}

static double srgb_byte(double x)
{
    x = fmin(fmax(x, 0), 1);
    return 255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1 / 2.4) - 0.055);
}

/* The device's function is the host's. */
static void check_curve(const uint8_t *rgba, struct vec c, uint32_t curve)
{
    const vec3s radiance = { { (float)c.x, (float)c.y, (float)c.z } };
    const vec3s encoded = tonemap_encode(radiance, (struct tonemap_params){ 1.0F, curve });
    for (size_t k = 0; k < 3; k++)
        CHECK_NEAR(rgba[k], (double)encoded.raw[k] * 255, 1);
}

static void check_display(struct gpu *gpu, const struct picture_request *request)
{
    struct render_result result = picture_render(gpu, request);
    const struct tonemap_values *params = settings_of(request->settings, &tonemap_settings);
    const struct picture_layer beauty = picture_layer(&result.image, "");
    double brightest = 0;
    for (size_t i = 0; i < pixel_count(request); i++) {
        struct vec c = vec_scale(picture_at(beauty, i), exp2((double)params->exposure));
        brightest = fmax(brightest, c.x);
        if (params->curve == TONEMAP_NEUTRAL)
            c = neutral(c);
        if (params->curve > TONEMAP_CLIP) { /* tests/unit/test_tonemap.c has these in numbers */
            check_curve(&result.rgba[4 * i], c, params->curve);
            continue;
        }
        CHECK_NEAR(result.rgba[4 * i + 0], srgb_byte(c.x), 1);
        CHECK_NEAR(result.rgba[4 * i + 1], srgb_byte(c.y), 1);
        CHECK_NEAR(result.rgba[4 * i + 2], srgb_byte(c.z), 1);
        assert_int_equal(result.rgba[4 * i + 3], 255);
    }
    assert_true(brightest > 5);
    render_result_finish(&result);
}

static void display_is_the_mean_tonemapped(void **state)
{
    static const char *const changes[] = { "tonemap.exposure=-1.5", "tonemap.curve=clip",
                                           "tonemap.curve=agx", "tonemap.curve=aces",
                                           "tonemap.curve=hable" };
    struct scene scene;
    load(&scene, "sphere", NULL);
    for (size_t k = 0; k < sizeof(changes) / sizeof(changes[0]); k++) {
        struct settings settings = picture_settings(changes[k]);
        assert_int_equal(settings_assign(&settings, "sky.sun_azimuth=180", SETTING_USER, NULL),
                         STATUS_OK);
        assert_int_equal(settings_assign(&settings, "env_cube.dynamic=off", SETTING_USER, NULL),
                         STATUS_OK);
        assert_int_equal(settings_assign(&settings, "tonemap.resolve=linear", SETTING_USER, NULL),
                         STATUS_OK);
        for (uint32_t samples = 1; samples <= 4; samples += 3) {
            const struct picture_request request = {
                .scene = &scene,
                .settings = &settings,
                .camera = { .eye = { { 0, 0, 5 } }, .target = { { 0, 2, 0 } }, .fov_deg = 60 },
                .width = 128,
                .height = 96,
                .samples = samples,
                .display = true,
            };
            check_display(*state, &request);
        }
    }
    scene_finish(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_pixel_is_black_or_no_number),
        cmocka_unit_test(lookups_have_no_seams),
        cmocka_unit_test(environment_stands_still_behind),
        cmocka_unit_test(up_is_up_and_right_is_right),
        cmocka_unit_test(sky_is_above_and_sun_where_it_is_set),
        cmocka_unit_test(edges_show_the_share_of_samples),
        cmocka_unit_test(environment_is_jittered_alike),
        cmocka_unit_test(nothing_changes_by_itself),
        cmocka_unit_test(renderer_forgets_earlier_views),
        cmocka_unit_test(geometry_is_not_averaged),
        cmocka_unit_test(display_is_the_mean_tonemapped),
    };
    return RUN_ON_DEVICE(tests);
}
