/* vec.h: double-precision vectors, to compute expected images in closed form. */
#ifndef TESTS_VEC_H
#define TESTS_VEC_H

#include <cglm/types-struct.h>
#include <math.h>

struct vec {
    double x, y, z;
};

static inline struct vec vec_from(vec3s v)
{
    return (struct vec){ (double)v.x, (double)v.y, (double)v.z };
}

static inline struct vec vec_scale(struct vec a, double s)
{
    return (struct vec){ a.x * s, a.y * s, a.z * s };
}

/* a + s b */
static inline struct vec vec_add(struct vec a, double s, struct vec b)
{
    return (struct vec){ a.x + s * b.x, a.y + s * b.y, a.z + s * b.z };
}

static inline double vec_dot(struct vec a, struct vec b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline struct vec vec_cross(struct vec a, struct vec b)
{
    return (struct vec){ a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}

static inline double vec_norm(struct vec a)
{
    return sqrt(vec_dot(a, a));
}

static inline struct vec vec_unit(struct vec a)
{
    return vec_scale(a, 1 / vec_norm(a));
}

/* Returns the angle between two directions in degrees; accurate for small angles, too. */
static inline double vec_angle_deg(struct vec a, struct vec b)
{
    return atan2(vec_norm(vec_cross(a, b)), vec_dot(a, b)) * 57.295779513082321;
}

/* Returns the largest absolute difference of the components; NaN if any is NaN. */
static inline double vec_difference(struct vec a, struct vec b)
{
    const struct vec d = vec_add(a, -1, b);
    const double sum = d.x + d.y + d.z;
    return isnan(sum) ? sum : fmax(fabs(d.x), fmax(fabs(d.y), fabs(d.z)));
}

#endif
