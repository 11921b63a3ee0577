/*
 * test_cracks.c: clipping of cracks to the ice, against rays traced here in double precision,
 * without the device's depth maps.
 */
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "src/scene/generate/generate.h"
#include "tests/support/assertions.h"
#include "tests/support/lavapipe.h"
#include "tests/support/picture.h"
#include "tests/support/screen_tiles.h"

enum {
    SIZE = 224,
    PIXELS = SIZE * SIZE,
    HITS_MAX = 64,
    WANTED = 10000, /* fragments to check */
};

/* Every fragment that is kept shows: a gap reflects 3.5 % at least. */
#define GAPS "cracks.refract=gap", "cracks.strength=0", "cracks.bump=0", "cracks.gap=1000"

static const double pi = 3.14159265358979323846;
/* Relative: a device may round to halves either way. */
static const double half_step = 1e-3;

/* ---- scenes ---- */

static struct settings settings_with(const char *const *assignments)
{
    struct settings settings = settings_default();
    for (size_t i = 0; assignments[i]; i++)
        assert_int_equal(settings_assign(&settings, assignments[i], SETTING_USER, NULL), STATUS_OK);
    return settings;
}

#define SETTINGS(...) settings_with((const char *const[]){ __VA_ARGS__, NULL })

/* Around the z axis, then tilted about x: seen from +z, one side of the ring hides the other. */
static void make_torus(struct mesh *mesh, float tilt)
{
    enum {
        AROUND = 64,
        ACROSS = 32
    };

    assert_true(mesh_init(mesh, AROUND * ACROSS, 6 * AROUND * ACROSS));
    uint32_t *out = mesh->indices;
    for (uint32_t i = 0; i < AROUND * ACROSS; i++) {
        const uint32_t section = i / ACROSS;
        const float u = (float)section * (float)(2 * pi / AROUND);
        const float v = (float)(i % ACROSS) * (float)(2 * pi / ACROSS);
        const vec3s flat = { { (1 + 0.4f * cosf(v)) * cosf(u), (1 + 0.4f * cosf(v)) * sinf(u),
                               0.4f * sinf(v) } };
        mesh->vertices[i].position = glms_vec3_rotate(flat, tilt, (vec3s){ { 1, 0, 0 } });
        const uint32_t up = section * ACROSS + (i + 1) % ACROSS;
        const uint32_t right = (i + ACROSS) % (AROUND * ACROSS);
        const uint32_t both = (up + ACROSS) % (AROUND * ACROSS);
        const uint32_t corners[] = { i, right, both, i, both, up };
        for (int k = 0; k < 6; k++)
            *out++ = corners[k];
    }
    mesh_make_normals(mesh);
}

/* In front of one colour, so that nothing but the object counts. */
static struct scene open_scene(const char *name)
{
    struct scene scene = { .background.kind = SCENE_COLOR,
                           .background.color = { { 0.25f, 0.25f, 0.25f } } };
    struct mesh *object = &scene.model.object;
    if (!strcmp(name, "torus"))
        make_torus(object, 1.3f);
    else if (!strcmp(name, "teapot"))
        assert_true(generate_teapot(object, GENERATE_TEAPOT_TRIANGLES));
    else if (!strcmp(name, "valley"))
        assert_true(generate_ice_cube(object, GENERATE_ICE_CUBE_TRIANGLES));
    else
        assert_true(generate_sphere(object, GENERATE_SPHERE_TRIANGLES));
    scene.box = mesh_box(object);
    return scene;
}

static void crack(struct scene *scene, uint32_t count, uint32_t seed)
{
    const struct scene_cracks cracks = { .count = count, .seed = seed, .size = 1 };
    assert_int_equal(scene_generate_cracks(scene, &cracks), STATUS_OK);
}

static struct picture_request request_of(const struct scene *scene, const struct settings *settings)
{
    return (struct picture_request){
        .scene = scene,
        .settings = settings,
        .camera = camera_orbit(0, 0, 1.1f * box_diagonal(scene->box), box_center(scene->box), 45),
        .width = SIZE,
        .height = SIZE,
        .layers = picture_layer_bit("cracks") | picture_layer_bit("intervals"),
    };
}

/* ---- what is kept ---- */

/* Of a point at distance `t` along a ray, when the ray meets the closed mesh at `hits`. */
static bool is_inside(const double *hits, size_t count, double t)
{
    bool inside = false;
    for (size_t i = 0; i < count; i++)
        inside ^= hits[i] > t;
    return inside;
}

/* Of the pixels whose ray meets a crack once. */
struct tally {
    size_t kept, kept_outside;   /* of the fragments that the picture shows */
    size_t inside, left_out;     /* of those that it must show */
    size_t pixels, wrong_counts; /* pixels, and those with another number of intervals */
};

/* Every `step`th pixel, and a fourth or less of those that show nothing. */
static void count_fragments(struct tally *tally, const struct picture_request *request,
                            const struct image *image, size_t step)
{
    const float *alpha = image_find(image, "cracks.A");
    const float *intervals = image_find(image, "intervals.Z");
    struct tiles cracks;
    struct tiles object;
    screen_tiles_init(&cracks, &request->scene->inclusions.cracks, request);
    screen_tiles_init(&object, &request->scene->model.object, request);
    for (size_t i = 0; i < PIXELS; i += step) {
        double at[HITS_MAX];
        double faces[HITS_MAX];
        if (alpha[i] == 0.0f && i % (intervals[i] == 0.0f ? 16 : 4) != 0)
            continue;
        const bool one = screen_tiles_trace(&cracks, i, at, HITS_MAX) == 1;
        if (!one && i % 8 != 0)
            continue;
        const size_t face_count = screen_tiles_trace(&object, i, faces, HITS_MAX);
        tally->pixels++;
        tally->wrong_counts += 2 * (size_t)intervals[i] != face_count;
        if (!one)
            continue;
        const bool kept = alpha[i] > 0.03f;
        const bool inside = is_inside(faces, face_count, at[0]);
        tally->kept += kept;
        tally->kept_outside += kept && !inside;
        tally->inside += inside;
        tally->left_out += inside && !kept;
    }
    screen_tiles_finish(&cracks);
    screen_tiles_finish(&object);
}

/* Seed after seed, until enough fragments have been seen. */
static struct tally tally_scene(struct gpu *gpu, const char *name, const char *clip, size_t step,
                                size_t wanted)
{
    const struct settings settings = SETTINGS(clip, GAPS);
    struct scene scene = open_scene(name);
    struct tally tally = { 0 };
    uint32_t seed = 1;
    for (; tally.kept < wanted; seed++) {
        assert_true(seed < 10);
        crack(&scene, 2, seed);
        const struct picture_request request = request_of(&scene, &settings);
        struct render_result result = picture_render(gpu, &request);
        count_fragments(&tally, &request, &result.image, step);
        render_result_finish(&result);
    }
    print_message("%s, %s: %zu kept, %zu of them outside (%.2f %%); %zu inside, %zu left out; "
                  "%zu pixels, %zu with other intervals; %u pictures\n",
                  name, clip, tally.kept, tally.kept_outside,
                  100.0 * (double)tally.kept_outside / (double)tally.kept, tally.inside,
                  tally.left_out, tally.pixels, tally.wrong_counts, seed - 1);
    scene_finish(&scene);
    return tally;
}

static void check_right(const struct tally *tally)
{
    assert_true(tally->kept >= WANTED);
    assert_true(tally->kept_outside * 1000 <= tally->kept);
    assert_true(tally->left_out * 4000 <= tally->inside); /* a fourth was looked at */
    assert_true(tally->wrong_counts * 1000 <= tally->pixels);
}

/* Intervals are right for a torus; what the convex test keeps of it is partly outside. */
static void test_torus(void **state)
{
    const struct tally right = tally_scene(*state, "torus", "cracks.clip=interval", 1, WANTED);
    check_right(&right);
    const struct tally convex = tally_scene(*state, "torus", "cracks.clip=convex", 3, WANTED / 4);
    assert_true(convex.kept_outside * 100 > convex.kept);
    assert_true(convex.left_out * 4000 <= convex.inside);
}

static void test_teapot(void **state)
{
    const struct tally right = tally_scene(*state, "teapot", "cracks.clip=interval", 1, WANTED);
    check_right(&right);
    const struct tally convex = tally_scene(*state, "teapot", "cracks.clip=convex", 3, WANTED / 4);
    assert_true(convex.kept_outside > right.kept_outside);
}

/* Without clipping, and with too few intervals, it is wrong. */
static void test_other_clippings_are_wrong(void **state)
{
    const struct tally none = tally_scene(*state, "torus", "cracks.clip=none", 7, WANTED / 4);
    assert_true(none.kept_outside * 10 > none.kept);
    const struct tally one = tally_scene(*state, "torus", "ice_interval.count=1", 3, WANTED / 4);
    assert_int_equal(one.kept_outside, 0);
    assert_true(one.left_out * 1000 > one.inside);
    assert_true(one.wrong_counts * 100 > one.pixels);
}

/* ---- pictures beside each other ---- */

static struct render_result render(struct gpu *gpu, const struct scene *scene,
                                   const struct settings *settings)
{
    const struct picture_request request = request_of(scene, settings);
    return picture_render(gpu, &request);
}

/* Pixels whose value in any of the two pictures' planes of that name is not the same. */
static size_t count_different(const struct image *a, const struct image *b, const char *plane,
                              float tolerance)
{
    const float *x = image_find(a, plane);
    const float *y = image_find(b, plane);
    size_t count = 0;
    for (size_t i = 0; i < PIXELS; i++)
        count += !(fabsf(x[i] - y[i]) <= tolerance);
    return count;
}

static size_t count_above(const struct image *image, const char *plane, float least)
{
    const float *x = image_find(image, plane);
    size_t count = 0;
    for (size_t i = 0; i < PIXELS; i++)
        count += x[i] > least;
    return count;
}

static void test_convex_is_interval_for_a_sphere(void **state)
{
    static const char *const planes[] = { "R", "G", "B", "cracks.R", "cracks.G", "cracks.A" };
    static const char *const kinds[] = { "cracks.refract=off", "cracks.refract=gap",
                                         "cracks.refract=normals" };
    struct scene scene = open_scene("sphere");
    crack(&scene, 4, 5);
    for (size_t k = 0; k < 3; k++) {
        const struct settings convex = SETTINGS("cracks.clip=convex", kinds[k]);
        const struct settings interval = SETTINGS("cracks.clip=interval", kinds[k]);
        struct render_result a = render(*state, &scene, &convex);
        struct render_result b = render(*state, &scene, &interval);
        for (size_t p = 0; p < sizeof(planes) / sizeof(planes[0]); p++)
            assert_int_equal(count_different(&a.image, &b.image, planes[p], 0), 0);
        assert_true(count_above(&a.image, "cracks.A", 0.01f) > 1000);
        render_result_finish(&a);
        render_result_finish(&b);
    }
    scene_finish(&scene);
}

static void test_cracks_turn_with_the_ice(void **state)
{
    const struct settings interval = SETTINGS("cracks.clip=interval", GAPS, "motion.ice=30");
    struct scene scene = open_scene("torus");
    crack(&scene, 2, 3);
    struct picture_request request = request_of(&scene, &interval);
    struct picture_stage stage;
    picture_begin(&stage, *state, &request);
    struct render_result still = picture_take(&stage, &request);
    request.time = 2;
    struct render_result a = picture_take(&stage, &request);
    picture_end(&stage);
    const size_t shown = count_above(&a.image, "cracks.A", 0.03f);
    assert_true(count_different(&a.image, &still.image, "cracks.A", 0.01f) * 4 > shown);
    render_result_finish(&still);
    render_result_finish(&a);
    scene_finish(&scene);
}

static void test_seeds_and_counts(void **state)
{
    static const struct scene_cracks kinds[] = {
        { .count = 2, .seed = 1, .size = 1 },
        { .count = 2, .seed = 1, .size = 1 },
        { .count = 2, .seed = 2, .size = 1 },
        { .count = 64, .seed = 1, .size = 1 },
    };
    const struct settings settings = settings_default();
    struct scene scene = open_scene("valley");
    struct render_result results[4];
    for (size_t i = 0; i < 4; i++) {
        assert_int_equal(scene_generate_cracks(&scene, &kinds[i]), STATUS_OK);
        results[i] = render(*state, &scene, &settings);
    }
    assert_int_equal(count_different(&results[0].image, &results[1].image, "R", 0), 0);
    assert_int_equal(count_different(&results[0].image, &results[1].image, "cracks.A", 0), 0);
    assert_true(count_different(&results[0].image, &results[2].image, "cracks.A", 0.1f) > 500);
    assert_true(count_different(&results[0].image, &results[2].image, "R", 0.01f) > 500);
    const size_t two = count_above(&results[0].image, "cracks.A", 0.1f);
    const size_t many = count_above(&results[3].image, "cracks.A", 0.1f);
    print_message("2 cracks shine in %zu pixels, 64 in %zu\n", two, many);
    assert_true(two > 500 && many > 2 * two);
    for (size_t i = 0; i < 4; i++)
        render_result_finish(&results[i]);
    scene_finish(&scene);
}

/* Only where lights shine: none without them, and nothing where there is no ice. */
static void test_nothing_but_highlights(void **state)
{
    const struct settings lit = settings_default();
    const struct settings dark = SETTINGS("light.count=0");
    const struct settings none = SETTINGS("cracks.count=0", "light.count=0");
    struct scene scene = open_scene("teapot");
    struct render_result plain = render(*state, &scene, &none);
    crack(&scene, 2, 1);
    struct render_result a = render(*state, &scene, &lit);
    struct render_result b = render(*state, &scene, &dark);
    assert_true(count_above(&a.image, "cracks.A", 0.1f) > 100);
    assert_int_equal(count_above(&b.image, "cracks.A", 0), 0);
    assert_int_equal(count_above(&plain.image, "cracks.A", 0), 0);
    assert_int_equal(count_different(&b.image, &plain.image, "G", 0), 0);
    const float *shine = image_find(&a.image, "cracks.A");
    const float *ice = image_find(&a.image, "intervals.Z");
    for (size_t i = 0; i < PIXELS; i++)
        assert_false(shine[i] > 0 && ice[i] == 0.0f);
    render_result_finish(&plain);
    render_result_finish(&a);
    render_result_finish(&b);
    scene_finish(&scene);
}

/* Red and opaque on every fragment that is kept, and on nothing else. */
static void test_surface(void **state)
{
    static const char *const kinds[] = { "cracks.refract=off", "cracks.refract=gap" };
    static const char *const clips[] = { "cracks.clip=interval", "cracks.clip=none" };
    struct scene scene = open_scene("torus");
    crack(&scene, 2, 3);
    for (size_t k = 0; k < 2; k++) {
        size_t shown[2], wrong = 0;
        for (size_t c = 0; c < 2; c++) {
            const struct settings gap = SETTINGS(clips[c], GAPS);
            const struct settings red = SETTINGS(clips[c], kinds[k], "cracks.debug=on");
            struct render_result a = render(*state, &scene, &gap);
            struct render_result b = render(*state, &scene, &red);
            const float *kept = image_find(&a.image, "cracks.A");
            shown[c] = 0;
            for (size_t i = 0; i < PIXELS; i++) {
                const float whole = kept[i] > 0.0f ? 1.0f : 0.0f;
                shown[c] += kept[i] > 0.0f;
                const float shows = image_find(&b.image, "cracks.R")[i];
                assert_true(image_find(&b.image, "cracks.A")[i] == shows);
                assert_true(shows == 0.0f || shows == 1.0f);
                wrong += shows != whole; /* at rims, where gaps are closed */
                assert_true(image_find(&b.image, "cracks.G")[i] == 0.0f);
                assert_true(image_find(&b.image, "cracks.B")[i] == 0.0f);
            }
            render_result_finish(&a);
            render_result_finish(&b);
        }
        print_message("%s: %zu pixels red, %zu without clipping\n", kinds[k], shown[0], shown[1]);
        assert_true(shown[0] > 2000 && shown[1] * 4 > shown[0] * 5 && wrong < 50);
    }
    scene_finish(&scene);
}

/* ---- one flat crack ---- */

/* Through the sphere's centre, its normal at an angle to the axis towards the viewer. */
static void add_flat_crack(struct scene *scene, double degrees)
{
    static const uint32_t corners[6] = { 0, 1, 2, 0, 2, 3 };
    const float c = (float)cos(degrees * pi / 180);
    const float s = (float)sin(degrees * pi / 180);
    const vec3s right = { { c, 0, -s } };
    mesh_finish(&scene->inclusions.cracks);
    assert_true(mesh_init(&scene->inclusions.cracks, 4, 6));
    for (uint32_t i = 0; i < 4; i++) { /* no diagonal through the centre */
        const float x = i == 1 || i == 2 ? 0.7f : -0.4f;
        const float y = i >= 2 ? 0.4f : -0.6f;
        scene->inclusions.cracks.vertices[i].position = glms_vec3_scale(right, x);
        scene->inclusions.cracks.vertices[i].position.y = y;
        scene->inclusions.cracks.vertices[i].normal = (vec3s){ { s, 0, c } };
        scene->inclusions.cracks.vertices[i].color = glms_vec3_one();
    }
    memcpy(scene->inclusions.cracks.indices, corners, sizeof(corners));
}

enum {
    FLAT_SIZE = 65,
    MIDDLE = FLAT_SIZE * FLAT_SIZE / 2, /* its ray goes along -z */
};

static struct render_result render_flat(struct gpu *gpu, const struct scene *scene,
                                        const struct settings *settings)
{
    const struct picture_request request = {
        .scene = scene,
        .settings = settings,
        .camera = camera_orbit(0, 0, 4, box_center(scene->box), 30),
        .width = FLAT_SIZE,
        .height = FLAT_SIZE,
        .layers =
            picture_layer_bit("cracks") | picture_layer_bit("back.N") | picture_layer_bit("exit"),
    };
    return picture_render(gpu, &request);
}

static const struct {
    double degrees, share;
} gap_law[] = {
    { 0, 0.0351309 },  { 30, 0.0433238 },   { 45, 0.1869719 },
    { 48, 0.3850670 }, { 49.8, 0.9083175 }, { 52, 1 },
};

/* What a gap reflects, and where it comes from. */
static void test_gap_reflects(void **state)
{
    const struct settings settings = SETTINGS(GAPS);
    struct scene scene = open_scene("sphere");
    picture_use_directions(&scene, 1024);
    for (size_t k = 0; k < sizeof(gap_law) / sizeof(gap_law[0]); k++) {
        const double degrees = gap_law[k].degrees;
        add_flat_crack(&scene, degrees);
        struct render_result result = render_flat(*state, &scene, &settings);
        const float alpha = image_find(&result.image, "cracks.A")[MIDDLE];
        const double turn = 2 * degrees * pi / 180;
        const struct vec mirrored =
            picture_direction_color((struct vec){ sin(turn), 0, cos(turn) });
        const struct vec seen = picture_at(picture_layer(&result.image, "cracks"), MIDDLE);
        print_message("%4.1f degrees: %.6f, must be %.6f\n", degrees, (double)alpha,
                      gap_law[k].share);
        CHECK_NEAR(alpha, gap_law[k].share, degrees > 49 ? 4e-3 : half_step * gap_law[k].share);
        assert_true(vec_difference(seen, vec_scale(mirrored, (double)alpha)) < 0.01);
        render_result_finish(&result);
    }
    scene_finish(&scene);
}

/* What it does not reflect goes straight through: one colour all around stays that colour. */
static void test_gaps_lose_no_light(void **state)
{
    const struct settings settings = SETTINGS(GAPS, "light.count=0");
    struct scene scene = open_scene("torus");
    crack(&scene, 5, 4);
    struct render_result result = render(*state, &scene, &settings);
    const float *picture = image_find(&result.image, "G");
    assert_true(count_above(&result.image, "cracks.A", 0.5f) > 100);
    for (size_t i = 0; i < PIXELS; i++)
        CHECK_NEAR(picture[i], 0.25, 1e-3);
    render_result_finish(&result);
    scene_finish(&scene);
}

/* By bounce, light is followed on from a crack that mirrors all: seen through the middle of a ball,
 * none of it is bent, but for what is reflected where it leaves. */
static void test_gap_is_followed(void **state)
{
    const struct settings settings = SETTINGS(GAPS, "cracks.clip=convex");
    struct scene scene = open_scene("sphere");
    picture_use_directions(&scene, 1024);
    add_flat_crack(&scene, 52);
    const struct picture_request request = {
        .scene = &scene,
        .settings = &settings,
        .camera = camera_orbit(0, 0, 4, box_center(scene.box), 30),
        .width = FLAT_SIZE,
        .height = FLAT_SIZE,
        .refraction = "bounce",
    };
    struct render_result result = picture_render(*state, &request);
    const double turn = 104 * pi / 180;
    const struct vec mirrored = picture_direction_color((struct vec){ sin(turn), 0, cos(turn) });
    const struct vec straight = picture_direction_color((struct vec){ 0, 0, -1 });
    const struct vec seen = picture_at(picture_layer(&result.image, ""), MIDDLE);
    print_message("%.3f from what it mirrors, %.3f from what is behind\n",
                  vec_difference(seen, mirrored), vec_difference(seen, straight));
    assert_true(vec_difference(seen, mirrored) < 0.1);
    assert_true(vec_difference(seen, straight) > 0.3);
    render_result_finish(&result);
    scene_finish(&scene);
}

/* It loses no light, either. */
static void test_even_light_by_bounce(void **state)
{
    const struct settings settings = SETTINGS("cracks.refract=gap", "light.count=0");
    struct scene scene = open_scene("valley");
    crack(&scene, 5, 4);
    struct picture_request request = request_of(&scene, &settings);
    request.refraction = "bounce";
    struct render_result result = picture_render(*state, &request);
    const float *picture = image_find(&result.image, "G");
    for (size_t i = 0; i < PIXELS; i++)
        CHECK_NEAR(picture[i], 0.25, 1e-3);
    render_result_finish(&result);
    scene_finish(&scene);
}

/* The paper's experiment: the normal of the nearest crack in the place of the back face's. */
static void test_normals(void **state)
{
    const struct settings settings = SETTINGS("cracks.refract=normals", "cracks.bump=0");
    const struct settings without = SETTINGS("cracks.refract=off", "cracks.bump=0");
    struct scene scene = open_scene("sphere");
    add_flat_crack(&scene, 30);
    struct render_result a = render_flat(*state, &scene, &settings);
    struct render_result b = render_flat(*state, &scene, &without);
    const struct vec normal = { -sin(pi / 6), 0, -cos(pi / 6) }; /* away from the eye */
    const struct vec axis = { 0, 0, -1 };
    const struct picture_layer changed = picture_layer(&a.image, "back.N");
    const struct picture_layer as_before = picture_layer(&b.image, "back.N");
    assert_true(vec_difference(picture_at(changed, MIDDLE), normal) < 1e-3);
    assert_true(vec_angle_deg(picture_at(as_before, MIDDLE), axis) < 8); /* a facet's */
    const struct vec exit_a = picture_at(picture_layer(&a.image, "exit"), MIDDLE);
    const struct vec exit_b = picture_at(picture_layer(&b.image, "exit"), MIDDLE);
    assert_true(vec_angle_deg(exit_a, exit_b) > 2);
    /* where the crack is not, nothing changes */
    const size_t beside = MIDDLE - FLAT_SIZE / 4;
    assert_true(vec_norm(picture_at(as_before, beside)) > 0.9);
    assert_true(vec_difference(picture_at(changed, beside), picture_at(as_before, beside)) == 0);
    render_result_finish(&a);
    render_result_finish(&b);
    scene_finish(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_torus),
        cmocka_unit_test(test_teapot),
        cmocka_unit_test(test_other_clippings_are_wrong),
        cmocka_unit_test(test_convex_is_interval_for_a_sphere),
        cmocka_unit_test(test_cracks_turn_with_the_ice),
        cmocka_unit_test(test_seeds_and_counts),
        cmocka_unit_test(test_nothing_but_highlights),
        cmocka_unit_test(test_surface),
        cmocka_unit_test(test_gap_reflects),
        cmocka_unit_test(test_gaps_lose_no_light),
        cmocka_unit_test(test_gap_is_followed),
        cmocka_unit_test(test_even_light_by_bounce),
        cmocka_unit_test(test_normals),
    };
    return RUN_ON_DEVICE(tests);
}
