/*
 * window_canvas.h: presents images to an X window through shared memory (MIT-SHM).
 *
 * Used only on X servers without DRI3; with DRI3, drivers share images with the server themselves.
 * It opens an X connection of its own, so that it does not interfere with GLFW's requests and
 * replies.
 */
#ifndef FIRN_VIEW_WINDOW_CANVAS_H
#define FIRN_VIEW_WINDOW_CANVAS_H

#include "src/gpu/gpu_canvas.h"

struct GLFWwindow;
struct window_canvas;

/* Returns NULL, without logging, if the server cannot read shared memory or has DRI3, and without
 * X11. The canvas must outlive its users, but not the window. */
struct window_canvas *window_canvas_open(struct GLFWwindow *window);
void window_canvas_close(struct window_canvas *canvas); /* may be NULL */

/* Returns the canvas for a swapchain; NULL for NULL. */
const struct gpu_canvas *window_canvas_of(const struct window_canvas *canvas);

#endif
