/* background.h: the scene around the ice, as the eye sees it. */
#ifndef TECH_BACKGROUND_H
#define TECH_BACKGROUND_H
#include "graph/rg_cmd.h"
#include "src/tech/technique.h"

/* Rows that draw the surroundings, and then the sky where there are no surroundings. */
struct background_rows {
    const char *name;                     /* of the technique */
    const struct rg_image *color, *depth; /* reversed depth: 0 is infinity */
    bool keep;                            /* keep the images' content: the object, drawn before */
    bool shine;                           /* lit by ice_caustics.h */
    bool has_materials, has_extras;       /* of technique_choice */
    bool at_vertices; /* surroundings with materials are lit there, and do not mirror */
    bool mirrors;     /* surroundings with materials fill the images of mirror.h, too */
    enum rg_repeat repeat;
    rg_record_fn *record_surroundings, *record_sky; /* both push a struct background_push */
    rg_when_fn *when;                               /* of both */
};

/* Makes the rows with `builder`, which owns them. */
struct rg_technique background_make(struct row_builder *builder,
                                    const struct background_rows *wanted);

#endif
