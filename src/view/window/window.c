/* window.c: platform window on GLFW: creation, input events, full screen, Vulkan surface. */
#define GLFW_INCLUDE_NONE
#include "src/view/window/window.h"
#include <GLFW/glfw3.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/clock.h"
#include "src/base/log.h"
#include "src/view/window/glfw_x11_workarounds.h"

static const double divider_reach = 8.0;        /* pixels; maximum distance from the divider */
static const double double_click_seconds = 0.4; /* maximum time between both clicks */
static const double double_click_reach = 5.0;   /* maximum distance, screen coordinates */

static enum status failed(const char *what)
{
    const char *why = NULL;
    glfwGetError(&why);
    log_error("%s: %s (firn render works without a window)", what, why ? why : "unknown reason");
    return STATUS_NO_DEVICE;
}

static bool notify(struct window *w, const struct window_event *event)
{
    return w->listen && w->listen(w->listener, event);
}

static void add_action(struct window *w, enum view_action action)
{
    if (action == VIEW_QUIT)
        glfwSetWindowShouldClose(w->handle, GLFW_TRUE); /* also ends a job of the worker thread */
    else if (action != VIEW_ACTION_NONE && w->input.action_count < WINDOW_ACTION_COUNT)
        w->input.actions[w->input.action_count++] = action;
}

/* Returns the character that a key types without modifiers on this keyboard layout. While Ctrl is
 * held, GLFW reports no characters. */
static unsigned typed_character(int key, int code)
{
    const char *name = glfwGetKeyName(key, code);
    return name && name[0] && !name[1] ? (unsigned char)name[0] : 0;
}

static void on_key(GLFWwindow *handle, int key, int code, int event, int modifiers)
{
    struct window *w = glfwGetWindowUserPointer(handle);
    const struct window_event notice = {
        .kind = WINDOW_KEY,
        .code = key,
        .down = event != GLFW_RELEASE,
        .control = modifiers & GLFW_MOD_CONTROL,
        .shift = modifiers & GLFW_MOD_SHIFT,
        .alt = modifiers & GLFW_MOD_ALT,
    };
    w->repeated = event == GLFW_REPEAT;
    const struct key_press press = {
        .key = key == GLFW_KEY_UNKNOWN ? 0 : key,
        .character = notice.control ? typed_character(key, code) : 0,
        .repeated = w->repeated,
        .control = notice.control,
        .shift = notice.shift,
    };
    if (!notify(w, &notice) && notice.down)
        add_action(w, key_bindings_find(&press));
}

static void on_character(GLFWwindow *handle, unsigned character)
{
    struct window *w = glfwGetWindowUserPointer(handle);
    const struct window_event notice = { .kind = WINDOW_CHARACTER, .code = (int)character };
    if (!notify(w, &notice))
        add_action(w, key_bindings_find(
                          &(struct key_press){ .character = character, .repeated = w->repeated }));
}

static bool is_down(GLFWwindow *handle, int button)
{
    return glfwGetMouseButton(handle, button) == GLFW_PRESS;
}

static bool holds(GLFWwindow *handle, int left, int right)
{
    return glfwGetKey(handle, left) == GLFW_PRESS || glfwGetKey(handle, right) == GLFW_PRESS;
}

/* Returns the drag to which mouse movement is added, given the button, Ctrl and Shift. */
static struct window_drag *current_drag(struct window *w)
{
    const bool shift = holds(w->handle, GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT);
    const bool left = is_down(w->handle, GLFW_MOUSE_BUTTON_LEFT);
    if (left && holds(w->handle, GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL))
        return shift ? &w->input.sun : &w->input.light;
    return left && !shift ? &w->input.orbit : &w->input.pan;
}

/* Converts an x coordinate of the window to a fraction of the image width. */
static double fraction_of_view(const struct window *w, double x)
{
    int width;
    int height;
    glfwGetWindowSize(w->handle, &width, &height);
    const double pixels = width > 0 ? x * window_size(w).width / width : 0.0;
    return w->image_area.extent.width
               ? (pixels - w->image_area.offset.x) / w->image_area.extent.width
               : 0.0;
}

static bool is_near_divider(const struct window *w, double x)
{
    const double distance = fabs(fraction_of_view(w, x) - w->divider) * w->image_area.extent.width;
    return w->divider >= 0.0 && distance <= divider_reach;
}

/* Detects double clicks: two presses close to each other in time and position. */
static void detect_double_click(struct window *w)
{
    const double now = glfwGetTime();
    const double distance = hypot(w->cursor_x - w->pressed_x, w->cursor_y - w->pressed_y);
    const bool is_double =
        now - w->pressed_at < double_click_seconds && distance < double_click_reach;
    int width;
    int height;
    glfwGetWindowSize(w->handle, &width, &height);
    const double pixels = width > 0 ? (double)window_size(w).width / width : 1.0;
    w->pressed_at = is_double ? 0.0 : now;
    w->pressed_x = w->cursor_x;
    w->pressed_y = w->cursor_y;
    if (!is_double)
        return;
    w->input.double_clicked = true;
    w->input.click_x = w->cursor_x * pixels;
    w->input.click_y = w->cursor_y * pixels;
}

static void on_button(GLFWwindow *handle, int button, int event, int modifiers)
{
    struct window *w = glfwGetWindowUserPointer(handle);
    const struct window_event notice = {
        .kind = WINDOW_BUTTON,
        .code = button,
        .down = event == GLFW_PRESS,
    };
    (void)modifiers;
    const bool consumed = notify(w, &notice);
    w->input.pressed = w->input.pressed || notice.down;
    w->input.released = w->input.released || !notice.down;
    if (!notice.down)
        w->input.released_at = clock_seconds();
    if (button == GLFW_MOUSE_BUTTON_LEFT)
        w->drags_divider = !consumed && notice.down && is_near_divider(w, w->cursor_x);
    if (button == GLFW_MOUSE_BUTTON_LEFT && !consumed && notice.down && !w->drags_divider)
        detect_double_click(w);
}

/* Moves the divider while it is dragged, and changes the cursor shape near it. */
static void drag_divider(struct window *w, double x)
{
    const bool shown = w->drags_divider || is_near_divider(w, x);
    if (shown && !w->divider_cursor)
        w->divider_cursor = glfwCreateStandardCursor(GLFW_HRESIZE_CURSOR);
    if (w->divider_cursor)
        glfwSetCursor(w->handle, shown ? w->divider_cursor : NULL);
    if (!w->drags_divider)
        return;
    w->input.moved_divider = true;
    w->input.divider = fmin(fmax(fraction_of_view(w, x), 0.0), 1.0);
}

static void on_cursor(GLFWwindow *handle, double x, double y)
{
    struct window *w = glfwGetWindowUserPointer(handle);
    int width;
    int height;
    glfwGetWindowSize(handle, &width, &height);
    const double scale = height > 0 ? 1.0 / height : 0.0;
    const double dx = (x - w->cursor_x) * scale;
    const double dy = (y - w->cursor_y) * scale;
    const bool held = (is_down(handle, GLFW_MOUSE_BUTTON_LEFT) && !w->drags_divider) ||
                      is_down(handle, GLFW_MOUSE_BUTTON_RIGHT) ||
                      is_down(handle, GLFW_MOUSE_BUTTON_MIDDLE);
    w->cursor_x = x; /* glfwGetCursorPos() may already report a later position */
    w->cursor_y = y;
    const double pixels = scale * window_size(w).height;
    if (notify(w, &(struct window_event){ WINDOW_CURSOR, x * pixels, y * pixels }))
        return;
    drag_divider(w, x);
    if (!held)
        return;
    if (hypot(x - w->pressed_x, y - w->pressed_y) >= double_click_reach)
        w->pressed_at = 0.0; /* a dragged press cannot start a double click */
    if (!(w->input.moved_at > 0.0))
        w->input.moved_at = clock_seconds();
    current_drag(w)->x += dx;
    current_drag(w)->y += dy;
}

static void on_wheel(GLFWwindow *handle, double x, double y)
{
    struct window *w = glfwGetWindowUserPointer(handle);
    if (!notify(w, &(struct window_event){ WINDOW_WHEEL, x, y }))
        w->input.wheel += y;
}

/* Keeps only the first dropped file, because the viewer opens one file at a time. */
static void on_drop(GLFWwindow *handle, int count, const char **paths)
{
    struct window *w = glfwGetWindowUserPointer(handle);
    if (count < 1)
        return;
    free(w->dropped);
    w->dropped = strdup(paths[0]);
    if (!w->dropped)
        log_error("out of memory");
    if (count > 1)
        log_warning("%d files were dropped on the window, but only the first is opened: %s", count,
                    paths[0]);
}

static void on_refresh(GLFWwindow *handle)
{
    struct window *w = glfwGetWindowUserPointer(handle);
    w->input.redraw = true;
}

static void on_resize(GLFWwindow *handle, int width, int height)
{
    struct window *w = glfwGetWindowUserPointer(handle);
    const bool sound = width > 0 && height > 0;
    w->framebuffer = (VkExtent2D){ sound ? (uint32_t)width : 0, sound ? (uint32_t)height : 0 };
    on_refresh(handle);
}

static void on_minimise(GLFWwindow *handle, int minimised)
{
    struct window *w = glfwGetWindowUserPointer(handle);
    w->minimised = minimised;
    on_refresh(handle);
}

/* Queries the window size from the window system. This is too slow for every frame, because the
 * reply comes only after all earlier requests are processed. */
static void query_size(struct window *w)
{
    int width;
    int height;
    glfwGetFramebufferSize(w->handle, &width, &height);
    on_resize(w->handle, width, height);
    w->minimised = glfwGetWindowAttrib(w->handle, GLFW_ICONIFIED);
}

static void listen(struct window *w)
{
    glfwSetWindowUserPointer(w->handle, w);
    glfwSetKeyCallback(w->handle, on_key);
    glfwSetCharCallback(w->handle, on_character);
    glfwSetCursorPosCallback(w->handle, on_cursor);
    glfwSetMouseButtonCallback(w->handle, on_button);
    glfwSetScrollCallback(w->handle, on_wheel);
    glfwSetDropCallback(w->handle, on_drop);
    glfwSetFramebufferSizeCallback(w->handle, on_resize);
    glfwSetWindowIconifyCallback(w->handle, on_minimise);
    glfwSetWindowRefreshCallback(w->handle, on_refresh);
}

/* Resizes the window to a framebuffer size. Screen coordinates may be coarser than pixels. */
static void fit_framebuffer(struct window *w, uint32_t width, uint32_t height)
{
    const VkExtent2D size = window_size(w);
    if (size.width == 0 || size.height == 0 || (size.width == width && size.height == height))
        return;
    int window_width;
    int window_height;
    glfwGetWindowSize(w->handle, &window_width, &window_height);
    glfwSetWindowSize(w->handle, (int)((double)width * window_width / size.width + 0.5),
                      (int)((double)height * window_height / size.height + 0.5));
}

/* Returns a monitor's area without the desktop's panels and docks; 0x0 if unknown. */
static VkExtent2D find_work_area(GLFWmonitor *monitor)
{
    int work_area[4] = { 0 };
    if (monitor)
        glfwGetMonitorWorkarea(monitor, &work_area[0], &work_area[1], &work_area[2], &work_area[3]);
    const bool known = work_area[2] > 0 && work_area[3] > 0;
    return (VkExtent2D){ known ? (uint32_t)work_area[2] : 0, known ? (uint32_t)work_area[3] : 0 };
}

static VkExtent2D choose_size(const struct window_params *params, VkExtent2D room)
{
    GLFWmonitor *monitor = glfwGetPrimaryMonitor();
    float scale[2] = { 1.0f, 1.0f };
    if (monitor)
        glfwGetMonitorContentScale(monitor, &scale[0], &scale[1]);
    return params->fit(params->user, fmaxf(scale[0], scale[1]), room);
}

/* Subtracts the sizes of title bar and borders, which are known before the window is shown. */
static VkExtent2D without_frame(struct window *w, VkExtent2D room)
{
    int left, top, right, bottom;
    glfwGetWindowFrameSize(w->handle, &left, &top, &right, &bottom);
    const uint32_t width = (uint32_t)(left + right);
    const uint32_t height = (uint32_t)(top + bottom);
    return room.width > width && room.height > height
               ? (VkExtent2D){ room.width - width, room.height - height }
               : room;
}

/* Connects to the window system. Requests X11 if there is no Wayland session, because GLFW 3.4
 * would otherwise also try Wayland, and the Wayland library would print an error. */
static bool connect_system(void)
{
#ifdef GLFW_PLATFORM
    if (!getenv("WAYLAND_DISPLAY"))
        glfwInitHint(GLFW_PLATFORM, GLFW_PLATFORM_X11);
#endif
    return glfwInit();
}

enum status window_init(struct window *w, const struct window_params *params)
{
    *w = (struct window){ .divider = -1.0 };
    if (!connect_system())
        return failed("cannot connect to a window system");
    w->is_initialised = true;
    if (!glfwVulkanSupported())
        return failed("cannot use Vulkan with windows");
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    glfwWindowHint(GLFW_AUTO_ICONIFY, GLFW_FALSE); /* full screen stays without focus */
    glfwWindowHintString(GLFW_X11_CLASS_NAME, "firn");
    glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
    const VkExtent2D room = find_work_area(glfwGetPrimaryMonitor());
    VkExtent2D size = choose_size(params, room);
    w->handle = glfwCreateWindow((int)size.width, (int)size.height, params->title, NULL, NULL);
    if (!w->handle)
        return failed("cannot open a window");
    window_set_background(w, params->background);
    listen(w);
    query_size(w);
    size = choose_size(params, without_frame(w, room));
    fit_framebuffer(w, size.width, size.height);
    glfwShowWindow(w->handle);
    glfwPollEvents();
    query_size(w);
    return STATUS_OK;
}

void window_set_background(struct window *w, uint32_t color)
{
    window_x11_background(w->handle, color);
}

void window_finish(struct window *w)
{
    if (w->handle)
        glfwDestroyWindow(w->handle);
    if (w->is_initialised)
        glfwTerminate();
    free(w->dropped);
    *w = (struct window){ 0 };
}

float window_scale(const struct window *w)
{
    float x;
    float y;
    glfwGetWindowContentScale(w->handle, &x, &y);
    return x > y ? x : y;
}

void window_copy(struct window *w, const char *text)
{
    glfwSetClipboardString(w->handle, text);
}

void window_title(struct window *w, const char *title)
{
    glfwSetWindowTitle(w->handle, title);
    glfwPollEvents();
}

void window_show_pixels(struct window *w, VkRect2D area, const uint32_t *pixels, VkExtent2D size)
{
    const int x = area.offset.x + ((int)area.extent.width - (int)size.width) / 2;
    const int y = area.offset.y + ((int)area.extent.height - (int)size.height) / 2;
    window_x11_show(w->handle, x, y, pixels, size.width, size.height);
}

void window_hide(struct window *w)
{
    glfwHideWindow(w->handle);
}

void window_poll(struct window *w)
{
    (void)w;
    window_x11_ignore_errors();
    glfwPollEvents();
}

void window_wait(struct window *w, double seconds)
{
    (void)w;
    window_x11_ignore_errors();
    glfwWaitEventsTimeout(seconds);
}

void window_wake(void)
{
    glfwPostEmptyEvent();
}

void window_set_listener(struct window *w, window_listen_fn *function, void *listener)
{
    double x;
    double y;
    glfwGetCursorPos(w->handle, &x, &y);
    w->listen = function;
    w->listener = listener;
    on_cursor(w->handle, x, y);
}

struct window_input window_take_input(struct window *w)
{
    const struct window_input input = w->input;
    w->input = (struct window_input){ 0 };
    return input;
}

char *window_take_dropped(struct window *w)
{
    char *path = w->dropped;
    w->dropped = NULL;
    return path;
}

bool window_is_closed(const struct window *w)
{
    return glfwWindowShouldClose(w->handle);
}

VkExtent2D window_size(const struct window *w)
{
    return w->minimised ? (VkExtent2D){ 0, 0 } : w->framebuffer;
}

void window_toggle_fullscreen(struct window *w)
{
    GLFWmonitor *monitor = glfwGetPrimaryMonitor();
    const GLFWvidmode *mode = monitor ? glfwGetVideoMode(monitor) : NULL;
    if (glfwGetWindowMonitor(w->handle)) {
        glfwSetWindowMonitor(w->handle, NULL, w->left, w->top, w->width, w->height, GLFW_DONT_CARE);
    } else if (mode) {
        glfwGetWindowPos(w->handle, &w->left, &w->top);
        glfwGetWindowSize(w->handle, &w->width, &w->height);
        glfwSetWindowMonitor(w->handle, monitor, 0, 0, mode->width, mode->height,
                             mode->refreshRate);
    }
}

static bool can_present(VkInstance instance, VkPhysicalDevice physical, uint32_t queue_family)
{
    return glfwGetPhysicalDevicePresentationSupport(instance, physical, queue_family);
}

enum status window_system(const struct window *w, struct gpu_window_system *system)
{
    (void)w;
    uint32_t count = 0;
    const char **extensions = glfwGetRequiredInstanceExtensions(&count);
    *system = (struct gpu_window_system){ (const char *const *)extensions, count, can_present };
    return extensions ? STATUS_OK : failed("cannot use Vulkan with windows");
}

enum status window_surface(const struct window *w, const struct gpu *gpu, VkSurfaceKHR *surface)
{
    const VkResult result = glfwCreateWindowSurface(gpu->instance, w->handle, NULL, surface);
    if (result == VK_SUCCESS)
        return STATUS_OK;
    *surface = VK_NULL_HANDLE;
    return failed("cannot create a Vulkan surface for the window");
}
