/*
 * reference.h: the truth: pictures traced on the CPU, with no device; beside renderer.h.
 *
 *     reference_create()   looks for what it needs
 *     reference_render()   traces all samples of a picture
 *
 * What is traced: the object as a smooth dielectric (refract.ior, refract.dispersion, absorb.*),
 * its surroundings, what moves, sky, environment picture or colour, from the very samples that the
 * renderer draws. What is not: cracks, air, bubbles, bumps, frost, highlights of lights. The
 * environment is met where it is, not looked up in a cube, and reflection is by Fresnel's
 * equations: env_cube.*, refract.fresnel and refract.lookup have no effect. whitted.h says how, and
 * where it is not exact.
 *
 * The same picture gives the same bytes, whatever the number of threads.
 *
 * Ownership: scene and settings are borrowed and outlive the reference.
 * Errors:    logged once where found; STATUS_NO_DEVICE (built without Embree, or the CPU is too
 *            old for it), STATUS_TRY_AGAIN (memory, threads).
 */
#ifndef FIRN_REFERENCE_REFERENCE_H
#define FIRN_REFERENCE_REFERENCE_H

#include "src/render/renderer.h"

/* As --refraction names it. It has no techniques, and so no plan. */

/* Whether this build can trace. */
bool reference_is_built(void);

struct reference_request {
    const struct scene *scene;
    const struct settings *settings;
    uint32_t width, height; /* pixels */
    uint32_t samples;       /* a pixel; 0 means 1 */
    uint32_t layers;        /* bit i: techniques_layer(i), one that it makes */
    bool linear;            /* the beauty, in render_result.image */
    bool display;           /* the tonemapped picture, in render_result.rgba */
    uint32_t threads;       /* 0: one for each core */
    uint64_t memory;        /* bytes that the triangles may take; 0: those of the machine */
};

struct reference;

MUST_USE enum status reference_create(struct reference **reference,
                                      const struct reference_request *request);

/*
 * *result must be {0} or finished; on failure it is {0}. `progress`, which may be NULL, is called
 * by the calling thread, now and then, with the tiles that are done and all there are; false stops
 * the other threads within a row of pixels: STATUS_FAILED, nothing logged.
 */
MUST_USE enum status reference_render(struct reference *reference, const struct renderer_shot *shot,
                                      struct render_result *result, renderer_progress_fn *progress,
                                      void *user);

/* "Embree 3.13.5", what made the picture; the reference owns it. */
const char *reference_device(const struct reference *reference);

void reference_destroy(struct reference *reference); /* may be NULL */

#endif
