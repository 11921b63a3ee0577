/* object_cache.c: error handling of Vulkan calls, and an executor's objects, cached by key. An
 * object with a key is reused: for equal content in one plan, by the next plan, or (pipelines) by
 * another executor. Keys contain handles of other objects, which is safe, since these are in the
 * same list, and lists move as a whole. */
#include <stdlib.h>
#include <string.h>
#include "graph/exec/executor_internal.h"

enum {
    UNUSED_MAX = 1, /* plans that an unused pipeline survives */
};

struct exec_object {
    VkObjectType type; /* UNKNOWN: host memory; MAX_ENUM: moved */
    uint64_t handle;
    uint64_t key;    /* RG_NO_KEY: never reused */
    uint32_t unused; /* plans since its last use */
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

VkResult rg_exec_reserve_object(struct rg_exec *exec)
{
    struct exec_objects *list = &exec->objects;
    if (list->count < list->room)
        return VK_SUCCESS;
    uint32_t room = list->room * 2 + 64;
    struct exec_object *entries = realloc(list->entries, room * sizeof(*entries));
    if (!entries)
        return rg_exec_check(exec, VK_ERROR_OUT_OF_HOST_MEMORY, "realloc", NULL);
    list->entries = entries;
    list->room = room;
    return VK_SUCCESS;
}

uint64_t rg_exec_key(uint64_t key, const void *data, size_t size)
{
    const unsigned char *bytes = data;
    uint64_t word = 0;
    for (; size; bytes += sizeof(word)) {
        size_t part = size < sizeof(word) ? size : sizeof(word);
        memcpy(&word, bytes, part);
        key = (key ^ word) * UINT64_C(0x9e3779b97f4a7c15);
        key ^= key >> 29;
        size -= part;
    }
    return key ? key : 1;
}

/* Returns true for types of objects that several users can share, as they have no content. */
static bool can_be_shared(VkObjectType type)
{
    return type == VK_OBJECT_TYPE_SAMPLER || type == VK_OBJECT_TYPE_IMAGE_VIEW ||
           type == VK_OBJECT_TYPE_BUFFER_VIEW || type == VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT ||
           type == VK_OBJECT_TYPE_PIPELINE_LAYOUT || type == VK_OBJECT_TYPE_PIPELINE ||
           type == VK_OBJECT_TYPE_RENDER_PASS || type == VK_OBJECT_TYPE_FRAMEBUFFER;
}

/* Finds an object of the previous plan. Each search resumes where the last one ended, because both
 * plans create objects in about the same order. */
static struct exec_object *find_former(struct exec_objects *former, VkObjectType type, uint64_t key)
{
    for (uint32_t i = 0; i < former->count; i++) {
        uint32_t at = (former->next + i) % former->count;
        if (former->entries[at].key == key && former->entries[at].type == type) {
            former->next = at + 1;
            return &former->entries[at];
        }
    }
    return NULL;
}

bool rg_exec_find(struct rg_exec *exec, VkObjectType type, uint64_t key, void *handle, size_t size)
{
    const struct exec_objects *own = &exec->objects;
    const struct exec_object *found = NULL;
    exec->found = RG_NOT_FOUND;
    if (key == RG_NO_KEY)
        return false;
    for (uint32_t i = 0; i < own->count && !found && can_be_shared(type); i++) {
        if (own->entries[i].key == key && own->entries[i].type == type)
            found = &own->entries[i];
    }
    if (found) {
        exec->found = RG_FOUND_HERE;
    } else {
        struct exec_object *former = find_former(&exec->former, type, key);
        if (!former)
            return false;
        exec->found = RG_FOUND_FORMER;
        exec->objects.entries[exec->objects.count++] = *former;
        former->type = VK_OBJECT_TYPE_MAX_ENUM;
        exec->objects.entries[exec->objects.count - 1].unused = 0;
        found = &exec->objects.entries[exec->objects.count - 1];
    }
    memcpy(handle, &found->handle, size);
    return true;
}

void rg_exec_add_object(struct rg_exec *exec, VkObjectType type, uint64_t key, uint64_t handle,
                        const char *name)
{
    const VkDebugUtilsObjectNameInfoEXT info = {
        .sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT,
        .objectType = type,
        .objectHandle = handle,
        .pObjectName = name,
    };
    exec->objects.entries[exec->objects.count++] = (struct exec_object){ type, handle, key, 0 };
    if (name && exec->vk.SetDebugUtilsObjectNameEXT)
        exec->vk.SetDebugUtilsObjectNameEXT(exec->device, &info);
}

/* Allocates at least one element, because calloc() may return NULL for zero elements. */
void *rg_exec_make_array(struct rg_exec *exec, uint64_t key, size_t count, size_t size)
{
    void *array;
    if (rg_exec_reserve_object(exec) != VK_SUCCESS)
        return NULL;
    if (rg_exec_find(exec, VK_OBJECT_TYPE_UNKNOWN, key, &array, sizeof(array)))
        return array;
    array = calloc(count ? count : 1, size);
    if (array)
        rg_exec_add_object(exec, VK_OBJECT_TYPE_UNKNOWN, key, (uintptr_t)array, NULL);
    else
        rg_exec_check(exec, VK_ERROR_OUT_OF_HOST_MEMORY, "calloc", NULL);
    return array;
}

static void free_object(const struct rg_functions *vk, VkDevice device,
                        const struct exec_object *object)
{
#define DESTROY(kind, name) \
    if (object->type == VK_OBJECT_TYPE_##kind) \
        vk->Destroy##name(device, (Vk##name)object->handle, NULL);
    DESTROY(BUFFER, Buffer)
    DESTROY(BUFFER_VIEW, BufferView)
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
        vk->FreeMemory(device, (VkDeviceMemory)object->handle, NULL);
    if (object->type == VK_OBJECT_TYPE_UNKNOWN)
        free((void *)(uintptr_t)object->handle);
}

static void free_objects(const struct rg_functions *vk, VkDevice device, struct exec_objects *list)
{
    while (list->count)
        free_object(vk, device, &list->entries[--list->count]);
    free(list->entries);
    *list = (struct exec_objects){ 0 };
}

/* Returns true for pipelines and their layouts, which do not depend on the view's size. */
static bool is_worth_keeping(const struct exec_object *object)
{
    return object->unused <= UNUSED_MAX && (object->type == VK_OBJECT_TYPE_PIPELINE ||
                                            object->type == VK_OBJECT_TYPE_PIPELINE_LAYOUT ||
                                            object->type == VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT);
}

/* Moves the pipelines in a list to the executor's objects, and frees all other objects. */
static void keep_pipelines(struct rg_exec *exec, struct exec_objects *list)
{
    for (uint32_t i = 0; i < list->count; i++) {
        struct exec_object *object = &list->entries[i];
        if (!is_worth_keeping(object) || rg_exec_reserve_object(exec) != VK_SUCCESS)
            continue;
        exec->objects.entries[exec->objects.count++] = *object;
        object->type = VK_OBJECT_TYPE_MAX_ENUM;
    }
    free_objects(&exec->vk, exec->device, list);
}

void rg_exec_free_former(struct rg_exec *exec)
{
    for (uint32_t i = 0; i < exec->former.count; i++)
        exec->former.entries[i].unused++;
    keep_pipelines(exec, &exec->former);
}

/* ---- pipelines shared across executors ---- */

struct rg_pipelines {
    struct rg_functions vk;
    VkDevice device;
    struct exec_objects cached;
};

struct rg_pipelines *rg_pipelines_create(void)
{
    return calloc(1, sizeof(struct rg_pipelines));
}

void rg_pipelines_destroy(struct rg_pipelines *pipelines)
{
    if (pipelines)
        free_objects(&pipelines->vk, pipelines->device, &pipelines->cached);
    free(pipelines);
}

void rg_exec_adopt_pipelines(struct rg_exec *exec)
{
    struct rg_pipelines *pipelines = exec->params.pipelines;
    if (!pipelines)
        return;
    exec->former = pipelines->cached;
    pipelines->cached = (struct exec_objects){ 0 };
}

void rg_exec_free_objects(struct rg_exec *exec)
{
    struct rg_pipelines *pipelines = exec->params.pipelines;
    struct exec_objects own = exec->objects;
    if (pipelines) {
        exec->objects = pipelines->cached;
        keep_pipelines(exec, &own);
        keep_pipelines(exec, &exec->former);
        *pipelines = (struct rg_pipelines){ exec->vk, exec->device, exec->objects };
    }
    free_objects(&exec->vk, exec->device, &own);
    free_objects(&exec->vk, exec->device, &exec->former);
}
