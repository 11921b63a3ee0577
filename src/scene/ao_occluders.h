/*
 * ao_occluders.h: convex occluders around a scene's objects, for analytic ambient occlusion.
 *
 * Clear objects need contact shadows, but ray casts or screen-space samples per pixel are noisy or
 * miss hidden geometry. A few convex bodies per scene can be integrated in closed form. An occluder
 * is an 18-DOP (the face and edge directions of a cube); objects that are nearly inside it become
 * its members. Flat objects, such as puddles, have no occluder.
 */
#ifndef FIRN_SCENE_AO_OCCLUDERS_H
#define FIRN_SCENE_AO_OCCLUDERS_H

#include "shaders/lighting/ao.h"
#include "src/base/status.h"
#include "src/scene/refractive_object.h"

enum {
    AO_PLANES = 18,
    AO_MEMBERS = 8, /* maximum members; more change little */
};

struct ao_member {
    uint32_t object;
    float
        /* fraction of the occluder's volume inside `object`, but not inside an enclosed object */
        volume_fraction;
};

/* Convex body: the intersection of half-spaces in object space. A point p is inside if dot(p,
 * planes[i].xyz) <= planes[i].w for all i. */
struct ao_shape {
    vec4s planes[AO_PLANES]; /* unit normals */
    struct box box;
    /* factor on the width and depth of `box` that gives a box with the body's volume; at most 1 */
    float relative_width;
    struct ao_member members[AO_MEMBERS];
    uint32_t member_count;
};

struct ao {
    struct ao_shape shapes[AO_OCCLUDERS_MAX]; /* occluders by decreasing size */
    uint32_t count;
};

/* Fits occluders to all objects, or one occluder to the whole mesh if there are no objects. If out
 * of memory, logs an error and returns STATUS_TRY_AGAIN. */
MUST_USE enum status ao_find(struct ao *ao, const struct mesh *mesh, const struct object *objects,
                             uint32_t count);

#endif
