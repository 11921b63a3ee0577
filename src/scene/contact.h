/*
 * contact.h: convex bodies around a scene's objects, which hide the sky from what they stand on.
 *
 * A body is a polytope whose normals are the directions from a cube's middle to its faces and
 * edges (hull.h without corners); an object that is nearly inside it is a member of it. Films and
 * puddles, which are flat, have none.
 */
#ifndef FIRN_SCENE_CONTACT_H
#define FIRN_SCENE_CONTACT_H

#include "shaders/contact.h"
#include "src/base/status.h"
#include "src/scene/object.h"

enum {
    CONTACT_PLANES = 18,
    CONTACT_MEMBERS = 8, /* of a body; others change little */
};

struct contact_member {
    uint32_t object;
    float share; /* of the body's volume that is the object and nothing in it */
};

/* Its points p have dot(p, planes[i].xyz) <= planes[i].w, in the space of the objects. */
struct contact_shape {
    vec4s planes[CONTACT_PLANES]; /* unit normals */
    struct box box;
    float slim; /* by which a box as high is slimmer that has as much surface; at most 1 */
    struct contact_member members[CONTACT_MEMBERS];
    uint32_t member_count;
};

struct contact {
    struct contact_shape shapes[CONTACT_BODIES]; /* the largest first */
    uint32_t count;
};

/* Finds the bodies of objects; without a list, all of the mesh is one. Logs and returns
 * STATUS_TRY_AGAIN when out of memory. */
MUST_USE enum status contact_find(struct contact *contact, const struct mesh *mesh,
                                  const struct object *objects, uint32_t count);

#endif
