/* presenter.c: swapchain and render-graph plan that present the image in a window. */
#include "src/view/window/presenter.h"
#include "graph/rg_firn.h"
#include "src/base/clock.h"
#include "src/base/log.h"
#include "src/render/compiled_frame.h"
#include "src/tech/frame_resources.h"
#include "src/tech/output/tonemap.h"
#include "src/view/view_frame_stats.h"

enum {
    IMPORT_IMAGE,
    IMPORT_RIGHT,
    IMPORT_WINDOW,
    IMPORT_FONT, /* only with a user interface */
    IMPORT_COUNT,
};

enum status presenter_init(struct presenter *s, struct gpu *gpu, VkSurfaceKHR surface,
                           VkPresentModeKHR mode)
{
    *s = (struct presenter){ .gpu = gpu };
    const enum status status = gpu_swapchain_init(gpu, &s->swapchain, surface, mode);
    present_tables_init(&s->tables, s->swapchain.format);
    overlay_tables_init(&s->overlay, &s->tables.window, s->swapchain.copies);
    return status;
}

void presenter_finish(struct presenter *s)
{
    if (!s->gpu)
        return;
    presenter_disconnect(s);
    gpu_swapchain_finish(s->gpu, &s->swapchain);
    *s = (struct presenter){ 0 };
}

enum status presenter_fit(struct presenter *s, VkExtent2D size, bool *remade)
{
    /* compare requested sizes, because the surface may choose another extent */
    *remade = s->swapchain.stale || s->size.width != size.width || s->size.height != size.height;
    if (!*remade)
        return STATUS_OK;
    presenter_disconnect(s);
    s->size = size;
    return gpu_swapchain_recreate(s->gpu, &s->swapchain, size);
}

static uint32_t import_count(const struct presenter *s)
{
    return s->font ? IMPORT_COUNT : IMPORT_FONT;
}

static enum status report_faults(const struct rg_plan *plan)
{
    for (uint32_t i = 0; i < plan->fault_count; i++) {
        char text[512];
        rg_fault_text(&plan->faults[i], text, sizeof(text));
        log_error("internal error: invalid render graph of the window: %s", text);
    }
    return plan->fault_count ? STATUS_FAILED : STATUS_OK;
}

static enum status compile(const struct presenter *s, const struct presenter_images *images,
                           const struct rg_device *device, struct rg_plan **plan)
{
    const struct rg_technique *const parts[] = {
        &s->tables.technique,
        &s->overlay.technique,
    };
    const VkExtent2D extent = s->swapchain.extent;
    const struct rg_import imports[IMPORT_COUNT] = {
        [IMPORT_IMAGE] = { .image = &frame_display,
                             .access = RG_SAMPLED,
                             .extent = images->extent },
        [IMPORT_RIGHT] = { .image = &present_right,
                           .access = RG_SAMPLED,
                           .extent = images->right_extent },
        [IMPORT_WINDOW] = { .image = &s->tables.window },
        [IMPORT_FONT] = {
            .image = &overlay_font,
            .access = RG_SAMPLED,
            .extent = { s->font ? s->font->extent.width : 0, s->font ? s->font->extent.height : 0 },
        },
    };
    *plan = rg_compile(&(struct rg_compile_params){
        .techniques = parts,
        .technique_count = s->font ? 2 : 1,
        .view = extent,
        .outputs = &(struct rg_output){ .image = &s->tables.window, .access = RG_PRESENT },
        .output_count = 1,
        .imports = imports,
        .import_count = import_count(s),
        .device = device,
    });
    if (!*plan) {
        log_error("out of memory while compiling the window's render graph");
        return STATUS_TRY_AGAIN;
    }
    return report_faults(*plan);
}

static void log_exec(void *user, const char *what, VkResult result)
{
    (void)user;
    (void)gpu_failed(what, result);
}

/* Creates an executor for the plan, or updates the existing one. */
static enum status realise(struct presenter *s, const struct presenter_images *images,
                           const struct rg_plan *plan)
{
    const struct rg_exec_import objects[IMPORT_COUNT] = {
        [IMPORT_IMAGE] = { .image = images->left },
        [IMPORT_RIGHT] = { .image = images->right },
        [IMPORT_WINDOW] = {
            .images = s->swapchain.images,
            .image_count = s->swapchain.image_count,
        },
        [IMPORT_FONT] = { .image = s->font ? s->font->image : VK_NULL_HANDLE },
    };
    const uint32_t encodes = s->swapchain.encodes;
    const VkSpecializationMapEntry entry = { PRESENT_ENCODES, 0, sizeof(encodes) };
    const VkSpecializationInfo constants = { 1, &entry, sizeof(encodes), &encodes };
    VkResult result;
    const struct rg_exec_params params = {
        .plan = plan,
        GPU_EXEC_PARAMS(s->gpu),
        .log = log_exec,
        .constants = &constants,
        .frames_in_flight = GPU_SWAPCHAIN_SLOT_COUNT,
        .imports = objects,
        .import_count = import_count(s),
        .measured = true,
        .replace_shader = s->replace,
        .user = s->replace_user,
    };
    if (s->exec) {
        /* the images shown before are destroyed by their owners */
        const enum status status = gpu_status(rg_exec_wait_all(s->exec));
        return status == STATUS_OK ? gpu_status(rg_exec_update(s->exec, &params)) : status;
    }
    s->exec = rg_exec_create_extended(
        &params, &(struct rg_exec_extensions){ .render_passes = s->gpu->validated }, &result);
    if (s->exec)
        rg_exec_measure(s->exec, &(struct rg_measure){ .clock = RG_CLOCK_STREAM });
    return gpu_status(result);
}

static bool shows(const struct presenter *s, const struct presenter_images *images)
{
    const struct presenter_images *now = &s->images;
    return s->exec && now->left == images->left && now->right == images->right &&
           now->extent.width == images->extent.width &&
           now->extent.height == images->extent.height &&
           now->right_extent.width == images->right_extent.width &&
           now->right_extent.height == images->right_extent.height;
}

enum status presenter_connect(struct presenter *s, const struct presenter_images *images)
{
    const struct rg_vulkan vulkan = compiled_frame_vulkan(s->gpu);
    const struct rg_device device = rg_exec_device(&vulkan);
    struct rg_plan *plan = NULL;
    if (shows(s, images))
        return STATUS_OK;
    enum status status = compile(s, images, &device, &plan);
    if (status == STATUS_OK)
        status = realise(s, images, plan);
    if (status != STATUS_OK) {
        rg_plan_destroy(plan);
        return status;
    }
    rg_plan_destroy(s->plan);
    s->plan = plan;
    s->panels_version = 0;
    s->images = *images;
    return STATUS_OK;
}

void presenter_disconnect(struct presenter *s)
{
    rg_exec_destroy(s->exec);
    rg_plan_destroy(s->plan);
    s->exec = NULL;
    s->plan = NULL;
}

void presenter_set_font(struct presenter *s, const struct gpu_image *font)
{
    presenter_disconnect(s);
    s->font = font;
}

enum status presenter_begin(struct presenter *s, bool *ready)
{
    *ready = false;
    enum status status = gpu_status(rg_exec_begin(s->exec, &s->slot));
    const double start = clock_seconds();
    if (status == STATUS_OK)
        status = gpu_swapchain_acquire(s->gpu, &s->swapchain, s->slot, &s->index);
    s->wait_seconds = clock_seconds() - start;
    *ready = status == STATUS_OK && s->index != GPU_SWAPCHAIN_NONE;
    return status;
}

static VkSemaphoreSubmitInfo semaphore_info(VkSemaphore semaphore)
{
    return (VkSemaphoreSubmitInfo){
        .sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO,
        .semaphore = semaphore,
        .stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
    };
}

enum status presenter_end(struct presenter *s, const struct window_frame *frame)
{
    const struct gpu_swapchain *chain = &s->swapchain;
    struct window_frame window = *frame;
    window.right_columns = s->images.right_extent.width;
    window.right_rows = s->images.right_extent.height;
    window.encodes_srgb = chain->encodes;
    window.caches_panels = chain->copies;
    window.panels_are_outdated = window.overlay && window.overlay->version != s->panels_version;
    window.panels = &s->overlay.panels;
    window.window_image = &s->tables.window;
    const struct rg_frame inputs = { .window = &window };
    const VkSemaphoreSubmitInfo wait = semaphore_info(chain->acquired[s->slot]);
    const VkSemaphoreSubmitInfo signal = semaphore_info(chain->drawn[s->index]);
    const struct rg_exec_external_sync sync = { s->index, 1, 1, &wait, &signal };
    enum status status = gpu_status(rg_exec_submit_synced(s->exec, &inputs, &sync));
    if (status == STATUS_OK && window.overlay)
        s->panels_version = window.overlay->version;
    const double start = clock_seconds();
    if (status == STATUS_OK)
        status = gpu_swapchain_present(s->gpu, &s->swapchain, s->index);
    s->wait_seconds += clock_seconds() - start;
    return status;
}

enum status presenter_wait(struct presenter *s)
{
    return s->exec ? gpu_status(rg_exec_wait_all(s->exec)) : STATUS_OK;
}
