/* window_layout.c: computes the rectangles of image, toolbar, timeline and panels. */
#include "src/view/window/window_layout.h"

static const float bar_height = 36.0f; /* all lengths are pixels at scale 1 */
static const float status_height = 26.0f;
static const float strip_height = 30.0f;
static const float timeline_window_height = 560.0f; /* minimum window height with a timeline */

/* Widths of the side panel: wider windows get a wider panel. */
static const struct {
    float window, panel; /* minimum window width; panel width */
} widths[] = {
    { 1300.0f, 340.0f },
    { 900.0f, 300.0f },
    { 0.0f, 250.0f },
};

enum {
    WIDTH_COUNT = sizeof(widths) / sizeof(widths[0]),
};

static uint32_t pixels(float length, float scale)
{
    return (uint32_t)(length * scale + 0.5f);
}

static uint32_t panel_width(uint32_t window, float scale)
{
    uint32_t i = 0;
    while (i + 1 < WIDTH_COUNT && window < pixels(widths[i].window, scale))
        i++;
    const uint32_t width = pixels(widths[i].panel, scale);
    return width < window / 2 ? width : window / 2;
}

static VkRect2D rectangle(uint32_t x, uint32_t y, uint32_t width, uint32_t height)
{
    return (VkRect2D){ { (int32_t)x, (int32_t)y }, { width, height } };
}

struct window_layout window_layout_of(VkExtent2D window, float scale, bool has_panels)
{
    const uint32_t bar = pixels(bar_height, scale);
    const uint32_t status = pixels(status_height, scale);
    const uint32_t width = panel_width(window.width, scale);
    struct window_layout l = { .image = rectangle(0, 0, window.width, window.height) };
    if (!has_panels || width < 2 || window.height < 2 * (bar + status))
        return l;
    const uint32_t left = window.width - width;
    const uint32_t body = window.height - status;
    const uint32_t strip =
        window.height < pixels(timeline_window_height, scale) ? 0 : pixels(strip_height, scale);
    l.bar = rectangle(0, 0, left, bar);
    l.image = rectangle(0, bar, left, body - bar - strip);
    l.strip = rectangle(0, body - strip, left, strip);
    l.panel = rectangle(left, 0, width, body);
    l.status = rectangle(0, body, window.width, status);
    return l;
}

VkExtent2D window_layout_for_image(VkExtent2D image, float scale)
{
    const uint32_t more = pixels(bar_height, scale) + pixels(status_height, scale);
    VkExtent2D window = { 0, image.height + more };
    const uint32_t strip = pixels(strip_height, scale);
    window.height += window.height + strip < pixels(timeline_window_height, scale) ? 0 : strip;
    for (uint32_t i = 0; i < WIDTH_COUNT; i++) {
        window.width = image.width + pixels(widths[i].panel, scale);
        if (panel_width(window.width, scale) + image.width == window.width)
            return window;
    }
    window.width = 2 * image.width; /* in a narrow window the panel takes half of the width */
    return window;
}
