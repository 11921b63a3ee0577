/* medium_density.h: density fields of tiny bubbles in ice (shaders/inclusions/medium_density.h).
 * The material or the settings give an object such a field. Density grows with depth, because
 * freezing ice pushes air towards the core. */
#ifndef FIRN_SCENE_SCATTERING_MEDIA_H
#define FIRN_SCENE_SCATTERING_MEDIA_H

#include "shaders/inclusions/medium_density.h"
#include "src/scene/import/model.h"

struct scattering_medium {
    uint32_t object; /* index of the object that contains the medium */
    float
        /* material.scattering_optical_depth, or 0 to use that of the settings */
        density;
    bool is_even;      /* true for the maximum density everywhere */
    struct box box;    /* bounding box of object and texels, in mesh space */
    struct box filled; /* bounding box of non-zero density; set by scattering_media_fill() */
};

struct scattering_media {
    struct scattering_medium all[MEDIUM_MAX];
    uint32_t count;
    uint32_t left_out; /* objects beyond MEDIUM_MAX, rendered as clear */
    /* densities, 0 to 255, of MEDIUM_SIZE^3 texels per medium, x fastest. Byte 0 is the density of
     * the texel, byte 1 that of the next texel in z. Owned; NULL before scattering_media_fill(). */
    uint8_t (*texels)[2];
};

/* Finds the objects whose materials scatter light. Generates no texels. If `is_asked`, includes the
 * first object, too. If its material sets no optical depth, the settings do. */
struct scattering_media scattering_media_find(const struct model *model, bool is_asked);

/* Generates the texels. Returns false when out of memory. */
bool scattering_media_fill(struct scattering_media *scattering_media, const struct model *model);

void scattering_media_finish(struct scattering_media *scattering_media); /* {0} is fine */

/* Returns a medium's density at a point, interpolated trilinearly, 0 to 1; 0 outside the box. */
float scattering_media_at(const struct scattering_media *scattering_media, uint32_t index,
                          vec3s point);

#endif
