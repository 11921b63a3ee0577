/* ui_plan_chart.c: draws the compiled render graph as a chart of passes and resource lifetimes. */
#include "src/view/panels/ui_plan_chart.h"
#include "src/view/panels/imgui.h"

static const double mebi = 1024.0 * 1024.0;

struct chart {
    const struct rg_plan *plan;
    struct imgui_rect area;
    float column, row; /* pixels per pass and per resource */
};

static struct imgui_rect cell(const struct chart *c, uint32_t first, uint32_t last, uint32_t row)
{
    const float end = (float)(last < c->plan->pass_count ? last + 1 : c->plan->pass_count);
    return (struct imgui_rect){
        .x = c->area.x + (float)first * c->column,
        .y = c->area.y + (float)row * c->row,
        .width = (end - (float)first) * c->column,
        .height = c->row,
    };
}

static void draw_image(const struct chart *c, uint32_t i)
{
    const struct rg_plan_image *image = &c->plan->images[i];
    const struct imgui_rect whole = cell(c, image->first, image->last, i + 1);
    struct imgui_rect bar = whole;
    char text[256];
    bar.height *= 0.8f;
    if (image->imported)
        imgui_rectangle(bar, IMGUI_RGBA(120, 126, 132, 255));
    else if (image->persistent)
        imgui_rectangle(bar, IMGUI_RGBA(196, 150, 60, 255));
    else
        imgui_rectangle(bar, IMGUI_RGBA(58, 134, 190, 255));
    if (!imgui_is_hovered(whole))
        return;
    imgui_rectangle(bar, IMGUI_RGBA(255, 255, 255, 90));
    snprintf(text, sizeof(text), "%s\n%ux%u %s%s", image->image->name, image->extent.width,
             image->extent.height, rg_format_info(image->image->format)->name,
             image->imported     ? ", imported"
             : image->persistent ? ", persistent"
                                 : "");
    if (image->block != RG_NONE)
        snprintf(text, sizeof(text), "%s\n%ux%u %s\n%.2f MiB at offset %.2f MiB in block %u",
                 image->image->name, image->extent.width, image->extent.height,
                 rg_format_info(image->image->format)->name, (double)image->size / mebi,
                 (double)image->offset / mebi, image->block);
    imgui_cursor_tooltip(text);
}

/* Draws a pass in the top row, red if a batch of barriers precedes it. */
static void draw_pass(const struct chart *c, uint32_t p)
{
    const struct rg_plan_pass *pass = &c->plan->passes[p];
    const struct imgui_rect whole = cell(c, p, p, 0);
    struct imgui_rect box = whole;
    char text[256];
    box.width -= 1.0f;
    box.height *= 0.8f;
    imgui_rectangle(box, pass->barrier_count ? IMGUI_RGBA(208, 96, 72, 255)
                                             : IMGUI_RGBA(90, 160, 100, 255));
    if (!imgui_is_hovered(whole))
        return;
    struct imgui_rect column = whole;
    column.height = c->area.height;
    imgui_rectangle(column, IMGUI_RGBA(255, 255, 255, 40));
    snprintf(text, sizeof(text), "pass %u: %s\n%u barrier%s before it", p, pass->pass->name,
             pass->barrier_count, pass->barrier_count == 1 ? "" : "s");
    imgui_cursor_tooltip(text);
}

void ui_plan_chart_memory(const struct rg_plan *plan)
{
    char text[128];
    snprintf(text, sizeof(text), "%.1f MiB of memory, %.1f without aliasing",
             (double)plan->memory_used / mebi, (double)plan->memory_without_aliasing / mebi);
    imgui_text_wrapped(text);
    imgui_tooltip("device memory of the plan's images and buffers");
}

static void print_sums(const struct rg_plan *plan)
{
    char text[256];
    snprintf(text, sizeof(text), "%u passes, %u barriers, %u batches", plan->pass_count,
             plan->barrier_count, plan->batch_count);
    imgui_text_wrapped(text);
    ui_plan_chart_memory(plan);
    imgui_text_dim("passes (red: waits for barriers), images");
}

void ui_plan_chart_panel(const struct rg_plan *plan)
{
    struct chart c = { .plan = plan, .row = 7.0f * imgui_scale() };
    print_sums(plan);
    c.area = imgui_reserve(imgui_available_width(), c.row * (float)(plan->image_count + 1));
    c.column = c.area.width / (float)plan->pass_count;
    for (uint32_t p = 0; p < plan->pass_count; p++)
        draw_pass(&c, p);
    for (uint32_t i = 0; i < plan->image_count; i++)
        draw_image(&c, i);
}
