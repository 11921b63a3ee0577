/* glfw_x11_workarounds.h: X11 background colour, gravity and error handling, which GLFW lacks. */
#ifndef FIRN_VIEW_WINDOW_GLFW_X11_WORKAROUNDS_H
#define FIRN_VIEW_WINDOW_GLFW_X11_WORKAROUNDS_H

#include <stdint.h>

struct GLFWwindow;

/* Sets the colour of newly exposed areas, 0xRRGGBB. Also keeps the old contents in place while the
 * window is resized. */
void window_x11_background(struct GLFWwindow *window, uint32_t color);

/* Makes X errors no longer end the program. Xlib's default handler exits, for instance if the
 * source window of a drag and drop is gone. Call this before each event poll, because GLFW 3.3
 * sometimes restores the old handler. */
void window_x11_ignore_errors(void);

#endif
