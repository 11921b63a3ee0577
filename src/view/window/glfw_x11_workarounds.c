/* glfw_x11_workarounds.c: sets background and gravity of GLFW's X11 windows, and handles X errors.
 * Without a background, newly exposed areas flash in the window manager's colour. X11 functions are
 * looked up at run time, because GLFW may be built without X11. */
#include "src/view/window/glfw_x11_workarounds.h"
#ifdef WINDOW_X11
#include <X11/Xlib.h>
#include <dlfcn.h>
#include <stddef.h>
#include "src/base/log.h"

typedef Display *get_display_fn(void);
typedef Window get_window_fn(struct GLFWwindow *window);
typedef int change_fn(Display *, Window, unsigned long, XSetWindowAttributes *);
typedef GC create_gc_fn(Display *, Drawable, unsigned long, XGCValues *);
typedef int free_gc_fn(Display *, GC);
typedef int put_fn(Display *, Drawable, GC, XImage *, int, int, int, int, unsigned, unsigned);
typedef int flush_fn(Display *);
typedef Status init_fn(XImage *);
typedef Status geometry_fn(Display *, Drawable, Window *, int *, int *, unsigned *, unsigned *,
                           unsigned *, unsigned *);
typedef XErrorHandler set_handler_fn(XErrorHandler handler);

/* Conversion of object pointers to function pointers. ISO C does not allow a cast for that. */
union symbol {
    void *address;
    get_display_fn *get_display;
    get_window_fn *get_window;
    change_fn *change;
    set_handler_fn *set_handler;
    create_gc_fn *create_gc;
    free_gc_fn *free_gc;
    put_fn *put;
    flush_fn *flush;
    init_fn *init;
    geometry_fn *geometry;
};

/* Returns GLFW's X display and the window's id. Returns NULL and 0 if GLFW does not use X11. */
static Display *find(struct GLFWwindow *window, Window *id)
{
    void *program = dlopen(NULL, RTLD_LAZY);
    const union symbol get_display = { program ? dlsym(program, "glfwGetX11Display") : NULL };
    const union symbol get_window = { program ? dlsym(program, "glfwGetX11Window") : NULL };
    Display *display = get_display.get_display ? get_display.get_display() : NULL;
    *id = display && get_window.get_window ? get_window.get_window(window) : 0;
    if (program)
        dlclose(program);
    return display;
}

void window_x11_background(struct GLFWwindow *window, uint32_t color)
{
    void *x11 = dlopen("libX11.so.6", RTLD_LAZY);
    const union symbol change = { x11 ? dlsym(x11, "XChangeWindowAttributes") : NULL };
    XSetWindowAttributes requested = { .background_pixel = color, .bit_gravity = NorthWestGravity };
    Window id;
    Display *display = find(window, &id);
    if (id && change.change)
        change.change(display, id, CWBackPixel | CWBitGravity, &requested);
    if (x11)
        dlclose(x11);
}

/* Returns the depth of a window, bits; 0 if it is not known. */
static unsigned depth_of(void *x11, Display *display, Window id)
{
    const union symbol geometry = { dlsym(x11, "XGetGeometry") };
    Window root;
    int at[2];
    unsigned size[3];
    unsigned depth = 0;
    if (id && geometry.geometry)
        geometry.geometry(display, id, &root, &at[0], &at[1], &size[0], &size[1], &size[2], &depth);
    return depth;
}

static void put(void *x11, Display *display, Window id, XImage *image, int x, int y)
{
    const union symbol create_gc = { dlsym(x11, "XCreateGC") };
    const union symbol free_gc = { dlsym(x11, "XFreeGC") };
    const union symbol put_image = { dlsym(x11, "XPutImage") };
    const union symbol flush = { dlsym(x11, "XFlush") };
    const union symbol init = { dlsym(x11, "XInitImage") };
    if (!create_gc.create_gc || !free_gc.free_gc || !put_image.put || !flush.flush || !init.init ||
        !init.init(image))
        return;
    GC gc = create_gc.create_gc(display, id, 0, NULL);
    put_image.put(display, id, gc, image, 0, 0, x, y, (unsigned)image->width,
                  (unsigned)image->height);
    free_gc.free_gc(display, gc);
    flush.flush(display);
}

void window_x11_show(struct GLFWwindow *window, int x, int y, const uint32_t *pixels,
                     uint32_t width, uint32_t height)
{
    static const uint32_t one = 1;
    void *x11 = dlopen("libX11.so.6", RTLD_LAZY);
    const int order = *(const char *)&one == 1 ? LSBFirst : MSBFirst;
    Window id;
    Display *display = find(window, &id);

    union {
        const uint32_t *in;
        char *out;
    } data = { pixels };

    XImage image = {
        .width = (int)width,
        .height = (int)height,
        .format = ZPixmap,
        .data = data.out, /* is only read */
        .byte_order = order,
        .bitmap_unit = 32,
        .bitmap_bit_order = order,
        .bitmap_pad = 32,
        .depth = x11 ? (int)depth_of(x11, display, id) : 0,
        .bits_per_pixel = 32,
    };
    if (image.depth == 24 || image.depth == 32) /* others have another format of pixels */
        put(x11, display, id, &image, x, y);
    if (x11)
        dlclose(x11);
}

/* Logs X errors other than BadWindow. An X error handler must not call Xlib functions. */
static int handle_error(Display *display, XErrorEvent *event)
{
    (void)display;
    if (event->error_code != BadWindow)
        log_warning("the X server refused request %d with error %d", event->request_code,
                    event->error_code);
    return 0;
}

void window_x11_ignore_errors(void)
{
    void *x11 = dlopen("libX11.so.6", RTLD_LAZY | RTLD_NOLOAD); /* loaded only if GLFW uses X11 */
    const union symbol set = { x11 ? dlsym(x11, "XSetErrorHandler") : NULL };
    if (set.set_handler)
        set.set_handler(handle_error);
    if (x11)
        dlclose(x11);
}
#else
void window_x11_background(struct GLFWwindow *window, uint32_t color)
{
    (void)window;
    (void)color;
}

void window_x11_show(struct GLFWwindow *window, int x, int y, const uint32_t *pixels,
                     uint32_t width, uint32_t height)
{
    (void)window;
    (void)x;
    (void)y;
    (void)pixels;
    (void)width;
    (void)height;
}

void window_x11_ignore_errors(void)
{
}
#endif
