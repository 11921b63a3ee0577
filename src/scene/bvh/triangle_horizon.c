/*
 * triangle_horizon.c: computes an upper bound of each triangle's horizon by BVH traversal.
 *
 * Most rays that leave a convex or nearly convex object hit nothing, but still cost a traversal.
 * The horizon of a triangle is the largest elevation angle above its plane at which any other
 * triangle is visible from it. A ray that leaves more steeply cannot hit the object.
 *
 * The child with the higher elevation is visited first, and subtrees below the horizon found so far
 * are skipped. The previous triangle's highest occluder is tested first, since neighbours usually
 * share it. Visits are capped; triangles beyond the cap, or with steep horizons, are marked
 * unknown, and their rays are traced.
 */
#include "src/scene/bvh/triangle_horizon.h"
#include <float.h>
#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

enum {
    THREADS_MAX = 16,
    THREAD_MIN = 1 << 12, /* minimum triangles per thread */
    BLOCK = 64,           /* triangles per block, see find_horizons() */
    VISITS_MAX = 1024,    /* maximum node visits per triangle */
};

/* Limits of a horizon's tangent. Steeper horizons cull few rays. Flatter ones are slow to find. */
static const float steepest = 2.6f, flattest = 0.143f;

/* Triangle whose horizon is computed. */
struct receiver {
    float corners[3][3], center[3];
    float radius;          /* bounding radius of the triangle */
    float plane[4];        /* plane equation: unit normal, negated distance from the origin */
    float edge_dirs[3][3]; /* in-plane outward normal of each edge */
    uint32_t at;           /* triangle index in leaf order */
};

static float dot(const float a[static 3], const float b[static 3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(float to[static 3], const float a[static 3], const float b[static 3])
{
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        to[k] = a[i] * b[j] - a[j] * b[i];
    }
}

/* Returns false for a zero vector. */
static bool normalize(float v[static 3])
{
    const float length = sqrtf(dot(v, v));
    for (int k = 0; k < 3 && length > 0.0f; k++)
        v[k] /= length;
    return length > 0.0f;
}

struct search {
    const struct bvh_two_level *hierarchy;
    const struct bvh_part *part;
    float epsilon; /* maximum height that counts as a rounding error, metres */
    uint8_t *horizons;
};

static void copy_corners(float to[static 3][3], const struct search *search, uint32_t at)
{
    const uint32_t triangle = search->part->triangles[search->hierarchy->builder.order[at]];
    for (uint32_t k = 0; k < 3; k++)
        memcpy(to[k], bvh_corner(search->part, triangle, k)->position.raw, sizeof(to[k]));
}

/* Sets up the triangle at leaf-order index `at`. Returns false for a degenerate triangle. */
static bool receiver_init(struct receiver *from, const struct search *search, uint32_t at)
{
    float sides[3][3];
    from->at = at;
    copy_corners(from->corners, search, at);
    for (int k = 0; k < 3; k++) {
        from->center[k] = (from->corners[0][k] + from->corners[1][k] + from->corners[2][k]) / 3.0f;
        for (int i = 0; i < 3; i++)
            sides[i][k] = from->corners[(i + 1) % 3][k] - from->corners[i][k];
    }
    cross(from->plane, sides[0], sides[1]);
    if (!normalize(from->plane))
        return false;
    from->plane[3] = -dot(from->plane, from->center);
    from->radius = 0.0f;
    for (int i = 0; i < 3; i++) {
        cross(from->edge_dirs[i], sides[i], from->plane);
        if (!normalize(from->edge_dirs[i]))
            return false;
        float offset[3];
        for (int k = 0; k < 3; k++)
            offset[k] = from->corners[i][k] - from->center[k];
        from->radius = fmaxf(from->radius, sqrtf(dot(offset, offset)));
    }
    return true;
}

/* Returns the largest dot product of `dir` with a corner of the triangle. */
static float extent_along(const struct receiver *from, const float dir[static 3])
{
    return fmaxf(dot(dir, from->corners[0]),
                 fmaxf(dot(dir, from->corners[1]), dot(dir, from->corners[2])));
}

/* Returns an upper bound of the tangent of a box's elevation angle above a triangle: the box's
 * maximum height divided by its minimum in-plane distance. */
static float box_elevation(const struct receiver *from, const struct bvh_box *box, float epsilon)
{
    const float *normal = from->plane;
    float dir[3], half[3];
    float up = 0.0f, half_height = 0.0f, extent = 0.0f;
    for (int k = 0; k < 3; k++) {
        dir[k] = 0.5f * box->low[k] + 0.5f * box->high[k] - from->center[k];
        half[k] = 0.5f * (box->high[k] - box->low[k]);
        up += normal[k] * dir[k];
        half_height += fabsf(normal[k]) * half[k];
    }
    if (up + half_height <= epsilon)
        return 0.0f;
    for (int k = 0; k < 3; k++) {
        dir[k] -= up * normal[k];
        extent += fabsf(dir[k]) * half[k];
    }
    const float square = dot(dir, dir);
    const float nearest = square - extent - from->radius * sqrtf(square);
    return nearest > 0.0f ? (up + half_height) * sqrtf(square) / nearest : FLT_MAX;
}

/* Returns the tangent of a triangle's elevation angle above the receiver's plane, from distances
 * along `dir`. Corners that the receiver shares have distance 0 and height 0. */
static float elevation_along(const struct receiver *from, float corners[static 3][3],
                             const float dir[static 3], float epsilon)
{
    const float reach = extent_along(from, dir);
    float most = 0.0f;
    for (int i = 0; i < 3; i++) {
        const float height = dot(from->plane, corners[i]) + from->plane[3];
        const float away = dot(dir, corners[i]) - reach;
        if (away < -epsilon || (height > epsilon && away <= 0.0f))
            return FLT_MAX;
        if (height > epsilon)
            most = fmaxf(most, height / away);
    }
    return most;
}

/* Returns the lowest elevation tangent of several directions, but stops at one <= `enough`. */
static float triangle_elevation(const struct receiver *from, const struct search *search,
                                uint32_t at, float enough)
{
    float corners[3][3], dir[3], top = -FLT_MAX;
    copy_corners(corners, search, at);
    for (int i = 0; i < 3; i++)
        top = fmaxf(top, dot(from->plane, corners[i]) + from->plane[3]);
    if (top <= search->epsilon)
        return 0.0f;
    for (int k = 0; k < 3; k++)
        dir[k] = (corners[0][k] + corners[1][k] + corners[2][k]) / 3.0f - from->center[k];
    const float up = dot(dir, from->plane);
    for (int k = 0; k < 3; k++)
        dir[k] -= up * from->plane[k];
    float lowest = normalize(dir) ? elevation_along(from, corners, dir, search->epsilon) : FLT_MAX;
    for (int i = 0; i < 3 && lowest > enough; i++)
        lowest = fminf(lowest, elevation_along(from, corners, from->edge_dirs[i], search->epsilon));
    return lowest;
}

/* Traversal stack entry: a node, and an upper bound of the elevation tangent of its box. */
struct candidate {
    float most;
    uint32_t node;
};

/* Returns the tangent of a triangle's horizon angle, or a value above `steepest` if unknown. Tests
 * triangle *highest first. Sets *highest to the triangle that defines the horizon. */
static float horizon_of(const struct receiver *from, const struct search *search, uint32_t *highest)
{
    const struct bvh_node *nodes = search->hierarchy->builder.nodes;
    struct candidate stack[BVH_DEPTH_MAX + 2];
    uint32_t count = 0, visits = 0;
    float horizon = flattest;
    if (*highest != from->at)
        horizon = fmaxf(horizon, triangle_elevation(from, search, *highest, horizon));
    stack[count++] = (struct candidate){ FLT_MAX, search->hierarchy->root };
    while (count && horizon <= steepest) {
        const struct candidate candidate = stack[--count];
        const struct bvh_node *node = &nodes[candidate.node];
        if (candidate.most <= horizon)
            continue;
        for (uint32_t i = node->first; !node->children[0] && i < node->first + node->count; i++) {
            const float most = i == from->at ? 0.0f : triangle_elevation(from, search, i, horizon);
            *highest = most > horizon ? i : *highest;
            horizon = fmaxf(horizon, most);
        }
        if (!node->children[0])
            continue;
        if (++visits > VISITS_MAX)
            return FLT_MAX;
        struct candidate a = { 0.0f, node->children[0] }, b = { 0.0f, node->children[1] };
        a.most = box_elevation(from, &nodes[a.node].box, search->epsilon);
        b.most = box_elevation(from, &nodes[b.node].box, search->epsilon);
        stack[count++] = a.most < b.most ? a : b;
        stack[count++] = a.most < b.most ? b : a;
    }
    return horizon;
}

/* Range of triangles of one thread. */
struct range {
    const struct search *search;
    uint32_t first, end;
};

static void *find_horizons(void *user)
{
    const struct range *range = user;
    uint32_t highest = range->first;
    for (uint32_t i = range->first; i < range->end; i++) {
        struct receiver from;
        uint8_t *horizon = &range->search->horizons[i];
        *horizon = BVH_HORIZON_UNKNOWN;
        highest = i % BLOCK ? highest : i; /* blocks make it independent of threads */
        if (!receiver_init(&from, range->search, i))
            continue;
        const float candidate = horizon_of(&from, range->search, &highest);
        if (candidate <= steepest)
            *horizon = (uint8_t)ceilf((float)BVH_HORIZON_STEPS *
                                      (candidate / sqrtf(1.0f + candidate * candidate) + 1e-3f));
    }
    return NULL;
}

static float epsilon_of(const struct bvh_box *box)
{
    float most = 0.0f;
    for (int k = 0; k < 3; k++)
        most = fmaxf(most, fmaxf(fabsf(box->low[k]), fabsf(box->high[k])));
    return 4e-7f * most;
}

uint8_t *bvh_horizons_compute(const struct bvh_two_level *hierarchy, const struct bvh_part *part,
                              uint32_t threads)
{
    struct range ranges[THREADS_MAX];
    pthread_t workers[THREADS_MAX];
    bool is_parallel[THREADS_MAX] = { false };
    if (!part->count || part->count > BVH_HORIZON_TRIANGLES_MAX)
        return NULL;
    struct search search = { hierarchy, part,
                             epsilon_of(&hierarchy->builder.nodes[hierarchy->root].box),
                             malloc(part->count) };
    uint32_t count = part->count / THREAD_MIN + 1;
    count = count < threads ? count : threads ? threads : 1;
    count = count < THREADS_MAX ? count : THREADS_MAX;
    const uint32_t block_count = part->count / count / BLOCK * BLOCK;
    for (uint32_t i = 0; i < count && search.horizons; i++) {
        const uint32_t first = i * block_count,
                       end = i + 1 < count ? first + block_count : part->count;
        ranges[i] = (struct range){ &search, first, end };
        is_parallel[i] =
            i + 1 < count && !pthread_create(&workers[i], NULL, find_horizons, &ranges[i]);
        if (!is_parallel[i])
            (void)find_horizons(&ranges[i]);
    }
    for (uint32_t i = 0; i < count; i++) {
        if (is_parallel[i])
            pthread_join(workers[i], NULL);
    }
    return search.horizons;
}

bool bvh_has_horizon_grid(const struct bvh *bvh, const struct bvh_two_level *objects)
{
    return objects->horizons && bvh->object_count == 1;
}

/* Returns a quantised horizon, raised by the largest angle between face and vertex normals. */
static uint8_t widened_horizon(const struct bvh_two_level *hierarchy, const struct bvh_part *part,
                               uint32_t at)
{
    const struct search search = { .hierarchy = hierarchy, .part = part };
    const double horizon = (double)hierarchy->horizons[at] / BVH_HORIZON_STEPS;
    const uint32_t triangle = part->triangles[hierarchy->builder.order[at]];
    struct receiver from;
    double cosine = 1.0;
    if (horizon > 1.0 || !receiver_init(&from, &search, at))
        return BVH_HORIZON_UNKNOWN;
    for (uint32_t k = 0; k < 3; k++) {
        const float *normal = bvh_corner(part, triangle, k)->normal.raw;
        cosine = fmin(cosine, (double)(dot(normal, from.plane) / sqrtf(dot(normal, normal))));
    }
    const double angle = asin(horizon) + acos(fmax(cosine, 0.0));
    if (!(cosine > 0.0 && angle < 1.5))
        return BVH_HORIZON_UNKNOWN;
    return (uint8_t)ceil(BVH_HORIZON_STEPS * sin(angle));
}

struct grid {
    uint8_t cells[BVH_HORIZON_GRID][BVH_HORIZON_GRID][BVH_HORIZON_GRID]; /* horizon of each cell */
    bool is_occupied[BVH_HORIZON_GRID][BVH_HORIZON_GRID]
                    [BVH_HORIZON_GRID]; /* true if the cell contains triangles */
};

static void widen_cells(struct grid *grid, const int first[static 3], const int last[static 3],
                        uint8_t horizon)
{
    for (int z = first[2]; z <= last[2]; z++) {
        for (int y = first[1]; y <= last[1]; y++) {
            for (int x = first[0]; x <= last[0]; x++) {
                uint8_t *cell = &grid->cells[z][y][x];
                *cell = grid->is_occupied[z][y][x] && *cell > horizon ? *cell : horizon;
                grid->is_occupied[z][y][x] = true;
            }
        }
    }
}

void bvh_horizon_grid_write(struct bvh *bvh, const struct bvh_two_level *objects,
                            const struct bvh_part *part)
{
    /* maximum distance of a hit point from its triangle, in cells */
    static const float tolerance = 0.1f;
    const struct bvh_box *all = &objects->builder.nodes[objects->root].box;
    struct grid grid = { 0 };
    memset(grid.cells, BVH_HORIZON_UNKNOWN, sizeof(grid.cells));
    for (int k = 0; k < 3; k++) {
        bvh->grid_low.raw[k] = all->low[k];
        bvh->grid_scale.raw[k] = (float)BVH_HORIZON_GRID / fmaxf(all->high[k] - all->low[k], 1e-9f);
    }
    for (uint32_t i = 0; i < part->count; i++) {
        const struct bvh_box triangle_box =
            bvh_triangle_box(part, part->triangles[objects->builder.order[i]]);
        int first[3], last[3];
        for (int k = 0; k < 3; k++) {
            const float low = bvh->grid_low.raw[k], scale = bvh->grid_scale.raw[k];
            first[k] = (int)fmaxf((triangle_box.low[k] - low) * scale - tolerance, 0.0f);
            last[k] =
                (int)fminf((triangle_box.high[k] - low) * scale + tolerance, BVH_HORIZON_GRID - 1);
        }
        widen_cells(&grid, first, last, widened_horizon(objects, part, i));
    }
    bvh->grid = bvh->corners.count;
    bvh->corners.count += BVH_HORIZON_GRID_WORDS;
    for (uint32_t i = 0; i < sizeof(grid.cells); i++)
        bvh->corners.all[bvh->grid + i / 32][i / 8 % 4] |= (uint32_t)(&grid.cells[0][0][0])[i]
                                                           << i % 8 * 4;
}
