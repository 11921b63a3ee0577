/* clipboard.h: pictures in the desktop's clipboard, of which GLFW knows only text. */
#ifndef FIRN_VIEW_CLIPBOARD_H
#define FIRN_VIEW_CLIPBOARD_H

#include <stdbool.h>

/* Gives a PNG file's data to wl-copy (under Wayland) or xclip, which keeps them for others. False:
 * the program is not installed, or fails; not logged. */
bool clipboard_copy_png(const char *path);

#endif
