/*
 * reference.h: the path tracer that renders reference images, on the CPU with Embree.
 *
 *     reference_create()    checks the build and the CPU
 *     reference_render()    renders all samples of an image
 *     reference_continue()  renders until a noise or time limit, resumes, and reports the noise
 *
 * Supported: the object as a smooth or rough dielectric (refract.ior, refract.dispersion, absorb.*)
 * with bubbles, cracks, air, bumps and frost; surroundings, moving objects, caustics of the sun,
 * sky, environment map or plain colour. Sample positions are those of the renderer. Not supported:
 * specular highlights of lights. Rays intersect the surroundings instead of sampling an environment
 * cube, and reflectance follows the exact Fresnel equations, so env_cube.*, refract.fresnel and
 * refract.lookup have no effect. whitted.h describes the method and its errors.
 *
 * Images are bit-identical for any number of threads, and no matter how their number of samples was
 * reached: by request, by a noise or time limit, in one run or several.
 *
 * Ownership: scene and settings are borrowed and must outlive the reference.
 * Errors:    logged once where found; STATUS_NO_DEVICE (built without Embree, or the CPU is too old
 * for it), STATUS_TRY_AGAIN (out of memory or threads).
 */
#ifndef FIRN_REFERENCE_REFERENCE_H
#define FIRN_REFERENCE_REFERENCE_H

#include "src/render/renderer.h"

/* Returns true if this build contains the path tracer. */
bool reference_is_built(void);

struct reference_request {
    const struct scene *scene;
    const struct settings *settings;
    uint32_t width, height; /* pixels */
    uint32_t samples;       /* samples per pixel, upper limit; 0 means 1 */
    double noise;           /* stop when the noise is at or below this; 0 to render all samples */
    double seconds;         /* start no further round of samples after this time; 0 for no limit */
    enum pixel_filter filter;
    uint32_t layers;  /* bit i: techniques_layer(i); needs reference_has_layer() */
    bool linear;      /* return linear radiance in render_result.image */
    bool display;     /* return the tone-mapped image in render_result.rgba */
    uint32_t threads; /* 0 for one per core */
    uint64_t memory;  /* limit for the triangles in bytes; 0 for the machine's memory */
};

struct reference;

/* Creates a path tracer. On failure *reference is NULL. */
MUST_USE enum status reference_create(struct reference **reference,
                                      const struct reference_request *request);

/*
 * Renders an image. *result must be {0} or finished; on failure it is {0}. The calling thread calls
 * `progress`, which may be NULL, now and then with the number of finished tiles and of all tiles.
 * If `progress` returns false, all threads stop within a row of pixels, and the result is
 * STATUS_FAILED without a message.
 */
MUST_USE enum status reference_render(struct reference *reference, const struct renderer_shot *shot,
                                      struct render_result *result, renderer_progress_fn *progress,
                                      void *user);

/*
 * Samples are rendered in rounds, which end after 1, 2, 4, 8, 16, 32, 48, ... samples per pixel.
 * Limits are checked between rounds. The noise of an image is the mean standard error of its pixels
 * (reference_sample_sums.h). The estimate is too uncertain to stop at with fewer than
 * REFERENCE_NOISE_SAMPLES samples.
 */
enum {
    REFERENCE_NOISE_SAMPLES = 8
};

/* A pixel deserves a warning if terminated rays carry more than this fraction of its light. */
#define REFERENCE_REMAINING_MAX 0.05

/* The result of a run: samples, noise and truncated light. */
struct reference_outcome {
    uint32_t samples;       /* per pixel */
    double noise;           /* mean standard error; REFERENCE_ERROR_UNKNOWN for a single sample */
    double remaining;       /* largest pixel mean of the layer `remaining` */
    uint64_t pixels_beyond; /* pixels whose `remaining` exceeds REFERENCE_REMAINING_MAX */
};

struct reference_sums;

/* Loads the sums of previous runs into `sums`, initially 0, and sets their number of samples. */
typedef enum status reference_load_fn(void *user, struct reference_sums *sums);

/* Called with the sums after each round. A failure ends the rendering. */
typedef enum status reference_keep_fn(void *user, const struct reference_sums *sums, bool is_last);

/* One run of an image that may be rendered over several runs. */
struct reference_session {
    reference_load_fn *load; /* loads the sums of previous runs; NULL to start from nothing */
    reference_keep_fn *keep; /* saves the sums after each round; may be NULL */
    void *user;              /* argument of both callbacks */
    struct reference_outcome outcome;
};

/* Renders as reference_render() does, until a limit of the request; fills session->outcome. */
MUST_USE enum status reference_continue(struct reference *reference,
                                        const struct renderer_shot *shot,
                                        struct render_result *result,
                                        struct reference_session *session,
                                        renderer_progress_fn *progress, void *user);

/* Returns name and version of the ray tracing library, "Embree 3.13.5"; owned by the reference. */
const char *reference_device(const struct reference *reference);

void reference_destroy(struct reference *reference); /* may be NULL */

#endif
