/* bubble_intersect.c: ray intersection and surface points of bubbles, in double precision because
 * bubbles are tiny compared to ray lengths. */
#include "src/scene/bubble_intersect.h"
#include <math.h>

static double axis_dot(const struct bubble *bubble, const double v[static 3])
{
    double sum = 0.0;
    for (int k = 0; k < 3; k++)
        sum += (double)bubble->axis.raw[k] * v[k];
    return sum;
}

static void add_axis(const struct bubble *bubble, double factor, double v[static 3])
{
    for (int k = 0; k < 3; k++)
        v[k] += factor * (double)bubble->axis.raw[k];
}

static double length_of(const double v[static 3])
{
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/* Scales a vector along the axis, so that the ellipsoid becomes a sphere. */
static void to_sphere(const struct bubble *bubble, double v[static 3])
{
    const double radius = (double)bubble->radius;
    const double along = axis_dot(bubble, v);
    add_axis(bubble, (radius / (radius + (double)bubble->stretch) - 1.0) * along, v);
}

/* Moves `v`, a point relative to the bubble's centre, into the space where the bubble is a sphere.
 * For an ellipsoid, scales `v` along the axis and returns 0. For a capsule, subtracts the nearest
 * point of the axis segment, and returns that point's coordinate along the axis. */
static double reduce(const struct bubble *bubble, double v[static 3])
{
    const double half = (double)bubble->stretch;
    if (!bubble->is_capsule) {
        to_sphere(bubble, v);
        return 0.0;
    }
    const double along = fmin(fmax(axis_dot(bubble, v), -half), half);
    add_axis(bubble, -along, v);
    return along;
}

struct box bubble_box(const struct bubble *bubble)
{
    const float radius = bubble->radius;
    const float half_length = radius + bubble->stretch;
    struct box box;
    for (int k = 0; k < 3; k++) {
        const float along = bubble->axis.raw[k];
        const float extent =
            bubble->is_capsule
                ? radius + bubble->stretch * fabsf(along)
                : sqrtf(radius * radius +
                        (half_length * half_length - radius * radius) * along * along);
        box.min.raw[k] = bubble->center.raw[k] - extent;
        box.max.raw[k] = bubble->center.raw[k] + extent;
    }
    return box;
}

bool bubble_contains(const struct bubble *bubble, vec3s point)
{
    double v[3];
    for (int k = 0; k < 3; k++)
        v[k] = (double)point.raw[k] - (double)bubble->center.raw[k];
    reduce(bubble, v);
    return length_of(v) < (double)bubble->radius;
}

/* Ray relative to the bubble's centre; distances are in lengths of `dir`. */
struct ray {
    double from[3], dir[3];
};

static struct ray ray_of(const struct bubble *bubble, vec3s origin, vec3s dir)
{
    struct ray ray;
    for (int k = 0; k < 3; k++) {
        ray.from[k] = (double)origin.raw[k] - (double)bubble->center.raw[k];
        ray.dir[k] = (double)dir.raw[k];
    }
    return ray;
}

/* Intersects a sphere at the origin. A zero direction gives an infinite interval or a miss. */
static bool intersect_sphere(const struct ray *ray, double radius, double at[static 2])
{
    double a = 0.0, b = 0.0, c = -radius * radius;
    for (int k = 0; k < 3; k++) {
        a += ray->dir[k] * ray->dir[k];
        b += ray->dir[k] * ray->from[k];
        c += ray->from[k] * ray->from[k];
    }
    const double root2 = b * b - a * c;
    if (root2 < 0.0 || (!(a > 0.0) && c > 0.0))
        return false;
    at[0] = a > 0.0 ? (-b - sqrt(root2)) / a : -HUGE_VAL;
    at[1] = a > 0.0 ? (-b + sqrt(root2)) / a : HUGE_VAL;
    return true;
}

/* Intersects the cylindrical part of a capsule. */
static bool intersect_cylinder(const struct bubble *bubble, const struct ray *ray,
                               double at[static 2])
{
    const double half = (double)bubble->stretch;
    const double along = axis_dot(bubble, ray->from), slope = axis_dot(bubble, ray->dir);
    struct ray across = *ray;
    add_axis(bubble, -along, across.from);
    add_axis(bubble, -slope, across.dir);
    if (!intersect_sphere(&across, (double)bubble->radius, at))
        return false;
    if (!(fabs(slope) > 0.0))
        return fabs(along) < half;
    const double side = slope > 0.0 ? half : -half;
    at[0] = fmax(at[0], (-side - along) / slope);
    at[1] = fmin(at[1], (side - along) / slope);
    return at[0] < at[1];
}

/* Intersects a capsule, as the union of a cylinder and two spheres. */
static bool intersect_capsule(const struct bubble *bubble, const struct ray *ray,
                              double at[static 2])
{
    double interval[3][2];
    bool is_hit[3] = { intersect_cylinder(bubble, ray, interval[0]) };
    for (int end = 0; end < 2; end++) {
        struct ray moved = *ray;
        add_axis(bubble, (double)(end ? bubble->stretch : -bubble->stretch), moved.from);
        is_hit[1 + end] = intersect_sphere(&moved, (double)bubble->radius, interval[1 + end]);
    }
    at[0] = HUGE_VAL;
    at[1] = -HUGE_VAL;
    for (int i = 0; i < 3; i++) {
        at[0] = is_hit[i] ? fmin(at[0], interval[i][0]) : at[0];
        at[1] = is_hit[i] ? fmax(at[1], interval[i][1]) : at[1];
    }
    return at[0] <= at[1];
}

bool bubble_intersect(const struct bubble *bubble, vec3s origin, vec3s dir, double at[static 2])
{
    struct ray ray = ray_of(bubble, origin, dir);
    if (bubble->is_capsule)
        return intersect_capsule(bubble, &ray, at);
    to_sphere(bubble, ray.from);
    to_sphere(bubble, ray.dir);
    return intersect_sphere(&ray, (double)bubble->radius, at);
}

struct bubble_face bubble_face_at(const struct bubble *bubble, vec3s origin, vec3s dir, double at)
{
    const double radius = (double)bubble->radius;
    const struct ray ray = ray_of(bubble, origin, dir);
    double normal[3], point[3];
    for (int k = 0; k < 3; k++)
        normal[k] = ray.from[k] + at * ray.dir[k];
    const double along = reduce(bubble, normal);
    const double length = length_of(normal);
    for (int k = 0; k < 3; k++) {
        normal[k] /= length;
        point[k] = radius * normal[k];
    }
    if (bubble->is_capsule) {
        add_axis(bubble, along, point);
    } else {
        add_axis(bubble, (double)bubble->stretch * axis_dot(bubble, normal), point);
        to_sphere(bubble, normal);
    }
    const double scale = 1.0 / length_of(normal);
    struct bubble_face face;
    for (int k = 0; k < 3; k++) {
        face.position.raw[k] = (float)((double)bubble->center.raw[k] + point[k]);
        face.normal.raw[k] = (float)(scale * normal[k]);
    }
    return face;
}
