/*
 * clouds.h: where the ice of a scene scatters light: bubbles too small to be seen one by one
 * (shaders/cloud.h), in each object whose material says so.
 */
#ifndef FIRN_SCENE_CLOUDS_H
#define FIRN_SCENE_CLOUDS_H

#include "src/scene/import/model.h"

enum {
    CLOUDS_MAX = 8, /* of a scene; TRACE_CLOUDS_MAX of shaders/refract_trace.h */
};

struct cloud_field {
    uint32_t object;   /* whose ice it is in */
    float density;     /* material.cloud; 0: that of settings */
    struct box box;    /* of the object, in the space of the mesh; the texels fill it */
    struct box filled; /* the part of it outside of which there is no cloud; of clouds_fill() */
};

struct clouds {
    struct cloud_field all[CLOUDS_MAX];
    uint32_t count;
    uint32_t left_out;    /* objects beyond CLOUDS_MAX, which are clear */
    uint8_t (*texels)[2]; /* CLOUD_SIZE a side, along x first, then y, for each cloud: its density,
                             255 where it is greatest, and that of the next texel along z; owned;
                             NULL until clouds_fill() */
};

/* Finds the clouds of a model: those of materials, or, if `is_asked`, also one in the first object,
 * whose density settings say. Without texels. */
struct clouds clouds_find(const struct model *model, bool is_asked);

/* Makes the texels. Returns false when out of memory. */
bool clouds_fill(struct clouds *clouds, const struct model *model);

void clouds_finish(struct clouds *clouds); /* {0} is fine */

/* Returns the density of a cloud at a point, 0 to 1, linear between texels; 0 outside its box. */
float clouds_at(const struct clouds *clouds, uint32_t index, vec3s point);

#endif
