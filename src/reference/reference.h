/*
 * reference.h: reference pictures, traced on the CPU without a device.
 *
 *     reference_create()    checks the build and the CPU
 *     reference_render()    traces all samples of a picture
 *     reference_continue()  traces some of them, and says how exact it is
 *
 * Traced are the object as a smooth dielectric (refract.ior, refract.dispersion, absorb.*), its
 * bubbles, cracks, air, bumps, frost and surroundings, moving objects, the sun's light through the
 * object, sky, environment image or colour, with the renderer's sample positions. Not traced are
 * highlights of lights. Rays intersect the surroundings instead of looking up a cube, and
 * reflectance is that of Fresnel's equations: env_cube.*, refract.fresnel and refract.lookup have
 * no effect. whitted.h describes the method and its errors.
 *
 * Equal pictures have equal bytes for any number of threads, and however their number of samples
 * was reached: as asked for, by a limit of noise or time, in one run or several.
 *
 * Ownership: scene and settings are borrowed and must outlive the reference.
 * Errors:    logged once where found; STATUS_NO_DEVICE (built without Embree, or the CPU is too
 *            old for it), STATUS_TRY_AGAIN (out of memory or threads).
 */
#ifndef FIRN_REFERENCE_REFERENCE_H
#define FIRN_REFERENCE_REFERENCE_H

#include "src/render/renderer.h"

/* Returns whether this build can trace. */
bool reference_is_built(void);

struct reference_request {
    const struct scene *scene;
    const struct settings *settings;
    uint32_t width, height; /* pixels */
    uint32_t samples;       /* per pixel, at most; 0 means 1 */
    double noise;           /* it ends once its noise is no larger; 0: after all samples */
    double seconds;         /* no round of samples begins later than so long; 0: no limit */
    enum pixel_filter filter;
    uint32_t layers;  /* bit i: techniques_layer(i), for which reference_makes() is true */
    bool linear;      /* return the beauty in render_result.image */
    bool display;     /* return the tonemapped picture in render_result.rgba */
    uint32_t threads; /* 0: one for each core */
    uint64_t memory;  /* limit of the triangles' bytes; 0: the machine's memory */
};

struct reference;

/* Creates a reference; on failure *reference is NULL. */
MUST_USE enum status reference_create(struct reference **reference,
                                      const struct reference_request *request);

/*
 * Traces a shot. *result must be {0} or finished; on failure it is {0}. The calling thread calls
 * `progress`, which may be NULL, from time to time with the number of finished tiles and of all
 * tiles. If it returns false, all threads stop within a row of pixels, and the result is
 * STATUS_FAILED without a message.
 */
MUST_USE enum status reference_render(struct reference *reference, const struct renderer_shot *shot,
                                      struct render_result *result, renderer_progress_fn *progress,
                                      void *user);

/*
 * Samples are traced in rounds: after 1, 2, 4, 8, 16, 32, 48, ... samples of all pixels it may end.
 * The noise of a picture is the mean of its pixels' standard errors (reference_sums.h). With less
 * than REFERENCE_NOISE_SAMPLES samples it is too uncertain to end by.
 */
enum {
    REFERENCE_NOISE_SAMPLES = 8
};

/* From this share on, light that was not followed is worth a warning. */
#define REFERENCE_REMAINING_MAX 0.05

/* What has come of a picture. */
struct reference_outcome {
    uint32_t samples;       /* per pixel */
    double noise;           /* of 1 sample it is not known: REFERENCE_ERROR_UNKNOWN */
    double remaining;       /* the largest mean of a pixel's layer `remaining` */
    uint64_t pixels_beyond; /* pixels in which that is more than REFERENCE_REMAINING_MAX */
};

struct reference_sums;

/* Fills the sums, which are 0, and their number of samples, at most the request's. */
typedef enum status reference_load_fn(void *user, struct reference_sums *sums);

/* Is given the sums after each round; a failure ends the picture. */
typedef enum status reference_keep_fn(void *user, const struct reference_sums *sums, bool is_last);

/* One run of a picture, which may take several. */
struct reference_session {
    reference_load_fn *load; /* what runs before have summed; NULL: nothing */
    reference_keep_fn *keep; /* may be NULL */
    void *user;              /* of both */
    struct reference_outcome outcome;
};

/* Traces a shot as reference_render() does, until the first of the request's limits, and fills
 * session->outcome. */
MUST_USE enum status reference_continue(struct reference *reference,
                                        const struct renderer_shot *shot,
                                        struct render_result *result,
                                        struct reference_session *session,
                                        renderer_progress_fn *progress, void *user);

/* Returns the name of the tracer, "Embree 3.13.5", owned by the reference. */
const char *reference_device(const struct reference *reference);

void reference_destroy(struct reference *reference); /* may be NULL */

#endif
