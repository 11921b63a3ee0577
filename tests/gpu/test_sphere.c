/* test_sphere.c: the layers of a sphere against closed forms and against each other. */
#include <stdlib.h>

#include "tests/support/assertions.h"

#include "src/render/uploaded_scene.h"
#include "src/scene/generate/generate.h"
#include "tests/support/lavapipe.h"
#include "tests/support/picture.h"

static const double eta = 1.0003 / 1.3091;
static const double blend = 0.33; /* a of eq. 1 */

/* From here the sphere covers a fifth of the picture, from there nearly all of it. */
static const vec3s fifth = { { 1.007F, 0.886F, 4.028F } };
static const vec3s full = { { 0.417F, 0.367F, 1.67F } };

struct sphere_picture {
    struct scene scene;
    struct picture_request request;
    struct render_result result;
    struct picture_layer beauty, normal, position, back, exit, refraction, reflection;
    const float *z, *fresnel;
    size_t pixel_count;
};

/* In an environment of directions. */
static struct sphere_picture draw(struct gpu *gpu, uint32_t triangles, const char *refraction,
                                  vec3s eye)
{
    struct sphere_picture p = {
        .scene = picture_sphere_scene((vec3s){ { 0, 0, 0 } }, triangles),
        .request = {
            .refraction = refraction,
            .camera = { .eye = eye, .fov_deg = 45 },
            .width = 192,
            .height = 144,
            .layers = PICTURE_ALL_LAYERS,
        },
        .pixel_count = (size_t)192 * 144,
    };
    picture_use_directions(&p.scene, 512);
    p.request.scene = &p.scene;
    p.result = picture_render(gpu, &p.request);
    const struct image *image = &p.result.image;
    p.beauty = picture_layer(image, "");
    p.normal = picture_layer(image, "N");
    p.position = picture_layer(image, "P");
    p.back = picture_layer(image, "back.N");
    p.exit = picture_layer(image, "exit");
    p.refraction = picture_layer(image, "refraction");
    p.reflection = picture_layer(image, "reflection");
    p.z = image_find(image, "Z");
    p.fresnel = image_find(image, "fresnel.Z");
    return p;
}

static void finish(struct sphere_picture *p)
{
    render_result_finish(&p->result);
    scene_finish(&p->scene);
}

/* ---- closed forms ---- */

/* Where a ray meets the unit sphere around the origin; the points are the normals. */
struct crossing {
    struct vec front, back;
};

static bool cross_sphere(struct vec eye, struct vec e, struct crossing *crossing)
{
    const double middle = -vec_dot(eye, e);
    const double root = middle * middle - vec_dot(eye, eye) + 1;
    if (root < 0)
        return false;
    crossing->front = vec_add(eye, middle - sqrt(root), e);
    crossing->back = vec_add(eye, middle + sqrt(root), e);
    return true;
}

/* Distance of the ray from the sphere's centre, in radii. */
static double impact(struct vec eye, struct vec e)
{
    return vec_norm(vec_cross(eye, e));
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

/* ---- errors over the pixels that show the sphere and should ---- */

typedef double error_fn(const struct sphere_picture *p, size_t i, struct vec e,
                        const struct crossing *ideal);

static void check_errors(const struct sphere_picture *p, const char *what, error_fn *error,
                         double median, double most)
{
    double *errors = malloc(p->pixel_count * sizeof(*errors));
    size_t count = 0;
    assert_non_null(errors);
    for (size_t i = 0; i < p->pixel_count; i++) {
        const struct vec e = picture_pixel_ray(&p->request, i);
        struct crossing ideal;
        if (!picture_is_object(p->exit, i) ||
            !cross_sphere(vec_from(p->request.camera.eye), e, &ideal))
            continue;
        errors[count++] = error(p, i, e, &ideal);
    }
    const double middle = picture_quantile(errors, count, 0.5);
    const double high = picture_quantile(errors, count, 0.95);
    if (!(middle <= median && high <= most))
        fail_msg("%s: median %g, 95 %% below %g", what, middle, high);
    free(errors);
}

static double exit_error(const struct sphere_picture *p, size_t i, struct vec e,
                         const struct crossing *ideal)
{
    return vec_angle_deg(picture_at(p->exit, i), refracted(e, ideal->front));
}

static double normal_error(const struct sphere_picture *p, size_t i, struct vec e,
                           const struct crossing *ideal)
{
    (void)e;
    return vec_angle_deg(picture_at(p->normal, i), ideal->front);
}

static double back_error(const struct sphere_picture *p, size_t i, struct vec e,
                         const struct crossing *ideal)
{
    (void)e;
    return vec_angle_deg(picture_at(p->back, i), ideal->back);
}

static double position_error(const struct sphere_picture *p, size_t i, struct vec e,
                             const struct crossing *ideal)
{
    (void)e;
    return vec_norm(vec_add(picture_at(p->position, i), -1, ideal->front));
}

static double fresnel_error(const struct sphere_picture *p, size_t i, struct vec e,
                            const struct crossing *ideal)
{
    return fabs((double)p->fresnel[i] - pow(1 - fabs(vec_dot(e, ideal->front)), 3));
}

/*
 * A ray meets a facet a little before or behind the sphere, by up to 0.006 on its axis, and the
 * interpolated normal is that of another point: toward the silhouette both errors grow like a
 * tangent.
 */
static void layers_are_those_of_a_sphere(void **state)
{
    struct sphere_picture p = draw(*state, GENERATE_SPHERE_TRIANGLES, "one-sided", fifth);
    check_errors(&p, "exit", exit_error, 0.1, 0.5);
    finish(&p);
    p = draw(*state, GENERATE_SPHERE_TRIANGLES, "one-sided", full);
    check_errors(&p, "exit", exit_error, 0.1, 0.5);
    check_errors(&p, "normal", normal_error, 0.35, 1);
    check_errors(&p, "back", back_error, 0.35, 1);
    check_errors(&p, "position", position_error, 0.01, 0.02);
    check_errors(&p, "fresnel", fresnel_error, 0.012, 0.05);
    finish(&p);
    p = draw(*state, 40000, "one-sided", fifth);
    check_errors(&p, "exit", exit_error, 0.005, 0.05);
    check_errors(&p, "normal", normal_error, 0.02, 0.1);
    check_errors(&p, "back", back_error, 0.02, 0.1);
    check_errors(&p, "position", position_error, 0.0005, 0.002);
    check_errors(&p, "fresnel", fresnel_error, 0.0005, 0.003);
    finish(&p);
}

/* What holds in every pixel, whatever the triangles: vertices and normals of a sphere are one. */
static void check_pixel(const struct sphere_picture *p, size_t i, struct vec forward)
{
    const struct vec e = picture_pixel_ray(&p->request, i);
    const struct vec point = picture_at(p->position, i);
    const struct vec from_eye = vec_add(point, -1, vec_from(p->request.camera.eye));
    const struct vec n = picture_at(p->normal, i);
    const struct vec n_b = picture_at(p->back, i);
    const double b = impact(vec_from(p->request.camera.eye), e);
    if (!picture_is_object(p->exit, i)) {
        assert_true(b > 0.985);
        assert_true(p->z[i] >= 1e10F && vec_norm(n) == 0 && p->fresnel[i] == 0.0F);
        return;
    }
    assert_true(b < 1.007); /* where the vertices are */
    CHECK_NEAR(vec_norm(vec_cross(from_eye, e)), 0, 1e-4);
    CHECK_NEAR(p->z[i], vec_dot(from_eye, forward), 1e-4);
    CHECK_NEAR(vec_difference(n, vec_unit(point)), 0, 1e-4);
    assert_true(vec_dot(n, e) < 0.15); /* the last facets bend around the silhouette */
    CHECK_NEAR(vec_norm(n_b), 1, 2e-3);
    assert_true(vec_dot(n_b, e) > -0.15);
}

static void pixels_are_consistent(void **state)
{
    struct sphere_picture p = draw(*state, GENERATE_SPHERE_TRIANGLES, "paper", fifth);
    const struct vec forward =
        picture_ray(&p.request, p.request.width / 2.0, p.request.height / 2.0);
    for (size_t i = 0; i < p.pixel_count; i++)
        check_pixel(&p, i, forward);
    finish(&p);
}

/* Eq. 1 and 2 on the layers that the same picture shows, to float's precision. */
static void exit_follows_from_the_normals(void **state)
{
    static const char *const refraction_models[] = { "paper", "one-sided" };
    for (size_t r = 0; r < 2; r++) {
        struct sphere_picture p =
            draw(*state, GENERATE_SPHERE_TRIANGLES, refraction_models[r], fifth);
        for (size_t i = 0; i < p.pixel_count; i++) {
            const struct vec e = picture_pixel_ray(&p.request, i);
            const struct vec n_f = picture_at(p.normal, i);
            const struct vec n_r =
                r ? n_f : vec_add(vec_scale(n_f, 1 - blend), -blend, picture_at(p.back, i));
            if (picture_is_object(p.exit, i))
                CHECK_NEAR(vec_angle_deg(picture_at(p.exit, i), refracted(e, n_r)), 0, 1e-3);
        }
        finish(&p);
    }
}

/* Deviation of light that passes the centre at 0.6 radii. */
static void check_deviation(struct gpu *gpu, const char *refraction, double expected)
{
    struct sphere_picture p = draw(gpu, 40000, refraction, fifth);
    double sum = 0;
    size_t count = 0;
    for (size_t i = 0; i < p.pixel_count; i++) {
        const struct vec e = picture_pixel_ray(&p.request, i);
        const double b = impact(vec_from(p.request.camera.eye), e);
        if (fabs(b - 0.6) > 0.01)
            continue;
        sum += vec_angle_deg(picture_at(p.exit, i), e);
        count++;
    }
    assert_true(count > 50);
    CHECK_NEAR(sum / (double)count, expected, 0.05);
    finish(&p);
}

static void light_is_deviated_as_known(void **state)
{
    check_deviation(*state, "one-sided", 9.582);
    check_deviation(*state, "paper", 3.285);
}

static void beauty_is_composed_of_the_layers(void **state)
{
    static const char *const refraction_models[] = { "paper", "one-sided" };
    for (size_t r = 0; r < 2; r++) {
        struct sphere_picture p =
            draw(*state, GENERATE_SPHERE_TRIANGLES, refraction_models[r], fifth);
        for (size_t i = 0; i < p.pixel_count; i++) {
            const double f = (double)p.fresnel[i];
            const struct vec expected = vec_add(vec_scale(picture_at(p.reflection, i), f), 1 - f,
                                                picture_at(p.refraction, i));
            if (picture_is_object(p.exit, i))
                CHECK_NEAR(vec_difference(picture_at(p.beauty, i), expected), 0, 1e-3);
        }
        finish(&p);
    }
}

/* Share of light that the unit sphere reflects inside where a chord of that length ends. */
static double reflected_inside(double chord)
{
    const double inside = fmin(chord / 2, 1);
    const double outside = sqrt(fmax(1 - (1 - inside * inside) / (eta * eta), 0));
    const double s = (inside - eta * outside) / (inside + eta * outside);
    const double p = (eta * inside - outside) / (eta * inside + outside);
    return (s * s + p * p) / 2;
}

/* All chords of a ray are equal: the share 1 - F leaves after one, and the rest after two. */
static void second_exit_has_the_rest(void **state)
{
    struct settings settings = picture_settings("light.count=0");
    static const char *const all[] = { "absorb.red=0.3", "refract.fresnel=crossfade",
                                       "refract.crossfade=1" };
    for (size_t i = 0; i < sizeof(all) / sizeof(all[0]); i++)
        assert_int_equal(settings_assign(&settings, all[i], SETTING_USER, NULL), STATUS_OK);
    struct scene scene = picture_sphere_scene((vec3s){ { 0, 0, 0 } }, 40000);
    scene.background.kind = SCENE_COLOR;
    scene.background.color = (vec3s){ { 1, 1, 1 } };
    const struct picture_request request = {
        .scene = &scene,
        .settings = &settings,
        .refraction = "bounce",
        .camera = { .eye = fifth, .fov_deg = 45 },
        .width = 192,
        .height = 144,
        .layers = picture_layer_bit("path"),
    };
    struct render_result result = picture_render(*state, &request);
    const float *path = image_find(&result.image, "path.Z");
    const float *red = image_find(&result.image, "R");
    double most = 0;
    for (size_t i = 0; i < (size_t)192 * 144; i++) {
        const double share = reflected_inside((double)path[i]), left = exp(-0.3 * (double)path[i]);
        if (!(path[i] > 0) || share > 0.3) /* at the rim the share changes within a texel */
            continue;
        CHECK_NEAR((double)red[i], (1 - share) * left + share * left * left, 2e-3);
        most = fmax(most, share);
    }
    assert_true(most > 0.1);
    render_result_finish(&result);
    scene_finish(&scene);
}

/* The colour of a ball of directions that a ray from outside meets, or white before it. */
static struct vec ball_or_white(struct vec from, struct vec dir, struct vec center, double radius)
{
    const struct vec m = vec_add(from, -1, center);
    const double middle = -vec_dot(m, dir);
    const double root = middle * middle - vec_dot(m, m) + radius * radius;
    if (root < 0 || middle < 0)
        return (struct vec){ 1, 1, 1 };
    const struct vec end = vec_add(m, middle - sqrt(root), dir);
    return picture_direction_color(vec_scale(end, 1 / radius));
}

static struct vec bent(struct vec e, struct vec n, double ratio)
{
    const double c = vec_dot(n, e);
    const double k = 1 - ratio * ratio * (1 - c * c);
    return vec_add(vec_scale(e, ratio), -(ratio * c + sqrt(k)), n);
}

/* Mean difference of what is seen through the sphere of a ball before a white sky. */
static double ball_error(struct gpu *gpu, const char *lookup)
{
    const char *const all[] = { lookup, "refract.fresnel=crossfade", "refract.crossfade=1",
                                "refract_bounce.exits=1" };
    const vec3s center = { { -0.5F, 0.1F, -2.6F } };
    struct settings settings = picture_settings("light.count=0");
    for (size_t i = 0; i < sizeof(all) / sizeof(all[0]); i++)
        assert_int_equal(settings_assign(&settings, all[i], SETTING_USER, NULL), STATUS_OK);
    struct scene scene = picture_sphere_scene((vec3s){ { 0, 0, 0 } }, 40000);
    scene.background.kind = SCENE_COLOR;
    scene.background.color = (vec3s){ { 1, 1, 1 } };
    picture_add_directions(&scene, center, 1);
    const struct picture_request request = {
        .scene = &scene,
        .settings = &settings,
        .refraction = "bounce",
        .camera = { .eye = fifth, .fov_deg = 45 },
        .width = 192,
        .height = 144,
        .layers = picture_layer_bit("exit"),
    };
    struct render_result result = picture_render(gpu, &request);
    const struct picture_layer beauty = picture_layer(&result.image, "");
    double sum = 0, count = 0;
    for (size_t i = 0; i < (size_t)192 * 144; i++) {
        const struct vec e = picture_pixel_ray(&request, i);
        struct crossing c;
        if (impact(vec_from(fifth), e) > 0.95 || !cross_sphere(vec_from(fifth), e, &c))
            continue;
        const struct vec inside = bent(e, c.front, eta);
        const struct vec exit = vec_add(c.front, -2 * vec_dot(c.front, inside), inside);
        const struct vec dir = bent(inside, vec_scale(exit, -1), 1 / eta);
        sum += vec_difference(picture_at(beauty, i), ball_or_white(exit, dir, vec_from(center), 1));
        count++;
    }
    render_result_finish(&result);
    scene_finish(&scene);
    return sum / count;
}

static void objects_before_the_sky_are_where_they_are(void **state)
{
    const double infinite = ball_error(*state, "refract.lookup=infinite");
    const double distance = ball_error(*state, "refract.lookup=distance");
    print_message("ball before the sky: infinite %.4f, distance %.4f\n", infinite, distance);
    assert_true(distance < 0.25 * infinite);
}

/* What a window's movements draw. Of the same error, more triangles become as many. */
static void coarse_triangles_have_the_shape(void **state)
{
    uint32_t counts[2];
    for (uint32_t i = 0; i < 2; i++) {
        struct scene scene = picture_sphere_scene((vec3s){ { 0, 0, 0 } }, i ? 40000 : 10000);
        struct uploaded_scene on_gpu;
        assert_int_equal(uploaded_scene_init(&on_gpu, *state, &scene), STATUS_OK);
        assert_int_equal(uploaded_scene_add_simplified(&on_gpu, *state, &scene), STATUS_OK);
        const struct rg_mesh whole = uploaded_scene_mesh(&on_gpu.object, false);
        const struct rg_mesh coarse = uploaded_scene_mesh(&on_gpu.object, true);
        assert_ptr_equal(coarse.vertices, whole.vertices);
        assert_int_equal(whole.index_count, scene.model.object.index_count);
        counts[i] = coarse.index_count / 3;
        uploaded_scene_finish(&on_gpu, *state);
        scene_finish(&scene);
    }
    print_message("coarse triangles: %u and %u\n", counts[0], counts[1]);
    /* A chord of angle a is a^2 / 8 of the radius below the sphere. */
    assert_in_range(counts[0], 300, 2500);
    assert_in_range(counts[1], 300, 2500);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(coarse_triangles_have_the_shape),
        cmocka_unit_test(layers_are_those_of_a_sphere),
        cmocka_unit_test(pixels_are_consistent),
        cmocka_unit_test(exit_follows_from_the_normals),
        cmocka_unit_test(light_is_deviated_as_known),
        cmocka_unit_test(beauty_is_composed_of_the_layers),
        cmocka_unit_test(second_exit_has_the_rest),
        cmocka_unit_test(objects_before_the_sky_are_where_they_are),
    };
    return RUN_ON_DEVICE(tests);
}
