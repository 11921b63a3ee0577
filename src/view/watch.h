/*
 * watch.h: shaders that are compiled when their files are saved, with glslc as the build does it,
 * and take the place of those that the program has in it.
 *
 * A thread looks at the folder and compiles what has changed, or includes what has changed. All of
 * it takes effect together, and only without an error: until then the shaders before stay. A shader
 * may not read bindings that the one in the program does not have; what it shares with C (the .h
 * files) changes for GLSL alone, so keep their layouts.
 *
 * Errors:        logged once, one line; they are in watch_message(), too.
 * Thread-safety: all functions are for one thread; that of the watch is its own.
 */
#ifndef FIRN_VIEW_WATCH_H
#define FIRN_VIEW_WATCH_H

#include <stdbool.h>
#include "graph/rg_exec.h"
#include "src/base/status.h"

struct watch;

/* `folder` has the program's shaders, as shaders/ of its source. Logs: STATUS_NO_INPUT if it does
 * not, STATUS_FAILED if there is no glslangValidator. `quiet`: does not print what was compiled. */
MUST_USE enum status watch_create(struct watch **watch, const char *folder, bool quiet);
void watch_destroy(struct watch *watch); /* may be NULL */

/* Whether shaders have changed: if so, they count for watch_replace() from now on. */
bool watch_take(struct watch *watch);

/* As before watch_take(), after pipelines could not be made. */
void watch_revert(struct watch *watch);

/* What is wrong with the files as they are now, one line; "": nothing. Valid until the next
 * watch_take(). */
const char *watch_message(const struct watch *watch);

/* For executors; `user` is the watch. */
rg_replace_shader_fn watch_replace;

#endif
