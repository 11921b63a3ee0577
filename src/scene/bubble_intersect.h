/* bubble_intersect.h: air bubbles are spheres, ellipsoids of revolution, or capsules. A capsule is
 * all points within a radius of its axis segment. All bubbles are convex. */
#ifndef FIRN_SCENE_BUBBLE_INTERSECT_H
#define FIRN_SCENE_BUBBLE_INTERSECT_H

#include "src/scene/geometry/mesh.h"

struct bubble {
    vec3s center;
    float radius; /* radius across the axis, metres */
    /* half-length along the axis, minus the radius, metres; negative for oblate bubbles */
    float stretch;
    vec3s axis;      /* unit axis; may be zero for a sphere */
    bool is_capsule; /* true for a capsule (stretch >= 0) */
};

static inline bool bubble_is_sphere(const struct bubble *bubble)
{
    return !(bubble->stretch < 0.0f || bubble->stretch > 0.0f);
}

struct box bubble_box(const struct bubble *bubble);

bool bubble_contains(const struct bubble *bubble, vec3s point);

/* Intersects a line with a bubble, and returns false for a miss. The line extends a ray in both
 * directions. The two distances are in lengths of `dir`, and negative behind `origin`. */
bool bubble_intersect(const struct bubble *bubble, vec3s origin, vec3s dir, double at[static 2]);

struct bubble_face {
    vec3s position, normal; /* `normal` is unit, outward */
};

/* Projects the hit at distance `at` onto the bubble's surface, to remove rounding errors. */
struct bubble_face bubble_face_at(const struct bubble *bubble, vec3s origin, vec3s dir, double at);

#endif
