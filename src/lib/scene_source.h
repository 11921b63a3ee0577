/* scene_source.h: arrays of the caller that replace the files of a scene. */
#ifndef FIRN_LIB_SCENE_SOURCE_H
#define FIRN_LIB_SCENE_SOURCE_H

#include "src/lib/lib.h"
#include "src/scene/import/model_arrays.h"

struct lib_arrays {
    struct model_arrays model;
    struct environment environment; /* texels NULL unless set */
};

/* Value of the option `env` for an environment from an array; recognised by its address. */
extern const char lib_environment_name[];

/* Sets scene->source for the arrays and changed materials of a scene. */
void lib_set_source(firn_scene *scene);
void lib_free_arrays(struct lib_arrays *arrays);

#endif
