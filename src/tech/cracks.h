/* cracks.h: cracks inside the ice. */
#ifndef TECH_CRACKS_H
#define TECH_CRACKS_H
#include "shaders/cracks.h"
#include "src/tech/technique.h"

/* How cracks are clipped to the ice. */
enum cracks_clip {
    CRACKS_CLIP_CONVEX,   /* between the nearest front and the farthest back face */
    CRACKS_CLIP_INTERVAL, /* within one of the intervals of ice_interval */
    CRACKS_CLIP_PRECUT,   /* not when drawn: they were cut when the scene was loaded */
    CRACKS_CLIP_NONE,     /* not at all */
};

/* How cracks change what is seen through the ice. */
enum cracks_refract {
    CRACKS_REFRACT_OFF,
    CRACKS_REFRACT_NORMALS, /* their normals replace those of the back faces */
    CRACKS_REFRACT_GAP,     /* they reflect the environment as thin gaps of air */
};

struct cracks_params {
    struct cracks_look look;
    uint32_t count, seed; /* of the scene's cracks */
    float size;           /* factor on theirs */
    uint32_t clip;        /* enum cracks_clip */
    uint32_t refract;     /* enum cracks_refract */
};

/* Premultiplied colours: highlights, and reflections of gaps. */
extern const struct rg_image cracks_color;

/* What gaps that reflect much show of themselves, for rungs that follow light on from there
 * (shaders/cracks_met.glsl); 0 without one. Nothing writes it unless cracks_are_met(). */
extern const struct rg_image cracks_met;

extern const struct setting_group cracks_settings;

extern const struct technique cracks;

/* Returns whether there are cracks that are clipped to the ice, which over.c draws over the ice;
 * other cracks are drawn over the finished picture. */
bool cracks_are_in_ice(const struct settings *settings);

/* Returns whether a rung, which may be NULL, follows what cracks mirror. */
bool cracks_are_met(const struct settings *settings, const struct technique *rung);

#endif
