/* fuzz_scene.h: what a model or a panorama that was accepted must be, for every pass draws it. */
#ifndef TESTS_FUZZ_SCENE_H
#define TESTS_FUZZ_SCENE_H

#include "src/base/status.h"
#include "src/scene/environment/environment.h"
#include "src/scene/import/model.h"

/* Abort if it is not so. */
void fuzz_check_model(const struct model *model);
void fuzz_check_environment(const struct environment *environment);

/* Aborts if something is left of a model or panorama that was refused. */
void fuzz_check_no_model(const struct model *model);
void fuzz_check_no_environment(const struct environment *environment);

/* Loads a panorama, checks it and frees it. */
enum status fuzz_load_environment(const char *path);

#endif
