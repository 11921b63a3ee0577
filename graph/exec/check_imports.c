/* check_imports.c: compares imported objects with what the plan was compiled for. */
#include "graph/exec/executor_internal.h"

/* Logs a difference between an import and its declaration. */
static VkResult refuse(const struct rg_exec *exec, const char *name, const char *what,
                       uint64_t found, uint64_t expected)
{
    char text[192];
    snprintf(text, sizeof(text), "%s %llu, where the plan has %llu, in the import", what,
             (unsigned long long)found, (unsigned long long)expected);
    return rg_exec_check(exec, VK_ERROR_INITIALIZATION_FAILED, text, name);
}

/* Member of a create info: value in the import, and value that the plan expects. */
struct fact {
    const char *name;
    uint64_t found, expected;

    enum {
        FACT_EQUAL,
        FACT_AT_LEAST, /* found >= expected */
        FACT_CONTAINS, /* bit masks: found has all bits of expected */
    } rule;
};

static VkResult check_facts(const struct rg_exec *exec, const char *name, const struct fact *facts,
                            size_t count)
{
    VkResult result = VK_SUCCESS;
    for (size_t i = 0; i < count; i++) {
        const struct fact *f = &facts[i];
        if (f->rule == FACT_EQUAL      ? f->found != f->expected
            : f->rule == FACT_AT_LEAST ? f->found < f->expected
                                       : (f->expected & ~f->found) != 0)
            result = refuse(exec, name, f->name, f->found, f->expected);
    }
    return result;
}

static VkResult check_image(const struct rg_exec *exec, const struct rg_plan_image *plan,
                            const struct rg_exec_import *import)
{
    const VkImageCreateInfo needed = rg_image_create_info(plan);
    const VkImageCreateInfo *has = import->image_info ? import->image_info : &needed;
    uint32_t families[RG_QUEUE_COUNT];
    const bool is_shared = rg_exec_families(exec, plan->queues, families) > 1;
    const struct fact facts[] = {
        { "flags", has->flags, needed.flags, FACT_CONTAINS },
        { "imageType", (uint64_t)has->imageType, (uint64_t)needed.imageType, FACT_EQUAL },
        { "format", (uint64_t)has->format, (uint64_t)needed.format, FACT_EQUAL },
        { "extent.width", has->extent.width, needed.extent.width, FACT_EQUAL },
        { "extent.height", has->extent.height, needed.extent.height, FACT_EQUAL },
        { "extent.depth", has->extent.depth, needed.extent.depth, FACT_EQUAL },
        { "mipLevels", has->mipLevels, needed.mipLevels, FACT_AT_LEAST },
        { "arrayLayers", has->arrayLayers, needed.arrayLayers, FACT_AT_LEAST },
        { "samples", (uint64_t)has->samples, (uint64_t)needed.samples, FACT_EQUAL },
        { "usage", has->usage, needed.usage, FACT_CONTAINS },
        { "sharingMode", has->sharingMode, import->image_info && is_shared, FACT_AT_LEAST },
    };
    bool is_null = !import->image_count && !import->image;
    for (uint32_t i = 0; i < import->image_count; i++)
        is_null = is_null || !import->images[i];
    if (is_null)
        return rg_exec_check(exec, VK_ERROR_INITIALIZATION_FAILED, "VK_NULL_HANDLE as the import",
                             plan->image->name);
    return check_facts(exec, plan->image->name, facts, sizeof(facts) / sizeof(facts[0]));
}

static VkResult check_buffer(const struct rg_exec *exec, const struct rg_plan_buffer *plan,
                             const struct rg_exec_import *import)
{
    const VkBufferCreateInfo *info = import->buffer_info;
    const bool is_structure = plan->usage & VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_STORAGE_BIT_KHR;
    VkMemoryRequirements memory;
    uint32_t families[RG_QUEUE_COUNT];
    const bool is_shared = rg_exec_families(exec, plan->queues, families) > 1;
    if (!import->buffer || (is_structure && !import->acceleration))
        return rg_exec_check(exec, VK_ERROR_INITIALIZATION_FAILED, "VK_NULL_HANDLE as the import",
                             plan->buffer->name);
    exec->vk.GetBufferMemoryRequirements(exec->device, import->buffer, &memory);
    const struct fact facts[] = {
        { "size", info ? info->size : memory.size, plan->size, FACT_AT_LEAST },
        { "usage", info ? info->usage : plan->usage, plan->usage, FACT_CONTAINS },
        { "sharingMode", info ? info->sharingMode : 1, is_shared, FACT_AT_LEAST },
    };
    return check_facts(exec, plan->buffer->name, facts, sizeof(facts) / sizeof(facts[0]));
}

VkResult rg_exec_check_imports(struct rg_exec *exec)
{
    const struct rg_plan *plan = exec->plan;
    const struct rg_exec_import *imports = exec->params.imports;
    const size_t count = exec->params.import_count; /* device_memory.c reports missing ones */
    VkResult result = VK_SUCCESS;
    for (uint32_t i = 0; i < plan->image_count && result == VK_SUCCESS; i++) {
        if (plan->images[i].import < count)
            result = check_image(exec, &plan->images[i], &imports[plan->images[i].import]);
    }
    for (uint32_t i = 0; i < plan->buffer_count && result == VK_SUCCESS; i++) {
        if (plan->buffers[i].import < count)
            result = check_buffer(exec, &plan->buffers[i], &imports[plan->buffers[i].import]);
    }
    return result;
}
