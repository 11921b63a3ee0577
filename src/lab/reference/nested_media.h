/*
 * nested_media.h: nested dielectrics with priorities. Tracks which objects and which medium
 * surround a ray. In an overlap, the medium of highest priority (`rank`) applies. Surfaces inside
 * this medium are skipped (Schmidt, Budge 2002, Simple Nested Dielectrics in Ray Traced Images).
 * Coincident surfaces of several objects are one interface.
 */
#ifndef FIRN_LAB_REFERENCE_NESTED_MEDIA_H
#define FIRN_LAB_REFERENCE_NESTED_MEDIA_H

#include "src/tech/frame_media.h"

#define NESTED_MEDIA_NONE UINT32_MAX /* index of no object */

enum {
    NESTED_MEDIA_MAX = 15, /* capacity of a set of objects */
};

struct nested_media {
    struct frame_medium *all; /* one per object, outside, bubbles */
    uint32_t outside;         /* index of the outermost medium */
    uint32_t bubble;          /* index of the air in bubbles */
    bool is_dispersive;       /* some refractive index varies with colour */
};

/* The set of objects that contain a ray's origin. */
struct nested_media_set {
    uint16_t count;
    uint16_t objects[NESTED_MEDIA_MAX];
};

/* Collects a scene's media. Returns false when out of memory or for more than 65533 objects. */
bool nested_media_init(struct nested_media *media, const struct scene *scene,
                       const struct settings *settings);
void nested_media_finish(struct nested_media *media);

/* Returns the set's object of highest priority other than `except`, or else the outside medium. */
uint32_t nested_media_top(const struct nested_media *media, const struct nested_media_set *set,
                          uint32_t except);

/* Returns true if there is no interface between two media: if they are the same medium, objects of
 * equal parameters, or both air of equal refractive index. */
bool nested_media_are_equal(const struct nested_media *media, uint32_t a, uint32_t b);

/* Objects that a ray enters and leaves at one hit, which may be on several coincident surfaces. */
struct nested_media_changes {
    struct nested_media_set entered, left;
};

/* Removes the objects that a ray both enters and leaves at one hit. */
void nested_media_changes_cancel(struct nested_media_changes *changes);

/* Applies the changes to a set: the objects around a point behind the hit, or in front of it. */
void nested_media_set_apply(struct nested_media_set *set,
                            const struct nested_media_changes *changes, bool is_behind);

bool nested_media_set_has(const struct nested_media_set *set, uint32_t object);

/* Adds an object to the set, or removes it if `is_inside` is false. */
void nested_media_set_update(struct nested_media_set *set, uint32_t object, bool is_inside);

/* Media in front of and behind an object's surface, along a ray that crosses it. */
struct nested_media_crossing {
    uint32_t before, after; /* media on both sides */
    bool is_entering;
};

/* Returns the media in front of and behind an object's surface. `is_entering` is true at front
 * faces. The result does not depend on whether `set` contains the object, so meshes may be open or
 * overlap. */
struct nested_media_crossing nested_media_cross(const struct nested_media *media,
                                                const struct nested_media_set *set, uint32_t object,
                                                bool is_entering);

#endif
