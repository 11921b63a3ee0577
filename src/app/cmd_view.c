/* cmd_view.c: command firn view: starts firn-view, the only program that links a window system. */
#include <errno.h>
#include <string.h>
#include "src/app/app.h"
#include "src/base/log.h"
#include "src/base/process.h"
#include "src/base/program.h"

enum status app_view(const struct app_options *o)
{
    char path[PROGRAM_PATH_SIZE];
    const int error = program_path(path, "firn-view") ? process_replace(path, o->run.args) : ENOENT;
    if (error == ENOENT)
        log_error("firn-view is not installed: this build has no window; rebuild with meson "
                  "-Dview=enabled (needs GLFW and Dear ImGui)");
    else
        log_error("cannot start firn-view: %s", strerror(error));
    return STATUS_NO_DEVICE;
}
