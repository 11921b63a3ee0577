/*
 * melt_curvature_flow.c: time steps of the surface retreat, implicit in mean curvature.
 *
 * A step solves (M + t L) p' = M (p - s n): M is the diagonal matrix of point areas, L the
 * cotangent Laplacian, n the normal, s the retreat of a flat face, and t = s d / 2 (Desbrun, Meyer,
 * Schroeder and Barr 1999, Implicit fairing of irregular meshes using diffusion and curvature
 * flow). Implicit integration stays stable with large steps, where an explicit one would need steps
 * as small as the smallest triangle. The solver is Jacobi-preconditioned CG.
 *
 * Where two faces collide, at an edge or in a thin part, their points get zero area, so that the
 * smoothness term alone places them between their neighbours.
 */
#include "src/scene/melt/melt_curvature_flow.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define AIR_LAYER 0.118 /* thickness of the warm air layer, in half widths */
#define SPREAD    0.4   /* factor of tangential smoothing, applied SPREADS times per step */
#define STEP      0.025 /* retreat of a face per step, in half widths */

#define COTANGENT_MIN 0.02 /* minimum cotangent, which limits the effect of sliver triangles */
#define COTANGENT_MAX 8.0

enum {
    STAGES_MAX = 400,
    ITERATIONS_MAX = 60,
    HALVINGS = 30,
    SPREADS = 4,
    TRIES = 5, /* maximum number of attempts at a step, which is repeated if triangles invert */
};

typedef double point[3];

/* Off-diagonal entry of a sparse matrix row. */
struct neighbour {
    uint32_t point;
    double weight;
};

struct work {
    const struct melt_curvature_flow *flow;
    uint32_t *starts; /* start of each point's row in `neighbours`; count + 1 elements */
    struct neighbour *neighbours;
    double *sums;  /* sum of each row's weights */
    double *areas; /* a third of the adjacent triangles' area; 0 once the point has collided */
    bool *is_collided;
    point *normals, *next, *goal, *residual, *direction, *product_vector;
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

static double volume_of(const struct melt_curvature_flow *flow, point *points)
{
    double sum = 0;
    for (uint32_t i = 0; i < flow->corner_count; i += 3) {
        point area;
        cross(points[flow->corners[i + 1]], points[flow->corners[i + 2]], area);
        sum += dot(points[flow->corners[i]], area);
    }
    return sum / 6;
}

double melt_curvature_flow_half_width(const struct melt_curvature_flow *flow)
{
    return 0.5 * cbrt(fmax(volume_of(flow, flow->points), 0));
}

/* Returns half the cotangent of a triangle's angle at corner `c`. */
static double half_cotangent(const point a, const point b, const point c)
{
    point to_a, to_b, area;
    subtract(a, c, to_a);
    subtract(b, c, to_b);
    cross(to_a, to_b, area);
    const double cotangent = dot(to_a, to_b) / fmax(sqrt(dot(area, area)), 1e-300);
    return 0.5 * fmin(fmax(cotangent, COTANGENT_MIN), COTANGENT_MAX);
}

/* Builds the cotangent Laplacian L, with two entries per triangle edge. */
static void build_laplacian(struct work *work)
{
    const struct melt_curvature_flow *flow = work->flow;
    uint32_t *ends = &work->starts[1];
    memset(work->starts, 0, (flow->count + (size_t)1) * sizeof(*work->starts));
    memset(work->sums, 0, flow->count * sizeof(*work->sums));
    for (uint32_t i = 0; i < flow->corner_count; i++)
        ends[flow->corners[i]] += 2;
    for (uint32_t i = 1; i < flow->count; i++)
        ends[i] += ends[i - 1];
    for (uint32_t i = flow->count; i > 0; i--) /* converts row ends to row starts */
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

/* Computes the area and the normal of each point. */
static void measure_points(struct work *work)
{
    const struct melt_curvature_flow *flow = work->flow;
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
        work->areas[i] *= work->is_collided[i] ? 0 : 1;
    }
}

/* Marks the points of triangles that the step has inverted because two faces collide. Returns the
 * number of newly inverted triangles. */
static uint32_t mark_collisions(struct work *work)
{
    const struct melt_curvature_flow *flow = work->flow;
    uint32_t count = 0;
    for (uint32_t i = 0; i < flow->corner_count; i += 3) {
        const uint32_t *corners = &flow->corners[i];
        const bool all_follow = work->is_collided[corners[0]] && work->is_collided[corners[1]] &&
                                work->is_collided[corners[2]];
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
            work->is_collided[corners[k]] = true;
            work->areas[corners[k]] = 0;
        }
    }
    return count;
}

/* Multiplies x by M + t L. Returns the dot product of x and the result. */
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

/* Applies the Jacobi preconditioner to the residual. Returns the dot product of the preconditioned
 * residual and the residual. If `updates_direction`, sets the search direction to the
 * preconditioned residual plus `beta` times the previous direction. */
static double precondition(struct work *work, double t, double beta, bool updates_direction)
{
    double product = 0;
    for (uint32_t i = 0; i < work->flow->count; i++) {
        const double own = fmax(work->areas[i] + t * work->sums[i], 1e-300);
        for (int k = 0; k < 3; k++) {
            const double divided = work->residual[i][k] / own;
            product += divided * work->residual[i][k];
            if (updates_direction)
                work->direction[i][k] = divided + beta * work->direction[i][k];
        }
    }
    return product;
}

/* Solves (M + t L) next = goal by conjugate gradients, starting at the current points. */
static void solve(struct work *work, double t)
{
    const uint32_t count = work->flow->count;
    double start = 0;
    memcpy(work->next, work->flow->points, count * sizeof(point));
    multiply(work, t, work->next, work->product_vector);
    for (uint32_t i = 0; i < count; i++)
        subtract(work->goal[i], work->product_vector[i], work->residual[i]);
    double product = precondition(work, t, 0, true);
    for (int iteration = 0; iteration < ITERATIONS_MAX && product > 1e-10 * start; iteration++) {
        start = fmax(start, product);
        const double energy = multiply(work, t, work->direction, work->product_vector);
        const double alpha = energy > 0 ? product / energy : 0;
        for (uint32_t i = 0; i < count; i++) {
            for (int k = 0; k < 3; k++) {
                work->next[i][k] += alpha * work->direction[i][k];
                work->residual[i][k] -= alpha * work->product_vector[i][k];
            }
        }
        const double before = product;
        product = precondition(work, t, 0, false);
        precondition(work, t, product / fmax(before, 1e-300), true);
    }
}

/* Smooths the next state tangentially, to keep points from crowding where two faces approach. */
static void smooth_tangentially(struct work *work)
{
    for (uint32_t i = 0; i < work->flow->count; i++) {
        const uint32_t first = work->starts[i], end = work->starts[i + 1];
        point direction = { 0 };
        for (uint32_t n = first; n < end; n++) {
            for (int k = 0; k < 3; k++)
                direction[k] += (work->next[work->neighbours[n].point][k] - work->next[i][k]) /
                                (double)(end - first);
        }
        const double across = dot(direction, work->normals[i]);
        for (int k = 0; k < 3; k++)
            work->product_vector[i][k] = direction[k] - across * work->normals[i][k];
    }
    for (uint32_t i = 0; i < work->flow->count; i++) {
        for (int k = 0; k < 3; k++)
            work->next[i][k] += SPREAD * work->product_vector[i][k];
    }
}

/* Moves all points of the next state to the centroid of the current state. */
static void collapse(struct work *work)
{
    const struct melt_curvature_flow *flow = work->flow;
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

/* Computes the surface after one time step in work->next. Returns the volume inside it. */
static double compute_next(struct work *work, double half, double volume)
{
    const struct melt_curvature_flow *flow = work->flow;
    build_laplacian(work);
    measure_points(work);
    for (int iteration = 0; iteration < TRIES; iteration++) {
        for (uint32_t i = 0; i < flow->count; i++) {
            for (int k = 0; k < 3; k++)
                work->goal[i][k] =
                    work->areas[i] * (flow->points[i][k] - STEP * half * work->normals[i][k]);
        }
        solve(work, STEP * half * AIR_LAYER * half / 2);
        for (int i = 0; i < SPREADS; i++)
            smooth_tangentially(work);
        const uint32_t inverted = mark_collisions(work);
        if (inverted >
            flow->corner_count / 6) { /* most triangles are inverted, so the ice has vanished */
            collapse(work);
            return 0;
        }
        if (!inverted)
            break;
    }
    const double after = volume_of(flow, work->next);
    if (after > 0 && after < volume)
        return after;
    collapse(work);
    return 0;
}

/* Interpolates all points between the current and the next time step. */
static void interpolate(struct work *work, double fraction, point *to)
{
    for (uint32_t i = 0; i < work->flow->count; i++) {
        for (int k = 0; k < 3; k++)
            to[i][k] =
                work->flow->points[i][k] + fraction * (work->next[i][k] - work->flow->points[i][k]);
    }
}

/* Returns the interpolation factor at which the volume is `target`, by bisection. */
static double find_fraction(struct work *work, double target)
{
    double low = 0, high = 1;
    for (int i = 0; i < HALVINGS; i++) {
        const double middle = 0.5 * (low + high);
        interpolate(work, middle, work->product_vector);
        if (volume_of(work->flow, work->product_vector) > target)
            low = middle;
        else
            high = middle;
    }
    return 0.5 * (low + high);
}

/* Melts `fraction` of the volume, then moves faces in by `further`. Returns the final volume. */
static double run(struct work *work, double fraction, double further)
{
    const double first = volume_of(work->flow, work->flow->points);
    const double half = melt_curvature_flow_half_width(work->flow);
    /* number of time steps left for the retreat by `further`; -1 before the retreat starts */
    double volume = first, left = -1;
    for (int stage = 0; stage < STAGES_MAX && volume > 0 && !(left >= 0 && left <= 0); stage++) {
        const double after = compute_next(work, half, volume);
        double part = 1;
        if (left < 0 && after <= (1 - fraction) * first) {
            const double at = find_fraction(work, (1 - fraction) * first);
            left = further / STEP;
            part = fmin(at + left, 1);
            left -= part - at;
        } else if (left > 0) {
            part = fmin(left, 1);
            left -= part;
        }
        interpolate(work, part, work->flow->points);
        volume = part < 1 ? volume_of(work->flow, work->flow->points) : after;
    }
    return volume;
}

static void *make(size_t count, size_t size)
{
    return calloc(count ? count : 1, size);
}

bool melt_curvature_flow_run(struct melt_curvature_flow *flow, double fraction, double further,
                             double *lost)
{
    const double first = volume_of(flow, flow->points);
    const size_t count = flow->count;
    struct work work = { .flow = flow };
    *lost = 0;
    if (!(first > 0) || !(fraction > 0 || further > 0))
        return true;
    point *points = make(6 * count, sizeof(point));
    work.starts = make(count + 2, sizeof(*work.starts));
    work.neighbours = make((size_t)flow->corner_count * 2, sizeof(*work.neighbours));
    work.sums = make(2 * count, sizeof(*work.sums));
    work.is_collided = make(count, sizeof(*work.is_collided));
    const bool done = points && work.starts && work.neighbours && work.sums && work.is_collided;
    if (done) {
        work.areas = &work.sums[count];
        work.normals = points;
        work.next = &points[count];
        work.goal = &points[2 * count];
        work.residual = &points[3 * count];
        work.direction = &points[4 * count];
        work.product_vector = &points[5 * count];
        *lost = 1 - run(&work, fmin(fraction, 1), further) / first;
    }
    free(points);
    free(work.starts);
    free(work.neighbours);
    free(work.sums);
    free(work.is_collided);
    return done;
}
