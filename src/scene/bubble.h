/*
 * bubble.h: a bubble: a sphere, an ellipsoid of revolution, or a capsule (all points within its
 * radius of a segment of its axis). All are convex.
 */
#ifndef FIRN_SCENE_BUBBLE_H
#define FIRN_SCENE_BUBBLE_H

#include "src/scene/geometry/mesh.h"

struct bubble {
    vec3s center;
    float radius;    /* radius across the axis, metres */
    float stretch;   /* half-length along the axis minus radius, metres; negative if oblate */
    vec3s axis;      /* unit; may be {0} for a sphere */
    bool is_capsule; /* a capsule, whose `stretch` is not negative; if false, an ellipsoid */
};

static inline bool bubble_is_sphere(const struct bubble *bubble)
{
    return !(bubble->stretch < 0.0f || bubble->stretch > 0.0f);
}

struct box bubble_box(const struct bubble *bubble);

/* Returns true if a point is inside. */
bool bubble_contains(const struct bubble *bubble, vec3s point);

/* Finds the two intersections of a ray's line with a bubble, in lengths of `dir`; they may be
 * negative. Returns false if it misses. */
bool bubble_intersect(const struct bubble *bubble, vec3s origin, vec3s dir, double at[static 2]);

struct bubble_face {
    vec3s position, normal; /* `normal` is unit, outward */
};

/* Returns the exact surface point nearest to a ray's hit, which is off the surface by rounding. */
struct bubble_face bubble_face_at(const struct bubble *bubble, vec3s origin, vec3s dir, double at);

#endif
