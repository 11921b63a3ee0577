/*
 * bubble.h: one bubble: a sphere, an ellipsoid that is round about its axis, or a capsule, which is
 * all that is within its radius of a part of its axis. All are convex.
 *
 * Errors: none.
 */
#ifndef FIRN_SCENE_BUBBLE_H
#define FIRN_SCENE_BUBBLE_H

#include "src/scene/mesh.h"

struct bubble {
    vec3s center;
    float radius;    /* metres, across the axis */
    float stretch;   /* metres: along the axis it reaches radius + stretch; 0: a sphere; below 0: a
                        flat ellipsoid */
    vec3s axis;      /* unit; of a sphere it may be {0} */
    bool is_capsule; /* else an ellipsoid; `stretch` is not below 0 */
};

static inline bool bubble_is_sphere(const struct bubble *bubble)
{
    return !(bubble->stretch < 0.0f || bubble->stretch > 0.0f);
}

struct box bubble_box(const struct bubble *bubble);

/* Returns whether a point is inside. */
bool bubble_holds(const struct bubble *bubble, vec3s point);

/* Finds where the line of a ray enters and leaves a bubble, in lengths of `dir`; this may be behind
 * its origin. Returns false if it misses. */
bool bubble_cross(const struct bubble *bubble, vec3s origin, vec3s dir, double at[static 2]);

struct bubble_face {
    vec3s position, normal; /* unit, outward */
};

/* Returns the point that is exactly on the surface, beside that of a ray which is on it but for
 * rounding. */
struct bubble_face bubble_face_at(const struct bubble *bubble, vec3s origin, vec3s dir, double at);

#endif
