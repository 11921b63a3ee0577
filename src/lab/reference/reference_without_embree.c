/* reference_without_embree.c: stubs of reference.c and ray_layer_tracer.c for builds without
 * Embree; every call fails. */
#include "src/base/log.h"
#include "src/lab/reference/ray_layer_tracer.h"
#include "src/lab/reference/reference.h"

bool reference_is_built(void)
{
    return false;
}

enum status reference_create(struct reference **reference, const struct reference_request *request)
{
    (void)request;
    *reference = NULL;
    log_error("--refraction reference: this build has no Embree (install libembree-dev, then meson "
              "setup --reconfigure -Dreference=enabled)");
    return STATUS_NO_DEVICE;
}

enum status reference_render(struct reference *reference, const struct renderer_shot *shot,
                             struct render_result *result, renderer_progress_fn *progress,
                             void *user)
{
    (void)reference;
    (void)shot;
    (void)progress;
    (void)user;
    *result = (struct render_result){ 0 };
    return STATUS_NO_DEVICE;
}

enum status reference_continue(struct reference *reference, const struct renderer_shot *shot,
                               struct render_result *result, struct reference_session *session,
                               renderer_progress_fn *progress, void *user)
{
    session->outcome = (struct reference_outcome){ 0 };
    return reference_render(reference, shot, result, progress, user);
}

const char *reference_device(const struct reference *reference)
{
    (void)reference;
    return "";
}

void reference_destroy(struct reference *reference)
{
    (void)reference;
}

uint64_t ray_layer_tracer_mask(uint64_t layers)
{
    (void)layers;
    return 0;
}

enum status ray_layer_tracer_create(struct ray_layer_tracer **tracer,
                                    const struct renderer_params *params, const char *objects,
                                    const char *materials)
{
    (void)params;
    (void)objects;
    (void)materials;
    *tracer = NULL;
    return STATUS_NO_DEVICE;
}

enum status ray_layer_tracer_draw(struct ray_layer_tracer *tracer, const struct renderer_shot *shot,
                                  struct image *image)
{
    (void)tracer;
    (void)shot;
    (void)image;
    return STATUS_NO_DEVICE;
}

void ray_layer_tracer_destroy(struct ray_layer_tracer *tracer)
{
    (void)tracer;
}
