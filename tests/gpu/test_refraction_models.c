/*
 * test_refraction_models.c: refraction models against closed forms, a traced mesh and each other.
 */
#include <cglm/struct.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/support/assertions.h"

#include "src/scene/generate/generate.h"
#include "tests/support/brute_force_trace.h"
#include "tests/support/lavapipe.h"
#include "tests/support/picture.h"

static const double eta = 1.0003 / 1.3091;

/* ---- pictures of one object ---- */

struct rung_picture {
    struct picture_request request;
    struct render_result result;
    struct picture_layer beauty, exit;
    const float *path, *bounces, *tir;
    size_t pixel_count;
};

static struct picture_request request_of(const struct scene *scene, const char *refraction,
                                         const struct settings *settings, uint32_t size)
{
    return (struct picture_request){
        .scene = scene,
        .settings = settings,
        .refraction = refraction,
        .camera = { .eye = { { 0.91F, 0.8F, 3.63F } }, .fov_deg = 35 },
        .width = size,
        .height = size,
        .layers = picture_layer_bit("exit") | picture_layer_bit("path") |
                  picture_layer_bit("bounces") | picture_layer_bit("tir"),
    };
}

static struct rung_picture take(struct picture_stage *stage, const struct picture_request *request)
{
    struct rung_picture p = {
        .request = *request,
        .result = picture_take(stage, request),
        .pixel_count = (size_t)request->width * request->height,
    };
    p.beauty = picture_layer(&p.result.image, "");
    p.exit = picture_layer(&p.result.image, "exit");
    p.path = image_find(&p.result.image, "path.Z");
    p.bounces = image_find(&p.result.image, "bounces.Z");
    p.tir = image_find(&p.result.image, "tir.Z");
    return p;
}

static struct rung_picture draw(struct gpu *gpu, const struct scene *scene, const char *refraction,
                                const struct settings *settings, uint32_t size)
{
    const struct picture_request request = request_of(scene, refraction, settings, size);
    struct picture_stage stage;
    picture_begin(&stage, gpu, &request);
    const struct rung_picture p = take(&stage, &request);
    picture_end(&stage);
    return p;
}

static void finish(struct rung_picture *p)
{
    render_result_finish(&p->result);
}

/* Whether pixel i shows the object; no number in it may be none. */
static bool is_object(const struct rung_picture *p, size_t i)
{
    const struct vec exit = picture_at(p->exit, i);
    const struct vec color = picture_at(p->beauty, i);
    const double sum = exit.x + exit.y + exit.z + color.x + color.y + color.z + (double)p->path[i] +
                       (double)p->bounces[i] + (double)p->tir[i];
    assert_true(isfinite(sum));
    return picture_is_object(p->exit, i);
}

/* ---- a sphere, in closed form ---- */

/* Two bends of theta_i - theta_t each, where the centre is passed at b radii. */
static double deviation_deg(double b)
{
    return 2 * (asin(b) - asin(eta * b)) * 57.295779513082321;
}

/* What each rung makes of light that passes at 0.6 radii, degrees; 19.163 is right. */
static const struct {
    const char *refraction;
    double deviation, tolerance;
    bool has_path; /* that of a sphere: 2 cos theta_t */
} at_six_tenths[] = {
    { "paper", 3.285, 0.05, false },     { "per-vertex", 9.582, 0.05, false },
    { "one-sided", 9.582, 0.05, false }, { "wyman", 19.163, 1.5, false },
    { "search", 19.163, 0.05, true },    { "bounce", 19.163, 0.05, true },
    { "trace", 19.163, 0.05, true },
};

static void check_at_six_tenths(struct gpu *gpu, const struct scene *scene, size_t k)
{
    struct rung_picture p = draw(gpu, scene, at_six_tenths[k].refraction, NULL, 192);
    const struct vec eye = vec_from(p.request.camera.eye);
    double deviation = 0;
    double path = 0;
    size_t count = 0;
    for (size_t i = 0; i < p.pixel_count; i++) {
        const struct vec e = picture_pixel_ray(&p.request, i);
        const double b = vec_norm(vec_cross(eye, e));
        if (!is_object(&p, i) || fabs(b - 0.6) > 0.01)
            continue;
        deviation += vec_angle_deg(picture_at(p.exit, i), e);
        path += (double)p.path[i];
        count++;
    }
    assert_true(count > 50);
    const double mean = deviation / (double)count;
    if (!(fabs(mean - at_six_tenths[k].deviation) <= at_six_tenths[k].tolerance))
        fail_msg("%s: %g degrees", at_six_tenths[k].refraction, mean);
    if (at_six_tenths[k].has_path)
        CHECK_NEAR(path / (double)count, 2 * sqrt(1 - 0.36 * eta * eta), 2e-3);
    finish(&p);
}

static void sphere_deviates_as_known(void **state)
{
    struct scene scene = picture_sphere_scene((vec3s){ { 0, 0, 0 } }, 40000);
    CHECK_NEAR(deviation_deg(0.6), 19.163, 1e-3);
    for (size_t k = 0; k < sizeof(at_six_tenths) / sizeof(at_six_tenths[0]); k++)
        check_at_six_tenths(*state, &scene, k);
    const struct technique *refraction;
    for (size_t r = 0; (refraction = techniques_refraction(r)); r++) {
        size_t k = 0;
        while (strcmp(at_six_tenths[k].refraction, refraction->refraction.name) != 0)
            assert_true(++k < sizeof(at_six_tenths) / sizeof(at_six_tenths[0]));
    }
    scene_finish(&scene);
}

/* ---- a pane ---- */

/* Of the given corners; four vertices a side, each with its side's normal. */
static void make_box(struct mesh *mesh, vec3s half)
{
    static const uint32_t corners[6] = { 0, 1, 3, 0, 3, 2 };
    assert_true(mesh_init(mesh, 24, 36));
    for (uint32_t i = 0; i < 24; i++) {
        const uint32_t axis = i / 8;
        const float side = i / 4 % 2 ? 1 : -1;
        struct mesh_vertex *v = &mesh->vertices[i];
        v->normal.raw[axis] = side;
        v->position.raw[axis] = side * half.raw[axis];
        v->position.raw[(axis + 1) % 3] = (i & 1u ? side : -side) * half.raw[(axis + 1) % 3];
        v->position.raw[(axis + 2) % 3] = (i & 2u ? 1.0F : -1.0F) * half.raw[(axis + 2) % 3];
    }
    for (uint32_t i = 0; i < 36; i++)
        mesh->indices[i] = i / 6 * 4 + corners[i % 6];
}

/* Where light goes in at the front and out at the back, it leaves as it came, t / cos theta_t
 * further. Wyman's mix of two lengths is near that. */
static void pane_moves_light_aside(void **state)
{
    static const struct {
        const char *name;
        double tolerance;
    } refraction_models[] = {
        { "wyman", 0.02 }, { "search", 2e-3 }, { "bounce", 2e-3 }, { "trace", 2e-4 }
    };
    struct scene scene = { .background.kind = SCENE_COLOR };
    make_box(&scene.model.object, (vec3s){ { 1.2F, 1.2F, 0.15F } });
    scene.box = mesh_box(&scene.model.object);
    for (size_t r = 0; r < sizeof(refraction_models) / sizeof(refraction_models[0]); r++) {
        struct rung_picture p = draw(*state, &scene, refraction_models[r].name, NULL, 256);
        size_t count = 0;
        for (size_t i = 0; i < p.pixel_count; i++) {
            const struct vec e = picture_pixel_ray(&p.request, i);
            const struct vec eye = vec_from(p.request.camera.eye);
            const struct vec entry = vec_add(eye, (0.15 - eye.z) / e.z, e);
            if (fabs(entry.x) > 0.8 || fabs(entry.y) > 0.8)
                continue;
            const double sine = eta * sqrt(1 - e.z * e.z);
            assert_true(is_object(&p, i));
            CHECK_NEAR(vec_angle_deg(picture_at(p.exit, i), e), 0, 0.05);
            CHECK_NEAR(p.path[i], 0.3 / sqrt(1 - sine * sine), refraction_models[r].tolerance);
            count++;
        }
        assert_true(count > 10000);
        finish(&p);
    }
    scene_finish(&scene);
}

/* ---- meshes, traced ---- */

/* |x|^6 + |y|^6 + |z|^6 = 0.8^6 */
static void make_rounded_cube(struct mesh *mesh)
{
    assert_true(generate_sphere(mesh, 5000));
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        struct mesh_vertex *v = &mesh->vertices[i];
        const struct vec d = vec_from(v->position);
        const double size = 0.8 / pow(pow(d.x, 6) + pow(d.y, 6) + pow(d.z, 6), 1 / 6.0);
        const struct vec n = vec_unit((struct vec){ pow(d.x, 5), pow(d.y, 5), pow(d.z, 5) });
        v->position = glms_vec3_scale(v->position, (float)size);
        v->normal = (vec3s){ { (float)n.x, (float)n.y, (float)n.z } };
    }
}

static void make_sphere(struct mesh *mesh)
{
    assert_true(generate_sphere(mesh, 4800));
}

static void make_ice_cube(struct mesh *mesh)
{
    assert_true(generate_ice_cube(mesh, 4800));
}

enum {
    SIDE = 512, /* pixels of a picture */
    STEP = 12,  /* pixels from one traced ray to the next */
};

static void trace_picture(const struct scene *scene, const struct picture_request *request,
                          struct trace_path *ways)
{
    for (size_t y = STEP / 2; y < SIDE; y += STEP) {
        for (size_t x = STEP / 2; x < SIDE; x += STEP) {
            const size_t i = y * SIDE + x;
            ways[i] = trace_transmitted(&scene->model.object, vec_from(request->camera.eye),
                                        picture_pixel_ray(request, i), eta, 4);
        }
    }
}

/* Mean errors of the exit's direction, degrees. */
struct errors {
    double straight, total; /* where light is not totally reflected inside, and where it is */
    double path;            /* mean error of the length where it is not, metres */
    double wrong_class;     /* share of the rays for which the layer tir is wrong */
    size_t count, total_count;
};

static struct errors compare(const struct rung_picture *p, const struct trace_path *ways)
{
    struct errors e = { 0 };
    size_t wrong = 0;
    for (size_t i = 0; i < p->pixel_count; i++) {
        const bool object = is_object(p, i);
        if (!ways[i].hit || !object)
            continue;
        const double error = vec_angle_deg(picture_at(p->exit, i), ways[i].dir);
        const bool total = ways[i].bounces > 0;
        wrong += (p->tir[i] > 0.5F) != total;
        if (!total) {
            e.straight += error;
            e.path += fabs((double)p->path[i] - ways[i].path);
            e.count++;
        } else if (ways[i].left) {
            e.total += error;
            e.total_count++;
        }
    }
    assert_true(e.count > 0);
    e.straight /= (double)e.count;
    e.path /= (double)e.count;
    e.total /= e.total_count ? (double)e.total_count : 1;
    e.wrong_class = (double)wrong / (double)(e.count + e.total_count);
    return e;
}

/* What is allowed of a rung on a shape. */
struct mark {
    const char *refraction;
    double straight, total, path, wrong_class; /* 0 of the latter three: not looked at */
};

static void check_shape(struct gpu *gpu, void (*make)(struct mesh *mesh), const struct mark *marks)
{
    struct scene scene = { .background.kind = SCENE_COLOR };
    make(&scene.model.object);
    scene.box = mesh_box(&scene.model.object);
    struct trace_path *ways = calloc((size_t)SIDE * SIDE, sizeof(*ways));
    assert_non_null(ways);
    for (const struct mark *mark = marks; mark->refraction; mark++) {
        struct rung_picture p = draw(gpu, &scene, mark->refraction, NULL, SIDE);
        if (mark == marks)
            trace_picture(&scene, &p.request, ways);
        const struct errors e = compare(&p, ways);
        print_message("%-10s %6.3f degrees; totally reflected %6.2f; path %.4f; class wrong %.3f\n",
                      mark->refraction, e.straight, e.total, e.path, e.wrong_class);
        assert_true(e.count > 200);
        assert_true(e.straight <= mark->straight);
        assert_true(mark->total <= 0 || (e.total_count > 100 && e.total <= mark->total));
        assert_true(mark->path <= 0 || e.path <= mark->path);
        assert_true(mark->wrong_class <= 0 || e.wrong_class <= mark->wrong_class);
        finish(&p);
    }
    free(ways);
    scene_finish(&scene);
}

static void sphere_agrees_with_its_trace(void **state)
{
    static const struct mark marks[] = {
        { "one-sided", .straight = 14.5 },
        { "wyman", .straight = 8.5 },
        { "search", .straight = 0.2, .path = 5e-3, .wrong_class = 0.01 },
        { "bounce", .straight = 0.24, .path = 1e-2, .wrong_class = 0.01 },
        { "trace", .straight = 0.01, .path = 1e-4, .wrong_class = 1e-3 },
        { 0 },
    };
    check_shape(*state, make_sphere, marks);
}

static void rounded_cube_agrees_with_its_trace(void **state)
{
    static const struct mark marks[] = {
        { "wyman", .straight = 3 },
        { "search", .straight = 0.1, .path = 5e-3, .wrong_class = 0.01 },
        { "bounce", .straight = 0.1, .total = 2, .path = 5e-3, .wrong_class = 0.01 },
        { "trace", .straight = 0.01, .total = 0.05, .path = 1e-4, .wrong_class = 1e-3 },
        { 0 },
    };
    check_shape(*state, make_rounded_cube, marks);
}

static void ice_cube_agrees_with_its_trace(void **state)
{
    static const struct mark marks[] = {
        { "wyman", .straight = 5 },
        { "search", .straight = 0.15, .path = 5e-3, .wrong_class = 0.01 },
        { "bounce", .straight = 0.15, .total = 5, .path = 5e-3, .wrong_class = 0.01 },
        { 0 },
    };
    check_shape(*state, make_ice_cube, marks);
}

/* ---- what all rungs share ---- */

static struct settings set_all(const char *const *assignments)
{
    struct settings settings = picture_settings("light.count=0");
    for (; *assignments; assignments++)
        assert_int_equal(settings_assign(&settings, *assignments, SETTING_USER, NULL), STATUS_OK);
    return settings;
}

/* Where light of one radiance comes from everywhere, the object shows the same. What chooses paths
 * at random does so on average. */
static void white_furnace_is_white(void **state)
{
    static const char *const exact[] = { "refract.fresnel=exact", "refract.dispersion=1", NULL };
    const struct settings settings = set_all(exact);
    struct scene scene = { .background.kind = SCENE_COLOR, .background.color = { { 1, 1, 1 } } };
    make_ice_cube(&scene.model.object);
    scene.box = mesh_box(&scene.model.object);
    const struct technique *refraction;
    for (size_t r = 0; (refraction = techniques_refraction(r)); r++) {
        struct rung_picture p = draw(*state, &scene, refraction->refraction.name, &settings, 128);
        const bool is_random = refraction->refraction.traces_bvh;
        double sum = 0;
        for (size_t i = 0; i < p.pixel_count; i++) {
            const struct vec color = picture_at(p.beauty, i);
            CHECK_NEAR(vec_difference(color, (struct vec){ 1, 1, 1 }), 0, is_random ? 0.1 : 1e-3);
            sum += (color.x + color.y + color.z) / 3;
        }
        CHECK_NEAR(sum / (double)p.pixel_count, 1, 1e-3);
        finish(&p);
    }
    scene_finish(&scene);
}

/* In white light, the share of refraction times what the way has left of it. Rungs that follow
 * several ways have no share of the settings. */
static void light_is_absorbed_along_the_way(void **state)
{
    static const char *const blue[] = {
        "absorb.red=2",        "absorb.green=0.5",       "refract.fresnel=crossfade",
        "refract.crossfade=1", "refract_bounce.exits=1", NULL
    };
    const struct settings settings = set_all(blue);
    struct scene scene = picture_sphere_scene((vec3s){ { 0, 0, 0 } }, 4800);
    scene.background.kind = SCENE_COLOR;
    scene.background.color = (vec3s){ { 1, 1, 1 } };
    const struct technique *refraction;
    for (size_t r = 0; (refraction = techniques_refraction(r)); r++) {
        if (refraction->refraction.traces_bvh)
            continue;
        struct rung_picture p = draw(*state, &scene, refraction->refraction.name, &settings, 64);
        for (size_t i = 0; i < p.pixel_count; i++) {
            const double path = (double)p.path[i];
            const struct vec left = { exp(-2 * path), exp(-0.5 * path), 1 };
            if (is_object(&p, i))
                CHECK_NEAR(vec_difference(picture_at(p.beauty, i), left), 0, 1e-3);
        }
        finish(&p);
    }
    scene_finish(&scene);
}

static double unpolarised(double ci)
{
    const double n = 1 / eta;
    const double ct = sqrt(1 - eta * eta * (1 - ci * ci));
    const double rs = (ci - n * ct) / (ci + n * ct);
    const double rp = (n * ci - ct) / (n * ci + ct);
    return (rs * rs + rp * rp) / 2;
}

static void check_share(struct gpu *gpu, const struct scene *scene, const char *refraction,
                        size_t kind)
{
    static const char *const kinds[][3] = {
        { "refract.fresnel=paper", NULL },
        { "refract.fresnel=exact", NULL },
        { "refract.fresnel=crossfade", "refract.crossfade=0.3", NULL },
    };
    const struct settings settings = set_all(kinds[kind]);
    struct picture_request request = {
        .scene = scene,
        .settings = &settings,
        .refraction = refraction,
        .camera = { .eye = { { 0, 0, 4 } }, .fov_deg = 35 },
        .width = 64,
        .height = 64,
        .layers = picture_layer_bit("fresnel") | picture_layer_bit("N"),
    };
    struct render_result result = picture_render(gpu, &request);
    const struct picture_layer normal = picture_layer(&result.image, "N");
    const float *share = image_find(&result.image, "fresnel.Z");
    size_t count = 0;
    for (size_t i = 0; i < (size_t)64 * 64; i++) {
        const double ci = -vec_dot(picture_at(normal, i), picture_pixel_ray(&request, i));
        const double expected[] = { pow(1 - ci, 3), unpolarised(ci), 0.7 };
        if (!(ci > 0.1))
            continue;
        CHECK_NEAR(share[i], expected[kind], 3e-3);
        count++;
    }
    assert_true(count > 1000);
    render_result_finish(&result);
}

/* Eq. 4, Fresnel's equations, one share for all; with and without a vertex shader of its own. */
static void share_of_the_reflection_is_as_set(void **state)
{
    struct scene scene = picture_sphere_scene((vec3s){ { 0, 0, 0 } }, 40000);
    for (size_t kind = 0; kind < 3; kind++) {
        check_share(*state, &scene, "paper", kind);
        check_share(*state, &scene, "per-vertex", kind);
    }
    scene_finish(&scene);
}

static void check_colours(struct gpu *gpu, const struct scene *scene, const char *refraction)
{
    static const char *const dispersed[] = { "refract.dispersion=4", NULL };
    /* (1.3091 - 1) 0.025 4 apart */
    static const char *const alone[3][2] = { { "refract.ior=1.27819" },
                                             { "refract.ior=1.3091" },
                                             { "refract.ior=1.34001" } };
    const struct settings settings = set_all(dispersed);
    const struct settings first = set_all(alone[0]);
    struct picture_request request = request_of(scene, refraction, &first, 96);
    struct rung_picture all = draw(gpu, scene, refraction, &settings, 96);
    struct picture_stage stage;
    picture_begin(&stage, gpu, &request);
    for (int channel = 0; channel < 3; channel++) {
        const struct settings one = set_all(alone[channel]);
        request.settings = &one;
        struct rung_picture p = take(&stage, &request);
        size_t differ = 0;
        for (size_t i = 0; i < p.pixel_count; i++) {
            const float a = all.beauty.planes[channel][i];
            const float b = p.beauty.planes[channel][i];
            differ += !(fabsf(a - b) <= 2e-3F);
            if (channel == 1 && is_object(&p, i))
                differ += !(vec_angle_deg(picture_at(p.exit, i), picture_at(all.exit, i)) < 0.1);
        }
        assert_true(differ <= p.pixel_count / 500); /* at a limit of total reflection */
        finish(&p);
    }
    picture_end(&stage);
    finish(&all);
}

/* Each colour of a dispersed picture is that of one drawn with its index alone; its layers are
 * those of green. */
static void colours_bend_by_their_own_index(void **state)
{
    static const char *const refraction_models[] = { "per-vertex", "one-sided", "bounce" };
    struct scene scene = picture_sphere_scene((vec3s){ { 0, 0, 0 } }, 4800);
    picture_use_directions(&scene, 256);
    for (size_t r = 0; r < 3; r++)
        check_colours(*state, &scene, refraction_models[r]);
    scene_finish(&scene);
}

/* ---- near surroundings ---- */

static struct vec refracted(struct vec e, struct vec n, double ratio)
{
    const double c = vec_dot(n, e);
    const double k = 1 - ratio * ratio * (1 - c * c);
    return vec_add(vec_scale(e, ratio), -(ratio * c + sqrt(k)), n);
}

/* How far along a ray from inside the ball it ends. */
static double way_to(struct vec from, struct vec dir, struct vec center, double radius)
{
    const struct vec m = vec_add(from, -1, center);
    const double middle = -vec_dot(m, dir);
    return middle + sqrt(middle * middle - vec_dot(m, m) + radius * radius);
}

/* The colour of the ball where light that passes the unit sphere meets it; the ball's colours are
 * the directions from its own centre. */
static struct vec ball_behind_sphere(struct vec eye, struct vec e, struct vec center, double radius)
{
    const double middle = -vec_dot(eye, e);
    const struct vec entry =
        vec_add(eye, middle - sqrt(middle * middle - vec_dot(eye, eye) + 1), e);
    const struct vec inside = refracted(e, entry, eta);
    const struct vec exit = vec_add(entry, -2 * vec_dot(entry, inside), inside);
    const struct vec dir = refracted(inside, vec_scale(exit, -1), 1 / eta);
    const struct vec end = vec_add(exit, way_to(exit, dir, center, radius), dir);
    return picture_direction_color(vec_scale(vec_add(end, -1, center), 1 / radius));
}

/* Mean difference of what is seen through the sphere from what closed form says. */
static double ball_error(struct gpu *gpu, const char *refraction, const char *lookup)
{
    const vec3s center = { { 0.8F, -0.5F, 0.6F } };
    const char *const assignments[] = { lookup, "refract.fresnel=crossfade", "refract.crossfade=1",
                                        "refract_bounce.exits=1", NULL };
    const struct settings settings = set_all(assignments);
    struct scene scene = picture_sphere_scene((vec3s){ { 0, 0, 0 } }, 40000);
    picture_add_directions(&scene, center, 5);
    struct rung_picture p = draw(gpu, &scene, refraction, &settings, 96);
    const struct vec eye = vec_from(p.request.camera.eye);
    double sum = 0;
    size_t count = 0;
    for (size_t i = 0; i < p.pixel_count; i++) {
        const struct vec e = picture_pixel_ray(&p.request, i);
        if (!is_object(&p, i) || vec_norm(vec_cross(eye, e)) > 0.95)
            continue;
        sum += vec_difference(picture_at(p.beauty, i),
                              ball_behind_sphere(eye, e, vec_from(center), 5));
        count++;
    }
    assert_true(count > 1000);
    finish(&p);
    scene_finish(&scene);
    return sum / (double)count;
}

static void near_surroundings_are_seen_where_they_are(void **state)
{
    static const char *const refraction_models[] = { "search", "bounce" };
    assert_true(ball_error(*state, "search", "refract.lookup=infinite") > 0.05);
    for (size_t r = 0; r < 2; r++) {
        const double error = ball_error(*state, refraction_models[r], "refract.lookup=distance");
        if (!(error < 6e-4))
            fail_msg("%s: %g", refraction_models[r], error);
    }
}

/* With an argument one part of the tests, "beside" closed forms and traces or what all "share". */
int main(int argc, char **argv)
{
    const struct CMUnitTest beside[] = {
        cmocka_unit_test(sphere_deviates_as_known),
        cmocka_unit_test(pane_moves_light_aside),
        cmocka_unit_test(sphere_agrees_with_its_trace),
        cmocka_unit_test(rounded_cube_agrees_with_its_trace),
        cmocka_unit_test(ice_cube_agrees_with_its_trace),
        cmocka_unit_test(near_surroundings_are_seen_where_they_are),
    };
    const struct CMUnitTest share[] = {
        cmocka_unit_test(white_furnace_is_white),
        cmocka_unit_test(light_is_absorbed_along_the_way),
        cmocka_unit_test(share_of_the_reflection_is_as_set),
        cmocka_unit_test(colours_bend_by_their_own_index),
    };
    int failed = 0;
    if (argc < 2 || strcmp(argv[1], "beside") == 0)
        failed += RUN_ON_DEVICE(beside);
    if (argc < 2 || strcmp(argv[1], "share") == 0)
        failed += RUN_ON_DEVICE(share);
    return failed;
}
