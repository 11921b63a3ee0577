/* view_compare.c: A/B comparison: chooses side B; runs the reference and the error map. */
#include "src/view/view_compare.h"
#include <math.h>
#include <stdio.h>
#include <string.h>
#include "src/base/path.h"
#include "src/frame/pass_list.h"
#include "src/reader/image_reader.h"
#include "src/tech/output/tonemap.h"
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

static struct comparison_image *still_of(struct view *v)
{
    return v->compare.other == VIEW_SIDE_B_FILE        ? &v->compare.file
           : v->compare.other == VIEW_SIDE_B_REFERENCE ? &v->compare.traced
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
    for (size_t i = 0; (next = techniques_refraction(i)); i++)
        last = next;
    return v->picture->state.refraction == last ? techniques_refraction(0) : last;
}

void view_compare_choose(struct view *v, struct view_state *state, enum view_side_b other)
{
    const struct view_compare *c = &v->compare;
    state->other = other == VIEW_SIDE_B_STATE && !c->has_stored ? VIEW_SIDE_B_MODEL : other;
    state->split = NULL;
    state->right = (struct settings){ .values = { 0 } };
    if (state->other == VIEW_SIDE_B_MODEL)
        state->split = other_rung(v);
    if (state->other != VIEW_SIDE_B_STATE)
        return;
    state->split = c->stored.refraction;
    state->right = c->stored.settings;
}

enum status view_compare_use(struct view *v, const struct view_state *state)
{
    struct view_compare *c = &v->compare;
    const bool live = state->other == VIEW_SIDE_B_MODEL || state->other == VIEW_SIDE_B_STATE;
    view_compare_stop(v);
    presenter_disconnect(&v->screen);
    const enum status status =
        viewport_split(v->picture, live ? state->split : NULL,
                       state->other == VIEW_SIDE_B_STATE ? &state->right : NULL);
    if (status != STATUS_OK)
        return status;
    c->other = state->other;
    c->reference_failed = false;
    v->picture->shows_comparison_image = still_of(v) != NULL;
    v->picture->still = VK_NULL_HANDLE;
    if (c->other == VIEW_SIDE_B_NONE)
        c->differs = v->picture->flipped = false;
    return STATUS_OK;
}

void view_compare_with(struct view *v, enum view_side_b other)
{
    struct view_state state = view_state_now(v);
    view_compare_choose(v, &state, other);
    view_edit(v, &state, 0);
}

void view_compare_toggle(struct view *v)
{
    view_compare_with(v,
                      v->compare.other == VIEW_SIDE_B_NONE ? VIEW_SIDE_B_STATE : VIEW_SIDE_B_NONE);
}

void view_compare_store(struct view *v)
{
    struct view_compare *c = &v->compare;
    c->stored = view_state_now(v);
    c->has_stored = true;
    if (c->other == VIEW_SIDE_B_STATE)
        view_compare_with(v, VIEW_SIDE_B_STATE);
    ui_show_message(v->ui, "stored as B: change something, then compare with W");
}

/* Ensures that there is a side B, which flipping and differences need. */
static bool has_other(struct view *v)
{
    if (v->compare.other == VIEW_SIDE_B_NONE)
        view_compare_toggle(v);
    return v->compare.other != VIEW_SIDE_B_NONE;
}

void view_compare_flip(struct view *v)
{
    if (!has_other(v))
        return;
    v->picture->flipped = !v->picture->flipped;
    v->compare.differs = false;
}

void view_compare_toggle_error_map(struct view *v)
{
    struct view_compare *c = &v->compare;
    if (!has_other(v))
        return;
    c->differs = !c->differs;
    v->picture->flipped = false;
    ui_show_message(v->ui, c->differs ? "the FLIP error follows when both images are at rest" : "");
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
    return image_reader_read(&reading->image, reading->path,
                             &reading->view->picture->state.scene.reader);
}

void view_compare_await(struct view *v)
{
    v->compare.awaits_file = true;
    ui_show_message(v->ui, "drop the .png, .exr or .hdr file to compare with");
}

bool view_compare_accepts(const struct view *v, const char *path)
{
    return v->compare.awaits_file && image_reader_knows_suffix(path);
}

void view_compare_open(struct view *v, const char *path)
{
    struct view_compare *c = &v->compare;
    struct reading reading = { v, path, { 0 } };
    struct view_state state = view_state_now(v);
    const char *slash = strrchr(path, '/');
    char words[VIEW_SIDE_SIZE + 64];
    c->awaits_file = false;
    view_clear_errors(v);
    if (worker_run(&v->window, read_file, &reading) != STATUS_OK) {
        view_fail(v, "the file was not opened");
        return;
    }
    image_finish(&c->file.linear);
    c->file.linear = reading.image;
    c->file.is_shown = path_ends_in(path, ".png");
    c->file.is_made = c->has_errors = false;
    snprintf(c->file_name, sizeof(c->file_name), "%s", slash ? slash + 1 : path);
    view_compare_choose(v, &state, VIEW_SIDE_B_FILE);
    if (!view_edit(v, &state, 0))
        return;
    snprintf(words, sizeof(words), "compared with %s: D shows the difference, W hides it",
             c->file_name);
    ui_show_message(v->ui, words);
}

/* ---- reference ---- */

void view_compare_stop(struct view *v)
{
    struct view_compare *c = &v->compare;
    reference_job_stop(&c->truth);
    image_finish(&c->traced.linear);
    c->traced.is_made = false;
}

static void begin_truth(struct view *v)
{
    struct view_compare *c = &v->compare;
    const struct viewport *p = v->picture;
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
    c->view_reference_seen = v->refine.seen;
    c->reference_failed = !reference_job_begin(&c->truth, &request, &shot);
}

/* Runs the reference while the image is still, and stops it when the view or scene changes. */
static void follow_truth(struct view *v)
{
    struct view_compare *c = &v->compare;
    const bool same = view_progressive_is_same(&c->view_reference_seen, &v->refine.seen);
    if (c->other != VIEW_SIDE_B_REFERENCE)
        return;
    if (!same && (c->truth.runs || c->reference_failed)) {
        view_compare_stop(v);
        c->reference_failed = false;
    }
    if (!c->truth.runs && !c->reference_failed && is_at_rest(v))
        begin_truth(v);
    if (reference_job_take(&c->truth, &c->traced.linear)) {
        c->traced.is_made = false;
        v->changed = true;
        ui_wake(v->ui);
    }
    if (c->truth.runs && atomic_load(&c->truth.done) && c->truth.status != STATUS_OK) {
        view_compare_stop(v);
        c->reference_failed = true;
        view_fail(v, "the reference cannot be rendered");
    }
}

/* ---- error map ---- */

static uint32_t count_of(const struct view *v)
{
    const struct view_compare *c = &v->compare;
    const uint32_t other = c->other == VIEW_SIDE_B_REFERENCE ? c->truth.taken_samples : 0;
    return v->refine.shown + (other << 16);
}

/* Fills in the two images to compare. Returns false if one is missing or if their sizes differ. */
static bool find_sides(struct view *v, struct flip_error_map_image sides[static 2])
{
    const struct viewport *p = v->picture;
    const struct comparison_image *still = still_of(v);
    if (!p->renderer || !is_at_rest(v))
        return false;
    const float scale = 1.0f / (float)renderer_sum_count(p->renderer);
    sides[0] = (struct flip_error_map_image){ renderer_sums(p->renderer), scale, false };
    if (still)
        sides[1] = (struct flip_error_map_image){ &still->linear, 1.0f, still->is_shown };
    else if (p->right)
        sides[1] = (struct flip_error_map_image){ renderer_sums(p->right), scale, false };
    return (still || p->right) && sides[0].image->width &&
           sides[0].image->width == sides[1].image->width &&
           sides[0].image->height == sides[1].image->height;
}

static bool is_compared(const struct view *v)
{
    const struct view_compare *c = &v->compare;
    const float gain = gain_of(v);
    return c->map_count == count_of(v) && view_progressive_is_same(&c->map_seen, &v->refine.seen) &&
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
    if (!flip_error_map_take(&c->map))
        return;
    c->has_errors = !c->map.failed;
    c->errors_seen = c->map_seen;
    c->errors.is_made = false;
    v->changed = true;
    if (c->map.failed) {
        ui_show_failure(v->ui, "out of memory while comparing the images: make the window smaller");
        return;
    }
    snprintf(words, sizeof(words), "FLIP: mean %.4f, 95 %% of the pixels below %.4f", c->map.mean,
             c->map.high);
    ui_show_message(v->ui, words);
}

static void follow_errors(struct view *v)
{
    struct view_compare *c = &v->compare;
    struct flip_error_map_image sides[2];
    take_errors(v);
    if (!c->differs || c->map.runs || !is_at_rest(v) || !is_due(v) ||
        (c->has_errors && !c->errors.is_made)) /* the previous map has not been shown yet */
        return;
    c->map_seen = v->refine.seen;
    c->map_count = count_of(v);
    c->map_gain = gain_of(v);
    if (find_sides(v, sides))
        (void)flip_error_map_begin(&c->map, sides, c->map_gain, tone_of(v)->curve);
    else if (still_of(v) && still_of(v)->linear.width)
        ui_show_message(v->ui, "the images differ in size: start with --size equal to the file's");
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
    struct viewport *p = v->picture;
    struct comparison_image *still = still_of(v);
    enum status status = STATUS_OK;
    p->still = VK_NULL_HANDLE;
    if (still && still->linear.width) {
        status = still->is_made ? STATUS_OK : presenter_wait(&v->screen);
        if (status == STATUS_OK)
            status = comparison_image_show(still, &v->gpu, gain_of(v), tone_of(v)->curve);
        p->still = still->image.image;
        p->comparison_extent = (VkExtent2D){ still->linear.width, still->linear.height };
    }
    if (status != STATUS_OK || !c->differs || !c->has_errors || !is_at_rest(v) ||
        !view_progressive_is_same(&c->errors_seen, &v->refine.seen))
        return status;
    if (!c->errors.is_made)
        status = presenter_wait(&v->screen);
    if (status == STATUS_OK)
        status = comparison_image_upload(&c->errors, &v->gpu, c->map.rgba,
                                         (VkExtent2D){ c->map.width, c->map.height });
    p->instead = c->errors.image.image;
    return status;
}

/* ---- labels ---- */

void view_compare_print(const struct view *v, char left[static VIEW_SIDE_SIZE],
                        char right[static VIEW_SIDE_SIZE])
{
    const struct view_compare *c = &v->compare;
    const struct app_image *p = &v->picture->state;
    *right = '\0';
    snprintf(left, VIEW_SIDE_SIZE, "A %s", p->refraction->refraction.name);
    if (c->other == VIEW_SIDE_B_MODEL)
        snprintf(right, VIEW_SIDE_SIZE, "B %s", p->split->refraction.name);
    else if (c->other == VIEW_SIDE_B_STATE)
        snprintf(right, VIEW_SIDE_SIZE, "B stored, %s", p->split->refraction.name);
    else if (c->other == VIEW_SIDE_B_FILE)
        snprintf(right, VIEW_SIDE_SIZE, "B %s", c->file_name);
    else if (c->other == VIEW_SIDE_B_REFERENCE && c->traced.linear.width)
        snprintf(right, VIEW_SIDE_SIZE, "B reference %u/%u \xc2\xb1%.2g", c->truth.taken_samples,
                 v->refine.goal, c->truth.taken_noise);
    else if (c->other == VIEW_SIDE_B_REFERENCE)
        snprintf(right, VIEW_SIDE_SIZE, "B reference: %s",
                 v->refine.shown ? "rendering the first sample" : "when the image is at rest");
}
