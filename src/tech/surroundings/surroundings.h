/* surroundings.h: passes that draw the scene around the ice. */
#ifndef FIRN_TECH_SURROUNDINGS_SURROUNDINGS_H
#define FIRN_TECH_SURROUNDINGS_SURROUNDINGS_H
#include "graph/rg_cmd.h"
#include "src/tech/technique.h"

/* Parameters of the passes that draw the surroundings and the sky. */
struct surroundings_pass_params {
    const char *name;                     /* technique name; prefixes pass names */
    const struct rg_image *color, *depth; /* reversed depth: 0 is infinity */
    bool keep;                            /* load instead of clear the images */
    bool caustics;                        /* apply ice caustics and shadow */
    const struct scene *scene;
    bool per_vertex; /* per-vertex lighting; excludes `has_ssr` */
    bool has_ssr;    /* write the SSR inputs */
    enum rg_repeat repeat;
    rg_record_fn *record_surroundings, *record_sky; /* both push a struct surroundings_push */
    rg_when_fn *when;                               /* condition for both passes */
};

/* Builds the passes of the surroundings and the sky in memory that `builder` owns. */
struct rg_technique surroundings_make(struct pass_arena *builder,
                                      const struct surroundings_pass_params *params);

#endif
