/*
 * ui_command.h: the `firn render` that draws what a window shows.
 *
 * Only what differs from the defaults is said, in words that a shell reads back as they were. With
 * env_cube.dynamic=off the cube is drawn at the time of the command's picture. Of a split window it
 * draws what is on the left.
 */
#ifndef FIRN_VIEW_UI_UI_COMMAND_H
#define FIRN_VIEW_UI_UI_COMMAND_H

#include "src/app/app.h"

struct ui_command {
    const struct app_picture *picture; /* settings and size in use */
    const struct scene *scene;
    const struct camera *camera;
    float time; /* seconds */
};

/* One line, malloc'd, without newline. NULL: out of memory, which is logged. A camera that leans is
 * put upright, with a warning: no option says how it leans. */
char *ui_command_print(const struct ui_command *command);

#endif
