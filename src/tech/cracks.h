/* cracks.h: cracks inside the ice. */
#ifndef TECH_CRACKS_H
#define TECH_CRACKS_H
#include "shaders/cracks.h"
#include "src/tech/technique.h"

/* How cracks are kept inside the ice. */
enum cracks_clip {
    CRACKS_CLIP_CONVEX,   /* between the nearest front and the farthest back face */
    CRACKS_CLIP_INTERVAL, /* within one of the intervals of ice_interval */
    CRACKS_CLIP_PRECUT,   /* not at all: the scene's cracks were cut when it was loaded */
    CRACKS_CLIP_NONE,
};

/* How cracks change what is seen through the ice. */
enum cracks_refract {
    CRACKS_REFRACT_OFF,
    CRACKS_REFRACT_NORMALS, /* their normals take the place of the back faces' */
    CRACKS_REFRACT_GAP,     /* they reflect the environment as gaps filled with air do */
};

struct cracks_params {
    struct cracks_look look;
    uint32_t count, seed; /* of the scene's cracks */
    uint32_t clip;        /* enum cracks_clip */
    uint32_t refract;     /* enum cracks_refract */
};

/* Premultiplied: highlights, and what gaps reflect. */
extern const struct rg_image cracks_color;

extern const struct setting_group cracks_settings;

/*
 * What draws cracks_color. Without cracks it draws nothing there, and is culled unless the layer is
 * asked for. What is surely convex has one interval, from the nearest to the farthest face, and is
 * not searched for others.
 */
const struct technique *cracks_find(const struct settings *settings, bool is_convex);

/* Cracks are clipped to the ice, over whose picture over.c draws them; or what to list after that
 * draws them over all the picture, else NULL. */
bool cracks_are_in_ice(const struct settings *settings);
const struct technique *cracks_find_over(const struct settings *settings);

/* What to list before the rung and after ice_normal, whose image it changes; may be NULL. */
const struct technique *cracks_find_normals(const struct settings *settings, bool is_convex);

#endif
