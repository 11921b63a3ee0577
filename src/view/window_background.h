/*
 * window_background.h: what a window shows where nothing has been drawn yet.
 */
#ifndef FIRN_VIEW_WINDOW_BACKGROUND_H
#define FIRN_VIEW_WINDOW_BACKGROUND_H

#include <stdint.h>

struct GLFWwindow;

/* Fills new area of a window with a colour, 0xRRGGBB, and keeps what is in the old area while it is
 * resized. Without X11 nothing happens. */
void window_background(struct GLFWwindow *window, uint32_t color);

#endif
