/* reference_layers.h: the values of a traced ray, and the planes of a picture that receive them. */
#ifndef FIRN_REFERENCE_LAYERS_H
#define FIRN_REFERENCE_LAYERS_H

#include <cglm/types-struct.h>
#include "src/frame/layers.h"
#include "src/settings/settings.h"

/* What a path has met: the bits of the layer `met`. */
enum reference_met {
    REFERENCE_MET_BUBBLES = 1,
    REFERENCE_MET_CRACKS = 2,
    REFERENCE_MET_AIR =
        4, /* a plane that covers more than a twentieth, or a medium that scatters */
};

/* The values of a ray from the eye, all of them floats; 0 without a surface. */
struct reference_seen {
    vec3s color; /* linear radiance */
    float alpha; /* 1; of a hidden background 0 */
    float z;     /* distance along the view's axis, metres; GBUFFER_NOTHING: no surface */
    vec3s normal, position;
    /* Of the path that is refracted wherever that is possible: direction of its exit, length inside
     * the object in metres, number of total reflections, 1 if its first inner surface has one. */
    vec3s exit;
    float path, bounces, tir;
    float met;                    /* by the same path: enum reference_met */
    vec3s refraction, reflection; /* radiance of both branches at the first surface */
    float fresnel;                /* weight of the reflection (with dispersion, of green) */
    vec3s remaining;              /* weight of rays that were terminated */
    vec3s albedo;
    float object; /* number of the first surface's object */
    float last;   /* the same of the last surface of the path that is refracted */
    vec2s motion; /* pixels since the frame before, right and down */
};

enum {
    REFERENCE_SEEN_COUNT = sizeof(struct reference_seen) / sizeof(float),
    REFERENCE_SEEN_ERROR, /* of no ray: the standard error of a pixel (reference_sums.h) */
    REFERENCE_SEEN_NOTHING,
};

/* Returns the index of the float that a plane receives, REFERENCE_SEEN_ERROR or
 * REFERENCE_SEEN_NOTHING. */
size_t reference_layers_find(const char *plane);

/* Returns the plane that receives the float of an index. */
const char *reference_layers_plane(size_t index);

/* Returns whether the reference has a layer. */
bool reference_makes(const struct frame_layer *layer);

enum {
    REFERENCE_NAMES_SIZE = 512 /* bytes for all names of reference_leaves_out() */
};

/* Writes the names of features that the settings switch on and the reference leaves out, separated
 * by commas, to `names`. Returns whether there are any. */
bool reference_leaves_out(const struct settings *settings, char *names, size_t size);

#endif
