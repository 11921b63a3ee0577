/* view_progressive.c: progressive refinement: fast interactive frames, then samples. */
#include "src/view/view_progressive.h"
#include <cglm/struct.h>
#include <math.h>
#include <string.h>
#include "src/base/clock.h"
#include "src/render/weighted_mean.h"
#include "src/view/view_internal.h"
#include "src/view/window/worker_thread.h"

static const double rest_seconds = 0.12;  /* rest before sampling starts, seconds */
static const double show_seconds = 0.25;  /* interval between displayed means, seconds */
static const double part_seconds = 0.015; /* duration of a part of a sample, seconds */
static const double soon_seconds = 0.15; /* seconds per sample above which a draft is shown first */
static const double draft_share = 1.0 / 3.0; /* greatest time of that draft, relative to a sample */

enum {
    FIRST_COUNT = 8, /* up to this sample count, the image is shown only after 2^n samples */
};

static struct view_identity current_identity(const struct view *v, float time)
{
    const struct viewport *p = v->viewport;
    return (struct view_identity){ p->version, p->camera, time, p->state.scene.settings };
}

static bool differ(float a, float b)
{
    return a < b || a > b;
}

static bool refines(const struct view *v)
{
    return v->viewport && v->viewport->is_progressive && v->viewport->renderer &&
           !(v->resize_at > 0.0);
}

bool view_progressive_is_same(const struct view_identity *a, const struct view_identity *b)
{
    const struct settings settings = viewport_with_exposure(&a->settings, &b->settings);
    return a->renderer_version == b->renderer_version && camera_is_equal(&a->camera, &b->camera) &&
           !differ(a->time, b->time) && settings_equal(&settings, &b->settings);
}

/* Returns true if the samples of a view can be shown at the exposure of another. */
static bool has_same_weights(const struct view_identity *a, const struct view_identity *b)
{
    return !differ(weighted_mean_scale(&a->settings), weighted_mean_scale(&b->settings));
}

/* Returns true if the view is unchanged except for an exposure that changes no sample's weight. */
static bool is_same(const struct view *v, const struct view_identity *now)
{
    const struct view_identity *drawn = &v->progressive.identity;
    return v->progressive.has_identity && view_progressive_is_same(drawn, now) &&
           has_same_weights(drawn, now);
}

static bool has_other_exposure(const struct view *v)
{
    return !settings_equal(&v->progressive.identity.settings, &v->viewport->state.scene.settings);
}

static bool has_current_samples(const struct view *v)
{
    const struct view_identity now = current_identity(v, view_time(v));
    return is_same(v, &now);
}

double view_progressive_wait(const struct view *v)
{
    const struct view_progressive *r = &v->progressive;
    if (refines(v) && r->has_identity && r->is_resolving)
        return 0.0;
    if (!refines(v) || !r->has_identity || r->count >= r->target_count || r->is_stopped)
        return -1.0;
    const double left = r->moved_at + rest_seconds - clock_seconds();
    return r->skips_rest || left < 0.0 ? 0.0 : left;
}

double view_progressive_seconds_left(const struct view *v)
{
    const struct view_progressive *r = &v->progressive;
    const double taken = clock_seconds() - r->begun_at;
    return r->count && r->count < r->target_count ? taken * (r->target_count - r->count) / r->count
                                                  : 0.0;
}

void view_progressive_stop(struct view *v)
{
    struct view_progressive *r = &v->progressive;
    if (r->is_stopped || !r->has_identity || r->count >= r->target_count) {
        if (r->is_stopped)
            ui_show_message(v->ui, "drawing continues");
        r->is_stopped = false;
        return;
    }
    r->is_stopped = true;
    ui_show_message(v->ui, "drawing stopped; Esc continues");
}

bool view_progressive_is_first(const struct view *v)
{
    const struct view_progressive *r = &v->progressive;
    return r->has_identity && !r->shown_count && (r->count || r->is_partial);
}

static bool is_to_be_shown(const struct view_progressive *r)
{
    if (r->count >= r->target_count)
        return true;
    return r->count <= FIRST_COUNT ? !(r->count & (r->count - 1))
                                   : clock_seconds() > r->shown_at + show_seconds;
}

/* Does the next step towards showing the mean of the samples. */
static enum status resolve_step(struct view *v)
{
    struct view_progressive *r = &v->progressive;
    const uint32_t step = r->resolve_step++;
    const bool is_last = r->resolve_step == RENDERER_RESOLVE_STEPS;
    /* frames in flight may still read the image that the last step overwrites */
    enum status status = is_last ? presenter_wait(&v->presenter) : STATUS_OK;
    if (status == STATUS_OK)
        status = viewport_resolve(v->viewport, r->count, step);
    r->is_resolving = !is_last && status == STATUS_OK;
    if (!is_last)
        return status;
    r->identity.settings = v->viewport->state.scene.settings;
    r->shown_count = r->count;
    v->inspector.sample_count = 0; /* invalidates the inspector's image */
    r->shown_at = clock_seconds();
    v->changed = true; /* display the new mean */
    return status;
}

static enum status resolve(struct view *v)
{
    enum status status;
    v->progressive.resolve_step = 0;
    do
        status = resolve_step(v);
    while (v->progressive.is_resolving);
    return status;
}

static struct renderer_shot current_shot(const struct view *v)
{
    return (struct renderer_shot){ .camera = v->progressive.identity.camera,
                                   .time = v->progressive.identity.time };
}

static enum status make_draft(void *user)
{
    struct view *v = user;
    const struct renderer_shot shot = current_shot(v);
    return viewport_create_draft(v->viewport, &shot);
}

/* Returns true if the full renderers are fast enough for interaction, judged by the last frame. */
static bool is_fluid(const struct viewport *p)
{
    struct dynamic_resolution resolution;
    dynamic_resolution_begin(&resolution, viewport_pass_seconds(p));
    return resolution.passes > 0.0 && resolution.k == DYNAMIC_RESOLUTION_MAX;
}

static enum status begin_draft(struct view *v)
{
    const double start = clock_seconds();
    const struct viewport *p = v->viewport;
    const enum status status = worker_run(&v->window, make_draft, v);
    if (p->draft.left)
        dynamic_resolution_begin(&v->progressive.dynamic_resolution, 4.0 * p->draft.seconds);
    view_frame_stats_exclude(&v->frame_stats, start);
    return status;
}

enum status view_progressive_begin(struct view *v)
{
    struct viewport *p = v->viewport;
    if (!viewport_wants_draft(p))
        return STATUS_OK;
    const enum status status = viewport_wait(p);
    return status == STATUS_OK && !is_fluid(p) ? begin_draft(v) : status;
}

/* Draws a full-size draft, which is shown until the first sample is finished. */
static enum status draw_full_draft(struct view *v)
{
    const struct renderer_shot shot = current_shot(v);
    const struct setup_image *p = &v->viewport->state;
    enum status status = presenter_wait(&v->presenter);
    if (status == STATUS_OK)
        status = viewport_draw_interactive(v->viewport, &shot, (VkExtent2D){ p->width, p->height });
    v->progressive.has_full_draft = v->changed = true;
    return status;
}

static enum status rebuild(void *user)
{
    struct view *v = user;
    return viewport_rebuild(v->viewport);
}

/* Returns true if a full-size draft would postpone the first sample by more than it is worth: the
 * sample is short, or takes hardly longer than the draft. */
static bool is_sample_soon(const struct view_progressive *r)
{
    const double draft = r->dynamic_resolution.passes + r->dynamic_resolution.rest;
    return r->sample_seconds > 0.0 &&
           (r->sample_seconds <= soon_seconds || r->sample_seconds * draft_share < draft);
}

/* Does one preparation before the next sample, for example creates the draft renderers or draws a
 * full-size draft. Sets *drew to false if there is nothing to prepare. */
static enum status prepare(struct view *v, bool *drew)
{
    struct view_progressive *r = &v->progressive;
    struct viewport *p = v->viewport;
    *drew = true;
    if (r->count == 1 && p->draft.left && is_fluid(p)) {
        presenter_disconnect(&v->presenter); /* frames in flight may show a draft */
        draft_renderer_finish(&p->draft);
    }
    if (r->count == 1 && viewport_wants_draft(p) && !is_fluid(p))
        return begin_draft(v);
    if (!r->count && viewport_is_outgrown(p)) {
        presenter_disconnect(&v->presenter);
        v->changed = true; /* the new renderers start from the first sample */
        return worker_run(&v->window, rebuild, v);
    }
    if (!r->count && !r->has_full_draft && p->shows_draft && !is_sample_soon(r))
        return draw_full_draft(v);
    *drew = false;
    return STATUS_OK;
}

/* Returns the duration of a part of a sample. The shown image must not be drawn while the window
 * shows it, so the first sample is drawn at once unless a draft is shown. */
static double part_duration(const struct viewport *p)
{
    return p->shows_draft || p->shows_mean ? part_seconds : HUGE_VAL;
}

static enum status draw_part(struct view *v)
{
    struct view_progressive *r = &v->progressive;
    const double start = clock_seconds();
    const struct renderer_shot shot = current_shot(v);
    const bool is_first = !r->is_partial;
    bool is_done = false;
    enum status status = is_first && !r->count ? presenter_wait(&v->presenter) : STATUS_OK;
    if (status == STATUS_OK)
        status =
            viewport_refine(v->viewport, &shot, r->count, part_duration(v->viewport), &is_done);
    r->begun_at = is_first && !r->count ? start : r->begun_at;
    r->sample_begun_at = is_first ? start : r->sample_begun_at;
    r->is_partial = !is_done;
    if (is_first && !r->count)
        ui_wake(v->ui); /* for the text on progress */
    if (is_done) {
        r->count++;
        r->sample_seconds = clock_seconds() - r->sample_begun_at;
        r->is_resolving = is_to_be_shown(r);
        r->resolve_step = 0;
    }
    view_frame_stats_exclude(&v->frame_stats, start);
    return status;
}

enum status view_progressive_step(struct view *v, bool *drew)
{
    const double wait = view_progressive_wait(v);
    const bool is_due = wait >= 0.0 && !(wait > 0.0);
    *drew = false;
    if (!refines(v) || !has_current_samples(v) || (wait > 0.0))
        return STATUS_OK;
    if (v->progressive.is_resolving) {
        *drew = v->progressive.drew_part = true;
        return resolve_step(v);
    }
    const bool prepares = !v->progressive.is_partial && !v->progressive.is_stopped;
    const enum status status = prepares ? prepare(v, drew) : STATUS_OK;
    if (status != STATUS_OK || *drew || !is_due)
        return status;
    *drew = v->progressive.drew_part = true;
    return draw_part(v);
}

enum status view_progressive_draw(struct view *v, const struct renderer_shot *shot)
{
    struct view_progressive *r = &v->progressive;
    const struct viewport *p = v->viewport;
    const struct view_identity now = current_identity(v, shot->time);
    v->redrawn = false;
    if (is_same(v, &now))
        return r->count && has_other_exposure(v) ? resolve(v) : STATUS_OK;
    if (!r->dynamic_resolution.k)
        dynamic_resolution_begin(&r->dynamic_resolution,
                                 p->draft.left ? 4.0 * p->draft.seconds : 0.0);
    const bool first = !r->has_identity;
    const uint32_t k = p->draft.is_off ? DYNAMIC_RESOLUTION_MAX : r->dynamic_resolution.k;
    const VkExtent2D view = { dynamic_resolution_scale(p->state.width, k),
                              dynamic_resolution_scale(p->state.height, k) };
    const bool other = view.width != p->extent.width || view.height != p->extent.height;
    enum status status = other ? presenter_wait(&v->presenter) : STATUS_OK;
    if (status == STATUS_OK)
        status = viewport_draw_interactive(v->viewport, shot, view);
    r->identity = now;
    r->has_identity = true;
    r->count = r->shown_count = 0;
    r->has_full_draft = r->is_partial = r->is_resolving = r->is_stopped = false;
    r->moved_at = first ? 0.0 : clock_seconds();
    v->redrawn = true;
    return status;
}
