/*
 * test_cracks_hit.c: cracks in a ball as the refraction model `bounce` draws them: intersections
 * and the radiance along reflected rays.
 */
#include <cglm/struct.h>
#include <math.h>
#include "src/scene/generate/generate.h"
#include "tests/support/assertions.h"
#include "tests/support/lavapipe.h"
#include "tests/support/picture.h"

enum {
    SIZE = 65,
    MIDDLE = SIZE * SIZE / 2, /* its ray goes along -z */
};

static const double pi = 3.14159265358979323846;
static const double eta = 1.3091 / 1.0003;

/* A sheet that stands upright, `turn` degrees about y from facing +z. */
struct sheet {
    vec3s center;
    double turn;
    float half_width;
};

static void add_sheets(struct scene *scene, const struct sheet *sheets, uint32_t count)
{
    static const uint32_t corners[6] = { 0, 1, 2, 0, 2, 3 };
    struct mesh *mesh = &scene->inclusions.cracks;
    assert_true(mesh_init(mesh, 4 * count, 6 * count));
    for (uint32_t k = 0; k < count; k++) {
        const float c = (float)cos(sheets[k].turn * pi / 180);
        const float s = (float)sin(sheets[k].turn * pi / 180);
        for (uint32_t i = 0; i < 4; i++) { /* no diagonal through the centre */
            const float across = (i == 1 || i == 2 ? 1.2f : -0.8f) * sheets[k].half_width;
            const vec3s from = { { across * c, i >= 2 ? 0.3f : -0.2f, -across * s } };
            struct mesh_vertex *vertex = &mesh->vertices[4 * k + i];
            vertex->position = glms_vec3_add(sheets[k].center, from);
            vertex->normal = (vec3s){ { s, 0, c } };
            vertex->color = glms_vec3_one();
        }
        for (uint32_t i = 0; i < 6; i++)
            mesh->indices[6 * k + i] = 4 * k + corners[i];
    }
}

/* What the ray through the ball's middle sees. */
static struct vec see(struct gpu *gpu, const struct sheet *sheets, uint32_t count,
                      const char *setting)
{
    static const char *const gaps[] = { "cracks.refract=gap", "cracks.bump=0", "cracks.gap=1000",
                                        "cracks.clip=convex" };
    struct settings settings = picture_settings(setting);
    for (size_t i = 0; i < sizeof(gaps) / sizeof(gaps[0]); i++)
        assert_int_equal(settings_assign(&settings, gaps[i], SETTING_USER, NULL), STATUS_OK);
    struct scene scene = picture_sphere_scene((vec3s){ { 0, 0, 0 } }, 40000);
    picture_use_directions(&scene, 1024);
    add_sheets(&scene, sheets, count);
    const struct picture_request request = {
        .scene = &scene,
        .settings = &settings,
        .camera = camera_orbit(0, 0, 4, (vec3s){ { 0, 0, 0 } }, 30),
        .width = SIZE,
        .height = SIZE,
        .refraction = "bounce",
    };
    struct render_result result = picture_render(gpu, &request);
    const struct vec seen = picture_at(picture_layer(&result.image, ""), MIDDLE);
    render_result_finish(&result);
    scene_finish(&scene);
    return seen;
}

static struct vec turned(double degrees)
{
    return (struct vec){ sin(degrees * pi / 180), 0, cos(degrees * pi / 180) };
}

/* Returns the colour in the direction in which a ray leaves the ball. */
static struct vec leave(struct vec from, struct vec dir)
{
    const double middle = vec_dot(from, dir);
    const double length = sqrt(middle * middle + 1 - vec_dot(from, from)) - middle;
    const struct vec n = vec_add(from, length, dir);
    const double c = vec_dot(n, dir);
    const double along = sqrt(1 - eta * eta * (1 - c * c)) - eta * c;
    return picture_direction_color(vec_add(vec_scale(dir, eta), along, n));
}

/* A gap at 48 degrees mirrors .385 of the light. That is followed, too, and bent where it leaves,
 * unless it is less than what a branch takes. */
static void the_lesser_part_is_followed(void **state)
{
    const struct sheet sheet = { { { 0, 0, 0.5f } }, 48, 0.4f };
    const struct vec at_once = see(*state, &sheet, 1, "refract_bounce.min_branch=0.5");
    const struct vec followed = see(*state, &sheet, 1, "refract_bounce.min_branch=0.1");
    const struct vec bent = leave((struct vec){ 0, 0, 0.5 }, turned(96));
    const struct vec straight = picture_direction_color(turned(96));
    const struct vec wanted = vec_scale(vec_add(bent, -1, straight), 0.385);
    const struct vec change = vec_add(followed, -1, at_once);
    print_message("%.4f of change, must be %.4f; %.4f between them\n", vec_norm(change),
                  vec_norm(wanted), vec_difference(change, wanted));
    assert_true(vec_norm(wanted) > 0.02);
    assert_true(vec_difference(change, wanted) < 0.3 * vec_norm(wanted));
}

static const struct sheet first = { { { 0, 0, 0 } }, 52, 0.4f };
static const struct sheet second = { { { 0.65f, 0, -0.16f } }, -21, 0.2f };

/* Light that one sheet mirrors meets another. */
static void mirrored_light_meets_cracks(void **state)
{
    const struct sheet sheets[2] = { first, second };
    const struct vec one = see(*state, sheets, 1, "refract_bounce.inclusions=cracks");
    const struct vec both = see(*state, sheets, 2, "refract_bounce.inclusions=cracks");
    const struct vec once = leave((struct vec){ 0, 0, 0 }, turned(104));
    const struct vec twice = leave((struct vec){ 0.65, 0, -0.16 }, turned(34));
    print_message("%.3f and %.3f from what they mirror, which are %.3f apart\n",
                  vec_difference(one, once), vec_difference(both, twice),
                  vec_difference(once, twice));
    assert_true(vec_difference(one, once) < 0.1);
    assert_true(vec_difference(both, twice) < 0.1);
    assert_true(vec_difference(once, twice) > 0.3);
}

/* Between two sheets the ball's surface reflects all. */
static void light_that_a_face_reflects_meets_cracks(void **state)
{
    const struct sheet sheets[2] = { { { { 0, 0, 0.85f } }, 52, 0.2f },
                                     { { { 0.805f, 0, 0.207f } }, 47.8, 0.12f } };
    const struct vec one = see(*state, sheets, 2, "refract_bounce.inclusions=cracks");
    const struct vec both = see(*state, sheets, 2, "refract_bounce.inclusions=all");
    const struct vec wanted = leave((struct vec){ 0.805, 0, 0.207 }, turned(102.8));
    print_message("%.3f from what is mirrored, %.3f without the second sheet\n",
                  vec_difference(both, wanted), vec_difference(one, wanted));
    assert_true(vec_difference(both, wanted) < 0.1);
    assert_true(vec_difference(one, wanted) > 0.3);
}

/* However often light is parted, none is lost, and none is made. */
static void even_light(void **state)
{
    static const char *const ways[] = { "refract_bounce.min_branch=0",
                                        "refract_bounce.min_branch=1",
                                        "refract_bounce.min_throughput=0.1" };
    for (size_t way = 0; way < sizeof(ways) / sizeof(ways[0]); way++) {
        struct settings settings = picture_settings("cracks.refract=gap");
        struct scene scene = { .background.kind = SCENE_COLOR,
                               .background.color = { { 0.25f, 0.25f, 0.25f } } };
        const struct scene_cracks cracks = { .count = 5, .seed = 4, .size = 1 };
        assert_int_equal(
            settings_assign(&settings, "refract_bounce.inclusions=all", SETTING_USER, NULL),
            STATUS_OK);
        assert_int_equal(settings_assign(&settings, ways[way], SETTING_USER, NULL), STATUS_OK);
        assert_true(generate_ice_cube(&scene.model.object, GENERATE_ICE_CUBE_TRIANGLES));
        scene.box = mesh_box(&scene.model.object);
        assert_int_equal(scene_generate_cracks(&scene, &cracks), STATUS_OK);
        const struct picture_request request = {
            .scene = &scene,
            .settings = &settings,
            .camera = camera_orbit(0, 0, 1.1f * box_diagonal(scene.box), box_center(scene.box), 45),
            .width = 2 * SIZE,
            .height = 2 * SIZE,
            .refraction = "bounce",
        };
        struct render_result result = picture_render(*state, &request);
        const float *picture = image_find(&result.image, "G");
        for (size_t i = 0; i < (size_t)4 * SIZE * SIZE; i++)
            CHECK_NEAR(picture[i], 0.25, 1e-3);
        render_result_finish(&result);
        scene_finish(&scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_lesser_part_is_followed),
        cmocka_unit_test(mirrored_light_meets_cracks),
        cmocka_unit_test(light_that_a_face_reflects_meets_cracks),
        cmocka_unit_test(even_light),
    };
    return RUN_ON_DEVICE(tests);
}
