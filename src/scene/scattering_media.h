/*
 * scattering_media.h: scattering media: density fields of tiny bubbles in ice
 * (shaders/inclusions/medium.h).
 *
 * An object has one if its material or the settings say so. Density grows with depth, since
 * freezing pushes air towards the core.
 */
#ifndef FIRN_SCENE_SCATTERING_MEDIA_H
#define FIRN_SCENE_SCATTERING_MEDIA_H

#include "src/scene/import/model.h"

enum {
    SCATTERING_MEDIA_MAX =
        8, /* maximum per scene; equals TRACE_SCATTERING_MAX of shaders/trace/refract_trace.h */
};

struct scattering_medium {
    uint32_t object;   /* index of the object that contains the medium */
    float density;     /* material.cloud; 0 if the settings define it */
    struct box box;    /* bounding box of the object, in mesh space, which the texels fill */
    struct box filled; /* bounding box of non-zero density; set by scattering_media_fill() */
};

struct clouds {
    struct scattering_medium all[SCATTERING_MEDIA_MAX];
    uint32_t count;
    uint32_t
        left_out; /* number of objects beyond SCATTERING_MEDIA_MAX, which are rendered as clear */
    /* for each medium MEDIUM_SIZE texels per axis, x fastest: density, with 255 as the maximum, and
     * density of the next texel along z; owned; NULL before scattering_media_fill() */
    uint8_t (*texels)[2];
};

/* Finds the scattering media of a model, without texels: those of materials and, if `is_asked`, one
 * in the first object with the density of the settings. */
struct clouds scattering_media_find(const struct model *model, bool is_asked);

/* Generates the texels. Returns false when out of memory. */
bool scattering_media_fill(struct clouds *clouds, const struct model *model);

void scattering_media_finish(struct clouds *clouds); /* {0} is fine */

/* Returns the trilinearly interpolated density of a medium at a point, 0 to 1; 0 outside its box.
 */
float scattering_media_at(const struct clouds *clouds, uint32_t index, vec3s point);

#endif
