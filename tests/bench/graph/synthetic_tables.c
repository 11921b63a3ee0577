/* synthetic_tables.c: rows filled at run time. */
#include "tests/bench/graph/synthetic_tables.h"
#include <stdlib.h>

static rg_record_fn record;
static rg_when_fn when;

static const struct rg_shader shader = { .name = "synthetic.comp" };

static void record(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)cmd, (void)frame; /* never runs */
}

static bool when(const struct rg_frame *frame, uint32_t repetition)
{
    (void)frame, (void)repetition; /* never runs */
    return true;
}

static VkFormat format_of(const struct synthetic_image *image)
{
    return image->depth              ? VK_FORMAT_D32_SFLOAT
           : image->texel_size == 16 ? VK_FORMAT_R32G32B32A32_SFLOAT
           : image->texel_size == 8  ? VK_FORMAT_R16G16B16A16_SFLOAT
                                     : VK_FORMAT_R8G8B8A8_UNORM;
}

/* Writes of raster passes are targets. */
static struct rg_use *fill_uses(const struct synthetic_tables *tables, struct rg_use *use,
                                const struct synthetic_pass *pass)
{
    uint16_t binding = 0;
    uint32_t write_count = pass->raster ? 0 : pass->write_count;
    for (uint32_t i = 0; i < pass->read_count - pass->tests_depth; i++) {
        *use++ = (struct rg_use){
            .image = &tables->images[pass->reads[i]],
            .access = RG_SAMPLED,
            .binding = binding++,
        };
    }
    for (uint32_t i = 0; i < write_count; i++) {
        *use++ = (struct rg_use){
            .image = &tables->images[pass->writes[i]],
            .access = RG_STORAGE_WRITE,
            .binding = binding++,
        };
    }
    *use++ = (struct rg_use){ 0 };
    return use;
}

static struct rg_target *fill_targets(const struct synthetic_tables *tables,
                                      struct rg_target *target, const struct synthetic_pass *pass,
                                      struct rg_pass *row)
{
    enum rg_load load = pass->keeps ? RG_LOAD_KEEP : RG_LOAD_CLEAR;
    row->color = target;
    row->color_count = pass->write_count - pass->has_depth;
    for (uint32_t i = 0; i < row->color_count; i++)
        *target++ = (struct rg_target){ .image = &tables->images[pass->writes[i]], .load = load };
    if (pass->has_depth)
        row->depth = (struct rg_target){
            .image = &tables->images[pass->writes[row->color_count]],
            .load = load,
        };
    if (pass->tests_depth)
        row->depth.image = &tables->images[pass->reads[pass->read_count - 1]];
    row->depth_read_only = pass->tests_depth;
    row->kind = RG_RASTER;
    row->vert = row->frag = &shader;
    row->comp = NULL;
    if (row->color_count && row->color[0].image->cube)
        row->repeat = RG_PER_LAYER;
    return target;
}

/* Repetitions of a row are in one. */
static uint32_t fill_rows(const struct synthetic_tables *tables, const struct synthetic *graph)
{
    struct rg_use *use = tables->uses;
    struct rg_target *target = tables->targets;
    uint32_t row_count = 0;
    for (uint32_t i = 0; i < graph->pass_count; i++) {
        const struct synthetic_pass *pass = &graph->passes[i];
        struct rg_pass *row = &tables->passes[row_count];
        if (pass->repetition)
            continue;
        *row = (struct rg_pass){
            .name = pass->name,
            .kind = RG_COMPUTE,
            .uses = use,
            .comp = &shader,
            .record = record,
            .when = pass->conditional ? when : NULL,
        };
        if (pass->raster)
            target = fill_targets(tables, target, pass, row);
        use = fill_uses(tables, use, pass);
        row_count++;
    }
    return row_count;
}

void synthetic_tables_fill(struct synthetic_tables *tables, const struct synthetic *graph)
{
    for (uint32_t i = 0; i < graph->image_count; i++) {
        const struct synthetic_image *image = &graph->images[i];
        tables->images[i] = (struct rg_image){
            .name = image->name,
            .format = format_of(image),
            .width = image->width,
            .height = image->height,
            .cube = image->cube,
        };
    }
    uint32_t row_count = fill_rows(tables, graph);
    tables->technique = (struct rg_technique){ "synthetic", tables->passes, row_count };
    tables->techniques[0] = &tables->technique;
    tables->import = (struct rg_import){ .image = tables->images };
    tables->output = (struct rg_output){ .image = tables->images, .access = RG_PRESENT };
    tables->params = (struct rg_compile_params){
        .techniques = tables->techniques,
        .technique_count = 1,
        .view = { graph->images[0].width, graph->images[0].height },
        .outputs = &tables->output,
        .output_count = 1,
        .imports = &tables->import,
        .import_count = 1,
    };
}

bool synthetic_tables_init(struct synthetic_tables *tables, const struct synthetic *graph)
{
    *tables = (struct synthetic_tables){
        .images = calloc(graph->image_count, sizeof(*tables->images)),
        .passes = calloc(graph->pass_count, sizeof(*tables->passes)),
        .uses = calloc((size_t)graph->access_count + graph->pass_count, sizeof(*tables->uses)),
        .targets = calloc(graph->access_count, sizeof(*tables->targets)),
    };
    if (tables->images && tables->passes && tables->uses && tables->targets)
        return true;
    synthetic_tables_finish(tables);
    return false;
}

void synthetic_tables_finish(struct synthetic_tables *tables)
{
    free(tables->images);
    free(tables->passes);
    free(tables->uses);
    free(tables->targets);
    *tables = (struct synthetic_tables){ 0 };
}
