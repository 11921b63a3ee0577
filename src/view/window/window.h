/*
 * window.h: platform window on GLFW: creation, input events, full screen, Vulkan surface. Only
 * window.c and glfw_x11_workarounds.c call GLFW. Functions that fail log GLFW's description and
 * return STATUS_NO_DEVICE.
 */
#ifndef FIRN_VIEW_WINDOW_WINDOW_H
#define FIRN_VIEW_WINDOW_WINDOW_H

#include "src/gpu/gpu.h"
#include "src/view/key_bindings.h"

struct GLFWcursor;
struct GLFWwindow;

enum {
    WINDOW_ACTION_COUNT = 32, /* maximum between two calls of window_take_input() */
};

/* Distance of a mouse drag to the right and down, in window heights. */
struct window_drag {
    double x, y;
};

/* Input accumulated since the last window_take_input(). */
struct window_input {
    struct window_drag orbit, pan; /* orbit and pan of the camera */
    struct window_drag light, sun; /* Ctrl drag; Ctrl Shift drag */
    double wheel;                  /* steps; positive away from the user */
    bool moved_divider;            /* the divider was dragged to `divider` */
    double divider;
    enum view_action actions[WINDOW_ACTION_COUNT];
    uint32_t action_count;
    bool redraw;             /* the window's contents may be damaged */
    bool pressed, released;  /* by any mouse button */
    double moved_at;         /* time of a drag's first movement, in seconds; 0 if none */
    double released_at;      /* release of a mouse button, clock_seconds() */
    bool double_clicked;     /* left button, at (click_x, click_y) */
    double click_x, click_y; /* position of the double click, pixels */
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
    int code;                 /* GLFW code, or Unicode character */
    bool down;                /* pressed rather than released */
    bool control, shift, alt; /* modifiers held with a key */
};

/* Callback for every event. Returns true to hide the event from the viewer. */
typedef bool window_listen_fn(void *user, const struct window_event *event);

/* Callback while a job runs on the worker thread, about ten times a second. `seconds` is the time
 * since the job started. It must not use the device. */
typedef void window_busy_fn(void *user, double seconds);

struct window {
    struct GLFWwindow *handle;
    window_listen_fn *listen; /* may be NULL */
    void *listener;
    window_busy_fn *show_busy; /* may be NULL */
    void (*end)(void *user);   /* called with `busy_user` if the window is closed during a job */
    void *busy_user;
    bool is_initialised; /* GLFW is initialised */
    struct window_input input;
    char *dropped;             /* path of a dropped file, malloc'd; NULL if none */
    double cursor_x, cursor_y; /* last cursor position, screen coordinates */
    VkRect2D image_area;       /* area of the image, pixels */
    double divider;     /* divider position as a fraction of the image width; negative if none */
    bool drags_divider; /* the divider is being dragged */
    double pressed_at, pressed_x, pressed_y; /* last press, to detect double clicks */
    struct GLFWcursor *divider_cursor;       /* cursor shape; NULL until needed */
    bool repeated;                           /* key event is an auto-repeat */
    VkExtent2D framebuffer;                  /* size in pixels, kept while minimised */
    bool minimised;
    int left, top, width, height; /* rectangle to restore after full screen */
};

/* Callback that returns the window size in pixels. `scale` is the scale of the user interface.
 * `room` is the work area of the desktop, in pixels; 0x0 if unknown. */
typedef VkExtent2D window_fit_fn(void *user, float scale, VkExtent2D room);

struct window_params {
    window_fit_fn *fit;
    void *user;
    const char *title;
    uint32_t background; /* colour of undrawn areas, 0xRRGGBB */
};

/* Opens the window and shows it empty at once. `fit` chooses the framebuffer size; the desktop may
 * override this size. *window must not be moved afterwards. */
MUST_USE enum status window_init(struct window *window, const struct window_params *params);

void window_set_background(struct window *window, uint32_t color);

/* Closes the window. *window may be zeroed or partly initialised. */
void window_finish(struct window *window);

/* Returns the desktop's content scale. At 2, everything is drawn twice as large. */
float window_scale(const struct window *window);

/* Copies text to the clipboard. The text stays there at least until the window is closed. */
void window_copy(struct window *window, const char *text);

void window_title(struct window *window, const char *title);

/* Shows pixels, 0xRRGGBB, in the middle of a part of the window until the next frame. X11 only. */
void window_show_pixels(struct window *window, VkRect2D area, const uint32_t *pixels,
                        VkExtent2D size);

void window_hide(struct window *window);

/* Handles pending events without waiting. */
void window_poll(struct window *window);
void window_wait(struct window *window, double seconds); /* waits up to `seconds` for events */

/* Makes window_wait() return; may be called from any thread. */
void window_wake(void);

/* Sets the event listener and immediately sends it the current cursor position. */
void window_set_listener(struct window *window, window_listen_fn *function, void *listener);

/* Returns the accumulated input and clears it. */
struct window_input window_take_input(struct window *window);

/* Takes the path of the last dropped file; NULL if there is none. The caller frees the path. */
char *window_take_dropped(struct window *window);

/* Returns true once the user has requested to close the window. */
bool window_is_closed(const struct window *window);

/* Returns the framebuffer size in pixels; 0x0 while minimised. */
VkExtent2D window_size(const struct window *window);

void window_toggle_fullscreen(struct window *window);

/* Returns the extensions and callbacks for gpu_create(). They are valid until window_finish(). */
MUST_USE enum status window_system(const struct window *window, struct gpu_window_system *system);
MUST_USE enum status window_surface(const struct window *window, const struct gpu *gpu,
                                    VkSurfaceKHR *surface);

#endif
