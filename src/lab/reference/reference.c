/* reference.c: renders reference images on several threads, up to a noise or time limit. */
#include "src/lab/reference/reference.h"
#include <cglm/struct.h>
#include <math.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "shaders/microfacet.h"
#include "src/base/clock.h"
#include "src/base/log.h"
#include "src/base/machine.h"
#include "src/base/parallel.h"
#include "src/lab/reference/photons.h"
#include "src/lab/reference/reference_aov_table.h"
#include "src/lab/reference/reference_sample_sums.h"
#include "src/lab/reference/traced_scene.h"
#include "src/lab/reference/whitted.h"
#include "src/render/sample_accumulation.h"
#include "src/render/weighted_mean.h"
#include "src/tech/lighting/ice_caustics.h"
#include "src/tech/output/tonemap.h"
#include "src/tech/water/caustics.h"

enum {
    TILE = 16, /* tile side in pixels */
    PLANE_COUNT_MAX = FRAME_LAYER_PLANES * (FRAME_LAYER_MAX + 1),
    ROUND_MAX = 16, /* samples per pixel and round */
};

struct reference {
    struct reference_request request;
    RTCDevice device;
    char device_name[32];
};

/* Image plane, and the index of the sample value that the plane stores. */
struct plane {
    float *texels;
    size_t value_index;
    uint32_t sum_index; /* index of the sum to average */
    bool mean;          /* mean of samples, or sample 0 */
};

/* Planes of the weighted mean for display, and their sums. */
struct display {
    float *texels[4]; /* NULL if the mean is not weighted */
    uint32_t rgb_sums[3], alpha_sum, weight_sum;
};

/* Statistics of a tile's pixels. */
struct tally {
    double error; /* sum of the pixels' standard errors */
    double remaining;
    uint64_t pixels_beyond;
};

/* An image in progress, shared by the threads. */
struct job {
    const struct reference *reference;
    struct traced_scene traced;
    struct photons photons;
    struct plane planes[PLANE_COUNT_MAX];
    uint32_t plane_count;
    struct display display;
    struct reference_session *session;
    struct reference_sums sums;
    uint32_t begin, end; /* sample range of the current round */
    struct tally *tallies;
    uint32_t tile_columns, tile_count;
    renderer_progress_fn *progress; /* may be NULL */
    void *user;                     /* argument of `progress` */
    atomic_bool is_stopped;
};

bool reference_is_built(void)
{
    return true;
}

enum status reference_create(struct reference **reference, const struct reference_request *request)
{
    struct reference *r = calloc(1, sizeof(*r));
    *reference = NULL;
    if (!r)
        return log_out_of_memory(NULL);
    r->request = *request;
    r->request.samples = request->samples ? request->samples : 1;
    r->request.threads = request->threads ? request->threads : machine_core_count();
    const enum status status = traced_scene_open_device(&r->device);
    if (status != STATUS_OK) {
        free(r);
        return status;
    }
    snprintf(r->device_name, sizeof(r->device_name), "Embree %d.%d.%d",
             (int)rtcGetDeviceProperty(r->device, RTC_DEVICE_PROPERTY_VERSION_MAJOR),
             (int)rtcGetDeviceProperty(r->device, RTC_DEVICE_PROPERTY_VERSION_MINOR),
             (int)rtcGetDeviceProperty(r->device, RTC_DEVICE_PROPERTY_VERSION_PATCH));
    *reference = r;
    return STATUS_OK;
}

const char *reference_device(const struct reference *r)
{
    return r->device_name;
}

void reference_destroy(struct reference *r)
{
    if (!r)
        return;
    rtcReleaseDevice(r->device);
    free(r);
}

static void write_first(const struct job *job, size_t pixel,
                        const struct reference_ray_values *seen)
{
    float values[REFERENCE_RAY_VALUE_COUNT];
    memcpy(values, seen, sizeof(values));
    for (uint32_t p = 0; p < job->plane_count; p++) {
        if (!job->planes[p].mean)
            job->planes[p].texels[pixel] = values[job->planes[p].value_index];
    }
}

/* Writes a pixel of the weighted mean. */
static void write_display(const struct job *job, size_t pixel, const double *sums)
{
    const struct display *display = &job->display;
    const double alpha = sums[display->alpha_sum];
    const double factor = weighted_mean_factor(alpha, sums[display->weight_sum], job->end);
    for (uint32_t c = 0; c < 3; c++)
        display->texels[c][pixel] = (float)(sums[display->rgb_sums[c]] * factor);
    display->texels[3][pixel] = (float)(alpha / job->end);
}

static void write_means(const struct job *job, size_t pixel, const double *sums,
                        struct tally *tally)
{
    const double error = reference_sums_error(sums, job->end);
    const double remaining = reference_sums_remaining(sums, job->end);
    for (uint32_t p = 0; p < job->plane_count; p++) {
        const struct plane *plane = &job->planes[p];
        if (plane->mean)
            plane->texels[pixel] = (float)(plane->value_index == REFERENCE_RAY_VALUE_ERROR
                                               ? error
                                               : sums[plane->sum_index] / job->end);
    }
    if (job->display.texels[0])
        write_display(job, pixel, sums);
    tally->error += error;
    tally->remaining = fmax(tally->remaining, remaining);
    tally->pixels_beyond += remaining > REFERENCE_REMAINING_MAX;
}

static void trace_pixel(const struct job *job, uint32_t x, uint32_t y, struct tally *tally)
{
    const size_t pixel = (size_t)y * job->reference->request.width + x;
    double scratch[REFERENCE_VALUE_COUNT] = { 0 };
    double *sums = job->sums.sums ? &job->sums.sums[pixel * job->sums.count] : scratch;
    for (uint32_t s = job->begin; s < job->end; s++) {
        const struct embree_scene_ray ray = camera_rays_at(&job->traced.camera_rays, x, y, s);
        struct tracer tracing = job->traced.tracing;
        tracing.sample = s;
        if (job->traced.camera_rays.is_orthographic)
            whitted_find_enclosing(&tracing, ray.origin, &tracing.camera_inside);
        const struct reference_ray_values seen =
            whitted_trace(&tracing, &ray, job->traced.globals.forward, microfacet_hash(x, y));
        reference_sums_add(&job->sums, sums, &seen);
        if (s == 0)
            write_first(job, pixel, &seen);
    }
    write_means(job, pixel, sums, tally);
}

static uint32_t min_u32(uint32_t a, uint32_t b)
{
    return a < b ? a : b;
}

static void trace_tile(void *user, uint32_t tile)
{
    struct job *job = user;
    const struct reference_request *request = &job->reference->request;
    struct tally tally = { 0 };
    const uint32_t left = tile % job->tile_columns * TILE;
    const uint32_t top = tile / job->tile_columns * TILE;
    for (uint32_t y = top; y < min_u32(top + TILE, request->height); y++) {
        for (uint32_t x = left; x < min_u32(left + TILE, request->width); x++)
            trace_pixel(job, x, y, &tally);
        if (atomic_load(&job->is_stopped))
            return;
    }
    job->tallies[tile] = tally;
}

/* Reports progress to the callback, as a number of tiles from 0 to tile_count for the whole run. If
 * the callback returns false, cancels the tiles in progress. */
static bool report_tiles(void *user, uint32_t done)
{
    struct job *job = user;
    const uint64_t before = (uint64_t)job->begin * job->tile_count;
    const uint64_t now = (uint64_t)(job->end - job->begin) * done;
    const uint32_t tiles = (uint32_t)((before + now) / job->reference->request.samples);
    const bool goes_on = !job->progress || job->progress(job->user, tiles, job->tile_count);
    if (!goes_on)
        atomic_store(&job->is_stopped, true);
    return goes_on;
}

/* Returns true if sums are saved or loaded. A later run may then add PNG files. */
static bool keeps_sums(const struct job *job)
{
    return job->session->load || job->session->save;
}

static bool has_rounds(const struct job *job)
{
    const struct reference_request *request = &job->reference->request;
    return request->noise > 0.0 || request->seconds > 0.0 || keeps_sums(job);
}

/* Returns the sample count after the round that starts with `samples` samples. */
static uint32_t round_end(const struct job *job, uint32_t samples)
{
    const uint32_t samples_max = job->reference->request.samples;
    uint32_t end = 1;
    if (!has_rounds(job))
        return samples_max;
    while (end <= samples)
        end += min_u32(end, ROUND_MAX);
    return min_u32(end, samples_max);
}

static bool is_enough(const struct job *job, double began)
{
    const struct reference_request *request = &job->reference->request;
    const struct reference_outcome *outcome = &job->session->outcome;
    const uint32_t samples = outcome->samples;
    return samples >= request->samples ||
           (request->noise > 0.0 && samples >= REFERENCE_NOISE_SAMPLES &&
            outcome->noise <= request->noise) ||
           (request->seconds > 0.0 && samples && clock_seconds() - began >= request->seconds);
}

/* Sums up the tiles in a fixed order, so that `noise` does not depend on the number of threads. */
static struct reference_outcome outcome_of(const struct job *job)
{
    const double pixels = (double)job->sums.width * job->sums.height;
    struct reference_outcome outcome = { .samples = job->end };
    for (uint32_t i = 0; i < job->tile_count; i++) {
        const struct tally *tally = &job->tallies[i];
        outcome.noise += tally->error / pixels;
        outcome.remaining = fmax(outcome.remaining, tally->remaining);
        outcome.pixels_beyond += tally->pixels_beyond;
    }
    return outcome;
}

/* Renders until every pixel has `samples` samples, and updates the session's outcome. */
static enum status run_until(struct job *job, uint32_t samples)
{
    job->begin = job->sums.samples;
    job->end = samples;
    const bool goes_on = parallel_for(job->tile_count, job->reference->request.threads, trace_tile,
                                      job, report_tiles, job);
    job->sums.samples = samples;
    job->session->outcome = outcome_of(job);
    return goes_on ? STATUS_OK : STATUS_FAILED;
}

static enum status run_rounds(struct job *job)
{
    const struct reference_session *session = job->session;
    const double began = clock_seconds();
    enum status status = STATUS_OK;
    if (session->load)
        status = session->load(session->user, &job->sums);
    if (status == STATUS_OK && job->sums.samples)
        status = run_until(job, job->sums.samples);
    while (status == STATUS_OK && !is_enough(job, began)) {
        status = run_until(job, round_end(job, job->sums.samples));
        if (status == STATUS_OK && session->save)
            status = session->save(session->user, &job->sums, is_enough(job, began));
    }
    return status;
}

/* Adds the planes of a layer to the image. Returns false when out of memory. */
static bool add_layer(struct job *job, struct image *image, const struct frame_layer *layer)
{
    if (!accumulate_add_planes(image, layer))
        return false;
    for (uint32_t p = 0; p < frame_layer_plane_count(layer); p++) {
        const size_t value_index = reference_layers_find(layer->planes[p]);
        const bool is_sum = layer->mean && value_index < REFERENCE_RAY_VALUE_COUNT;
        job->planes[job->plane_count++] = (struct plane){
            .texels = image_find(image, layer->planes[p]),
            .value_index = value_index,
            .sum_index = is_sum ? reference_sums_add_value(&job->sums, (uint32_t)value_index) : 0,
            .mean = layer->mean,
        };
        if (!layer->mean)
            reference_sums_add_first(&job->sums, (uint32_t)value_index,
                                     image_find(image, layer->planes[p]));
    }
    return true;
}

/* Adds the sums of the weighted mean. */
static void add_display_sums(struct job *job)
{
    struct display *display = &job->display;
    for (uint32_t c = 0; c < 3; c++)
        display->rgb_sums[c] = reference_sums_add_value(&job->sums, REFERENCE_SUM_DISPLAY + c);
    display->alpha_sum = reference_sums_add_value(&job->sums, (uint32_t)reference_layers_find("A"));
    display->weight_sum = reference_sums_add_value(&job->sums, REFERENCE_SUM_WEIGHT);
}

/* Adds the planes of the weighted mean. Returns false when out of memory. */
static bool add_display(struct job *job, struct image *image)
{
    const bool done = accumulate_add_planes(image, &frame_beauty);
    for (uint32_t c = 0; c < 4 && done; c++)
        job->display.texels[c] = image_find(image, frame_beauty.planes[c]);
    return done;
}

/* Allocates the image's planes, sums and tile statistics. Returns false when out of memory. */
static bool add_layers(struct job *job, struct render_result *result)
{
    const struct reference_request *request = &job->reference->request;
    const bool is_shown = request->display || request->resolved;
    const float scale = weighted_mean_scale(request->settings);
    const bool is_weighted = is_shown && request->samples > 1 && scale > 0.0f;
    struct image *image = &result->image;
    bool done = true;
    image_init(image, request->width, request->height);
    image_init(&result->display, request->width, request->height);
    reference_sums_init(&job->sums, request->width, request->height);
    job->sums.weight_scale = scale;
    if (scale > 0.0f && (is_weighted || keeps_sums(job)))
        add_display_sums(job);
    if (is_weighted)
        done = add_display(job, &result->display);
    if (request->linear || (is_shown && !is_weighted))
        done = done && add_layer(job, image, &frame_beauty);
    for (uint32_t i = 0; techniques_layer(i); i++) {
        if (request->layers & UINT64_C(1) << i && reference_has_layer(techniques_layer(i)))
            done = done && add_layer(job, image, techniques_layer(i));
    }
    job->tile_columns = (request->width + TILE - 1) / TILE;
    job->tile_count = job->tile_columns * ((request->height + TILE - 1) / TILE);
    job->tallies = calloc(job->tile_count, sizeof(*job->tallies));
    return done && job->tallies && (!has_rounds(job) || reference_sums_allocate(&job->sums));
}

/* Reports that no tile is done while the photon map is built. */
static bool report_photons(void *user, uint32_t done)
{
    const struct job *job = user;
    (void)done;
    return !job->progress || job->progress(job->user, 0, job->tile_count);
}

/* Builds the photon map if the rasteriser would render caustics with these settings. */
static enum status trace_photons(struct job *job)
{
    const struct settings *settings = job->reference->request.settings;
    const struct ice_caustics_params *light = settings_of(settings, &ice_caustics_settings);
    const struct caustics_params *pool = settings_of(settings, &caustics_settings);
    const bool has_pool = job->reference->request.scene->has_pool;
    const struct photons_params params = {
        .count = job->traced.tracing.params.photons,
        .sun_deg = pool->sun,
        .has_shadow = light->shadow || has_pool,
        .threads = job->reference->request.threads,
        .progress = report_photons,
        .user = job,
    };
    if (!(has_pool ? caustics_are_lit(settings) : ice_caustics.is_on(settings)) || !params.count ||
        !(glms_vec3_max(job->traced.globals.sun_light) > 0.0f))
        return STATUS_OK;
    const enum status status = photons_init(&job->photons, &job->traced.tracing, &params);
    job->traced.tracing.photons = status == STATUS_OK ? &job->photons : NULL;
    return status;
}

static enum status trace(struct job *job, const struct renderer_shot *shot)
{
    const struct reference_request *request = &job->reference->request;
    const struct traced_scene_params params = {
        .scene = request->scene,
        .settings = request->settings,
        .width = request->width,
        .height = request->height,
        .filter = request->filter,
        .device = job->reference->device,
        .memory = request->memory,
    };
    enum status status = traced_scene_init(&job->traced, &params, shot);
    job->traced.tracing.has_layers = request->layers != 0;
    if (status == STATUS_OK)
        status = trace_photons(job);
    if (status == STATUS_OK) {
        whitted_find_enclosing(&job->traced.tracing, job->traced.camera_rays.push.eye,
                               &job->traced.tracing.camera_inside);
        status = run_rounds(job);
    }
    photons_finish(&job->photons);
    traced_scene_finish(&job->traced);
    return status;
}

/* Returns the tone-mapped image as RGBA, or NULL when out of memory. */
static uint8_t *make_display(const struct job *job, const struct image *image)
{
    const struct tonemap_params params = tonemap_params_of(job->reference->request.settings);
    const size_t count = (size_t)image->width * image->height;
    const float *planes[3];
    for (int c = 0; c < 3; c++)
        planes[c] = image_find(image, frame_beauty.planes[c]);
    uint8_t *rgba = malloc(count * 4);
    for (size_t i = 0; rgba && i < count; i++) {
        const vec3s radiance = { { planes[0][i], planes[1][i], planes[2][i] } };
        const vec3s encoded = tonemap_encode(radiance, params);
        for (int c = 0; c < 3; c++)
            rgba[i * 4 + (size_t)c] = (uint8_t)lrintf(encoded.raw[c] * 255.0f);
        rgba[i * 4 + 3] = 255;
    }
    return rgba;
}

enum status reference_continue(struct reference *r, const struct renderer_shot *shot,
                               struct render_result *result, struct reference_session *session,
                               renderer_progress_fn *progress, void *user)
{
    struct job *job = calloc(1, sizeof(*job));
    enum status status = STATUS_TRY_AGAIN;
    *result = (struct render_result){ 0 };
    session->outcome = (struct reference_outcome){ 0 };
    if (job) {
        job->reference = r;
        job->session = session;
        job->progress = progress;
        job->user = user;
    }
    bool has_memory = job && add_layers(job, result);
    if (has_memory)
        status = trace(job, shot);
    if (status == STATUS_OK && result->display.planes &&
        weighted_mean_is_filtered(r->request.settings))
        has_memory = weighted_mean_filter(&result->display, job->sums.weight_scale);
    if (status == STATUS_OK && has_memory && r->request.display) {
        result->rgba = make_display(job, render_result_display(result));
        has_memory = result->rgba != NULL;
    }
    if (!has_memory) {
        status = log_out_of_memory(NULL);
    }
    if (job) {
        reference_sums_finish(&job->sums);
        free(job->tallies);
    }
    free(job);
    if (status != STATUS_OK)
        render_result_finish(result);
    return status;
}

enum status reference_render(struct reference *r, const struct renderer_shot *shot,
                             struct render_result *result, renderer_progress_fn *progress,
                             void *user)
{
    struct reference_session session = { 0 };
    return reference_continue(r, shot, result, &session, progress, user);
}
