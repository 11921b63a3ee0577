/*
 * window_x11.h: what GLFW leaves undone under X11. Without X11 nothing happens.
 */
#ifndef FIRN_VIEW_WINDOW_X11_H
#define FIRN_VIEW_WINDOW_X11_H

#include <stdint.h>

struct GLFWwindow;

/* Returns the number of a window; 0 without X11. */
uint32_t window_x11_id(struct GLFWwindow *window);

/* Fills new area of a window with a colour, 0xRRGGBB, and keeps what is in the old area while it is
 * resized. */
void window_x11_background(struct GLFWwindow *window, uint32_t color);

/*
 * Lets the program go on after a request that the X server refuses: as a rule Xlib ends it, for
 * instance where what is dropped comes from a window that is gone when GLFW answers it. What is
 * refused for another reason is logged. GLFW 3.3 takes this back now and then, so it is called
 * before events are handled.
 */
void window_x11_go_on(void);

#endif
