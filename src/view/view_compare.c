/* view_compare.c: A/B comparison: chooses side B; runs the reference and the error map. */
#include "src/view/view_compare.h"
#include <math.h>
#include <stdio.h>
#include <string.h>
#include "src/base/path.h"
#include "src/frame/list.h"
#include "src/reader/picture_reader.h"
#include "src/tech/tonemap.h"
#include "src/view/view_internal.h"
#include "src/view/worker.h"

static const struct tonemap_params *tone_of(const struct view *v)
{
    return settings_of(&v->picture->state.scene.settings, &tonemap_settings);
}

static float gain_of(const struct view *v)
{
    return exp2f(tone_of(v)->exposure);
}

static struct still *still_of(struct view *v)
{
    return v->compare.other == VIEW_OTHER_FILE        ? &v->compare.file
           : v->compare.other == VIEW_OTHER_REFERENCE ? &v->compare.traced
                                                      : NULL;
}

/* Returns true if the samples belong to the current renderers, which may just have been replaced.
 */
static bool is_at_rest(const struct view *v)
{
    return v->refine.shown && v->refine.seen.version == v->picture->version;
}

/* ---- choice of side B ---- */

/* Returns the default refraction model of side B: that of --split, or the last (most exact) one;
 * the first one if side A already uses the last. */
static const struct technique *other_rung(const struct view *v)
{
    const struct technique *last = NULL, *next;
    if (v->options->picture.split)
        return v->options->picture.split;
    for (size_t i = 0; (next = techniques_rung(i)); i++)
        last = next;
    return v->picture->state.rung == last ? techniques_rung(0) : last;
}

void view_compare_choose(struct view *v, struct view_state *state, enum view_other other)
{
    const struct view_compare *c = &v->compare;
    state->other = other == VIEW_OTHER_STATE && !c->has_stored ? VIEW_OTHER_RUNG : other;
    state->split = NULL;
    state->right = (struct settings){ .values = { 0 } };
    if (state->other == VIEW_OTHER_RUNG)
        state->split = other_rung(v);
    if (state->other != VIEW_OTHER_STATE)
        return;
    state->split = c->stored.rung;
    state->right = c->stored.settings;
}

enum status view_compare_use(struct view *v, const struct view_state *state)
{
    struct view_compare *c = &v->compare;
    const bool live = state->other == VIEW_OTHER_RUNG || state->other == VIEW_OTHER_STATE;
    view_compare_stop(v);
    screen_disconnect(&v->screen);
    const enum status status =
        picture_split(v->picture, live ? state->split : NULL,
                      state->other == VIEW_OTHER_STATE ? &state->right : NULL);
    if (status != STATUS_OK)
        return status;
    c->other = state->other;
    c->truth_failed = false;
    v->picture->shows_still = still_of(v) != NULL;
    v->picture->still = VK_NULL_HANDLE;
    if (c->other == VIEW_OTHER_NONE)
        c->differs = v->picture->flipped = false;
    return STATUS_OK;
}

void view_compare_with(struct view *v, enum view_other other)
{
    struct view_state state = view_state_now(v);
    view_compare_choose(v, &state, other);
    view_change(v, &state, 0);
}

void view_compare_toggle(struct view *v)
{
    view_compare_with(v, v->compare.other == VIEW_OTHER_NONE ? VIEW_OTHER_STATE : VIEW_OTHER_NONE);
}

void view_compare_store(struct view *v)
{
    struct view_compare *c = &v->compare;
    c->stored = view_state_now(v);
    c->has_stored = true;
    if (c->other == VIEW_OTHER_STATE)
        view_compare_with(v, VIEW_OTHER_STATE);
    ui_say(v->ui, "stored as B: change something, then compare with W");
}

/* Ensures that there is a side B, which flipping and differences need. */
static bool has_other(struct view *v)
{
    if (v->compare.other == VIEW_OTHER_NONE)
        view_compare_toggle(v);
    return v->compare.other != VIEW_OTHER_NONE;
}

void view_compare_flip(struct view *v)
{
    if (!has_other(v))
        return;
    v->picture->flipped = !v->picture->flipped;
    v->compare.differs = false;
}

void view_compare_differ(struct view *v)
{
    struct view_compare *c = &v->compare;
    if (!has_other(v))
        return;
    c->differs = !c->differs;
    v->picture->flipped = false;
    ui_say(v->ui, c->differs ? "the FLIP error follows when both images are at rest" : "");
}

/* ---- image files ---- */

struct reading {
    struct view *view;
    const char *path;
    struct image image;
};

static enum status read_file(void *user)
{
    struct reading *reading = user;
    return picture_read(&reading->image, reading->path,
                        &reading->view->picture->state.scene.reader);
}

void view_compare_await(struct view *v)
{
    v->compare.awaits_file = true;
    ui_say(v->ui, "drop the .png, .exr or .hdr file to compare with");
}

bool view_compare_takes(const struct view *v, const char *path)
{
    return v->compare.awaits_file && picture_is_named(path);
}

void view_compare_open(struct view *v, const char *path)
{
    struct view_compare *c = &v->compare;
    struct reading reading = { v, path, { 0 } };
    struct view_state state = view_state_now(v);
    const char *slash = strrchr(path, '/');
    char words[VIEW_SIDE_SIZE + 64];
    c->awaits_file = false;
    view_attempt(v);
    if (worker_run(&v->window, read_file, &reading) != STATUS_OK) {
        view_fail(v, "the file was not opened");
        return;
    }
    image_finish(&c->file.linear);
    c->file.linear = reading.image;
    c->file.is_shown = path_ends_in(path, ".png");
    c->file.is_made = c->has_errors = false;
    snprintf(c->file_name, sizeof(c->file_name), "%s", slash ? slash + 1 : path);
    view_compare_choose(v, &state, VIEW_OTHER_FILE);
    if (!view_change(v, &state, 0))
        return;
    snprintf(words, sizeof(words), "compared with %s: D shows the difference, W hides it",
             c->file_name);
    ui_say(v->ui, words);
}

/* ---- reference ---- */

void view_compare_stop(struct view *v)
{
    struct view_compare *c = &v->compare;
    truth_stop(&c->truth);
    image_finish(&c->traced.linear);
    c->traced.is_made = false;
}

static void begin_truth(struct view *v)
{
    struct view_compare *c = &v->compare;
    const struct picture *p = v->picture;
    const struct reference_request request = {
        .scene = &p->scene,
        .settings = &p->state.scene.settings,
        .width = p->state.width,
        .height = p->state.height,
        .samples = v->refine.goal,
        .filter = p->state.filter,
    };
    const struct renderer_shot shot = { .camera = v->refine.seen.camera,
                                        .time = v->refine.seen.time };
    c->truth_seen = v->refine.seen;
    c->truth_failed = !truth_begin(&c->truth, &request, &shot);
}

/* Runs the reference while the image is still, and stops it when the view or scene changes. */
static void follow_truth(struct view *v)
{
    struct view_compare *c = &v->compare;
    const bool same = view_refine_is_same(&c->truth_seen, &v->refine.seen);
    if (c->other != VIEW_OTHER_REFERENCE)
        return;
    if (!same && (c->truth.runs || c->truth_failed)) {
        view_compare_stop(v);
        c->truth_failed = false;
    }
    if (!c->truth.runs && !c->truth_failed && is_at_rest(v))
        begin_truth(v);
    if (truth_take(&c->truth, &c->traced.linear)) {
        c->traced.is_made = false;
        v->changed = true;
        ui_wake(v->ui);
    }
    if (c->truth.runs && atomic_load(&c->truth.done) && c->truth.status != STATUS_OK) {
        view_compare_stop(v);
        c->truth_failed = true;
        view_fail(v, "the reference cannot be rendered");
    }
}

/* ---- error map ---- */

static uint32_t count_of(const struct view *v)
{
    const struct view_compare *c = &v->compare;
    const uint32_t other = c->other == VIEW_OTHER_REFERENCE ? c->truth.took_samples : 0;
    return v->refine.shown + (other << 16);
}

/* Fills in the two images to compare. Returns false if one is missing or if their sizes differ. */
static bool find_sides(struct view *v, struct error_side sides[static 2])
{
    const struct picture *p = v->picture;
    const struct still *still = still_of(v);
    if (!p->renderer || !is_at_rest(v))
        return false;
    const float scale = 1.0f / (float)renderer_sum_count(p->renderer);
    sides[0] = (struct error_side){ renderer_sums(p->renderer), scale, false };
    if (still)
        sides[1] = (struct error_side){ &still->linear, 1.0f, still->is_shown };
    else if (p->right)
        sides[1] = (struct error_side){ renderer_sums(p->right), scale, false };
    return (still || p->right) && sides[0].image->width &&
           sides[0].image->width == sides[1].image->width &&
           sides[0].image->height == sides[1].image->height;
}

static bool is_compared(const struct view *v)
{
    const struct view_compare *c = &v->compare;
    const float gain = gain_of(v);
    return c->map_count == count_of(v) && view_refine_is_same(&c->map_seen, &v->refine.seen) &&
           !(gain < c->map_gain || gain > c->map_gain);
}

/* Returns true if the error map is outdated; it is updated at sample counts 2^n and at the last. */
static bool is_due(const struct view *v)
{
    const uint32_t shown = v->refine.shown;
    return (shown >= v->refine.goal || !(shown & (shown - 1))) && !is_compared(v);
}

static void take_errors(struct view *v)
{
    struct view_compare *c = &v->compare;
    char words[160];
    if (!error_map_take(&c->map))
        return;
    c->has_errors = !c->map.failed;
    c->errors_seen = c->map_seen;
    c->errors.is_made = false;
    v->changed = true;
    if (c->map.failed) {
        ui_fail(v->ui, "out of memory while comparing the images: make the window smaller");
        return;
    }
    snprintf(words, sizeof(words), "FLIP: mean %.4f, 95 %% of the pixels below %.4f", c->map.mean,
             c->map.high);
    ui_say(v->ui, words);
}

static void follow_errors(struct view *v)
{
    struct view_compare *c = &v->compare;
    struct error_side sides[2];
    take_errors(v);
    if (!c->differs || c->map.runs || !is_at_rest(v) || !is_due(v) ||
        (c->has_errors && !c->errors.is_made)) /* the previous map has not been shown yet */
        return;
    c->map_seen = v->refine.seen;
    c->map_count = count_of(v);
    c->map_gain = gain_of(v);
    if (find_sides(v, sides))
        (void)error_map_begin(&c->map, sides, c->map_gain, tone_of(v)->curve);
    else if (still_of(v) && still_of(v)->linear.width)
        ui_say(v->ui, "the images differ in size: start with --size equal to the file's");
}

void view_compare_follow(struct view *v)
{
    follow_truth(v);
    follow_errors(v);
}

/* ---- display ---- */

enum status view_compare_show(struct view *v)
{
    struct view_compare *c = &v->compare;
    struct picture *p = v->picture;
    struct still *still = still_of(v);
    enum status status = STATUS_OK;
    p->still = VK_NULL_HANDLE;
    if (still && still->linear.width) {
        status = still->is_made ? STATUS_OK : screen_wait(&v->screen);
        if (status == STATUS_OK)
            status = still_show(still, &v->gpu, gain_of(v), tone_of(v)->curve);
        p->still = still->image.image;
        p->still_extent = (VkExtent2D){ still->linear.width, still->linear.height };
    }
    if (status != STATUS_OK || !c->differs || !c->has_errors || !is_at_rest(v) ||
        !view_refine_is_same(&c->errors_seen, &v->refine.seen))
        return status;
    if (!c->errors.is_made)
        status = screen_wait(&v->screen);
    if (status == STATUS_OK)
        status = still_put(&c->errors, &v->gpu, c->map.rgba,
                           (VkExtent2D){ c->map.width, c->map.height });
    p->instead = c->errors.image.image;
    return status;
}

/* ---- labels ---- */

void view_compare_print(const struct view *v, char left[static VIEW_SIDE_SIZE],
                        char right[static VIEW_SIDE_SIZE])
{
    const struct view_compare *c = &v->compare;
    const struct app_picture *p = &v->picture->state;
    *right = '\0';
    snprintf(left, VIEW_SIDE_SIZE, "A %s", p->rung->rung.name);
    if (c->other == VIEW_OTHER_RUNG)
        snprintf(right, VIEW_SIDE_SIZE, "B %s", p->split->rung.name);
    else if (c->other == VIEW_OTHER_STATE)
        snprintf(right, VIEW_SIDE_SIZE, "B stored, %s", p->split->rung.name);
    else if (c->other == VIEW_OTHER_FILE)
        snprintf(right, VIEW_SIDE_SIZE, "B %s", c->file_name);
    else if (c->other == VIEW_OTHER_REFERENCE && c->traced.linear.width)
        snprintf(right, VIEW_SIDE_SIZE, "B reference %u/%u \xc2\xb1%.2g", c->truth.took_samples,
                 v->refine.goal, c->truth.took_noise);
    else if (c->other == VIEW_OTHER_REFERENCE)
        snprintf(right, VIEW_SIDE_SIZE, "B reference: %s",
                 v->refine.shown ? "rendering the first sample" : "when the image is at rest");
}
