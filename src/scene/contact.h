/*
 * contact.h: convex occluders around a scene's objects, for analytic ambient occlusion.
 *
 * Problem: clear objects need contact shadows, but ray casts or screen-space samples per pixel are
 * noisy or miss hidden geometry. A few convex bodies per scene can be integrated in closed form. An
 * occluder is an 18-DOP (the face and edge directions of a cube); objects that are nearly inside it
 * become its members. Flat objects, such as puddles, have no occluder.
 */
#ifndef FIRN_SCENE_CONTACT_H
#define FIRN_SCENE_CONTACT_H

#include "shaders/contact.h"
#include "src/base/status.h"
#include "src/scene/object.h"

enum {
    CONTACT_PLANES = 18,
    CONTACT_MEMBERS = 8, /* maximum number of members; more would change little */
};

struct contact_member {
    uint32_t object;
    float share; /* fraction of the occluder's volume, without objects inside this one */
};

/* A point p is inside if dot(p, planes[i].xyz) <= planes[i].w for all i, in object space. */
struct contact_shape {
    vec4s planes[CONTACT_PLANES]; /* unit normals */
    struct box box;
    float slim; /* relative width of an equally high box of equal surface area, at most 1 */
    struct contact_member members[CONTACT_MEMBERS];
    uint32_t member_count;
};

struct contact {
    struct contact_shape shapes[CONTACT_BODIES]; /* in order of decreasing size */
    uint32_t count;
};

/* Finds the occluders of all objects; without objects, the whole mesh is one. Logs and returns
 * STATUS_TRY_AGAIN when out of memory. */
MUST_USE enum status contact_find(struct contact *contact, const struct mesh *mesh,
                                  const struct object *objects, uint32_t count);

#endif
