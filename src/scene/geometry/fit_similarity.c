/* fit_similarity.c: similarity transforms between triangle sets from three corner pairs. */
#include "src/scene/geometry/fit_similarity.h"
#include <math.h>
#include <string.h>

/* Orthonormal frame of three points; the first axis points along the first side. */
struct frame {
    double origin[3], axes[3][3], length;
    bool is_collinear;
};

static const float *position_of(const struct similarity_transform_corners *corners, uint32_t corner)
{
    return corners->position(corners->context, corner);
}

static void cross(const double *a, const double *b, double *to)
{
    for (int k = 0; k < 3; k++)
        to[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void difference(const float *a, const float *b, double *to)
{
    for (int k = 0; k < 3; k++)
        to[k] = (double)b[k] - (double)a[k];
}

/* Normalises v. Returns its former length. */
static double normalise(double *v)
{
    const double length = sqrt(dot(v, v));
    for (int k = 0; k < 3 && length > 0.0; k++)
        v[k] /= length;
    return length;
}

/* Picks corner 0, the corner farthest from it, and the one farthest from the line between them. */
struct similarity_transform_anchor
similarity_transform_anchor_find(const struct similarity_transform_corners *corners)
{
    struct similarity_transform_anchor anchor = { { 0 }, 0.0 };
    const float *origin = position_of(corners, 0);
    double along[3] = { 0 }, farthest = 0.0;
    for (uint32_t i = 0; i < corners->count; i++) {
        double v[3];
        difference(origin, position_of(corners, i), v);
        if (dot(v, v) > anchor.length) {
            anchor.length = dot(v, v);
            anchor.corners[1] = i;
            memcpy(along, v, sizeof(along));
        }
    }
    for (uint32_t i = 0; i < corners->count; i++) {
        double v[3], cross_product[3];
        difference(origin, position_of(corners, i), v);
        cross(along, v, cross_product);
        if (dot(cross_product, cross_product) > farthest) {
            farthest = dot(cross_product, cross_product);
            anchor.corners[2] = i;
        }
    }
    return anchor;
}

static struct frame frame_of(const struct similarity_transform_corners *corners,
                             const struct similarity_transform_anchor *anchor)
{
    struct frame frame;
    double cross_product[3];
    const float *origin = position_of(corners, anchor->corners[0]);
    for (int k = 0; k < 3; k++)
        frame.origin[k] = (double)origin[k];
    difference(origin, position_of(corners, anchor->corners[1]), frame.axes[0]);
    difference(origin, position_of(corners, anchor->corners[2]), cross_product);
    frame.length = normalise(frame.axes[0]);
    cross(frame.axes[0], cross_product, frame.axes[2]);
    frame.is_collinear = !(normalise(frame.axes[2]) > 1e-6 * frame.length);
    cross(frame.axes[2], frame.axes[0], frame.axes[1]);
    return frame;
}

bool similarity_transform_find(struct similarity_transform *motion,
                               const struct similarity_transform_anchor *anchor,
                               const struct similarity_transform_corners *before,
                               const struct similarity_transform_corners *after)
{
    const struct frame a = frame_of(before, anchor), b = frame_of(after, anchor);
    if (a.is_collinear || b.is_collinear)
        return false;
    motion->length = b.length;
    for (int k = 0; k < 3; k++) {
        motion->rows[k][3] = b.origin[k];
        for (int i = 0; i < 3; i++) {
            motion->rows[k][i] = 0.0;
            for (int axis = 0; axis < 3; axis++)
                motion->rows[k][i] += b.length / a.length * b.axes[axis][k] * a.axes[axis][i];
            motion->rows[k][3] -= motion->rows[k][i] * a.origin[i];
        }
    }
    return true;
}

double similarity_transform_error(const struct similarity_transform *motion,
                                  const float before[static 3], const float after[static 3])
{
    double error = 0.0;
    for (int k = 0; k < 3; k++) {
        double moved = motion->rows[k][3];
        for (int i = 0; i < 3; i++)
            moved += motion->rows[k][i] * (double)before[i];
        error = fmax(error, fabs(moved - (double)after[k]));
    }
    return error;
}
