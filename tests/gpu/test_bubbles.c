/*
 * test_bubbles.c: bubbles against closed forms: reflection, transmission, order, and clipping to
 * the ice. Surroundings are directions as colours: see picture.h.
 */
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>

#include "src/settings/quality.h"
#include "tests/support/assertions.h"
#include "tests/support/lavapipe.h"
#include "tests/support/picture.h"

enum {
    SIZE = 256,
};

static const double eta = 1.3091 / 1.0003; /* from the ice into the bubble */

static struct scene open_scene(const struct bubble *spheres, uint32_t count)
{
    const vec3s center = { { 0, 0, 0 } };
    struct scene scene = picture_sphere_scene(center, 4000);
    picture_use_directions(&scene, 1024);
    scene.inclusions.bubbles.all = calloc(count + 1, sizeof(*scene.inclusions.bubbles.all));
    assert_non_null(scene.inclusions.bubbles.all);
    for (uint32_t i = 0; i < count; i++)
        scene.inclusions.bubbles.all[i] = spheres[i];
    scene.inclusions.bubbles.count = count;
    return scene;
}

static struct picture_request request_of(const struct scene *scene, float azimuth, float distance,
                                         float fov_deg)
{
    return (struct picture_request){
        .scene = scene,
        .camera = camera_orbit(azimuth, 0, distance, box_center(scene->box), fov_deg),
        .width = SIZE,
        .height = SIZE,
        .layers = picture_layer_bit("bubbles") | picture_layer_bit("thickness"),
    };
}

/* ---- one bubble, as its closed forms have it ---- */

/* Where a ray meets a sphere. */
struct meeting {
    double b;           /* impact parameter in its radii; not below 1: not at all */
    double distance;    /* of the nearer point */
    struct vec outward; /* from the centre to the ray, unit */
};

static struct meeting meet(struct vec eye, struct vec e, struct bubble sphere)
{
    const struct vec to_center = vec_add(vec_from(sphere.center), -1, eye);
    const double along = vec_dot(to_center, e);
    const struct vec aside = vec_add(vec_scale(e, along), -1, to_center);
    const double r = (double)sphere.radius;
    const double b = vec_norm(aside) / r;
    return (struct meeting){
        .b = b,
        .distance = along - r * sqrt(fmax(1 - b * b, 0)),
        .outward = vec_scale(aside, 1 / (r * b)),
    };
}

/* A direction as colour, turned outward by an angle. */
static struct vec turned_color(struct vec e, struct vec outward, double angle)
{
    return picture_direction_color(vec_add(vec_scale(e, cos(angle)), sin(angle), outward));
}

/* Share of the light that is reflected. */
static double fresnel(double b)
{
    if (b * eta >= 1)
        return 1;
    const double ci = cos(asin(b));
    const double ct = cos(asin(eta * b));
    const double rs = (eta * ci - ct) / (eta * ci + ct);
    const double rp = (ci - eta * ct) / (ci + eta * ct);
    return (rs * rs + rp * rp) / 2;
}

/* How much of the picture behind is replaced by light that passes. */
static double passing(double b)
{
    return b * eta >= 1 ? 0 : (1 - fresnel(b)) * eta * eta * b * b;
}

struct shade {
    struct vec color; /* premultiplied */
    double alpha;
};

static struct shade shade(struct vec e, struct meeting m)
{
    const struct vec back = turned_color(e, m.outward, 2 * acos(m.b));
    struct shade s = { vec_scale(back, fresnel(m.b)), fresnel(m.b) + passing(m.b) };
    if (passing(m.b) > 0) {
        const double angle = 2 * (asin(eta * m.b) - asin(m.b));
        s.color = vec_add(s.color, passing(m.b), turned_color(e, m.outward, angle));
    }
    return s;
}

/* ---- tests ---- */

/* Directions found in the picture; the share of light that is reflected is taken out. */
static void light_that_passes(void **state)
{
    static const double published[][2] = { { 0.2, 7.2729 }, { 0.4, 15.9760 }, { 0.6, 29.7431 } };
    const struct bubble sphere = { { { 0, 0, 0 } }, 0.5F };
    struct scene scene = open_scene(&sphere, 1);
    const struct picture_request request = request_of(&scene, 0, 40, 1.6F);
    struct render_result result = picture_render(*state, &request);
    const struct picture_layer layer = picture_layer(&result.image, "bubbles");
    const struct vec eye = vec_from(request.camera.eye);
    for (size_t k = 0; k < 3; k++) {
        double sum = 0;
        size_t count = 0;
        for (size_t i = 0; i < (size_t)SIZE * SIZE; i++) {
            const struct vec e = picture_pixel_ray(&request, i);
            const struct meeting m = meet(eye, e, sphere);
            if (fabs(m.b - published[k][0]) > 0.01)
                continue;
            const struct vec back = turned_color(e, m.outward, 2 * acos(m.b));
            const struct vec seen =
                vec_scale(vec_add(picture_at(layer, i), -fresnel(m.b), back), 1 / passing(m.b));
            const struct vec dir = vec_add(vec_scale(seen, 2), -1, (struct vec){ 1, 1, 1 });
            assert_true(vec_dot(dir, m.outward) > 0);
            sum += vec_angle_deg(dir, e);
            count++;
        }
        print_message("%.1f: %.3f degrees\n", published[k][0], sum / (double)count);
        assert_true(count > 50);
        CHECK_NEAR(sum / (double)count, published[k][1], 0.1);
    }
    render_result_finish(&result);
    scene_finish(&scene);
}

/* All of the light where alpha is 1. */
static void total_reflection(void **state)
{
    const struct bubble sphere = { { { 0, 0, 0 } }, 0.5F };
    struct scene scene = open_scene(&sphere, 1);
    const struct picture_request request = request_of(&scene, 0, 40, 1.6F);
    struct render_result result = picture_render(*state, &request);
    const struct picture_layer layer = picture_layer(&result.image, "bubbles");
    const float *alpha = image_find(&result.image, "bubbles.A");
    size_t all = 0;
    size_t total = 0;
    for (size_t i = 0; i < (size_t)SIZE * SIZE; i++) {
        const struct vec e = picture_pixel_ray(&request, i);
        const struct meeting m = meet(vec_from(request.camera.eye), e, sphere);
        all += m.b < 1;
        total += alpha[i] >= 1.0F;
        if (m.b > 1.001)
            assert_true(alpha[i] == 0.0F);
        if (m.b > 0.77 && m.b < 0.97) /* then by 14 degrees for 0.03 */
            CHECK_NEAR(
                vec_difference(picture_at(layer, i), turned_color(e, m.outward, 2 * acos(m.b))), 0,
                5e-3);
        if (m.b < 0.05)
            CHECK_NEAR(alpha[i], 0.0179 + eta * eta * m.b * m.b, 1e-3);
    }
    const double share = (double)total / (double)all;
    print_message("%.2f %% of the disc\n", 100 * share);
    CHECK_NEAR(share, 0.416, 3e-3);
    render_result_finish(&result);
    scene_finish(&scene);
}

/* Compares every pixel with the bubbles behind each other; the rim's pixels apart. */
static void check_picture(struct gpu *gpu, const struct picture_request *request,
                          const struct bubble *spheres)
{
    struct render_result result = picture_render(gpu, request);
    const struct picture_layer layer = picture_layer(&result.image, "bubbles");
    const float *alpha = image_find(&result.image, "bubbles.A");
    const struct vec eye = vec_from(request->camera.eye);
    size_t hidden = 0;
    for (size_t i = 0; i < (size_t)SIZE * SIZE; i++) {
        const struct vec e = picture_pixel_ray(request, i);
        struct meeting m[2] = { meet(eye, e, spheres[0]), meet(eye, e, spheres[1]) };
        if ((m[0].b > 0.97 && m[0].b < 1.02) || (m[1].b > 0.97 && m[1].b < 1.02))
            continue;
        struct shade sum = { { 0, 0, 0 }, 0 };
        const size_t first = m[0].distance < m[1].distance ? 0 : 1;
        for (size_t k = 0; k < 2; k++) {
            const struct meeting *next = &m[k ? 1 - first : first];
            if (next->b >= 1)
                continue;
            const struct shade s = shade(e, *next);
            sum.color = vec_add(sum.color, 1 - sum.alpha, s.color);
            sum.alpha += (1 - sum.alpha) * s.alpha;
        }
        hidden += m[0].b < 1 && m[1].b < 1;
        CHECK_NEAR(vec_difference(picture_at(layer, i), sum.color), 0, 8e-3);
        CHECK_NEAR(alpha[i], sum.alpha, 2e-3);
    }
    assert_true(hidden > 500);
    render_result_finish(&result);
}

/* Two bubbles, one before the other: from both sides, in either order, and turned half around. */
static void the_nearer_bubble_hides_the_other(void **state)
{
    static const struct bubble spheres[3] = {
        { { { 0.1F, 0, 0.4F } }, 0.25F },
        { { { -0.1F, 0.1F, -0.4F } }, 0.35F },
        { { { 0.1F, 0, 0.4F } }, 0.25F },
    };
    static const struct bubble turned[2] = {
        { { { -0.1F, 0, -0.4F } }, 0.25F },
        { { { 0.1F, 0.1F, 0.4F } }, 0.35F },
    };
    const struct settings settings = picture_settings("motion.ice=60");
    for (size_t order = 0; order < 2; order++) {
        struct scene scene = open_scene(&spheres[order], 2);
        struct picture_request request = request_of(&scene, 0, 4, 20);
        check_picture(*state, &request, spheres);
        request = request_of(&scene, 180, 4, 20);
        check_picture(*state, &request, spheres);
        request = request_of(&scene, 0, 4, 20);
        request.settings = &settings;
        request.time = 3;
        check_picture(*state, &request, turned);
        scene_finish(&scene);
    }
}

/* Counts pixels of bubbles, which must all be on the ice. */
static size_t count_on_ice(struct gpu *gpu, const struct picture_request *request)
{
    struct render_result result = picture_render(gpu, request);
    const float *alpha = image_find(&result.image, "bubbles.A");
    const float *thickness = image_find(&result.image, "thickness.Z");
    size_t count = 0;
    for (size_t i = 0; i < (size_t)SIZE * SIZE; i++) {
        count += alpha[i] > 0.0F;
        assert_true(alpha[i] == 0.0F || thickness[i] > 0.0F);
    }
    render_result_finish(&result);
    return count;
}

/* Bubbles that lie across the surface, beside the ice, before and behind it. */
static void clipped_to_the_ice(void **state)
{
    static const struct bubble across = { { { 0.9F, 0, 0 } }, 0.3F };
    static const struct bubble outside[3] = {
        { { { 1.2F, 0, 0 } }, 0.15F },
        { { { 0, 0, 1.2F } }, 0.15F },
        { { { 0, 0, -1.2F } }, 0.15F },
    };
    struct scene scene = open_scene(&across, 1);
    struct picture_request request = request_of(&scene, 0, 4, 40);
    assert_true(count_on_ice(*state, &request) > 300);
    scene_finish(&scene);
    scene = open_scene(outside, 3);
    request = request_of(&scene, 0, 4, 40);
    assert_int_equal(count_on_ice(*state, &request), 0);
    scene_finish(&scene);
}

/* The nearer the eye, the wider a sphere's outline is than the sphere. */
static void close_up(void **state)
{
    const struct bubble sphere = { { { 0, 0, 0 } }, 0.9F };
    struct scene scene = open_scene(&sphere, 1);
    const struct picture_request request = request_of(&scene, 0, 1.3F, 100);
    struct render_result result = picture_render(*state, &request);
    const float *alpha = image_find(&result.image, "bubbles.A");
    size_t seen = 0;
    for (size_t i = 0; i < (size_t)SIZE * SIZE; i++) {
        const struct vec e = picture_pixel_ray(&request, i);
        const struct meeting m = meet(vec_from(request.camera.eye), e, sphere);
        assert_true(m.b > 0.99 || alpha[i] > 0.0F);
        assert_true(m.b < 1.01 || alpha[i] <= 0.0F);
        seen += alpha[i] > 0.0F;
    }
    assert_true(seen < (size_t)SIZE * SIZE * 3 / 4);
    render_result_finish(&result);
    scene_finish(&scene);
}

/* An eye in a bubble sees none of it; as many as there can be are drawn. */
static void extremes(void **state)
{
    const struct bubble sphere = { { { 0, 0, 0 } }, 0.5F };
    struct scene scene = open_scene(&sphere, 1);
    struct picture_request request = request_of(&scene, 0, 0.25F, 40);
    assert_int_equal(count_on_ice(*state, &request), 0);
    scene_finish(&scene);
    const struct scene_params params = {
        .name = "sphere",
        .bubbles = { .count = BUBBLES_COUNT_MAX, .seed = 1, .size = 0.02F },
    };
    assert_int_equal(scene_load(&scene, &params), STATUS_OK);
    assert_int_equal(scene.inclusions.bubbles.count, BUBBLES_COUNT_MAX);
    request = request_of(&scene, 0, 4, 40);
    assert_true(count_on_ice(*state, &request) > 10000);
    scene_finish(&scene);
}

/* In surroundings of one colour there is nothing to see of them, nor of the ice. */
static void in_even_light(void **state)
{
    const struct bubble sphere = { { { 0, 0, 0 } }, 0.5F };
    struct scene scene = open_scene(&sphere, 1);
    scene.background.kind = SCENE_COLOR;
    scene.background.color = (vec3s){ { 0.25F, 0.5F, 0.75F } };
    struct picture_request request = request_of(&scene, 0, 4, 40);
    const struct settings settings = picture_settings("refract_bounce.inclusions=all");
    static const char *const refraction_models[] = { NULL, "bounce" };
    request.settings = &settings;
    for (size_t r = 0; r < 2; r++) {
        request.refraction = refraction_models[r];
        struct render_result result = picture_render(*state, &request);
        const float *alpha = image_find(&result.image, "bubbles.A");
        for (size_t i = 0; i < (size_t)SIZE * SIZE; i++) {
            const struct vec color = vec_from(scene.background.color);
            const struct vec bubble = picture_at(picture_layer(&result.image, "bubbles"), i);
            const struct vec seen = picture_at(picture_layer(&result.image, ""), i);
            CHECK_NEAR(vec_difference(bubble, vec_scale(color, (double)alpha[i])), 0, 1e-3);
            CHECK_NEAR(vec_difference(seen, color), 0, 2e-3);
        }
        render_result_finish(&result);
    }
    scene_finish(&scene);
}

/* Along a path through a bubble, only its two segments in ice absorb, by exp(-a t). */
static void absorbed_outside_the_bubble(void **state)
{
    const struct bubble sphere = { { { 0, 0, 0 } }, 0.9F };
    const double t = 0.1, a = 5, reflected = pow((eta - 1) / (eta + 1), 2);
    struct scene scene = open_scene(&sphere, 1);
    scene.background.kind = SCENE_COLOR;
    scene.background.color = (vec3s){ { 1, 1, 1 } };
    struct picture_request request = request_of(&scene, 0, 4, 1);
    const struct settings settings = picture_settings("absorb.red=5");
    request.settings = &settings;
    request.refraction = "trace";
    request.width = request.height = 8;
    struct render_result result = picture_render(*state, &request);
    for (size_t i = 0; i < 64; i++) {
        const struct vec seen = picture_at(picture_layer(&result.image, ""), i);
        CHECK_NEAR(seen.x, pow(1 - reflected, 4) * exp(-2 * a * t) + reflected, 0.03);
        CHECK_NEAR(seen.y, 1, 0.01);
    }
    render_result_finish(&result);
    scene_finish(&scene);
}

/* Light through a sphere is followed as its closed forms have it. */
static void spheres_as_shapes(void **state)
{
    const struct bubble spheres[2] = { { { { -0.4F, 0.1F, 0 } }, 0.3F },
                                       { { { 0.3F, 0, -0.3F } }, 0.4F } };
    const struct settings settings = picture_settings("bubbles.shape=capsule");
    struct scene scene = open_scene(spheres, 2);
    struct picture_request request = request_of(&scene, 0, 4, 40);
    struct render_result closed = picture_render(*state, &request);
    request.settings = &settings;
    struct render_result followed = picture_render(*state, &request);
    size_t apart = 0;
    for (size_t i = 0; i < (size_t)SIZE * SIZE; i++) {
        const struct vec a = picture_at(picture_layer(&closed.image, "bubbles"), i);
        const struct vec b = picture_at(picture_layer(&followed.image, "bubbles"), i);
        apart += vec_difference(a, b) > 0.02;
    }
    assert_true(apart < 20); /* at outlines */
    render_result_finish(&closed);
    render_result_finish(&followed);
    scene_finish(&scene);
}

/* Rays that meet what is long, and no others, see it; in even light all of them see that light. */
static void long_ones(void **state)
{
    const vec3s axis = glms_vec3_normalize((vec3s){ { 2, 1, -1 } });
    const struct bubble both[2] = {
        { .center = { { 0, 0.3F, 0.1F } }, 0.08F, 0.5F, axis, .is_capsule = true },
        { .center = { { 0, -0.3F, 0 } }, 0.1F, 0.3F, axis },
    };
    const struct settings settings = picture_settings("bubbles.shape=grown");
    struct scene scene = open_scene(both, 2);
    scene.background.kind = SCENE_COLOR;
    scene.background.color = (vec3s){ { 0.25F, 0.5F, 0.75F } };
    struct picture_request request = request_of(&scene, 0, 4, 40);
    request.settings = &settings;
    struct render_result result = picture_render(*state, &request);
    const float *alpha = image_find(&result.image, "bubbles.A");
    size_t wrong = 0, seen = 0;
    for (size_t i = 0; i < (size_t)SIZE * SIZE; i++) {
        const struct vec e = picture_pixel_ray(&request, i);
        const vec3s dir = { { (float)e.x, (float)e.y, (float)e.z } };
        double at[2];
        const bool is_hit = bubble_intersect(&both[0], request.camera.eye, dir, at) ||
                            bubble_intersect(&both[1], request.camera.eye, dir, at);
        const struct vec bubble = picture_at(picture_layer(&result.image, "bubbles"), i);
        const struct vec even = vec_scale(vec_from(scene.background.color), (double)alpha[i]);
        CHECK_NEAR(vec_difference(bubble, even), 0, 1e-3);
        wrong += is_hit != (alpha[i] > 0.0F);
        seen += is_hit;
    }
    assert_in_range(seen, 1500, 8000);
    assert_true(wrong < 20);
    render_result_finish(&result);
    scene_finish(&scene);
}

/* What is over the ice hides the ice by alpha, and what stands before the ice hides that. */
static void over_the_ice(void **state)
{
    const struct bubble sphere = { { { 0, 0, 0 } }, 0.5F };
    const struct settings settings = picture_settings("bubbles.count=0");
    struct scene scene = open_scene(&sphere, 1);
    const struct picture_quad quad = { .top_left = { { -0.4F, 0.4F, 2 } },
                                       .right = { { 0.4F, 0, 0 } },
                                       .down = { { 0, -0.8F, 0 } },
                                       .color = { { 0.1F, 0.2F, 0.3F } },
                                       .material = MESH_UNLIT };
    picture_add_quad(&scene, &quad);
    struct picture_request request = request_of(&scene, 0, 4, 40);
    struct render_result with = picture_render(*state, &request);
    request.settings = &settings;
    struct render_result without = picture_render(*state, &request);
    const float *alpha = image_find(&with.image, "bubbles.A");
    size_t before = 0;
    size_t hidden = 0;
    for (size_t i = 0; i < (size_t)SIZE * SIZE; i++) {
        const struct vec was = picture_at(picture_layer(&without.image, ""), i);
        const struct vec bubble = picture_at(picture_layer(&with.image, "bubbles"), i);
        const struct vec is = picture_at(picture_layer(&with.image, ""), i);
        if (vec_difference(was, vec_from(quad.color)) < 1e-3) {
            CHECK_NEAR(vec_difference(is, was), 0, 0);
            before += alpha[i] > 0.5F;
        } else {
            CHECK_NEAR(vec_difference(is, vec_add(bubble, 1 - (double)alpha[i], was)), 0, 2e-3);
            hidden += alpha[i] > 0.5F;
        }
        assert_true(picture_at(picture_layer(&without.image, "bubbles"), i).x <= 0.0);
    }
    assert_true(before > 300 && hidden > 300);
    render_result_finish(&with);
    render_result_finish(&without);
    scene_finish(&scene);
}

/* Returns the mean difference of two images where the first differs from that without bubbles. */
static double bubble_difference(const struct render_result *result,
                                const struct render_result *without,
                                const struct render_result *other)
{
    const struct picture_layer with = picture_layer(&result->image, "");
    const struct picture_layer empty = picture_layer(&without->image, "");
    const struct picture_layer seen = picture_layer(&other->image, "");
    double sum = 0;
    size_t count = 0;
    for (size_t i = 0; i < (size_t)SIZE * SIZE; i++) {
        if (vec_difference(picture_at(with, i), picture_at(empty, i)) < 0.05)
            continue;
        sum += vec_difference(picture_at(seen, i), picture_at(with, i));
        count++;
    }
    print_message("%.3g on %zu pixels\n", sum / (double)count, count);
    assert_true(count > 500);
    return sum / (double)count;
}

static struct render_result at_level(struct gpu *gpu, const struct scene *scene, uint32_t level,
                                     bool is_nested)
{
    struct picture_request request = request_of(scene, 0, 4, 40);
    struct settings settings = picture_settings("bubbles.count=2");
    quality_apply(&settings, level, SETTING_QUALITY);
    if (is_nested)
        settings_set_value(&settings, settings_find("refract_bounce.nested"), 2);
    request.settings = &settings;
    request.refraction = "bounce";
    return picture_render(gpu, &request);
}

/* Bubbles off the axis are in the same places at all quality levels, and in nested objects. */
static void levels_agree(void **state)
{
    static const struct bubble spheres[2] = { { { { 0.5F, 0.1F, 0.3F } }, 0.2F },
                                              { { { -0.4F, -0.3F, 0.2F } }, 0.15F } };
    struct scene with = open_scene(spheres, 2), without = open_scene(spheres, 0);
    const uint32_t high = QUALITY_COUNT - 1;
    struct render_result empty = at_level(*state, &without, high, false);
    struct render_result top = at_level(*state, &with, high, false);
    for (uint32_t level = 0; level < high; level++) {
        struct render_result other = at_level(*state, &with, level, false);
        CHECK_NEAR(bubble_difference(&top, &empty, &other), 0, 0.01);
        render_result_finish(&other);
    }
    struct model *model = &with.model;
    model->objects = calloc(1, sizeof(*model->objects));
    model->materials = calloc(1, sizeof(*model->materials));
    assert_true(model->objects && model->materials);
    model->objects[0].index_count = model->object.index_count;
    model->objects[0].box = with.box;
    model->materials[0].flags = MATERIAL_FROM_SETTINGS;
    model->materials[0].transmission = 1;
    model->object_count = model->material_count = 1;
    with.is_convex = false;
    struct render_result nested = at_level(*state, &with, high, true);
    CHECK_NEAR(bubble_difference(&top, &empty, &nested), 0, 0.01);
    render_result_finish(&nested);
    render_result_finish(&empty);
    render_result_finish(&top);
    scene_finish(&with);
    scene_finish(&without);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(light_that_passes),
        cmocka_unit_test(total_reflection),
        cmocka_unit_test(the_nearer_bubble_hides_the_other),
        cmocka_unit_test(clipped_to_the_ice),
        cmocka_unit_test(close_up),
        cmocka_unit_test(extremes),
        cmocka_unit_test(levels_agree),
        cmocka_unit_test(in_even_light),
        cmocka_unit_test(absorbed_outside_the_bubble),
        cmocka_unit_test(spheres_as_shapes),
        cmocka_unit_test(long_ones),
        cmocka_unit_test(over_the_ice),
    };
    return RUN_ON_DEVICE(tests);
}
