/*
 * The traced reference of what is inside ice against closed forms: bubbles.
 */
#include <math.h>
#include <stdlib.h>

#include "src/scene/generate/generate.h"
#include "tests/support/check.h"
#include "tests/support/picture.h"
#include "tests/support/seen.h"

static const double air = 1.0003;
static const double ice = 1.3091;

/* ---- scenes ---- */

/* A block of ice of 100 m across around the origin, in white. */
static struct scene block_scene(void)
{
    static const uint32_t corners[2][6] = { { 0, 2, 1, 1, 2, 3 }, { 0, 1, 2, 1, 3, 2 } };
    struct scene scene = { .background = SCENE_COLOR, .background_color = glms_vec3_one() };
    struct mesh *box = &scene.model.object;
    assert_true(mesh_init(box, 24, 36));
    for (uint32_t i = 0; i < 24; i++) {
        const uint32_t axis = i / 8;
        const float side = i / 4 % 2 ? 1.0F : -1.0F;
        struct mesh_vertex *vertex = &box->vertices[i];
        vertex->normal.raw[axis] = side;
        vertex->position.raw[axis] = 50 * side;
        vertex->position.raw[(axis + 1) % 3] = i % 2 ? 50 : -50;
        vertex->position.raw[(axis + 2) % 3] = i / 2 % 2 ? 50 : -50;
    }
    for (uint32_t i = 0; i < 36; i++)
        box->indices[i] = 4 * (i / 6) + corners[i / 6 % 2][i % 6];
    scene.box = mesh_box(box);
    return scene;
}

static void add_bubble(struct scene *scene, vec3s center, float radius)
{
    struct bubbles *bubbles = &scene->bubbles;
    bubbles->spheres = realloc(bubbles->spheres, (bubbles->count + 1) * sizeof(*bubbles->spheres));
    assert_non_null(bubbles->spheres);
    bubbles->spheres[bubbles->count++] = (struct bubbles_sphere){ center, radius };
}

/* The direction outside of light that leaves the block's far side, of an angle inside. */
static struct vec outside_of(double inside)
{
    return seen_direction(asin(ice / air * sin(inside)));
}

/* ---- bubbles ---- */

/* A bubble turns light outward by 2 (t - i), and reflects what Fresnel's equations say; the eye is
 * in the ice. */
static void test_bubble(void **state)
{
    static const double table[][2] = {
        { 0, 0 }, { 0.2, 7.2729 }, { 0.4, 15.9760 }, { 0.6, 29.7431 }
    };
    const struct settings settings = settings_default();
    struct scene scene = block_scene();
    (void)state;
    add_bubble(&scene, (vec3s){ { 0, 0, -5 } }, 1);
    for (size_t i = 0; i < sizeof(table) / sizeof(table[0]); i++) {
        const double b = table[i][0];
        const double turn = table[i][1] * SEEN_PI / 180;
        const struct seen seen =
            seen_look(&scene, &settings, (struct vec){ b, 0, 0 }, seen_direction(0));
        assert_true(vec_angle_deg(seen.exit, outside_of(turn)) < 0.001);
        CHECK_NEAR(seen.fresnel, seen_fresnel(asin(b), ice, air), 1e-6);
        CHECK_NEAR(seen.position.x, b, 1e-6);
        CHECK_NEAR(seen.position.z, -5 + sqrt(1 - b * b), 1e-6);
        CHECK_NEAR(seen.tir, 0, 0);
    }
    const struct seen rim =
        seen_look(&scene, &settings, (struct vec){ 0.77, 0, 0 }, seen_direction(0));
    CHECK_NEAR(rim.fresnel, 1, 0); /* beyond 1.0003 / 1.3091 */
    scene_finish(&scene);
}

/* Where a bubble reaches out of the ice, its surface is between air and air; and the ice's is, where
 * it is inside the bubble. */
static void test_bubble_in_the_surface(void **state)
{
    const struct settings settings = settings_default();
    struct scene scene = block_scene();
    (void)state;
    add_bubble(&scene, (vec3s){ { 0, 0, 50 } }, 1);
    struct seen seen = seen_look(&scene, &settings, (struct vec){ 0.5, 0, 60 }, seen_direction(0));
    CHECK_NEAR(seen.z, 10 + sqrt(0.75), 1e-5); /* the pit's floor, which the bubble leaves */
    CHECK_NEAR(seen.fresnel, seen_fresnel(SEEN_PI / 6, air, ice), 1e-5);
    seen = seen_look(&scene, &settings, (struct vec){ 0, 0, 50.5 }, seen_direction(0));
    CHECK_NEAR(seen.z, 1.5, 1e-5); /* the eye inside the bubble, outside of the ice */
    seen = seen_look(&scene, &settings, (struct vec){ 0, 0, 49.5 }, seen_direction(0));
    CHECK_NEAR(seen.z, 0.5, 1e-5); /* inside both */
    scene_finish(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_bubble),
        cmocka_unit_test(test_bubble_in_the_surface),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
