/* objects.c: calls that may fail, and the list of what they make, which frees all of it. */
#include <stdlib.h>
#include "graph/exec/exec.h"

struct exec_object {
    VkObjectType type; /* VK_OBJECT_TYPE_UNKNOWN: memory of the host */
    uint64_t handle;
};

VkResult rg_exec_check(const struct rg_exec *exec, VkResult result, const char *call,
                       const char *of)
{
    char what[512];
    if (result == VK_SUCCESS || !exec->params.log)
        return result;
    if (of)
        snprintf(what, sizeof(what), "%s of %s", call, of);
    else
        snprintf(what, sizeof(what), "%s of a frame of %u passes", call, exec->plan->pass_count);
    exec->params.log(exec->params.user, what, result);
    return result;
}

VkResult rg_exec_make_room(struct rg_exec *exec)
{
    if (exec->object_count < exec->object_room)
        return VK_SUCCESS;
    uint32_t room = exec->object_room * 2 + 64;
    struct exec_object *objects = realloc(exec->objects, room * sizeof(*objects));
    if (!objects)
        return rg_exec_check(exec, VK_ERROR_OUT_OF_HOST_MEMORY, "realloc", NULL);
    exec->objects = objects;
    exec->object_room = room;
    return VK_SUCCESS;
}

void rg_exec_keep(struct rg_exec *exec, VkObjectType type, uint64_t handle, const char *name)
{
    const VkDebugUtilsObjectNameInfoEXT info = {
        .sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT,
        .objectType = type,
        .objectHandle = handle,
        .pObjectName = name,
    };
    exec->objects[exec->object_count++] = (struct exec_object){ type, handle };
    if (name && exec->vk.SetDebugUtilsObjectNameEXT)
        exec->vk.SetDebugUtilsObjectNameEXT(exec->device, &info);
}

/* At least one element: calloc() may return NULL for none, which would look like a failure. */
void *rg_exec_make_array(struct rg_exec *exec, size_t count, size_t size)
{
    if (rg_exec_make_room(exec) != VK_SUCCESS)
        return NULL;
    void *array = calloc(count ? count : 1, size);
    if (array)
        rg_exec_keep(exec, VK_OBJECT_TYPE_UNKNOWN, (uintptr_t)array, NULL);
    else
        rg_exec_check(exec, VK_ERROR_OUT_OF_HOST_MEMORY, "calloc", NULL);
    return array;
}

static void free_object(const struct rg_exec *exec, const struct exec_object *object)
{
#define DESTROY(kind, name) \
    if (object->type == VK_OBJECT_TYPE_##kind) \
        exec->vk.Destroy##name(exec->device, (Vk##name)object->handle, NULL);
    DESTROY(BUFFER, Buffer)
    DESTROY(COMMAND_POOL, CommandPool)
    DESTROY(DESCRIPTOR_POOL, DescriptorPool)
    DESTROY(DESCRIPTOR_SET_LAYOUT, DescriptorSetLayout)
    DESTROY(FENCE, Fence)
    DESTROY(FRAMEBUFFER, Framebuffer)
    DESTROY(IMAGE, Image)
    DESTROY(IMAGE_VIEW, ImageView)
    DESTROY(PIPELINE, Pipeline)
    DESTROY(PIPELINE_LAYOUT, PipelineLayout)
    DESTROY(QUERY_POOL, QueryPool)
    DESTROY(RENDER_PASS, RenderPass)
    DESTROY(SAMPLER, Sampler)
    if (object->type == VK_OBJECT_TYPE_DEVICE_MEMORY)
        exec->vk.FreeMemory(exec->device, (VkDeviceMemory)object->handle, NULL);
    if (object->type == VK_OBJECT_TYPE_UNKNOWN)
        free((void *)(uintptr_t)object->handle);
}

void rg_exec_free_objects(struct rg_exec *exec)
{
    while (exec->object_count)
        free_object(exec, &exec->objects[--exec->object_count]);
    free(exec->objects);
}
