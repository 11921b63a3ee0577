/*
 * watch.h: shader hot reload: compiles shaders with glslc when their files are saved, and replaces
 * the embedded ones.
 *
 * A thread polls the folder and recompiles files that changed, directly or in an include. Changes
 * take effect together and only if everything compiles; until then the previous shaders stay. A
 * shader may not use bindings that the embedded one lacks. Headers shared with C change for GLSL
 * only, so their layouts have to stay.
 *
 * Errors:        logged once, one line; also returned by watch_message(). Thread-safety: call all
 * functions from one thread; the watch has its own.
 */
#ifndef FIRN_VIEW_WATCH_H
#define FIRN_VIEW_WATCH_H

#include <stdbool.h>
#include "graph/rg_exec.h"
#include "src/base/status.h"

struct watch;

/* Starts to watch `folder`, which contains the shaders as in the source tree. Logs: STATUS_NO_INPUT
 * if it does not, STATUS_FAILED without glslc. `quiet`: does not print which shaders were compiled.
 */
MUST_USE enum status watch_create(struct watch **watch, const char *folder, bool quiet);
void watch_destroy(struct watch *watch); /* may be NULL */

/* Makes newly compiled shaders current for watch_replace(). Returns true if there are any. */
bool watch_take(struct watch *watch);

/* Undoes watch_take() after pipelines could not be created. */
void watch_revert(struct watch *watch);

/* Returns the current compilation error, one line, or "". Valid until the next watch_take(). */
const char *watch_message(const struct watch *watch);

/* Replaces shaders in executors; `user` is the watch. */
rg_replace_shader_fn watch_replace;

#endif
