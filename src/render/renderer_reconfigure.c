/* renderer_reconfigure.c: switches a renderer to other params, keeping resources still needed. */
#include <stdlib.h>
#include "src/base/log.h"
#include "src/render/make_frame_request.h"
#include "src/render/renderer_internal.h"

/* Replaces the plan of compiled_frame by one compiled from the request. */
static enum status replace(struct renderer *r, struct compiled_frame *compiled_frame,
                           struct frame_request request)
{
    struct compiled_frame next = { 0 };
    enum status status = compiled_frame_compile(&next, &r->params, request);
    struct rg_exec_import *imports = status == STATUS_OK ? renderer_imports(r, next.frame) : NULL;
    if (status == STATUS_OK && !imports)
        status = log_out_of_memory(NULL);
    if (status == STATUS_OK)
        status = compiled_frame_replace(compiled_frame, &next, &r->params, imports);
    compiled_frame_destroy(&next);
    free(imports);
    return status;
}

static enum status update(struct renderer *r, struct compiled_frame *compiled_frame,
                          struct frame_request request)
{
    return compiled_frame->exec ? replace(r, compiled_frame, request)
                                : renderer_compile(r, compiled_frame, request);
}

/* Updates all executors. Destroys `capture` last, because `image` imports its cube. */
static enum status update_all(struct renderer *r)
{
    const bool captures = renderer_wants_capture(&r->params);
    const bool resolves = renderer_wants_resolve(&r->params);
    struct compiled_frame unused = r->capture;
    enum status status = STATUS_OK;
    if (captures)
        status = update(r, &r->capture, renderer_capture_request(&r->params));
    else
        r->capture = (struct compiled_frame){ 0 };
    if (status == STATUS_OK)
        status = update(r, &r->image, renderer_image_request(&r->params));
    if (!captures)
        compiled_frame_destroy(&unused);
    if (!resolves)
        compiled_frame_destroy(&r->resolve);
    else if (status == STATUS_OK)
        status = update(r, &r->resolve, renderer_resolve_request(&r->params));
    return status;
}

/* Discards sums and drawn cube faces. */
static void discard_images(struct renderer *r)
{
    image_finish(&r->sums);
    r->sum_count = 0;
    r->captured = false;
    r->cube.is_drawn = false;
}

enum status renderer_change(struct renderer *r, const struct renderer_params *params)
{
    /* necessary, because rg_exec_update() of the image does not wait for `capture` */
    enum status status = renderer_abandon(r);
    if (status == STATUS_OK)
        status = renderer_wait(r);
    renderer_set_params(r, params);
    discard_images(r);
    if (status == STATUS_OK)
        status = gpu_check_size(params->gpu, r->params.width, r->params.height);
    if (status == STATUS_OK && renderer_uses_bvh(&r->params)) {
        status = renderer_build_bvh(r);
        if (status == STATUS_OK)
            status = renderer_upload_bvh(r);
    }
    if (status == STATUS_OK)
        status = update_all(r);
    frame_objects_finish(&r->objects);
    if (status == STATUS_OK)
        status = frame_objects_init(&r->objects, &r->image.frame->list, r->params.scene);
    return status;
}
