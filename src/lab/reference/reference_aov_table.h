/* reference_aov_table.h: values computed for a camera ray, and the layers (AOVs) that store them.
 */
#ifndef FIRN_LAB_REFERENCE_REFERENCE_AOV_TABLE_H
#define FIRN_LAB_REFERENCE_REFERENCE_AOV_TABLE_H

#include <cglm/types-struct.h>
#include "src/render/frame/output_layers.h"
#include "src/settings/settings.h"

/* Inclusion types hit by a path: bits of the layer `inclusions`. */
enum reference_inclusion {
    REFERENCE_INCLUSION_BUBBLES = 1,
    REFERENCE_INCLUSION_CRACKS = 2,
    REFERENCE_INCLUSION_AIR = 4, /* or a plane of air */
};

/* Float values computed for a camera ray. Most are 0 if the ray hits nothing. */
struct reference_ray_values {
    vec3s color; /* linear radiance */
    float alpha; /* 1 - luminance of the transmittance to a hidden background */
    float z;     /* view depth, metres; else GBUFFER_NOTHING */
    vec3s normal, position;
    /* Refracted path: `exit` is its final direction. `path` is its length inside the object, in
     * metres. `bounces` is the number of total internal reflections. If there are any, `tir` is 1,
     * otherwise 0. */
    vec3s exit;
    float path, bounces, tir;
    float inclusion_bits;         /* inclusions hit by the refracted path */
    vec3s refraction, reflection; /* radiance per primary branch */
    float fresnel;                /* primary hit's reflectance; green if dispersive */
    vec3s remaining;              /* throughput of terminated rays */
    vec3s albedo;
    float object; /* primary hit's object number */
    float last;   /* refracted path's last object number */
    vec2s motion; /* pixels since the previous frame */
};

enum {
    REFERENCE_RAY_VALUE_COUNT = sizeof(struct reference_ray_values) / sizeof(float),
    REFERENCE_RAY_VALUE_ERROR, /* standard error of a pixel (reference_sample_sums.h) */
    REFERENCE_RAY_VALUE_NONE,
};

/* Returns the index of the value that an image plane stores: REFERENCE_RAY_VALUE_ERROR for the
 * standard error, REFERENCE_RAY_VALUE_NONE if the plane is unknown. */
size_t reference_layers_find(const char *plane);

/* Returns the name of the plane that stores value `index`, or NULL. */
const char *reference_layers_plane(size_t index);

/* Returns true if the path tracer can compute a layer. */
bool reference_has_layer(const struct frame_layer *layer);

enum {
    REFERENCE_NAMES_SIZE = 512 /* bytes for the names of reference_unsupported() */
};

/* Returns true if settings enable features that the path tracer lacks. Writes their names to
 * `names`, separated by commas. */
bool reference_unsupported(const struct settings *settings, char *names, size_t size);

#endif
