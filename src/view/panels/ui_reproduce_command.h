/* ui_reproduce_command.h: prints a shell command, `firn render`, that reproduces the viewer's
 * image. Of a split view, only side A is reproduced. With env_cube.dynamic=off, the environment
 * cube may differ, because the viewer may have drawn it at an earlier or later scene time. */
#ifndef FIRN_VIEW_PANELS_UI_REPRODUCE_COMMAND_H
#define FIRN_VIEW_PANELS_UI_REPRODUCE_COMMAND_H

#include "src/setup/setup.h"

struct ui_render_command {
    const struct setup_image *image; /* current settings and size */
    const struct scene *scene;
    const struct camera *camera;
    float time; /* scene time, seconds */
};

/* Returns the command as one line without newline; the caller frees it. If out of memory, logs an
 * error and returns NULL. If the camera is rolled, warns, because no option sets the roll. */
char *ui_render_command_print(const struct ui_render_command *command);

#endif
