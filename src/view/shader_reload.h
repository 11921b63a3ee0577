/*
 * shader_reload.h: shader hot reload: compiles shaders with glslc when their files are saved, and
 * replaces the embedded ones.
 *
 * A thread polls the folder and recompiles files that changed, directly or in an include. Changes
 * take effect together and only if everything compiles; until then the previous shaders stay. A
 * shader may not use bindings that the embedded one lacks. Headers shared with C change for GLSL
 * only, so their layouts have to stay.
 *
 * Errors:        logged once, one line; also returned by shader_reload_message(). Thread-safety:
 * call all functions from one thread; the watch has its own.
 */
#ifndef FIRN_VIEW_SHADER_RELOAD_H
#define FIRN_VIEW_SHADER_RELOAD_H

#include <stdbool.h>
#include "graph/rg_exec.h"
#include "src/base/status.h"

struct shader_reload;

/* Starts to watch `folder`, which contains the shaders as in the source tree. Logs: STATUS_NO_INPUT
 * if it does not, STATUS_FAILED without glslc. `quiet`: does not print which shaders were compiled.
 */
MUST_USE enum status shader_reload_create(struct shader_reload **watch, const char *folder,
                                          bool quiet);
void shader_reload_destroy(struct shader_reload *watch); /* may be NULL */

/* Makes newly compiled shaders current for shader_reload_replace(). Returns true if there are any.
 */
bool shader_reload_take(struct shader_reload *watch);

/* Undoes shader_reload_take() after pipelines could not be created. */
void shader_reload_revert(struct shader_reload *watch);

/* Returns the current compilation error, one line, or "". Valid until the next
 * shader_reload_take(). */
const char *shader_reload_message(const struct shader_reload *watch);

/* Replaces shaders in executors; `user` is the watch. */
rg_replace_shader_fn shader_reload_replace;

#endif
