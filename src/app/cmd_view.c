/* cmd_view.c: command firn view: starts firn-view, the only program that links a window system. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include "src/app/app.h"
#include "src/base/log.h"
#include "src/version.h"

enum {
    PATH_SIZE = 4096
};

static const char name[] = "/firn-view";

/* Writes the path of firn-view beside this program. Returns false if its folder is unknown. */
static bool find_beside(char path[static PATH_SIZE])
{
    const ssize_t length = readlink("/proc/self/exe", path, PATH_SIZE - sizeof(name));
    if (length <= 0 || length >= (ssize_t)(PATH_SIZE - sizeof(name)))
        return false;
    path[length] = '\0';
    char *slash = strrchr(path, '/');
    if (!slash)
        return false;
    memcpy(slash, name, sizeof(name));
    return true;
}

enum status app_view(const struct app_options *o)
{
    static const char installed[] = FIRN_BINDIR "/firn-view";
    char path[PATH_SIZE];
    if (find_beside(path))
        execv(path, o->run.args);
    if (errno == ENOENT)
        execv(installed, o->run.args);
    if (errno == ENOENT)
        log_error("firn-view is not installed: this build has no window; rebuild with meson "
                  "-Dview=enabled (needs GLFW and Dear ImGui)");
    else
        log_error("cannot start firn-view: %s", strerror(errno));
    return STATUS_NO_DEVICE;
}
