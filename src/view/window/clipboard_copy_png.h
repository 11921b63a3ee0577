/* clipboard_copy_png.h: copies PNG images to the desktop's clipboard. GLFW supports only text. */
#ifndef FIRN_VIEW_WINDOW_CLIPBOARD_COPY_PNG_H
#define FIRN_VIEW_WINDOW_CLIPBOARD_COPY_PNG_H

#include <stdbool.h>

/* Copies a PNG file to the clipboard through wl-copy (Wayland) or xclip (X11). The program keeps
 * running to serve paste requests. If it fails or is missing, returns false without logging. */
bool clipboard_copy_png(const char *path);

#endif
