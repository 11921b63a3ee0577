/* html_chart.c: SVG timeline of passes and memory. Each pass has a column. The last column is the
 * end of the frame. Barrier batches are marked between columns. */
#include <inttypes.h>
#include "graph/dump/dump_internal.h"

enum {
    AXIS_WIDTH = 190, /* pixels, like all sizes below */
    LEFT = 36,        /* space for the initial barriers */
    MIN_COLUMN = 24,
    MAX_COLUMN = 96,
    CHART_WIDTH = 1200, /* minimum; more with many passes */
    BAR_HEIGHT = 20,
    MIN_BLOCK_HEIGHT = 96,
    MAX_BLOCK_HEIGHT = 480,
    MAX_NAME_HEIGHT = 240,
    LABEL_DISTANCE = 900, /* between repeated labels */
    TICK_COUNT = 4,
};

struct chart {
    struct rg_dump d;
    uint32_t column, columns; /* width and number of columns */
};

enum group {
    TRANSIENT,
    PERSISTENT,
    IMPORTED,
    HOST,
};

static enum group group_of(const struct rg_dump_resource *r)
{
    return r->imported           ? IMPORTED
           : r->persistent       ? PERSISTENT
           : r->block != RG_NONE ? TRANSIENT
                                 : HOST;
}

static const char *style_of(const struct rg_plan *plan, uint32_t index)
{
    VkImageUsageFlags usage = index < plan->image_count ? plan->images[index].usage : 0;
    return index >= plan->image_count                            ? "data"
           : usage & VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT ? "depth"
           : usage & VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT         ? "color"
           : usage & VK_IMAGE_USAGE_STORAGE_BIT                  ? "storage"
                                                                 : "copy";
}

/* Returns the next resource index of a group in a memory block, or in any block for RG_NONE. */
static uint32_t next_in_group(const struct rg_plan *plan, enum group group, uint32_t block,
                              uint32_t index)
{
    for (; index < plan->image_count + plan->buffer_count; index++) {
        const struct rg_dump_resource r = rg_dump_resource(plan, index);
        if (group_of(&r) == group && (block == RG_NONE || r.block == block))
            return index;
    }
    return RG_NONE;
}

/* Begins a row with its axis. */
static void open_row(const struct chart *c, const char *style, uint32_t height)
{
    rg_dump_print(&c->d,
                  "<div class=\"row %s\">\n<svg class=\"axis\" width=\"%u\" height=\"%u\">\n",
                  style, AXIS_WIDTH, height);
}

static void close_row(const struct chart *c)
{
    rg_dump_print(&c->d, "</svg>\n</div>\n");
}

/* Begins the plot of a chart row; x = 0 is the left edge of the first column. */
static void open_plot(const struct chart *c, uint32_t height, const char *attributes)
{
    uint32_t width = LEFT + c->columns * c->column;
    rg_dump_print(
        &c->d,
        "</svg>\n<svg class=\"plot\" width=\"%u\" height=\"%u\" viewBox=\"-%u 0 %u %u\"%s>\n",
        width, height, LEFT, width, height, attributes);
}

static void print_axis_text(const struct chart *c, uint32_t y, const char *text)
{
    rg_dump_print(&c->d, "<text x=\"6\" y=\"%u\">%n</text>\n", y, text);
}

/* Prints a vertical line at each batch of barriers. */
static void print_batch_lines(const struct chart *c, uint32_t height)
{
    const struct rg_plan *plan = c->d.plan;
    rg_dump_print(&c->d, "<rect class=\"grid\" width=\"%u\" height=\"%u\"/>\n",
                  c->columns * c->column, height);
    rg_dump_print(&c->d, "<path class=\"batches\" d=\"M0 0");
    for (uint32_t p = 0; p < plan->pass_count; p++) {
        if (plan->passes[p].barrier_count)
            rg_dump_print(&c->d, "M%u 0v%u", p * c->column, height);
    }
    if (plan->final_barrier_count)
        rg_dump_print(&c->d, "M%u 0v%u", plan->pass_count * c->column, height);
    rg_dump_print(&c->d, "\"/>\n");
}

/* Prints a label, clipped to its box, and repeated if the box is long. */
static void print_label(const struct chart *c, uint32_t x, uint32_t width, uint64_t y,
                        const char *name)
{
    rg_dump_print(&c->d, "<svg x=\"%u\" y=\"%z\" width=\"%u\" height=\"16\">", x, y, width - 2);
    for (uint32_t at = 0; at == 0 || at + LABEL_DISTANCE / 2 < width; at += LABEL_DISTANCE)
        rg_dump_print(&c->d, "<text x=\"%u\" y=\"12\">%n</text>", at + 4, name);
    rg_dump_print(&c->d, "</svg>");
}

/* Prints an SVG attribute given in thousandths of a pixel. */
static void print_pixels(FILE *out, const char *name, uint64_t thousandths)
{
    fprintf(out, " %s=\"%" PRIu64 ".%03u\"", name, thousandths / 1000,
            (unsigned)(thousandths % 1000));
}

/* Prints the name of a column: the name of its pass, or "end of frame". */
static void print_column_name(const struct chart *c, uint32_t column)
{
    const struct rg_plan *plan = c->d.plan;
    if (column < plan->pass_count)
        rg_dump_pass_name(&c->d, plan->passes[column].pass, plan->passes[column].repetition);
    else
        rg_dump_print(&c->d, "end of frame");
}

static void print_techniques(const struct chart *c)
{
    const struct rg_plan *plan = c->d.plan;
    open_row(c, "techniques", BAR_HEIGHT);
    print_axis_text(c, 14, "technique");
    open_plot(c, BAR_HEIGHT, "");
    for (uint32_t first = 0, end; first < plan->pass_count; first = end) {
        const struct rg_technique *technique = plan->passes[first].technique;
        for (end = first; end < plan->pass_count && plan->passes[end].technique == technique;)
            end++;
        uint32_t x = first * c->column, width = (end - first) * c->column;
        rg_dump_print(&c->d, "<g class=\"technique\"><title>%n</title>", technique->name);
        rg_dump_print(&c->d, "<rect x=\"%u\" y=\"0\" width=\"%u\" height=\"%u\"/>", x, width,
                      BAR_HEIGHT);
        print_label(c, x, width, 2, technique->name);
        rg_dump_print(&c->d, "</g>\n");
    }
    close_row(c);
}

/* Returns the height in pixels of the longest pass name, which is written vertically. */
static uint32_t name_height(const struct rg_plan *plan)
{
    uint32_t longest = 16; /* of the last column */
    for (uint32_t p = 0; p < plan->pass_count; p++) {
        const char *name = plan->passes[p].pass->name;
        uint32_t length = 5; /* for the repetition index */
        for (; *name; length++)
            rg_dump_decode_utf8(&name);
        longest = length > longest ? length : longest;
    }
    uint32_t height = 7 * longest + 8;
    return height < MAX_NAME_HEIGHT ? height : MAX_NAME_HEIGHT;
}

static void print_passes(const struct chart *c)
{
    static const char *const styles[] = {
        [RG_RASTER] = "color",
        [RG_COMPUTE] = "storage",
        [RG_TRANSFER] = "copy",
    };
    const struct rg_plan *plan = c->d.plan;
    uint32_t height = name_height(plan);
    open_row(c, "passes", height);
    print_axis_text(c, height - 6, "pass");
    open_plot(c, height, "");
    for (uint32_t p = 0; p <= plan->pass_count; p++) {
        const struct rg_pass *pass = p < plan->pass_count ? plan->passes[p].pass : NULL;
        if (pass) {
            rg_dump_print(&c->d, "<g class=\"%s%s\" tabindex=\"0\" data-pass=\"%u\"><title>",
                          styles[pass->kind], pass->when ? " when" : "", p);
            rg_dump_pass(&c->d, p);
            rg_dump_print(&c->d, "</title><rect x=\"%u\" y=\"1\" width=\"%u\" height=\"%u\"/>",
                          p * c->column + 2, c->column - 4, height - 2);
        }
        rg_dump_print(&c->d, "%s<text transform=\"translate(%u %u) rotate(-90)\">",
                      pass ? "" : "<g>", p * c->column + c->column / 2 + 4, height - 6);
        print_column_name(c, p);
        rg_dump_print(&c->d, "</text></g>\n");
    }
    close_row(c);
}

static void print_batch(const struct chart *c, uint32_t x, uint32_t first, uint32_t count)
{
    if (!count)
        return;
    rg_dump_print(&c->d, "<g class=\"batch\" tabindex=\"0\"><title>");
    rg_dump_barriers(&c->d, "barrier", first, count);
    rg_dump_print(&c->d, "</title><circle cx=\"%u\" cy=\"12\" r=\"9\"/>", x);
    rg_dump_print(&c->d, "<text class=\"middle\" x=\"%u\" y=\"16\">%u</text></g>\n", x, count);
}

static void print_batches(const struct chart *c)
{
    const struct rg_plan *plan = c->d.plan;
    open_row(c, "barriers", 24);
    print_axis_text(c, 16, "barriers");
    open_plot(c, 24, "");
    if (plan->initial_barrier_count) {
        rg_dump_print(&c->d, "<g class=\"batch\" tabindex=\"0\" data-initial=\"0\"><title>");
        rg_dump_barriers(&c->d, "barrier before the first frame", plan->first_initial_barrier,
                         plan->initial_barrier_count);
        rg_dump_print(&c->d,
                      "</title><rect x=\"-34\" y=\"3\" width=\"22\" height=\"18\"/>"
                      "<text class=\"middle\" x=\"-23\" y=\"16\">%u</text></g>\n",
                      plan->initial_barrier_count);
    }
    for (uint32_t p = 0; p < plan->pass_count; p++)
        print_batch(c, p * c->column, plan->passes[p].first_barrier, plan->passes[p].barrier_count);
    print_batch(c, plan->pass_count * c->column, plan->first_final_barrier,
                plan->final_barrier_count);
    close_row(c);
}

/* Begins the SVG group of a resource, with a tooltip (title) of its offset and lifetime. */
static void open_resource(const struct chart *c, uint32_t index, const struct rg_dump_resource *r)
{
    const struct rg_plan *plan = c->d.plan;
    bool is_buffer = index >= plan->image_count;
    uint32_t own = is_buffer ? index - plan->image_count : index;
    enum group group = group_of(r);
    rg_dump_print(&c->d, "<g class=\"%s\" tabindex=\"0\" data-%s=\"%u\"><title>",
                  style_of(plan, index), is_buffer ? "buffer" : "image", own);
    if (is_buffer)
        rg_dump_buffer(&c->d, own);
    else
        rg_dump_image(&c->d, own);
    if (group == TRANSIENT)
        rg_dump_print(&c->d, "%b at %b, ", r->size, r->offset);
    else if (group == PERSISTENT)
        rg_dump_print(&c->d, "%b, ", r->size);
    rg_dump_print(&c->d, "from ");
    print_column_name(c, r->first);
    rg_dump_print(&c->d, " to ");
    print_column_name(c, r->last);
    rg_dump_print(&c->d, "</title>");
}

/* Converts a size or offset in bytes to thousandths of a pixel. */
static uint64_t scaled(VkDeviceSize size, const struct rg_block *block, uint32_t height)
{
    return (uint64_t)((double)size / (double)block->size * height * 1000.0 + 0.5);
}

static void print_rectangle(const struct chart *c, uint32_t index, const struct rg_block *block,
                            uint32_t height)
{
    const struct rg_dump_resource r = rg_dump_resource(c->d.plan, index);
    uint32_t x = r.first * c->column, width = (r.last - r.first + 1) * c->column;
    uint64_t top = scaled(r.offset, block, height);
    uint64_t bottom = scaled(r.offset + r.size, block, height);
    open_resource(c, index, &r);
    rg_dump_print(&c->d, "<rect x=\"%u\" width=\"%u\"", x, width);
    print_pixels(c->d.out, "y", top);
    print_pixels(c->d.out, "height", bottom - top);
    rg_dump_print(&c->d, "/>");
    if (bottom - top >= 12000)
        print_label(c, x, width, top / 1000, r.name);
    rg_dump_print(&c->d, "</g>\n");
}

static uint32_t block_height(const struct rg_plan *plan, uint32_t block)
{
    uint32_t height = MIN_BLOCK_HEIGHT;
    for (uint32_t i = next_in_group(plan, TRANSIENT, block, 0); i != RG_NONE;
         i = next_in_group(plan, TRANSIENT, block, i + 1))
        height += height < MAX_BLOCK_HEIGHT ? 2 * BAR_HEIGHT : 0;
    return height < MAX_BLOCK_HEIGHT ? height : MAX_BLOCK_HEIGHT;
}

static void print_block(const struct chart *c, uint32_t index)
{
    const struct rg_plan *plan = c->d.plan;
    const struct rg_block *block = &plan->blocks[index];
    uint32_t height = block_height(plan, index);
    char attributes[64];
    rg_dump_print(&c->d, "<h2>Block %u: %s</h2>\n", index, block->buffers ? "buffers" : "images");
    open_row(c, "block", height);
    for (uint32_t i = 0; i <= TICK_COUNT; i++) {
        uint32_t y = i * (height - 1) / TICK_COUNT;
        uint32_t text_y = i == 0 ? 10 : i == TICK_COUNT ? y : y + 4;
        rg_dump_print(&c->d, "<path class=\"line\" d=\"M%u %uh8\"/>", AXIS_WIDTH - 8, y);
        rg_dump_print(&c->d, "<text class=\"end\" x=\"%u\" y=\"%u\">%b</text>\n", AXIS_WIDTH - 12,
                      text_y, block->size / TICK_COUNT * i + block->size % TICK_COUNT * i / 4);
    }
    snprintf(attributes, sizeof(attributes), " data-block=\"%u\" data-column=\"%u\"", index,
             c->column);
    open_plot(c, height, attributes);
    print_batch_lines(c, height);
    for (uint32_t i = next_in_group(plan, TRANSIENT, index, 0); i != RG_NONE;
         i = next_in_group(plan, TRANSIENT, index, i + 1))
        print_rectangle(c, i, block, height);
    close_row(c);
}

/* ---- unaliased resources ---- */

static void print_bar(const struct chart *c, uint32_t index, uint32_t y)
{
    const struct rg_dump_resource r = rg_dump_resource(c->d.plan, index);
    open_resource(c, index, &r);
    if (group_of(&r) == PERSISTENT) /* spans all frames */
        rg_dump_print(&c->d, "<rect class=\"frames\" x=\"0\" y=\"%u\" width=\"%u\" height=\"%u\"/>",
                      y, c->columns * c->column, BAR_HEIGHT - 4);
    rg_dump_print(&c->d, "<rect x=\"%u\" y=\"%u\" width=\"%u\" height=\"%u\"/></g>\n",
                  r.first * c->column, y, (r.last - r.first + 1) * c->column, BAR_HEIGHT - 4);
}

static void print_bars(const struct chart *c, enum group group, const char *title)
{
    const struct rg_plan *plan = c->d.plan;
    uint32_t count = 0, y = 14;
    for (uint32_t i = next_in_group(plan, group, RG_NONE, 0); i != RG_NONE;
         i = next_in_group(plan, group, RG_NONE, i + 1))
        count++;
    if (!count)
        return;
    rg_dump_print(&c->d, "<h2>%s</h2>\n", title);
    open_row(c, "bars", count * BAR_HEIGHT);
    for (uint32_t i = next_in_group(plan, group, RG_NONE, 0); i != RG_NONE;
         i = next_in_group(plan, group, RG_NONE, i + 1)) {
        print_axis_text(c, y, rg_dump_resource(plan, i).name);
        y += BAR_HEIGHT;
    }
    open_plot(c, count * BAR_HEIGHT, "");
    print_batch_lines(c, count * BAR_HEIGHT);
    y = 2;
    for (uint32_t i = next_in_group(plan, group, RG_NONE, 0); i != RG_NONE;
         i = next_in_group(plan, group, RG_NONE, i + 1)) {
        print_bar(c, i, y);
        y += BAR_HEIGHT;
    }
    close_row(c);
}

void rg_dump_chart(const struct rg_dump *d)
{
    uint32_t columns = d->plan->pass_count + 1, column = CHART_WIDTH / columns;
    column = column < MIN_COLUMN ? MIN_COLUMN : column > MAX_COLUMN ? MAX_COLUMN : column;
    const struct chart chart = { *d, column, columns };
    rg_dump_print(d,
                  "<main tabindex=\"0\">\n<svg width=\"0\" height=\"0\"><defs><pattern id=\"grid\" "
                  "width=\"%u\" height=\"8\" patternUnits=\"userSpaceOnUse\">"
                  "<path class=\"line\" d=\"M0 0v8\"/></pattern></defs></svg>\n"
                  "<div class=\"head\">\n",
                  column);
    print_techniques(&chart);
    print_passes(&chart);
    print_batches(&chart);
    rg_dump_print(d, "</div>\n");
    for (uint32_t i = 0; i < d->plan->block_count; i++)
        print_block(&chart, i);
    print_bars(&chart, PERSISTENT, "Persistent");
    print_bars(&chart, IMPORTED, "Imported");
    print_bars(&chart, HOST, "Host memory");
    rg_dump_print(d, "</main>\n");
}
