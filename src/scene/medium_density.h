/* medium_density.h: density fields of tiny bubbles in ice (shaders/inclusions/medium.h). They are
 * made for objects whose material specifies them, or on request of the settings. Density grows with
 * depth, since freezing pushes air towards the core. */
#ifndef FIRN_SCENE_MEDIUM_DENSITY_H
#define FIRN_SCENE_MEDIUM_DENSITY_H

#include "src/scene/import/model.h"

enum {
    SCATTERING_MEDIA_MAX = 8, /* per scene; equals TRACE_SCATTERING_MAX (refract_trace.h) */
};

struct scattering_medium {
    uint32_t object; /* index of the object that contains the medium */
    float
        /* material.scattering_optical_depth; 0 to use the settings' optical depth */
        density;
    struct box box;    /* object's bounding box in mesh space, spanned by the texels */
    struct box filled; /* bounding box of non-zero density; set by scattering_media_fill() */
};

struct scattering_media {
    struct scattering_medium all[SCATTERING_MEDIA_MAX];
    uint32_t count;
    uint32_t left_out; /* objects beyond SCATTERING_MEDIA_MAX, rendered as clear */
    /* densities of each medium, 0 to 255, MEDIUM_SIZE texels per axis, x fastest; the second byte
     * is the density of the next texel along z; owned; NULL before scattering_media_fill() */
    uint8_t (*texels)[2];
};

/* Finds the scattering media of a model's materials, without texels. If `is_asked`, the first
 * object always gets one. If its material specifies no density, that of the settings is used. */
struct scattering_media scattering_media_find(const struct model *model, bool is_asked);

/* Generates the texels. Returns false when out of memory. */
bool scattering_media_fill(struct scattering_media *scattering_media, const struct model *model);

void scattering_media_finish(struct scattering_media *scattering_media); /* {0} is fine */

/* Returns a medium's density at a point, interpolated trilinearly, 0 to 1; 0 outside the box. */
float scattering_media_at(const struct scattering_media *scattering_media, uint32_t index,
                          vec3s point);

#endif
