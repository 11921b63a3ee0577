/* cracks.h: cracks inside the ice: settings, images and passes. */
#ifndef FIRN_TECH_INCLUSIONS_CRACKS_H
#define FIRN_TECH_INCLUSIONS_CRACKS_H
#include "shaders/inclusions/cracks.h"
#include "src/tech/technique.h"

/* Methods of clipping cracks to the ice. */
enum cracks_clip {
    CRACKS_CLIP_CONVEX,   /* nearest front to farthest back face */
    CRACKS_CLIP_INTERVAL, /* to the intervals of ice_interval */
    CRACKS_CLIP_NONE,     /* no clipping */
};

/* Effect of cracks on what is visible through the ice. */
enum cracks_refract {
    CRACKS_REFRACT_OFF,
    CRACKS_REFRACT_NORMALS, /* replace normals of the back faces */
    CRACKS_REFRACT_GAP,     /* reflect the environment as air gaps */
};

struct cracks_params {
    struct cracks_shading shading;
    uint32_t count, seed; /* number of cracks; random seed */
    float size;           /* factor on the sheet width */
    uint32_t clip;        /* enum cracks_clip */
    uint32_t refract;     /* enum cracks_refract */
};

/* Premultiplied colour of cracks: highlights, and reflections at air gaps. */
extern const struct rg_image cracks_color;

/* Depth and normal of each pixel's most reflective air gap in a crack, or 0 without one. Refraction
 * models reflect rays at these gaps. Written only if cracks_are_traced(). */
extern const struct rg_image cracks_hits;

extern const struct setting_group cracks_settings;

extern const struct technique cracks;

/* Returns true if composite.c blends cracks, clipped to the ice, into the image. Otherwise cracks
 * are drawn over the finished image. */
bool cracks_are_in_ice(const struct settings *settings);

/* Returns true if the refraction model traces reflections at cracks. `refraction` may be NULL. */
bool cracks_are_traced(const struct settings *settings, const struct technique *refraction);

#endif
