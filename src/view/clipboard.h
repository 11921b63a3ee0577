/* clipboard.h: copies PNG images to the desktop's clipboard, as GLFW supports only text. */
#ifndef FIRN_VIEW_CLIPBOARD_H
#define FIRN_VIEW_CLIPBOARD_H

#include <stdbool.h>

/* Passes a PNG file to wl-copy (Wayland) or xclip (X11), which keeps running to serve paste
 * requests. Returns false, without logging, if the program is not installed or fails. */
bool clipboard_copy_png(const char *path);

#endif
