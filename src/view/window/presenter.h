/*
 * presenter.h: presents an image in a window: swapchain, render-graph plan, frames in flight.
 *
 *     presenter_fit()      at the start of a frame: recreates the swapchain if the size changed
 *     presenter_connect()  after that, and when the source image is another one
 *     presenter_begin()    waits for a free slot and acquires a swapchain image
 *     ... render the source image ...
 *     presenter_end()      draws it into the swapchain image and presents it
 *
 * Errors: logged once where found.
 */
#ifndef FIRN_VIEW_WINDOW_PRESENTER_H
#define FIRN_VIEW_WINDOW_PRESENTER_H

#include "graph/rg_exec.h"
#include "graph/rg_profile.h"
#include "src/gpu/gpu_swapchain.h"
#include "src/view/window/overlay_draw_list.h"
#include "src/view/window/present_pass.h"
#include "src/view/window/ui_overlay.h"

struct presenter_images {
    VkImage left, right;
    VkExtent2D extent, right_extent;
};

struct presenter {
    struct gpu *gpu;
    struct gpu_swapchain swapchain;
    rg_replace_shader_fn *replace; /* set before presenter_connect(); may be NULL */
    void *replace_user;
    VkExtent2D size; /* window size of the swapchain */
    struct present_tables tables;
    struct overlay_tables overlay;
    uint32_t panels_version;        /* cached draw-list version; 0 if none */
    const struct gpu_image *font;   /* font atlas; NULL without user interface */
    struct presenter_images images; /* source images, while connected */
    struct rg_plan *plan;
    struct rg_exec *exec; /* NULL if not connected */
    uint32_t slot, index; /* acquired by presenter_begin() */
    double wait_seconds;  /* seconds the host waited to acquire and present this frame's image */
};

/* Initialises a presenter, which must not be moved. Borrows `surface`. */
MUST_USE enum status presenter_init(struct presenter *s, struct gpu *gpu, VkSurfaceKHR surface,
                                    VkPresentModeKHR mode);
void presenter_finish(struct presenter *s); /* {0} and half-built are fine */

/* Recreates the swapchain if it is stale or `size` has changed. If *remade becomes true, call
 * presenter_connect() next. If swapchain.stale stays true, nothing can be presented. */
MUST_USE enum status presenter_fit(struct presenter *s, VkExtent2D size, bool *remade);

/* Sets the user interface's font atlas (may be NULL). presenter_connect() must follow. */
void presenter_set_font(struct presenter *s, const struct gpu_image *font);

/* Sets the images to present, which must be ready for sampling. If the view is not split, `right`
 * must equal `left`. Must not be called between presenter_begin() and presenter_end(). */
MUST_USE enum status presenter_connect(struct presenter *s, const struct presenter_images *images);

/* Waits for the frames in flight and releases the images. */
void presenter_disconnect(struct presenter *s);

/* Acquires a swapchain image. If *ready is false, call presenter_fit() and try again. */
MUST_USE enum status presenter_begin(struct presenter *s, bool *ready);

/* Draws and presents a frame. The draw list frame->overlay indexes the buffers overlay_vertices and
 * overlay_indices. Members of `frame` that are declared after `overlay` need not be set. */
MUST_USE enum status presenter_end(struct presenter *s, const struct window_frame *frame);

/* Waits until no frame reads the source images. */
MUST_USE enum status presenter_wait(struct presenter *s);

#endif
