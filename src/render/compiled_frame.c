/* compiled_frame.c: compiles a frame's plan for the device and creates its executor. */
#include "src/render/compiled_frame.h"
#include <math.h>
#include <stdlib.h>
#include "graph/rg_firn.h"
#include "src/base/log.h"
#include "src/gpu/gpu.h"
#include "src/render/lavapipe_tuning.h"
#include "src/render/make_frame_request.h"
#include "src/settings/scene_settings.h"

enum {
    FRAMES_IN_FLIGHT = 2,
};

static void log_exec(void *user, const char *what, VkResult result)
{
    (void)user;
    (void)gpu_failed(what, result);
}

/* Checks that the plan fits in device memory. Host-visible buffers count once per frame in flight.
 * If a CPU device draws tiles, images count as one tile, because unused memory is not committed. */
static enum status check_memory(const struct gpu *gpu, const struct frame_plan *frame)
{
    const struct rg_plan *plan = frame->plan;
    const VkDeviceSize texels = (VkDeviceSize)frame->max_region.width * frame->max_region.height;
    const VkDeviceSize tile_count =
        lavapipe_tuning_is_cpu(gpu) && texels
            ? (VkDeviceSize)plan->view.width * plan->view.height / texels
            : 1;
    VkDeviceSize host_size = 0;
    for (uint32_t i = 0; i < plan->buffer_count; i++) {
        const struct rg_plan_buffer *buffer = &plan->buffers[i];
        if (!buffer->imported && buffer->buffer->memory != RG_MEMORY_DEVICE)
            host_size += FRAMES_IN_FLIGHT * buffer->size;
    }
    return gpu_check_memory(gpu, plan->view,
                            plan->memory_used / tile_count + plan->memory_persistent, host_size);
}

struct rg_vulkan compiled_frame_vulkan(const struct gpu *gpu)
{
    return (struct rg_vulkan){
        gpu->instance,
        vkGetInstanceProcAddr,
        gpu->physical,
        gpu->device,
    };
}

enum status compiled_frame_compile(struct compiled_frame *compiled_frame,
                                   const struct renderer_params *params,
                                   struct frame_request request)
{
    const struct gpu *gpu = params->gpu;
    const struct rg_vulkan vulkan = compiled_frame_vulkan(gpu);
    const struct rg_device device = rg_exec_device(&vulkan);
    request.device = &device;
    compiled_frame->frame = calloc(1, sizeof(*compiled_frame->frame));
    if (!compiled_frame->frame)
        return log_out_of_memory(NULL);
    enum status status = frame_plan_init(compiled_frame->frame, &request);
    if (status == STATUS_OK)
        status = check_memory(gpu, compiled_frame->frame);
    return status;
}

/* Parameters of an executor. Must not be copied, because `info` and `params` point into it. */
struct exec_description {
    struct frame_constants constants;
    VkSpecializationMapEntry entries[CONSTANT_COUNT];
    VkSpecializationInfo info;
    struct rg_exec_params params;
};

/* Fills *described from a compiled_frame whose plan has been compiled. */
static void describe(struct exec_description *described,
                     const struct compiled_frame *compiled_frame,
                     const struct renderer_params *params, const struct rg_exec_import *imports)
{
    const struct gpu *gpu = params->gpu;
    const struct texture_params *texture = settings_of(params->settings, &texture_settings);
    struct exec_description *d = described;
    const struct settings settled =
        frame_resolve_settings(params->settings, params->scene, params->refraction, params->height);
    d->constants = frame_view_constants(params->scene, &settled, params->refraction);
    d->constants.values[CONSTANT_TILED] = renderer_is_interleaved(params);
    d->constants.values[CONSTANT_ORTHOGRAPHIC] = params->is_orthographic;
    for (uint32_t i = 0; i < CONSTANT_COUNT; i++)
        d->entries[i] = (VkSpecializationMapEntry){ i, i * sizeof(uint32_t), sizeof(uint32_t) };
    d->info =
        (VkSpecializationInfo){ CONSTANT_COUNT, d->entries, sizeof(d->constants), &d->constants };
    d->params = (struct rg_exec_params){
        .plan = compiled_frame->frame->plan,
        GPU_EXEC_PARAMS(gpu),
        .pipelines = gpu->pipelines,
        .imports = imports,
        .import_count = compiled_frame->frame->import_count,
        .max_anisotropy = fminf(gpu->max_anisotropy, (float)texture->anisotropy),
        .frames_in_flight = FRAMES_IN_FLIGHT,
        .measured = params->measured,
        .statistics = gpu->has_statistics,
        .constants = &d->info,
        .replace_shader = params->replace,
        .log = log_exec,
        .user = params->replace_user,
    };
}

enum status compiled_frame_realise(struct compiled_frame *compiled_frame,
                                   const struct renderer_params *params,
                                   const struct rg_exec_import *imports)
{
    struct exec_description described;
    VkResult result;
    describe(&described, compiled_frame, params, imports);
    compiled_frame->exec = rg_exec_create_extended(
        &described.params,
        &(struct rg_exec_extensions){
            /* only with validation layers, some of which ignore dynamic rendering */
            .render_passes = params->gpu->validated,
            .more = frame_object_next_pass,
            .same_texel = &frame_same_texel,
        },
        &result);
    if (compiled_frame->exec)
        lavapipe_tuning_advise_memory(params->gpu, compiled_frame->frame, compiled_frame->exec);
    return gpu_status(result);
}

/* Frees the frame plan. No frame may be in flight. */
static void destroy_frame(struct compiled_frame *compiled_frame)
{
    if (compiled_frame->frame)
        frame_plan_finish(compiled_frame->frame);
    free(compiled_frame->frame);
    compiled_frame->frame = NULL;
}

enum status compiled_frame_replace(struct compiled_frame *compiled_frame,
                                   struct compiled_frame *next,
                                   const struct renderer_params *params,
                                   const struct rg_exec_import *imports)
{
    struct compiled_frame former = *compiled_frame;
    struct exec_description described;
    describe(&described, next, params, imports);
    /* the caller then destroys what the former frame imported */
    enum status status = gpu_status(rg_exec_wait_all(former.exec));
    if (status == STATUS_OK)
        status = gpu_status(rg_exec_update(former.exec, &described.params));
    if (status == STATUS_OK)
        lavapipe_tuning_advise_memory(params->gpu, next->frame, former.exec);
    compiled_frame->frame = next->frame;
    next->frame = NULL;
    destroy_frame(&former);
    return status;
}

enum status compiled_frame_change_view(struct compiled_frame *compiled_frame,
                                       const struct renderer_params *params,
                                       struct frame_request request,
                                       const struct rg_exec_import *imports)
{
    const struct rg_vulkan vulkan = compiled_frame_vulkan(params->gpu);
    const struct rg_device device = rg_exec_device(&vulkan);
    struct exec_description described;
    struct rg_plan *former;
    request.device = &device;
    enum status status = frame_plan_change_view(compiled_frame->frame, &request, &former);
    if (status != STATUS_OK)
        return status;
    describe(&described, compiled_frame, params, imports);
    status = gpu_status(rg_exec_wait_all(compiled_frame->exec));
    if (status == STATUS_OK)
        status = gpu_status(rg_exec_update(compiled_frame->exec, &described.params));
    rg_plan_destroy(former);
    return status;
}

void compiled_frame_destroy(struct compiled_frame *compiled_frame)
{
    rg_exec_destroy(compiled_frame->exec);
    compiled_frame->exec = NULL;
    destroy_frame(compiled_frame);
}
