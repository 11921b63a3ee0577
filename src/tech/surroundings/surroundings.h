/* surroundings.h: passes that draw the scene around the ice. */
#ifndef FIRN_TECH_SURROUNDINGS_SURROUNDINGS_H
#define FIRN_TECH_SURROUNDINGS_SURROUNDINGS_H
#include "graph/rg_cmd.h"
#include "src/tech/technique.h"

/* Parameters of the passes that draw the surroundings, and then the sky in the remaining pixels. */
struct surroundings_rows {
    const char *name;                     /* of the technique, prefix of the passes' names */
    const struct rg_image *color, *depth; /* reversed depth: 0 is infinity */
    bool keep;     /* load the images instead of clearing: the object has been drawn */
    bool caustics; /* apply the caustics and shadow of ice_caustics.c */
    bool has_materials, has_extras; /* as in technique_choice */
    bool per_vertex; /* lighting per vertex of surroundings with materials; excludes `mirrors` */
    bool has_ssr;    /* write the inputs of the screen-space reflections */
    enum rg_repeat repeat;
    rg_record_fn *record_surroundings, *record_sky; /* both push a struct surroundings_push */
    rg_when_fn *when;                               /* condition for both passes */
};

/* Builds the two passes in memory that `builder` owns. */
struct rg_technique surroundings_make(struct pass_builder *builder,
                                      const struct surroundings_rows *wanted);

#endif
