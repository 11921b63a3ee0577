/* screen.c: the plan that brings a picture into a window's images. */
#include "src/view/screen.h"
#include "src/frame.h"
#include "src/log.h"
#include "src/tech/tonemap.h"

enum {
    IMPORT_PICTURE,
    IMPORT_RIGHT,
    IMPORT_WINDOW,
    IMPORT_COUNT,
};

enum status screen_init(struct screen *s, struct gpu *gpu, VkSurfaceKHR surface,
                        VkPresentModeKHR mode)
{
    *s = (struct screen){ .gpu = gpu };
    const enum status status = gpu_swapchain_init(gpu, &s->swapchain, surface, mode);
    present_tables_init(&s->tables, s->swapchain.format);
    return status;
}

void screen_finish(struct screen *s)
{
    if (!s->gpu)
        return;
    screen_disconnect(s);
    gpu_swapchain_finish(s->gpu, &s->swapchain);
    *s = (struct screen){ 0 };
}

enum status screen_fit(struct screen *s, VkExtent2D size, bool *remade)
{
    /* the surface may settle on another extent, so what was asked for counts */
    *remade = s->swapchain.stale || s->size.width != size.width || s->size.height != size.height;
    if (!*remade)
        return STATUS_OK;
    screen_disconnect(s);
    s->size = size;
    return gpu_swapchain_recreate(s->gpu, &s->swapchain, size);
}

/* ---- the plan ---- */

static enum status compile(struct screen *s, const struct rg_device *device)
{
    const struct rg_technique *const techniques[] = { &s->tables.technique };
    const VkExtent2D extent = s->swapchain.extent;
    const struct rg_import imports[IMPORT_COUNT] = {
        [IMPORT_PICTURE] = { .image = &tonemap_color, .access = RG_SAMPLED },
        [IMPORT_RIGHT] = { .image = &present_right, .access = RG_SAMPLED },
        [IMPORT_WINDOW] = { .image = &s->tables.window },
    };
    s->plan = rg_compile(&(struct rg_compile_params){
        .techniques = techniques,
        .technique_count = 1,
        .view = extent,
        .outputs = &(struct rg_output){ .image = &s->tables.window, .access = RG_PRESENT },
        .output_count = 1,
        .imports = imports,
        .import_count = IMPORT_COUNT,
        .device = device,
    });
    if (!s->plan) {
        log_error("out of memory while compiling the window's plan");
        return STATUS_TRY_AGAIN;
    }
    for (uint32_t i = 0; i < s->plan->fault_count; i++) {
        char text[512];
        rg_fault_text(&s->plan->faults[i], text, sizeof(text));
        log_error("the window's tables: %s", text);
    }
    return s->plan->fault_count ? STATUS_FAILED : STATUS_OK;
}

static void log_exec(void *user, const char *line)
{
    (void)user;
    log_error("%s", line);
}

enum status screen_connect(struct screen *s, VkImage picture, VkImage right)
{
    const struct gpu *gpu = s->gpu;
    const struct rg_vulkan vulkan = {
        gpu->instance,
        vkGetInstanceProcAddr,
        gpu->physical,
        gpu->device,
    };
    const struct rg_device device = rg_exec_device(&vulkan);
    const struct rg_exec_import objects[IMPORT_COUNT] = {
        [IMPORT_PICTURE] = { .image = picture },
        [IMPORT_RIGHT] = { .image = right },
        [IMPORT_WINDOW] = {
            .images = s->swapchain.images,
            .image_count = s->swapchain.image_count,
        },
    };
    VkResult result;
    screen_disconnect(s);
    const enum status status = compile(s, &device);
    if (status != STATUS_OK)
        return status;
    s->exec = rg_exec_create(
        &(struct rg_exec_params){
            .plan = s->plan,
            .instance = gpu->instance,
            .get_proc_addr = vkGetInstanceProcAddr,
            .physical = gpu->physical,
            .device = gpu->device,
            .queue = gpu->queue,
            .queue_family = gpu->queue_family,
            .pipeline_cache = gpu->pipeline_cache,
            .frames_in_flight = GPU_SWAPCHAIN_SLOT_COUNT,
            .imports = objects,
            .import_count = IMPORT_COUNT,
            .render_passes = gpu->validated, /* see rg_exec.h */
            .measured = true,
            .replace = s->replace,
            .log = log_exec,
            .user = s->replace_user,
        },
        &result);
    if (s->exec)
        rg_exec_measure(s->exec, &(struct rg_measure){ .clock = RG_CLOCK_STREAM });
    return gpu_status(result);
}

void screen_disconnect(struct screen *s)
{
    rg_exec_destroy(s->exec);
    rg_plan_destroy(s->plan);
    s->exec = NULL;
    s->plan = NULL;
}

/* ---- a frame ---- */

enum status screen_begin(struct screen *s, bool *ready)
{
    *ready = false;
    enum status status = gpu_status(rg_exec_begin(s->exec, &s->slot));
    if (status == STATUS_OK)
        status = gpu_swapchain_acquire(s->gpu, &s->swapchain, s->slot, &s->index);
    *ready = status == STATUS_OK && s->index != GPU_SWAPCHAIN_NONE;
    return status;
}

enum status screen_end(struct screen *s, uint32_t line)
{
    const struct gpu_swapchain *chain = &s->swapchain;
    const struct rg_frame frame = { .present = { .encodes = chain->encodes, .line = line } };
    const struct rg_exec_ties ties = {
        .image = s->index,
        .wait = chain->acquired[s->slot],
        .signal = chain->drawn[s->index],
    };
    const enum status status = gpu_status(rg_exec_submit_tied(s->exec, &frame, &ties));
    return status == STATUS_OK ? gpu_swapchain_present(s->gpu, &s->swapchain, s->index) : status;
}
