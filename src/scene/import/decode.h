/* decode.h: reads models and panoramas in a reader process (reader.h, with its errors). */
#ifndef FIRN_SCENE_IMPORT_DECODE_H
#define FIRN_SCENE_IMPORT_DECODE_H

#include "src/reader/reader.h"
#include "src/scene/environment.h"
#include "src/scene/import/model.h"

/* Load a file as model_load_posed() (pose NULL: at rest) and environment_load() do; if `params` is
 * NULL, in this process. */
MUST_USE enum status decode_model(struct model *model, const char *path,
                                  enum model_part everything_is, const struct model_pose *pose,
                                  const struct reader_params *params);
MUST_USE enum status decode_environment(struct environment *environment, const char *path,
                                        const struct reader_params *params);

/* Does the whole work of a reader process, of all kinds, and returns its exit code. */
int decode_main(int argc, char **argv);

#endif
