/*
 * test_objects.c: several refractive objects in one image: each has the pixels that it has alone,
 * the nearest one occludes the others in any file order, and layers show the visible one.
 */
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "src/scene/generate/generate.h"
#include "src/tech/refract/refract.h"
#include "src/tech/techniques.h"
#include "tests/support/assertions.h"
#include "tests/support/lavapipe.h"
#include "tests/support/picture.h"
#include "tests/support/vec.h"

enum {
    WIDTH = 80,
    HEIGHT = 48,
    TRIANGLES = 960,
    HAIRS = 4,
};

struct ball {
    vec3s center;
    float radius, ior;
};

static const struct ball left = { { { -1.4F, 0, 0 } }, 0.9F, 1.3F };
static const struct ball right = { { { 1.4F, 0.1F, 0 } }, 0.7F, 2 };
static const struct ball low = { { { 1.2F, -1.5F, 0.3F } }, 0.35F, 1.5F };
static const struct ball behind = { { { -0.6F, 0.3F, -3 } }, 1.2F, 1.6F };

static void add_ball(struct scene *scene, const struct ball *ball)
{
    struct model *model = &scene->model;
    struct mesh mesh;
    assert_true(generate_sphere(&mesh, TRIANGLES));
    for (uint32_t i = 0; i < mesh.vertex_count; i++) {
        vec3s *p = &mesh.vertices[i].position;
        *p = glms_vec3_muladds(*p, ball->radius, ball->center);
    }
    const uint32_t i = model->object_count++;
    model->objects[i] = (struct object){
        .first_index = model->object.index_count,
        .index_count = mesh.index_count,
        .material = i,
    };
    model->materials[i] = material_make("glass");
    model->materials[i].transmission = 1;
    model->materials[i].roughness = 0;
    model->materials[i].thickness = 1;
    model->materials[i].ior = ball->ior;
    model->material_count = i + 1;
    assert_true(mesh_append(&model->object, &mesh));
    mesh_finish(&mesh);
}

static struct scene scene_with_room(uint32_t count)
{
    const struct settings settings = settings_default();
    const struct refract_params *refract = settings_of(&settings, &refract_settings);
    struct scene scene = { .model_ior = refract->ior };
    scene.model.objects = calloc(count, sizeof(struct object));
    scene.model.materials = calloc(count, sizeof(struct material));
    assert_true(scene.model.objects && scene.model.materials);
    return scene;
}

static void complete(struct scene *scene)
{
    const struct model *model = &scene->model;
    assert_int_equal(
        object_assign_ranks(model->objects, model->object_count, &model->object, model->materials),
        STATUS_OK);
    scene->box = mesh_box(&model->object);
    picture_use_directions(scene, 256);
}

static struct scene scene_of(const struct ball *const *balls, uint32_t count)
{
    struct scene scene = scene_with_room(count);
    for (uint32_t i = 0; i < count; i++)
        add_ball(&scene, balls[i]);
    complete(&scene);
    return scene;
}

/* Gives the last object a cavity. */
static void add_cavity(struct scene *scene, const struct ball *ball)
{
    struct model *model = &scene->model;
    const uint32_t first_vertex = model->object.vertex_count;
    const uint32_t first = model->object.index_count;
    add_ball(scene, ball);
    model->object_count--;
    model->material_count--;
    model->objects[model->object_count - 1].index_count += model->object.index_count - first;
    for (uint32_t i = first; i < model->object.index_count; i += 3) {
        const uint32_t last = model->object.indices[i];
        model->object.indices[i] = model->object.indices[i + 2];
        model->object.indices[i + 2] = last;
    }
    for (uint32_t i = first_vertex; i < model->object.vertex_count; i++) {
        vec3s *normal = &model->object.vertices[i].normal;
        *normal = glms_vec3_negate(*normal);
    }
}

/* Without layers there is nothing in the balls either, so that they may share passes. */
static struct render_result draw(struct gpu *gpu, const char *refraction, uint64_t layers,
                                 const struct ball *const *balls, uint32_t count)
{
    static const char *const inside[] = { "air.count=0", "bubbles.count=0", "cracks.count=0" };
    struct scene scene = scene_of(balls, count);
    struct settings settings = picture_settings("light.count=0");
    for (size_t i = 0; i < 3 && !layers; i++)
        assert_int_equal(settings_assign(&settings, inside[i], SETTING_USER, NULL), STATUS_OK);
    struct render_result result = picture_render(gpu, &(struct picture_request){
                                                          .scene = &scene,
                                                          .settings = &settings,
                                                          .refraction = refraction,
                                                          .camera = {
                                                              .eye = { { 0, 0, 6 } },
                                                              .fov_deg = 40,
                                                          },
                                                          .width = WIDTH,
                                                          .height = HEIGHT,
                                                          .layers = layers,
                                                      });
    scene_finish(&scene);
    return result;
}

#define DRAW(gpu, refraction, layers, ...) \
    draw(gpu, refraction, layers, (const struct ball *const[]){ __VA_ARGS__ }, \
         sizeof((const struct ball *const[]){ __VA_ARGS__ }) / sizeof(struct ball *))

/* Each half is that of a picture of one ball, in all layers that the rung has; but balls of the
 * right half are one further in the list. A few rays leave a face by a hair, which is one of their
 * exits then. */
static void check_halves(const struct image *both, const struct image *one,
                         const struct image *other)
{
    size_t by_a_hair = 0;
    for (uint32_t p = 0; p < both->plane_count; p++) {
        const char *name = both->planes[p].name;
        const float *texels = image_find(both, name);
        const float *halves[2] = { image_find(one, name), image_find(other, name) };
        for (size_t i = 0; i < (size_t)WIDTH * HEIGHT; i++) {
            const bool of_other = i % WIDTH >= WIDTH / 2;
            float wanted = halves[of_other][i];
            if (of_other && wanted >= 1 && !strcmp(name, "object.Z"))
                wanted++;
            const float off = fabsf(texels[i] - wanted) / (1 + fabsf(wanted));
            by_a_hair += off > 4e-3F && off <= 1e-2F;
            if (!(off <= 1e-2F) || by_a_hair > HAIRS)
                fail_msg("%s at %zu, %zu: %g, alone %g", name, i % WIDTH, i / WIDTH,
                         (double)texels[i], (double)wanted);
        }
    }
}

static vec3s normal_at(const struct image *image, size_t pixel)
{
    return (vec3s){ { image_find(image, "back.N.X")[pixel], image_find(image, "back.N.Y")[pixel],
                      image_find(image, "back.N.Z")[pixel] } };
}

static void each_looks_as_it_does_alone(void **state)
{
    static const struct {
        const char *refraction;
        uint64_t layers;
    } cases[] = {
        { "paper", PICTURE_ALL_LAYERS },
        { "wyman", PICTURE_ALL_LAYERS },
        { "bounce", PICTURE_ALL_LAYERS },
        { "bounce", 0 },
    };

    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        const char *refraction = cases[i].refraction;
        const uint64_t layers = cases[i].layers;
        struct render_result both = DRAW(*state, refraction, layers, &left, &right, &low);
        struct render_result one = DRAW(*state, refraction, layers, &left);
        struct render_result other = DRAW(*state, refraction, layers, &right, &low);
        check_halves(&both.image, &one.image, &other.image);
        render_result_finish(&both);
        render_result_finish(&one);
        render_result_finish(&other);
    }
}

static void the_nearest_is_seen(void **state)
{
    const uint64_t layers = picture_layer_bit("exit") | picture_layer_bit("thickness");
    struct render_result a = DRAW(*state, "bounce", layers, &left, &behind, &right);
    struct render_result b = DRAW(*state, "bounce", layers, &right, &behind, &left);
    struct render_result alone = DRAW(*state, "bounce", layers, &left);
    const float *thickness = image_find(&alone.image, "thickness.Z");
    for (uint32_t p = 0; p < a.image.plane_count; p++) {
        const char *name = a.image.planes[p].name;
        const float *first = image_find(&a.image, name);
        const float *second = image_find(&b.image, name);
        const float *left_alone = image_find(&alone.image, name);
        size_t seen = 0;
        assert_memory_equal(first, second, sizeof(float) * WIDTH * HEIGHT);
        for (size_t i = 0; i < (size_t)WIDTH * HEIGHT; i++) {
            if (!(thickness[i] > 0.1F))
                continue;
            CHECK_NEAR((double)first[i], (double)left_alone[i],
                       2e-3 * (1 + fabs((double)left_alone[i])));
            seen++;
        }
        assert_true(seen > 100);
    }
    render_result_finish(&a);
    render_result_finish(&b);
    render_result_finish(&alone);
}

/* A small ball before a large one: the layer has the faces of both, also by rungs that look faces
 * up in a rectangle around each. */
static void back_faces_of_all(void **state)
{
    static const struct ball small = { { { 0.3F, 0.2F, 2 } }, 0.3F, 1.5F };
    static const char *const refraction_models[] = { "paper", "bounce" };
    const uint64_t layers = picture_layer_bit("back.N");
    for (size_t k = 0; k < 2; k++) {
        struct render_result both = DRAW(*state, refraction_models[k], layers, &small, &behind);
        struct render_result near = DRAW(*state, refraction_models[k], layers, &small);
        struct render_result far = DRAW(*state, refraction_models[k], layers, &behind);
        size_t seen[2] = { 0 };
        for (size_t i = 0; i < (size_t)WIDTH * HEIGHT; i++) {
            const vec3s is = normal_at(&both.image, i), own = normal_at(&near.image, i);
            const bool is_near = glms_vec3_norm2(own) > 0;
            const vec3s wanted = is_near ? own : normal_at(&far.image, i);
            assert_true(glms_vec3_distance(is, wanted) < 2e-3F);
            seen[is_near] += glms_vec3_norm2(wanted) > 0;
        }
        assert_true(seen[0] > 100 && seen[1] > 30);
        render_result_finish(&both);
        render_result_finish(&near);
        render_result_finish(&far);
    }
}

/* ---- objects in objects ---- */

static const struct ball shell = { { { 0.2F, 0.1F, 0 } }, 1.2F, 1.5F };
static const struct ball cavity = { { { 0.2F, 0.1F, 0 } }, 0.9F, 1 };
static const struct ball core = { { { 0.2F, 0.1F, 0 } }, 0.6F, 1.6F };

/* A ball in the middle of a hollow one. */
static struct scene hollow_scene(bool core_first)
{
    struct scene scene = scene_with_room(3);
    const struct object *objects = scene.model.objects;
    if (core_first)
        add_ball(&scene, &core);
    add_ball(&scene, &shell);
    add_cavity(&scene, &cavity);
    if (!core_first)
        add_ball(&scene, &core);
    complete(&scene);
    assert_int_equal(objects[!core_first].enclosing_object, 1 + core_first);
    assert_int_equal(objects[!core_first].container_rank, 0);
    assert_int_equal(objects[core_first].enclosing_object, 0);
    return scene;
}

/* Returns the angle, degrees, by which the ball and those in it turn a ray that misses their middle
 * by `miss`. */
static double turn_of(double miss)
{
    const struct ball *const balls[] = { &shell, &cavity, &core };
    double before = 1, turn = 0;
    for (int i = 0; i < 3 && miss < before * (double)balls[i]->radius; i++) {
        const double out = miss / (before * (double)balls[i]->radius);
        const double in = miss / ((double)balls[i]->ior * (double)balls[i]->radius);
        turn += 360 / 3.14159265358979323846 * (asin(out) - asin(in));
        before = (double)balls[i]->ior;
    }
    return fabs(turn);
}

/* Light that no face reflects is turned as Snell's law says, wherever the file has the inner ball;
 * and none is lost. */
static void light_goes_through_objects_in_objects(void **state)
{
    const struct vec middle = { (double)shell.center.x, (double)shell.center.y, -6 };
    const struct settings settings = picture_settings("light.count=0");
    for (int core_first = 0; core_first < 2; core_first++) {
        struct scene scene = hollow_scene(core_first);
        struct picture_request request = {
            .scene = &scene,
            .settings = &settings,
            .refraction = "bounce",
            .camera = { .eye = { { 0, 0, 6 } }, .fov_deg = 30 },
            .width = WIDTH,
            .height = HEIGHT,
            .layers = picture_layer_bit("exit"),
        };
        struct render_result result = picture_render(*state, &request);
        const struct picture_layer exit = picture_layer(&result.image, "exit");
        size_t count = 0, wrong = 0;
        for (size_t i = 0; i < (size_t)WIDTH * HEIGHT; i++) {
            const struct vec ray = picture_pixel_ray(&request, i);
            const double miss = vec_norm(vec_cross(ray, middle));
            if (miss > 0.8 || fabs(miss - 0.6) < 0.05) /* the edge of a ball is too near */
                continue;
            count++;
            wrong += !(fabs(vec_angle_deg(ray, picture_at(exit, i)) - turn_of(miss)) < 1);
        }
        assert_true(count > 300);
        assert_in_range(wrong, 0, count / 50);
        render_result_finish(&result);
        scene.background.kind = SCENE_COLOR;
        scene.background.color = glms_vec3_one();
        request.layers = 0;
        result = picture_render(*state, &request);
        for (size_t i = 0; i < (size_t)WIDTH * HEIGHT; i++)
            assert_true(fabsf(image_find(&result.image, "G")[i] - 1) < 4e-3F);
        render_result_finish(&result);
        scene_finish(&scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_looks_as_it_does_alone),
        cmocka_unit_test(the_nearest_is_seen),
        cmocka_unit_test(back_faces_of_all),
        cmocka_unit_test(light_goes_through_objects_in_objects),
    };
    return RUN_ON_DEVICE(tests);
}
