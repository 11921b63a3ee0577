/* tree_horizon.c: bounds how high a part's triangles rise above the planes of others. */
#include "src/scene/tree_horizon.h"
#include <float.h>
#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

enum {
    THREADS_MAX = 16,
    THREAD_MIN = 1 << 12, /* triangles that are worth a thread */
    BLOCK = 64,           /* triangles of which each begins with what the one before found */
    VISITS_MAX = 1024,    /* nodes that are looked at for a triangle */
};

/* Steeper horizons are of no use, and flatter ones take long: tangents. */
static const float steepest = 2.6f, flattest = 0.143f;

/* A triangle from which others are seen. */
struct outlook {
    float corners[3][3], middle[3];
    float radius;       /* around the middle */
    float plane[4];     /* unit normal; distance of the origin before it */
    float across[3][3]; /* in the plane, away from each side */
    uint32_t at;        /* in the order of the leaves */
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

/* Returns false for a vector without a direction. */
static bool normalize(float v[static 3])
{
    const float length = sqrtf(dot(v, v));
    for (int k = 0; k < 3 && length > 0.0f; k++)
        v[k] /= length;
    return length > 0.0f;
}

/* What all threads have in common. */
struct search {
    const struct tree_shape *shape;
    const struct tree_part *part;
    float room; /* heights that are rounding */
    uint8_t *horizons;
};

static void copy_corners(float to[static 3][3], const struct search *search, uint32_t at)
{
    const uint32_t triangle = search->part->triangles[search->shape->draft.order[at]];
    for (uint32_t k = 0; k < 3; k++)
        memcpy(to[k], tree_corner(search->part, triangle, k)->position.raw, sizeof(to[k]));
}

/* Returns false for a triangle without an area. */
static bool look_out(struct outlook *from, const struct search *search, uint32_t at)
{
    float sides[3][3];
    from->at = at;
    copy_corners(from->corners, search, at);
    for (int k = 0; k < 3; k++) {
        from->middle[k] = (from->corners[0][k] + from->corners[1][k] + from->corners[2][k]) / 3.0f;
        for (int i = 0; i < 3; i++)
            sides[i][k] = from->corners[(i + 1) % 3][k] - from->corners[i][k];
    }
    cross(from->plane, sides[0], sides[1]);
    if (!normalize(from->plane))
        return false;
    from->plane[3] = -dot(from->plane, from->middle);
    from->radius = 0.0f;
    for (int i = 0; i < 3; i++) {
        cross(from->across[i], sides[i], from->plane);
        if (!normalize(from->across[i]))
            return false;
        float arm[3];
        for (int k = 0; k < 3; k++)
            arm[k] = from->corners[i][k] - from->middle[k];
        from->radius = fmaxf(from->radius, sqrtf(dot(arm, arm)));
    }
    return true;
}

/* Returns how far the triangle reaches along a direction. */
static float reach_of(const struct outlook *from, const float dir[static 3])
{
    return fmaxf(dot(dir, from->corners[0]),
                 fmaxf(dot(dir, from->corners[1]), dot(dir, from->corners[2])));
}

/* Returns the tangent of the elevation under which a box may be seen: its height over the least
 * distance along a direction in the plane, towards its middle. */
static float rise_of_box(const struct outlook *from, const struct tree_box *box, float room)
{
    const float *normal = from->plane;
    float dir[3], half[3];
    float up = 0.0f, thick = 0.0f, wide = 0.0f;
    for (int k = 0; k < 3; k++) {
        dir[k] = 0.5f * box->low[k] + 0.5f * box->high[k] - from->middle[k];
        half[k] = 0.5f * (box->high[k] - box->low[k]);
        up += normal[k] * dir[k];
        thick += fabsf(normal[k]) * half[k];
    }
    if (up + thick <= room)
        return 0.0f;
    for (int k = 0; k < 3; k++) {
        dir[k] -= up * normal[k];
        wide += fabsf(dir[k]) * half[k];
    }
    const float square = dot(dir, dir);
    const float near = square - wide - from->radius * sqrtf(square);
    return near > 0.0f ? (up + thick) * sqrtf(square) / near : FLT_MAX;
}

/* The same of a triangle, along a direction in the plane; corners that both have are at no
 * distance, and of no height. */
static float rise_along(const struct outlook *from, float corners[static 3][3],
                        const float dir[static 3], float room)
{
    const float reach = reach_of(from, dir);
    float most = 0.0f;
    for (int i = 0; i < 3; i++) {
        const float height = dot(from->plane, corners[i]) + from->plane[3];
        const float away = dot(dir, corners[i]) - reach;
        if (away < -room || (height > room && away <= 0.0f))
            return FLT_MAX;
        if (height > room)
            most = fmaxf(most, height / away);
    }
    return most;
}

/* Of several directions that which tells of least counts, or the first that tells of `enough`. */
static float rise_of_triangle(const struct outlook *from, const struct search *search, uint32_t at,
                              float enough)
{
    float corners[3][3], dir[3], top = -FLT_MAX;
    copy_corners(corners, search, at);
    for (int i = 0; i < 3; i++)
        top = fmaxf(top, dot(from->plane, corners[i]) + from->plane[3]);
    if (top <= search->room)
        return 0.0f;
    for (int k = 0; k < 3; k++)
        dir[k] = (corners[0][k] + corners[1][k] + corners[2][k]) / 3.0f - from->middle[k];
    const float up = dot(dir, from->plane);
    for (int k = 0; k < 3; k++)
        dir[k] -= up * from->plane[k];
    float least = normalize(dir) ? rise_along(from, corners, dir, search->room) : FLT_MAX;
    for (int i = 0; i < 3 && least > enough; i++)
        least = fminf(least, rise_along(from, corners, from->across[i], search->room));
    return least;
}

/* A node that may rise above the horizon. */
struct rise {
    float most;
    uint32_t node;
};

/* Returns the tangent of the horizon, or more than `steepest`. What may rise most comes first, and
 * before it *highest, a triangle, which becomes the one that has risen most. */
static float horizon_of(const struct outlook *from, const struct search *search, uint32_t *highest)
{
    const struct tree_node *nodes = search->shape->draft.nodes;
    struct rise stack[TREE_DEPTH_MAX + 2];
    uint32_t count = 0, visits = 0;
    float horizon = flattest;
    if (*highest != from->at)
        horizon = fmaxf(horizon, rise_of_triangle(from, search, *highest, horizon));
    stack[count++] = (struct rise){ FLT_MAX, search->shape->root };
    while (count && horizon <= steepest) {
        const struct rise rise = stack[--count];
        const struct tree_node *node = &nodes[rise.node];
        if (rise.most <= horizon)
            continue;
        for (uint32_t i = node->first; !node->children[0] && i < node->first + node->count; i++) {
            const float most = i == from->at ? 0.0f : rise_of_triangle(from, search, i, horizon);
            *highest = most > horizon ? i : *highest;
            horizon = fmaxf(horizon, most);
        }
        if (!node->children[0])
            continue;
        if (++visits > VISITS_MAX)
            return FLT_MAX;
        struct rise a = { 0.0f, node->children[0] }, b = { 0.0f, node->children[1] };
        a.most = rise_of_box(from, &nodes[a.node].box, search->room);
        b.most = rise_of_box(from, &nodes[b.node].box, search->room);
        stack[count++] = a.most < b.most ? a : b;
        stack[count++] = a.most < b.most ? b : a;
    }
    return horizon;
}

/* Triangles of a thread. */
struct range {
    const struct search *search;
    uint32_t first, end;
};

static void *find_range(void *user)
{
    const struct range *range = user;
    uint32_t highest = range->first;
    for (uint32_t i = range->first; i < range->end; i++) {
        struct outlook from;
        uint8_t *horizon = &range->search->horizons[i];
        *horizon = TREE_HORIZON_UNKNOWN;
        highest = i % BLOCK ? highest : i; /* the same for any number of threads */
        if (!look_out(&from, range->search, i))
            continue;
        const float rise = horizon_of(&from, range->search, &highest);
        if (rise <= steepest)
            *horizon = (uint8_t)ceilf((float)TREE_HORIZON_STEPS *
                                      (rise / sqrtf(1.0f + rise * rise) + 1e-3f));
    }
    return NULL;
}

static float room_of(const struct tree_box *box)
{
    float most = 0.0f;
    for (int k = 0; k < 3; k++)
        most = fmaxf(most, fmaxf(fabsf(box->low[k]), fabsf(box->high[k])));
    return 4e-7f * most;
}

uint8_t *tree_horizons(const struct tree_shape *shape, const struct tree_part *part,
                       uint32_t threads)
{
    struct range ranges[THREADS_MAX];
    pthread_t others[THREADS_MAX];
    bool is_beside[THREADS_MAX] = { false };
    if (!part->count || part->count > TREE_HORIZON_MAX)
        return NULL;
    struct search search = { shape, part, room_of(&shape->draft.nodes[shape->root].box),
                             malloc(part->count) };
    uint32_t count = part->count / THREAD_MIN + 1;
    count = count < threads ? count : threads ? threads : 1;
    count = count < THREADS_MAX ? count : THREADS_MAX;
    const uint32_t share = part->count / count / BLOCK * BLOCK;
    for (uint32_t i = 0; i < count && search.horizons; i++) {
        const uint32_t first = i * share, end = i + 1 < count ? first + share : part->count;
        ranges[i] = (struct range){ &search, first, end };
        is_beside[i] = i + 1 < count && !pthread_create(&others[i], NULL, find_range, &ranges[i]);
        if (!is_beside[i])
            (void)find_range(&ranges[i]);
    }
    for (uint32_t i = 0; i < count; i++) {
        if (is_beside[i])
            pthread_join(others[i], NULL);
    }
    return search.horizons;
}

/* ---- the grid ---- */

bool tree_has_grid(const struct tree *tree, const struct tree_shape *objects)
{
    return objects->horizons && tree->shells == 1;
}

/* Returns the horizon of a triangle above any plane whose normal is between those of its corners,
 * in steps. */
static uint8_t widest_of(const struct tree_shape *shape, const struct tree_part *part, uint32_t at)
{
    const struct search search = { .shape = shape, .part = part };
    const double horizon = (double)shape->horizons[at] / TREE_HORIZON_STEPS;
    const uint32_t triangle = part->triangles[shape->draft.order[at]];
    struct outlook from;
    double cosine = 1.0;
    if (horizon > 1.0 || !look_out(&from, &search, at))
        return TREE_HORIZON_UNKNOWN;
    for (uint32_t k = 0; k < 3; k++) {
        const float *normal = tree_corner(part, triangle, k)->normal.raw;
        cosine = fmin(cosine, (double)(dot(normal, from.plane) / sqrtf(dot(normal, normal))));
    }
    const double angle = asin(horizon) + acos(fmax(cosine, 0.0));
    if (!(cosine > 0.0 && angle < 1.5))
        return TREE_HORIZON_UNKNOWN;
    return (uint8_t)ceil(TREE_HORIZON_STEPS * sin(angle));
}

struct grid {
    uint8_t cells[TREE_GRID][TREE_GRID][TREE_GRID]; /* horizons */
    bool is_met[TREE_GRID][TREE_GRID][TREE_GRID];   /* triangles are in a cell */
};

static void put_horizon(struct grid *grid, const int first[static 3], const int last[static 3],
                        uint8_t horizon)
{
    for (int z = first[2]; z <= last[2]; z++) {
        for (int y = first[1]; y <= last[1]; y++) {
            for (int x = first[0]; x <= last[0]; x++) {
                uint8_t *cell = &grid->cells[z][y][x];
                *cell = grid->is_met[z][y][x] && *cell > horizon ? *cell : horizon;
                grid->is_met[z][y][x] = true;
            }
        }
    }
}

void tree_grid_lay(struct tree *tree, const struct tree_shape *objects,
                   const struct tree_part *part)
{
    static const float aside = 0.1f; /* cells, by which points may be beside their triangles */
    const struct tree_box *all = &objects->draft.nodes[objects->root].box;
    struct grid grid = { 0 };
    memset(grid.cells, TREE_HORIZON_UNKNOWN, sizeof(grid.cells));
    for (int k = 0; k < 3; k++) {
        tree->grid_low.raw[k] = all->low[k];
        tree->grid_scale.raw[k] = (float)TREE_GRID / fmaxf(all->high[k] - all->low[k], 1e-9f);
    }
    for (uint32_t i = 0; i < part->count; i++) {
        const struct tree_box own = tree_box_of(part, part->triangles[objects->draft.order[i]]);
        int first[3], last[3];
        for (int k = 0; k < 3; k++) {
            const float low = tree->grid_low.raw[k], scale = tree->grid_scale.raw[k];
            first[k] = (int)fmaxf((own.low[k] - low) * scale - aside, 0.0f);
            last[k] = (int)fminf((own.high[k] - low) * scale + aside, TREE_GRID - 1);
        }
        put_horizon(&grid, first, last, widest_of(objects, part, i));
    }
    tree->grid = tree->corners.count;
    tree->corners.count += TREE_GRID_WORDS;
    for (uint32_t i = 0; i < sizeof(grid.cells); i++)
        tree->corners.all[tree->grid + i / 32][i / 8 % 4] |= (uint32_t)(&grid.cells[0][0][0])[i]
                                                             << i % 8 * 4;
}
