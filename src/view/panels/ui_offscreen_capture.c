/* ui_offscreen_capture.c: renders the window's contents off screen and reads them back. */
#include "src/view/panels/ui_offscreen_capture.h"
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/render/compiled_frame.h"
#include "src/tech/frame_resources.h"
#include "src/tech/output/tonemap.h"

enum {
    IMPORT_IMAGE,
    IMPORT_RIGHT,
    IMPORT_FONT,
    IMPORT_COUNT,
};

static const struct rg_buffer pixels = {
    .name = "ui_screenshot.pixels",
    .size_per_texel = 4,
    .memory = RG_MEMORY_READBACK,
};

/* State of a screenshot. Tables contain pointers to this struct, so it must not be moved. */
struct shot {
    const struct presenter *presenter;
    const struct viewport *viewport;
    const struct window_frame *frame;
    struct present_tables present;
    struct overlay_tables overlay;
    struct rg_use uses[3];
    struct rg_pass passes[1];
    struct rg_technique readback;
    struct rg_plan *plan;
    struct rg_exec *exec;
};

static void record_copy(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    rg_cmd_copy_image_to_buffer(cmd, rg_cmd_pass(cmd)->uses[0].image, &pixels, 0);
}

static void make_tables(struct shot *s)
{
    present_tables_init(&s->present, VK_FORMAT_R8G8B8A8_UNORM);
    overlay_tables_init(&s->overlay, &s->present.window, false);
    s->uses[0] = (struct rg_use){ .image = &s->present.window, .access = RG_COPY_SRC };
    s->uses[1] = (struct rg_use){ .buffer = &pixels, .access = RG_COPY_DST };
    s->passes[0] = (struct rg_pass){
        .name = "ui_screenshot.readback",
        .kind = RG_TRANSFER,
        .uses = s->uses,
        .record = record_copy,
    };
    s->readback = (struct rg_technique)RG_TECHNIQUE("ui_screenshot", s->passes);
}

static enum status compile(struct shot *s, const struct gpu_image *font,
                           const struct rg_device *device)
{
    const struct rg_technique *const parts[] = {
        &s->present.technique,
        &s->overlay.technique,
        &s->readback,
    };
    const VkExtent2D viewport = { s->frame->present.texel_columns, s->frame->present.texel_rows };
    const struct rg_import imports[IMPORT_COUNT] = {
        [IMPORT_IMAGE] = { .image = &frame_display, .access = RG_SAMPLED, .extent = viewport },
        [IMPORT_RIGHT] = { .image = &present_right,
                           .access = RG_SAMPLED,
                           .extent = viewport_right_extent(s->viewport) },
        [IMPORT_FONT] = {
            .image = &overlay_font,
            .access = RG_SAMPLED,
            .extent = { font->extent.width, font->extent.height },
        },
    };
    s->plan = rg_compile(&(struct rg_compile_params){
        .techniques = parts,
        .technique_count = sizeof(parts) / sizeof(parts[0]),
        .view = s->presenter->swapchain.extent,
        .outputs = &(struct rg_output){ .buffer = &pixels, .access = RG_HOST_READ },
        .output_count = 1,
        .imports = imports,
        .import_count = IMPORT_COUNT,
        .device = device,
    });
    if (!s->plan) {
        log_error("out of memory while compiling the plan of a screenshot");
        return STATUS_TRY_AGAIN;
    }
    return presenter_report_faults(s->plan);
}

static enum status realise(struct shot *s, const struct gpu_image *font)
{
    const struct rg_exec_import imports[IMPORT_COUNT] = {
        [IMPORT_IMAGE] = { .image = viewport_left(s->viewport) },
        [IMPORT_RIGHT] = { .image = viewport_right(s->viewport) },
        [IMPORT_FONT] = { .image = font->image },
    };
    struct rg_exec_params params = presenter_exec_params(s->presenter->gpu, s->plan);
    VkResult result;
    params.frames_in_flight = 1;
    params.imports = imports;
    params.import_count = IMPORT_COUNT;
    params.replace_shader = s->presenter->replace;
    params.user = s->presenter->replace_user;
    s->exec = rg_exec_create(&params, &result);
    return gpu_status(result);
}

static enum status draw(struct shot *s, struct ui *ui, size_t size, uint8_t **rgba)
{
    uint32_t slot;
    enum status status = gpu_status(rg_exec_begin(s->exec, &slot));
    if (status != STATUS_OK)
        return status;
    struct window_frame window = *s->frame;
    window.right_columns = viewport_right_extent(s->viewport).width;
    window.right_rows = viewport_right_extent(s->viewport).height;
    window.overlay = ui_copy_draw_list(ui, rg_exec_mapped(s->exec, &overlay_vertices, slot),
                                       rg_exec_mapped(s->exec, &overlay_indices, slot));
    const struct rg_frame frame = { .window = &window };
    status = gpu_status(rg_exec_submit(s->exec, &frame));
    if (status == STATUS_OK)
        status = gpu_status(rg_exec_wait(s->exec, slot));
    if (status != STATUS_OK)
        return status;
    *rgba = malloc(size);
    if (!*rgba) {
        return log_out_of_memory(NULL);
    }
    memcpy(*rgba, rg_exec_mapped(s->exec, &pixels, slot), size);
    return STATUS_OK;
}

enum status ui_screenshot(const struct presenter *presenter, const struct viewport *viewport,
                          const struct window_frame *frame, struct ui *ui, uint8_t **rgba)
{
    const struct rg_vulkan vulkan = compiled_frame_vulkan(presenter->gpu);
    const struct rg_device device = rg_exec_device(&vulkan);
    const VkExtent2D size = presenter->swapchain.extent;
    struct shot s = { .presenter = presenter, .viewport = viewport, .frame = frame };
    *rgba = NULL;
    make_tables(&s);
    enum status status = compile(&s, ui_font(ui), &device);
    if (status == STATUS_OK)
        status = realise(&s, ui_font(ui));
    if (status == STATUS_OK)
        status = draw(&s, ui, (size_t)size.width * size.height * 4, rgba);
    rg_exec_destroy(s.exec);
    rg_plan_destroy(s.plan);
    return status;
}
