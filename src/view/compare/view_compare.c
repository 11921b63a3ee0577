/* view_compare.c: A/B comparison: chooses side B; runs the reference and the error map. */
#include "src/view/compare/view_compare.h"
#include <stdio.h>
#include <string.h>
#include "src/tech/output/tonemap.h"
#include "src/view/view_internal.h"
#include "src/view/window/worker_thread.h"

static struct tonemap_params tone_of(const struct view *v)
{
    return tonemap_params_of(&v->viewport->state.scene.settings);
}

static struct comparison_image *side_b_image(struct view *v)
{
    return v->compare.side_b == VIEW_SIDE_B_FILE        ? &v->compare.file
           : v->compare.side_b == VIEW_SIDE_B_REFERENCE ? &v->compare.reference
                                                        : NULL;
}

/* Returns true if the displayed image consists of samples from the current renderers. */
static bool is_at_rest(const struct view *v)
{
    return v->progressive.shown_count &&
           v->progressive.identity.renderer_version == v->viewport->version;
}

/* ---- choice of side B ---- */

/* Returns the default refraction model of side B: the one given by --split, otherwise the last
 * (most exact) model. If side A already uses the last model, returns the first. */
static const struct technique *side_b_refraction(const struct view *v)
{
    const struct technique *last = NULL, *next;
    if (v->options->image->split)
        return v->options->image->split;
    for (size_t i = 0; (next = techniques_refraction(i)); i++)
        last = next;
    return v->viewport->state.refraction == last ? techniques_refraction(0) : last;
}

void view_compare_choose(struct view *v, struct view_state *state, enum view_side_b other)
{
    const struct view_compare *c = &v->compare;
    state->side_b = other == VIEW_SIDE_B_STATE && !c->has_stored ? VIEW_SIDE_B_MODEL : other;
    state->split = NULL;
    state->right_settings = (struct settings){ 0 };
    if (state->side_b == VIEW_SIDE_B_MODEL)
        state->split = side_b_refraction(v);
    if (state->side_b != VIEW_SIDE_B_STATE)
        return;
    state->split = c->stored.refraction;
    state->right_settings = c->stored.settings;
}

struct split {
    struct view *view;
    const struct view_state *state;
};

static enum status split(void *user)
{
    const struct split *to = user;
    const struct view_state *state = to->state;
    const bool live = state->side_b == VIEW_SIDE_B_MODEL || state->side_b == VIEW_SIDE_B_STATE;
    return viewport_split(to->view->viewport, live ? state->split : NULL,
                          state->side_b == VIEW_SIDE_B_STATE ? &state->right_settings : NULL);
}

enum status view_compare_use(struct view *v, const struct view_state *state)
{
    struct view_compare *c = &v->compare;
    view_compare_stop(v);
    presenter_disconnect(&v->presenter);
    const enum status status = worker_run(&v->window, split, &(struct split){ v, state });
    if (status != STATUS_OK)
        return status;
    c->side_b = state->side_b;
    c->reference_failed = false;
    v->viewport->shows_comparison_image = side_b_image(v) != NULL;
    v->viewport->comparison_image = VK_NULL_HANDLE;
    if (c->side_b == VIEW_SIDE_B_NONE)
        c->wants_error_map = v->viewport->flipped = false;
    return STATUS_OK;
}

/* ---- reference ---- */

void view_compare_stop(struct view *v)
{
    struct view_compare *c = &v->compare;
    reference_job_stop(&c->reference_job);
    image_finish(&c->reference.linear);
    c->reference.is_current = false;
}

static void begin_reference_job(struct view *v)
{
    struct view_compare *c = &v->compare;
    const struct viewport *p = v->viewport;
    const struct reference_request request = {
        .scene = &p->scene,
        .settings = &p->state.scene.settings,
        .width = p->state.width,
        .height = p->state.height,
        .samples = v->progressive.target_count,
        .filter = p->state.filter,
    };
    const struct renderer_shot shot = { .camera = v->progressive.identity.camera,
                                        .time = v->progressive.identity.time };
    c->reference_identity = v->progressive.identity;
    c->reference_failed = !reference_job_begin(&c->reference_job, &request, &shot);
}

/* Runs the reference job while the image is at rest. Stops it if the view or scene changes. */
static void follow_reference_job(struct view *v)
{
    struct view_compare *c = &v->compare;
    const bool same = view_progressive_is_same(&c->reference_identity, &v->progressive.identity);
    if (c->side_b != VIEW_SIDE_B_REFERENCE)
        return;
    if (!same && (c->reference_job.runs || c->reference_failed)) {
        view_compare_stop(v);
        c->reference_failed = false;
    }
    if (!c->reference_job.runs && !c->reference_failed && is_at_rest(v))
        begin_reference_job(v);
    if (reference_job_take(&c->reference_job, &c->reference.linear)) {
        c->reference.is_current = false;
        v->changed = true;
        ui_wake(v->ui);
    }
    if (c->reference_job.runs && atomic_load(&c->reference_job.done) &&
        c->reference_job.status != STATUS_OK) {
        view_compare_stop(v);
        c->reference_failed = true;
        view_fail(v, "the reference cannot be rendered");
    }
}

/* ---- error map ---- */

static uint32_t count_of(const struct view *v)
{
    const struct view_compare *c = &v->compare;
    const uint32_t other = c->side_b == VIEW_SIDE_B_REFERENCE ? c->reference_job.taken_samples : 0;
    return v->progressive.shown_count + (other << 16);
}

/* Fills in the two images to compare. Returns false if one is missing or their sizes differ. */
static bool find_sides(struct view *v, struct flip_error_map_image sides[static 2])
{
    const struct viewport *p = v->viewport;
    const struct comparison_image *comparison = side_b_image(v);
    if (!p->renderer || !is_at_rest(v))
        return false;
    const float scale = 1.0f / (float)renderer_sum_count(p->renderer);
    sides[0] = (struct flip_error_map_image){ renderer_sums(p->renderer), scale, false };
    if (comparison)
        sides[1] =
            (struct flip_error_map_image){ &comparison->linear, 1.0f, comparison->is_tone_mapped };
    else if (p->right_renderer)
        sides[1] = (struct flip_error_map_image){ renderer_sums(p->right_renderer), scale, false };
    return (comparison || p->right_renderer) && sides[0].image->width &&
           sides[0].image->width == sides[1].image->width &&
           sides[0].image->height == sides[1].image->height;
}

static bool is_compared(const struct view *v)
{
    const struct view_compare *c = &v->compare;
    const struct tonemap_params tonemap = tone_of(v);
    return c->flip_map_sample_count == count_of(v) &&
           view_progressive_is_same(&c->flip_map_identity, &v->progressive.identity) &&
           tonemap_params_equal(&c->flip_map.tonemap, &tonemap);
}

/* Returns true if the error map is outdated and the sample count is a power of 2 or the maximum. */
static bool is_due(const struct view *v)
{
    const uint32_t shown = v->progressive.shown_count;
    return (shown >= v->progressive.target_count || !(shown & (shown - 1))) && !is_compared(v);
}

static void take_errors(struct view *v)
{
    struct view_compare *c = &v->compare;
    char words[160];
    if (!flip_error_map_take(&c->flip_map))
        return;
    c->has_error_image = !c->flip_map.failed;
    c->error_image_identity = c->flip_map_identity;
    c->error_image.is_current = false;
    v->changed = true;
    if (c->flip_map.failed) {
        ui_show_failure(v->ui, "out of memory while comparing the images: make the window smaller");
        return;
    }
    snprintf(words, sizeof(words), "FLIP: mean %.4f, 95 %% of the pixels below %.4f",
             c->flip_map.mean, c->flip_map.percentile_95);
    ui_show_message(v->ui, words);
}

static void follow_errors(struct view *v)
{
    struct view_compare *c = &v->compare;
    struct flip_error_map_image sides[2];
    take_errors(v);
    if (!c->wants_error_map || c->flip_map.runs || v->progressive.is_partial || !is_at_rest(v) ||
        !is_due(v) ||
        (c->has_error_image &&
         !c->error_image.is_current)) /* wait until the previous map was shown */
        return;
    c->flip_map_identity = v->progressive.identity;
    c->flip_map_sample_count = count_of(v);
    c->flip_map.tonemap = tone_of(v);
    if (find_sides(v, sides))
        (void)flip_error_map_begin(&c->flip_map, sides);
    else if (side_b_image(v) && side_b_image(v)->linear.width)
        ui_show_message(v->ui, "the images differ in size: start with --size equal to the file's");
}

void view_compare_follow(struct view *v)
{
    follow_reference_job(v);
    follow_errors(v);
}

/* ---- display ---- */

enum status view_compare_show(struct view *v)
{
    struct view_compare *c = &v->compare;
    struct viewport *p = v->viewport;
    struct comparison_image *comparison = side_b_image(v);
    const struct tonemap_params tonemap = tone_of(v);
    enum status status = STATUS_OK;
    p->comparison_image = VK_NULL_HANDLE;
    if (comparison && comparison->linear.width) {
        status = comparison->is_current ? STATUS_OK : presenter_wait(&v->presenter);
        if (status == STATUS_OK)
            status = comparison_image_show(comparison, &v->gpu, &tonemap);
        p->comparison_image = comparison->image.image;
        p->comparison_extent = (VkExtent2D){ comparison->linear.width, comparison->linear.height };
    }
    if (status != STATUS_OK || !c->wants_error_map || !c->has_error_image || !is_at_rest(v) ||
        !view_progressive_is_same(&c->error_image_identity, &v->progressive.identity))
        return status;
    if (!c->error_image.is_current)
        status = presenter_wait(&v->presenter);
    if (status == STATUS_OK)
        status = comparison_image_upload(&c->error_image, &v->gpu, c->flip_map.rgba,
                                         (VkExtent2D){ c->flip_map.width, c->flip_map.height });
    p->replacement = c->error_image.image.image;
    return status;
}

/* ---- labels ---- */

void view_compare_print(const struct view *v, char left[static VIEW_SIDE_SIZE],
                        char right[static VIEW_SIDE_SIZE])
{
    const struct view_compare *c = &v->compare;
    const struct setup_image *p = &v->viewport->state;
    *right = '\0';
    snprintf(left, VIEW_SIDE_SIZE, "A %s", p->refraction->refraction.name);
    if (c->side_b == VIEW_SIDE_B_MODEL)
        snprintf(right, VIEW_SIDE_SIZE, "B %s", p->split->refraction.name);
    else if (c->side_b == VIEW_SIDE_B_STATE)
        snprintf(right, VIEW_SIDE_SIZE, "B stored, %s", p->split->refraction.name);
    else if (c->side_b == VIEW_SIDE_B_FILE)
        snprintf(right, VIEW_SIDE_SIZE, "B %s", c->file_name);
    else if (c->side_b == VIEW_SIDE_B_REFERENCE && c->reference.linear.width)
        snprintf(right, VIEW_SIDE_SIZE, "B reference %u/%u \xc2\xb1%.2g",
                 c->reference_job.taken_samples, v->progressive.target_count,
                 c->reference_job.taken_noise);
    else if (c->side_b == VIEW_SIDE_B_REFERENCE)
        snprintf(right, VIEW_SIDE_SIZE, "B reference: %s",
                 v->progressive.shown_count ? "rendering the first sample"
                                            : "when the image is at rest");
}
