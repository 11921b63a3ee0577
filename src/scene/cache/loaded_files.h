/* loaded_files.h: keeps the model and the environment of a scene as they were read, so that changes
 * of objects, materials and exposure do not read the files again. */
#ifndef FIRN_SCENE_CACHE_LOADED_FILES_H
#define FIRN_SCENE_CACHE_LOADED_FILES_H

#include "src/scene/environment/environment.h"
#include "src/scene/import/model.h"

/* Contents of the files of one scene, before any option changes them. {0} is empty. */
struct loaded_files {
    struct model model;
    char *model_key; /* name of the model and how it was read; NULL without a model */
    char *objects;   /* model_pose.objects when it was read */
    struct environment environment;
    char *environment_name; /* NULL without an environment */
    uint16_t *prefiltered;  /* image_based_lighting_prefilter() of the environment; or NULL */
    float prefiltered_stops;
};

void loaded_files_finish(struct loaded_files *files);
void loaded_files_drop_environment(struct loaded_files *files);

/* Copies the model if reading it like this has the same result, else returns false. The caller owns
 * the copy. Poses at other times than 0 must be read. */
bool loaded_files_copy_model(const struct loaded_files *files, const char *name,
                             enum model_role role, const struct model_pose *pose,
                             struct model *model);

/* Keeps a copy of a model that was read. When out of memory, keeps nothing. */
void loaded_files_keep_model(struct loaded_files *files, const char *name, enum model_role role,
                             const struct model_pose *pose, const struct model *model);

/* Copies or keeps the environment map without its rotation and exposure, as the functions above do
 * the model. */
bool loaded_files_copy_environment(const struct loaded_files *files, const char *name,
                                   struct environment *environment);
void loaded_files_keep_environment(struct loaded_files *files, const char *name,
                                   const struct environment *environment);

/* Returns the prefiltered lighting of the kept environment, to which an exposure was applied. The
 * caller owns it. NULL when out of memory. */
uint16_t *loaded_files_prefilter(struct loaded_files *files, const struct environment *environment,
                                 float stops);

#endif
