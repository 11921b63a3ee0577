/*
 * test_bump.c: bump mapping of the ice: in closed form for constant slopes, in the mean for
 * others. The layer `exit` tells of the normal, by eq. 1 and 2.
 */
#include <cglm/struct.h>
#include <stdlib.h>

#include "tests/support/assertions.h"
#include "tests/support/bump_reference.h"
#include "tests/support/lavapipe.h"
#include "tests/support/picture.h"

enum {
    SIZE = 176,
};

static const double eta = 1.0003 / 1.3091;
static const vec3s origin = { { 0, 0, 0 } };
static const vec3s eye = { { 1.007F, 0.886F, 2.6F } };

struct bump_picture {
    struct picture_request request;
    struct render_result result;
    struct picture_layer exit, normal, back;
};

static struct settings settings_of_bumps(const char *strength, const char *mapping)
{
    struct settings settings = picture_settings(strength);
    assert_int_equal(settings_assign(&settings, mapping, SETTING_USER, NULL), STATUS_OK);
    assert_int_equal(settings_assign(&settings, "motion.ice=30", SETTING_USER, NULL), STATUS_OK);
    return settings;
}

static struct bump_picture draw(struct gpu *gpu, const struct scene *scene, const char *refraction,
                                const struct settings *settings, float time)
{
    struct bump_picture p = {
        .request = {
            .scene = scene,
            .settings = settings,
            .refraction = refraction,
            .camera = { .eye = eye, .fov_deg = 50 },
            .width = SIZE,
            .height = SIZE,
            .layers = picture_layer_bit("exit") | picture_layer_bit("N") |
                      picture_layer_bit("back.N"),
            .time = time,
        },
    };
    p.result = picture_render(gpu, &p.request);
    p.exit = picture_layer(&p.result.image, "exit");
    p.normal = picture_layer(&p.result.image, "N");
    p.back = picture_layer(&p.result.image, "back.N");
    return p;
}

/* Eq. 2, with the reflected direction for a negative root. */
static struct vec refracted(struct vec e, struct vec n)
{
    const double c = vec_dot(n, e);
    const double k = 1 - eta * eta * (1 - c * c);
    if (k < 0)
        return vec_add(e, -2 * c, n);
    return vec_add(vec_scale(e, eta), -(eta * c + sqrt(k)), n);
}

/* Degrees between where light leaves in a pixel and where the closed form sends it, from the layers
 * of the mesh's normals; a is that of eq. 1, 0 for one side. */
static double error_of(const struct bump_picture *p, const struct bumps *bumps, double a, size_t i)
{
    const struct vec e = picture_pixel_ray(&p->request, i);
    const struct vec n_f = bump_reference_normal(bumps, picture_at(p->normal, i), e);
    const struct vec n_r = vec_add(vec_scale(n_f, 1 - a), -a, picture_at(p->back, i));
    return vec_angle_deg(picture_at(p->exit, i), refracted(e, n_r));
}

/* Of all pixels, of a sphere whose facets are small: normals tell where they are. */
static void check_sphere(struct gpu *gpu, const char *refraction, double a, struct bumps bumps,
                         float time)
{
    struct scene scene = picture_sphere_scene(origin, 40000);
    const struct settings settings =
        settings_of_bumps("bump.strength=0.5", "bump.mapping=triplanar");
    /* the strength leaves half of it, the mask four fifths */
    bump_reference_make_constant(&scene, bumps.slope_u / 0.5 / 0.8, bumps.slope_v / 0.5 / 0.8, 0.2,
                                 1);
    struct bump_picture p = draw(gpu, &scene, refraction, &settings, time);
    size_t count = 0;
    for (size_t i = 0; i < (size_t)SIZE * SIZE; i++) {
        if (!picture_is_object(p.exit, i))
            continue;
        CHECK_NEAR(error_of(&p, &bumps, a, i), 0, 0.15);
        count++;
    }
    assert_true(count > 2000);
    render_result_finish(&p.result);
    scene_finish(&scene);
}

static void slopes_bend_the_normal(void **state)
{
    check_sphere(*state, "one-sided", 0, (struct bumps){ 0.3, -0.2, 0 }, 0);
    check_sphere(*state, "paper", 0.33, (struct bumps){ 0.3, -0.2, 0 }, 0);
    check_sphere(*state, "one-sided", 0, (struct bumps){ 0.1, 0.4, 0 }, 0);
    check_sphere(*state, "one-sided", 0, (struct bumps){ 3, 1, 0 }, 0); /* turned from the eye */
}

static void bumps_turn_with_the_ice(void **state)
{
    const double turn = 30 * 1.7 * GLM_PI / 180;
    check_sphere(*state, "one-sided", 0, (struct bumps){ 0.3, -0.2, turn }, 1.7F);
}

/* ---- what must not change ---- */

static void check_same(const struct bump_picture *a, const struct bump_picture *b, double degrees)
{
    size_t count = 0;
    for (size_t i = 0; i < (size_t)SIZE * SIZE; i++) {
        assert_int_equal(picture_is_object(a->exit, i), picture_is_object(b->exit, i));
        CHECK_NEAR(vec_difference(picture_at(a->normal, i), picture_at(b->normal, i)), 0, 0);
        if (!picture_is_object(a->exit, i))
            continue;
        CHECK_NEAR(vec_angle_deg(picture_at(a->exit, i), picture_at(b->exit, i)), 0, degrees);
        count++;
    }
    assert_true(count > 2000);
}

/* Without maps, and where the mask says so, the surface is smooth; N is the mesh's always. */
static void smooth_is_smooth(void **state)
{
    struct scene scene = picture_sphere_scene(origin, 960);
    const struct settings on = settings_of_bumps("bump.strength=0.5", "bump.mapping=triplanar");
    const struct settings off = settings_of_bumps("bump.strength=0", "bump.mapping=triplanar");
    struct bump_picture smooth = draw(*state, &scene, "paper", &off, 0);
    struct bump_picture no_maps = draw(*state, &scene, "paper", &on, 0);
    check_same(&smooth, &no_maps, 1e-3);
    bump_reference_make_constant(&scene, 1, 1, 1, 0);
    struct bump_picture masked = draw(*state, &scene, "paper", &on, 0);
    check_same(&smooth, &masked, 1e-3);
    render_result_finish(&smooth.result);
    render_result_finish(&no_maps.result);
    render_result_finish(&masked.result);
    scene_finish(&scene);
}

/* ---- by uv ---- */

/* A square across +X as the object, its u along -Z, its v along -Y: as a picture hangs. */
static struct scene square_scene(void)
{
    static const uint32_t indices[6] = { 0, 2, 3, 0, 3, 1 };
    struct scene scene = { 0 };
    struct mesh *mesh = &scene.model.object;
    assert_true(mesh_init(mesh, 4, 6));
    for (uint32_t i = 0; i < 6; i++)
        mesh->indices[i] = indices[i];
    for (uint32_t i = 0; i < 4; i++) {
        const uint32_t row = i / 2;
        const vec2s uv = { { (float)(i % 2) * 3, (float)row * 5 } };
        mesh->vertices[i] = (struct mesh_vertex){
            .position = { { 0, 1 - uv.y / 2.5F, 1 - uv.x / 1.5F } },
            .normal = { { 1, 0, 0 } },
            .uv = uv,
        };
    }
    scene.box = mesh_box(mesh);
    return scene;
}

static void check_square(struct gpu *gpu, const char *mapping, struct vec gradient)
{
    struct scene scene = square_scene();
    const struct settings settings = settings_of_bumps("bump.strength=1", mapping);
    bump_reference_make_constant(&scene, 0.3, 0.1, 0, 1);
    struct bump_picture p = draw(gpu, &scene, "one-sided", &settings, 0);
    size_t count = 0;
    for (size_t i = 0; i < (size_t)SIZE * SIZE; i++) {
        const struct vec e = picture_pixel_ray(&p.request, i);
        if (!picture_is_object(p.exit, i))
            continue;
        const struct vec n_f = bump_reference_perturb(gradient, (struct vec){ 1, 0, 0 }, e);
        CHECK_NEAR(vec_angle_deg(picture_at(p.exit, i), refracted(e, n_f)), 0, 0.05);
        count++;
    }
    assert_true(count > 500);
    render_result_finish(&p.result);
    scene_finish(&scene);
}

static void maps_lie_along_planes_or_uv(void **state)
{
    check_square(*state, "bump.mapping=triplanar", (struct vec){ 0, 0.3, 0.1 });
    check_square(*state, "bump.mapping=uv", (struct vec){ 0, -0.1, -0.3 });
}

/* A mesh without uv: as if it were smooth. */
static void no_uv_is_smooth(void **state)
{
    struct scene scene = picture_sphere_scene(origin, 960);
    const struct settings on = settings_of_bumps("bump.strength=0.5", "bump.mapping=uv");
    const struct settings off = settings_of_bumps("bump.strength=0", "bump.mapping=uv");
    bump_reference_make_constant(&scene, 1, 1, 0, 0);
    struct bump_picture smooth = draw(*state, &scene, "paper", &off, 0);
    struct bump_picture bumped = draw(*state, &scene, "paper", &on, 0);
    check_same(&smooth, &bumped, 1e-3);
    render_result_finish(&smooth.result);
    render_result_finish(&bumped.result);
    scene_finish(&scene);
}

/* ---- the maps made by code ---- */

/* Which plane has the largest share. */
static int plane_of(struct vec n)
{
    const double x = fabs(n.x);
    const double y = fabs(n.y);
    return x > y ? (x > fabs(n.z) ? 0 : 2) : (y > fabs(n.z) ? 1 : 2);
}

struct sums {
    struct vec deviation;
    double square, size;
    double inside, across; /* difference between neighbours: of one plane, of two */
    size_t count, inside_count, across_count;
};

static void add_pixel(struct sums *s, const struct bump_picture *p,
                      const struct bump_picture *smooth, size_t i)
{
    const struct vec e = picture_pixel_ray(&p->request, i);
    if (!picture_is_object(p->exit, i) || vec_dot(picture_at(p->normal, i), e) > -0.5)
        return;
    const struct vec d = vec_add(picture_at(p->exit, i), -1, picture_at(smooth->exit, i));
    s->deviation = vec_add(s->deviation, 1, d);
    s->square += vec_dot(d, d);
    s->count++;
    if (!picture_is_object(p->exit, i + 1))
        return;
    const bool same = plane_of(picture_at(p->normal, i)) == plane_of(picture_at(p->normal, i + 1));
    const double step = vec_norm(vec_add(picture_at(p->exit, i + 1), -1, picture_at(p->exit, i)));
    *(same ? &s->inside : &s->across) += step;
    *(same ? &s->inside_count : &s->across_count) += 1;
}

/* Around the smooth direction, without a step where another plane takes over. */
static void bumps_are_even_and_seamless(void **state)
{
    struct scene scene = picture_sphere_scene(origin, 40000);
    const struct settings on = settings_of_bumps("bump.strength=0.2", "bump.mapping=triplanar");
    const struct settings off = settings_of_bumps("bump.strength=0", "bump.mapping=triplanar");
    assert_true(bump_maps_init(&scene.bump, &(struct bump_maps_params){ 0 }));
    struct bump_picture smooth = draw(*state, &scene, "one-sided", &off, 0);
    struct bump_picture p = draw(*state, &scene, "one-sided", &on, 0);
    struct sums s = { { 0 } };
    for (size_t i = 0; i + 1 < (size_t)SIZE * SIZE; i++)
        add_pixel(&s, &p, &smooth, i);
    const double count = (double)s.count;
    const double deviation = sqrt(s.square / count);
    print_message("mean %g, deviation %g; steps %g and %g\n", vec_norm(s.deviation) / count,
                  deviation, s.inside / (double)s.inside_count, s.across / (double)s.across_count);
    assert_true(s.across_count > 50);
    assert_true(vec_norm(s.deviation) / count < 0.25 * deviation);
    /* a normal turned by d turns refracted light by (1 - eta) d, straight on */
    assert_true(deviation > 0.5 * (1 - eta) * 0.2 && deviation < 1.5 * (1 - eta) * 0.2);
    assert_true(s.across / (double)s.across_count < 1.2 * s.inside / (double)s.inside_count);
    render_result_finish(&smooth.result);
    render_result_finish(&p.result);
    scene_finish(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(slopes_bend_the_normal), cmocka_unit_test(bumps_turn_with_the_ice),
        cmocka_unit_test(smooth_is_smooth),       cmocka_unit_test(maps_lie_along_planes_or_uv),
        cmocka_unit_test(no_uv_is_smooth),        cmocka_unit_test(bumps_are_even_and_seamless),
    };
    return RUN_ON_DEVICE(tests);
}
