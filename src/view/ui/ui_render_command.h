/* ui_render_command.h: prints the `firn render` command that draws what the window shows, quoted
 * for a shell, with only the options that differ from the defaults. Of a split view, only side A is
 * drawn; with env_cube.dynamic=off, the cube is drawn at the command's time. */
#ifndef FIRN_VIEW_UI_UI_RENDER_COMMAND_H
#define FIRN_VIEW_UI_UI_RENDER_COMMAND_H

#include "src/app/app.h"

struct ui_render_command {
    const struct app_image *image; /* current settings and size */
    const struct scene *scene;
    const struct camera *camera;
    float time; /* scene time, seconds */
};

/* Returns one line, malloc'd, without newline; NULL if out of memory, which is logged. A camera
 * with roll is levelled, with a warning, because no option describes roll. */
char *ui_render_command_print(const struct ui_render_command *command);

#endif
