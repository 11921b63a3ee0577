/* window_background.c: GLFW's windows have neither a background nor a gravity under X11, so new
 * area shows what the window manager draws there: often white. Libraries are asked for what they
 * have, since GLFW may be built without X11. */
#include "src/view/window_background.h"
#ifdef WINDOW_X11
#include <X11/Xlib.h>
#include <dlfcn.h>
#include <stddef.h>

typedef Display *get_display_fn(void);
typedef Window get_window_fn(struct GLFWwindow *window);
typedef int change_fn(Display *, Window, unsigned long, XSetWindowAttributes *);

/* A pointer to a function, which C keeps apart from others. */
union symbol {
    void *address;
    get_display_fn *get_display;
    get_window_fn *get_window;
    change_fn *change;
};

void window_background(struct GLFWwindow *window, uint32_t color)
{
    void *program = dlopen(NULL, RTLD_LAZY);
    void *x11 = dlopen("libX11.so.6", RTLD_LAZY);
    const union symbol get_display = { program ? dlsym(program, "glfwGetX11Display") : NULL };
    const union symbol get_window = { program ? dlsym(program, "glfwGetX11Window") : NULL };
    const union symbol change = { x11 ? dlsym(x11, "XChangeWindowAttributes") : NULL };
    if (get_display.get_display && get_window.get_window && change.change) {
        Display *display = get_display.get_display();
        XSetWindowAttributes wanted = { .background_pixel = color,
                                        .bit_gravity = NorthWestGravity };
        if (display)
            change.change(display, get_window.get_window(window), CWBackPixel | CWBitGravity,
                          &wanted);
    }
    if (x11)
        dlclose(x11);
    if (program)
        dlclose(program);
}
#else
void window_background(struct GLFWwindow *window, uint32_t color)
{
    (void)window;
    (void)color;
}
#endif
