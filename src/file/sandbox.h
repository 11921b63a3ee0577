/*
 * sandbox.h: restricts this process to reading one file or folder and computing.
 *
 * Four mechanisms are applied as far as the kernel supports them (docs/explanation/trust.md
 * describes what remains possible without them): Landlock, so that no other file can be opened; a
 * seccomp filter that allows few system calls (no new processes or programs, sockets, signals to
 * others, opening for writing, or new executable memory); no capabilities except those to read
 * other users' files; and no_new_privs. Other calls fail with EPERM.
 */
#ifndef FIRN_FILE_SANDBOX_H
#define FIRN_FILE_SANDBOX_H

#include <stdbool.h>
#include "src/base/status.h"

/*
 * Restricts this thread and all threads that it starts, permanently. The file `path` and all open
 * descriptors stay usable. If `with_folder` is true, files in the folder of `path` stay readable,
 * except through links to the outside. Returns false if a supported mechanism cannot be applied.
 */
MUST_USE bool sandbox_enter(const char *path, bool with_folder);

/* Sandbox mechanisms that this kernel supports. */
struct sandbox_support {
    int landlock; /* Landlock ABI version, or 0 */
    bool seccomp;
};
struct sandbox_support sandbox_query(void);

#endif
