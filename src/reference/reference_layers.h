/* reference_layers.h: the values of a traced ray, and the layers (AOVs) that store them. */
#ifndef FIRN_REFERENCE_LAYERS_H
#define FIRN_REFERENCE_LAYERS_H

#include <cglm/types-struct.h>
#include "src/frame/output_layers.h"
#include "src/settings/settings.h"

/* Inclusions hit by a path: the bits of the layer `met`. */
enum reference_inclusion {
    REFERENCE_INCLUSION_BUBBLES = 1,
    REFERENCE_INCLUSION_CRACKS = 2,
    REFERENCE_INCLUSION_AIR =
        4, /* a plane of air with an opacity above 0.05, or a scattering medium */
};

/* The values of a camera ray, all of them floats; 0 if nothing is hit. */
struct reference_ray_values {
    vec3s color; /* linear radiance */
    float alpha; /* 1; 0 for a hidden background */
    float z;     /* depth along the viewing direction, metres; GBUFFER_NOTHING if nothing is hit */
    vec3s normal, position;
    /* For the path that refracts wherever possible: exit direction, length inside the object in
     * metres, number of total internal reflections, and 1 if the first inner surface has one. */
    vec3s exit;
    float path, bounces, tir;
    float met; /* inclusions hit by the refracted path: enum reference_inclusion */
    vec3s refraction, reflection; /* radiance of both branches at the first surface */
    float fresnel;   /* reflectance at the first surface; with dispersion that of green */
    vec3s remaining; /* throughput of terminated rays */
    vec3s albedo;
    float object; /* number of the object at the primary hit */
    float last;   /* number of the last object that the refracted path hits */
    vec2s motion; /* pixels since the previous frame, right and down */
};

enum {
    REFERENCE_RAY_VALUE_COUNT = sizeof(struct reference_ray_values) / sizeof(float),
    REFERENCE_RAY_VALUE_ERROR, /* standard error of a pixel (reference_sample_sums.h) */
    REFERENCE_RAY_VALUE_NONE,
};

/* Returns the index of the float that a plane stores, REFERENCE_RAY_VALUE_ERROR, or
 * REFERENCE_RAY_VALUE_NONE if the plane is unknown. */
size_t reference_layers_find(const char *plane);

/* Returns the name of the plane that stores the float with this index, or NULL. */
const char *reference_layers_plane(size_t index);

/* Returns true if the path tracer can compute a layer. */
bool reference_has_layer(const struct frame_layer *layer);

enum {
    REFERENCE_NAMES_SIZE = 512 /* bytes for the names of reference_unsupported() */
};

/* Writes the names of enabled features that the path tracer does not support to `names`, separated
 * by commas. Returns true if there are any. */
bool reference_unsupported(const struct settings *settings, char *names, size_t size);

#endif
