/* scene_source.h: arrays of the caller that replace the model or environment file of a scene. */
#ifndef FIRN_LIB_SCENE_SOURCE_H
#define FIRN_LIB_SCENE_SOURCE_H

#include "src/lib/lib.h"
#include "src/scene/import/model_arrays.h"

struct lib_arrays {
    struct model_arrays model;
    struct environment environment; /* texels are NULL if none is set */
};

/* Value of the option `env` that stands for an environment from an array; compared by address. */
extern const char lib_environment_name[];

/* Sets scene->source to provide the scene's arrays and changed materials. */
void lib_set_source(firn_scene *scene);
void lib_free_arrays(struct lib_arrays *arrays);

#endif
