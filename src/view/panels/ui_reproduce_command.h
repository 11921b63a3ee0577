/* ui_reproduce_command.h: prints a `firn render` command, quoted for a shell, that reproduces the
 * viewer's image. A split view is reproduced as side A only. With env_cube.dynamic=off, the
 * environment cube may differ, because the viewer may have drawn it at another scene time. */
#ifndef FIRN_VIEW_PANELS_UI_REPRODUCE_COMMAND_H
#define FIRN_VIEW_PANELS_UI_REPRODUCE_COMMAND_H

#include "src/setup/setup.h"

struct ui_render_command {
    const struct setup_image *image; /* current settings and size */
    const struct scene *scene;
    const struct camera *camera;
    float time; /* scene time, seconds */
};

/* Returns the command as one line, malloc'd, without newline. If out of memory, logs and returns
 * NULL. A rolled camera is printed level, with a warning, because no option describes roll. */
char *ui_render_command_print(const struct ui_render_command *command);

#endif
