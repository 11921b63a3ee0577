/*
 * window_canvas.h: an X window's pictures in memory that the X server reads (MIT-SHM).
 *
 * Only under servers without DRI3: to others drivers hand images themselves. It has a connection of
 * its own, so that GLFW's requests and answers stay GLFW's.
 */
#ifndef FIRN_VIEW_WINDOW_CANVAS_H
#define FIRN_VIEW_WINDOW_CANVAS_H

#include "src/gpu/gpu_canvas.h"

struct GLFWwindow;
struct window_canvas;

/* Returns NULL, silently, if the window's server cannot read memory of this process, or need not,
 * and in programs without X11. It outlives what shows pictures, and not the window. */
struct window_canvas *window_canvas_open(struct GLFWwindow *window);
void window_canvas_close(struct window_canvas *canvas); /* may be NULL */

/* Of NULL: NULL. */
const struct gpu_canvas *window_canvas_of(const struct window_canvas *canvas);

#endif
