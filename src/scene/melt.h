/*
 * melt.h: a scene's ice, melted: its shells retreat (melt_flow.h), and what is in, below and around
 * it follows.
 *
 * Ice is what has the index of ice, and the object of a scene without materials. It keeps its
 * triangles. What stood on something sinks onto it, and what floated keeps its share above water.
 * Shells of air in the ice stay where they are in it; as its surface reaches them they open, shrink
 * and are gone; cracks grow wider there. Shells of water below it, where it stands, and films on
 * what is around it spread as far as what has melted fills them. Hollows appear on its surface.
 *
 * Errors: the water that the ice floats in keeps its level. Spread water does not see what is in
 * its way. Air that has come out of the ice leaves no drops.
 */
#ifndef FIRN_SCENE_MELT_H
#define FIRN_SCENE_MELT_H

#include "src/scene/generate/generate.h"
#include "src/scene/import/model.h"

struct melting {
    float share; /* of the volume that is lost at time 0, 0 to 1 */
    float speed; /* at which the faces retreat from then on, halves of the width a second */
    bool is_all; /* every object is ice */
    bool is_none;
};

struct melted {
    float share;       /* of the first ice's volume that is lost; 0: nothing has melted */
    struct mesh grown; /* the objects before, where the ice has sunk to; {0} */
    struct box box;    /* of it */
};

/* Melts the ice of a model for a time, seconds. Logs a warning at time 0 if there is none. Logs and
 * returns STATUS_TRY_AGAIN when out of memory; *melted is {0} if nothing melts. */
MUST_USE enum status melt_model(struct model *model, const struct melting *melting, float time,
                                struct melted *melted);

/* Shrinks bubbles that were in the grown object, and leaves out those that are outside of the
 * melted one. Returns false when out of memory. */
bool melt_bubbles(struct bubbles *bubbles, const struct mesh *object);

/* Opens cracks where the surface of an object, of which a share has melted, is near. Returns false
 * when out of memory. */
bool melt_cracks(struct mesh *cracks, const struct mesh *object, float share);

void melted_finish(struct melted *melted); /* {0} is fine */

/* Returns what is left of frost, and of what else makes ice matt: 1 to 0. */
float melted_frost(const struct melted *melted);

/* Returns by how much the hollows of the surface are deeper. */
float melted_hollows(const struct melted *melted);

#endif
