/*
 * test_box_projection.c: refract.lookup=box shows a box at its true position with every refraction
 * model. The sides of the box have positions as colours, and these are linear: what a pixel shows
 * says where its ray ended.
 */
#include "tests/support/assertions.h"

#include "tests/support/lavapipe.h"
#include "tests/support/picture.h"

#include <cglm/struct.h>
#include <stdlib.h>
#include <string.h>

static const struct box sides = { { { -3, -1.75F, -4 } }, { { 5, 4, 6 } } };
static const double eta = 1.0003 / 1.3091;

enum {
    SIZE = 96
};

/* ---- what is drawn ---- */

/* A unit sphere, not in the middle of the box. */
static struct scene box_scene(void)
{
    struct scene scene = picture_sphere_scene((vec3s){ { 0, 0, 0 } }, 40000);
    const vec3s extent = glms_vec3_sub(sides.max, sides.min);
    for (int i = 0; i < 6; i++) {
        const int axis = i / 2;
        struct picture_quad quad = { .top_left = sides.min, .material = MESH_UNLIT };
        quad.top_left.raw[axis] = i % 2 ? sides.max.raw[axis] : sides.min.raw[axis];
        quad.right.raw[(axis + 1) % 3] = extent.raw[(axis + 1) % 3];
        quad.down.raw[(axis + 2) % 3] = extent.raw[(axis + 2) % 3];
        picture_add_quad(&scene, &quad);
    }
    for (uint32_t i = 0; i < scene.model.surroundings.vertex_count; i++) {
        struct mesh_vertex *v = &scene.model.surroundings.vertices[i];
        v->color = glms_vec3_div(glms_vec3_sub(v->position, sides.min), extent);
    }
    scene.model.box = mesh_box(&scene.model.surroundings);
    return scene;
}

struct shown {
    struct picture_request request;
    struct render_result result;
    struct picture_layer exit, refraction, reflection;
    const float *path, *fresnel;
};

/* `assignments` ends at NULL. */
static struct settings set_all(const char *const *assignments)
{
    struct settings settings = picture_settings("light.count=0");
    for (; *assignments; assignments++)
        assert_int_equal(settings_assign(&settings, *assignments, SETTING_USER, NULL), STATUS_OK);
    return settings;
}

static struct picture_request request_of(const struct scene *scene, const char *refraction,
                                         const struct settings *settings)
{
    return (struct picture_request){
        .scene = scene,
        .settings = settings,
        .refraction = refraction,
        .camera = { .eye = { { 0.91F, 0.8F, 3.63F } }, .fov_deg = 35 },
        .width = SIZE,
        .height = SIZE,
        .layers = picture_layer_bit("exit") | picture_layer_bit("path") |
                  picture_layer_bit("refraction") | picture_layer_bit("reflection") |
                  picture_layer_bit("fresnel"),
    };
}

static struct shown take(struct picture_stage *stage, const struct picture_request *request)
{
    struct shown s = { .request = *request, .result = picture_take(stage, request) };
    s.exit = picture_layer(&s.result.image, "exit");
    s.refraction = picture_layer(&s.result.image, "refraction");
    s.reflection = picture_layer(&s.result.image, "reflection");
    s.path = image_find(&s.result.image, "path.Z");
    s.fresnel = image_find(&s.result.image, "fresnel.Z");
    return s;
}

static struct shown draw(struct gpu *gpu, const struct scene *scene, const char *refraction,
                         const char *const *assignments)
{
    const struct settings settings = set_all(assignments);
    const struct picture_request request = request_of(scene, refraction, &settings);
    struct picture_stage stage;
    picture_begin(&stage, gpu, &request);
    const struct shown s = take(&stage, &request);
    picture_end(&stage);
    return s;
}

/* ---- what must be seen ---- */

static struct vec to_box(struct vec from, struct vec dir)
{
    const double origin[3] = { from.x, from.y, from.z };
    const double way[3] = { dir.x, dir.y, dir.z };
    double t = HUGE_VAL;
    for (size_t axis = 0; axis < 3; axis++) {
        const float side = way[axis] > 0 ? sides.max.raw[axis] : sides.min.raw[axis];
        if (way[axis] < 0 || way[axis] > 0)
            t = fmin(t, ((double)side - origin[axis]) / way[axis]);
    }
    return vec_add(from, t, dir);
}

/* What a colour is the position of; the cube was captured at the origin. */
static struct vec position(struct vec color)
{
    const struct vec low = vec_from(sides.min);
    const struct vec high = vec_from(sides.max);
    return (struct vec){ low.x + color.x * (high.x - low.x), low.y + color.y * (high.y - low.y),
                         low.z + color.z * (high.z - low.z) };
}

struct errors {
    double all[2][SIZE * SIZE];
    double mean[2], worst[2]; /* degrees; of refraction and reflection; without the last tenth */
    size_t count;
};

static void add_error(struct errors *errors, size_t which, struct vec color, struct vec from,
                      struct vec dir)
{
    const double error = vec_angle_deg(position(color), to_box(from, dir));
    assert_true(isfinite(error));
    errors->all[which][errors->count] = error;
}

static int compare(const void *a, const void *b)
{
    return (*(const double *)a > *(const double *)b) - (*(const double *)a < *(const double *)b);
}

static void add_errors(struct errors *errors, const struct shown *s, size_t i)
{
    const struct vec eye = vec_from(s->request.camera.eye);
    const struct vec e = picture_pixel_ray(&s->request, i);
    const double middle = -vec_dot(eye, e);
    if (!picture_is_object(s->exit, i) || vec_norm(vec_cross(eye, e)) > 0.9)
        return;
    const struct vec entry =
        vec_add(eye, middle - sqrt(middle * middle - vec_dot(eye, eye) + 1), e);
    const double c = vec_dot(entry, e);
    const struct vec inside =
        vec_add(vec_scale(e, eta), -(eta * c + sqrt(1 - eta * eta * (1 - c * c))), entry);
    const struct vec exit = vec_add(entry, (double)s->path[i], inside);
    /* Russian roulette of `trace` raises the throughput of what it follows to 1. */
    const bool is_raised = !strcmp(s->request.refraction, "trace");
    const double passing = is_raised ? 1 - (double)s->fresnel[i] : 1;
    add_error(errors, 0, vec_scale(picture_at(s->refraction, i), passing), exit,
              picture_at(s->exit, i));
    add_error(errors, 1, picture_at(s->reflection, i), entry, vec_add(e, -2 * c, entry));
    errors->count++;
}

static struct errors measure(struct gpu *gpu, const struct scene *scene, const char *refraction,
                             const char *lookup)
{
    static struct errors errors;
    errors = (struct errors){ 0 };
    /* Light that leaves in one direction alone can be told from its colour. Russian roulette of
     * `trace` follows a reflection in less than a tenth of the pixels; the expected radiance of the
     * others bends the colour by a degree. */
    const char *const one_way[] = { lookup, "refract_bounce.exits=1", "trace.min_branch=1", NULL };
    struct shown s = draw(gpu, scene, refraction, one_way);
    for (size_t i = 0; i < (size_t)SIZE * SIZE; i++)
        add_errors(&errors, &s, i);
    assert_true(errors.count > 1000);
    const size_t kept = errors.count - errors.count / 10;
    for (size_t which = 0; which < 2; which++) {
        qsort(errors.all[which], errors.count, sizeof(double), compare);
        for (size_t i = 0; i < kept; i++)
            errors.mean[which] += errors.all[which][i] / (double)kept;
        errors.worst[which] = errors.all[which][kept - 1];
    }
    render_result_finish(&s.result);
    return errors;
}

/* From where light leaves, in the direction in which it does. What is left is the cube's texels
 * (0.18 degrees wide) and halves. */
static void every_rung_sees_the_box(void **state)
{
    struct scene scene = box_scene();
    print_message("degrees, mean and greatest:      refracted        reflected\n");
    const struct technique *refraction;
    for (size_t r = 0; (refraction = techniques_refraction(r)); r++) {
        const struct errors box =
            measure(*state, &scene, refraction->refraction.name, "refract.lookup=box");
        const struct errors far =
            measure(*state, &scene, refraction->refraction.name, "refract.lookup=infinite");
        print_message("%-12s box %7.4f %7.4f  %7.4f %7.4f  infinite %5.2f %5.2f  %5.2f %5.2f\n",
                      refraction->refraction.name, box.mean[0], box.worst[0], box.mean[1],
                      box.worst[1], far.mean[0], far.worst[0], far.mean[1], far.worst[1]);
        const bool is_bent = !strcmp(refraction->refraction.name, "trace");
        for (size_t which = 0; which < 2; which++) {
            /* a mirror doubles errors */
            const double most = which ? 0.1 : is_bent ? 1 : 0.05;
            assert_true(box.mean[which] < most);
            assert_true(box.worst[which] < fmax(0.5, 2 * most));
            assert_true(far.mean[which] > 2);
        }
    }
    scene_finish(&scene);
}

/* ---- boxes of the settings ---- */

static void check_same(const struct shown *a, const struct shown *b, bool same)
{
    const struct image *image = &a->result.image;
    size_t differ = 0;
    for (size_t p = 0; p < image->plane_count; p++) {
        const struct image_plane *plane = &image->planes[p];
        const float *other = image_find(&b->result.image, plane->name);
        for (size_t i = 0; i < (size_t)SIZE * SIZE; i++) {
            assert_true(isfinite(plane->texels[i]));
            differ += !(fabsf(plane->texels[i] - other[i]) <= 0);
        }
    }
    assert_true(same == (differ == 0));
}

/* A box of the settings takes the place of that of the surroundings; where it is none, or the ice
 * lies outside of it, all is as if infinitely far away. */
static void boxes_of_the_settings(void **state)
{
    static const char *const infinite[] = { "refract.lookup=infinite", NULL };
    static const char *const automatic[] = { "refract.lookup=box", NULL };
    static const char *const boxes[][8] = {
        { "refract.lookup=box", "env_box.min_x=-3", "env_box.max_x=5", "env_box.min_y=-1.75",
          "env_box.max_y=4", "env_box.min_z=-4", "env_box.max_z=6" }, /* the same */
        { "refract.lookup=box", "env_box.min_x=-3", "env_box.max_x=7", "env_box.min_y=-1.75",
          "env_box.max_y=4", "env_box.min_z=-4", "env_box.max_z=6" }, /* another */
        { "refract.lookup=box", "env_box.min_x=3", "env_box.max_x=-3", "env_box.min_y=-3",
          "env_box.max_y=3", "env_box.min_z=-3", "env_box.max_z=3" }, /* inside out */
        { "refract.lookup=box", "env_box.min_x=3", "env_box.max_x=5", "env_box.min_y=-3",
          "env_box.max_y=3", "env_box.min_z=-3", "env_box.max_z=3" }, /* beside the ice */
        { "refract.lookup=box", "env_box.min_x=1" },
    };
    static const int as_automatic = 0, as_infinite = 2;
    struct scene scene = box_scene();
    struct shown far = draw(*state, &scene, "search", infinite);
    const struct settings settings = set_all(automatic);
    struct picture_request request = request_of(&scene, "search", &settings);
    struct picture_stage stage;
    picture_begin(&stage, *state, &request);
    struct shown near = take(&stage, &request);
    check_same(&far, &near, false);
    for (int i = 0; i < (int)(sizeof(boxes) / sizeof(boxes[0])); i++) {
        const struct settings other = set_all(boxes[i]);
        request.settings = &other;
        struct shown s = take(&stage, &request);
        check_same(&s, &near, i == as_automatic);
        check_same(&s, &far, i >= as_infinite);
        render_result_finish(&s.result);
    }
    picture_end(&stage);
    scene.model.box = (struct box){ 0 }; /* nothing around it */
    struct shown none = draw(*state, &scene, "search", automatic);
    check_same(&none, &far, true);
    render_result_finish(&none.result);
    render_result_finish(&near.result);
    render_result_finish(&far.result);
    scene_finish(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_rung_sees_the_box),
        cmocka_unit_test(boxes_of_the_settings),
    };
    return RUN_ON_DEVICE(tests);
}
