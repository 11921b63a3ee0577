/*
 * test_optics.c: lib/optics.glsl, bubble_deflection.glsl and box_projection.glsl, run on a device,
 * against vectors worked out elsewhere in double precision (tests/data/oracles.json) and against
 * closed forms.
 *
 * Vectors: e goes towards the surface, the front normal against it; "inside" and "chord" are those
 * of a ray that enters a unit sphere of ice along -z, x being its impact parameter.
 */
#include <cglm/struct.h>
#include <math.h>

#include "tests/support/assertions.h"

#include "src/scene/generate/random.h"
#include "src/scene/scene.h"
#include "tests/gpu/optics_ask.h"
#include "tests/support/lavapipe.h"
#include "tests/support/vec.h"

/* ---- the vectors ---- */

static void blended_normals(void **state)
{
    enum {
        COUNT = 16
    };
    struct optics_question asked[COUNT];
    struct optics_answer got[COUNT];
    json_t *oracles = load(ORACLES);
    const json_t *cases = get_cases(oracles, "blend", COUNT);
    const double eta = get_number(oracles, "air") / get_number(oracles, "ice");
    for (size_t i = 0; i < COUNT; i++) {
        const json_t *row = json_array_get(cases, i);
        asked[i] = (struct optics_question){
            .e = get_vector(row, "e"),
            .front = get_vector(row, "front_normal"),
            .back = get_vector(row, "back_normal"),
            .a = (float)get_number(row, "a"),
            .eta = (float)eta,
        };
    }
    ask(*state, asked, got, COUNT);
    for (size_t i = 0; i < COUNT; i++) {
        const json_t *row = json_array_get(cases, i);
        check_vector(got[i].blended, get_vector(row, "blended"));
        check_vector(got[i].refracted, get_vector(row, "refracted"));
        check_vector(got[i].reflected, get_vector(row, "reflected"));
        CHECK_NEAR(got[i].fresnel_paper, get_number(row, "fresnel_paper"), tolerance);
        CHECK_NEAR(got[i].fresnel, get_number(row, "fresnel_exact"), tolerance);
        for (size_t c = 0; c < 3; c++) {
            const double f = (double)got[i].fresnel;
            CHECK_NEAR(got[i].composed.raw[c],
                       f * (double)got[i].reflected.raw[c] +
                           (1 - f) * (double)got[i].refracted.raw[c],
                       tolerance);
        }
    }
    json_decref(oracles);
}

static void refracted_or_reflected(void **state)
{
    enum {
        COUNT = 28
    };
    struct optics_question asked[COUNT];
    struct optics_answer got[COUNT];
    json_t *oracles = load(ORACLES);
    const json_t *cases = get_cases(oracles, "refract", COUNT);
    int total = 0;
    for (size_t i = 0; i < COUNT; i++) {
        const json_t *row = json_array_get(cases, i);
        asked[i] = (struct optics_question){
            .e = get_vector(row, "e"),
            .front = get_vector(row, "n"),
            .eta = (float)(get_number(row, "n1") / get_number(row, "n2")),
        };
    }
    ask(*state, asked, got, COUNT);
    for (size_t i = 0; i < COUNT; i++) {
        const json_t *row = json_array_get(cases, i);
        const json_t *tir = json_object_get(row, "total_internal_reflection");
        assert_true(json_is_boolean(tir));
        CHECK_NEAR(got[i].fresnel, get_number(row, "fresnel"), tolerance);
        if (json_is_true(tir)) {
            const vec3s e = asked[i].e;
            const vec3s n = asked[i].front;
            const float c = 2 * glms_vec3_dot(e, n);
            total++;
            assert_true(got[i].k < 0);
            check_vector(got[i].refracted, glms_vec3_sub(e, glms_vec3_scale(n, c)));
            CHECK_NEAR(got[i].fresnel, 1, 0);
        } else {
            assert_true(got[i].k >= 0);
            check_vector(got[i].refracted, get_vector(row, "refracted"));
        }
        CHECK_NEAR(glms_vec3_norm(got[i].refracted), 1, tolerance);
    }
    assert_int_equal(total, 9);
    json_decref(oracles);
}

/* In at the one side, out at the other. */
static void through_a_sphere(void **state)
{
    enum {
        COUNT = 12
    };
    struct optics_question asked[2 * COUNT];
    struct optics_answer got[2 * COUNT];
    json_t *oracles = load(ORACLES);
    const json_t *cases = get_cases(oracles, "sphere_two_interfaces", COUNT);
    const double eta = get_number(oracles, "air") / get_number(oracles, "ice");
    const vec3s e = { { 0, 0, -1 } };
    for (size_t i = 0; i < COUNT; i++) {
        const json_t *row = json_array_get(cases, i);
        const double x = get_number(row, "impact");
        asked[2 * i] = (struct optics_question){
            .e = e,
            .front = { { (float)x, 0, (float)sqrt(1 - x * x) } },
            .eta = (float)eta,
        };
        asked[2 * i + 1] = (struct optics_question){
            .e = get_vector(row, "inside"),
            .front = glms_vec3_negate(get_vector(row, "exit_point")),
            .eta = (float)(1 / eta),
        };
    }
    ask(*state, asked, got, 2 * COUNT);
    for (size_t i = 0; i < COUNT; i++) {
        const json_t *row = json_array_get(cases, i);
        const vec3s out = got[2 * i + 1].refracted;
        check_vector(got[2 * i].refracted, get_vector(row, "inside"));
        check_vector(out, get_vector(row, "exit_direction"));
        CHECK_NEAR(atan2(hypot((double)out.x, (double)out.y), -(double)out.z),
                   get_number(row, "deviation_deg") * acos(-1) / 180, tolerance);
    }
    json_decref(oracles);
}

/* ---- bubbles ---- */

static double turn_deg(vec2s turn)
{
    CHECK_NEAR(glms_vec2_norm(turn), 1, tolerance);
    return atan2((double)turn.y, (double)turn.x) * 180 / acos(-1);
}

static void through_a_bubble(void **state)
{
    enum {
        COUNT = 8
    };
    struct optics_question asked[COUNT];
    struct optics_answer got[COUNT];
    json_t *oracles = load(ORACLES);
    const json_t *cases = get_cases(oracles, "bubble", COUNT);
    const double eta = get_number(oracles, "ice") / get_number(oracles, "air");
    int total = 0;
    for (size_t i = 0; i < COUNT; i++) {
        const double b = get_number(json_array_get(cases, i), "impact");
        asked[i] = (struct optics_question){ .b = (float)b, .eta = (float)eta };
    }
    ask(*state, asked, got, COUNT);
    for (size_t i = 0; i < COUNT; i++) {
        const json_t *row = json_array_get(cases, i);
        const bool tir = json_is_true(json_object_get(row, "total_internal_reflection"));
        const vec2s turn = tir ? got[i].bubble_reflected : got[i].bubble_transmitted;
        CHECK_NEAR(turn_deg(turn), get_number(row, "deviation_deg"), 1e-3);
        assert_true(tir == (get_number(row, "impact") * eta > 1));
        total += tir;
    }
    assert_int_equal(total, 3);
    json_decref(oracles);
}

/* Straight through the middle and back from it; on both sides of total reflection alike. */
static void ends_of_a_bubble(void **state)
{
    enum {
        COUNT = 6
    };

    const double eta = 1.3091 / 1.0003;
    const double at[COUNT] = { 0, 0.2, 0.4, 0.6, 1 / eta, 1 };
    const double passed[COUNT - 1] = { 0, 7.2729, 15.9760, 29.7431, 2 * (90 - 49.8281) };
    struct optics_question asked[COUNT];
    struct optics_answer got[COUNT];
    for (size_t i = 0; i < COUNT; i++)
        asked[i] = (struct optics_question){ .b = (float)at[i], .eta = (float)eta };
    ask(*state, asked, got, COUNT);
    for (size_t i = 0; i < COUNT - 1; i++) /* near the limit, by the root of the rounding */
        CHECK_NEAR(turn_deg(got[i].bubble_transmitted), passed[i], i < 4 ? 1e-3 : 0.1);
    CHECK_NEAR(turn_deg(got[0].bubble_reflected), 180, 1e-3);
    CHECK_NEAR(turn_deg(got[4].bubble_reflected), passed[4], 1e-3);
    CHECK_NEAR(turn_deg(got[5].bubble_reflected), 0, 1e-3);
}

/* ---- closed forms ---- */

/* Light that comes in at an angle to the normal, which is +y. */
static struct optics_question at_angle(double degrees, double n1, double n2)
{
    const double angle = degrees * acos(-1) / 180;
    return (struct optics_question){
        .e = { { (float)sin(angle), -(float)cos(angle), 0 } },
        .front = { { 0, 1, 0 } },
        .eta = (float)(n1 / n2),
    };
}

static void closed_forms(void **state)
{
    const double air = 1.0003;
    const double ice = 1.3091;
    const double critical = asin(air / ice) * 180 / acos(-1);
    struct optics_question asked[] = {
        at_angle(0, air, ice),
        at_angle(0, ice, air),
        at_angle(60, air, ice),
        at_angle(60, air, ice),
        at_angle(critical - 0.01, ice, air),
        at_angle(critical + 0.01, ice, air),
        at_angle(30, ice, ice),
    };

    enum {
        COUNT = sizeof(asked) / sizeof(asked[0])
    };

    struct optics_answer got[COUNT];
    asked[3].front = glms_vec3_negate(asked[3].front);
    ask(*state, asked, got, COUNT);

    CHECK_NEAR(critical, 49.8281, 5e-5);
    CHECK_NEAR(got[0].fresnel, 0.017879537, 1e-7);
    CHECK_NEAR(got[1].fresnel, 0.017879537, 1e-7);
    CHECK_NEAR(got[0].fresnel_paper, 0, 1e-7);
    for (size_t i = 2; i < 4; i++) { /* whichever way the normal points */
        CHECK_NEAR(got[i].fresnel_paper, 0.125, 1e-6);
        CHECK_NEAR(got[i].fresnel, 0.0551, 5e-5);
    }
    assert_true(got[4].k > 0);
    assert_true(got[4].fresnel < 1);
    assert_true(got[4].refracted.y < 0);
    assert_true(got[5].k < 0);
    CHECK_NEAR(got[5].fresnel, 1, 0);
    assert_true(got[5].refracted.y > 0);
    check_vector(got[6].refracted, asked[6].e); /* no surface at all */
    CHECK_NEAR(got[6].fresnel, 0, 1e-7);
}

/* A thin gap of air in ice: the vectors, and what the law says at other angles. */
static void gaps(void **state)
{
    static const double more[][2] = {
        { 0, 0.0351309 },  { 30, 0.0433238 },   { 45, 0.1869719 },
        { 48, 0.3850670 }, { 49.8, 0.9083175 }, { 49.84, 1 },
    };

    enum {
        COUNT = 8,
        MORE = sizeof(more) / sizeof(more[0]),
    };

    struct optics_question asked[COUNT + MORE];
    struct optics_answer got[COUNT + MORE];
    json_t *oracles = load(ORACLES);
    const json_t *cases = get_cases(oracles, "crack_gap", COUNT);
    const double air = get_number(oracles, "air");
    const double ice = get_number(oracles, "ice");
    for (size_t i = 0; i < COUNT; i++)
        asked[i] = at_angle(get_number(json_array_get(cases, i), "angle_in_ice_deg"), ice, air);
    for (size_t i = 0; i < MORE; i++)
        asked[COUNT + i] = at_angle(more[i][0], ice, air);
    ask(*state, asked, got, COUNT + MORE);
    for (size_t i = 0; i < COUNT; i++)
        CHECK_NEAR(got[i].gap, get_number(json_array_get(cases, i), "reflectance"), tolerance);
    for (size_t i = 0; i < MORE; i++) /* the law is steep where it ends */
        CHECK_NEAR(got[COUNT + i].gap, more[i][1], more[i][0] > 49 ? 1e-4 : 1e-6);
    json_decref(oracles);
}

/* ---- a cube captured in a box ---- */

static void looked_up_in_a_box(void **state)
{
    enum {
        COUNT = 10
    };
    struct optics_question asked[COUNT];
    struct optics_answer got[COUNT];
    json_t *oracles = load(ORACLES);
    const json_t *cases = get_cases(oracles, "local_cube", COUNT);
    for (size_t i = 0; i < COUNT; i++) {
        const json_t *row = json_array_get(cases, i);
        asked[i] = (struct optics_question){
            .e = get_vector(row, "direction"),
            .point = get_vector(row, "position"),
            .low = get_vector(row, "box_min"),
            .high = get_vector(row, "box_max"),
            .captured = get_vector(row, "capture"),
        };
    }
    ask(*state, asked, got, COUNT);
    for (size_t i = 0; i < COUNT; i++)
        check_vector(got[i].local, get_vector(json_array_get(cases, i), "lookup"));
    json_decref(oracles);
}

/* Where no box is to be met the direction itself looks it up. */
static void no_box_to_meet(void **state)
{
    const vec3s e = { { 0.6F, 0, -0.8F } };
    const vec3s low = { { -1, -1, -1 } };
    const vec3s high = { { 1, 1, 1 } };
    const vec3s inside = { { 0.5F, 0.25F, 0 } };
    const vec3s beside = { { 0, 0, 2 } };
    const vec3s none = { { NAN, 0, 0 } };
    const struct optics_question asked[] = {
        { .e = e, .point = beside, .low = low, .high = high },          /* outside, the box ahead */
        { .e = e, .point = { { 2, 0, 0 } }, .low = low, .high = high }, /* behind: t < 0 */
        { .e = e, .point = inside, .low = high, .high = low },          /* inside out */
        { .e = e, .point = inside },                                    /* no box */
        { .e = e, .point = none, .low = low, .high = high },
        { .e = { { 0, 0, 0 } }, .point = inside, .low = low, .high = high },
        { .e = { { 1, 0, 0 } }, .point = high, .low = low, .high = high, .captured = high },
        { .e = { { 1, 0, -0.0F } }, .point = inside, .low = low, .high = high }, /* this is met */
        { .e = { { 1, 1e-38F, -1e-42F } }, .point = inside, .low = low, .high = high }, /* too */
    };

    enum {
        COUNT = sizeof(asked) / sizeof(asked[0]),
        MET = 2
    };

    const vec3s met = { { 1, 0.25F, 0 } };
    struct optics_answer got[COUNT];
    ask(*state, asked, got, COUNT);
    for (size_t i = 0; i < COUNT; i++)
        check_vector(got[i].local, i < COUNT - MET ? asked[i].e : met);
}

/* Metres along a ray to a triangle; HUGE_VAL if it passes by. */
static double way_to_triangle(const struct mesh *mesh, uint32_t first, struct vec from,
                              struct vec dir)
{
    struct vec at[3];
    for (uint32_t i = 0; i < 3; i++)
        at[i] = vec_from(mesh->vertices[mesh->indices[first + i]].position);
    const struct vec u = vec_add(at[1], -1, at[0]);
    const struct vec v = vec_add(at[2], -1, at[0]);
    const struct vec across = vec_cross(dir, v);
    const double determinant = vec_dot(u, across);
    if (fabs(determinant) < 1e-15)
        return HUGE_VAL;
    const struct vec offset = vec_add(from, -1, at[0]);
    const struct vec other = vec_cross(offset, u);
    const double a = vec_dot(offset, across) / determinant;
    const double b = vec_dot(dir, other) / determinant;
    const double t = vec_dot(v, other) / determinant;
    return a < -1e-9 || b < -1e-9 || a + b > 1 + 1e-9 || t <= 0 ? HUGE_VAL : t;
}

/* The nearest point that a ray meets. */
static struct vec meet(const struct mesh *mesh, struct vec from, struct vec dir)
{
    double nearest = HUGE_VAL;
    for (uint32_t i = 0; i < mesh->index_count; i += 3)
        nearest = fmin(nearest, way_to_triangle(mesh, i, from, dir));
    assert_true(nearest < HUGE_VAL); /* the room is closed */
    return vec_add(from, nearest, dir);
}

static bool is_on_wall(struct box walls, struct vec point)
{
    const double at[3] = { point.x, point.y, point.z };
    double nearest = HUGE_VAL;
    for (size_t axis = 0; axis < 3; axis++) {
        nearest = fmin(nearest, fabs(at[axis] - (double)walls.min.raw[axis]));
        nearest = fmin(nearest, fabs(at[axis] - (double)walls.max.raw[axis]));
    }
    return nearest < 1e-6;
}

/* From points about the ice the walls of the built-in room are looked up where they are. */
static void walls_of_the_room(void **state)
{
    enum {
        COUNT = 400
    };
    static struct optics_question asked[COUNT];
    static struct optics_answer got[COUNT];
    struct scene scene;
    struct random random = random_begin(7, 0);
    double worst = 0;
    double uncorrected = 0;
    size_t count = 0;
    assert_int_equal(scene_load(&scene, &(struct scene_params){ .name = "room" }), STATUS_OK);
    const vec3s center = box_center(scene.box);
    for (size_t i = 0; i < COUNT; i++) {
        asked[i] = (struct optics_question){
            .e = glms_vec3_normalize(random_box(&random)),
            .point = glms_vec3_muladds(random_box(&random), 0.8F, center),
            .low = scene.model.box.min,
            .high = scene.model.box.max,
            .captured = center,
        };
    }
    ask(*state, asked, got, COUNT);
    for (size_t i = 0; i < COUNT; i++) {
        const struct vec dir = vec_from(asked[i].e);
        const struct vec end = meet(&scene.model.surroundings, vec_from(asked[i].point), dir);
        if (!is_on_wall(scene.model.box, end))
            continue;
        const struct vec right = vec_add(end, -1, vec_from(center));
        worst = fmax(worst, vec_angle_deg(vec_from(got[i].local), right));
        uncorrected += vec_angle_deg(dir, right);
        count++;
    }
    assert_true(count > COUNT / 3);
    uncorrected /= (double)count;
    print_message("%zu rays: greatest error %.2g degrees; uncorrected %.2g on average\n", count,
                  worst, uncorrected);
    assert_true(worst < 2e-5);
    assert_true(uncorrected > 3);
    scene_finish(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(blended_normals),
        cmocka_unit_test(refracted_or_reflected),
        cmocka_unit_test(through_a_sphere),
        cmocka_unit_test(closed_forms),
        cmocka_unit_test(through_a_bubble),
        cmocka_unit_test(ends_of_a_bubble),
        cmocka_unit_test(gaps),
        cmocka_unit_test(looked_up_in_a_box),
        cmocka_unit_test(no_box_to_meet),
        cmocka_unit_test(walls_of_the_room),
    };
    return RUN_ON_DEVICE(tests);
}
