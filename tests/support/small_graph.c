/* small_graph.c: compiles small render graphs; has stubs for their callbacks. */
#include "tests/support/small_graph.h"

#include <stdio.h>

#include "tests/support/assertions.h"

const struct rg_shader small_graph_shader = { .name = "shader" };

void small_graph_record(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)cmd;
    (void)frame;
}

VkRect2D small_graph_area(const struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)cmd;
    (void)frame;
    return (VkRect2D){ 0 };
}

struct rg_plan *small_graph_compile(const struct small_graph *graph)
{
    const struct rg_technique technique = { "tech", graph->passes, graph->pass_count };
    const struct rg_technique *const techniques[] = { &technique };
    struct rg_compile_params params = {
        .techniques = techniques,
        .technique_count = 1,
        .view = graph->view,
        .outputs = graph->outputs,
        .imports = graph->imports,
        .sizes = graph->sizes,
        .size_count = graph->sizes[0].image != NULL,
        .sharing = graph->sharing,
    };
    while (graph->outputs[params.output_count].access)
        params.output_count++;
    while (graph->imports[params.import_count].image)
        params.import_count++;
    if (!params.view.width)
        params.view = (VkExtent2D){ SMALL_GRAPH_SIZE, SMALL_GRAPH_SIZE };
    struct rg_plan *plan = rg_compile(&params);
    assert_non_null(plan);
    if (plan->fault_count)
        rg_dump(plan, stderr);
    assert_int_equal(plan->fault_count, 0);
    return plan;
}

uint32_t small_graph_find(const struct rg_plan *plan, const struct rg_image *image)
{
    for (uint32_t i = 0; i < plan->image_count; i++) {
        if (plan->images[i].image == image)
            return i;
    }
    return RG_NONE;
}
