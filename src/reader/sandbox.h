/*
 * sandbox.h: takes from this process everything but reading one file, or one folder, and computing.
 *
 * Four things, each as far as the kernel has it (docs/trust.md says what is left without it):
 * Landlock, so that no other file can be opened; a seccomp filter that allows few system calls (no
 * new processes or programs, no sockets, no signals to others, nothing opened for writing, no new
 * executable memory); no capabilities but those to read files of others; no new privileges. What
 * the filter does not allow fails with EPERM.
 */
#ifndef FIRN_READER_SANDBOX_H
#define FIRN_READER_SANDBOX_H

#include <stdbool.h>
#include "src/base/status.h"

/*
 * Holds for this thread and all that it could start, and for good. Of the file system, `path` stays
 * readable, and where `with_folder` is true, all in its folder and those below, without what links
 * there lead to elsewhere. Descriptors that are open stay usable. Returns false if a part that the
 * kernel has cannot be applied.
 */
MUST_USE bool sandbox_enter(const char *path, bool with_folder);

/* What of the sandbox this kernel has. */
struct sandbox_parts {
    int landlock; /* version of its interface; 0: none */
    bool seccomp;
};
struct sandbox_parts sandbox_find(void);

#endif
