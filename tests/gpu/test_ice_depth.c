/*
 * test_ice_depth.c: front depth, back depth and thickness of the ice, against a sphere's closed
 * form, also with rotation.
 */
#include <math.h>

#include "src/scene/generate/generate.h"
#include "tests/support/assertions.h"
#include "tests/support/lavapipe.h"
#include "tests/support/picture.h"

enum {
    SIZE = 128,
};

static const float distance = 4.0f;

static struct picture_request request_of(const struct scene *scene)
{
    return (struct picture_request){
        .scene = scene,
        .camera = camera_orbit(0, 0, distance, box_center(scene->box), 40),
        .width = SIZE,
        .height = SIZE,
        .layers = PICTURE_ALL_LAYERS,
    };
}

static void open_scene(struct scene *scene, const char *name)
{
    const vec3s gray = { { 0.5f, 0.5f, 0.5f } };
    const struct scene_params params = { .name = name,
                                         .background = &gray,
                                         .object_triangles = 16384 };
    assert_int_equal(scene_load(scene, &params), STATUS_OK);
}

static void test_sphere(void **state)
{
    struct scene scene;
    open_scene(&scene, "sphere");
    const struct picture_request request = request_of(&scene);
    struct render_result result = picture_render(*state, &request);
    const float *front = image_find(&result.image, "front.Z");
    const float *back = image_find(&result.image, "back.Z");
    const float *thickness = image_find(&result.image, "thickness.Z");
    size_t inside = 0;
    for (size_t i = 0; i < (size_t)SIZE * SIZE; i++) {
        const struct vec ray = picture_pixel_ray(&request, i);
        const double along = -ray.z; /* metres along the axis for each along the ray */
        const double middle = (double)distance * along;
        const double b2 = (double)distance * (double)distance - middle * middle;
        if (b2 > 0.95 && b2 < 1.05) /* the silhouette is a polygon */
            continue;
        if (b2 > 1.0) {
            assert_true(front[i] == 0.0f && back[i] == 0.0f && thickness[i] == 0.0f);
            continue;
        }
        const double half = sqrt(1.0 - b2);
        assert_true(fabs((double)front[i] - (middle - half) * along) < 0.01);
        assert_true(fabs((double)back[i] - (middle + half) * along) < 0.01);
        assert_true(fabs((double)thickness[i] - 2.0 * half) < 0.02);
        inside++;
    }
    assert_true(inside > 1000);
    render_result_finish(&result);
    scene_finish(&scene);
}

/* The ice turned by 90 degrees, and the camera the other way around the ice at rest. */
static void test_turning(void **state)
{
    struct scene scene;
    open_scene(&scene, "valley");
    const struct settings settings = picture_settings("motion.ice=30");
    struct picture_request turned = request_of(&scene);
    struct picture_request gone = turned;
    turned.settings = gone.settings = &settings;
    turned.time = 3.0f;
    gone.camera = camera_orbit(-90, 0, distance, box_center(scene.box), 40);
    struct render_result a = picture_render(*state, &turned);
    struct render_result b = picture_render(*state, &gone);
    const float *x = image_find(&a.image, "thickness.Z");
    const float *y = image_find(&b.image, "thickness.Z");
    size_t different = 0;
    size_t seen = 0;
    for (size_t i = 0; i < (size_t)SIZE * SIZE; i++) {
        different += fabsf(x[i] - y[i]) > 0.01f;
        seen += x[i] > 0.0f;
    }
    assert_true(seen > 1000);
    assert_true(different < seen / 100); /* edges */
    render_result_finish(&a);
    render_result_finish(&b);
    scene_finish(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_sphere),
        cmocka_unit_test(test_turning),
    };
    return RUN_ON_DEVICE(tests);
}
