/* glfw_x11_workarounds.h: X11 background colour, gravity, pixels and error handling, which GLFW
 * lacks. */
#ifndef FIRN_VIEW_WINDOW_GLFW_X11_WORKAROUNDS_H
#define FIRN_VIEW_WINDOW_GLFW_X11_WORKAROUNDS_H

#include <stdint.h>

struct GLFWwindow;

/* Sets the colour of newly exposed areas, 0xRRGGBB. Also keeps the old contents in place while the
 * window is resized. */
void window_x11_background(struct GLFWwindow *window, uint32_t color);

/* Shows pixels, 0xRRGGBB, at (x, y) in the window, over what was presented, until something is
 * presented again. Does nothing where GLFW does not use X11. */
void window_x11_show(struct GLFWwindow *window, int x, int y, const uint32_t *pixels,
                     uint32_t width, uint32_t height);

/* Makes X errors no longer end the program. Xlib's default handler exits, for instance if the
 * source window of a drag and drop is gone. Call this before each event poll, because GLFW 3.3
 * sometimes restores the old handler. */
void window_x11_ignore_errors(void);

#endif
