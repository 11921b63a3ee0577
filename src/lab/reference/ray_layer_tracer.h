/*
 * ray_layer_tracer.h: traces the layers of src/tech/output/ray_layers.h with Embree, by one ray
 * through each pixel centre. They do not depend on the refraction model, the samples or the lens,
 * except Cryptomattes, for which the first surface of every sample is found.
 *
 * Thread safety: one thread at a time per tracer.
 */
#ifndef FIRN_LAB_REFERENCE_RAY_LAYER_TRACER_H
#define FIRN_LAB_REFERENCE_RAY_LAYER_TRACER_H

#include "src/render/renderer.h"

/* Returns those layers of a mask that this tracer computes. Bit i is techniques_layer(i). */
uint64_t ray_layer_tracer_mask(uint64_t layers);

struct ray_layer_tracer;

/*
 * Creates a tracer for an image. Uses scene, settings, size, tiles, samples and filter of `params`,
 * and those layers that ray_layer_tracer_mask() selects. Scene and settings are borrowed. `objects`
 * and `materials` are the names of src/setup/object_id_names.h; they are copied.
 *
 * On failure, logs an error and sets *tracer to NULL. Returns STATUS_NO_DEVICE if the build or the
 * CPU cannot use Embree, STATUS_TRY_AGAIN when out of memory.
 */
MUST_USE enum status ray_layer_tracer_create(struct ray_layer_tracer **tracer,
                                             const struct renderer_params *params,
                                             const char *objects, const char *materials);

/* Adds the planes of all layers to the image or tile of a shot. The Embree scene is kept for the
 * next shot unless objects move. Returns STATUS_TRY_AGAIN when out of memory. */
MUST_USE enum status ray_layer_tracer_draw(struct ray_layer_tracer *tracer,
                                           const struct renderer_shot *shot, struct image *image);

void ray_layer_tracer_destroy(struct ray_layer_tracer *tracer); /* may be NULL */

#endif
