/*
 * bench.c: rg_exec_update() beside rg_exec_create(), of firn's own frames: the view changes from
 * 1024x768 to 1500x950 and back, within the largest view and without one; the rung changes, and
 * settings that change the plan.
 * Fails if the median of the ratio is above 0.25 within the largest view, or above 0.5 otherwise.
 * The executors draw nothing.
 */
#include <stdio.h>
#include <stdlib.h>

#include "graph/rg_exec.h"
#include "src/base/clock.h"
#include "src/gpu/gpu_internal.h"
#include "src/render/frame/compile_frame_plan.h"
#include "src/scene/scene.h"
#include "tests/support/assertions.h"

enum {
    RUN_COUNT = 25
};

struct change {
    const char *name;
    const char *refraction_models[2]; /* before and after */
    VkExtent2D views[2];
    VkExtent2D max_view; /* 0x0: none */
    double most;         /* ratio */
    const char *setting; /* after the change; NULL: the same */
};

static const struct change changes[] = {
    { "view, within the largest",
      { "paper", "paper" },
      { { 1024, 768 }, { 1500, 950 } },
      { 1500, 950 },
      0.25 },
    { "view", { "paper", "paper" }, { { 1024, 768 }, { 1500, 950 } }, { 0, 0 }, 0.5 },
    { "rung", { "paper", "bounce" }, { { 1024, 768 }, { 1024, 768 } }, { 0, 0 }, 0.5 },
    { "cracks",
      { "paper", "paper" },
      { { 1024, 768 }, { 1024, 768 } },
      { 0, 0 },
      0.5,
      "cracks.count=0" },
    { "air", { "paper", "paper" }, { { 1024, 768 }, { 1024, 768 } }, { 0, 0 }, 0.5, "air.count=0" },
    { "nothing", { "paper", "paper" }, { { 1024, 768 }, { 1024, 768 } }, { 0, 0 }, 0.25 },
};

enum {
    IMPORT_COUNT = 64
};

struct side {
    struct settings settings;
    struct frame_plan frame; /* the tables */
    struct rg_plan *plan;
    struct rg_exec_import imports[IMPORT_COUNT]; /* without content */
    VkDeviceMemory memory[IMPORT_COUNT];
};

static VkImage make_image(struct gpu *gpu, const struct rg_plan_image *plan, VkDeviceMemory *memory)
{
    const VkImageCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
        .flags = plan->flags,
        .imageType = plan->depth > 1 ? VK_IMAGE_TYPE_3D : VK_IMAGE_TYPE_2D,
        .format = plan->image->format,
        .extent = { plan->extent.width, plan->extent.height, plan->depth },
        .mipLevels = plan->mips,
        .arrayLayers = plan->layers,
        .samples = VK_SAMPLE_COUNT_1_BIT,
        .usage = plan->usage,
    };
    VkMemoryRequirements needs;
    VkImage image;
    assert_int_equal(vkCreateImage(gpu->device, &info, NULL, &image), VK_SUCCESS);
    vkGetImageMemoryRequirements(gpu->device, image, &needs);
    assert_int_equal(gpu_memory_allocate(gpu, &needs, GPU_MEMORY_DEVICE, NULL, memory), STATUS_OK);
    assert_int_equal(vkBindImageMemory(gpu->device, image, *memory, 0), VK_SUCCESS);
    return image;
}

static void make_imports(struct gpu *gpu, struct side *side)
{
    assert_true(side->frame.import_count <= IMPORT_COUNT);
    for (uint32_t i = 0; i < side->plan->image_count; i++) {
        const struct rg_plan_image *image = &side->plan->images[i];
        if (image->imported)
            side->imports[image->import].image =
                make_image(gpu, image, &side->memory[image->import]);
    }
    for (uint32_t i = 0; i < side->plan->buffer_count; i++) {
        const struct rg_plan_buffer *buffer = &side->plan->buffers[i];
        struct gpu_buffer made;
        if (!buffer->imported)
            continue;
        assert_int_equal(gpu_memory_buffer(gpu, &made, buffer->usage, buffer->size, false, NULL),
                         STATUS_OK);
        side->imports[buffer->import].buffer = made.buffer;
        side->memory[buffer->import] = made.memory;
    }
}

static void destroy_imports(const struct gpu *gpu, const struct side *side)
{
    for (int i = 0; i < IMPORT_COUNT; i++) {
        vkDestroyImage(gpu->device, side->imports[i].image, NULL);
        vkDestroyBuffer(gpu->device, side->imports[i].buffer, NULL);
        vkFreeMemory(gpu->device, side->memory[i], NULL);
    }
}

static void init_side(struct side *side, const struct change *change, int which,
                      const struct rg_device *device)
{
    side->settings = settings_default();
    if (which && change->setting)
        assert_int_equal(settings_assign(&side->settings, change->setting, SETTING_USER, NULL),
                         STATUS_OK);
    static const struct scene scene = { 0 };
    const struct frame_request request = {
        .config = { .settings = &side->settings,
                    .scene = &scene,
                    .refraction = techniques_find_refraction(change->refraction_models[which]) },
        .view = change->views[which],
        .beauty = true,
        .display = true,
        .device = device,
    };
    assert_int_equal(frame_plan_init(&side->frame, &request), STATUS_OK);
    side->plan = rg_compile(&(struct rg_compile_params){
        .techniques = side->frame.techniques,
        .technique_count = side->frame.technique_count,
        .view = request.view,
        .max_view = change->max_view,
        .outputs = side->frame.outputs,
        .output_count = side->frame.output_count,
        .imports = side->frame.imports,
        .import_count = side->frame.import_count,
        .device = device,
    });
    assert_non_null(side->plan);
    assert_int_equal(side->plan->fault_count, 0);
}

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a;
    const double y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median(double values[static RUN_COUNT])
{
    qsort(values, RUN_COUNT, sizeof(*values), compare);
    return values[RUN_COUNT / 2];
}

/* Returns whether the change is as cheap as it must be. */
static bool measure(struct gpu *gpu, const struct rg_vulkan *vulkan, const struct change *change)
{
    const struct rg_device device = rg_exec_device(vulkan);
    double fresh[RUN_COUNT], updates[RUN_COUNT], ratios[RUN_COUNT];
    struct side sides[2] = { 0 };
    for (int i = 0; i < 2; i++) {
        init_side(&sides[i], change, i, &device);
        make_imports(gpu, &sides[i]);
    }
    struct rg_exec_params params = {
        .plan = sides[0].plan,
        .instance = gpu->instance,
        .get_proc_addr = vulkan->get_proc_addr,
        .physical = gpu->physical,
        .device = gpu->device,
        .queue = gpu->queue,
        .queue_family = gpu->queue_family,
        .pipeline_cache = gpu->pipeline_cache,
        .max_anisotropy = gpu->max_anisotropy,
        .imports = sides[0].imports,
        .import_count = sides[0].frame.import_count,
    };
    struct rg_exec *changed = rg_exec_create(&params, NULL);
    assert_non_null(changed);
    for (int i = 0; i < RUN_COUNT; i++) {
        params.plan = sides[(i + 1) % 2].plan;
        params.imports = sides[(i + 1) % 2].imports;
        params.import_count = sides[(i + 1) % 2].frame.import_count;
        const double start = clock_ms();
        struct rg_exec *exec = rg_exec_create(&params, NULL);
        fresh[i] = clock_ms() - start;
        assert_non_null(exec);
        rg_exec_destroy(exec);
        const double middle = clock_ms();
        assert_int_equal(rg_exec_update(changed, &params), VK_SUCCESS);
        updates[i] = clock_ms() - middle;
        ratios[i] = updates[i] / fresh[i];
    }
    rg_exec_destroy(changed);
    for (int i = 0; i < 2; i++) {
        destroy_imports(gpu, &sides[i]);
        rg_plan_destroy(sides[i].plan);
        frame_plan_finish(&sides[i].frame);
    }
    const double ratio = median(ratios);
    printf("%s: fresh %.2f ms, update %.2f ms, ratio %.4f, at most %.2f\n", change->name,
           median(fresh), median(updates), ratio, change->most);
    return ratio <= change->most;
}

int main(void)
{
    struct gpu gpu;
    bool good = true;
    if (gpu_create(&gpu, &(struct gpu_params){ 0 }) != STATUS_OK)
        return 77;
    const struct rg_vulkan vulkan = { gpu.instance, vkGetInstanceProcAddr, gpu.physical,
                                      gpu.device };
    for (size_t i = 0; i < sizeof(changes) / sizeof(changes[0]); i++)
        good &= measure(&gpu, &vulkan, &changes[i]);
    gpu_destroy(&gpu);
    return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
