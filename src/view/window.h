/*
 * window.h: platform window on GLFW: creation, input events, full screen, Vulkan surface. Only
 * window.c and window_x11.c call GLFW functions.
 *
 * Errors: logged on one line with GLFW's description; STATUS_NO_DEVICE.
 */
#ifndef FIRN_VIEW_WINDOW_H
#define FIRN_VIEW_WINDOW_H

#include "src/gpu/gpu.h"
#include "src/view/key_bindings.h"

struct GLFWcursor;
struct GLFWwindow;

enum {
    WINDOW_ACTION_COUNT = 32, /* maximum between two calls of window_take_input() */
};

/* Mouse drag in fractions of the window height, right and down. */
struct window_drag {
    double x, y;
};

/* Input accumulated since the last window_take_input(). */
struct window_input {
    struct window_drag turn, pan;  /* orbit and pan of the camera */
    struct window_drag light, sun; /* of all light (Ctrl drag) and of the sun (Ctrl Shift drag) */
    double wheel;                  /* steps; positive away from the user */
    bool slid;                     /* the divider was dragged to `divider` */
    double divider;
    enum view_action actions[WINDOW_ACTION_COUNT];
    uint32_t action_count;
    bool redraw;            /* the window's contents may be damaged */
    bool pressed, released; /* a mouse button was pressed or released */
    double moved_at;    /* first mouse movement that moved the image, clock_seconds(); 0 if none */
    double released_at; /* release of a mouse button, clock_seconds() */
    bool doubled;       /* double click of the left button at (at_x, at_y) */
    double at_x, at_y;  /* position of the double click, pixels */
};

enum window_event_kind {
    WINDOW_CURSOR,
    WINDOW_BUTTON,
    WINDOW_WHEEL,
    WINDOW_KEY,
    WINDOW_CHARACTER,
};

/* An input event, passed to the listener in order. */
struct window_event {
    enum window_event_kind kind;
    double x, y;              /* cursor position, pixels; wheel movement, steps */
    int code;                 /* GLFW button or key code, or Unicode character */
    bool down;                /* pressed rather than released */
    bool control, shift, alt; /* modifiers held with a key */
};

/* Listener that gets events first. Returns true to consume an event, so that it moves no camera and
 * triggers no action. */
typedef bool window_listen_fn(void *user, const struct window_event *event);

struct window {
    struct GLFWwindow *handle;
    window_listen_fn *listen; /* may be NULL */
    void *listener;
    bool has_library; /* GLFW is initialised */
    struct window_input input;
    char *dropped;             /* path of a dropped file, malloc'd; NULL if none */
    double cursor_x, cursor_y; /* last cursor position, screen coordinates */
    VkRect2D view;             /* area of the image, pixels */
    double divider; /* position as a fraction of the image width; negative without a divider */
    bool slides;    /* the divider is being dragged */
    double pressed_at, pressed_x, pressed_y; /* last press, to detect double clicks */
    struct GLFWcursor *slider;               /* cursor shape near the divider; NULL until needed */
    bool repeated;                           /* the current key event is an auto-repeat */
    VkExtent2D framebuffer;                  /* size in pixels, kept while minimised */
    bool minimised;
    int left, top, width, height; /* window rectangle to restore after full screen */
};

/* Chooses the window size in pixels for a user interface `scale` and an available work area `room`
 * (0x0 if not known). */
typedef VkExtent2D window_fit_fn(void *user, float scale, VkExtent2D room);

struct window_params {
    window_fit_fn *fit;
    void *user;
    const char *title;
    uint32_t background; /* colour of undrawn areas, 0xRRGGBB */
};

/* Opens the window and shows it empty at once; `fit` chooses its framebuffer size, which the
 * desktop may change. *window must not move afterwards. */
MUST_USE enum status window_init(struct window *window, const struct window_params *params);

void window_set_background(struct window *window, uint32_t color);

/* Closes the window; {0} and half-initialised ones are fine. */
void window_finish(struct window *window);

/* Returns the desktop's content scale: 2 if everything is drawn twice as large. */
float window_scale(const struct window *window);

/* Copies text to the clipboard, where it stays at least as long as the window exists. */
void window_copy(struct window *window, const char *text);

void window_title(struct window *window, const char *title);

void window_hide(struct window *window);

/* window_poll() handles pending events; window_wait() waits for events for at most `seconds`. */
void window_poll(struct window *window);
void window_wait(struct window *window, double seconds);

/* Ends window_wait(); may be called from any thread. */
void window_wake(void);

/* Sets the listener that gets all events first. It immediately gets the current cursor position, as
 * the cursor may not move for a while. */
void window_set_listener(struct window *window, window_listen_fn *hear, void *listener);

/* Returns the accumulated input and clears it. */
struct window_input window_take_input(struct window *window);

/* Returns the last dropped file and forgets it; the caller frees the path. NULL if there is none.
 */
char *window_take_dropped(struct window *window);

/* true once the user has requested to close it */
bool window_is_closed(const struct window *window);

/* Returns the framebuffer size in pixels; 0x0 while minimised. */
VkExtent2D window_size(const struct window *window);

void window_toggle_fullscreen(struct window *window); /* toggles full screen */

/* Returns the extensions and callbacks that gpu_create() needs; valid while the window exists. */
MUST_USE enum status window_system(const struct window *window, struct gpu_window_system *system);
MUST_USE enum status window_surface(const struct window *window, const struct gpu *gpu,
                                    VkSurfaceKHR *surface);

#endif
