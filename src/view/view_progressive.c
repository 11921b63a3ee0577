/* view_progressive.c: progressive refinement: fast frames during interaction, then sample by
 * sample. */
#include "src/view/view_progressive.h"
#include <cglm/struct.h>
#include <string.h>
#include "src/base/clock.h"
#include "src/view/view_internal.h"
#include "src/view/worker.h"

static const double rest_seconds = 0.12; /* time without movement until samples are drawn */
static const double show_seconds = 0.25; /* between displayed means, after the first few */
static const double soon_seconds = 0.15; /* slower samples are preceded by a full-size draft */

enum {
    FIRST_COUNT = 8, /* up to this sample, means are shown at 1, 2, 4 and 8 samples */
};

static struct view_identity seen_now(const struct view *v, float time)
{
    const struct viewport *p = v->picture;
    return (struct view_identity){ p->version, p->camera, time, p->state.scene.settings };
}

static bool differ(float a, float b)
{
    return a < b || a > b;
}

static bool is_same_camera(const struct camera *a, const struct camera *b)
{
    return glms_vec3_eqv(a->eye, b->eye) && glms_vec3_eqv(a->target, b->target) &&
           glms_vec3_eqv(a->up, b->up) && !differ(a->fov_deg, b->fov_deg) &&
           !differ(a->height, b->height) && !differ(a->depth, b->depth);
}

static bool refines(const struct view *v)
{
    return v->picture && v->picture->refines && v->picture->renderer && !(v->resize_at > 0.0);
}

bool view_progressive_is_same(const struct view_identity *a, const struct view_identity *b)
{
    const struct settings settings = viewport_with_exposure(&a->settings, &b->settings);
    return a->version == b->version && is_same_camera(&a->camera, &b->camera) &&
           !differ(a->time, b->time) && !memcmp(&settings, &b->settings, sizeof(settings));
}

/* Returns true if the view is unchanged except for the exposure. */
static bool is_same(const struct view *v, const struct view_identity *now)
{
    return v->refine.has_seen && view_progressive_is_same(&v->refine.seen, now);
}

static bool has_other_exposure(const struct view *v)
{
    return memcmp(&v->refine.seen.settings, &v->picture->state.scene.settings,
                  sizeof(struct settings)) != 0;
}

static bool is_seen(const struct view *v)
{
    const struct view_identity now = seen_now(v, view_time(v));
    return is_same(v, &now);
}

double view_progressive_wait(const struct view *v)
{
    const struct view_progressive *r = &v->refine;
    if (!refines(v) || !r->has_seen || r->count >= r->goal)
        return -1.0;
    const double left = r->moved_at + rest_seconds - clock_seconds();
    return r->at_once || left < 0.0 ? 0.0 : left;
}

double view_progressive_seconds_left(const struct view *v)
{
    const struct view_progressive *r = &v->refine;
    const double taken = clock_seconds() - r->begun_at;
    return r->count && r->count < r->goal ? taken * (r->goal - r->count) / r->count : 0.0;
}

static bool is_to_be_shown(const struct view_progressive *r)
{
    if (r->count >= r->goal)
        return true;
    return r->count <= FIRST_COUNT ? !(r->count & (r->count - 1))
                                   : clock_seconds() > r->shown_at + show_seconds;
}

static enum status resolve(struct view *v)
{
    struct view_progressive *r = &v->refine;
    /* frames in flight may still read the image that is overwritten here */
    enum status status = presenter_wait(&v->screen);
    if (status == STATUS_OK)
        status = viewport_resolve(v->picture, r->count);
    r->seen.settings = v->picture->state.scene.settings;
    r->shown = r->count;
    v->look.sample_count = 0; /* invalidates the inspector's image */
    r->shown_at = clock_seconds();
    v->changed = true; /* the new mean has to be displayed */
    return status;
}

static struct renderer_shot shot_seen(const struct view *v)
{
    return (struct renderer_shot){ .camera = v->refine.seen.camera, .time = v->refine.seen.time };
}

static enum status make_quick(void *user)
{
    struct view *v = user;
    const struct renderer_shot shot = shot_seen(v);
    return viewport_create_draft(v->picture, &shot);
}

/* Returns true if the full renderers are fast enough for interaction, judged by the last frame. */
static bool is_fluid(const struct viewport *p)
{
    struct dynamic_resolution moving;
    dynamic_resolution_begin(&moving, viewport_pass_seconds(p));
    return moving.passes > 0.0 && moving.k == DYNAMIC_RESOLUTION_MAX;
}

static enum status begin_quick(struct view *v)
{
    const double start = clock_seconds();
    const struct viewport *p = v->picture;
    const enum status status = worker_run(&v->window, make_quick, v);
    if (p->quick.left)
        dynamic_resolution_begin(&v->refine.moving, 4.0 * p->quick.seconds);
    view_frame_stats_exclude(&v->costs, start);
    return status;
}

enum status view_progressive_begin(struct view *v)
{
    struct viewport *p = v->picture;
    if (!viewport_wants_draft(p))
        return STATUS_OK;
    const enum status status = viewport_wait(p);
    return status == STATUS_OK && !is_fluid(p) ? begin_quick(v) : status;
}

/* Draws a draft in full size, shown until the first sample is finished. */
static enum status draw_whole(struct view *v)
{
    const struct renderer_shot shot = shot_seen(v);
    const struct app_image *p = &v->picture->state;
    enum status status = presenter_wait(&v->screen);
    if (status == STATUS_OK)
        status = viewport_draw_interactive(v->picture, &shot, (VkExtent2D){ p->width, p->height });
    v->refine.is_whole = v->changed = true;
    return status;
}

/* Does what precedes the next sample: creates draft renderers, replaces outgrown ones, or draws a
 * full-size draft. *drew is true if it did one of these. */
static enum status prepare(struct view *v, bool *drew)
{
    struct view_progressive *r = &v->refine;
    struct viewport *p = v->picture;
    *drew = true;
    if (r->count == 1 && viewport_wants_draft(p) && !is_fluid(p))
        return begin_quick(v);
    if (!r->count && viewport_is_outgrown(p)) {
        presenter_disconnect(&v->screen);
        v->changed = true; /* the new renderers start from the first sample */
        return viewport_rebuild(p);
    }
    const bool is_soon = r->sample > 0.0 && r->sample <= soon_seconds;
    if (!r->count && !r->is_whole && p->shows_draft && !is_soon)
        return draw_whole(v);
    *drew = false;
    return STATUS_OK;
}

static enum status draw_sample(struct view *v)
{
    struct view_progressive *r = &v->refine;
    const double start = clock_seconds();
    const struct renderer_shot shot = shot_seen(v);
    enum status status = r->count ? STATUS_OK : presenter_wait(&v->screen);
    if (status == STATUS_OK)
        status = viewport_refine(v->picture, &shot, r->count);
    if (status == STATUS_OK)
        noise_estimate_add(&r->noise, renderer_sums(v->picture->renderer), r->count);
    r->begun_at = r->count ? r->begun_at : start;
    r->count++;
    r->sample = clock_seconds() - start;
    if (status == STATUS_OK && is_to_be_shown(r))
        status = resolve(v);
    view_frame_stats_exclude(&v->costs, start);
    return status;
}

enum status view_progressive_step(struct view *v, bool *drew)
{
    const double wait = view_progressive_wait(v);
    const bool is_due = wait >= 0.0 && !(wait > 0.0);
    *drew = false;
    if (!refines(v) || !is_seen(v) || (wait > 0.0))
        return STATUS_OK;
    const enum status status = prepare(v, drew);
    if (status != STATUS_OK || *drew || !is_due)
        return status;
    *drew = true;
    return draw_sample(v);
}

enum status view_progressive_draw(struct view *v, const struct renderer_shot *shot)
{
    struct view_progressive *r = &v->refine;
    const struct viewport *p = v->picture;
    const struct view_identity now = seen_now(v, shot->time);
    v->redrawn = false;
    if (is_same(v, &now))
        return r->count && has_other_exposure(v) ? resolve(v) : STATUS_OK;
    if (!r->moving.k)
        dynamic_resolution_begin(&r->moving, 0.0);
    const bool first = !r->has_seen;
    const uint32_t k = first || p->quick.is_off ? DYNAMIC_RESOLUTION_MAX : r->moving.k;
    const VkExtent2D view = { dynamic_resolution_scale(p->state.width, k),
                              dynamic_resolution_scale(p->state.height, k) };
    const bool other = view.width != p->view.width || view.height != p->view.height;
    enum status status = other ? presenter_wait(&v->screen) : STATUS_OK;
    if (status == STATUS_OK)
        status = viewport_draw_interactive(v->picture, shot, view);
    r->seen = now;
    r->has_seen = true;
    r->count = r->shown = 0;
    r->is_whole = false;
    r->moved_at = first ? 0.0 : clock_seconds();
    v->redrawn = true;
    return status;
}
