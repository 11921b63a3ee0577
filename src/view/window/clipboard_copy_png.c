/* clipboard_copy_png.c: copies a PNG file to the clipboard through wl-copy or xclip. */
#include "src/view/window/clipboard_copy_png.h"
#include <errno.h>
#include <fcntl.h>
#include <stddef.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

/* Replaces this child process by wl-copy or xclip, which reads the image from descriptor `png`. */
__attribute__((noreturn)) static void become_owner(int png, int nothing)
{
    const bool ready = dup2(png, STDIN_FILENO) >= 0 && dup2(nothing, STDOUT_FILENO) >= 0 &&
                       dup2(nothing, STDERR_FILENO) >= 0;
    if (ready && getenv("WAYLAND_DISPLAY"))
        execlp("wl-copy", "wl-copy", "--type", "image/png", NULL);
    if (ready)
        execlp("xclip", "xclip", "-selection", "clipboard", "-t", "image/png", NULL);
    _exit(EXIT_FAILURE);
}

bool clipboard_copy_png(const char *path)
{
    int how = -1;
    const int png = open(path, O_RDONLY | O_CLOEXEC);
    const int nothing = open("/dev/null", O_RDWR | O_CLOEXEC);
    const pid_t child = png >= 0 && nothing >= 0 ? fork() : -1;
    if (child == 0)
        become_owner(png, nothing);
    while (child > 0 && waitpid(child, &how, 0) < 0 && errno == EINTR)
        continue;
    if (png >= 0)
        close(png);
    if (nothing >= 0)
        close(nothing);
    return child > 0 && WIFEXITED(how) && WEXITSTATUS(how) == EXIT_SUCCESS;
}
