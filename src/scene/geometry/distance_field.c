/*
 * distance_field.c: interior distance field of a mesh, where its winding number is not 0.
 *
 * Computing the distance of every texel to every triangle would be too slow. Only texels near a
 * triangle test it directly; the others test the nearest triangles of their neighbours, in sweeps
 * over the grid (Tsai 2002, Rapid and accurate computation of the distance function using grids).
 * Distances are exact, since they are computed to triangles and not propagated.
 */
#include "src/scene/geometry/distance_field.h"
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>
#include "shaders/inclusions/medium_density.h"

enum {
    SIZE = MEDIUM_SIZE,
    COUNT = SIZE * SIZE * SIZE,
    SWEEPS = 4, /* forward and backward, twice */
};

#define NOWHERE UINT32_MAX

struct work {
    const struct mesh *mesh;
    struct box box;
    vec3s cell;        /* size of a texel */
    uint32_t *nearest; /* index of each texel's nearest triangle, or NOWHERE */
    uint8_t *changed;  /* last sweep that changed each texel */
    float *distances2;
    int32_t *windings;
};

static size_t texel_at(int x, int y, int z)
{
    return ((size_t)z * SIZE + (size_t)y) * SIZE + (size_t)x;
}

static vec3s center_of(const struct work *work, int x, int y, int z)
{
    const vec3s at = { { (float)x + 0.5f, (float)y + 0.5f, (float)z + 0.5f } };
    return glms_vec3_add(work->box.min, glms_vec3_mul(at, work->cell));
}

static void corners_of(const struct mesh *mesh, uint32_t triangle, vec3s corners[static 3])
{
    for (uint32_t k = 0; k < 3; k++)
        corners[k] = mesh->vertices[mesh->indices[triangle * 3 + k]].position;
}

/* Returns the squared distance from p to the segment from a to b. */
static float line_distance2(vec3s p, vec3s a, vec3s b)
{
    const vec3s along = glms_vec3_sub(b, a);
    const vec3s to = glms_vec3_sub(p, a);
    const float t = glms_vec3_dot(to, along) / fmaxf(glms_vec3_norm2(along), 1e-30f);
    return glms_vec3_norm2(glms_vec3_sub(to, glms_vec3_scale(along, glm_clamp(t, 0.0f, 1.0f))));
}

/* Returns the squared distance from p to a triangle. If p is beyond any edge, measures to the
 * nearest of these edges. Otherwise, measures to the triangle's plane. */
static float distance2(const struct work *work, uint32_t triangle, vec3s p)
{
    vec3s c[3];
    corners_of(work->mesh, triangle, c);
    const vec3s n = glms_vec3_cross(glms_vec3_sub(c[1], c[0]), glms_vec3_sub(c[2], c[0]));
    const float n2 = glms_vec3_norm2(n);
    float nearest2 = INFINITY;
    for (int k = 0; k < 3; k++) {
        const vec3s next = c[(k + 1) % 3];
        const vec3s inwards = glms_vec3_cross(n, glms_vec3_sub(next, c[k]));
        const bool is_inside_edge = glms_vec3_dot(inwards, glms_vec3_sub(p, c[k])) >= 0.0f;
        if (!is_inside_edge || !(n2 > 0.0f))
            nearest2 = fminf(nearest2, line_distance2(p, c[k], next));
    }
    if (nearest2 < INFINITY)
        return nearest2;
    const float height = glms_vec3_dot(glms_vec3_sub(p, c[0]), n);
    return height * height / n2;
}

static void test_triangle(const struct work *work, uint32_t triangle, int x, int y, int z)
{
    const size_t texel = texel_at(x, y, z);
    if (work->nearest[texel] == triangle)
        return;
    const float found = distance2(work, triangle, center_of(work, x, y, z));
    if (found < work->distances2[texel]) {
        work->distances2[texel] = found;
        work->nearest[texel] = triangle;
    }
}

/* Range of texel coordinates along x, y and z, with both ends included. */
struct range {
    int first[3], last[3];
};

static struct range range_of(const struct work *work, const vec3s corners[static 3], int more)
{
    struct range range;
    for (int k = 0; k < 3; k++) {
        const float a = corners[0].raw[k], b = corners[1].raw[k], c = corners[2].raw[k];
        const float from = (fminf(a, fminf(b, c)) - work->box.min.raw[k]) / work->cell.raw[k];
        const float to = (fmaxf(a, fmaxf(b, c)) - work->box.min.raw[k]) / work->cell.raw[k];
        range.first[k] = (int)fmaxf(floorf(from - 0.5f) - (float)more, 0.0f);
        range.last[k] = (int)fminf(ceilf(to - 0.5f) + (float)more, SIZE - 1);
    }
    return range;
}

static void test_near(const struct work *work, uint32_t triangle)
{
    vec3s corners[3];
    corners_of(work->mesh, triangle, corners);
    const struct range r = range_of(work, corners, 0);
    for (int z = r.first[2]; z <= r.last[2]; z++) {
        for (int y = r.first[1]; y <= r.last[1]; y++) {
            for (int x = r.first[0]; x <= r.last[0]; x++)
                test_triangle(work, triangle, x, y, z);
        }
    }
}

/* Tests a texel against the nearest triangles of 13 neighbours: if `side` is -1, those earlier in
 * scan order; if `side` is 1, those later. Skips neighbours unchanged since sweep `since`. */
static void test_neighbours(const struct work *work, size_t texel, int side, int since)
{
    const int x = (int)(texel % SIZE), y = (int)(texel / SIZE % SIZE),
              z = (int)(texel / SIZE / SIZE);
    uint32_t tested[13];
    int count = 0;
    for (int i = 14; i < 27; i++) {
        const int nx = x + side * (i % 3 - 1);
        const int ny = y + side * (i / 3 % 3 - 1);
        const int nz = z + side * (i / 9 - 1);
        if (nx < 0 || ny < 0 || nz < 0 || nx >= SIZE || ny >= SIZE || nz >= SIZE)
            continue;
        const size_t neighbour = texel_at(nx, ny, nz);
        const uint32_t nearest = work->nearest[neighbour];
        bool is_new = nearest != NOWHERE && work->changed[neighbour] >= since;
        for (int k = 0; k < count && is_new; k++)
            is_new = tested[k] != nearest;
        if (is_new) {
            tested[count++] = nearest;
            test_triangle(work, nearest, x, y, z);
        }
    }
}

/* Propagates nearest triangles between neighbouring texels inside the mesh. Skips neighbours that
 * have not changed since the previous sweep in this direction. */
static void sweep(const struct work *work, int number)
{
    const bool is_forward = number % 2 == 0;
    const int since = number < 2 ? 0 : number - 1;
    for (size_t i = 0; i < COUNT; i++) {
        const size_t texel = is_forward ? i : COUNT - 1 - i;
        const uint32_t before = work->nearest[texel];
        if (!work->windings[texel])
            continue;
        test_neighbours(work, texel, is_forward ? -1 : 1, since);
        if (work->nearest[texel] != before)
            work->changed[texel] = (uint8_t)number;
    }
}

/* Returns twice the signed area of the triangle a, b, (y, z) in the yz plane. */
static double area(vec3s a, vec3s b, double y, double z)
{
    return ((double)b.y - (double)a.y) * (z - (double)a.z) -
           ((double)b.z - (double)a.z) * (y - (double)a.y);
}

/* Adds a triangle's winding (1 or -1) to all texels behind the triangle along +x. Texel rows are
 * shifted slightly, because rows must not pass through edges of a mesh aligned with the grid. */
static void add_winding(const struct work *work, uint32_t triangle)
{
    vec3s c[3];
    corners_of(work->mesh, triangle, c);
    const struct range r = range_of(work, c, 1);
    for (int z = r.first[2]; z <= r.last[2]; z++) {
        for (int y = r.first[1]; y <= r.last[1]; y++) {
            const vec3s at = center_of(work, 0, y, z);
            const double row_y = (double)at.y + 1.234567e-4 * (double)work->cell.y;
            const double row_z = (double)at.z + 2.718282e-4 * (double)work->cell.z;
            const double a = area(c[1], c[2], row_y, row_z);
            const double b = area(c[2], c[0], row_y, row_z);
            const double d = area(c[0], c[1], row_y, row_z);
            if (!((a > 0 && b > 0 && d > 0) || (a < 0 && b < 0 && d < 0)))
                continue;
            const double x =
                (a * (double)c[0].x + b * (double)c[1].x + d * (double)c[2].x) / (a + b + d);
            const double first = ceil((x - (double)at.x) / (double)work->cell.x);
            for (int i = (int)fmax(first, 0.0); i < SIZE; i++)
                work->windings[texel_at(i, y, z)] += a > 0 ? 1 : -1;
        }
    }
}

/* Returns a point's distance to the triangles that are stored for a texel and its neighbours. */
static float depth_near(const struct work *work, const int texel[static 3], vec3s point)
{
    float nearest2 = INFINITY;
    for (int i = 0; i < 27; i++) {
        const int x = texel[0] + i % 3 - 1, y = texel[1] + i / 3 % 3 - 1, z = texel[2] + i / 9 - 1;
        if (x < 0 || y < 0 || z < 0 || x >= SIZE || y >= SIZE || z >= SIZE)
            continue;
        const uint32_t nearest = work->nearest[texel_at(x, y, z)];
        if (nearest != NOWHERE)
            nearest2 = fminf(nearest2, distance2(work, nearest, point));
    }
    return sqrtf(nearest2);
}

/* Returns the maximum depth near the deepest texel, searched in steps of a quarter texel. */
static float find_maximum(const struct work *work, size_t index)
{
    const int texel[3] = { (int)(index % SIZE), (int)(index / SIZE % SIZE),
                           (int)(index / SIZE / SIZE) };
    const vec3s center = center_of(work, texel[0], texel[1], texel[2]);
    float most = 0.0f;
    for (int i = 0; i < 729; i++) { /* steps of a quarter texel */
        const int x = i % 9 - 4, y = i / 9 % 9 - 4, z = i / 81 - 4;
        const vec3s step = { { (float)x, (float)y, (float)z } };
        const vec3s moved = glms_vec3_scale(glms_vec3_mul(step, work->cell), 0.25f);
        most = fmaxf(most, depth_near(work, texel, glms_vec3_add(center, moved)));
    }
    return most;
}

static void measure(struct distance_field *field, const struct work *work)
{
    size_t best = 0;
    for (size_t i = 0; i < COUNT; i++) {
        const bool is_inside = work->windings[i] && work->nearest[i] != NOWHERE;
        field->texels[i] = is_inside ? sqrtf(work->distances2[i]) : 0.0f;
        best = field->texels[i] > field->texels[best] ? i : best;
    }
    if (!(field->texels[best] > 0.0f))
        return;
    field->max_depth = find_maximum(work, best);
    for (size_t i = 0; i < COUNT; i++)
        field->texels[i] /= field->max_depth;
}

static struct box box_of(const struct mesh *mesh)
{
    const vec3s first = mesh->vertices[mesh->indices[0]].position;
    struct box box = { first, first };
    for (uint32_t i = 1; i < mesh->index_count; i++) {
        const vec3s corner = mesh->vertices[mesh->indices[i]].position;
        box.min = glms_vec3_minv(box.min, corner);
        box.max = glms_vec3_maxv(box.max, corner);
    }
    return box;
}

bool distance_field_init(struct distance_field *field, const struct mesh *mesh)
{
    *field = (struct distance_field){ 0 };
    if (!mesh->index_count)
        return true;
    struct work work = { .mesh = mesh, .box = box_of(mesh) };
    field->box = work.box;
    for (int k = 0; k < 3; k++) {
        const float side = work.box.max.raw[k] - work.box.min.raw[k];
        work.cell.raw[k] = fmaxf(side, 1e-6f * box_diagonal(work.box)) / SIZE;
    }
    work.nearest = malloc(COUNT * sizeof(*work.nearest));
    work.changed = calloc(COUNT, sizeof(*work.changed));
    work.distances2 = malloc(COUNT * sizeof(*work.distances2));
    work.windings = calloc(COUNT, sizeof(*work.windings));
    field->texels = malloc(COUNT * sizeof(*field->texels));
    const bool done =
        work.nearest && work.changed && work.distances2 && work.windings && field->texels;
    for (size_t i = 0; done && i < COUNT; i++) {
        work.nearest[i] = NOWHERE;
        work.distances2[i] = INFINITY;
    }
    for (uint32_t i = 0; done && i < mesh->index_count / 3; i++) {
        test_near(&work, i);
        add_winding(&work, i);
    }
    for (int i = 0; done && i < SWEEPS; i++)
        sweep(&work, i);
    if (done)
        measure(field, &work);
    else
        distance_field_finish(field);
    free(work.nearest);
    free(work.changed);
    free(work.distances2);
    free(work.windings);
    return done;
}

void distance_field_finish(struct distance_field *field)
{
    free(field->texels);
    *field = (struct distance_field){ 0 };
}

float distance_field_at(const struct distance_field *field, vec3s point)
{
    int lower[3];
    float weights[3], sum = 0.0f;
    if (!field->texels)
        return 0.0f;
    for (int k = 0; k < 3; k++) {
        const float side = field->box.max.raw[k] - field->box.min.raw[k];
        const float at = (point.raw[k] - field->box.min.raw[k]) / side * SIZE - 0.5f;
        const float clamped = glm_clamp(side > 0.0f ? at : 0.0f, 0.0f, SIZE - 1.0f);
        lower[k] = (int)fminf(clamped, SIZE - 2);
        weights[k] = clamped - (float)lower[k];
    }
    for (int i = 0; i < 8; i++) {
        const int x = i & 1, y = i >> 1 & 1, z = i >> 2;
        const float weight = (x ? weights[0] : 1.0f - weights[0]) *
                             (y ? weights[1] : 1.0f - weights[1]) *
                             (z ? weights[2] : 1.0f - weights[2]);
        sum += weight * field->texels[texel_at(lower[0] + x, lower[1] + y, lower[2] + z)];
    }
    return sum;
}
