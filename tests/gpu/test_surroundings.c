/* test_surroundings.c: textures, alpha cut-outs, emission and lighting of the surroundings. */
#include <cglm/struct.h>
#include <stdlib.h>
#include <string.h>

#include "tests/support/assertions.h"

#include "tests/support/lavapipe.h"
#include "tests/support/picture.h"

static const vec3s white = { { 1, 1, 1 } };

/* Relative: a device may round to halves either way. */
static const double half_step = 1.1e-3;

/* Two metres wide, around the origin, towards +Z. */
static const struct picture_quad square = {
    .top_left = { { -1, 1, 0 } },
    .right = { { 2, 0, 0 } },
    .down = { { 0, -2, 0 } },
    .color = { { 1, 1, 1 } },
};

/* One square in front of a dark background, the object out of the way behind the camera. */
static struct scene one_square(uint32_t material, vec3s color)
{
    struct scene scene = picture_sphere_scene((vec3s){ { 0, 0, 30 } }, 20);
    struct picture_quad quad = square;
    quad.material = material;
    quad.color = color;
    scene.background.kind = SCENE_COLOR;
    scene.background.color = (vec3s){ { 0, 0, 0.125F } };
    picture_add_quad(&scene, &quad);
    return scene;
}

static struct picture_request view_of(const struct scene *scene)
{
    return (struct picture_request){
        .scene = scene,
        .camera = { .eye = { { 0, 0, 5 } }, .fov_deg = 45 },
        .width = 128,
        .height = 96,
    };
}

/* The pixel that sees a point of the square's plane. */
static size_t pixel_at(const struct picture_request *request, double x, double y)
{
    const double pixel = 5 * 2 * tan(GLM_PI / 8) / request->height;
    return (size_t)(request->height / 2.0 - y / pixel) * request->width +
           (size_t)(request->width / 2.0 + x / pixel);
}

static void check_color(const struct render_result *result, size_t pixel, vec3s color)
{
    const struct vec seen = picture_at(picture_layer(&result->image, ""), pixel);
    CHECK_NEAR(vec_difference(seen, vec_from(color)), 0, half_step);
}

/* ---- textures ---- */

enum {
    TEXTURE_SIDE = 8
};

/*
 * Three layers. The middle one has quarters, each of some texels, so that no filter mixes them: red
 * green / blue grey, the grey one transparent.
 */
static void add_textures(struct scene *scene)
{
    static const uint8_t quarters[4][4] = {
        { 255, 0, 0, 255 },
        { 0, 255, 0, 128 },
        { 0, 0, 255, 255 },
        { 188, 188, 188, 127 },
    };
    const size_t layer_size = (size_t)TEXTURE_SIDE * TEXTURE_SIDE * 4;
    struct texture_layers *textures = &scene->model.textures;
    *textures = (struct texture_layers){ calloc(3, layer_size), TEXTURE_SIDE, 3 };
    assert_non_null(textures->texels);
    for (size_t i = 0; i < layer_size / 4; i++) {
        const size_t right = i % TEXTURE_SIDE / (TEXTURE_SIDE / 2);
        const size_t below = i / TEXTURE_SIDE / (TEXTURE_SIDE / 2);
        memcpy(textures->texels + layer_size + 4 * i, quarters[2 * below + right], 4);
    }
}

static void check_texels(struct gpu *gpu, uint32_t material, vec3s color, vec3s fourth)
{
    struct scene scene = one_square(material, color);
    add_textures(&scene);
    const struct picture_request request = view_of(&scene);
    struct render_result result = picture_render(gpu, &request);
    check_color(&result, pixel_at(&request, -0.5, 0.5), (vec3s){ { color.x, 0, 0 } });
    check_color(&result, pixel_at(&request, 0.5, 0.5), (vec3s){ { 0, color.y, 0 } });
    check_color(&result, pixel_at(&request, -0.5, -0.5), (vec3s){ { 0, 0, color.z } });
    check_color(&result, pixel_at(&request, 0.5, -0.5), fourth);
    check_color(&result, pixel_at(&request, 1.2, 0), scene.background.color);
    render_result_finish(&result);
    scene_finish(&scene);
}

static void textures_are_upright_and_linear(void **state)
{
    const float grey = 0.5029F; /* of sRGB 188 */
    const vec3s tint = { { 0.25F, 0.5F, 0.75F } };
    check_texels(*state, MESH_UNLIT | 2, white, (vec3s){ { grey, grey, grey } });
    check_texels(*state, MESH_UNLIT | 2, tint, glms_vec3_scale(tint, grey));
}

static void cutouts_are_holes(void **state)
{
    check_texels(*state, MESH_UNLIT | MESH_CUTOUT | 2, white, (vec3s){ { 0, 0, 0.125F } });
}

/* ---- light ---- */

static struct vec color_of_square(struct gpu *gpu, const struct scene *scene,
                                  const struct settings *settings)
{
    struct picture_request request = view_of(scene);
    request.settings = settings;
    struct render_result result = picture_render(gpu, &request);
    const struct vec color =
        picture_at(picture_layer(&result.image, ""), pixel_at(&request, 0.1, 0.1));
    render_result_finish(&result);
    return color;
}

static void unlit_colors_are_exact(void **state)
{
    const vec3s color = { { 0.5F, 0.0078125F, 3 } };
    struct scene scene = one_square(MESH_UNLIT, color);
    const struct settings settings = picture_settings("sky.strength=0");
    const struct vec seen = color_of_square(*state, &scene, &settings);
    CHECK_NEAR(seen.x, color.x, half_step * 0.5);
    CHECK_NEAR(seen.y, color.y, half_step * 0.01);
    CHECK_NEAR(seen.z, color.z, half_step * 3);
    scene_finish(&scene);
}

static struct settings sun_at(const char *azimuth)
{
    struct settings settings = picture_settings(azimuth);
    assert_int_equal(settings_assign(&settings, "sky.sun_elevation=0", SETTING_USER, NULL),
                     STATUS_OK);
    return settings;
}

/* By the cosine of the angle between normal and sun, with the sky's light besides. */
static void light_follows_the_sun(void **state)
{
    struct scene scene = one_square(0, white);
    const struct settings head_on = sun_at("sky.sun_azimuth=0");
    const struct settings aslant = sun_at("sky.sun_azimuth=60");
    const struct settings behind = sun_at("sky.sun_azimuth=120");
    const struct settings dark = picture_settings("sky.strength=0");
    const struct vec bright = color_of_square(*state, &scene, &head_on);
    const struct vec half = color_of_square(*state, &scene, &aslant);
    const struct vec ambient = color_of_square(*state, &scene, &behind);
    assert_true(ambient.x > 0.05 && bright.x > ambient.x + 0.5);
    CHECK_NEAR(half.x - ambient.x, 0.5 * (bright.x - ambient.x), 2e-3);
    CHECK_NEAR(half.z - ambient.z, 0.5 * (bright.z - ambient.z), 2e-3);
    assert_true(vec_norm(color_of_square(*state, &scene, &dark)) == 0);
    scene_finish(&scene);
    scene = one_square(0, (vec3s){ { 0.5F, 0.5F, 0.5F } });
    CHECK_NEAR(color_of_square(*state, &scene, &head_on).x, bright.x / 2, 2e-3);
    scene_finish(&scene);
}

/* Whichever way the normals point: both sides are lit as seen. */
static void both_sides_are_lit_alike(void **state)
{
    struct scene scene = one_square(0, white);
    const struct settings settings = sun_at("sky.sun_azimuth=30");
    const struct vec front = color_of_square(*state, &scene, &settings);
    for (uint32_t i = 0; i < scene.model.surroundings.vertex_count; i++)
        scene.model.surroundings.vertices[i].normal = (vec3s){ { 0, 0, -1 } };
    const struct vec back = color_of_square(*state, &scene, &settings);
    assert_true(vec_difference(front, back) == 0);
    scene_finish(&scene);
}

/* ---- what hides what ---- */

static void the_nearer_surface_is_seen(void **state)
{
    static const vec3s red = { { 1, 0, 0 } };
    for (int nearer_first = 0; nearer_first < 2; nearer_first++) {
        struct scene scene = one_square(MESH_UNLIT, nearer_first ? white : red);
        struct picture_quad other = square;
        other.top_left.z = nearer_first ? -0.001F : 0.001F;
        other.color = nearer_first ? red : white;
        other.material = MESH_UNLIT;
        picture_add_quad(&scene, &other);
        const struct settings settings = settings_default();
        const struct vec seen = color_of_square(*state, &scene, &settings);
        CHECK_NEAR(vec_difference(seen, vec_from(white)), 0, half_step);
        scene_finish(&scene);
    }
}

/* A square before the sphere hides it in the picture and in its layers; one behind does not. */
static void surroundings_hide_the_object(void **state)
{
    for (int is_hidden = 0; is_hidden < 2; is_hidden++) {
        struct scene scene = one_square(MESH_UNLIT, white);
        struct picture_request request = view_of(&scene);
        const float z = is_hidden ? -1.5F : 1.5F;
        for (uint32_t i = 0; i < scene.model.object.vertex_count; i++) {
            vec3s *p = &scene.model.object.vertices[i].position;
            *p = glms_vec3_add(glms_vec3_scale(scene.model.object.vertices[i].normal, 0.5F),
                               (vec3s){ { 0, 0, z } });
        }
        scene.box = mesh_box(&scene.model.object);
        request.layers = PICTURE_ALL_LAYERS;
        struct render_result result = picture_render(*state, &request);
        const size_t middle = pixel_at(&request, 0.05, 0.05);
        const double depth = (double)image_find(&result.image, "Z")[middle];
        assert_true(picture_is_object(picture_layer(&result.image, "exit"), middle) != is_hidden);
        if (is_hidden) {
            CHECK_NEAR(depth, 5, 1e-4);
            check_color(&result, middle, white);
        } else {
            assert_true(depth < 3.5);
        }
        render_result_finish(&result);
        scene_finish(&scene);
    }
}

/* A floor that the sphere all but touches is whole in the cube. */
static void what_is_near_is_reflected(void **state)
{
    static const struct picture_quad floor = {
        { { -50, -1.01F, -50 } }, { { 100, 0, 0 } }, { { 0, 0, 100 } }, { { 1, 0, 0 } }, MESH_UNLIT,
    };
    struct scene scene = picture_sphere_scene((vec3s){ { 0, 0, 0 } }, 960);
    scene.background.kind = SCENE_COLOR;
    picture_add_quad(&scene, &floor);
    struct picture_request request = view_of(&scene);
    request.layers = PICTURE_ALL_LAYERS;
    struct render_result result = picture_render(*state, &request);
    const struct picture_layer reflection = picture_layer(&result.image, "reflection");
    const struct picture_layer exit = picture_layer(&result.image, "exit");
    const struct picture_layer normal = picture_layer(&result.image, "N");
    size_t count = 0;
    for (size_t i = 0; i < (size_t)request.width * request.height; i++) {
        const struct vec e = picture_pixel_ray(&request, i);
        const struct vec n = picture_at(normal, i);
        const double down = 2 * vec_dot(e, n) * n.y - e.y; /* of the reflected direction */
        if (!picture_is_object(exit, i) || fabs(down) < 0.05)
            continue;
        const struct vec red = { down > 0, 0, 0 };
        CHECK_NEAR(vec_difference(picture_at(reflection, i), red), 0, half_step);
        count++;
    }
    assert_true(count > 1000);
    render_result_finish(&result);
    scene_finish(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(textures_are_upright_and_linear),
        cmocka_unit_test(cutouts_are_holes),
        cmocka_unit_test(unlit_colors_are_exact),
        cmocka_unit_test(light_follows_the_sun),
        cmocka_unit_test(both_sides_are_lit_alike),
        cmocka_unit_test(the_nearer_surface_is_seen),
        cmocka_unit_test(surroundings_hide_the_object),
        cmocka_unit_test(what_is_near_is_reflected),
    };
    return RUN_ON_DEVICE(tests);
}
