/*
 * test_ice_caustics.c: light through the object onto a floor, against rays computed by hand. The
 * floor is looked at from below, where nothing hides it: the layer says how much light there is.
 */
#include <math.h>
#include <string.h>

#include "tests/support/assertions.h"

#include "src/settings/scene_settings.h"
#include "tests/support/lavapipe.h"
#include "tests/support/picture.h"

enum {
    SIDE = 512, /* pixels */
};

static const double pi = 3.14159265358979323846;
static const double index_ratio = 1.3091 / 1.0003;

static void add_level(struct scene *scene, float half, float height)
{
    picture_add_quad(scene, &(struct picture_quad){
                                .top_left = { { -half, height, -half } },
                                .right = { { 2 * half, 0, 0 } },
                                .down = { { 0, 0, 2 * half } },
                                .color = { { 0.5F, 0.5F, 0.5F } },
                            });
}

struct lit_floor {
    struct render_result result;
    const float *light; /* the layer */
    struct picture_layer position;
    double pixel; /* area on the floor, square metres */
};

static struct settings settings_with(const char *const *assignments)
{
    struct settings settings = picture_settings("ice_caustics.light=sun");
    assert_int_equal(settings_assign(&settings, "caustics.sun=0.01", SETTING_USER, NULL),
                     STATUS_OK);
    for (; *assignments; assignments++)
        assert_int_equal(settings_assign(&settings, *assignments, SETTING_USER, NULL), STATUS_OK);
    return settings;
}

/* The picture is `width` metres wide on the floor. */
static struct lit_floor draw(struct gpu *gpu, const struct scene *scene, float height, double width,
                             const char *const *assignments)
{
    const struct settings settings = settings_with(assignments);
    const double away = 8;
    const struct picture_request request = {
        .scene = scene,
        .settings = &settings,
        .camera = {
            .eye = { { 0, height - (float)away, 0 } },
            .fov_deg = (float)(2 * atan(width / 2 / away) * 180 / pi),
        },
        .width = SIDE,
        .height = SIDE,
        .layers = picture_layer_bit("caustics") | picture_layer_bit("P"),
    };
    struct lit_floor lit = { .result = picture_render(gpu, &request) };
    lit.light = image_find(&lit.result.image, "caustics.Z");
    lit.position = picture_layer(&lit.result.image, "P");
    lit.pixel = width / SIDE * (width / SIDE);
    assert_non_null(lit.light);
    return lit;
}

/* ---- a ball ---- */

static double fresnel(double sine)
{
    const double inside = sine / index_ratio;
    const double ci = sqrt(1 - sine * sine);
    const double ct = sqrt(1 - inside * inside);
    const double rs = (ci - index_ratio * ct) / (ci + index_ratio * ct);
    const double rp = (index_ratio * ci - ct) / (index_ratio * ci + ct);
    return (rs * rs + rp * rp) / 2;
}

/* How far from the axis a ray lands that meets a unit ball at that distance from it; the plane is
 * `below` its centre. */
static double landing(double from_axis, double below)
{
    const double outer = asin(from_axis);
    const double inner = asin(from_axis / index_ratio);
    const double chord = 2 * cos(inner);
    const double turned = outer - inner;
    const double x = from_axis - chord * sin(turned);
    const double y = sqrt(1 - from_axis * from_axis) - chord * cos(turned);
    return fabs(x - (below + y) * tan(2 * turned));
}

/* Returns how far from the axis the light lands that a unit ball's outside reflects there. */
static double reflected_landing(double from_axis, double below)
{
    const double turned = pi - 2 * asin(from_axis);
    const double y = sqrt(1 - from_axis * from_axis);
    return turned < pi / 2 ? from_axis + (below + y) * tan(turned) : HUGE_VAL;
}

/* Light that lands within a radius, over what falls on the ball. */
static double expected_within(double radius, double below)
{
    const int count = 200000;
    double sum = 0;
    for (int i = 0; i < count; i++) {
        const double b = (i + 0.5) / count;
        const double passed = 1 - fresnel(b);
        if (landing(b, below) < radius)
            sum += passed * passed * 2 * b / count;
        if (reflected_landing(b, below) < radius)
            sum += (1 - passed) * 2 * b / count;
    }
    return sum;
}

/* Without the shadow all above 1 has come through the ball or from its outside. */
static double seen_within(const struct lit_floor *lit, double radius)
{
    double sum = 0;
    for (size_t i = 0; i < (size_t)SIDE * SIDE; i++) {
        const struct vec at = picture_at(lit->position, i);
        if (hypot(at.x, at.z) < radius)
            sum += ((double)lit->light[i] - 1) * lit->pixel / pi;
    }
    return sum;
}

static void check_ball(struct gpu *gpu, double below, bool roof)
{
    static const char *const no_shadow[] = { "sky.sun_elevation=90", "ice_caustics.shadow=off",
                                             "ice_caustics.ground=off", NULL };
    static const double radii[] = { 0.15, 0.2, 0.35, 0.5, 0.8, 1.6, 2.4 };
    struct scene scene = picture_sphere_scene((vec3s){ { 0, 0, 0 } }, 40000);
    add_level(&scene, 20, (float)-below);
    if (roof)
        add_level(&scene, 20, 3);
    struct lit_floor lit = draw(gpu, &scene, (float)-below, 5, no_shadow);
    for (size_t i = 0; i < sizeof(radii) / sizeof(radii[0]); i++) {
        const double seen = seen_within(&lit, radii[i]);
        const double expected = expected_within(radii[i], below);
        print_message("floor %g below, within %g: %.4f of %.4f\n", below, radii[i], seen, expected);
        CHECK_NEAR(seen, expected, 0.01);
    }
    render_result_finish(&lit.result);
    scene_finish(&scene);
}

/* Before the focus, where its outer rays cross the axis, and behind. */
static void a_ball_gathers_light(void **state)
{
    check_ball(*state, 1.05, false);
    check_ball(*state, 1.5, false);
    check_ball(*state, 2.1, false);
    check_ball(*state, 3, false);
}

static void a_roof_is_not_in_the_way(void **state)
{
    check_ball(*state, 1.5, true);
}

/* ---- a slab ---- */

static const struct vec slab = { 1.2, 0.3, 1.2 }; /* half sides */

static void add_side(struct mesh *mesh, struct vec normal, struct vec along)
{
    static const uint32_t order[6] = { 0, 1, 2, 0, 2, 3 };
    static const double corners[4][2] = { { -1, -1 }, { 1, -1 }, { 1, 1 }, { -1, 1 } };
    const struct vec across = vec_cross(normal, along);
    for (uint32_t i = 0; i < 4; i++) {
        const struct vec at = vec_add(vec_add(normal, corners[i][0], along), corners[i][1], across);
        mesh->vertices[mesh->vertex_count + i] = (struct mesh_vertex){
            .position = { { (float)(at.x * slab.x), (float)(at.y * slab.y),
                            (float)(at.z * slab.z) } },
            .normal = { { (float)normal.x, (float)normal.y, (float)normal.z } },
        };
    }
    for (uint32_t i = 0; i < 6; i++)
        mesh->indices[mesh->index_count + i] = mesh->vertex_count + order[i];
    mesh->vertex_count += 4;
    mesh->index_count += 6;
}

static struct scene slab_scene(void)
{
    static const struct vec axes[3] = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
    struct scene scene = { 0 };
    struct mesh *mesh = &scene.model.object;
    assert_true(mesh_init(mesh, 24, 36));
    mesh->vertex_count = mesh->index_count = 0;
    for (size_t i = 0; i < 3; i++) {
        add_side(mesh, axes[i], axes[(i + 1) % 3]);
        add_side(mesh, vec_scale(axes[i], -1), axes[(i + 1) % 3]);
    }
    scene.box = mesh_box(mesh);
    return scene;
}

struct slab_light {
    double shift;       /* along x, in the air below the slab */
    double inside;      /* the same, in the slab */
    double through;     /* share of light that two surfaces and the way leave */
    double outside;     /* fraction that the right side reflects */
    double inside_left; /* fraction that the left side reflects inside */
};

/* The sun stands on +x, `elevation` degrees high. */
static struct slab_light slab_light_of(double below, double absorption, double elevation)
{
    const double sine = cos(elevation * pi / 180);
    const double sine_inside = sine / index_ratio;
    const double cosine_inside = sqrt(1 - sine_inside * sine_inside);
    return (struct slab_light){
        .shift = (below - slab.y) * sine / sqrt(1 - sine * sine),
        .inside = 2 * slab.y * sine_inside / cosine_inside,
        .through = pow(1 - fresnel(sine), 2) * exp(-absorption * 2 * slab.y / cosine_inside),
        .outside = fresnel(sin(elevation * pi / 180)),
        .inside_left = fresnel(fmin(cosine_inside * index_ratio, 1)),
    };
}

/* Which light a place on the floor gets: 0 that of the sun alone, 1 that comes from the upper side
 * through the lower, 2 the same and as much that the left side has turned back (totally), 3 that of
 * the sun and what the right side reflects, -1 some of several. */
static int slab_zone(const struct slab_light *light, struct vec at)
{
    const double margin = 0.05;
    const double leaves = at.x + light->shift;
    const double enters = leaves + light->inside;
    const double turned = at.x - light->shift + slab.x;   /* from the left side's lower edge */
    const double mirrored = at.x - slab.x - light->shift; /* from the right side's lower edge */
    const double mirrored_all = light->shift / (0.9 - slab.y) * 2 * slab.y;
    if (fabs(at.z) < slab.z + margin && at.x > slab.x + margin && mirrored > -margin &&
        mirrored < mirrored_all + margin)
        return fabs(at.z) < slab.z - margin && mirrored > margin && mirrored < mirrored_all - margin
                   ? 3
                   : -1;
    if (fabs(at.z) > slab.z + margin || at.x > slab.x + margin)
        return 0;
    if (fabs(at.z) > slab.z - margin || leaves < -slab.x + margin || enters > slab.x - margin)
        return -1;
    if (turned > margin && turned < light->inside - margin)
        return 2;
    return turned < -margin || turned > light->inside + margin ? 1 : -1;
}

static void a_slab_takes_its_share(void **state)
{
    static const char *const slanted[] = { "sky.sun_elevation=50", "sky.sun_azimuth=90",
                                           "absorb.green=0.7", NULL };
    const double below = 0.9;
    const struct slab_light light = slab_light_of(below, 0.7, 50);
    const double expected[4] = { 1, light.through, 2 * light.through, 1 + light.outside };
    double sums[4] = { 0 };
    double counts[4] = { 0 };
    struct scene scene = slab_scene();
    add_level(&scene, 20, (float)-below);
    struct lit_floor lit = draw(*state, &scene, (float)-below, 5, slanted);
    for (size_t i = 0; i < (size_t)SIDE * SIDE; i++) {
        const int zone = slab_zone(&light, picture_at(lit.position, i));
        if (zone < 0)
            continue;
        sums[zone] += (double)lit.light[i];
        counts[zone]++;
    }
    for (size_t i = 0; i < 4; i++) {
        print_message("%zu: %.4f of %.4f, %.0f pixels\n", i, sums[i] / counts[i], expected[i],
                      counts[i]);
        assert_true(counts[i] > 2000);
        CHECK_NEAR(sums[i] / counts[i], expected[i], 0.01);
    }
    render_result_finish(&lit.result);
    scene_finish(&scene);
}

/* At a low sun, the left side reflects only a part, which leaves through the lower side. It lands
 * where the sun shines, too. */
static void light_leaves_after_a_partial_reflection(void **state)
{
    static const char *const low[] = { "sky.sun_elevation=25", "sky.sun_azimuth=90", NULL };
    const double below = 0.9, margin = 0.08;
    const struct slab_light light = slab_light_of(below, 0, 25);
    double sum = 0, count = 0;
    struct scene scene = slab_scene();
    add_level(&scene, 20, (float)-below);
    struct lit_floor lit = draw(*state, &scene, (float)-below, 3, low);
    for (size_t i = 0; i < (size_t)SIDE * SIDE; i++) {
        const struct vec at = picture_at(lit.position, i);
        const double turned = at.x - light.shift + slab.x;
        if (fabs(at.z) > slab.z - margin || turned < margin || turned > light.inside - margin)
            continue;
        sum += (double)lit.light[i];
        count++;
    }
    const double expected = 1 + light.through * light.inside_left;
    print_message("%.4f of %.4f, %.0f pixels\n", sum / count, expected, count);
    assert_true(count > 2000 && expected > 1.1);
    CHECK_NEAR(sum / count, expected, 0.01);
    render_result_finish(&lit.result);
    scene_finish(&scene);
}

/* ---- surroundings ---- */

/* The sun stands on +x, 50 degrees high, a level square above the floor. */
static void surroundings_shade_each_other(void **state)
{
    static const char *const slanted[] = { "sky.sun_elevation=50", "sky.sun_azimuth=90", NULL };
    const double half = 0.4, above = 0.3, below = 3, margin = 0.03;
    const double shift = above / tan(50 * pi / 180);
    double sums[2] = { 0 };
    double counts[2] = { 0 };
    struct scene scene = picture_sphere_scene((vec3s){ { 0, 0, -3 } }, 1000);
    add_level(&scene, 5, (float)-below);
    add_level(&scene, (float)half, (float)(above - below));
    struct lit_floor lit = draw(*state, &scene, (float)-below, 3, slanted);
    for (size_t i = 0; i < (size_t)SIDE * SIDE; i++) {
        const struct vec at = picture_at(lit.position, i);
        const double out = fmax(fabs(at.x + shift), fabs(at.z)) - half;
        if (fabs(out) < margin)
            continue;
        sums[out < 0] += (double)lit.light[i];
        counts[out < 0]++;
    }
    print_message("%.4f of 1, %.4f of 0\n", sums[0] / counts[0], sums[1] / counts[1]);
    assert_true(counts[0] > 2000 && counts[1] > 2000);
    CHECK_NEAR(sums[0] / counts[0], 1, 0.01);
    CHECK_NEAR(sums[1] / counts[1], 0, 0.001);
    render_result_finish(&lit.result);
    scene_finish(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_ball_gathers_light),
        cmocka_unit_test(a_roof_is_not_in_the_way),
        cmocka_unit_test(a_slab_takes_its_share),
        cmocka_unit_test(light_leaves_after_a_partial_reflection),
        cmocka_unit_test(surroundings_shade_each_other),
    };
    return RUN_ON_DEVICE(tests);
}
