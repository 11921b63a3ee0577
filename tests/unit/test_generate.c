/*
 * test_generate.c: built-in objects are closed meshes with the requested triangle counts and
 * sizes.
 */
#include "src/scene/generate/generate.h"

#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>

#include "shaders/water/water.h"
#include "src/file/srgb.h"
#include "src/scene/stage/stage.h"
#include "src/scene/stage/stage_textures.h"
#include "tests/support/assertions.h"

typedef bool (*generate_fn)(struct mesh *mesh, uint32_t triangles);

static const struct solid {
    generate_fn generate;
    uint32_t default_count, least_count;
    int euler; /* vertices - edges + faces: 2, or 0 for a surface with one handle */
} solids[] = {
    { generate_sphere, 960, 6, 2 },
    { generate_ice_cube, 4800, 12, 2 },
    { generate_teapot, 14400, 1780, 0 },
};

enum {
    SOLID_COUNT = sizeof(solids) / sizeof(*solids),
};

static vec3s corner(const struct mesh *mesh, uint32_t index)
{
    return mesh->vertices[mesh->indices[index]].position;
}

/* The normal of the triangle at an index, as long as twice its area. */
static vec3s facet(const struct mesh *mesh, uint32_t index)
{
    vec3s a = corner(mesh, index);
    return glms_vec3_cross(glms_vec3_sub(corner(mesh, index + 1), a),
                           glms_vec3_sub(corner(mesh, index + 2), a));
}

static void check_vertices(const struct mesh *mesh)
{
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        const struct mesh_vertex *v = &mesh->vertices[i];
        assert_true(glms_vec3_isvalid(v->position));
        assert_true(glms_vec3_isvalid(v->color));
        CHECK_NEAR(glms_vec3_norm(v->normal), 1, 1e-5);
        assert_int_equal(v->material, 0);
    }
}

/* No slivers, and vertex normals on the outer side of every facet they belong to. */
static void check_facets(const struct mesh *mesh)
{
    assert_int_equal(mesh->index_count % 3, 0);
    for (uint32_t i = 0; i < mesh->index_count; i += 3) {
        vec3s normal = facet(mesh, i);
        float longest = 0;
        for (uint32_t k = 0; k < 3; k++) {
            assert_in_range(mesh->indices[i + k], 0, mesh->vertex_count - 1);
            vec3s side = glms_vec3_sub(corner(mesh, i + (k + 1) % 3), corner(mesh, i + k));
            longest = fmaxf(longest, glms_vec3_norm(side));
            assert_true(glms_vec3_dot(normal, mesh->vertices[mesh->indices[i + k]].normal) > 0);
        }
        /* height over longest side */
        assert_true(glms_vec3_norm(normal) > 0.002F * longest * longest);
    }
}

static int compare_edges(const void *a, const void *b)
{
    uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

/* Every edge runs once in either direction: closed and consistently wound. */
static void check_closed(const struct mesh *mesh, int euler)
{
    uint64_t *edges = calloc(mesh->index_count, sizeof(*edges));
    assert_non_null(edges);
    for (uint32_t i = 0; i < mesh->index_count; i++) {
        uint32_t next = i % 3 == 2 ? i - 2 : i + 1;
        edges[i] = (uint64_t)mesh->indices[i] << 32 | mesh->indices[next];
    }
    qsort(edges, mesh->index_count, sizeof(*edges), compare_edges);
    for (uint32_t i = 0; i < mesh->index_count; i++) {
        assert_true(i == 0 || edges[i] != edges[i - 1]);
        uint64_t reverse = edges[i] << 32 | edges[i] >> 32;
        assert_non_null(bsearch(&reverse, edges, mesh->index_count, sizeof(*edges), compare_edges));
    }
    free(edges);
    int faces = (int)mesh->index_count / 3;
    assert_int_equal((int)mesh->vertex_count - 3 * faces / 2 + faces, euler);
}

/* One piece, without stray vertices: triangles reach every vertex from the first. */
static void check_connected(const struct mesh *mesh)
{
    bool *reached = calloc(mesh->vertex_count, sizeof(*reached));
    assert_non_null(reached);
    reached[mesh->indices[0]] = true;
    uint32_t count = 1;
    for (uint32_t before = 0; before != count;) {
        before = count;
        for (uint32_t i = 0; i < mesh->index_count; i += 3) {
            const uint32_t *t = mesh->indices + i;
            if (!reached[t[0]] && !reached[t[1]] && !reached[t[2]])
                continue;
            for (int k = 0; k < 3; k++) {
                count += reached[t[k]] ? 0 : 1;
                reached[t[k]] = true;
            }
        }
    }
    free(reached);
    assert_int_equal(count, mesh->vertex_count);
}

static double volume(const struct mesh *mesh)
{
    double sum = 0;
    for (uint32_t i = 0; i < mesh->index_count; i += 3)
        sum += (double)glms_vec3_dot(corner(mesh, i), facet(mesh, i)) / 6;
    return sum;
}

static void check_solid(const struct mesh *mesh, int euler)
{
    check_vertices(mesh);
    check_facets(mesh);
    check_closed(mesh, euler);
    check_connected(mesh);
    assert_true(volume(mesh) > 0);
}

static void test_solids_of_many_counts(void **state)
{
    (void)state;
    static const uint32_t counts[] = { 0, 1, 7, 50, 100, 333, 700, 1000, 2000, 4097, 9000, 50000 };
    for (int i = 0; i < SOLID_COUNT; i++) {
        for (size_t k = 0; k < sizeof(counts) / sizeof(*counts); k++) {
            struct mesh mesh = { 0 };
            assert_true(solids[i].generate(&mesh, counts[k]));
            check_solid(&mesh, solids[i].euler);
            uint32_t made = mesh.index_count / 3;
            if (counts[k] < solids[i].least_count)
                assert_int_equal(made, solids[i].least_count);
            else /* no step between neighbouring meshes is larger */
                CHECK_NEAR(made, counts[k], 0.3 * counts[k]);
            mesh_finish(&mesh);
        }
    }
}

static void test_default_counts_are_exact(void **state)
{
    (void)state;
    for (int i = 0; i < SOLID_COUNT; i++) {
        struct mesh mesh = { 0 };
        assert_true(solids[i].generate(&mesh, solids[i].default_count));
        assert_int_equal(mesh.index_count, 3 * solids[i].default_count);
        check_solid(&mesh, solids[i].euler);
        vec3s center = box_center(mesh_box(&mesh));
        CHECK_NEAR(glms_vec3_norm(center), 0, 1e-5);
        for (uint32_t k = 0; k < mesh.vertex_count; k++)
            assert_true(glms_vec3_eq(mesh.vertices[k].color, 1));
        mesh_finish(&mesh);
    }
    assert_int_equal(GENERATE_SPHERE_TRIANGLES, 960);
    assert_int_equal(GENERATE_ICE_CUBE_TRIANGLES, 4800);
    assert_int_equal(GENERATE_TEAPOT_TRIANGLES, 14400);
    assert_int_equal(GENERATE_LANDSCAPE_TRIANGLES, 2340);
}

static void test_closest_count_is_chosen(void **state)
{
    (void)state;

    /* neighbouring meshes of the cube: 12 * 20^2, 12 * 21^2; of the teapot: 14400 and the next */
    static const struct {
        generate_fn generate;
        uint32_t wanted, made;
    } rows[] = {
        { generate_ice_cube, 4801, 4800 },  { generate_ice_cube, 5045, 4800 },
        { generate_ice_cube, 5047, 5292 },  { generate_ice_cube, 29, 12 },
        { generate_ice_cube, 31, 48 },      { generate_sphere, 961, 960 },
        { generate_sphere, 1000, 990 },     { generate_teapot, 14401, 14400 },
        { generate_teapot, 14399, 14400 },  { generate_landscape, 2341, 2340 },
        { generate_landscape, 2339, 2340 }, { generate_landscape, 0, 2 },
    };

    for (size_t i = 0; i < sizeof(rows) / sizeof(*rows); i++) {
        struct mesh mesh = { 0 };
        assert_true(rows[i].generate(&mesh, rows[i].wanted));
        assert_int_equal(mesh.index_count / 3, rows[i].made);
        mesh_finish(&mesh);
    }
}

static void test_huge_counts_are_cut(void **state)
{
    (void)state;
    for (int i = 0; i < SOLID_COUNT; i++) {
        struct mesh mesh = { 0 };
        assert_true(solids[i].generate(&mesh, UINT32_MAX));
        CHECK_NEAR(mesh.index_count / 3.0, GENERATE_TRIANGLES_MAX, 0.02 * GENERATE_TRIANGLES_MAX);
        uint32_t last = 0;
        for (uint32_t k = 0; k < mesh.index_count; k++)
            last = mesh.indices[k] > last ? mesh.indices[k] : last;
        assert_int_equal(last + 1, mesh.vertex_count);
        mesh_finish(&mesh);
    }
}

static void test_sphere_is_round(void **state)
{
    (void)state;
    struct mesh mesh = { 0 };
    assert_true(generate_sphere(&mesh, GENERATE_SPHERE_TRIANGLES));
    assert_int_equal(mesh.vertex_count, 32 * 15 + 2);
    const float radius = glms_vec3_norm(mesh.vertices[0].position);
    CHECK_NEAR(radius, 1.0055, 0.0015);
    for (uint32_t i = 0; i < mesh.vertex_count; i++) {
        const struct mesh_vertex *v = &mesh.vertices[i];
        const vec3s on_sphere = glms_vec3_scale(v->normal, radius);
        CHECK_NEAR(glms_vec3_distance(v->position, on_sphere), 0, 1e-6);
    }
    CHECK_NEAR(volume(&mesh), 4.18879, 1e-4); /* 4/3 pi */
    mesh_finish(&mesh);
}

static void test_ice_cube_is_an_irregular_cube(void **state)
{
    (void)state;
    struct mesh mesh = { 0 };
    assert_true(generate_ice_cube(&mesh, GENERATE_ICE_CUBE_TRIANGLES));
    struct box box = mesh_box(&mesh);
    CHECK_NEAR(box.max.x - box.min.x, 1.6, 1e-5);
    CHECK_NEAR(box.max.y - box.min.y, 1.6, 0.15);
    CHECK_NEAR(box.max.z - box.min.z, 1.6, 0.15);
    CHECK_NEAR(volume(&mesh), 1.6 * 1.6 * 1.6, 1);
    /* a point and its mirror image are at different distances */
    double skew = 0;
    for (uint32_t i = 0; i < 441; i++) {
        vec3s below = mesh.vertices[i].position;
        vec3s above = mesh.vertices[mesh.vertex_count - 441 + i].position;
        skew = fmax(skew, fabs((double)(below.z + above.z)));
    }
    assert_true(skew > 0.02 && skew < 0.4);
    mesh_finish(&mesh);
}

/* +1 where the upward ray at (x, z) enters through a triangle, -1 where it leaves, at *y. */
static int crossing(const struct mesh *mesh, uint32_t index, float x, float z, double *y)
{
    double px[3], pz[3], w[3], area = 0;
    for (uint32_t k = 0; k < 3; k++) {
        px[k] = (double)corner(mesh, index + k).x - (double)x;
        pz[k] = (double)corner(mesh, index + k).z - (double)z;
    }
    for (int k = 0; k < 3; k++) {
        int a = (k + 1) % 3, b = (k + 2) % 3;
        w[k] = pz[a] * px[b] - px[a] * pz[b];
        area += w[k];
    }
    if (area == 0)
        return 0;
    *y = 0;
    for (uint32_t k = 0; k < 3; k++) {
        if (w[k] / area < 0)
            return 0;
        *y += w[k] / area * (double)corner(mesh, index + k).y;
    }
    return area > 0 ? -1 : 1;
}

/*
 * Along a line through a solid without walls inside, entering and leaving take turns. Returns how
 * often the line enters.
 */
static int check_line(const struct mesh *mesh, float x, float z)
{
    double heights[64];
    int ways[64];
    int count = 0;
    for (uint32_t i = 0; i < mesh->index_count; i += 3) {
        double y;
        int way = crossing(mesh, i, x, z, &y);
        if (way == 0)
            continue;
        assert_true(count < 64);
        int at = count++;
        for (; at > 0 && heights[at - 1] > y; at--) {
            heights[at] = heights[at - 1];
            ways[at] = ways[at - 1];
        }
        heights[at] = y;
        ways[at] = way;
    }
    assert_int_equal(count % 2, 0);
    for (int i = 0; i < count; i++)
        assert_int_equal(ways[i], i % 2 == 0 ? 1 : -1);
    return count / 2;
}

static void test_solids_have_no_walls_inside(void **state)
{
    (void)state;
    for (int i = 0; i < SOLID_COUNT; i++) {
        struct mesh mesh = { 0 };
        assert_true(solids[i].generate(&mesh, solids[i].default_count));
        /* odd numbers, so that no line meets an edge */
        for (int x = 0; x < 48; x++)
            for (int z = 0; z < 11; z++)
                check_line(&mesh, 0.0437F * (float)x - 1.0137F, 0.1793F * (float)z - 0.9871F);
        mesh_finish(&mesh);
    }
}

static void test_teapot_looks_like_one(void **state)
{
    (void)state;
    struct mesh mesh = { 0 };
    assert_true(generate_teapot(&mesh, GENERATE_TEAPOT_TRIANGLES));
    struct box box = mesh_box(&mesh);
    CHECK_NEAR(box.max.x - box.min.x, 2, 1e-5);
    /* Newell's teapot is 3.15 high and 4.0 wide where it reaches from -3 to about 3.43 */
    CHECK_NEAR((box.max.y - box.min.y) / 2, 3.15 / 6.43, 0.005);
    CHECK_NEAR((box.max.z - box.min.z) / 2, 4 / 6.43, 0.005);
    /* the line through the handle: two of its bars, air between them; through the spout: one */
    assert_int_equal(check_line(&mesh, -0.82F, 0.003F), 2);
    assert_int_equal(check_line(&mesh, 0.75F, 0.003F), 1);
    /* close beside the joints of handle and spout, and to the body: nothing */
    assert_int_equal(check_line(&mesh, -0.7016F, 0.0737F), 0);
    assert_int_equal(check_line(&mesh, 0.573F, 0.162F), 0);
    /* knob to bottom: solid */
    assert_int_equal(check_line(&mesh, -0.0671F, 0.003F), 1);
    /* mirror images left and right */
    double balance = 0;
    for (uint32_t i = 0; i < mesh.vertex_count; i++)
        balance += (double)mesh.vertices[i].position.z;
    CHECK_NEAR(balance, 0, 1e-3);
    mesh_finish(&mesh);
}

static void test_landscape(void **state)
{
    (void)state;
    struct mesh mesh = { 0 };
    assert_true(generate_landscape(&mesh, GENERATE_LANDSCAPE_TRIANGLES));
    assert_int_equal(mesh.index_count, 3 * 2340);
    check_vertices(&mesh);
    check_facets(&mesh);
    struct box box = mesh_box(&mesh);
    CHECK_NEAR(box.min.x, -30, 1e-4);
    CHECK_NEAR(box.max.x, 30, 1e-4);
    CHECK_NEAR(box.min.z, -30, 1e-4);
    CHECK_NEAR(box.max.z, 30, 1e-4);
    assert_true(box.max.y > 5 && box.max.y < 11);
    double ground = 0;
    for (uint32_t i = 0; i < mesh.index_count; i += 3) {
        vec3s normal = facet(&mesh, i);
        assert_true(normal.y > 0);
        ground += (double)normal.y / 2;
    }
    /* facets face up and tile the square, so none overlaps another */
    CHECK_NEAR(ground, 3600, 0.01);
    int outer = 0, high = 0;
    vec3s least = glms_vec3_one(), most = glms_vec3_zero();
    for (uint32_t i = 0; i < mesh.vertex_count; i++) {
        const struct mesh_vertex *v = &mesh.vertices[i];
        float distance = hypotf(v->position.x, v->position.z);
        if (distance < 6)
            CHECK_NEAR(v->position.y, -1.35, 0.12);
        outer += distance > 27;
        high += distance > 27 && v->position.y > 1;
        least = glms_vec3_minv(least, v->color);
        most = glms_vec3_maxv(most, v->color);
    }
    assert_true(high > outer * 3 / 4);
    for (int k = 0; k < 3; k++) {
        assert_true(least.raw[k] >= 0 && least.raw[k] < 0.1F);
        assert_true(most.raw[k] > 0.5F && most.raw[k] < 1.2F);
    }
    mesh_finish(&mesh);
}

/* Whether a triangle lies in the plane of a coordinate and some of it around a point there. */
static bool covers(const struct mesh *mesh, uint32_t index, int axis, vec3s point)
{
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    int left = 0;
    int right = 0;
    for (uint32_t k = 0; k < 3; k++) {
        const vec3s a = corner(mesh, index + k);
        const vec3s b = corner(mesh, index + (k + 1) % 3);
        if (fabsf(a.raw[axis] - point.raw[axis]) > 1e-6F)
            return false;
        const float side = (b.raw[u] - a.raw[u]) * (point.raw[v] - a.raw[v]) -
                           (b.raw[v] - a.raw[v]) * (point.raw[u] - a.raw[u]);
        left += side >= 0;
        right += side <= 0;
    }
    return left == 3 || right == 3;
}

static bool is_covered(const struct mesh *mesh, int axis, vec3s point)
{
    for (uint32_t i = 0; i < mesh->index_count; i += 3) {
        if (covers(mesh, i, axis, point))
            return true;
    }
    return false;
}

/* Level, under the object, lit from above, without holes: its area is that of a square. */
static void test_floor(void **state)
{
    const struct box object = { { { 1, 2, 3 } }, { { 3, 5, 9 } } };
    struct mesh mesh;
    double area = 0;
    (void)state;
    assert_true(generate_floor(&mesh, object));
    for (uint32_t i = 0; i < mesh.index_count; i += 3) {
        const struct mesh_vertex *v = mesh.vertices;
        const uint32_t *corner = &mesh.indices[i];
        const vec3s a = glms_vec3_sub(v[corner[1]].position, v[corner[0]].position);
        const vec3s b = glms_vec3_sub(v[corner[2]].position, v[corner[0]].position);
        const vec3s square = glms_vec3_cross(a, b);
        assert_true(square.y > 0); /* counter-clockwise from above */
        area += (double)square.y / 2;
    }
    for (uint32_t i = 0; i < mesh.vertex_count; i++) {
        CHECK_NEAR(mesh.vertices[i].position.y, 2, 0);
        CHECK_NEAR(mesh.vertices[i].normal.y, 1, 0);
        assert_true((mesh.vertices[i].material & MESH_UNLIT) == 0);
    }
    const struct box box = mesh_box(&mesh);
    const double side = (double)(box.max.x - box.min.x);
    CHECK_NEAR(box_center(box).x, 2, 1e-3);
    CHECK_NEAR(box_center(box).z, 6, 1e-3);
    CHECK_NEAR(side, 200 * 7, 0.1); /* of the object's diagonal */
    CHECK_NEAR(area / (side * side), 1, 1e-4);
    mesh_finish(&mesh);
}

/* The stage is level, whole, wound upwards, and fades to the colours of the horizon. */
static void test_stage(void **state)
{
    struct generate_stage stage = { .foot = { { 1, 2, 3 } }, .radius = 2, .uv_scale = 0.5F };
    struct mesh mesh = { 0 };
    (void)state;
    stage.near_color = glms_vec3_fill(0.2F);
    for (uint32_t i = 0; i < GENERATE_STAGE_SIDES; i++)
        stage.far_colors[i] = glms_vec3_fill(0.5F + 0.001F * (float)i);
    assert_true(generate_stage(&mesh, &stage));
    double area = 0;
    for (uint32_t i = 0; i < mesh.index_count; i += 3) {
        const vec3s normal = facet(&mesh, i);
        assert_true(normal.y > 0);
        area += 0.5 * (double)normal.y;
    }
    const double round = GENERATE_STAGE_SIDES / 2.0 * sin(2 * GLM_PI / GENERATE_STAGE_SIDES);
    CHECK_NEAR(area / (600.0 * 600.0 * round), 1, 1e-4);
    for (uint32_t i = 0; i < mesh.vertex_count; i++) {
        const struct mesh_vertex *v = &mesh.vertices[i];
        const float distance = glms_vec3_distance(v->position, stage.foot);
        CHECK_NEAR(v->position.y, 2, 0);
        CHECK_NEAR(v->uv.x, 0.25F * (v->position.x - 1), 1e-3);
        if (distance <= 3)
            CHECK_NEAR(v->color.x, 0.2F, 1e-6);
        if (distance >= 26.1F)
            CHECK_NEAR(v->color.x, stage.far_colors[i % GENERATE_STAGE_SIDES].x, 1e-6);
    }
    CHECK_NEAR(generate_stage_fade(0), 0, 0);
    CHECK_NEAR(generate_stage_fade(GENERATE_STAGE_RINGS - 1), 1, 0);
    mesh_finish(&mesh);
}

/* The floor is just below a model, wherever that is. */
static void test_stage_is_below_its_subject(void **state)
{
    (void)state;
    const struct stage_params stage = { .ground = STAGE_SHADOW };
    const struct environment environment = { 0 };
    const struct box subject = { { { 3, -2, 5 } }, { { 4, 0, 7 } } };
    struct model model = { 0 };
    assert_int_equal(stage_add(&model, &stage, subject, &environment), STATUS_OK);
    const struct box floor = mesh_box(&model.surroundings);
    CHECK_NEAR(floor.min.y, -2, 0.002);
    CHECK_NEAR(floor.max.y, floor.min.y, 0);
    assert_true(floor.max.y < subject.min.y);
    CHECK_NEAR(box_center(floor).x, 3.5, 0.1);
    CHECK_NEAR(box_center(floor).z, 6, 0.1);
    model_finish(&model);
}

/* Opposite edges of the textures differ no more than neighbouring columns and rows. */
static void test_floor_textures(void **state)
{
    const size_t size = STAGE_TEXTURE_SIZE;
    (void)state;
    for (int is_wood = 0; is_wood < 2; is_wood++) {
        struct stage_textures made;
        double inside = 0, across = 0, sum = 0;
        assert_true(stage_textures_generate(&made, is_wood));
        for (size_t i = 0; i < size; i++) {
            const uint8_t *row = &made.colors[4 * i * size], *column = &made.colors[4 * i];
            const size_t last = size - 1;
            across += abs(row[0] - row[4 * last]) + abs(column[0] - column[4 * last * size]);
            inside += abs(row[400] - row[404]) + abs(column[400 * size] - column[404 * size]);
        }
        assert_true(across < 2 * inside + 8.0 * (double)size);
        for (size_t i = 0; i < size * size; i++)
            sum += (double)srgb_decode((float)made.colors[4 * i] / 255);
        CHECK_NEAR(sum / (double)(size * size), made.mean.x, 2e-3);
        free(made.colors);
        free(made.normals);
    }
}

/* Six whole walls; the object lies on the table, off the middle. */
static void test_room(void **state)
{
    (void)state;
    const struct box object = { { { -0.8F, -0.7F, -0.8F } }, { { 0.8F, 0.7F, 0.8F } } };
    struct mesh mesh = { 0 };
    assert_true(generate_room(&mesh, object));
    const struct box box = mesh_box(&mesh);
    const vec3s extent = glms_vec3_sub(box.max, box.min);
    for (int i = 0; i < 600; i++) {
        const float share = (float)i / 600;
        vec3s point = glms_vec3_muladds(extent, share, box.min);
        const int axis = i % 3;
        point.raw[(axis + 1) % 3] =
            box.min.raw[(axis + 1) % 3] + extent.raw[(axis + 1) % 3] * fmodf(share * 37, 1);
        point.raw[axis] = i / 3 % 2 ? box.max.raw[axis] : box.min.raw[axis];
        assert_true(is_covered(&mesh, axis, point));
    }
    for (uint32_t i = 0; i < mesh.vertex_count; i++) {
        const struct mesh_vertex *v = &mesh.vertices[i];
        assert_int_equal(v->material, MESH_UNLIT);
        CHECK_NEAR(glms_vec3_norm(v->normal), 1, 0);
        assert_true(glms_vec3_isvalid(v->color) && glms_vec3_min(v->color) > 0);
    }
    for (uint32_t i = 0; i < mesh.index_count; i += 3)
        assert_true(glms_vec3_dot(facet(&mesh, i), mesh.vertices[mesh.indices[i]].normal) > 0);
    assert_true(is_covered(&mesh, 1, object.min));
    assert_true(glms_vec3_distance(box_center(box), box_center(object)) > 1);
    mesh_finish(&mesh);
}

/* As wide as it is told, nine tenths below. */
static void test_floe(void **state)
{
    (void)state;
    struct mesh mesh;
    const struct generate_pool pool = { .size = 4, .depth = 2, .ice = 1.25F };
    assert_true(generate_floating_ice(&mesh, &pool, 300));
    const struct box box = mesh_box(&mesh);
    CHECK_NEAR(box.max.x - box.min.x, 1.25, 1e-5);
    CHECK_NEAR(-box.min.y / (box.max.y - box.min.y), 0.917, 1e-4);
    mesh_finish(&mesh);
}

static void test_same_mesh_every_time(void **state)
{
    (void)state;
    struct mesh first = { 0 }, second = { 0 };
    assert_true(generate_ice_cube(&first, 1200));
    assert_true(generate_ice_cube(&second, 1200));
    assert_int_equal(first.vertex_count, second.vertex_count);
    assert_memory_equal(first.vertices, second.vertices,
                        first.vertex_count * sizeof(*first.vertices));
    mesh_finish(&first);
    mesh_finish(&second);
}

/* Stone up to the rim: walls that face the water, and level ground that does not cover it. */
static void test_pool(void **state)
{
    (void)state;
    struct mesh mesh;
    double wall_area = 0;
    vec3s sum = { 0 }; /* of the walls' normals: they stand around the water */
    assert_true(generate_pool(&mesh, &(struct generate_pool){ 3, 0.5F }));
    for (uint32_t i = 0; i < mesh.index_count; i += 3) {
        const vec3s normal = facet(&mesh, i);
        const vec3s a = corner(&mesh, i);
        assert_true(glms_vec3_dot(normal, mesh.vertices[mesh.indices[i]].normal) > 0);
        if (normal.y > 0) {
            assert_true(fmaxf(fabsf(a.x), fabsf(a.z)) >= 1.5F && a.y > 0);
            continue;
        }
        CHECK_NEAR(normal.y, 0, 1e-6);
        CHECK_NEAR(fmaxf(fabsf(a.x), fabsf(a.z)), 1.5, 1e-6);
        assert_true(normal.x * a.x + normal.z * a.z < 0);
        wall_area += (double)glms_vec3_norm(normal) / 2;
        sum = glms_vec3_add(sum, normal);
    }
    CHECK_NEAR(glms_vec3_norm(sum), 0, 1e-5);
    CHECK_NEAR(wall_area, 4 * 3 * (0.5 + (double)POOL_RIM), 1e-4);
    CHECK_NEAR(mesh_box(&mesh).min.y, -0.5, 1e-6);
    mesh_finish(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_solids_of_many_counts),
        cmocka_unit_test(test_default_counts_are_exact),
        cmocka_unit_test(test_closest_count_is_chosen),
        cmocka_unit_test(test_huge_counts_are_cut),
        cmocka_unit_test(test_sphere_is_round),
        cmocka_unit_test(test_ice_cube_is_an_irregular_cube),
        cmocka_unit_test(test_solids_have_no_walls_inside),
        cmocka_unit_test(test_teapot_looks_like_one),
        cmocka_unit_test(test_landscape),
        cmocka_unit_test(test_floor),
        cmocka_unit_test(test_stage),
        cmocka_unit_test(test_stage_is_below_its_subject),
        cmocka_unit_test(test_floor_textures),
        cmocka_unit_test(test_room),
        cmocka_unit_test(test_pool),
        cmocka_unit_test(test_floe),
        cmocka_unit_test(test_same_mesh_every_time),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
