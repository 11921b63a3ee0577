/*
 * test_highlight.c: highlights on a sphere in an even grey environment, against the closed form:
 * radiance in every pixel, and position by the half vector.
 */
#include <stdlib.h>

#include "tests/support/assertions.h"
#include "tests/support/bump_reference.h"
#include "tests/support/lavapipe.h"
#include "tests/support/picture.h"

enum {
    SIZE = 160,
    PIXEL_COUNT = SIZE * SIZE,
};

static const double gray = 0.25;
static const double pi = 3.14159265358979323846;
static const vec3s eye = { { 0.8F, 0.5F, 3.2F } };
static const double distance = 4 * 1.7320508; /* of the lights: the box's sphere's radii */

struct surface_picture {
    struct scene scene;
    struct settings settings;
    struct picture_request request;
    struct render_result result;
    struct picture_layer beauty, normal, exit;
};

/* Without surroundings: gray but for the highlights. */
static struct surface_picture draw(struct gpu *gpu, const char *const *assignments, float time,
                                   const struct bumps *bumps)
{
    struct surface_picture p = {
        .scene = picture_sphere_scene((vec3s){ { 0, 0, 0 } }, 40000),
        .settings = picture_settings("highlight.strength=100"),
        .request = {
            .camera = { .eye = eye, .fov_deg = 40 },
            .width = SIZE,
            .height = SIZE,
            .layers = picture_layer_bit("exit") | picture_layer_bit("N"),
            .time = time,
        },
    };
    p.scene.background.kind = SCENE_COLOR;
    p.scene.background.color = (vec3s){ { (float)gray, (float)gray, (float)gray } };
    if (bumps)
        bump_reference_make_constant(&p.scene, bumps->slope_u, bumps->slope_v, 0, 0);
    assert_int_equal(settings_assign(&p.settings, "highlight.shininess=300", SETTING_USER, NULL),
                     STATUS_OK);
    for (; *assignments; assignments++)
        assert_int_equal(settings_assign(&p.settings, *assignments, SETTING_USER, NULL), STATUS_OK);
    p.request.scene = &p.scene;
    p.request.settings = &p.settings;
    p.result = picture_render(gpu, &p.request);
    p.beauty = picture_layer(&p.result.image, "");
    p.normal = picture_layer(&p.result.image, "N");
    p.exit = picture_layer(&p.result.image, "exit");
    return p;
}

static void finish(struct surface_picture *p)
{
    render_result_finish(&p->result);
    scene_finish(&p->scene);
}

/* Light i of n, the first at `azimuth` degrees, 50 high. */
static struct vec light_at(double azimuth, size_t i, size_t n)
{
    const double turn = (azimuth + 360.0 * (double)i / (double)n) * pi / 180;
    const double up = 50 * pi / 180;
    return vec_scale((struct vec){ sin(turn) * cos(up), sin(up), cos(turn) * cos(up) }, distance);
}

/* ---- every pixel ---- */

/* Fresnel's reflectance of ice at a cosine of incidence. */
static double fresnel(double c)
{
    const double ior = 1.3091; /* refract.ior */
    const double t = sqrt(ior * ior - 1 + c * c);
    const double s = (c - t) / (c + t);
    const double p = (ior * ior * c - t) / (ior * ior * c + t);
    return (s * s + p * p) / 2;
}

static double shine(struct vec light, struct vec point, struct vec n, struct vec e)
{
    const struct vec light_dir = vec_unit(vec_add(light, -1, point));
    const struct vec half_dir = vec_unit(vec_add(light_dir, -1, e));
    const double c = vec_dot(n, light_dir) > 0 ? fmax(vec_dot(n, half_dir), 0) : 0;
    return fresnel(-vec_dot(half_dir, e)) * pow(c, 300);
}

/* Compares with 100 * strength times the closed form. */
static void check_pixels(const struct surface_picture *p, double azimuth, size_t light_count,
                         double strength, const struct bumps *bumps)
{
    const struct bumps none = { 0 };
    size_t bright = 0;
    for (size_t i = 0; i < PIXEL_COUNT; i++) {
        const struct vec e = picture_pixel_ray(&p->request, i);
        const struct vec seen = picture_at(p->beauty, i);
        const struct vec mesh_n = picture_at(p->normal, i);
        if (!picture_is_object(p->exit, i)) {
            CHECK_NEAR(vec_norm(seen), gray * sqrt(3), 1e-4);
            continue;
        }
        const struct vec n = bump_reference_normal(bumps ? bumps : &none, mesh_n, e);
        double sum = gray;
        for (size_t k = 0; k < light_count; k++)
            sum += 100 * strength * shine(light_at(azimuth, k, light_count), mesh_n, n, e);
        CHECK_NEAR(seen.x, sum, 0.03 * strength);
        assert_true(seen.x == seen.y && seen.y == seen.z);
        bright += seen.x > strength;
    }
    const float *alpha = image_find(&p->result.image, "A");
    for (size_t i = 0; i < PIXEL_COUNT; i++)
        CHECK_NEAR(alpha[i], 1, 0);
    assert_true(light_count ? bright > 5 : bright == 0);
}

static void pixels_are_as_computed(void **state)
{
    const char *const one[] = { "light.count=1", NULL };
    const char *const three[] = { "light.count=3", "light.azimuth=-20", "light.strength=3", NULL };
    struct surface_picture p = draw(*state, one, 0, NULL);
    check_pixels(&p, 60, 1, 1, NULL);
    finish(&p);
    p = draw(*state, three, 0, NULL);
    check_pixels(&p, -20, 3, 3, NULL);
    finish(&p);
}

/* Bumps of strength 1, even all over. */
static void bumps_move_highlights(void **state)
{
    const char *const one[] = { "light.count=1", "bump.strength=1", NULL };
    const struct bumps bumps = { 0.3, -0.2, 0 };
    struct surface_picture p = draw(*state, one, 0, &bumps);
    check_pixels(&p, 60, 1, 1, &bumps);
    finish(&p);
}

static void no_light_no_highlight(void **state)
{
    const char *const none[] = { "light.count=0", NULL };
    struct surface_picture p = draw(*state, none, 0, NULL);
    check_pixels(&p, 60, 0, 1, NULL);
    finish(&p);
}

/* ---- where they lie ---- */

/* Where on the unit sphere the normal is halfway between light and eye. */
static struct vec highlight_point(struct vec light)
{
    struct vec n = vec_unit(light);
    for (int i = 0; i < 200; i++) {
        const struct vec to_light = vec_unit(vec_add(light, -1, n));
        const struct vec to_eye = vec_unit(vec_add(vec_from(eye), -1, n));
        n = vec_unit(vec_add(to_light, 1, to_eye));
    }
    return n;
}

/* The pixel nearest to a direction from the eye. */
static void find_pixel(const struct surface_picture *p, struct vec dir, double *x, double *y)
{
    double best = 1e9;
    for (size_t i = 0; i < PIXEL_COUNT; i++) {
        const double angle = vec_angle_deg(picture_pixel_ray(&p->request, i), dir);
        if (angle >= best)
            continue;
        best = angle;
        const size_t row = i / SIZE;
        *x = (double)(i % SIZE);
        *y = (double)row;
    }
}

/* Takes the highlight around a pixel away; its weighted middle. False if it is dark there. */
static bool take_highlight(float *light, size_t at, double *x, double *y)
{
    static const int around[4] = { -1, 1, -SIZE, SIZE };
    size_t *open = malloc((4 * PIXEL_COUNT + 1) * sizeof(*open));
    size_t open_count = 0;
    double weight = 0;
    assert_non_null(open);
    *x = *y = 0;
    open[open_count++] = at;
    while (open_count > 0) {
        const size_t i = open[--open_count];
        if (i >= PIXEL_COUNT || light[i] < 0.2F)
            continue;
        const double w = (double)light[i];
        const size_t row = i / SIZE;
        weight += w;
        *x += w * (double)(i % SIZE);
        *y += w * (double)row;
        light[i] = 0;
        for (size_t k = 0; k < 4; k++)
            open[open_count++] = (size_t)((long)i + around[k]);
    }
    free(open);
    *x /= weight;
    *y /= weight;
    return weight > 0;
}

/* There is one highlight for each light that the sphere can show, where it should be. */
static void check_places(struct gpu *gpu, const char *count, size_t light_count, double azimuth,
                         float time)
{
    const char *const assignments[] = { count, "motion.lights=25", NULL };
    struct surface_picture p = draw(gpu, assignments, time, NULL);
    float *light = malloc(PIXEL_COUNT * sizeof(*light));
    assert_non_null(light);
    for (size_t i = 0; i < PIXEL_COUNT; i++)
        light[i] = p.beauty.planes[0][i] - (float)gray;
    for (size_t k = 0; k < light_count; k++) {
        const struct vec point = highlight_point(light_at(azimuth, k, light_count));
        double x = 0;
        double y = 0;
        double seen_x, seen_y;
        find_pixel(&p, vec_add(point, -1, vec_from(eye)), &x, &y);
        const size_t at = (size_t)y * SIZE + (size_t)x;
        assert_true(take_highlight(light, at, &seen_x, &seen_y));
        CHECK_NEAR(seen_x, x, 1);
        CHECK_NEAR(seen_y, y, 1);
    }
    for (size_t i = 0; i < PIXEL_COUNT; i++)
        assert_true(light[i] < 0.2F); /* and no other */
    free(light);
    finish(&p);
}

static void highlights_lie_halfway(void **state)
{
    check_places(*state, "light.count=1", 1, 60, 0);
    check_places(*state, "light.count=2", 2, 60, 0);
    check_places(*state, "light.count=4", 4, 60, 0);
}

static void lights_move_with_time(void **state)
{
    check_places(*state, "light.count=1", 1, 60 + 25 * 2.0, 2);
    check_places(*state, "light.count=3", 3, 60 + 25 * 1.2, 1.2F);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pixels_are_as_computed), cmocka_unit_test(bumps_move_highlights),
        cmocka_unit_test(no_light_no_highlight),  cmocka_unit_test(highlights_lie_halfway),
        cmocka_unit_test(lights_move_with_time),
    };
    return RUN_ON_DEVICE(tests);
}
