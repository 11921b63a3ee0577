/* run_graph.c: compiles render graphs for a device and executes them. */
#include "tests/support/run_graph.h"

#include <string.h>

#include "graph/exec/vulkan_functions.h"
#include "tests/support/assertions.h"

static void log_line(void *user, const char *what, VkResult result)
{
    struct run *run = user;
    run->line_count++;
    (void)snprintf(run->line, sizeof(run->line), "VkResult %d from %s", (int)result, what);
}

/* Returns volk's current function pointers, which a test may have replaced by mocks. */
static PFN_vkVoidFunction find_function(VkInstance instance, const char *name)
{
#define ROW(function) \
    if (strcmp(name, "vk" #function) == 0) \
        return (PFN_vkVoidFunction)vk##function;
    RG_FUNCTIONS(ROW)
    RG_FUNCTIONS_OPTIONAL(ROW)
    return vkGetInstanceProcAddr(instance, name);
}

static void print_faults(const struct rg_plan *plan)
{
    for (uint32_t i = 0; i < plan->fault_count; i++) {
        char text[300];
        (void)rg_fault_text(&plan->faults[i], text, sizeof(text));
        print_error("%s\n", text);
    }
}

void run_tables_init(struct run_tables *tables, const struct run_params *params,
                     const struct rg_device *device)
{
    size_t output_count = 0;
    for (size_t i = 0; params->outputs[i]; i++)
        tables->outputs[output_count++] = (struct rg_output){
            .buffer = params->outputs[i],
            .access = RG_HOST_READ,
        };
    for (size_t i = 0; params->kept[i].image || params->kept[i].buffer; i++)
        tables->outputs[output_count++] = params->kept[i];
    tables->technique = &params->technique;
    tables->compile = (struct rg_compile_params){
        .techniques = &tables->technique,
        .technique_count = 1,
        .view = params->view.width ? params->view : (VkExtent2D){ 8, 8 },
        .max_view = params->max_view,
        .outputs = tables->outputs,
        .output_count = output_count,
        .imports = params->imports,
        .import_count = params->import_count,
        .device = device,
        .sharing = params->sharing,
        .queues = params->queues,
    };
}

struct rg_plan *run_plan(const struct run_params *params, const struct rg_device *device)
{
    struct run_tables tables;
    run_tables_init(&tables, params, device);
    struct rg_plan *plan = rg_compile(&tables.compile);
    assert_non_null(plan);
    print_faults(plan);
    assert_int_equal(plan->fault_count, 0);
    return plan;
}

void run_compile(struct run *run, struct gpu *gpu, const struct run_params *params)
{
    *run = (struct run){
        .params = *params,
        .vulkan = { gpu->instance, find_function, gpu->physical, gpu->device },
        .gpu = gpu,
    };
    const struct rg_device device = rg_exec_device(&run->vulkan);
    run->plan = run_plan(&run->params, params->no_device ? NULL : &device);
}

static struct rg_exec_params exec_params(struct run *run, const struct rg_plan *plan)
{
    const struct rg_exec_queue main_queue = { run->gpu->queue, run->gpu->queue_family };
    return (struct rg_exec_params){
        .plan = plan,
        .instance = run->gpu->instance,
        .get_proc_addr = find_function,
        .physical = run->gpu->physical,
        .device = run->gpu->device,
        .queue = run->gpu->queue,
        .queue_family = run->gpu->queue_family,
        .compute = main_queue,
        .transfer = run->params.transfer ? *run->params.transfer : main_queue,
        .pipeline_cache = run->gpu->pipeline_cache,
        .pipelines = run->params.pipelines,
        .frames_in_flight = run->params.frames_in_flight,
        .imports = run->params.objects,
        .import_count = run->params.import_count,
        .sets = run->params.sets,
        .samplers = run->params.own_sampler,
        .sampler_count = run->params.own_sampler != NULL,
        .set_count = run->params.sets ? 1 : 0,
        .max_anisotropy = run->gpu->max_anisotropy,
        .measured = run->params.measure.clock || run->params.measure.statistics,
        .statistics = run->gpu->has_statistics,
        .constants = run->params.constants,
        .log = log_line,
        .user = run,
    };
}

VkResult run_create(struct run *run, const struct rg_plan *plan)
{
    const struct rg_exec_params params = exec_params(run, plan);
    VkResult result = VK_ERROR_UNKNOWN;
    run->exec = rg_exec_create_extended(&params,
                                        &(struct rg_exec_extensions){ run->params.render_passes,
                                                                      run->params.more,
                                                                      run->params.same_texel },
                                        &result);
    if (run->exec)
        rg_exec_measure(run->exec, &run->params.measure);
    assert_int_equal(!run->exec, result != VK_SUCCESS);
    return result;
}

VkResult run_try_update(struct run *run, const struct run_params *params)
{
    const struct rg_device device = rg_exec_device(&run->vulkan);
    struct rg_plan *former = run->plan;
    run->params = *params;
    run->plan = run_plan(&run->params, &device);
    const struct rg_exec_params changed = exec_params(run, run->plan);
    VkResult result = rg_exec_update(run->exec, &changed);
    rg_plan_destroy(former);
    return result;
}

void run_update(struct run *run, const struct run_params *params)
{
    if (run_try_update(run, params) != VK_SUCCESS)
        fail_msg("%s", run->line);
}

void run_open(struct run *run, struct gpu *gpu, const struct run_params *params)
{
    run_compile(run, gpu, params);
    if (run_create(run, run->plan) != VK_SUCCESS)
        fail_msg("%s", run->line);
}

void run_close(struct run *run)
{
    rg_exec_destroy(run->exec);
    rg_plan_destroy(run->plan);
    *run = (struct run){ 0 };
}

void run_frame(struct run *run, const struct rg_frame *frame)
{
    assert_int_equal(rg_exec_begin(run->exec, &run->slot), VK_SUCCESS);
    VkResult result = VK_NOT_READY;
    while (run->params.is_in_parts && result == VK_NOT_READY)
        result = rg_exec_submit_part(run->exec, frame, 0.0);
    if (!run->params.is_in_parts)
        result = rg_exec_submit(run->exec, frame);
    assert_int_equal(result, VK_SUCCESS);
    assert_int_equal(rg_exec_wait(run->exec, run->slot), VK_SUCCESS);
}

void *run_data(struct run *run, const struct rg_buffer *buffer)
{
    void *data = rg_exec_mapped(run->exec, buffer, run->slot);
    assert_non_null(data);
    return data;
}

struct run_params run_variant(const struct run_params *params, unsigned variant)
{
    struct run_params changed = *params;
    changed.render_passes = variant & 1;
    changed.sharing = variant & 2 ? RG_SHARE_NOTHING : RG_SHARE_FEWEST_BATCHES;
    return changed;
}

void run_variants(struct gpu *gpu, const struct run_params *params, const struct rg_frame *frame,
                  void (*check)(struct run *run))
{
    for (unsigned variant = 0; variant < 2 * RUN_VARIANT_COUNT; variant++) {
        struct run_params changed = run_variant(params, variant);
        changed.is_in_parts = variant >= RUN_VARIANT_COUNT;
        struct run run;
        run_open(&run, gpu, &changed);
        run_frame(&run, frame);
        check(&run);
        run_close(&run);
    }
}

void run_record_read(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    const struct rg_use *uses = rg_cmd_pass(cmd)->uses;
    rg_cmd_copy_image_to_buffer(cmd, uses[0].image, uses[1].buffer, 0);
}
