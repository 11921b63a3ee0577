/* object_cache.c: error handling of Vulkan calls, and an executor's objects, cached by key. An
 * object with a key is reused: for an equal key in one plan, by the next plan, or (pipelines) by
 * another executor. Keys contain handles of other objects, which is safe: an object leaves the list
 * together with those whose keys contain its handle, because no later plan can find them. */
#include <stdlib.h>
#include <string.h>
#include "graph/exec/executor_internal.h"

enum {
    UNUSED_MAX = 1, /* plans that an unused pipeline survives */
    /* hash chains for each object that the list has room for: most chains are empty, so that a
     * search without result seldom reads an object, which long lists do not have in a cache */
    CHAINS_PER_OBJECT = 4,
};

struct exec_object {
    VkObjectType type; /* UNKNOWN: host memory; MAX_ENUM: moved */
    uint32_t key_size; /* 0: never reused */
    size_t key;        /* index in the list's `keys` of the content that identifies the object */
    uint64_t handle;
    uint64_t hash; /* of type and key */
    uint32_t next; /* next object of the same hash chain, plus 1; 0 if there is none */
    uint32_t plan; /* number of the last plan that used it */
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

VkResult rg_exec_refuse(const struct rg_exec *exec, const char *misuse)
{
    return rg_exec_check(exec, VK_ERROR_VALIDATION_FAILED_EXT, misuse, NULL);
}

static uint32_t *chain_of(const struct exec_objects *list, uint64_t hash)
{
    return &list->chains[hash & ((size_t)list->room * CHAINS_PER_OBJECT - 1)];
}

/* Adds an object to the front of its hash chain. */
static void link_object(struct exec_objects *list, uint32_t index)
{
    uint32_t *chain = chain_of(list, list->entries[index].hash);
    list->entries[index].next = *chain;
    *chain = index + 1;
}

static void link_objects(struct exec_objects *list)
{
    if (list->room)
        memset(list->chains, 0, (size_t)list->room * CHAINS_PER_OBJECT * sizeof(*list->chains));
    for (uint32_t i = 0; i < list->count; i++)
        link_object(list, i);
}

/* Makes room for `count` more objects. Only `exec->objects` has a hash table. */
static VkResult reserve(const struct rg_exec *exec, struct exec_objects *list, uint32_t count)
{
    uint32_t room = list->room ? list->room : 64;
    if (count <= list->room - list->count)
        return VK_SUCCESS;
    while (count > room - list->count)
        room *= 2;
    struct exec_object *entries = realloc(list->entries, room * sizeof(*entries));
    if (entries)
        list->entries = entries;
    const bool has_table = list == &exec->objects;
    const size_t table_size = (size_t)room * CHAINS_PER_OBJECT * sizeof(*list->chains);
    uint32_t *chains = entries && has_table ? realloc(list->chains, table_size) : NULL;
    if (!entries || (has_table && !chains))
        return rg_exec_check(exec, VK_ERROR_OUT_OF_HOST_MEMORY, "realloc", NULL);
    list->room = room;
    if (has_table) {
        list->chains = chains;
        link_objects(list);
    }
    return VK_SUCCESS;
}

VkResult rg_exec_reserve_object(struct rg_exec *exec)
{
    if (exec->is_key_lost)
        return rg_exec_check(exec, VK_ERROR_OUT_OF_HOST_MEMORY, "realloc", NULL);
    return reserve(exec, exec->key_size ? &exec->objects : &exec->unshared, 1);
}

/* Appends to the bytes after the keys of all objects. */
void rg_exec_key(struct rg_exec *exec, const void *data, size_t size)
{
    struct exec_objects *list = &exec->objects;
    const size_t end = list->key_bytes + exec->key_size;
    if (size > list->key_room - end) {
        const size_t room = list->key_room * 2 + size + 64;
        unsigned char *keys = realloc(list->keys, room);
        exec->is_key_lost = exec->is_key_lost || !keys;
        if (!keys)
            return;
        list->keys = keys;
        list->key_room = room;
    }
    memcpy(list->keys + end, data, size);
    exec->key_size += size;
}

/* Returns the hash of a type and the current key. */
static uint64_t hash_of(const struct rg_exec *exec, VkObjectType type)
{
    const unsigned char *key = exec->objects.keys + exec->objects.key_bytes;
    uint64_t hash = (uint64_t)type;
    for (size_t at = 0; at < exec->key_size; at += sizeof(uint64_t)) {
        const size_t rest = exec->key_size - at;
        uint64_t word = 0;
        memcpy(&word, key + at, rest < sizeof(word) ? rest : sizeof(word));
        hash = (hash ^ word) * UINT64_C(0x9e3779b97f4a7c15);
        hash ^= hash >> 29;
    }
    return hash;
}

/* Returns true for types of objects that several users can share, as they have no content. Images
 * of the plan have unique names; placeholders are shared. Sets of several passes share a pool. */
static bool can_be_shared(VkObjectType type)
{
    return type == VK_OBJECT_TYPE_SAMPLER || type == VK_OBJECT_TYPE_IMAGE_VIEW ||
           type == VK_OBJECT_TYPE_BUFFER_VIEW || type == VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT ||
           type == VK_OBJECT_TYPE_PIPELINE_LAYOUT || type == VK_OBJECT_TYPE_PIPELINE ||
           type == VK_OBJECT_TYPE_RENDER_PASS || type == VK_OBJECT_TYPE_FRAMEBUFFER ||
           type == VK_OBJECT_TYPE_IMAGE || type == VK_OBJECT_TYPE_DESCRIPTOR_POOL;
}

/* Returns true if an object has a type and the current key. */
static bool has_key(const struct rg_exec *exec, const struct exec_object *object, VkObjectType type,
                    uint64_t hash)
{
    const struct exec_objects *list = &exec->objects;
    return object->hash == hash && object->type == type && object->key_size == exec->key_size &&
           !memcmp(list->keys + object->key, list->keys + list->key_bytes, exec->key_size);
}

/* Returns the object with a type and the current key, or NULL. If several unshared objects match,
 * returns the oldest that this plan does not use. Similar plans look up their objects in the same
 * order, so the search starts at the successor of the last object found. For shared views it starts
 * after the last shared view, because passes often sample images in the order of the targets. */
static struct exec_object *find_object(const struct rg_exec *exec, VkObjectType type)
{
    const struct exec_objects *list = &exec->objects;
    const uint64_t hash = hash_of(exec, type);
    struct exec_object *found = NULL;
    const bool is_view = type == VK_OBJECT_TYPE_IMAGE_VIEW;
    for (uint32_t i = 0; i < (is_view ? 2 : 1); i++) {
        const uint32_t index = i ? exec->next_view : exec->next_object;
        struct exec_object *next = index < list->count ? &list->entries[index] : NULL;
        if (next && (i || next->plan != exec->plan_number) && has_key(exec, next, type, hash))
            return next;
    }
    for (uint32_t i = list->room ? *chain_of(list, hash) : 0; i; i = list->entries[i - 1].next) {
        struct exec_object *object = &list->entries[i - 1];
        if (has_key(exec, object, type, hash) &&
            (object->plan != exec->plan_number || can_be_shared(type)))
            found = object;
    }
    return found;
}

bool rg_exec_find(struct rg_exec *exec, VkObjectType type, void *handle, size_t size)
{
    struct exec_object *object = exec->key_size ? find_object(exec, type) : NULL;
    exec->found = !object                             ? RG_NOT_FOUND
                  : object->plan == exec->plan_number ? RG_FOUND_HERE
                                                      : RG_FOUND_FORMER;
    if (!object)
        return false;
    const uint32_t next = (uint32_t)(object - exec->objects.entries) + 1;
    if (exec->found == RG_FOUND_FORMER)
        exec->next_object = next;
    else if (type == VK_OBJECT_TYPE_IMAGE_VIEW)
        exec->next_view = next;
    object->plan = exec->plan_number;
    memcpy(handle, &object->handle, size);
    exec->key_size = 0;
    return true;
}

void rg_exec_add_object(struct rg_exec *exec, VkObjectType type, uint64_t handle, const char *name)
{
    const VkDebugUtilsObjectNameInfoEXT info = {
        .sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT,
        .objectType = type,
        .objectHandle = handle,
        .pObjectName = name,
    };
    struct exec_objects *list = exec->key_size ? &exec->objects : &exec->unshared;
    struct exec_object *object = &list->entries[list->count++];
    *object = (struct exec_object){
        .type = type,
        .handle = handle,
        .plan = exec->plan_number,
        .key = list->key_bytes,
        .key_size = (uint32_t)exec->key_size,
    };
    if (exec->key_size) {
        object->hash = hash_of(exec, type);
        link_object(list, list->count - 1);
        list->key_bytes += exec->key_size;
        exec->key_size = 0;
    }
    if (name && exec->vk.SetDebugUtilsObjectNameEXT)
        exec->vk.SetDebugUtilsObjectNameEXT(exec->device, &info);
}

/* Allocates at least one element, because calloc() may return NULL for zero elements. */
void *rg_exec_make_array(struct rg_exec *exec, size_t count, size_t size)
{
    void *array;
    if (rg_exec_reserve_object(exec) != VK_SUCCESS)
        return NULL;
    if (rg_exec_find(exec, VK_OBJECT_TYPE_UNKNOWN, &array, sizeof(array)))
        return array;
    array = calloc(count ? count : 1, size);
    if (array)
        rg_exec_add_object(exec, VK_OBJECT_TYPE_UNKNOWN, (uintptr_t)array, NULL);
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
    DESTROY(SEMAPHORE, Semaphore)
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
    free(list->chains);
    free(list->keys);
    *list = (struct exec_objects){ 0 };
}

/* Returns true if the object is kept for the next plan: if `plan` uses it, or if it is a pipeline
 * or layout, which do not depend on the view, and has been unused for few plans. */
static bool is_kept(const struct exec_object *object, uint32_t plan, bool only_pipelines)
{
    const bool is_pipeline = object->type == VK_OBJECT_TYPE_PIPELINE ||
                             object->type == VK_OBJECT_TYPE_PIPELINE_LAYOUT ||
                             object->type == VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT;
    const uint32_t unused = plan - object->plan;
    return is_pipeline ? unused <= UNUSED_MAX : !unused && !only_pipelines;
}

/* Moves the objects that are not kept to the end of another list. */
static VkResult remove_objects(struct rg_exec *exec, struct exec_objects *to, bool only_pipelines)
{
    struct exec_objects *list = &exec->objects;
    const uint32_t count = list->count;
    uint32_t removed = 0;
    VkResult result;
    for (uint32_t i = 0; i < count; i++)
        removed += !is_kept(&list->entries[i], exec->plan_number, only_pipelines);
    RG_TRY(reserve(exec, to, removed));
    if (!removed)
        return result;
    list->count = 0;
    list->key_bytes = 0;
    for (uint32_t i = 0; i < count; i++) {
        const struct exec_object object = list->entries[i];
        if (!is_kept(&object, exec->plan_number, only_pipelines)) {
            to->entries[to->count++] = object;
            continue;
        }
        memmove(list->keys + list->key_bytes, list->keys + object.key, object.key_size);
        list->entries[list->count] = object;
        list->entries[list->count++].key = list->key_bytes;
        list->key_bytes += object.key_size;
    }
    link_objects(list);
fail:
    return result;
}

/* ---- objects of previous plans that frames in flight use ---- */

struct exec_retired {
    struct exec_objects objects;
    uint64_t frame; /* number of the last frame that may use them */
    struct exec_retired *next;
};

VkResult rg_exec_retire_former(struct rg_exec *exec)
{
    struct exec_retired *retired = malloc(sizeof(*retired));
    if (!retired)
        return rg_exec_check(exec, VK_ERROR_OUT_OF_HOST_MEMORY, "malloc", NULL);
    *retired = (struct exec_retired){ exec->former, exec->frame, exec->retired };
    exec->former = (struct exec_objects){ 0 };
    exec->retired = retired;
    return remove_objects(exec, &retired->objects, false);
}

/* Returns true if the device may still execute a slot's commands, also if the poll fails. */
static bool may_run(const struct rg_exec *exec, const struct exec_slot *slot)
{
    if (!slot->submitted)
        return false;
    const VkResult result = exec->vk.WaitForFences(exec->device, 1, &slot->fence, VK_TRUE, 0);
    return result != VK_SUCCESS && result != VK_ERROR_DEVICE_LOST;
}

/* Returns true if the frame with this number, or an earlier one, may still be executed. */
static bool is_in_flight(const struct rg_exec *exec, uint64_t frame)
{
    for (uint32_t i = 0; i < exec->slot_count; i++) {
        const struct exec_slot *slot = &exec->slots[i];
        if (slot->frame > frame)
            continue;
        if (slot->recorded || may_run(exec, slot))
            return true;
    }
    return false;
}

static void free_retired(struct rg_exec *exec, bool all)
{
    struct exec_retired **link = &exec->retired;
    while (*link) {
        struct exec_retired *retired = *link;
        if (!all && is_in_flight(exec, retired->frame)) {
            link = &retired->next;
            continue;
        }
        *link = retired->next;
        free_objects(&exec->vk, exec->device, &retired->objects);
        free(retired);
    }
}

void rg_exec_free_retired(struct rg_exec *exec)
{
    free_retired(exec, false);
}

/* ---- pipelines shared across executors ---- */

struct rg_pipelines {
    struct rg_functions vk;
    VkDevice device;
    struct exec_objects cached;
    uint32_t plan_number; /* of the executor destroyed last */
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
    exec->objects = pipelines->cached;
    exec->plan_number = pipelines->plan_number + 1;
    pipelines->cached = (struct exec_objects){ 0 };
}

/* Appends the executor's pipelines to those that other executors have cached. */
static void cache_pipelines(struct rg_exec *exec, struct rg_pipelines *pipelines)
{
    struct exec_objects own = exec->objects;
    exec->objects = pipelines->cached;
    for (uint32_t i = 0; i < exec->objects.count; i++)
        exec->objects.entries[i].plan += exec->plan_number - pipelines->plan_number;
    for (uint32_t i = 0; i < own.count; i++) {
        struct exec_object *object = &own.entries[i];
        rg_exec_key(exec, own.keys + object->key, object->key_size);
        if (rg_exec_reserve_object(exec) != VK_SUCCESS)
            break;
        rg_exec_add_object(exec, object->type, object->handle, NULL);
        exec->objects.entries[exec->objects.count - 1].plan = object->plan;
        object->type = VK_OBJECT_TYPE_MAX_ENUM; /* marks the object as moved */
    }
    *pipelines = (struct rg_pipelines){ exec->vk, exec->device, exec->objects, exec->plan_number };
    exec->objects = own;
}

void rg_exec_free_objects(struct rg_exec *exec)
{
    struct rg_pipelines *pipelines = exec->params.pipelines;
    exec->key_size = 0;
    exec->params.log = NULL; /* pipelines that cannot be cached are compiled again */
    free_retired(exec, true);
    if (pipelines && remove_objects(exec, &exec->unshared, true) == VK_SUCCESS)
        cache_pipelines(exec, pipelines);
    free_objects(&exec->vk, exec->device, &exec->objects);
    free_objects(&exec->vk, exec->device, &exec->unshared);
    free_objects(&exec->vk, exec->device, &exec->former);
}
