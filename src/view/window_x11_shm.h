/* window_x11_shm.h: presents images to an X window through shared memory (MIT-SHM). Not used on X
 * servers with DRI3, through which drivers share images. Uses a separate X connection, so that
 * GLFW's requests and replies are not disturbed. */
#ifndef FIRN_VIEW_WINDOW_X11_SHM_H
#define FIRN_VIEW_WINDOW_X11_SHM_H

#include "src/gpu/gpu_shared_window.h"

struct GLFWwindow;
struct window_x11_shm;

/* Connects to the X server. Returns NULL, without a message, if there is no X11, or if the server
 * has DRI3 or cannot read shared memory. The result must outlive its swapchains, not the window. */
struct window_x11_shm *window_x11_shm_open(struct GLFWwindow *window);
void window_x11_shm_close(struct window_x11_shm *canvas); /* may be NULL */

/* Returns the shared-memory window for gpu_swapchain_init(); NULL if `canvas` is NULL. */
const struct gpu_shared_window *window_x11_shm_canvas(const struct window_x11_shm *canvas);

#endif
