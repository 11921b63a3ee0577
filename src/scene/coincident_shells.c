/*
 * coincident_shells.c: self-join of the objects' triangles that finds coincident faces.
 *
 * The triangles are sorted by the dominant axis of their normals, then along a Morton curve. An
 * implicit binary tree of bounding boxes over the sorted order is traversed against itself. Pairs
 * of nodes are skipped if their boxes are apart, or if no normals are parallel. If all their
 * triangles belong to one object, pairs are also skipped if the object has only one solid, or if no
 * normals are opposite.
 */
#include "src/scene/coincident_shells.h"
#include <cglm/struct.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/machine.h"

enum {
    LEAF_TRIANGLES = 4,
    MORTON_BITS = 10, /* per axis */
    RADIX_BITS = 11,  /* of a counting sort pass */
    KEY_BITS = 3 * MORTON_BITS + 2,
    POLYGON_MAX = 6,     /* vertices of a triangle that is clipped by three half-planes */
    TESTS_MIN = 1 << 20, /* lower bound of tests_max() */
    TESTS_PER_TRIANGLE = 8,
};

/* Distances within which surfaces coincide: relative to the smaller object's radius, and to the
 * magnitude of coordinates because of rounding. */
#define SCALE_EPSILON 1.5e-4f
#define ROUND_EPSILON 5e-7f

#define CONTACT_COSINE  0.98f  /* minimum cosine between the normals of triangles at a contact */
#define PARALLEL_COSINE 0.999f /* minimum cosine between the normals of a shared face */

/* Maximum component of the sum of two unit normals whose cosine is below -PARALLEL_COSINE. */
#define OPPOSITE_SUM 0.045f

#define MIXED_OBJECTS UINT32_MAX

/* Node of the implicit tree: node i has the children 2 i and 2 i + 1. */
struct node {
    struct box box;
    struct box normals; /* bounds of the triangles' normals */
    uint32_t object;    /* object of all triangles, or MIXED_OBJECTS */
};

/* Triangle of the objects' mesh, without its corners, which few tests need. */
struct face {
    vec3s normal; /* unit normal; not a number if the triangle has no area */
    struct box box;
    uint32_t object;
};

struct join {
    struct coincident_shells *shells;
    const struct object *objects;
    const struct mesh *mesh;
    float *radii;        /* of the objects' boxes */
    float round_epsilon; /* maximum rounding error of coordinates */
    float reach;         /* maximum epsilon of two objects */
    uint32_t *order;     /* sorted triangles */
    struct face *faces;  /* triangles in that order */
    uint32_t triangle_count;
    struct node *nodes;
    uint32_t leaf_count;     /* power of two */
    uint64_t tests_left;     /* limit of the tests of two nodes or triangles */
    uint64_t own_tests_left; /* the same within objects */
};

static void grow(struct box *box, struct box other)
{
    for (int k = 0; k < 3; k++) {
        box->min.raw[k] = glm_min(box->min.raw[k], other.min.raw[k]);
        box->max.raw[k] = glm_max(box->max.raw[k], other.max.raw[k]);
    }
}

static void get_corners(const struct mesh *mesh, uint32_t triangle, vec3s corners[static 3])
{
    for (uint32_t k = 0; k < 3; k++)
        corners[k] = mesh->vertices[mesh->indices[(size_t)triangle * 3 + k]].position;
}

/* Returns a normal of the triangle's plane. Its length is twice the triangle's area. */
static vec3s area_normal(const vec3s corners[static 3])
{
    return glms_vec3_cross(glms_vec3_sub(corners[1], corners[0]),
                           glms_vec3_sub(corners[2], corners[0]));
}

static struct face face_at(const struct mesh *mesh, uint32_t triangle, uint32_t object)
{
    vec3s corners[3];
    get_corners(mesh, triangle, corners);
    const vec3s n = area_normal(corners);
    struct face face = { .object = object };
    face.normal = glms_vec3_scale(n, 1.0f / sqrtf(glms_vec3_dot(n, n)));
    face.box = (struct box){ corners[0], corners[0] };
    grow(&face.box, (struct box){ corners[1], corners[1] });
    grow(&face.box, (struct box){ corners[2], corners[2] });
    return face;
}

static bool are_apart(const struct box *a, const struct box *b, float reach)
{
    for (int k = 0; k < 3; k++) {
        if (a->min.raw[k] > b->max.raw[k] + reach || b->min.raw[k] > a->max.raw[k] + reach)
            return true;
    }
    return false;
}

/* ---- tree ---- */

/* Moves the lower MORTON_BITS bits of a number apart, to every third bit. */
static uint32_t spread_bits(uint32_t x)
{
    x = (x | x << 16) & 0x30000ff;
    x = (x | x << 8) & 0x300f00f;
    x = (x | x << 4) & 0x30c30c3;
    return (x | x << 2) & 0x9249249;
}

static uint32_t morton_code(vec3s at)
{
    uint32_t code = 0;
    for (int k = 0; k < 3; k++) {
        const float cell = glm_clamp(at.raw[k], 0.0f, 1.0f) * (float)((1 << MORTON_BITS) - 1);
        code |= spread_bits((uint32_t)cell) << k;
    }
    return code;
}

/* Returns the index of the component with the greatest magnitude. */
static uint32_t dominant_axis(vec3s n)
{
    const vec3s size = glms_vec3_abs(n);
    const uint32_t axis = size.y > size.x ? 1 : 0;
    return size.z > size.raw[axis] ? 2 : axis;
}

/* Sorts the triangles. Returns false when out of memory. */
static bool sort_triangles(struct join *join)
{
    const struct mesh *mesh = join->mesh;
    const uint32_t count = join->triangle_count;
    const struct box all = join->nodes[0].box;
    const vec3s size = glms_vec3_maxv(glms_vec3_sub(all.max, all.min), glms_vec3_fill(FLT_MIN));
    uint32_t *keys = malloc(((size_t)count + 1) * sizeof(*keys));
    uint32_t *other = malloc(((size_t)count + 1) * sizeof(*other));
    bool done = keys && other;
    for (uint32_t i = 0; done && i < count; i++) {
        vec3s corners[3];
        get_corners(mesh, i, corners);
        keys[i] = morton_code(glms_vec3_div(glms_vec3_sub(corners[0], all.min), size)) |
                  dominant_axis(area_normal(corners)) << 3 * MORTON_BITS;
        join->order[i] = i;
    }
    for (uint32_t shift = 0; done && shift < KEY_BITS; shift += RADIX_BITS) {
        uint32_t starts[(1 << RADIX_BITS) + 1] = { 0 };
        const uint32_t mask = (1 << RADIX_BITS) - 1;
        for (uint32_t i = 0; i < count; i++)
            starts[(keys[i] >> shift & mask) + 1]++;
        for (uint32_t b = 0; b < mask; b++)
            starts[b + 1] += starts[b];
        for (uint32_t i = 0; i < count; i++)
            other[starts[keys[join->order[i]] >> shift & mask]++] = join->order[i];
        uint32_t *sorted = other;
        other = join->order;
        join->order = sorted;
    }
    free(keys);
    free(other);
    return done;
}

static struct node leaf_at(const struct join *join, uint32_t leaf)
{
    const struct box empty = { glms_vec3_fill(FLT_MAX), glms_vec3_fill(-FLT_MAX) };
    struct node node = { empty, empty, MIXED_OBJECTS };
    for (uint32_t k = 0; k < LEAF_TRIANGLES; k++) {
        const uint32_t at = leaf * LEAF_TRIANGLES + k;
        if (at >= join->triangle_count)
            break;
        const struct face *face = &join->faces[at];
        node.object = k == 0 || node.object == face->object ? face->object : MIXED_OBJECTS;
        grow(&node.box, face->box);
        if (!glms_vec3_isnan(face->normal))
            grow(&node.normals, (struct box){ face->normal, face->normal });
    }
    return node;
}

/* Fills the tree. Nodes beyond the last triangle have empty boxes, which are apart from all. */
static void build_tree(struct join *join)
{
    for (uint32_t i = 2 * join->leaf_count - 1; i > 0; i--) {
        if (i >= join->leaf_count) {
            join->nodes[i] = leaf_at(join, i - join->leaf_count);
            continue;
        }
        const struct node *children = &join->nodes[(size_t)2 * i];
        const bool is_second_empty = children[1].box.min.x > children[1].box.max.x;
        join->nodes[i] = children[0];
        grow(&join->nodes[i].box, children[1].box);
        grow(&join->nodes[i].normals, children[1].normals);
        if (!is_second_empty && children[0].object != children[1].object)
            join->nodes[i].object = MIXED_OBJECTS;
    }
}

/* ---- contact of two triangles ---- */

/* Point of a triangle relative to the plane of another one. */
struct plane_point {
    vec3s at;
    float distance; /* signed */
};

/* Clips a polygon to the half-space dot(side, at - from) >= 0. Returns the number of vertices. */
static uint32_t clip(struct plane_point polygon[static POLYGON_MAX], uint32_t count, vec3s from,
                     vec3s side)
{
    struct plane_point clipped[POLYGON_MAX + 1];
    uint32_t kept = 0;
    for (uint32_t i = 0; i < count; i++) {
        const struct plane_point *a = &polygon[i], *b = &polygon[(i + 1) % count];
        const float at_a = glms_vec3_dot(side, glms_vec3_sub(a->at, from));
        const float at_b = glms_vec3_dot(side, glms_vec3_sub(b->at, from));
        if (at_a >= 0.0f && kept < POLYGON_MAX)
            clipped[kept++] = *a;
        if ((at_a >= 0.0f) != (at_b >= 0.0f) && kept < POLYGON_MAX) {
            const float t = at_a / (at_a - at_b);
            clipped[kept++] = (struct plane_point){ glms_vec3_lerp(a->at, b->at, t),
                                                    glm_lerp(a->distance, b->distance, t) };
        }
    }
    memcpy(polygon, clipped, kept * sizeof(*clipped));
    return kept;
}

static float area_of(const struct plane_point *polygon, uint32_t count)
{
    vec3s sum = glms_vec3_zero();
    for (uint32_t i = 2; i < count; i++)
        sum = glms_vec3_add(sum, glms_vec3_cross(glms_vec3_sub(polygon[i - 1].at, polygon[0].at),
                                                 glms_vec3_sub(polygon[i].at, polygon[0].at)));
    return 0.5f * glms_vec3_norm(sum);
}

/* Returns true if triangle `other` is farther than `epsilon` from the plane through `corner`. */
static bool is_beside(vec3s normal, vec3s corner, const vec3s other[static 3], float epsilon)
{
    float low = FLT_MAX, high = -FLT_MAX;
    for (uint32_t k = 0; k < 3; k++) {
        const float distance = glms_vec3_dot(normal, glms_vec3_sub(other[k], corner));
        low = glm_min(low, distance);
        high = glm_max(high, distance);
    }
    return !(low <= epsilon && high >= -epsilon);
}

/* Returns true if the part of triangle `b` in the prism over triangle `a` has less than `area`. It
 * lies in a strip along each edge of `a`: the edge's length times the greatest distance of `b`, the
 * dot product, bounds its area. The factor covers rounding and the tilt of `b`. */
static bool overlaps_little(const vec3s a[static 3], vec3s normal, const vec3s b[static 3],
                            float area)
{
    for (uint32_t k = 0; k < 3; k++) {
        const vec3s side = glms_vec3_cross(normal, glms_vec3_sub(a[(k + 1) % 3], a[k]));
        float strip = -FLT_MAX;
        for (uint32_t i = 0; i < 3; i++)
            strip = glm_max(strip, glms_vec3_dot(side, glms_vec3_sub(b[i], a[k])));
        if (strip < 0.9f * area)
            return true;
    }
    return false;
}

/* Clips triangle `b` to the prism over triangle `a`. Returns the number of vertices. */
static uint32_t overlap(const vec3s a[static 3], vec3s normal, const vec3s b[static 3],
                        struct plane_point polygon[static POLYGON_MAX])
{
    uint32_t count = 3;
    for (uint32_t k = 0; k < 3; k++)
        polygon[k] = (struct plane_point){ b[k], glms_vec3_dot(normal, glms_vec3_sub(b[k], a[0])) };
    for (uint32_t k = 0; k < 3 && count; k++) {
        const vec3s side = glms_vec3_sub(a[(k + 1) % 3], a[k]);
        count = clip(polygon, count, a[k], glms_vec3_cross(normal, side));
    }
    return count;
}

static float pair_epsilon(const struct join *join, uint32_t a, uint32_t b)
{
    return fmaxf(SCALE_EPSILON * fminf(join->radii[a], join->radii[b]), join->round_epsilon);
}

static void record_pair(struct coincident_shells *shells, uint32_t a, uint32_t b)
{
    const struct coincident_pair pair = { a < b ? a : b, a < b ? b : a };
    for (uint32_t i = 0; i < shells->pair_count; i++) {
        if (shells->pairs[i].first == pair.first && shells->pairs[i].second == pair.second)
            return;
    }
    if (shells->pair_count < COINCIDENT_PAIRS_MAX)
        shells->pairs[shells->pair_count++] = pair;
    else
        shells->has_more_pairs = true;
}

static void mark(struct join *join, uint32_t at)
{
    join->shells->triangles[join->order[at] / 32] |= 1u << join->order[at] % 32;
}

static bool is_marked(const struct join *join, uint32_t at)
{
    return join->shells->triangles[join->order[at] / 32] >> join->order[at] % 32 & 1;
}

/* Returns true if a contact of two triangles would not change the result. */
static bool is_known(const struct join *join, uint32_t at_a, uint32_t at_b, float epsilon)
{
    const struct coincident_shells *shells = join->shells;
    const bool is_own = join->faces[at_a].object == join->faces[at_b].object;
    return (is_own || shells->has_more_pairs) && shells->epsilon > 0.0f &&
           shells->epsilon <= epsilon && is_marked(join, at_a) && is_marked(join, at_b);
}

/* Marks two triangles if they are in contact. Triangles of one object must face each other, so that
 * both sides of a thin sheet are not in contact. */
static void test_faces(struct join *join, uint32_t at_a, uint32_t at_b)
{
    const struct face *a = &join->faces[at_a], *b = &join->faces[at_b];
    const bool is_own = a->object == b->object;
    const float epsilon = pair_epsilon(join, a->object, b->object);
    const float cosine = glms_vec3_dot(a->normal, b->normal);
    const bool is_parallel = fabsf(cosine) > PARALLEL_COSINE;
    if (!(is_own ? is_parallel && cosine < 0.0f : fabsf(cosine) > CONTACT_COSINE) ||
        are_apart(&a->box, &b->box, epsilon) || is_known(join, at_a, at_b, epsilon))
        return;
    vec3s corners[3], other[3];
    get_corners(join->mesh, join->order[at_a], corners);
    get_corners(join->mesh, join->order[at_b], other);
    if (is_beside(a->normal, corners[0], other, epsilon))
        return;
    const float area_min = epsilon * box_diagonal(a->box);
    if (overlaps_little(corners, a->normal, other, area_min))
        return;
    struct plane_point polygon[POLYGON_MAX];
    const uint32_t count = overlap(corners, a->normal, other, polygon);
    float low = FLT_MAX, high = -FLT_MAX;
    for (uint32_t i = 0; i < count; i++) {
        low = fminf(low, polygon[i].distance);
        high = fmaxf(high, polygon[i].distance);
    }
    if (!(area_of(polygon, count) > area_min) || low > epsilon || high < -epsilon)
        return;
    const bool is_shared = is_parallel && low >= -epsilon && high <= epsilon;
    if (is_own && !(is_shared && low >= -join->round_epsilon))
        return;
    struct coincident_shells *shells = join->shells;
    mark(join, at_a);
    mark(join, at_b);
    if (is_shared) {
        shells->epsilon = shells->epsilon > 0.0f ? fminf(shells->epsilon, epsilon) : epsilon;
        if (!is_own)
            record_pair(shells, a->object, b->object);
    }
}

/* ---- join ---- */

/* Lists the triangles of a leaf that are near a box. Returns their number. */
static uint32_t list_near(const struct join *join, uint32_t leaf, const struct box *box,
                          uint32_t near[static LEAF_TRIANGLES])
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < LEAF_TRIANGLES; i++) {
        const uint32_t at = (leaf - join->leaf_count) * LEAF_TRIANGLES + i;
        if (at >= join->triangle_count)
            break;
        if (!are_apart(&join->faces[at].box, box, join->reach))
            near[count++] = at;
    }
    return count;
}

/* Returns true if solids of an object may be in contact with each other. */
static bool has_solids(const struct join *join, uint32_t object)
{
    return join->objects[object].solid_count > 1;
}

/* Tests the triangles of two leaves against each other, within *tests_left tests. */
static void test_leaves(struct join *join, uint32_t a, uint32_t b, uint64_t *tests_left)
{
    uint32_t near_a[LEAF_TRIANGLES], near_b[LEAF_TRIANGLES];
    const uint32_t count_a = list_near(join, a, &join->nodes[b].box, near_a);
    const uint32_t count_b = count_a ? list_near(join, b, &join->nodes[a].box, near_b) : 0;
    for (uint32_t i = 0; i < count_a; i++) {
        for (uint32_t k = a == b ? i + 1 : 0; k < count_b && *tests_left; k++) {
            --*tests_left;
            const uint32_t object = join->faces[near_a[i]].object;
            if (object != join->faces[near_b[k]].object || has_solids(join, object))
                test_faces(join, near_a[i], near_b[k]);
        }
    }
}

/* Returns true if some normals in two bounds may be opposite. */
static bool may_oppose(const struct box *a, const struct box *b)
{
    for (int k = 0; k < 3; k++) {
        if (a->min.raw[k] + b->min.raw[k] > OPPOSITE_SUM ||
            a->max.raw[k] + b->max.raw[k] < -OPPOSITE_SUM)
            return false;
    }
    return true;
}

/* Returns true if no normals in two bounds are parallel enough for a contact. */
static bool are_oblique(const struct box *a, const struct box *b)
{
    float cosine_max = 0.0f;
    for (int k = 0; k < 3; k++)
        cosine_max += glm_max(fabsf(a->min.raw[k]), fabsf(a->max.raw[k])) *
                      glm_max(fabsf(b->min.raw[k]), fabsf(b->max.raw[k]));
    return cosine_max < CONTACT_COSINE;
}

/* Tests the triangles of two nodes of the same depth against each other. */
static void join_nodes(struct join *join, uint32_t a, uint32_t b)
{
    const struct node *x = &join->nodes[a], *y = &join->nodes[b];
    const bool is_own = x->object == y->object && x->object != MIXED_OBJECTS;
    uint64_t *tests_left = is_own ? &join->own_tests_left : &join->tests_left;
    if (*tests_left == 0 || (is_own && !has_solids(join, x->object)) ||
        are_apart(&x->box, &y->box, join->reach) || are_oblique(&x->normals, &y->normals) ||
        (is_own && !may_oppose(&x->normals, &y->normals)))
        return;
    --*tests_left;
    if (a >= join->leaf_count) {
        test_leaves(join, a, b, tests_left);
        return;
    }
    for (uint32_t i = 0; i < 4; i++) {
        if (a != b || i != 2)
            join_nodes(join, 2 * a + i / 2, 2 * b + i % 2);
    }
}

/* Returns the limit of the number of tests, which only stacks of many equal objects reach. */
static uint64_t tests_max(const struct join *join)
{
    return TESTS_MIN + (uint64_t)TESTS_PER_TRIANGLE * join->triangle_count;
}

static void measure(struct join *join, uint32_t count)
{
    const struct box all = mesh_box(join->mesh);
    const vec3s far = glms_vec3_maxv(glms_vec3_abs(all.min), glms_vec3_abs(all.max));
    join->round_epsilon = ROUND_EPSILON * glms_vec3_max(far);
    join->reach = join->round_epsilon;
    join->nodes[0].box = all;
    for (uint32_t i = 0; i < count; i++) {
        join->radii[i] = 0.5f * box_diagonal(join->objects[i].box);
        join->reach = fmaxf(join->reach, SCALE_EPSILON * join->radii[i]);
    }
}

/* Fills `faces` in the order of the mesh, which is read sequentially. Returns false when out of
 * memory. */
static bool fill_faces(struct join *join, uint32_t count)
{
    uint32_t *rank_of = malloc((join->triangle_count + (size_t)1) * sizeof(*rank_of));
    if (!rank_of)
        return false;
    for (uint32_t i = 0; i < join->triangle_count; i++)
        rank_of[join->order[i]] = i;
    for (uint32_t k = 0; k < count; k++) {
        const uint32_t first = join->objects[k].first_index / 3;
        for (uint32_t i = first; i < first + join->objects[k].index_count / 3; i++)
            join->faces[rank_of[i]] = face_at(join->mesh, i, k);
    }
    free(rank_of);
    return true;
}

static bool allocate(struct join *join, uint32_t count)
{
    const size_t triangles = join->triangle_count;
    join->leaf_count = 1;
    while ((size_t)join->leaf_count * LEAF_TRIANGLES < triangles)
        join->leaf_count *= 2;
    join->radii = malloc(count * sizeof(*join->radii));
    join->order = malloc((triangles + 1) * sizeof(*join->order));
    join->faces = calloc(triangles + 1, sizeof(*join->faces));
    join->nodes = malloc(2 * (size_t)join->leaf_count * sizeof(*join->nodes));
    join->shells->triangles = calloc(triangles / 32 + 1, sizeof(*join->shells->triangles));
    machine_advise_allocation(join->faces, triangles * sizeof(*join->faces));
    machine_advise_allocation(join->nodes, 2 * (size_t)join->leaf_count * sizeof(*join->nodes));
    return join->radii && join->order && join->faces && join->nodes && join->shells->triangles;
}

bool coincident_shells_find(struct coincident_shells *shells, const struct object *objects,
                            uint32_t count, const struct mesh *mesh)
{
    struct join join = { .shells = shells, .objects = objects, .mesh = mesh };
    join.triangle_count = mesh->index_count / 3;
    *shells = (struct coincident_shells){ 0 };
    if (count < 2 && !(count == 1 && objects[0].solid_count > 1))
        return true;
    bool done = allocate(&join, count);
    if (done) {
        measure(&join, count);
        done = sort_triangles(&join) && fill_faces(&join, count);
    }
    if (done) {
        build_tree(&join);
        join.tests_left = tests_max(&join);
        join.own_tests_left = join.tests_left;
        join_nodes(&join, 1, 1);
        shells->has_more_pairs |= join.tests_left == 0;
    }
    free(join.radii);
    free(join.order);
    free(join.faces);
    free(join.nodes);
    if (!done || !(shells->epsilon > 0.0f))
        coincident_shells_finish(shells);
    return done;
}

void coincident_shells_finish(struct coincident_shells *shells)
{
    free(shells->triangles);
    *shells = (struct coincident_shells){ 0 };
}
