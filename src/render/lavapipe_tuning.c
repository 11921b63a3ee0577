/* lavapipe_tuning.c: environment variables and memory page size for software Vulkan drivers. */
#include "src/render/lavapipe_tuning.h"
#include "src/base/environment.h"
#include "src/base/machine.h"

bool lavapipe_tuning_is_cpu(const struct gpu *gpu)
{
    return gpu->properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
}

void lavapipe_tuning_prefer_start(void)
{
    (void)environment_set_default("GALLIVM_PERF", "nopt"); /* failure only costs time */
}

/* Page sizes can be chosen because a CPU device's memory is ordinary memory of this process. */
void lavapipe_tuning_advise_memory(const struct gpu *gpu, const struct frame_plan *frame,
                                   struct rg_exec *exec)
{
    const uintptr_t page = 2 << 20;
    const struct rg_plan *plan = frame->plan;
    const bool whole = !frame->max_region.width;
    if (!lavapipe_tuning_is_cpu(gpu))
        return;
    for (uint32_t i = 0; i < plan->block_count; i++) {
        VkDeviceMemory memory = rg_exec_block(exec, i);
        void *mapped;
        if (vkMapMemory(gpu->device, memory, 0, VK_WHOLE_SIZE, 0, &mapped) != VK_SUCCESS)
            continue;
        const uintptr_t start = (uintptr_t)mapped;
        const uintptr_t begin = (start + page - 1) / page * page;
        const uintptr_t end = (start + (uintptr_t)plan->blocks[i].size) / page * page;
        if (begin < end)
            machine_advise_pages((char *)mapped + (begin - start), end - begin, whole);
        vkUnmapMemory(gpu->device, memory);
    }
}
