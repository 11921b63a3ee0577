/* clipboard_copy_png.h: copies PNG images to the desktop's clipboard. GLFW supports only text. */
#ifndef FIRN_VIEW_WINDOW_CLIPBOARD_COPY_PNG_H
#define FIRN_VIEW_WINDOW_CLIPBOARD_COPY_PNG_H

#include <stdbool.h>

/* Copies a PNG file to the clipboard. The program wl-copy (Wayland) or xclip (X11) keeps running to
 * serve paste requests. Returns false, without logging, if the program is missing or fails. */
bool clipboard_copy_png(const char *path);

#endif
