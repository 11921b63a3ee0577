/*
 * test_frost.c: frost against the closed form, in an environment of directions as colours: a round
 * lobe moves such a colour towards grey by the mean cosine of the lobe.
 */
#include <stdlib.h>

#include "tests/support/assertions.h"

#include "src/file/half_float.h"
#include "src/scene/mip_levels.h"
#include "tests/support/bump_reference.h"
#include "tests/support/lavapipe.h"
#include "tests/support/picture.h"

enum {
    SIZE = 128,
    PIXEL_COUNT = SIZE * SIZE,
};

static const double n = 1.3091 / 1.0003;
static const vec3s eye = { { 0.3F, 0.5F, 3.2F } };

struct frost_picture {
    struct settings settings;
    struct picture_request request;
    struct render_result result;
    struct picture_layer beauty, normal, exit;
};

static struct frost_picture draw(struct gpu *gpu, const struct scene *scene, const char *amount,
                                 const char *roughness)
{
    struct frost_picture p = {
        .settings = picture_settings(amount),
        .request = {
            .scene = scene,
            .camera = { .eye = eye, .fov_deg = 40 },
            .width = SIZE,
            .height = SIZE,
            .layers = picture_layer_bit("exit") | picture_layer_bit("N"),
        },
    };
    assert_int_equal(settings_assign(&p.settings, roughness, SETTING_USER, NULL), STATUS_OK);
    assert_int_equal(settings_assign(&p.settings, "bump.scale=1", SETTING_USER, NULL), STATUS_OK);
    p.request.settings = &p.settings;
    p.result = picture_render(gpu, &p.request);
    p.beauty = picture_layer(&p.result.image, "");
    p.normal = picture_layer(&p.result.image, "N");
    p.exit = picture_layer(&p.result.image, "exit");
    return p;
}

static struct scene sphere_in_directions(void)
{
    struct scene scene = picture_sphere_scene((vec3s){ { 0, 0, 0 } }, 960);
    picture_use_directions(&scene, 512);
    return scene;
}

/* Mean cosine of the lobe: slopes of GGX, tan d = alpha sqrt(u / (1 - u)) for even u, tilt
 * refracted light by (n - 1) d. */
static double mean_cosine(double roughness)
{
    const double alpha = roughness * roughness;
    double sum = 0;
    for (int i = 0; i < 100000; i++) {
        const double u = (i + 0.5) / 100000;
        sum += cos((n - 1) * atan(alpha * sqrt(u / (1 - u))));
    }
    return sum / 100000;
}

static struct vec blurred(struct vec dir, double cosine)
{
    return picture_direction_color(vec_scale(vec_unit(dir), cosine));
}

/* `share` of the light is taken by frost; the same part of that is white. */
static void check_pixels(const struct frost_picture *bare, const struct frost_picture *p,
                         double share, double cosine)
{
    double most = 0;
    for (size_t i = 0; i < PIXEL_COUNT; i++) {
        const struct vec before = picture_at(bare->beauty, i);
        const struct vec behind = blurred(picture_at(p->exit, i), cosine);
        const struct vec white = blurred(picture_at(p->normal, i), cosine);
        const struct vec frosty = vec_add(vec_scale(behind, 1 - share), share, white);
        struct vec expected = vec_add(vec_scale(before, 1 - share), share, frosty);
        if (!picture_is_object(p->exit, i))
            expected = before;
        const double error = vec_difference(picture_at(p->beauty, i), expected);
        most = fmax(most, isnan(error) ? HUGE_VAL : error);
    }
    if (most > 6e-3)
        fail_msg("share %g, mean cosine %g: wrong by up to %g", share, cosine, most);
}

static void frost_is_as_computed(void **state)
{
    struct scene scene = sphere_in_directions();
    struct frost_picture bare = draw(*state, &scene, "frost.amount=0", "frost.roughness=1");
    bump_reference_make_constant(&scene, 0, 0, 0, 1);
    struct frost_picture full = draw(*state, &scene, "frost.amount=1", "frost.roughness=1");
    struct frost_picture thin = draw(*state, &scene, "frost.amount=0.3", "frost.roughness=0.6");
    bump_reference_make_constant(&scene, 0, 0, 0.2, 0.6);
    struct frost_picture part = draw(*state, &scene, "frost.amount=0.8", "frost.roughness=0");
    check_pixels(&bare, &full, 1, mean_cosine(1));
    check_pixels(&bare, &thin, 0.3, mean_cosine(0.6));
    check_pixels(&bare, &part, 0.8 * 0.8 * 0.6, 1);
    assert_true(mean_cosine(1) < 0.98); /* else these tests tell nothing */
    render_result_finish(&bare.result);
    render_result_finish(&full.result);
    render_result_finish(&thin.result);
    render_result_finish(&part.result);
    scene_finish(&scene);
}

/* In an even white environment frost is as bright as all else. */
static void white_stays_white(void **state)
{
    struct scene scene = picture_sphere_scene((vec3s){ { 0, 0, 0 } }, 960);
    scene.background.kind = SCENE_COLOR;
    scene.background.color = (vec3s){ { 1, 1, 1 } };
    bump_reference_make_constant(&scene, 0, 0, 0, 1);
    struct frost_picture p = draw(*state, &scene, "frost.amount=0.7", "frost.roughness=1");
    for (size_t i = 0; i < PIXEL_COUNT; i++)
        CHECK_NEAR(vec_difference(picture_at(p.beauty, i), (struct vec){ 1, 1, 1 }), 0, 2e-3);
    render_result_finish(&p.result);
    scene_finish(&scene);
}

/* ---- where ---- */

/* Smooth where u lies below the middle of the plane across z, frosty above. */
static void halve_mask(struct scene *scene)
{
    enum {
        TEXELS = 64
    };

    const double middle = 0.71; /* where shaders/lighting/bump_map_sampling.glsl puts it */
    const struct mip_levels mip_levels = { .side = TEXELS, .layers = 1, .channels = 4 };
    struct bump_maps *maps = &scene->bump;
    *maps = (struct bump_maps){
        .texels = calloc(mip_levels_count(&mip_levels), sizeof(*maps->texels)),
        .size = TEXELS,
    };
    assert_non_null(maps->texels);
    for (uint32_t i = 0; i < TEXELS * TEXELS; i++) {
        const double u = (i % TEXELS + 0.5) / TEXELS;
        const bool smooth = u < middle && u > middle - 0.5;
        maps->texels[4 * i + 2] = half_from_float(smooth ? 1.0F : 0.0F);
        maps->texels[4 * i + 3] = half_from_float(1.0F);
    }
    mip_levels_fill_halves(maps->texels, &mip_levels);
}

/* The sky lights it: brighter than dark surroundings behind it, on one side alone. */
static void mask_says_where(void **state)
{
    struct scene scene = picture_sphere_scene((vec3s){ { 0, 0, 0 } }, 960);
    size_t left = 0;
    size_t right = 0;
    halve_mask(&scene);
    picture_add_directions(&scene, (vec3s){ { 0, 0, 0 } }, 30);
    for (uint32_t i = 0; i < scene.model.surroundings.vertex_count; i++)
        scene.model.surroundings.vertices[i].color = (vec3s){ { 0.05F, 0.05F, 0.05F } };
    struct frost_picture bare = draw(*state, &scene, "frost.amount=0", "frost.roughness=1");
    struct frost_picture p = draw(*state, &scene, "frost.amount=1", "frost.roughness=1");
    for (size_t i = 0; i < PIXEL_COUNT; i++) {
        const struct vec normal = picture_at(p.normal, i);
        if (!picture_is_object(p.exit, i) || normal.z < 0.9 || fabs(normal.x) < 0.1)
            continue;
        const double more = picture_at(p.beauty, i).y - picture_at(bare.beauty, i).y;
        if (normal.x > 0)
            assert_true(more > 0.2);
        else
            CHECK_NEAR(more, 0, 0.02);
        *(normal.x > 0 ? &right : &left) += 1;
    }
    assert_true(left > 50 && right > 50);
    render_result_finish(&bare.result);
    render_result_finish(&p.result);
    scene_finish(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(frost_is_as_computed),
        cmocka_unit_test(white_stays_white),
        cmocka_unit_test(mask_says_where),
    };
    return RUN_ON_DEVICE(tests);
}
