/* reference.c: traces the tiles of a picture with many threads. */
#include "src/reference/reference.h"
#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>
#include "shaders/tonemap.h"
#include "src/base/log.h"
#include "src/frame/view.h"
#include "src/reference/microfacet.h"
#include "src/reference/reference_layers.h"
#include "src/reference/whitted.h"
#include "src/render/accumulate.h"
#include "src/tech/tonemap.h"

enum {
    TILE = 16, /* pixels a side */
    THREAD_COUNT_MAX = 256,
    PLANE_COUNT_MAX = 4 * (FRAME_LAYER_MAX + 1),
};

struct reference {
    struct reference_request request;
    RTCDevice device;
    char device_name[32];
};

/* A plane of the image, and the value that it receives. */
struct plane {
    float *texels;
    size_t seen_index;
    bool mean; /* the mean of all samples, else sample 0, the pixel's centre */
};

/* A picture in progress, shared by the threads. */
struct job {
    const struct reference *reference;
    struct radiance radiance;
    struct globals globals;
    struct background_push push;
    struct bvh bvh;
    struct media media;
    struct whitted whitted;
    struct plane planes[PLANE_COUNT_MAX];
    uint32_t plane_count;
    uint32_t tile_columns, tile_count;
    atomic_uint next_tile, done_count;
    atomic_bool is_stopped;
};

/* ---- creation ---- */

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
    r->device = rtcNewDevice(NULL);
    if (!r->device) {
        const bool is_old = rtcGetDeviceError(NULL) == RTC_ERROR_UNSUPPORTED_CPU;
        log_error("--refraction reference: %s",
                  is_old ? "expected a CPU with SSE4.2, which Embree needs; use another rung"
                         : "out of memory");
        free(r);
        return is_old ? STATUS_NO_DEVICE : STATUS_TRY_AGAIN;
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

/* ---- a pixel ---- */

static struct bvh_ray ray_of(const struct job *job, uint32_t x, uint32_t y, vec2s jitter)
{
    const struct background_push *push = &job->push;
    const struct reference_request *request = &job->reference->request;
    const float right = 2.0f * ((float)x + 0.5f + jitter.x) / (float)request->width - 1.0f;
    const float down = 2.0f * ((float)y + 0.5f + jitter.y) / (float)request->height - 1.0f;
    const vec3s along =
        glms_vec3_muladds(push->up, -down, glms_vec3_muladds(push->right, right, push->forward));
    const vec3s dir = glms_vec3_normalize(along);
    return (struct bvh_ray){
        .origin = push->eye,
        .dir = dir,
        .near = scene_near_plane(request->scene) / glms_vec3_dot(dir, job->globals.forward),
        .from = BVH_NOWHERE,
    };
}

static void trace_pixel(const struct job *job, uint32_t x, uint32_t y)
{
    const uint32_t samples = job->reference->request.samples;
    const enum pixel_filter filter = job->reference->request.filter;
    const size_t pixel = (size_t)y * job->reference->request.width + x;
    double sums[REFERENCE_SEEN_COUNT] = { 0 };
    float first[REFERENCE_SEEN_COUNT];
    for (uint32_t s = 0; s < samples; s++) {
        const struct bvh_ray ray = ray_of(job, x, y, accumulate_offset(filter, s));
        struct whitted whitted = job->whitted;
        whitted.sample = s;
        const struct reference_seen seen =
            whitted_trace(&whitted, &ray, job->globals.forward, microfacet_hash(x, y));
        float values[REFERENCE_SEEN_COUNT];
        memcpy(values, &seen, sizeof(values));
        for (size_t i = 0; i < REFERENCE_SEEN_COUNT; i++)
            sums[i] += (double)values[i];
        if (s == 0)
            memcpy(first, values, sizeof(first));
    }
    for (uint32_t p = 0; p < job->plane_count; p++) {
        const struct plane *plane = &job->planes[p];
        plane->texels[pixel] =
            plane->mean ? (float)(sums[plane->seen_index] / samples) : first[plane->seen_index];
    }
}

/* ---- tiles ---- */

static uint32_t least(uint32_t a, uint32_t b)
{
    return a < b ? a : b;
}

/* Traces the next tile. Returns false if there is none left, or the picture is stopped. */
static bool trace_tile(struct job *job)
{
    const struct reference_request *request = &job->reference->request;
    const uint32_t tile = atomic_fetch_add(&job->next_tile, 1);
    if (tile >= job->tile_count)
        return false;
    const uint32_t left = tile % job->tile_columns * TILE;
    const uint32_t top = tile / job->tile_columns * TILE;
    for (uint32_t y = top; y < least(top + TILE, request->height); y++) {
        for (uint32_t x = left; x < least(left + TILE, request->width); x++)
            trace_pixel(job, x, y);
        if (atomic_load(&job->is_stopped))
            return false;
    }
    atomic_fetch_add(&job->done_count, 1);
    return true;
}

static void *work(void *user)
{
    while (trace_tile(user)) {
    }
    return NULL;
}

static uint32_t thread_count(const struct reference_request *request)
{
    const long cores = sysconf(_SC_NPROCESSORS_ONLN);
    const uint32_t wanted = request->threads ? request->threads : (uint32_t)(cores > 0 ? cores : 1);
    return least(wanted, THREAD_COUNT_MAX);
}

/* Traces all tiles. The calling thread traces, too, and reports the progress of all threads; if
 * threads cannot be created, there are fewer. */
static enum status run(struct job *job, renderer_progress_fn *progress, void *user)
{
    pthread_t threads[THREAD_COUNT_MAX];
    const uint32_t wanted = thread_count(&job->reference->request) - 1;
    uint32_t count = 0;
    while (count < wanted && !pthread_create(&threads[count], NULL, work, job))
        count++;
    while (trace_tile(job)) {
        if (progress && !progress(user, atomic_load(&job->done_count), job->tile_count))
            atomic_store(&job->is_stopped, true);
    }
    for (uint32_t i = 0; i < count; i++)
        pthread_join(threads[i], NULL);
    return atomic_load(&job->is_stopped) ? STATUS_FAILED : STATUS_OK;
}

/* ---- a picture ---- */

/* Adds the planes of a layer. Returns false when out of memory. */
static bool add_layer(struct job *job, struct image *image, const struct frame_layer *layer)
{
    if (!accumulate_add_planes(image, layer))
        return false;
    for (size_t p = 0; p < 4 && layer->planes[p]; p++) {
        job->planes[job->plane_count++] = (struct plane){
            .texels = image_find(image, layer->planes[p]),
            .seen_index = reference_layers_find(layer->planes[p]),
            .mean = layer->mean,
        };
    }
    return true;
}

static bool add_layers(struct job *job, struct image *image)
{
    const struct reference_request *request = &job->reference->request;
    bool done = true;
    image_init(image, request->width, request->height);
    if (request->linear || request->display)
        done = add_layer(job, image, &frame_beauty);
    for (uint32_t i = 0; techniques_layer(i); i++) {
        if (request->layers & 1u << i && reference_makes(techniques_layer(i)))
            done = done && add_layer(job, image, techniques_layer(i));
    }
    return done;
}

static uint64_t memory_of(const struct reference_request *request)
{
    const long pages = sysconf(_SC_PHYS_PAGES);
    const long page = sysconf(_SC_PAGESIZE);
    struct rlimit limit = { .rlim_cur = RLIM_INFINITY };
    if (request->memory)
        return request->memory;
    uint64_t memory = pages > 0 && page > 0 ? (uint64_t)pages * (uint64_t)page : UINT64_MAX;
    if (!getrlimit(RLIMIT_AS, &limit) && limit.rlim_cur < memory)
        memory = limit.rlim_cur;
    return memory;
}

static struct whitted tree_of(const struct job *job)
{
    const struct reference_params *params =
        settings_of(job->reference->request.settings, &reference_settings);
    return (struct whitted){
        .bvh = &job->bvh,
        .radiance = &job->radiance,
        .media = &job->media,
        .params = *params,
    };
}

static enum status trace(struct job *job, const struct renderer_shot *shot,
                         renderer_progress_fn *progress, void *user)
{
    const struct reference_request *request = &job->reference->request;
    const struct frame_view view = {
        .scene = request->scene,
        .settings = request->settings,
        .camera = shot->camera,
        .time = shot->time,
        .width = request->width,
        .height = request->height,
    };
    job->push = frame_view_push(&view);
    job->globals = frame_view_globals(&view, &job->push);
    job->radiance = radiance_of(request->scene, &job->globals);
    job->whitted = tree_of(job);
    job->tile_columns = (request->width + TILE - 1) / TILE;
    job->tile_count = job->tile_columns * ((request->height + TILE - 1) / TILE);
    if (!media_init(&job->media, request->scene, request->settings))
        return log_out_of_memory("objects");
    enum status status =
        bvh_init(&job->bvh, job->reference->device, &job->radiance, memory_of(request));
    if (status == STATUS_OK) {
        whitted_immerse(&job->whitted, job->push.eye, &job->whitted.eye_inside);
        status = run(job, progress, user);
    }
    media_finish(&job->media);
    bvh_finish(&job->bvh);
    return status;
}

/* Returns the tonemapped picture, or NULL when out of memory. */
static uint8_t *make_display(const struct job *job, const struct image *image)
{
    const struct tonemap_params *params =
        settings_of(job->reference->request.settings, &tonemap_settings);
    const float gain = exp2f(params->exposure);
    const size_t count = (size_t)image->width * image->height;
    const float *planes[3];
    for (int c = 0; c < 3; c++)
        planes[c] = image_find(image, frame_beauty.planes[c]);
    uint8_t *rgba = malloc(count * 4);
    for (size_t i = 0; rgba && i < count; i++) {
        const vec3s radiance = { { planes[0][i], planes[1][i], planes[2][i] } };
        const vec3s encoded = tonemap_encode(radiance, gain, params->curve);
        for (int c = 0; c < 3; c++)
            rgba[i * 4 + (size_t)c] = (uint8_t)lrintf(encoded.raw[c] * 255.0f);
        rgba[i * 4 + 3] = 255;
    }
    return rgba;
}

enum status reference_render(struct reference *r, const struct renderer_shot *shot,
                             struct render_result *result, renderer_progress_fn *progress,
                             void *user)
{
    struct job *job = calloc(1, sizeof(*job));
    enum status status = STATUS_TRY_AGAIN;
    *result = (struct render_result){ 0 };
    if (job)
        job->reference = r;
    bool has_memory = job && add_layers(job, &result->image);
    if (has_memory)
        status = trace(job, shot, progress, user);
    if (status == STATUS_OK && r->request.display) {
        result->rgba = make_display(job, &result->image);
        has_memory = result->rgba != NULL;
    }
    if (!has_memory) {
        status = log_out_of_memory(NULL);
    }
    free(job);
    if (status != STATUS_OK)
        render_result_finish(result);
    return status;
}
