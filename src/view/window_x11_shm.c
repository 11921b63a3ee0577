/* window_x11_shm.c: presents through System V shared memory attached to the X server (MIT-SHM). */
#include "src/view/window_x11_shm.h"
#ifdef WINDOW_CANVAS
#include <stdlib.h>
#include <string.h>
#include <sys/ipc.h>
#include <sys/shm.h>
#include <xcb/shm.h>
#include <xcb/xcb.h>
#include "src/view/glfw_x11_workarounds.h"

struct segment {
    void *memory; /* NULL if not allocated */
    xcb_shm_seg_t id;
    /* request that the server answers after reading the image */
    xcb_get_input_focus_cookie_t read;
    bool is_shown;
};

struct window_x11_shm {
    struct gpu_shared_window canvas;
    xcb_connection_t *x;
    xcb_window_t window;
    xcb_gcontext_t context;
    uint8_t depth;
    struct segment segments[GPU_SHARED_WINDOW_IMAGE_COUNT];
};

static void *map(void *user, uint32_t index, size_t size)
{
    struct window_x11_shm *c = user;
    struct segment *s = &c->segments[index];
    const int number = shmget(IPC_PRIVATE, size, IPC_CREAT | 0600);
    void *memory = number < 0 ? (void *)-1 : shmat(number, NULL, 0);
    bool is_attached = false;
    if (memory != (void *)-1) {
        s->id = xcb_generate_id(c->x);
        xcb_generic_error_t *error =
            xcb_request_check(c->x, xcb_shm_attach_checked(c->x, s->id, (uint32_t)number, true));
        is_attached = !error && !xcb_connection_has_error(c->x);
        free(error);
    }
    if (number >= 0)
        shmctl(number, IPC_RMID, NULL); /* mark the segment for deletion after the last detach */
    if (memory != (void *)-1 && !is_attached)
        shmdt(memory);
    s->memory = is_attached ? memory : NULL;
    return s->memory;
}

/* Discards queued errors and events, because X sends some events to every client. */
static void forget_events(struct window_x11_shm *c)
{
    xcb_generic_event_t *event;
    while ((event = xcb_poll_for_queued_event(c->x)))
        free(event);
}

static void wait(void *user, uint32_t index)
{
    struct window_x11_shm *c = user;
    struct segment *s = &c->segments[index];
    if (s->is_shown)
        free(xcb_get_input_focus_reply(c->x, s->read, NULL));
    s->is_shown = false;
    forget_events(c);
}

static void unmap(void *user, uint32_t index)
{
    struct window_x11_shm *c = user;
    struct segment *s = &c->segments[index];
    if (!s->memory)
        return;
    wait(user, index);
    xcb_shm_detach(c->x, s->id);
    xcb_flush(c->x);
    shmdt(s->memory);
    s->memory = NULL;
}

static void show(void *user, uint32_t index, VkExtent2D extent, uint32_t row_size)
{
    struct window_x11_shm *c = user;
    struct segment *s = &c->segments[index];
    const uint16_t width = (uint16_t)extent.width, height = (uint16_t)extent.height;
    xcb_shm_put_image(c->x, c->window, c->context, (uint16_t)(row_size / 4), height, 0, 0, width,
                      height, 0, 0, c->depth, XCB_IMAGE_FORMAT_Z_PIXMAP, false, s->id, 0);
    s->read = xcb_get_input_focus(c->x);
    s->is_shown = true;
    xcb_flush(c->x);
}

static bool has_extension(xcb_connection_t *x, const char *name)
{
    xcb_query_extension_reply_t *reply =
        xcb_query_extension_reply(x, xcb_query_extension(x, (uint16_t)strlen(name), name), NULL);
    const bool is_there = reply && reply->present;
    free(reply);
    return is_there;
}

/* Returns the visual with this id; NULL if the screen does not have it. */
static const xcb_visualtype_t *find_visual(const xcb_screen_t *screen, xcb_visualid_t visual_id)
{
    xcb_depth_iterator_t depth = xcb_screen_allowed_depths_iterator(screen);
    for (; depth.rem; xcb_depth_next(&depth)) {
        xcb_visualtype_iterator_t visual = xcb_depth_visuals_iterator(depth.data);
        for (; visual.rem; xcb_visualtype_next(&visual)) {
            if (visual.data->visual_id == visual_id)
                return visual.data;
        }
    }
    return NULL;
}

/* Returns true if the bytes of a pixel are in the order blue, green, red, unused. */
static bool is_blue_first(const xcb_setup_t *setup, xcb_visualid_t visual_id)
{
    const xcb_visualtype_t *visual = NULL;
    xcb_screen_iterator_t screen = xcb_setup_roots_iterator(setup);
    for (; screen.rem && !visual; xcb_screen_next(&screen))
        visual = find_visual(screen.data, visual_id);
    return setup->image_byte_order == XCB_IMAGE_ORDER_LSB_FIRST && visual &&
           visual->red_mask == 0xff0000 && visual->green_mask == 0xff00 &&
           visual->blue_mask == 0xff;
}

static bool has_four_bytes(const xcb_setup_t *setup, uint8_t depth)
{
    xcb_format_iterator_t format = xcb_setup_pixmap_formats_iterator(setup);
    for (; format.rem; xcb_format_next(&format)) {
        if (format.data->depth == depth)
            return format.data->bits_per_pixel == 32;
    }
    return false;
}

static bool fits(struct window_x11_shm *c)
{
    const xcb_setup_t *setup = xcb_get_setup(c->x);
    if (xcb_connection_has_error(c->x) || has_extension(c->x, "DRI3") ||
        !has_extension(c->x, "MIT-SHM"))
        return false;
    xcb_get_window_attributes_reply_t *attributes =
        xcb_get_window_attributes_reply(c->x, xcb_get_window_attributes(c->x, c->window), NULL);
    xcb_get_geometry_reply_t *geometry =
        xcb_get_geometry_reply(c->x, xcb_get_geometry(c->x, c->window), NULL);
    const bool fits = attributes && geometry && is_blue_first(setup, attributes->visual) &&
                      has_four_bytes(setup, geometry->depth);
    c->depth = geometry ? geometry->depth : 0;
    free(attributes);
    free(geometry);
    return fits;
}

struct window_x11_shm *window_x11_shm_open(struct GLFWwindow *window)
{
    const uint32_t id = window_x11_id(window);
    struct window_x11_shm *c = id ? calloc(1, sizeof(*c)) : NULL;
    if (!c)
        return NULL;
    c->canvas = (struct gpu_shared_window){ c, map, unmap, show, wait };
    c->window = id;
    c->x = xcb_connect(NULL, NULL);
    if (!fits(c)) {
        window_x11_shm_close(c);
        return NULL;
    }
    c->context = xcb_generate_id(c->x);
    xcb_create_gc(c->x, c->context, c->window, 0, NULL);
    return c;
}

void window_x11_shm_close(struct window_x11_shm *c)
{
    if (!c)
        return;
    xcb_disconnect(c->x);
    free(c);
}

const struct gpu_shared_window *window_x11_shm_canvas(const struct window_x11_shm *c)
{
    return c ? &c->canvas : NULL;
}
#else
struct window_x11_shm *window_x11_shm_open(struct GLFWwindow *window)
{
    (void)window;
    return NULL;
}

void window_x11_shm_close(struct window_x11_shm *canvas)
{
    (void)canvas;
}

const struct gpu_shared_window *window_x11_shm_canvas(const struct window_x11_shm *canvas)
{
    (void)canvas;
    return NULL;
}
#endif
