/*
 * window.h: a window of the desktop, and what hands do in it. The one place that knows GLFW.
 *
 * Errors: logged, one line, with GLFW's words: STATUS_NO_DEVICE.
 */
#ifndef FIRN_VIEW_WINDOW_H
#define FIRN_VIEW_WINDOW_H

#include "src/gpu/gpu.h"
#include "src/view/keys.h"

struct GLFWcursor;
struct GLFWwindow;

enum {
    WINDOW_ACTION_COUNT = 32, /* between two looks; more are lost */
};

/* In heights of the window, right and down. */
struct window_drag {
    double x, y;
};

/* What happened since it was looked at last. */
struct window_input {
    struct window_drag turn, pan;  /* of the camera */
    struct window_drag light, sun; /* with Ctrl all light, with Ctrl and Shift the sun alone */
    double wheel;                  /* steps, away from the hand */
    bool slid;                     /* the divider is now somewhere else: */
    double divider;
    enum view_action actions[WINDOW_ACTION_COUNT];
    uint32_t action_count;
    bool redraw;            /* what is shown may be gone */
    bool pressed, released; /* a button of the mouse */
    double moved_at;    /* when a hand first moved the picture, clock_seconds(); 0: it did not */
    double released_at; /* when it let go */
    bool doubled;       /* the left one, twice, at: */
    double at_x, at_y;  /* pixels */
};

enum window_event_kind {
    WINDOW_CURSOR,
    WINDOW_BUTTON,
    WINDOW_WHEEL,
    WINDOW_KEY,
    WINDOW_CHARACTER,
};

/* One thing that hands did, as it comes. */
struct window_event {
    enum window_event_kind kind;
    double x, y;              /* of the cursor, pixels; of the wheel, steps */
    int code;                 /* button or key, as GLFW names them, or character */
    bool down;                /* of a button or key */
    bool control, shift, alt; /* of a key */
};

/* Hears of everything first. True: keeps it to itself; it moves no camera and is no action. */
typedef bool window_listen_fn(void *user, const struct window_event *event);

struct window {
    struct GLFWwindow *handle;
    window_listen_fn *listen; /* may be NULL */
    void *listener;
    bool has_library; /* GLFW is up */
    struct window_input input;
    char *dropped;             /* path of a file, malloc'd; NULL: none */
    double cursor_x, cursor_y; /* where it was seen last, screen coordinates */
    VkRect2D view;             /* where the picture is, pixels */
    double divider; /* that a hand can take, of its width, from its left; below 0: none */
    bool slides;    /* a hand has it */
    double pressed_at, pressed_x, pressed_y; /* the left button, when and where, to find a pair */
    struct GLFWcursor *slider; /* what the mouse looks like there; NULL: never was there */
    bool repeated;             /* the key that is being handled is held down */
    VkExtent2D framebuffer;    /* pixels, also while it is: */
    bool minimised;
    int left, top, width, height; /* before it filled the screen */
};

/* The size of a window, pixels, where all is `scale` times as large as usual and there is so much
 * room (0x0: not known). */
typedef VkExtent2D window_fit_fn(void *user, float scale, VkExtent2D room);

struct window_params {
    window_fit_fn *fit;
    void *user;
    const char *title;
    uint32_t background; /* where nothing has been drawn, 0xRRGGBB */
};

/* Shows it at once, empty, with a framebuffer of this size if the desktop allows it. It must not
 * move afterwards. */
MUST_USE enum status window_init(struct window *window, const struct window_params *params);

void window_set_background(struct window *window, uint32_t color);

/* {0} and half-built are fine. */
void window_finish(struct window *window);

/* Pixels of a desktop's unit: 2 where all is twice as large. */
float window_scale(const struct window *window);

/* Into the clipboard, where it stays at least as long as the window. */
void window_copy(struct window *window, const char *text);

void window_title(struct window *window, const char *title);

void window_hide(struct window *window);

/* Handles what has happened; or waits until something happens, at most so many seconds. */
void window_poll(struct window *window);
void window_wait(struct window *window, double seconds);

/* Ends window_wait(); from any thread. */
void window_wake(void);

/* From now on somebody hears of everything first, and at once of where the cursor is: it may rest
 * there since before the window was. */
void window_tell(struct window *window, window_listen_fn *hear, void *listener);

/* Returns what has happened, and forgets it. */
struct window_input window_take(struct window *window);

/* The file dropped last, which the caller frees; NULL: none. Forgets it. */
char *window_take_dropped(struct window *window);

bool window_is_closed(const struct window *window); /* the user wants it so */

/* Pixels; 0x0 while it is minimised. */
VkExtent2D window_size(const struct window *window);

void window_fill_screen(struct window *window); /* or not any more */

/* For gpu_create(), as long as the window is there. */
MUST_USE enum status window_system(const struct window *window, struct gpu_window_system *system);
MUST_USE enum status window_surface(const struct window *window, const struct gpu *gpu,
                                    VkSurfaceKHR *surface);

#endif
