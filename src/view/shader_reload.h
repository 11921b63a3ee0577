/* shader_reload.h: shader hot reload: compiles shaders with glslc when their files are saved, and
 * replaces the embedded ones. A thread polls the folder and recompiles files that changed, directly
 * or in an include. Changes take effect together and only if everything compiles; until then the
 * previous shaders stay. A shader may not use bindings that the embedded one lacks. Headers shared
 * with C change for GLSL only, so their layouts have to stay. Errors are logged once, in one line.
 * Call all functions from one thread. */
#ifndef FIRN_VIEW_SHADER_RELOAD_H
#define FIRN_VIEW_SHADER_RELOAD_H

#include <stdbool.h>
#include "graph/rg_exec.h"
#include "src/base/status.h"

struct shader_reload;

/* Starts to watch `folder`, which must have the layout of the source tree. Logs errors. If there
 * are no shaders, returns STATUS_NO_INPUT. If glslc cannot be run, returns STATUS_FAILED. If
 * `quiet`, does not log successful compilations. */
MUST_USE enum status shader_reload_create(struct shader_reload **reload, const char *folder,
                                          bool quiet);
void shader_reload_destroy(struct shader_reload *w); /* may be NULL */

/* Makes shader_reload_replace() use the newly compiled shaders. Returns false if there are none. */
bool shader_reload_take(struct shader_reload *w);

/* Reactivates the previous shaders. Call this if the new shaders do not give valid pipelines. */
void shader_reload_revert(struct shader_reload *w);

/* Returns a one-line compilation error, or "". The text is valid until shader_reload_take(). */
const char *shader_reload_message(const struct shader_reload *w);

/* Callback by which executors get reloaded shaders. `user` must be a struct shader_reload. */
rg_replace_shader_fn shader_reload_replace;

#endif
