/*
 * reference.h: path tracer for reference images, on the CPU with Embree. whitted.h describes the
 * method and its errors.
 *
 * Supported: objects as smooth or rough dielectrics (refract.ior, refract.dispersion, absorb.*)
 * with bubbles, cracks, air, bumps and frost; surroundings, moving objects, caustics of the sun,
 * sky, environment map or plain colour. Sample positions are the renderer's. Not supported:
 * specular highlights of lights. Rays intersect the surroundings instead of sampling an environment
 * cube, and reflectance follows the exact Fresnel equations, so env_cube.*, refract.fresnel and
 * refract.lookup have no effect.
 *
 * Images are bit-identical for any number of threads, and however their samples were reached: by
 * request, by a noise or time limit, in one run or several.
 *
 * Ownership: scene and settings are borrowed and must outlive the reference. Errors are logged
 * once: STATUS_NO_DEVICE (built without Embree, or the CPU is too old for it), STATUS_TRY_AGAIN
 * (out of memory or threads).
 */
#ifndef FIRN_LAB_REFERENCE_REFERENCE_H
#define FIRN_LAB_REFERENCE_REFERENCE_H

#include "src/render/renderer.h"

/* Returns true if this build contains the path tracer. */
bool reference_is_built(void);

struct reference_request {
    const struct scene *scene;
    const struct settings *settings;
    uint32_t width, height; /* pixels */
    uint32_t samples;       /* samples per pixel; 0 means 1 */
    double noise;           /* noise limit; 0 for none */
    double seconds;         /* time limit; 0 for none */
    enum pixel_filter filter;
    uint64_t layers;  /* bit i requests techniques_layer(i) */
    bool linear;      /* return linear radiance in render_result.image */
    bool display;     /* return tone-mapped image in render_result.rgba */
    bool resolved;    /* return the mean for display: render_result_display() */
    uint32_t threads; /* 0 for one per core */
    uint64_t memory;  /* triangle memory limit; 0 for RAM */
};

struct reference;

/* Creates a path tracer. On failure *reference is NULL. */
MUST_USE enum status reference_create(struct reference **reference,
                                      const struct reference_request *request);

/*
 * Renders an image. *result must own no memory; on failure, *result is zeroed. The calling thread
 * regularly calls `progress`, which may be NULL, with the numbers of finished and of all tiles. If
 * `progress` returns false, rendering stops with STATUS_FAILED and without a log message.
 */
MUST_USE enum status reference_render(struct reference *reference, const struct renderer_shot *shot,
                                      struct render_result *result, renderer_progress_fn *progress,
                                      void *user);

/*
 * The noise limit is not checked below this number of samples per pixel. Limits are checked between
 * rounds, which end after 1, 2, 4, 8, 16, 32, 48, ... samples per pixel. The noise of an image is
 * the mean standard error of its pixels.
 */
enum {
    REFERENCE_NOISE_SAMPLES = 8
};

/* Maximum mean throughput of a pixel's terminated rays. Pixels above it cause a warning. */
#define REFERENCE_REMAINING_MAX 0.05

/* Result of a run: samples, noise, and light lost in terminated rays. */
struct reference_outcome {
    uint32_t samples;       /* per pixel */
    double noise;           /* mean standard error, or REFERENCE_ERROR_UNKNOWN */
    double remaining;       /* maximum of the layer `remaining` */
    uint64_t pixels_beyond; /* pixels above REFERENCE_REMAINING_MAX */
};

struct reference_sums;

/* Callback that loads the sums of previous runs into `sums`, including their sample count. */
typedef enum status reference_load_fn(void *user, struct reference_sums *sums);

/* Callback that saves the sums after each round. A failure ends the rendering. */
typedef enum status reference_save_fn(void *user, const struct reference_sums *sums, bool is_last);

/* Rendering session for an image whose samples may come from several runs. */
struct reference_session {
    reference_load_fn *load; /* NULL to start without samples */
    reference_save_fn *save; /* may be NULL */
    void *user;              /* argument of both callbacks */
    struct reference_outcome outcome;
};

/* Renders like reference_render(), but also loads and saves sums and fills session->outcome. */
MUST_USE enum status reference_continue(struct reference *reference,
                                        const struct renderer_shot *shot,
                                        struct render_result *result,
                                        struct reference_session *session,
                                        renderer_progress_fn *progress, void *user);

/* Returns the library and its version, such as "Embree 3.13.5". `reference` owns the text. */
const char *reference_device(const struct reference *reference);

void reference_destroy(struct reference *reference); /* may be NULL */

#endif
