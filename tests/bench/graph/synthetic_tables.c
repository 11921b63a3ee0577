/* synthetic_tables.c: rows filled at run time. */
#include "tests/bench/graph/synthetic_tables.h"
#include <stdlib.h>

static rg_record_fn record;

static const struct rg_shader shader = { .name = "synthetic.comp" };

static void record(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)cmd, (void)frame; /* never runs */
}

static VkFormat format_of(uint32_t texel_size)
{
    return texel_size == 16  ? VK_FORMAT_R32G32B32A32_SFLOAT
           : texel_size == 8 ? VK_FORMAT_R16G16B16A16_SFLOAT
                             : VK_FORMAT_R8G8B8A8_UNORM;
}

static struct rg_use *fill_uses(const struct synthetic_tables *tables, struct rg_use *use,
                                const struct synthetic_pass *pass)
{
    uint16_t binding = 0;
    for (uint32_t i = 0; i < pass->read_count; i++) {
        *use++ = (struct rg_use){
            .image = &tables->images[pass->reads[i]],
            .access = RG_SAMPLED,
            .binding = binding++,
        };
    }
    for (uint32_t i = 0; i < pass->write_count; i++) {
        *use++ = (struct rg_use){
            .image = &tables->images[pass->writes[i]],
            .access = RG_STORAGE_WRITE,
            .binding = binding++,
        };
    }
    *use++ = (struct rg_use){ 0 };
    return use;
}

void synthetic_tables_fill(struct synthetic_tables *tables, const struct synthetic *graph)
{
    for (uint32_t i = 0; i < graph->image_count; i++) {
        const struct synthetic_image *image = &graph->images[i];
        tables->images[i] = (struct rg_image){
            .name = image->name,
            .format = format_of(image->texel_size),
            .width = image->width,
            .height = image->height,
        };
    }
    struct rg_use *use = tables->uses;
    for (uint32_t i = 0; i < graph->pass_count; i++) {
        tables->passes[i] = (struct rg_pass){
            .name = graph->passes[i].name,
            .kind = RG_COMPUTE,
            .uses = use,
            .comp = &shader,
            .record = record,
        };
        use = fill_uses(tables, use, &graph->passes[i]);
    }
    tables->technique = (struct rg_technique){ "synthetic", tables->passes, graph->pass_count };
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
    };
    if (tables->images && tables->passes && tables->uses)
        return true;
    synthetic_tables_finish(tables);
    return false;
}

void synthetic_tables_finish(struct synthetic_tables *tables)
{
    free(tables->images);
    free(tables->passes);
    free(tables->uses);
    *tables = (struct synthetic_tables){ 0 };
}
