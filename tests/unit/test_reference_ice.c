/*
 * test_reference_ice.c: inclusions and surface effects of ice in the reference renderer, against
 * closed forms.
 */
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>

#include "shaders/lighting/bump_normal.h"
#include "src/lab/reference/inclusion_shading.h"
#include "src/scene/generate/generate.h"
#include "tests/support/assertions.h"
#include "tests/support/bump_reference.h"
#include "tests/support/picture.h"
#include "tests/support/reference_ray.h"

static const double air = 1.0003;
static const double ice = 1.3091;

/* ---- scenes ---- */

/* A block of ice of 100 m across around the origin, in white. */
static struct scene block_scene(void)
{
    static const uint32_t corners[2][6] = { { 0, 2, 1, 1, 2, 3 }, { 0, 1, 2, 1, 3, 2 } };
    struct scene scene = { .background.kind = SCENE_COLOR, .background.color = glms_vec3_one() };
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

static void add_shape(struct scene *scene, struct bubble bubble)
{
    struct bubbles *bubbles = &scene->inclusions.bubbles;
    bubbles->all = realloc(bubbles->all, (bubbles->count + 1) * sizeof(*bubbles->all));
    assert_non_null(bubbles->all);
    bubbles->all[bubbles->count++] = bubble;
}

static void add_bubble(struct scene *scene, vec3s center, float radius)
{
    add_shape(scene, (struct bubble){ center, radius });
}

/* Adds a sheet 40 m wide, in the plane z = at, that faces +Z. */
static void add_sheet(struct mesh *mesh, float at)
{
    static const uint32_t corners[6] = { 0, 1, 3, 0, 3, 2 };
    struct mesh sheet;
    assert_true(mesh_init(&sheet, 4, 6));
    for (uint32_t i = 0; i < 4; i++) {
        const vec2s uv = { { (float)(i % 2), (float)(i > 1) } };
        sheet.vertices[i] = (struct mesh_vertex){
            .position = { { 40 * uv.x - 20, 40 * uv.y - 20, at } },
            .normal = { { 0, 0, 1 } },
            .color = glms_vec3_one(),
            .uv = uv,
            .material = 1,
        };
    }
    for (uint32_t i = 0; i < 6; i++)
        sheet.indices[i] = corners[i];
    assert_true(mesh_append(mesh, &sheet));
    mesh_finish(&sheet);
}

/* The angle outside of light that leaves the block, of one inside. */
static double outside_of(double inside)
{
    return asin(ice / air * sin(inside));
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
        const double turn = table[i][1] * REFERENCE_RAY_PI / 180;
        const struct reference_ray seen = reference_ray_trace(
            &scene, &settings, (struct vec){ b, 0, 0 }, reference_ray_direction(0));
        assert_true(vec_angle_deg(seen.exit, reference_ray_direction(outside_of(turn))) < 0.001);
        CHECK_NEAR(seen.fresnel, reference_ray_fresnel(asin(b), ice, air), 1e-6);
        CHECK_NEAR(seen.position.x, b, 1e-6);
        CHECK_NEAR(seen.position.z, -5 + sqrt(1 - b * b), 1e-6);
        CHECK_NEAR(seen.tir, 0, 0);
    }
    const struct reference_ray rim = reference_ray_trace(
        &scene, &settings, (struct vec){ 0.77, 0, 0 }, reference_ray_direction(0));
    CHECK_NEAR(rim.fresnel, 1, 0); /* beyond 1.0003 / 1.3091 */
    scene_finish(&scene);
}

/* Snell's law for an angle of incidence. */
static double bent(double angle, double n1, double n2)
{
    return asin(n1 / n2 * sin(angle));
}

/* Returns the angle from -Z toward +X of light that has gone along -Z, at a distance `x` from the
 * centre, through an ellipse of half axes `a`, turned by an angle from +X toward +Z, and `c`. */
static double through_ellipse(double x, double a, double c, double turn)
{
    double cosine = cos(turn), sine = sin(turn), angle = 0;
    /* in its own axes: the light's way, and where it is */
    double at[2] = { x * cosine + 9 * sine, -x * sine + 9 * cosine };
    for (int side = 0; side < 2; side++) {
        const double dir[2] = { sin(angle) * cosine - cos(angle) * sine,
                                -sin(angle) * sine - cos(angle) * cosine };
        const double p = dir[0] * dir[0] / (a * a) + dir[1] * dir[1] / (c * c);
        const double q = dir[0] * at[0] / (a * a) + dir[1] * at[1] / (c * c);
        const double r = at[0] * at[0] / (a * a) + at[1] * at[1] / (c * c) - 1;
        const double t = side ? -2 * q / p : (-q - sqrt(q * q - p * r)) / p;
        at[0] += t * dir[0];
        at[1] += t * dir[1];
        /* of the normal, from +Z toward +X in the world; light from above it is turned */
        const double normal = atan2(at[0] / (a * a), at[1] / (c * c)) - turn;
        const double in = side ? angle + normal - REFERENCE_RAY_PI : angle + normal;
        angle += side ? bent(in, air, ice) - in : bent(in, ice, air) - in;
    }
    return angle;
}

/* Ellipsoids, however they lie, and the three ways through a capsule. */
static void test_shapes(void **state)
{
    static const double turns[] = { 0, 60, 90, 110 };
    const struct settings settings = settings_default();
    (void)state;
    for (size_t i = 0; i < 11; i++) {
        const double turn = turns[i % 4] * REFERENCE_RAY_PI / 180, x = 0.05 * ((double)i - 5);
        const double stretch = i / 4 == 1 ? -0.5 : 1;
        struct scene scene = block_scene();
        add_shape(&scene, (struct bubble){
                              .center = { { 1, 2, -5 } },
                              .radius = 1,
                              .stretch = (float)stretch,
                              .axis = { { (float)cos(turn), 0, (float)sin(turn) } },
                          });
        const double out = outside_of(through_ellipse(x, 1 + stretch, 1, turn));
        const struct reference_ray seen = reference_ray_trace(
            &scene, &settings, (struct vec){ 1 + x, 2, 0 }, reference_ray_direction(0));
        assert_true(vec_angle_deg(seen.exit, reference_ray_direction(out)) < 0.001);
        scene_finish(&scene);
    }
}

/* Across it a capsule is a sphere, along it a pane; what enters its end leaves by its side. */
static void test_capsule(void **state)
{
    const struct settings settings = settings_default();
    struct bubble worm = { .center = { { 0, 0, -5 } }, .radius = 1, .stretch = 3 };
    (void)state;
    worm.is_capsule = true;
    for (int axis = 0; axis < 3; axis++) {
        struct scene scene = block_scene();
        worm.axis = (vec3s){ { (float)(axis == 0), (float)(axis == 1), (float)(axis == 2) } };
        add_shape(&scene, worm);
        const double b = axis == 2 ? 0.6 : 0.4;
        const double inner = asin(b) - bent(asin(b), ice, air); /* below 0: outward */
        const double side = REFERENCE_RAY_PI / 2 - asin(air / ice * cos(inner));
        const double turns[3] = { 0, -2 * inner, side };
        const struct reference_ray seen = reference_ray_trace(
            &scene, &settings, (struct vec){ b, 0, 0 }, reference_ray_direction(0));
        assert_true(vec_angle_deg(seen.exit, reference_ray_direction(outside_of(turns[axis]))) <
                    0.001);
        CHECK_NEAR(seen.z, axis == 2 ? 2 - sqrt(1 - b * b) : 5 - (axis == 1 ? sqrt(1 - b * b) : 1),
                   1e-6);
        CHECK_NEAR(seen.fresnel, reference_ray_fresnel(axis == 0 ? 0 : asin(b), ice, air), 1e-6);
        scene_finish(&scene);
    }
}

/* Where a bubble reaches out of the ice, its surface is between air and air; so is that of the ice
 * inside of the bubble. */
static void test_bubble_in_the_surface(void **state)
{
    const struct settings settings = settings_default();
    struct scene scene = block_scene();
    (void)state;
    add_bubble(&scene, (vec3s){ { 0, 0, 50 } }, 1);
    struct reference_ray seen = reference_ray_trace(&scene, &settings, (struct vec){ 0.5, 0, 60 },
                                                    reference_ray_direction(0));
    CHECK_NEAR(seen.z, 10 + sqrt(0.75), 1e-5); /* the pit's floor, which the bubble leaves */
    CHECK_NEAR(seen.fresnel, reference_ray_fresnel(REFERENCE_RAY_PI / 6, air, ice), 1e-5);
    seen = reference_ray_trace(&scene, &settings, (struct vec){ 0, 0, 50.5 },
                               reference_ray_direction(0));
    CHECK_NEAR(seen.z, 1.5, 1e-5); /* the eye inside the bubble, outside of the ice */
    seen = reference_ray_trace(&scene, &settings, (struct vec){ 0, 0, 49.5 },
                               reference_ray_direction(0));
    CHECK_NEAR(seen.z, 0.5, 1e-5); /* inside both */
    scene_finish(&scene);
}

/* ---- cracks ---- */

/* A crack reflects R_gap, and sends the rest straight on; the eye is in the ice. From either side,
 * and twice as many cracks reflect what stacks of plates do. */
static void test_crack(void **state)
{
    static const double table[][2] = {
        { 0, .0351309 }, { 30, .0433238 }, { 45, .1869719 }, { 48, .3850670 }, { 49.8, .9083175 }
    };
    const struct settings settings = SETTINGS("cracks.bump=0", "cracks.gap=1000");
    struct scene scene = block_scene();
    (void)state;
    add_sheet(&scene.inclusions.cracks, -2);
    for (size_t i = 0; i < sizeof(table) / sizeof(table[0]); i++) {
        const double in = table[i][0] * REFERENCE_RAY_PI / 180;
        for (int back = 0; back < 2; back++) {
            const double turn = back ? REFERENCE_RAY_PI - in : in;
            const struct reference_ray seen =
                reference_ray_trace(&scene, &settings, (struct vec){ 0, 0, back ? -4 : 0 },
                                    reference_ray_direction(turn));
            CHECK_NEAR(seen.fresnel, table[i][1], 2e-5);
            CHECK_NEAR(seen.z, 2 / cos(in), 1e-4);
            if (in > 0.7) /* it meets another side of the block first */
                continue;
            const double out = outside_of(in);
            assert_true(vec_angle_deg(seen.exit, reference_ray_direction(
                                                     back ? REFERENCE_RAY_PI - out : out)) < 0.01);
        }
    }
    const struct reference_ray beyond = reference_ray_trace(
        &scene, &settings, (struct vec){ 0, 0, 0 }, reference_ray_direction(0.9));
    CHECK_NEAR(beyond.fresnel, 1, 0);
    scene_finish(&scene);
}

/* Outside of the ice, and in a bubble, a crack is air in air. */
static void test_crack_in_air(void **state)
{
    const struct settings settings = settings_default();
    struct scene scene = block_scene();
    (void)state;
    add_sheet(&scene.inclusions.cracks, 52);
    add_sheet(&scene.inclusions.cracks, -5);
    add_bubble(&scene, (vec3s){ { 0, 0, -5 } }, 1);
    struct reference_ray seen = reference_ray_trace(&scene, &settings, (struct vec){ 0, 0, 60 },
                                                    reference_ray_direction(0));
    CHECK_NEAR(seen.z, 10, 1e-4);
    seen = reference_ray_trace(&scene, &settings, (struct vec){ 0, 0, -4.5 },
                               reference_ray_direction(0));
    CHECK_NEAR(seen.z, 1.5, 1e-5);
    seen = reference_ray_trace(&scene, &settings, (struct vec){ 1.5, 0, -4.5 },
                               reference_ray_direction(0));
    CHECK_NEAR(seen.z, 0.5, 1e-5);
    scene_finish(&scene);
}

/* ---- planes of air ---- */

/* A plane covers what is behind by its bubbles and its haze, less when it is seen nearly edge on;
 * it is as bright as the background. Outside of the ice it is nothing. */
static void test_air(void **state)
{
    const struct settings settings = SETTINGS("reference.russian_roulette=off", "air.strength=0.5",
                                              "air.haze=0.25", "reference.bounces=1");
    const double clear = (1 - 0.5 * 102 / 255) * (1 - 0.25 * 51 / 255);
    const double edge = (1 - 0.25 * 102 / 255) * (1 - 0.125 * 51 / 255);
    struct scene scene = block_scene();
    uint8_t texels[8];
    (void)state;
    for (int i = 0; i < 8; i++)
        texels[i] = i % 2 ? 51 : 102;
    scene.inclusions.air_layers = (struct air_layers){ texels, 2, 1 };
    scene.background.color = (vec3s){ { 1, 0.5F, 2 } };
    add_sheet(&scene.inclusions.air, 52);
    add_sheet(&scene.inclusions.air, -1);
    add_sheet(&scene.inclusions.air, -2);
    struct reference_ray seen =
        reference_ray_trace(&scene, &settings, (struct vec){ 1, 2, 0 }, reference_ray_direction(0));
    const double cover = 1 - clear * clear;
    assert_true(vec_difference(seen.color, (struct vec){ cover, cover / 2, cover * 2 }) < 1e-5);
    CHECK_NEAR(seen.z, 50, 1e-3);
    CHECK_NEAR(seen.remaining.x, 1 - cover, 1e-5);
    seen = reference_ray_trace(&scene, &settings, (struct vec){ 0, 0, -1.5 },
                               reference_ray_direction(acos(0.15)));
    CHECK_NEAR(seen.color.x, 1 - edge, 1e-5);
    seen = reference_ray_trace(&scene, &settings, (struct vec){ 0, 0, 60 },
                               reference_ray_direction(0));
    CHECK_NEAR(seen.color.x, 0, 0);
    scene.inclusions.air_layers = (struct air_layers){ 0 };
    scene_finish(&scene);
}

/* A path notes what it meets on its way out: nothing, or any of the three, added. */
static void test_met(void **state)
{
    const struct settings settings = SETTINGS("cracks.bump=0", "air.strength=0.5", "air.haze=0");
    struct scene scene = block_scene();
    uint8_t texels[8];
    (void)state;
    for (int i = 0; i < 8; i++)
        texels[i] = 255;
    scene.inclusions.air_layers = (struct air_layers){ texels, 2, 1 };
    add_bubble(&scene, (vec3s){ { 0, 0, -5 } }, 1);
    add_bubble(&scene, (vec3s){ { 30, 0, -5 } }, 1);
    add_sheet(&scene.inclusions.cracks, -10);
    add_sheet(&scene.inclusions.air, -20);

    static const struct {
        double x, z, inclusion_bits;
    } table[] = { { 40, 0, 0 }, { 30, 0, 1 }, { 10, -15, 4 }, { 10, 0, 6 }, { 0.1, 0, 7 } };

    for (size_t i = 0; i < sizeof(table) / sizeof(table[0]); i++) {
        const struct vec eye = { table[i].x, 0, 60 }, inner = { table[i].x, 0, table[i].z };
        CHECK_NEAR(reference_ray_trace(&scene, &settings, inner, reference_ray_direction(0))
                       .inclusion_bits,
                   table[i].inclusion_bits, 0);
        if (table[i].z >= 0)
            CHECK_NEAR(reference_ray_trace(&scene, &settings, eye, reference_ray_direction(0))
                           .inclusion_bits,
                       table[i].inclusion_bits, 0);
    }
    scene.inclusions.air_layers = (struct air_layers){ 0 };
    scene_finish(&scene);
}

/* ---- bumps and frost ---- */

static struct globals globals_of_turn(double turn)
{
    return (struct globals){
        .world_from_object = glms_rotate_make((float)turn, (vec3s){ { 0, 1, 0 } }),
        .bump_strength = 0.5F,
        .bump_scale = 1,
        .radius = 1,
    };
}

static struct vec world_normal(const struct inclusions_surface *surface, struct vec n, struct vec e)
{
    const vec3s normal = { { (float)n.x, (float)n.y, (float)n.z } };
    const vec3s from_eye = { { (float)e.x, (float)e.y, (float)e.z } };
    return vec_from(bump_facing(surface->normal, normal, from_eye));
}

/* The normals of an even map on three planes are those that the rasteriser's test wants, too. */
static void test_bumps_on_planes(void **state)
{
    static const struct vec e = { 0, 0, -1 };
    const struct settings settings = SETTINGS("frost.amount=0.5");
    struct scene scene = block_scene();
    (void)state;
    bump_reference_make_constant(&scene, 0.8, -0.4, 0.25, 0.5);
    for (int i = 0; i < 200; i++) {
        const double up = 0.99 * sin(0.7 * i);
        const double flat = sqrt(1 - up * up);
        const struct vec n = { flat * sin(1.4 * cos(i)), up, flat * cos(1.4 * cos(i)) };
        const struct bumps bumps = { 0.8 * 0.5 * 0.75, -0.4 * 0.5 * 0.75, 0.1 * i };
        const struct globals globals = globals_of_turn(bumps.turn);
        const struct radiance radiance = radiance_of(&scene, &globals);
        const struct inclusions inclusions = inclusions_of(&radiance, &settings);
        const vec3s normal = { { (float)n.x, (float)n.y, (float)n.z } };
        const struct embree_scene_hit hit = { .surface = { .position = normal } };
        const struct inclusions_surface found =
            inclusions_surface_at(&inclusions, NULL, &hit, normal);
        assert_true(
            vec_difference(world_normal(&found, n, e), bump_reference_normal(&bumps, n, e)) < 1e-3);
        CHECK_NEAR(found.frost, 0.5 * 0.75 * 0.5, 1e-3);
    }
    scene_finish(&scene);
}

/* Slopes rise with u and v, whichever way these go, and the triangle is wound. */
static void test_bumps_by_uv(void **state)
{
    const struct settings settings = SETTINGS("bump.mapping=uv");
    struct scene scene = block_scene();
    struct mesh *box = &scene.model.object;
    vec3s positions[24];
    (void)state;
    bump_reference_make_constant(&scene, 0.8, -0.4, 0, 0);
    for (int mirrored = 0; mirrored < 2; mirrored++) {
        const double sign = mirrored ? -1 : 1;
        for (uint32_t i = 0; i < box->vertex_count; i++) {
            const vec3s p = positions[i] = box->vertices[i].position;
            box->vertices[i].uv = (vec2s){ { p.x * (float)sign, p.y * 0.3F } };
        }
        const struct globals globals = globals_of_turn(0);
        const struct radiance radiance = radiance_of(&scene, &globals);
        const struct inclusions inclusions = inclusions_of(&radiance, &settings);
        const struct embree_scene embree_scene = { .meshes[EMBREE_SCENE_OBJECT] = { box,
                                                                                    positions } };
        for (uint32_t triangle = 10; triangle < 12; triangle++) { /* of the side at z = 50 */
            const float out = triangle == 10 ? 1 : -1;
            const struct vec n = { 0, 0, (double)out }, e = { 0, 0, -(double)out };
            const struct embree_scene_hit hit = { .triangle = triangle };
            const struct inclusions_surface found =
                inclusions_surface_at(&inclusions, &embree_scene, &hit, (vec3s){ { 0, 0, out } });
            const struct vec gradient = { 0.4 * sign, -0.2, 0 };
            assert_true(vec_difference(world_normal(&found, n, e),
                                       bump_reference_perturb(gradient, n, e)) < 1e-3);
        }
    }
    scene_finish(&scene);
}

/* Light meets the bumpy normal where it enters and where it leaves: a pane of parallel slopes sends
 * it on in its direction, and Fresnel's share is that of the slope. */
static void test_bumpy_pane(void **state)
{
    const struct settings settings = SETTINGS("bump.strength=0.5");
    struct scene scene = block_scene();
    (void)state;
    bump_reference_make_constant(&scene, 0.4, 0, 0, 0); /* on the sides across z: along x */
    const struct reference_ray seen = reference_ray_trace(
        &scene, &settings, (struct vec){ 3, 2, 60 }, reference_ray_direction(0));
    CHECK_NEAR(seen.fresnel, reference_ray_fresnel(atan(0.2), air, ice), 1e-4);
    const double inside = atan(0.2) - asin(air / ice * sin(atan(0.2)));
    const double in = atan(0.2) + inside; /* at the far side, which slopes the other way */
    assert_true(vec_angle_deg(seen.exit, reference_ray_direction(asin(ice / air * sin(in)) -
                                                                 atan(0.2))) < 0.05);
    scene_finish(&scene);
}

/* The triangle decides on which side light is: what bumps would send to the wrong one goes as from
 * an even surface. */
static void test_bumps_keep_sides(void **state)
{
    const struct settings settings = SETTINGS("bump.strength=0.5");
    const double in = 75 * REFERENCE_RAY_PI / 180;
    struct scene scene = block_scene();
    (void)state;
    bump_reference_make_constant(&scene, -1.2, 0, 0, 0);
    struct reference_ray seen = reference_ray_trace(&scene, &settings, (struct vec){ 0, 0, -49 },
                                                    reference_ray_direction(in));
    CHECK_NEAR(seen.fresnel, 1, 0); /* as an even surface; by the slope it would leave upwards */
    picture_use_directions(&scene, 1024);
    bump_reference_make_constant(&scene, -0.6, 0, 0, 0);
    seen = reference_ray_trace(&scene, &settings, (struct vec){ -20, 0, 55 },
                               reference_ray_direction(in));
    const struct vec up = picture_direction_color(reference_ray_direction(REFERENCE_RAY_PI - in));
    assert_true(vec_difference(seen.reflection, up) < 0.02);
    scene_finish(&scene);
}

/* What a map with crystals everywhere makes of ice is what a rough material is. */
static void test_frost_is_roughness(void **state)
{
    struct render_result results[2];
    (void)state;
    for (int i = 0; i < 2; i++) {
        const struct settings settings = SETTINGS(i ? "frost.amount=1" : "frost.amount=0",
                                                  "bump.strength=0", "frost.roughness=0.5");
        struct scene scene = picture_sphere_scene(glms_vec3_zero(), 960);
        struct object object = { .index_count = scene.model.object.index_count, .rank = 1 };
        struct material material = material_make("ice");
        material.transmission = 1;
        material.thickness = 1;
        material.ior = 1.3F;
        material.roughness = i ? 0 : 0.5F;
        scene.background.kind = SCENE_COLOR;
        scene.background.color = glms_vec3_one();
        scene.model.objects = &object;
        scene.model.materials = &material;
        scene.model.object_count = scene.model.material_count = 1;
        bump_reference_make_constant(&scene, 0, 0, 0, 1);
        const struct reference_request request = {
            .scene = &scene,
            .settings = &settings,
            .width = 16,
            .height = 16,
            .samples = 4,
            .linear = true,
        };
        const struct renderer_shot shot = { .camera = { .eye = { { 0, 0, 6 } }, .fov_deg = 18 } };
        results[i] = reference_ray_render_image(&request, &shot);
        scene.model.objects = NULL;
        scene.model.materials = NULL;
        scene.model.object_count = scene.model.material_count = 0;
        scene_finish(&scene);
    }
    const float *a = image_find(&results[0].image, "R"), *b = image_find(&results[1].image, "R");
    double loss = 0;
    for (size_t k = 0; k < 256; k++) {
        assert_true(a[k] == b[k]);
        loss += 1 - (double)a[k];
    }
    assert_true(loss > 10);
    for (int i = 0; i < 2; i++)
        render_result_finish(&results[i]);
}

/* ---- all of it ---- */

/* A cube of ice with all that ice may have. */
static struct scene whole_scene(void)
{
    const struct generate_bubbles bubbles = {
        .count = 30, .seed = 1, .size = 0.1F, .shape = GENERATE_BUBBLES_MIXED, .stretch = 3
    };
    const struct generate_air planes = { 5, 1, 0.02F, 12 };
    const struct bump_maps_params bumps = { 0.4F, 0 };
    struct scene scene = { .background.kind = SCENE_COLOR, .background.color = glms_vec3_one() };
    assert_true(generate_ice_cube(&scene.model.object, 1200));
    scene.box = mesh_box(&scene.model.object);
    assert_true(generate_bubbles(&scene.inclusions.bubbles, &scene.model.object, &bubbles));
    const struct generate_cracks params = { 3, 1, 1 };
    assert_true(
        generate_cracks(&scene.inclusions.cracks, scene.box, &params, &scene.files.crack_sheet));
    assert_true(generate_air_planes(&scene.inclusions.air, scene.box, &planes));
    assert_true(generate_air_layers(&scene.inclusions.air_layers, &planes));
    assert_true(bump_maps_init(&scene.bump, &bumps));
    return scene;
}

enum {
    WHOLE_SIDE = 20, /* pixels */
};

static struct render_result whole_picture(const struct scene *scene,
                                          const struct settings *settings, uint32_t threads,
                                          uint64_t layers)
{
    const struct reference_request request = {
        .scene = scene,
        .settings = settings,
        .width = WHOLE_SIDE,
        .height = WHOLE_SIDE,
        .samples = 2,
        .layers = layers,
        .linear = true,
        .threads = threads,
    };
    const struct renderer_shot shot = { .camera = { .eye = { { 1, 1.5F, 3 } }, .fov_deg = 40 } };
    return reference_ray_render_image(&request, &shot);
}

/* In light of 1, ice shows 1, but for what rough surfaces lose; never more. */
static void test_white_furnace(void **state)
{
    static const char *const frosts[] = { "frost.amount=0", "frost.amount=0.7" };
    struct scene scene = whole_scene();
    (void)state;
    for (int frosty = 0; frosty < 2; frosty++) {
        const struct settings settings = SETTINGS("reference.russian_roulette=off", frosts[frosty],
                                                  "bump.strength=0.5", "reference.cutoff=0.01");
        struct render_result result = whole_picture(&scene, &settings, 0, reference_ray_layers());
        const float *red = image_find(&result.image, "R");
        const float *rest = image_find(&result.image, "remaining.R");
        const float *path = image_find(&result.image, "path.Z");
        double lost = 0;
        size_t count = 0;
        for (size_t k = 0; k < (size_t)WHOLE_SIDE * WHOLE_SIDE; k++) {
            const double all = (double)red[k] + (double)rest[k];
            assert_true(all < 1 + 1e-5);
            assert_true(frosty || all > 1 - 1e-5);
            count += path[k] > 0;
            lost += 1 - all;
        }
        assert_true(count > 100);
        assert_true(!frosty || (lost > 0.01 * (double)count && lost < 0.3 * (double)count));
        render_result_finish(&result);
    }
    scene_finish(&scene);
}

/* The pixels of a picture do not depend on which thread traces them, nor on layers beside it. */
static void test_threads(void **state)
{
    const struct settings settings = SETTINGS("frost.amount=0.7", "reference.cutoff=0.05");
    struct scene scene = whole_scene();
    struct render_result one = whole_picture(&scene, &settings, 1, reference_ray_layers());
    struct render_result four = whole_picture(&scene, &settings, 4, reference_ray_layers());
    struct render_result bare = whole_picture(&scene, &settings, 1, 0);
    (void)state;
    for (uint32_t i = 0; i < one.image.plane_count; i++)
        assert_memory_equal(one.image.planes[i].texels, four.image.planes[i].texels,
                            sizeof(float) * WHOLE_SIDE * WHOLE_SIDE);
    assert_int_equal(bare.image.plane_count, 4);
    for (uint32_t i = 0; i < bare.image.plane_count; i++)
        assert_memory_equal(image_find(&one.image, bare.image.planes[i].name),
                            bare.image.planes[i].texels, sizeof(float) * WHOLE_SIDE * WHOLE_SIDE);
    render_result_finish(&one);
    render_result_finish(&four);
    render_result_finish(&bare);
    scene_finish(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_bubble),
        cmocka_unit_test(test_shapes),
        cmocka_unit_test(test_capsule),
        cmocka_unit_test(test_bubble_in_the_surface),
        cmocka_unit_test(test_crack),
        cmocka_unit_test(test_crack_in_air),
        cmocka_unit_test(test_air),
        cmocka_unit_test(test_met),
        cmocka_unit_test(test_bumps_on_planes),
        cmocka_unit_test(test_bumps_by_uv),
        cmocka_unit_test(test_bumpy_pane),
        cmocka_unit_test(test_bumps_keep_sides),
        cmocka_unit_test(test_frost_is_roughness),
        cmocka_unit_test(test_white_furnace),
        cmocka_unit_test(test_threads),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
