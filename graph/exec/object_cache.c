/* object_cache.c: error handling of Vulkan calls, and an executor's objects, cached by key. An
 * object with a key is reused: for an equal key in one plan, by the next plan, or (pipelines) by
 * another executor. Keys contain handles of other objects, which is safe, since these are in the
 * same list, and lists move as a whole. */
#include <stdlib.h>
#include <string.h>
#include "graph/exec/executor_internal.h"

enum {
    UNUSED_MAX = 1, /* plans that an unused pipeline survives */
    SHORT_KEY = 40, /* bytes of a key that is stored in place */
};

struct exec_object {
    VkObjectType type; /* UNKNOWN: host memory; MAX_ENUM: moved */
    uint64_t handle;
    uint32_t key_size; /* 0: never reused */

    /* content that identifies it; allocated if it is longer than SHORT_KEY */
    union {
        unsigned char *key;
        unsigned char short_key[SHORT_KEY];
    };

    uint64_t hash;   /* of type and key */
    uint32_t next;   /* next object of the same hash chain, plus 1; 0 if there is none */
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

static const unsigned char *key_of(const struct exec_object *object)
{
    return object->key_size > SHORT_KEY ? object->key : object->short_key;
}

/* Moves the key into an object whose key_size is set. */
static void store_key(struct exec_object *object, struct exec_key *key)
{
    if (object->key_size <= SHORT_KEY) {
        memcpy(object->short_key, key->bytes, key->size);
        key->size = 0;
        return;
    }
    unsigned char *shrunk = realloc(key->bytes, key->size);
    object->key = shrunk ? shrunk : key->bytes;
    *key = (struct exec_key){ 0 };
}

static uint32_t *chain_of(const struct exec_objects *list, uint64_t hash)
{
    return &list->chains[hash & (list->room - 1)];
}

/* Adds an object to the front of its hash chain. */
static void link_object(struct exec_objects *list, uint32_t index)
{
    uint32_t *chain = chain_of(list, list->entries[index].hash);
    if (!list->entries[index].key_size)
        return;
    list->entries[index].next = *chain;
    *chain = index + 1;
}

/* Links all objects of a list, so that of equal keys the oldest object is found first. */
static void link_objects(struct exec_objects *list)
{
    if (list->room)
        memset(list->chains, 0, list->room * sizeof(*list->chains));
    for (uint32_t i = list->count; i-- > 0;)
        link_object(list, i);
}

/* Makes room for one more object, whose key must have been stored completely. */
VkResult rg_exec_reserve_object(struct rg_exec *exec)
{
    struct exec_objects *list = &exec->objects;
    if (list->count < list->room && !exec->key.is_lost)
        return VK_SUCCESS;
    const uint32_t room = list->room ? list->room * 2 : 64;
    struct exec_object *entries =
        exec->key.is_lost ? NULL : realloc(list->entries, room * sizeof(*entries));
    if (entries)
        list->entries = entries;
    uint32_t *chains = entries ? realloc(list->chains, room * sizeof(*chains)) : NULL;
    if (!chains)
        return rg_exec_check(exec, VK_ERROR_OUT_OF_HOST_MEMORY, "realloc", NULL);
    list->chains = chains;
    list->room = room;
    link_objects(list);
    return VK_SUCCESS;
}

void rg_exec_key(struct rg_exec *exec, const void *data, size_t size)
{
    struct exec_key *key = &exec->key;
    if (size > key->room - key->size) {
        const size_t room = key->room * 2 + size + 64;
        unsigned char *bytes = realloc(key->bytes, room);
        key->is_lost = key->is_lost || !bytes;
        if (!bytes)
            return;
        key->bytes = bytes;
        key->room = room;
    }
    memcpy(key->bytes + key->size, data, size);
    key->size += size;
}

static uint64_t hash_of(VkObjectType type, const struct exec_key *key)
{
    uint64_t hash = (uint64_t)type;
    for (size_t at = 0; at < key->size; at += sizeof(uint64_t)) {
        const size_t rest = key->size - at;
        uint64_t word = 0;
        memcpy(&word, key->bytes + at, rest < sizeof(word) ? rest : sizeof(word));
        hash = (hash ^ word) * UINT64_C(0x9e3779b97f4a7c15);
        hash ^= hash >> 29;
    }
    return hash;
}

/* Returns true for types of objects that several users can share, as they have no content. Images
 * of the plan have unique names; placeholders are shared. */
static bool can_be_shared(VkObjectType type)
{
    return type == VK_OBJECT_TYPE_SAMPLER || type == VK_OBJECT_TYPE_IMAGE_VIEW ||
           type == VK_OBJECT_TYPE_BUFFER_VIEW || type == VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT ||
           type == VK_OBJECT_TYPE_PIPELINE_LAYOUT || type == VK_OBJECT_TYPE_PIPELINE ||
           type == VK_OBJECT_TYPE_RENDER_PASS || type == VK_OBJECT_TYPE_FRAMEBUFFER ||
           type == VK_OBJECT_TYPE_IMAGE;
}

/* Moves an object to another list, which has room for it. */
static void move_object(struct exec_objects *to, struct exec_object *object)
{
    to->entries[to->count++] = *object;
    link_object(to, to->count - 1);
    object->type = VK_OBJECT_TYPE_MAX_ENUM;
    object->key_size = 0;
}

/* Returns the link to an object with a type and key, or NULL if the list has none. */
static uint32_t *find_link(const struct exec_objects *list, VkObjectType type,
                           const struct exec_key *key, uint64_t hash)
{
    uint32_t *link = list->room ? chain_of(list, hash) : NULL;
    while (link && *link) {
        struct exec_object *object = &list->entries[*link - 1];
        if (object->hash == hash && object->type == type && object->key_size == key->size &&
            !memcmp(key_of(object), key->bytes, key->size))
            return link;
        link = &object->next;
    }
    return NULL;
}

bool rg_exec_find(struct rg_exec *exec, VkObjectType type, void *handle, size_t size)
{
    struct exec_objects *own = &exec->objects;
    const uint64_t hash = hash_of(type, &exec->key);
    exec->found = RG_NOT_FOUND;
    if (!exec->key.size)
        return false;
    const uint32_t *link = can_be_shared(type) ? find_link(own, type, &exec->key, hash) : NULL;
    uint32_t *former = link ? NULL : find_link(&exec->former, type, &exec->key, hash);
    if (link)
        exec->found = RG_FOUND_HERE;
    if (former) {
        struct exec_object *object = &exec->former.entries[*former - 1];
        exec->found = RG_FOUND_FORMER;
        *former = object->next;
        move_object(own, object);
        own->entries[own->count - 1].unused = 0;
    }
    if (exec->found) {
        const uint32_t index = link ? *link - 1 : own->count - 1;
        memcpy(handle, &own->entries[index].handle, size);
        exec->key.size = 0;
    }
    return exec->found;
}

void rg_exec_add_object(struct rg_exec *exec, VkObjectType type, uint64_t handle, const char *name)
{
    struct exec_key *key = &exec->key;
    const VkDebugUtilsObjectNameInfoEXT info = {
        .sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT,
        .objectType = type,
        .objectHandle = handle,
        .pObjectName = name,
    };
    struct exec_object *object = &exec->objects.entries[exec->objects.count++];
    *object = (struct exec_object){ .type = type, .handle = handle };
    if (key->size) {
        object->key_size = (uint32_t)key->size;
        object->hash = hash_of(type, key);
        link_object(&exec->objects, exec->objects.count - 1);
        store_key(object, key);
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
    if (object->key_size > SHORT_KEY)
        free(object->key);
    if (object->type == VK_OBJECT_TYPE_UNKNOWN)
        free((void *)(uintptr_t)object->handle);
}

static void free_objects(const struct rg_functions *vk, VkDevice device, struct exec_objects *list)
{
    while (list->count)
        free_object(vk, device, &list->entries[--list->count]);
    free(list->entries);
    free(list->chains);
    *list = (struct exec_objects){ 0 };
}

/* Returns true for pipelines and their layouts, which do not depend on the view's size. */
static bool is_worth_keeping(const struct exec_object *object)
{
    return object->unused <= UNUSED_MAX && (object->type == VK_OBJECT_TYPE_PIPELINE ||
                                            object->type == VK_OBJECT_TYPE_PIPELINE_LAYOUT ||
                                            object->type == VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT);
}

/* Moves the pipelines in a list to the executor's objects. */
static void keep_pipelines(struct rg_exec *exec, struct exec_objects *list)
{
    for (uint32_t i = 0; i < list->count; i++) {
        struct exec_object *object = &list->entries[i];
        if (is_worth_keeping(object) && rg_exec_reserve_object(exec) == VK_SUCCESS)
            move_object(&exec->objects, object);
    }
}

/* Keeps pipelines of the previous plan that have been unused for few plans. */
static void keep_former_pipelines(struct rg_exec *exec)
{
    for (uint32_t i = 0; i < exec->former.count; i++)
        exec->former.entries[i].unused++;
    keep_pipelines(exec, &exec->former);
}

void rg_exec_free_former(struct rg_exec *exec)
{
    keep_former_pipelines(exec);
    free_objects(&exec->vk, exec->device, &exec->former);
}

/* ---- objects of previous plans that frames in flight use ---- */

struct exec_retired {
    struct exec_objects objects;
    uint64_t frame; /* number of the last frame that may use them */
    struct exec_retired *next;
};

void rg_exec_link_former(struct rg_exec *exec)
{
    link_objects(&exec->former);
}

VkResult rg_exec_retire_former(struct rg_exec *exec)
{
    struct exec_retired *retired = malloc(sizeof(*retired));
    if (!retired)
        return rg_exec_check(exec, VK_ERROR_OUT_OF_HOST_MEMORY, "malloc", NULL);
    keep_former_pipelines(exec);
    *retired = (struct exec_retired){ exec->former, exec->frame, exec->retired };
    exec->former = (struct exec_objects){ 0 };
    exec->retired = retired;
    return VK_SUCCESS;
}

/* Returns true if the frame with this number, or an earlier one, has not finished. */
static bool is_in_flight(const struct rg_exec *exec, uint64_t frame)
{
    for (uint32_t i = 0; i < exec->slot_count; i++) {
        const struct exec_slot *slot = &exec->slots[i];
        if (slot->frame > frame)
            continue;
        if (slot->recorded ||
            (slot->submitted &&
             exec->vk.WaitForFences(exec->device, 1, &slot->fence, VK_TRUE, 0) == VK_TIMEOUT))
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
    rg_exec_link_former(exec);
}

void rg_exec_free_objects(struct rg_exec *exec)
{
    struct rg_pipelines *pipelines = exec->params.pipelines;
    struct exec_objects own = exec->objects;
    free(exec->key.bytes);
    exec->key = (struct exec_key){ 0 };
    free_retired(exec, true);
    if (pipelines) {
        exec->objects = pipelines->cached;
        keep_pipelines(exec, &own);
        keep_pipelines(exec, &exec->former);
        *pipelines = (struct rg_pipelines){ exec->vk, exec->device, exec->objects };
    }
    free_objects(&exec->vk, exec->device, &own);
    free_objects(&exec->vk, exec->device, &exec->former);
}
