/*
 * melt_flow.c: the flow in steps that are implicit in the curvature.
 *
 * A step solves (M + t L) p' = M (p - s n): M is the area of each point, L the cotangents of the
 * surface, n the normal, s the retreat of a flat face and t = s d / 2 (Desbrun, Meyer, Schroeder
 * and Barr 1999, Implicit fairing of irregular meshes using diffusion and curvature flow). Where
 * two faces meet, at an edge or in a thin part, their points have no area from then on: they lie
 * between their neighbours. The system is solved by conjugate gradients.
 */
#include "src/scene/melt_flow.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define LAYER  0.118 /* thickness of the warmed air, in half widths */
#define SPREAD 0.4   /* of points along the surface in each of SPREADS turns of a stage */
#define STEP   0.025 /* retreat of a face in a stage, in half widths */

/* Limits of an angle's cotangent: narrow triangles are taken for wider ones. */
#define COTANGENT_LEAST 0.02
#define COTANGENT_MOST  8.0

enum {
    STAGES_MAX = 400,
    ITERATIONS_MAX = 60,
    HALVINGS = 30,
    SPREADS = 4,
    TRIES = 5, /* of a stage, in which triangles must not turn over */
};

typedef double point[3];

/* A weight of another point in the row of a point. */
struct neighbour {
    uint32_t point;
    double weight;
};

struct work {
    const struct melt_flow *flow;
    uint32_t *starts; /* of the neighbours of each point, count + 1 */
    struct neighbour *neighbours;
    double *sums;  /* of each point's weights */
    double *areas; /* a third of those of its triangles; 0: it only follows its neighbours */
    bool *follows;
    point *normals, *next, *goal, *rest, *way, *image;
};

static void subtract(const point a, const point b, point to)
{
    for (int k = 0; k < 3; k++)
        to[k] = a[k] - b[k];
}

static double dot(const point a, const point b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const point a, const point b, point to)
{
    for (int k = 0; k < 3; k++)
        to[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

static double volume_of(const struct melt_flow *flow, point *points)
{
    double sum = 0;
    for (uint32_t i = 0; i < flow->corner_count; i += 3) {
        point area;
        cross(points[flow->corners[i + 1]], points[flow->corners[i + 2]], area);
        sum += dot(points[flow->corners[i]], area);
    }
    return sum / 6;
}

double melt_flow_half(const struct melt_flow *flow)
{
    return 0.5 * cbrt(fmax(volume_of(flow, flow->points), 0));
}

/* Returns half the cotangent of a triangle's angle at its corner `c`. */
static double half_cotangent(const point a, const point b, const point c)
{
    point to_a, to_b, area;
    subtract(a, c, to_a);
    subtract(b, c, to_b);
    cross(to_a, to_b, area);
    const double cotangent = dot(to_a, to_b) / fmax(sqrt(dot(area, area)), 1e-300);
    return 0.5 * fmin(fmax(cotangent, COTANGENT_LEAST), COTANGENT_MOST);
}

/* Fills the rows of L: two entries for each side of a triangle. */
static void weigh(struct work *work)
{
    const struct melt_flow *flow = work->flow;
    uint32_t *ends = &work->starts[1];
    memset(work->starts, 0, (flow->count + (size_t)1) * sizeof(*work->starts));
    memset(work->sums, 0, flow->count * sizeof(*work->sums));
    for (uint32_t i = 0; i < flow->corner_count; i++)
        ends[flow->corners[i]] += 2;
    for (uint32_t i = 1; i < flow->count; i++)
        ends[i] += ends[i - 1];
    for (uint32_t i = flow->count; i > 0; i--) /* starts, until the entries are there */
        work->starts[i] = work->starts[i - 1];
    for (uint32_t i = 0; i < flow->corner_count; i++) {
        const uint32_t first = i - i % 3;
        const uint32_t a = flow->corners[first + (i + 1) % 3];
        const uint32_t b = flow->corners[first + (i + 2) % 3];
        const double weight =
            half_cotangent(flow->points[a], flow->points[b], flow->points[flow->corners[i]]);
        work->neighbours[ends[a]++] = (struct neighbour){ b, weight };
        work->neighbours[ends[b]++] = (struct neighbour){ a, weight };
        work->sums[a] += weight;
        work->sums[b] += weight;
    }
}

/* Finds each point's area and normal. */
static void survey(struct work *work)
{
    const struct melt_flow *flow = work->flow;
    memset(work->areas, 0, flow->count * sizeof(*work->areas));
    memset(work->normals, 0, flow->count * sizeof(*work->normals));
    for (uint32_t i = 0; i < flow->corner_count; i += 3) {
        const uint32_t *corners = &flow->corners[i];
        point along, other, area;
        subtract(flow->points[corners[1]], flow->points[corners[0]], along);
        subtract(flow->points[corners[2]], flow->points[corners[0]], other);
        cross(along, other, area);
        for (int k = 0; k < 3; k++) {
            work->areas[corners[k]] += sqrt(dot(area, area)) / 6;
            for (int axis = 0; axis < 3; axis++)
                work->normals[corners[k]][axis] += area[axis];
        }
    }
    for (uint32_t i = 0; i < flow->count; i++) {
        const double length = sqrt(dot(work->normals[i], work->normals[i]));
        for (int axis = 0; axis < 3; axis++)
            work->normals[i][axis] /= fmax(length, 1e-300);
        work->areas[i] *= work->follows[i] ? 0 : 1;
    }
}

/* Makes points follow at which a triangle of the next stage is turned over, since two faces have
 * met there. Returns the number of such triangles. */
static uint32_t find_met(struct work *work)
{
    const struct melt_flow *flow = work->flow;
    uint32_t count = 0;
    for (uint32_t i = 0; i < flow->corner_count; i += 3) {
        const uint32_t *corners = &flow->corners[i];
        const bool all_follow =
            work->follows[corners[0]] && work->follows[corners[1]] && work->follows[corners[2]];
        point along, other, area, normal = { 0 };
        subtract(work->next[corners[1]], work->next[corners[0]], along);
        subtract(work->next[corners[2]], work->next[corners[0]], other);
        cross(along, other, area);
        for (int k = 0; k < 9; k++)
            normal[k % 3] += work->normals[corners[k / 3]][k % 3];
        if (all_follow || dot(area, normal) > 0)
            continue;
        count++;
        for (int k = 0; k < 3; k++) {
            work->follows[corners[k]] = true;
            work->areas[corners[k]] = 0;
        }
    }
    return count;
}

/* Multiplies with M + t L; returns the product of result and argument. */
static double multiply(const struct work *work, double t, point *x, point *to)
{
    double product = 0;
    for (uint32_t i = 0; i < work->flow->count; i++) {
        const double own = work->areas[i] + t * work->sums[i];
        point sum = { 0 };
        for (uint32_t n = work->starts[i]; n < work->starts[i + 1]; n++) {
            const double *other = x[work->neighbours[n].point];
            for (int k = 0; k < 3; k++)
                sum[k] += work->neighbours[n].weight * other[k];
        }
        for (int k = 0; k < 3; k++)
            to[i][k] = own * x[i][k] - t * sum[k];
        product += dot(to[i], x[i]);
    }
    return product;
}

/* Divides the rest by the diagonal, adds `share` of the way before, and returns the product of what
 * is divided and the rest; `is_way` puts it into the way. */
static double divide(struct work *work, double t, double share, bool is_way)
{
    double product = 0;
    for (uint32_t i = 0; i < work->flow->count; i++) {
        const double own = fmax(work->areas[i] + t * work->sums[i], 1e-300);
        for (int k = 0; k < 3; k++) {
            const double divided = work->rest[i][k] / own;
            product += divided * work->rest[i][k];
            if (is_way)
                work->way[i][k] = divided + share * work->way[i][k];
        }
    }
    return product;
}

/* Solves (M + t L) next = goal, from next = the points. */
static void solve(struct work *work, double t)
{
    const uint32_t count = work->flow->count;
    double start = 0;
    memcpy(work->next, work->flow->points, count * sizeof(point));
    multiply(work, t, work->next, work->image);
    for (uint32_t i = 0; i < count; i++)
        subtract(work->goal[i], work->image[i], work->rest[i]);
    double product = divide(work, t, 0, true);
    for (int turn = 0; turn < ITERATIONS_MAX && product > 1e-10 * start; turn++) {
        start = fmax(start, product);
        const double energy = multiply(work, t, work->way, work->image);
        const double step = energy > 0 ? product / energy : 0;
        for (uint32_t i = 0; i < count; i++) {
            for (int k = 0; k < 3; k++) {
                work->next[i][k] += step * work->way[i][k];
                work->rest[i][k] -= step * work->image[i][k];
            }
        }
        const double before = product;
        product = divide(work, t, 0, false);
        divide(work, t, product / fmax(before, 1e-300), true);
    }
}

/* Moves points along the surface of the next stage towards the middle of their neighbours, so that
 * those of an edge are not crowded where two faces draw nearer to each other. */
static void spread(struct work *work)
{
    for (uint32_t i = 0; i < work->flow->count; i++) {
        const uint32_t first = work->starts[i], end = work->starts[i + 1];
        point way = { 0 };
        for (uint32_t n = first; n < end; n++) {
            for (int k = 0; k < 3; k++)
                way[k] += (work->next[work->neighbours[n].point][k] - work->next[i][k]) /
                          (double)(end - first);
        }
        const double across = dot(way, work->normals[i]);
        for (int k = 0; k < 3; k++)
            work->image[i][k] = way[k] - across * work->normals[i][k];
    }
    for (uint32_t i = 0; i < work->flow->count; i++) {
        for (int k = 0; k < 3; k++)
            work->next[i][k] += SPREAD * work->image[i][k];
    }
}

/* Puts all points of the next stage where the middle of this one is. */
static void vanish(struct work *work)
{
    const struct melt_flow *flow = work->flow;
    double sum = 0;
    point middle = { 0 };
    for (uint32_t i = 0; i < flow->count; i++) {
        sum += work->areas[i];
        for (int k = 0; k < 3; k++)
            middle[k] += work->areas[i] * flow->points[i][k];
    }
    for (uint32_t i = 0; i < flow->count; i++) {
        for (int k = 0; k < 3; k++)
            work->next[i][k] = middle[k] / fmax(sum, 1e-300);
    }
}

/* Finds the next stage; returns its volume. */
static double step(struct work *work, double half, double volume)
{
    const struct melt_flow *flow = work->flow;
    weigh(work);
    survey(work);
    for (int turn = 0; turn < TRIES; turn++) {
        for (uint32_t i = 0; i < flow->count; i++) {
            for (int k = 0; k < 3; k++)
                work->goal[i][k] =
                    work->areas[i] * (flow->points[i][k] - STEP * half * work->normals[i][k]);
        }
        solve(work, STEP * half * LAYER * half / 2);
        for (int i = 0; i < SPREADS; i++)
            spread(work);
        const uint32_t met = find_met(work);
        if (met > flow->corner_count / 6) { /* most of them: it is gone */
            vanish(work);
            return 0;
        }
        if (!met)
            break;
    }
    const double after = volume_of(flow, work->next);
    if (after > 0 && after < volume)
        return after;
    vanish(work);
    return 0;
}

/* Moves the points a share of the way to the next stage. */
static void go(struct work *work, double share, point *to)
{
    for (uint32_t i = 0; i < work->flow->count; i++) {
        for (int k = 0; k < 3; k++)
            to[i][k] =
                work->flow->points[i][k] + share * (work->next[i][k] - work->flow->points[i][k]);
    }
}

/* Returns the share of the way to the next stage after which the volume is `wanted`. */
static double share_at(struct work *work, double wanted)
{
    double low = 0, high = 1;
    for (int i = 0; i < HALVINGS; i++) {
        const double middle = 0.5 * (low + high);
        go(work, middle, work->image);
        if (volume_of(work->flow, work->image) > wanted)
            low = middle;
        else
            high = middle;
    }
    return 0.5 * (low + high);
}

/* Goes from stage to stage; returns the volume that is left. */
static double run(struct work *work, double share, double further)
{
    const double first = volume_of(work->flow, work->flow->points);
    const double half = melt_flow_half(work->flow);
    double volume = first, left = -1; /* stages after the share is lost; below 0: it is not */
    for (int stage = 0; stage < STAGES_MAX && volume > 0 && !(left >= 0 && left <= 0); stage++) {
        const double after = step(work, half, volume);
        double part = 1;
        if (left < 0 && after <= (1 - share) * first) {
            const double at = share_at(work, (1 - share) * first);
            left = further / STEP;
            part = fmin(at + left, 1);
            left -= part - at;
        } else if (left > 0) {
            part = fmin(left, 1);
            left -= part;
        }
        go(work, part, work->flow->points);
        volume = part < 1 ? volume_of(work->flow, work->flow->points) : after;
    }
    return volume;
}

static void *make(size_t count, size_t size)
{
    return calloc(count ? count : 1, size);
}

bool melt_flow_run(struct melt_flow *flow, double share, double further, double *lost)
{
    const double first = volume_of(flow, flow->points);
    const size_t count = flow->count;
    struct work work = { .flow = flow };
    *lost = 0;
    if (!(first > 0) || !(share > 0 || further > 0))
        return true;
    point *points = make(6 * count, sizeof(point));
    work.starts = make(count + 2, sizeof(*work.starts));
    work.neighbours = make((size_t)flow->corner_count * 2, sizeof(*work.neighbours));
    work.sums = make(2 * count, sizeof(*work.sums));
    work.follows = make(count, sizeof(*work.follows));
    const bool done = points && work.starts && work.neighbours && work.sums && work.follows;
    if (done) {
        work.areas = &work.sums[count];
        work.normals = points;
        work.next = &points[count];
        work.goal = &points[2 * count];
        work.rest = &points[3 * count];
        work.way = &points[4 * count];
        work.image = &points[5 * count];
        *lost = 1 - run(&work, fmin(share, 1), further) / first;
    }
    free(points);
    free(work.starts);
    free(work.neighbours);
    free(work.sums);
    free(work.follows);
    return done;
}
