/* ui_reproduce_command.h: prints the `firn render` command that reproduces the viewer's image. Of a
 * split view, that is side A. The command is quoted for a shell; default options are omitted. With
 * env_cube.dynamic=off, the environment cube may differ: it depends on the scene time. */
#ifndef FIRN_VIEW_UI_UI_REPRODUCE_COMMAND_H
#define FIRN_VIEW_UI_UI_REPRODUCE_COMMAND_H

#include "src/app/app.h"

struct ui_render_command {
    const struct app_image *image; /* current settings and size */
    const struct scene *scene;
    const struct camera *camera;
    float time; /* scene time, seconds */
};

/* Returns one line, malloc'd, without newline. If out of memory, logs and returns NULL. Warns if
 * the camera has roll, which no option can describe. The printed camera is level. */
char *ui_render_command_print(const struct ui_render_command *command);

#endif
