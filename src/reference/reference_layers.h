/* reference_layers.h: what a traced ray gives, and which planes of a picture take it. */
#ifndef FIRN_REFERENCE_LAYERS_H
#define FIRN_REFERENCE_LAYERS_H

#include <cglm/struct.h>
#include "src/frame/layers.h"
#include "src/settings/settings.h"

/* What a ray from the eye sees, all of float; zeros where there is nothing. */
struct reference_seen {
    vec3s color; /* linear radiance */
    float alpha; /* 1 */
    float z;     /* distance along the view's axis; GBUFFER_NOTHING: no surface */
    vec3s normal, position;
    vec3s exit;                   /* of light that is refracted wherever it can be: ... */
    float path, bounces, tir;     /* ... length, total reflections, whether the first meets one */
    vec3s refraction, reflection; /* radiance of both branches */
    float fresnel;                /* weight of the reflection (of green, with dispersion) */
    vec3s remaining;              /* weight of what was not followed to its end */
};

enum {
    REFERENCE_SEEN_COUNT = sizeof(struct reference_seen) / sizeof(float)
};

/* Which of the floats a plane takes; REFERENCE_SEEN_COUNT: none. */
size_t reference_layers_find(const char *plane);

/* Whether a layer is one that the reference makes. */
bool reference_makes(const struct frame_layer *layer);

enum {
    REFERENCE_NAMES_SIZE = 512 /* room for all of them */
};

/* Names of what the settings switch on and the reference leaves out, with commas between, into
 * `names`; true if there is any. */
bool reference_leaves_out(const struct settings *settings, char *names, size_t size);

#endif
