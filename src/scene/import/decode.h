/* decode.h: loads models and environment maps in a sandboxed reader process (errors: reader.h). */
#ifndef FIRN_SCENE_IMPORT_DECODE_H
#define FIRN_SCENE_IMPORT_DECODE_H

#include "src/reader/reader.h"
#include "src/scene/environment.h"
#include "src/scene/import/model.h"

/* Load a file like model_load_posed() (a NULL pose is the rest pose) or environment_load(), in a
 * reader process; if `params` is NULL, in this process. */
MUST_USE enum status decode_model(struct model *model, const char *path,
                                  enum model_part everything_is, const struct model_pose *pose,
                                  const struct reader_params *params);
MUST_USE enum status decode_environment(struct environment *environment, const char *path,
                                        const struct reader_params *params);

/* Main function of a reader process: parses the file, sends the result, returns the exit code. */
int decode_main(int argc, char **argv);

#endif
