/*
 * media.h: which of a scene's objects a ray is inside, and so the medium that it goes through.
 *
 * A ray is inside an object or not; where several overlap, the one of the greatest rank is there
 * (Schmidt and Budge 2002, Simple Nested Dielectrics in Ray Traced Images).
 */
#ifndef FIRN_REFERENCE_MEDIA_H
#define FIRN_REFERENCE_MEDIA_H

#include "src/tech/frame_media.h"

#define MEDIA_NOTHING UINT32_MAX /* no object */

enum {
    MEDIA_NESTED_MAX = 15, /* objects that a ray is inside at the same time; more are ignored */
};

/* All media of a scene. */
struct media {
    struct frame_medium *all; /* one for each object, then the outside, then the bubbles */
    uint32_t outside;         /* index of the outside */
    uint32_t bubble;          /* index of the bubbles: air as outside, which outranks all objects */
    bool is_dispersive;       /* the indices of some medium differ by colour */
};

/* The objects that a ray is inside. */
struct media_set {
    uint16_t count;
    uint16_t objects[MEDIA_NESTED_MAX];
};

/* Returns false when out of memory, or for more than 65533 objects. */
bool media_init(struct media *media, const struct scene *scene, const struct settings *settings);
void media_finish(struct media *media);

/* Returns the object whose medium a ray inside `set` is in, without object `except`; or the
 * outside. */
uint32_t media_top(const struct media *media, const struct media_set *set, uint32_t except);

/* Returns whether two media refract alike: a bubble is filled with what is outside. */
bool media_are_alike(const struct media *media, uint32_t a, uint32_t b);

bool media_set_has(const struct media_set *set, uint32_t object);

/* Adds or removes an object. */
void media_set_put(struct media_set *set, uint32_t object, bool is_inside);

/* Both sides of an object's surface, for a ray that crosses it. */
struct media_crossing {
    uint32_t before, after; /* indices of media */
    bool is_entering;
};

/* `is_entering`: the ray meets the surface's front. Whether the ray was inside the object before
 * does not matter: so open and overlapping meshes are crossed as path tracers do. */
struct media_crossing media_cross(const struct media *media, const struct media_set *set,
                                  uint32_t object, bool is_entering);

#endif
