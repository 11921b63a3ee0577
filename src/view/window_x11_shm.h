/* window_x11_shm.h: presents images to an X window through shared memory (MIT-SHM), only on X
 * servers without DRI3, because drivers use DRI3 to share images. It opens an X connection of its
 * own, so that it does not interfere with GLFW's requests and replies. */
#ifndef FIRN_VIEW_WINDOW_X11_SHM_H
#define FIRN_VIEW_WINDOW_X11_SHM_H

#include "src/gpu/gpu_host_memory_images.h"

struct GLFWwindow;
struct window_x11_shm;

/* Connects to the X server. Returns NULL, without a message, if there is no X11 or the server has
 * DRI3 or cannot read shared memory. Must outlive swapchains that use it, but not the window. */
struct window_x11_shm *window_x11_shm_open(struct GLFWwindow *window);
void window_x11_shm_close(struct window_x11_shm *canvas); /* may be NULL */

/* Returns the shared window to give to a swapchain; NULL if `canvas` is NULL. */
const struct gpu_shared_window *window_x11_shm_canvas(const struct window_x11_shm *canvas);

#endif
