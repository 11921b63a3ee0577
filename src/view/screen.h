/*
 * screen.h: brings a picture of the device into a window: swapchain, plan, frames in flight.
 *
 *     screen_fit()      when a frame begins: the swapchain fits the window
 *     screen_connect()  after that, and when the picture is another image
 *     screen_begin()    waits for room
 *     ... draw the picture ...
 *     screen_end()      copies it and shows it
 *
 * Errors: logged once where found.
 */
#ifndef FIRN_VIEW_SCREEN_H
#define FIRN_VIEW_SCREEN_H

#include "graph/rg_exec.h"
#include "graph/rg_time.h"
#include "src/gpu/gpu_swapchain.h"
#include "src/view/overlay.h"
#include "src/view/overlay_list.h"
#include "src/view/present.h"

struct screen_picture {
    VkImage left, right;
    VkExtent2D extent, right_extent;
};

struct screen {
    struct gpu *gpu;
    struct gpu_swapchain swapchain;
    rg_replace_shader_fn *replace; /* of rg_exec.h, set before screen_connect(); NULL: nothing */
    void *replace_user;
    VkExtent2D size; /* of the window, that it was made for */
    struct present_tables tables;
    struct overlay_tables overlay;
    uint32_t panels_version;      /* of the list in overlay.panels; 0: none */
    const struct gpu_image *font; /* of what lies over the picture; NULL: nothing */
    struct screen_picture shown;  /* while it is connected */
    struct rg_plan *plan;
    struct rg_exec *exec; /* NULL: not connected */
    uint32_t slot, index; /* of the frame and image taken by screen_begin() */
    double waited; /* by the host in that frame: for its image, and to have it shown; seconds */
};

/* Must not move afterwards. Surface and canvas, which may be NULL, are the caller's. */
MUST_USE enum status screen_init(struct screen *screen, struct gpu *gpu, VkSurfaceKHR surface,
                                 VkPresentModeKHR mode, const struct gpu_canvas *canvas);
void screen_finish(struct screen *screen); /* {0} and half-built are fine */

/* Makes the swapchain anew if it does not fit a window of this size; *remade says so. Afterwards
 * the screen is not connected. If swapchain.stale is still true, nothing can be shown. */
MUST_USE enum status screen_fit(struct screen *screen, VkExtent2D size, bool *remade);

/* What is drawn with this font lies over the picture from now on; NULL: nothing does. Afterwards
 * the screen is not connected. */
void screen_lay_over(struct screen *screen, const struct gpu_image *font);

/* Shows a picture, ready to be sampled, from now on; and where a line is drawn, another one right
 * of it (without one, the same), as large as the first. Not between screen_begin() and
 * screen_end(). */
MUST_USE enum status screen_connect(struct screen *screen, const struct screen_picture *picture);

/* Waits for its frames and forgets the picture. */
void screen_disconnect(struct screen *screen);

/* *ready is false if there is no image: fit it and begin again. */
MUST_USE enum status screen_begin(struct screen *screen, bool *ready);

/* `overlay` of the frame, with the screen's buffers overlay_vertices and overlay_indices, is what
 * lies over the picture; its right_columns and right_rows are the screen's. */
MUST_USE enum status screen_end(struct screen *screen, const struct window_frame *shown);

/* Until no frame reads the picture any more. */
MUST_USE enum status screen_wait(struct screen *screen);

/* ---- for other plans of the same kind ---- */

struct rg_exec_params screen_exec_params(const struct gpu *gpu, const struct rg_plan *plan);
MUST_USE enum status screen_report_faults(const struct rg_plan *plan); /* logs them */

#endif
