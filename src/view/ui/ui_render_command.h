/* ui_render_command.h: prints the `firn render` command that reproduces the viewer's image (side A
 * of a split view), quoted for a shell and without default options. With env_cube.dynamic=off, the
 * environment cube may differ, as it is rendered at the command's scene time. */
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
