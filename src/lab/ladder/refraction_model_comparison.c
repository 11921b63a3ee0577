/* refraction_model_comparison.c: renders refraction models and the reference, and measures errors.
 */
#include "src/lab/ladder/refraction_model_comparison.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/clock.h"
#include "src/base/log.h"
#include "src/file/half_float.h"
#include "src/lab/metric/angle.h"
#include "src/lab/metric/error_sums.h"
#include "src/lab/metric/flip.h"
#include "src/lab/profile/statistics.h"
#include "src/lab/reference/reference.h"
#include "src/lab/reference/reference_aov_table.h"
#include "src/render/make_frame_request.h"

static const char *const colors[3] = { "R", "G", "B" };
static const char *const directions[3] = { "exit.X", "exit.Y", "exit.Z" };

const char *const ladder_path_class_names[LADDER_PATH_CLASS_COUNT] = {
    [LADDER_REFRACTED] = "refracted",
    [LADDER_REFLECTED] = "reflected",
    [LADDER_TRAPPED] = "trapped",
};

const char *const ladder_inclusion_names[LADDER_INCLUSION_COUNT] = {
    [LADDER_CLEAR] = "clear",
    [LADDER_BUBBLES] = "bubbles",
    [LADDER_CRACKS] = "cracks",
    [LADDER_AIR] = "air",
};

/* User data of the progress callback. */
struct work {
    ladder_progress_fn *progress;
    void *user;
    uint32_t stage;
};

static size_t pixel_count(const struct ladder *ladder)
{
    return (size_t)ladder->width * ladder->height;
}

static bool show_progress(void *user, uint32_t done, uint32_t all)
{
    const struct work *work = user;
    return !work->progress || work->progress(work->user, work->stage, done, all);
}

/* Returns a bit mask of the layers to render, either by the reference or by a model. */
static uint64_t find_layers(bool of_reference)
{
    static const char *const names[] = {
        "exit", "path", "bounces", "tir", "remaining", "inclusions"
    };
    const size_t count = sizeof(names) / sizeof(names[0]) - (of_reference ? 0 : 2);
    uint64_t bits = 0;
    for (uint32_t i = 0; techniques_layer(i); i++) {
        for (size_t k = 0; k < count; k++)
            bits |= !strcmp(techniques_layer(i)->name, names[k]) ? UINT64_C(1) << i : 0;
    }
    return bits;
}

/* Rounds planes that EXR files store as half, to get the same errors as `firn diff`. */
static void round_to_half(const struct image *image)
{
    for (uint32_t p = 0; p < image->plane_count; p++) {
        float *texels = image->planes[p].texels;
        const size_t count = image->planes[p].half ? (size_t)image->width * image->height : 0;
        for (size_t i = 0; i < count; i++)
            texels[i] = half_to_float(half_from_float(texels[i]));
    }
}

static enum status trace(struct ladder *ladder, const struct ladder_params *params,
                         struct work *work)
{
    const struct reference_request request = {
        .scene = params->scene,
        .settings = params->settings,
        .width = params->width,
        .height = params->height,
        .samples = params->samples,
        .filter = params->filter,
        .layers = find_layers(true),
        .linear = true,
        .display = true,
    };
    struct reference *reference = NULL;
    const double start = clock_ms();
    enum status status = reference_create(&reference, &request);
    if (status == STATUS_OK)
        status =
            reference_render(reference, &params->shot, &ladder->reference, show_progress, work);
    if (status == STATUS_OK)
        snprintf(ladder->tracer, sizeof(ladder->tracer), "%s", reference_device(reference));
    ladder->reference_cost = clock_ms() - start;
    round_to_half(&ladder->reference.image);
    reference_destroy(reference);
    return status;
}

static struct renderer_params renderer_params_of(const struct ladder_params *params,
                                                 const struct technique *model)
{
    struct renderer_params made = {
        .gpu = params->gpu,
        .scene = params->scene,
        .settings = params->settings,
        .refraction = model,
        .width = params->width,
        .height = params->height,
        .samples = params->samples,
        .filter = params->filter,
    };
    renderer_set_camera(&made, &params->shot.camera);
    return made;
}

static enum status draw(struct ladder_model *model, const struct ladder_params *params,
                        struct work *work)
{
    struct renderer_params renderer_params = renderer_params_of(params, model->refraction);
    struct renderer *renderer = NULL;
    renderer_params.layers = find_layers(false);
    renderer_params.linear = renderer_params.display = true;
    enum status status = renderer_create(&renderer, &renderer_params);
    if (status == STATUS_OK)
        status = renderer_render(renderer, &params->shot, &model->result, show_progress, work);
    renderer_destroy(renderer);
    return status;
}

/* Masks of the pixels that each error metric covers. */
struct masks {
    bool *object, *untrapped, *path_classes[LADDER_PATH_CLASS_COUNT],
        *inclusions[LADDER_INCLUSION_COUNT];
    const bool *truth;
};

static enum ladder_path_class class_of(float bounces)
{
    return bounces < 0.5f ? LADDER_REFRACTED : bounces < 1.5f ? LADDER_REFLECTED : LADDER_TRAPPED;
}

/* Returns true if `hit_bits` (enum reference_inclusion) contain an inclusion class. */
static bool has_inclusion(uint32_t hit_bits, uint32_t inclusion)
{
    static const uint32_t bits[LADDER_INCLUSION_COUNT] = {
        [LADDER_BUBBLES] = REFERENCE_INCLUSION_BUBBLES,
        [LADDER_CRACKS] = REFERENCE_INCLUSION_CRACKS,
        [LADDER_AIR] = REFERENCE_INCLUSION_AIR,
    };
    return inclusion == LADDER_CLEAR ? hit_bits == 0 : hit_bits & bits[inclusion];
}

static enum status make_masks(struct masks *masks, struct ladder *ladder,
                              const struct ladder_params *params)
{
    const float *path = image_find(&ladder->reference.image, "path.Z");
    const float *tir = image_find(&ladder->reference.image, "tir.Z");
    const float *bounces = image_find(&ladder->reference.image, "bounces.Z");
    const size_t count = pixel_count(ladder);
    const float *hit_bits = image_find(&ladder->reference.image, "inclusions.Z");
    masks->object = calloc((2 + LADDER_PATH_CLASS_COUNT + LADDER_INCLUSION_COUNT) * count,
                           sizeof(*masks->object));
    if (!masks->object || !path || !tir || !bounces || !hit_bits)
        return log_out_of_memory(NULL);
    masks->untrapped = masks->object + count;
    for (size_t c = 0; c < LADDER_PATH_CLASS_COUNT; c++)
        masks->path_classes[c] = masks->object + (2 + c) * count;
    for (size_t c = 0; c < LADDER_INCLUSION_COUNT; c++)
        masks->inclusions[c] = masks->object + (2 + LADDER_PATH_CLASS_COUNT + c) * count;
    masks->truth = params->truth_counted ? params->truth_counted : masks->object;
    for (size_t i = 0; i < count; i++) {
        masks->object[i] = path[i] > 0.0f;
        masks->untrapped[i] = masks->object[i] && tir[i] == 0.0f;
        if (masks->object[i]) {
            const enum ladder_path_class cause = class_of(bounces[i]);
            masks->path_classes[cause][i] = true;
            ladder->path_class_counts[cause]++;
        }
        for (uint32_t c = 0; c < LADDER_INCLUSION_COUNT && masks->object[i]; c++) {
            masks->inclusions[c][i] = has_inclusion((uint32_t)hit_bits[i], c);
            ladder->inclusion_counts[c] += masks->inclusions[c][i];
        }
        ladder->object_count += masks->object[i];
        ladder->angle_count += masks->untrapped[i];
    }
    return STATUS_OK;
}

static void find_planes(const struct image *image, const char *const names[static 3],
                        const float *planes[static 3])
{
    for (int i = 0; i < 3; i++)
        planes[i] = image_find(image, names[i]);
}

static enum status measure_flip(struct ladder_model *model, const struct ladder *ladder)
{
    struct flip_pair pair = { .width = ladder->width, .height = ladder->height, .ppd = FLIP_PPD };
    double sum = 0.0;
    find_planes(&ladder->reference.image, colors, pair.reference);
    find_planes(&model->result.image, colors, pair.test);
    model->flip = malloc(pixel_count(ladder) * sizeof(*model->flip));
    if (!model->flip || !flip_ldr(&pair, 0.0, model->flip))
        return log_out_of_memory(NULL);
    for (size_t i = 0; i < pixel_count(ladder); i++)
        sum += (double)model->flip[i];
    model->error.flip = sum / (double)pixel_count(ladder);
    return STATUS_OK;
}

static enum status measure_angle(struct ladder_model *model, const struct ladder *ladder,
                                 const struct masks *masks)
{
    struct angle_pair pair = { .counted = masks->untrapped, .pixel_count = pixel_count(ladder) };
    struct angle angle;
    find_planes(&ladder->reference.image, directions, pair.reference);
    find_planes(&model->result.image, directions, pair.test);
    if (!angle_measure(&angle, &pair, NULL))
        return log_out_of_memory(NULL);
    model->error.angle = angle.mean;
    model->error.angle_95 = angle.percentile_95;
    return STATUS_OK;
}

static double measure_tir(const struct ladder_model *model, const struct ladder *ladder,
                          const struct masks *masks)
{
    const float *reference = image_find(&ladder->reference.image, "tir.Z");
    const float *test = image_find(&model->result.image, "tir.Z");
    uint64_t count = 0;
    for (size_t i = 0; i < pixel_count(ladder); i++)
        count += masks->object[i] && !(reference[i] == test[i]);
    return ladder->object_count ? (double)count / (double)ladder->object_count : (double)NAN;
}

/* Measures the colour difference of the pixels in a mask. */
static struct difference measure_colors(const struct image *a, const struct image *b,
                                        const bool *counted)
{
    struct difference difference = { 0 };
    const float *reference[3], *test[3];
    find_planes(a, colors, reference);
    find_planes(b, colors, test);
    for (int i = 0; i < 3; i++)
        difference_add(&difference, reference[i], test[i], counted, (size_t)a->width * a->height);
    return difference;
}

/* Returns the MAE against another renderer's image `truth`, or NaN if `truth` is NULL. */
static double measure_truth(const struct image *image, const struct image *truth,
                            const struct masks *masks)
{
    if (!truth)
        return (double)NAN;
    const struct difference difference = measure_colors(truth, image, masks->truth);
    return difference_mae(&difference);
}

static enum status compare(struct ladder_model *model, const struct ladder *ladder,
                           const struct image *truth, const struct masks *masks)
{
    const struct difference difference =
        measure_colors(&ladder->reference.image, &model->result.image, masks->object);
    model->error.truth = measure_truth(&model->result.image, truth, masks);
    model->error.not_finite = difference.not_finite;
    model->error.mae = difference_mae(&difference);
    model->error.mae_unclipped = difference_mae_unclipped(&difference);
    model->error.rmse = difference_rmse(&difference);
    for (int c = 0; c < LADDER_PATH_CLASS_COUNT; c++) {
        const struct difference part =
            measure_colors(&ladder->reference.image, &model->result.image, masks->path_classes[c]);
        model->error.path_class_mae[c] = difference_mae(&part);
    }
    for (int c = 0; c < LADDER_INCLUSION_COUNT; c++) {
        const struct difference part =
            measure_colors(&ladder->reference.image, &model->result.image, masks->inclusions[c]);
        model->error.inclusion_mae[c] = difference_mae(&part);
    }
    model->error.tir_differs = measure_tir(model, ladder, masks);
    enum status status = measure_flip(model, ladder);
    return status == STATUS_OK ? measure_angle(model, ladder, masks) : status;
}

static bool is_selected(const struct ladder_params *params, uint32_t index)
{
    return !params->refraction_models || (params->refraction_models >> index & 1u);
}

static uint32_t count_models(const struct ladder_params *params)
{
    uint32_t count = 0;
    for (uint32_t i = 0; techniques_refraction(i); i++)
        count += is_selected(params, i);
    return count < LADDER_MODEL_COUNT ? count : LADDER_MODEL_COUNT;
}

uint32_t ladder_stages(const struct ladder_params *params)
{
    return 1 + count_models(params) + (params->run_count > 0);
}

static void choose_models(struct ladder *ladder, const struct ladder_params *params)
{
    for (uint32_t i = 0;
         techniques_refraction(i) && ladder->refraction_model_count < LADDER_MODEL_COUNT; i++) {
        if (is_selected(params, i))
            ladder->refraction_models[ladder->refraction_model_count++].refraction =
                techniques_refraction(i);
    }
}

static enum status draw_models(struct ladder *ladder, const struct ladder_params *params,
                               struct work *work)
{
    struct masks masks = { 0 };
    enum status status = make_masks(&masks, ladder, params);
    ladder->reference_error.truth = measure_truth(&ladder->reference.image, params->truth, &masks);
    for (uint32_t i = 0; i < ladder->refraction_model_count && status == STATUS_OK; i++) {
        work->stage++;
        status = draw(&ladder->refraction_models[i], params, work);
        if (status == STATUS_OK)
            status = compare(&ladder->refraction_models[i], ladder, params->truth, &masks);
    }
    free(masks.object);
    return status;
}

static enum status time_frame(struct renderer *renderer, const struct renderer_shot *shot,
                              double *ms)
{
    const double start = clock_ms();
    enum status status = renderer_draw(renderer, shot);
    if (status == STATUS_OK)
        status = renderer_wait(renderer);
    *ms = clock_ms() - start;
    return status;
}

/* Stores the frame time of model i in run r in samples[i * run_count + r]: from the call until the
 * GPU has finished, without readback. The models take turns, because other load on the machine then
 * affects all of them equally. A warm-up run comes first, whose times are overwritten by run 0. */
static enum status time_all(struct renderer *const *renderers, const struct ladder *ladder,
                            const struct ladder_params *params, double *samples, struct work *work)
{
    enum status status = STATUS_OK;
    for (uint32_t run = 0; run <= params->run_count && status == STATUS_OK; run++) {
        const uint32_t sample = run ? run - 1 : 0;
        for (uint32_t i = 0; i < ladder->refraction_model_count && status == STATUS_OK; i++)
            status = time_frame(renderers[i], &params->shot,
                                &samples[(size_t)i * params->run_count + sample]);
        if (status == STATUS_OK && !show_progress(work, run, params->run_count))
            status = STATUS_FAILED;
    }
    return status;
}

/* Measures frame times with one sample per pixel, since cost is proportional to samples. */
static enum status measure_costs(struct ladder *ladder, const struct ladder_params *params,
                                 struct work *work)
{
    struct renderer *renderers[LADDER_MODEL_COUNT] = { 0 };
    const uint32_t count = ladder->refraction_model_count;
    double *samples = calloc((size_t)count * params->run_count, sizeof(*samples));
    enum status status = samples ? STATUS_OK : log_out_of_memory(NULL);
    work->stage++;
    for (uint32_t i = 0; i < count && status == STATUS_OK; i++) {
        struct renderer_params made =
            renderer_params_of(params, ladder->refraction_models[i].refraction);
        made.samples = 1;
        made.keep = true;
        status = renderer_create(&renderers[i], &made);
    }
    if (status == STATUS_OK)
        status = time_all(renderers, ladder, params, samples, work);
    for (uint32_t i = 0; i < count; i++) {
        if (status == STATUS_OK)
            ladder->refraction_models[i].cost =
                profile_summarize(&samples[(size_t)i * params->run_count], params->run_count)
                    .median;
        renderer_destroy(renderers[i]);
    }
    free(samples);
    return status;
}

enum status ladder_run(struct ladder *ladder, const struct ladder_params *params,
                       ladder_progress_fn *progress, void *user)
{
    struct work work = { progress, user, 0 };
    *ladder = (struct ladder){ .width = params->width,
                               .height = params->height,
                               .is_whole = params->is_whole };
    choose_models(ladder, params);
    enum status status = trace(ladder, params, &work);
    if (status == STATUS_OK)
        status = draw_models(ladder, params, &work);
    if (status == STATUS_OK && params->run_count)
        status = measure_costs(ladder, params, &work);
    if (status != STATUS_OK)
        ladder_finish(ladder);
    return status;
}

void ladder_finish(struct ladder *ladder)
{
    render_result_finish(&ladder->reference);
    for (uint32_t i = 0; i < ladder->refraction_model_count; i++) {
        render_result_finish(&ladder->refraction_models[i].result);
        free(ladder->refraction_models[i].flip);
    }
    *ladder = (struct ladder){ 0 };
}

const struct ladder_model *ladder_base(const struct ladder *ladder)
{
    for (uint32_t i = 0; i < ladder->refraction_model_count; i++) {
        if (!strcmp(ladder->refraction_models[i].refraction->refraction.name, "paper"))
            return &ladder->refraction_models[i];
    }
    return &ladder->refraction_models[0];
}

double ladder_cost_ratio(const struct ladder *ladder, const struct ladder_model *model)
{
    const double base = ladder_base(ladder)->cost;
    return base > 0.0 ? model->cost / base : (double)NAN;
}
