/* sandboxed_load.h: loads models and environments in a sandboxed reader process (reader_process.h).
 */
#ifndef FIRN_SCENE_IMPORT_SANDBOXED_LOAD_H
#define FIRN_SCENE_IMPORT_SANDBOXED_LOAD_H

#include "src/file/reader_process.h"
#include "src/scene/environment/environment.h"
#include "src/scene/import/model.h"

/* Loads a model like model_load_posed(), in a separate reader process unless `params` is NULL. If
 * `pose` is NULL, loads the rest pose. Returns the errors of reader_process.h. */
MUST_USE enum status sandboxed_load_model(struct model *model, const char *path,
                                          enum model_role default_role,
                                          const struct model_pose *pose,
                                          const struct reader_params *params);
/* Loads an environment like environment_load(). Uses a reader process unless `params` is NULL. */
MUST_USE enum status sandboxed_load_environment(struct environment *environment, const char *path,
                                                const struct reader_params *params);

/* Runs a reader process: parses the file, sends the result, returns the exit code. */
int sandboxed_load_main(int argc, char **argv);

#endif
