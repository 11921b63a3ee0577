/*
 * clouds.h: scattering media: density fields of tiny bubbles in ice (shaders/cloud.h).
 *
 * An object has one if its material or the settings say so. Density grows with depth, since
 * freezing pushes air towards the core.
 */
#ifndef FIRN_SCENE_CLOUDS_H
#define FIRN_SCENE_CLOUDS_H

#include "src/scene/import/model.h"

enum {
    CLOUDS_MAX = 8, /* maximum per scene; equals TRACE_CLOUDS_MAX of shaders/refract_trace.h */
};

struct cloud_field {
    uint32_t object;   /* index of the object that contains the medium */
    float density;     /* material.cloud; 0 if the settings define it */
    struct box box;    /* bounding box of the object, in mesh space, which the texels fill */
    struct box filled; /* bounding box of non-zero density; set by clouds_fill() */
};

struct clouds {
    struct cloud_field all[CLOUDS_MAX];
    uint32_t count;
    uint32_t left_out; /* number of objects beyond CLOUDS_MAX, which are rendered as clear */
    /* for each medium CLOUD_SIZE texels per axis, x fastest: density, with 255 as the maximum, and
     * density of the next texel along z; owned; NULL before clouds_fill() */
    uint8_t (*texels)[2];
};

/* Finds the scattering media of a model, without texels: those of materials and, if `is_asked`, one
 * in the first object with the density of the settings. */
struct clouds clouds_find(const struct model *model, bool is_asked);

/* Generates the texels. Returns false when out of memory. */
bool clouds_fill(struct clouds *clouds, const struct model *model);

void clouds_finish(struct clouds *clouds); /* {0} is fine */

/* Returns the trilinearly interpolated density of a medium at a point, 0 to 1; 0 outside its box.
 */
float clouds_at(const struct clouds *clouds, uint32_t index, vec3s point);

#endif
