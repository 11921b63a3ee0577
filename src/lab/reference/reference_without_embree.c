/* reference_without_embree.c: stub of reference.c for builds without Embree; every call fails. */
#include "src/base/log.h"
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
