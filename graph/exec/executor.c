/* executor.c: creates, updates and destroys an executor; begins, submits and waits for frames. */
#include <stdlib.h>
#include "graph/exec/executor_internal.h"

/* Creates fences and command buffers, or keeps them when the plan changes. */
static VkResult make_slots(struct rg_exec *exec)
{
    VkResult result;
    RG_KEY(exec, exec->slot_count);
    RG_MAKE(exec, NULL, COMMAND_POOL, CreateCommandPool, &exec->command_pool,
            &(VkCommandPoolCreateInfo){
                .sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                .flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT,
                .queueFamilyIndex = exec->params.queue_family,
            });
    for (uint32_t i = 0; i < exec->slot_count; i++) {
        struct exec_slot *slot = &exec->slots[i];
        slot->passes = NULL; /* they belonged to the previous plan */
        slot->times = (struct rg_times){ 0 };
        RG_KEY(exec, i);
        RG_MAKE(exec, NULL, FENCE, CreateFence, &slot->fence,
                &(VkFenceCreateInfo){ .sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO });
        if (exec->found)
            continue;
        RG_CALL(exec, NULL, AllocateCommandBuffers, exec->device,
                &(VkCommandBufferAllocateInfo){
                    .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                    .commandPool = exec->command_pool,
                    .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                    .commandBufferCount = 1,
                },
                &slot->commands);
    }
fail:
    return result;
}

static VkResult count_image_sets(struct rg_exec *exec)
{
    exec->image_set_count = 1;
    for (size_t i = 0; i < exec->params.import_count; i++) {
        uint32_t count = exec->params.imports[i].image_count;
        if (count && exec->image_set_count > 1 && count != exec->image_set_count)
            return rg_exec_check(exec, VK_ERROR_INITIALIZATION_FAILED, "rg_exec_import.image_count",
                                 "imports, which differs between them");
        if (count)
            exec->image_set_count = count;
    }
    exec->parities = 1;
    for (uint32_t i = 0; i < exec->plan->image_count; i++)
        exec->parities = exec->plan->images[i].partner != RG_NONE ? 2 : exec->parities;
    exec->image_set_count *= exec->parities;
    return VK_SUCCESS;
}

/* Returns the capacity for pending barriers: RG_MERGED_MAX or, if greater, the largest batch. */
static uint32_t batch_room(const struct rg_plan *plan)
{
    uint32_t room = RG_MERGED_MAX;
    for (uint32_t p = 0; p < plan->pass_count; p++) {
        if (plan->passes[p].barrier_count > room)
            room = plan->passes[p].barrier_count;
    }
    if (plan->final_barrier_count > room)
        room = plan->final_barrier_count;
    return plan->initial_barrier_count > room ? plan->initial_barrier_count : room;
}

static VkResult make_arrays(struct rg_exec *exec)
{
    const struct rg_plan *plan = exec->plan;
    size_t slot_count = exec->slot_count;
    size_t resource_count = (size_t)plan->image_count + plan->buffer_count;
    exec->batch.room = batch_room(plan);
    bool done = RG_MAKE_ARRAY(exec, exec->blocks, plan->block_count) &&
                RG_MAKE_ARRAY(exec, exec->buffers, plan->buffer_count * slot_count) &&
                RG_MAKE_ARRAY(exec, exec->fallbacks, plan->fallback_count) &&
                RG_MAKE_ARRAY(exec, exec->origins, resource_count) &&
                RG_MAKE_ARRAY(exec, exec->passes, plan->pass_count) &&
                RG_MAKE_ARRAY(exec, exec->batch.images, exec->batch.room) &&
                RG_MAKE_ARRAY(exec, exec->batch.buffers, exec->batch.room) &&
                RG_MAKE_ARRAY(exec, exec->image_sets, exec->image_set_count);
    for (uint32_t i = 0; done && i < exec->image_set_count; i++) {
        struct exec_image_set *set = &exec->image_sets[i];
        done = RG_MAKE_ARRAY(exec, set->images, plan->image_count) &&
               RG_MAKE_ARRAY(exec, set->targets, plan->pass_count) &&
               RG_MAKE_ARRAY(exec, set->descriptors, plan->pass_count);
    }
    if (!done)
        return VK_ERROR_OUT_OF_HOST_MEMORY;
    exec->image_set = &exec->image_sets[exec->parity % exec->parities];
    return VK_SUCCESS;
}

static VkResult make_all(struct rg_exec *exec)
{
    VkResult (*const steps[])(struct rg_exec *) = {
        rg_exec_check_features, rg_exec_check_imports,
        count_image_sets,       make_arrays,
        rg_exec_make_memory,    rg_exec_make_fallbacks,
        rg_exec_make_targets,   rg_exec_make_descriptors,
        rg_exec_make_pipelines, make_slots,
        rg_exec_make_queues,    rg_exec_make_time,
        rg_exec_make_coverage,
    };
    VkResult result = VK_SUCCESS;
    exec->vk.GetPhysicalDeviceMemoryProperties(exec->params.physical, &exec->memory_properties);
    for (size_t i = 0; i < sizeof(steps) / sizeof(steps[0]) && result == VK_SUCCESS; i++)
        result = steps[i](exec);
    return result;
}

static bool is_destroyed(const struct rg_plan *plan)
{
    return __atomic_load_n(&plan->users, __ATOMIC_ACQUIRE) & RG_PLAN_DESTROYED;
}

bool rg_exec_refuse_plan(const struct rg_exec *exec)
{
    if (is_destroyed(exec->plan))
        (void)rg_exec_refuse(exec, "a frame of a plan after its rg_plan_destroy()");
    return is_destroyed(exec->plan);
}

/* Returns a message if the parameters are invalid, otherwise NULL. */
static const char *params_problem(const struct rg_exec_params *p)
{
    const VkSpecializationInfo *k = p->constants;
    if (!p->plan || p->plan->fault_count || !p->get_proc_addr)
        return "params without a plan free of faults, or without get_proc_addr";
    if (is_destroyed(p->plan))
        return "params with a destroyed plan";
    if (p->set_count && !p->sets)
        return "params with a set_count but no sets";
    if (p->sampler_count && !p->samplers)
        return "params with a sampler_count but no samplers";
    if (p->import_count && !p->imports)
        return "params with an import_count but no imports";
    for (size_t i = 0; i < p->import_count; i++) {
        if (p->imports[i].image_count && !p->imports[i].images)
            return "params with an import that has an image_count but no images";
    }
    if (k && ((k->mapEntryCount && !k->pMapEntries) || (k->dataSize && !k->pData)))
        return "params with constants whose entries or data are NULL";
    for (uint32_t i = 0; k && i < k->mapEntryCount; i++) {
        const VkSpecializationMapEntry *entry = &k->pMapEntries[i];
        if (entry->size > k->dataSize || entry->offset > k->dataSize - entry->size)
            return "params with a constant that exceeds its data";
    }
    if (!p->instance || !p->physical || !p->device)
        return "params without an instance, a physical device or a device";
    return NULL;
}

/* Fills *functions. Returns NULL, or the name of a function that the instance lacks. */
static const char *find_functions(struct rg_functions *functions, PFN_vkGetInstanceProcAddr find,
                                  VkInstance instance)
{
    const char *missing = NULL;
#define FIND(function) functions->function = (PFN_vk##function)find(instance, "vk" #function);
#define FIND_OR_MISS(function) \
    FIND(function) \
    if (!functions->function) \
        missing = "vk" #function;
    RG_FUNCTIONS(FIND_OR_MISS)
    RG_FUNCTIONS_OPTIONAL(FIND)
    return missing;
}

/* Keeps the plan from being freed by rg_plan_destroy(). */
static void keep_plan(const struct rg_plan *plan)
{
    __atomic_fetch_add((uint32_t *)(uintptr_t)&plan->users, 1, __ATOMIC_RELAXED);
}

/* Frees the plan if it was destroyed, and no other executor has it. */
static void release_plan(const struct rg_plan *plan)
{
    struct rg_plan *p = (struct rg_plan *)(uintptr_t)plan;
    if (__atomic_sub_fetch(&p->users, 1, __ATOMIC_ACQ_REL) != RG_PLAN_DESTROYED)
        return;
    p->users = 0;
    rg_plan_destroy(p);
}

static const struct rg_exec_params no_params = { 0 };

struct rg_exec *rg_exec_create(const struct rg_exec_params *params, VkResult *result)
{
    return rg_exec_create_extended(params, &(struct rg_exec_extensions){ 0 }, result);
}

struct rg_exec *rg_exec_create_extended(const struct rg_exec_params *params,
                                        const struct rg_exec_extensions *extensions,
                                        VkResult *result)
{
    params = params ? params : &no_params;
    struct rg_exec start = {
        .params = *params,
        .extensions = *extensions,
        .plan = params->plan,
        .device = params->device,
        .slot_count = params->frames_in_flight ? params->frames_in_flight : 2,
    };
    start.slot = start.slot_count - 1;
    const char *wrong = params_problem(&start.params);
    const char *missing =
        wrong ? NULL : find_functions(&start.vk, params->get_proc_addr, params->instance);
    VkResult outcome = wrong     ? VK_ERROR_INITIALIZATION_FAILED
                       : missing ? VK_ERROR_INCOMPATIBLE_DRIVER
                                 : VK_SUCCESS;
    rg_exec_check(&start, outcome, wrong ? "rg_exec_create" : "vkGetInstanceProcAddr",
                  wrong ? wrong : missing);
    struct rg_exec *exec = outcome == VK_SUCCESS ? calloc(1, sizeof(*exec)) : NULL;
    if (exec) {
        *exec = start;
        keep_plan(exec->plan);
        rg_exec_adopt_pipelines(exec);
        exec->slots = calloc(exec->slot_count, sizeof(*exec->slots));
        outcome = exec->slots ? make_all(exec)
                              : rg_exec_check(exec, VK_ERROR_OUT_OF_HOST_MEMORY, "calloc", NULL);
        if (outcome == VK_SUCCESS)
            outcome = rg_exec_retire_former(exec);
        rg_exec_free_retired(exec);
    } else if (outcome == VK_SUCCESS) {
        outcome = rg_exec_check(&start, VK_ERROR_OUT_OF_HOST_MEMORY, "calloc", NULL);
    }
    if (result)
        *result = outcome;
    if (outcome == VK_SUCCESS)
        return exec;
    rg_exec_destroy(exec);
    return NULL;
}

VkResult rg_exec_update(struct rg_exec *exec, const struct rg_exec_params *params)
{
    VkResult result = VK_SUCCESS;
    params = params ? params : &no_params;
    if (exec->next_part.count)
        return rg_exec_refuse(exec, "rg_exec_update() before the last part");
    const struct rg_exec former = *exec;
    struct rg_exec next = {
        .params = former.params,
        .extensions = former.extensions,
        .vk = former.vk,
        .plan = params->plan,
        .device = former.device,
        .slot_count = former.slot_count,
        .slot = former.slot,
        .slots = former.slots,
        .frame = former.frame,
        .parity = former.parity,
        .timeline = former.timeline,
        .objects = former.objects,
        .former = former.unshared,
        .plan_number = former.plan_number + 1,
        .pool_number = former.pool_number,
        .retired = former.retired,
        .is_update = true,
    };
    next.params.plan = params->plan;
    next.params.imports = params->imports;
    next.params.import_count = params->import_count;
    next.params.max_anisotropy = params->max_anisotropy;
    next.params.constants = params->constants;
    next.params.replace_shader = params->replace_shader;
    next.params.user = params->user;
    const char *wrong = params_problem(&next.params);
    if (wrong)
        return rg_exec_check(exec, VK_ERROR_INITIALIZATION_FAILED, "rg_exec_update", wrong);
    *exec = next;
    keep_plan(exec->plan);
    RG_TRY(make_all(exec));
    RG_TRY(rg_exec_keep_content(exec, &former));
    rg_time_keep(exec, &former);
    RG_TRY(rg_exec_retire_former(exec));
    rg_exec_free_retired(exec);
fail:
    release_plan(former.plan);
    return result;
}

static VkResult wait_fence(const struct rg_exec *exec, const struct exec_slot *slot)
{
    return exec->vk.WaitForFences(exec->device, 1, &slot->fence, VK_TRUE, UINT64_MAX);
}

void rg_exec_destroy(struct rg_exec *exec)
{
    if (!exec)
        return;
    for (uint32_t i = 0; exec->slots && i < exec->slot_count; i++) {
        if (exec->slots[i].submitted) /* also if the device is lost */
            (void)wait_fence(exec, &exec->slots[i]);
    }
    rg_exec_wait_for_queues(exec);
    rg_exec_free_objects(exec);
    release_plan(exec->plan);
    free(exec->slots);
    free(exec);
}

VkResult rg_exec_begin(struct rg_exec *exec, uint32_t *slot)
{
    const uint64_t start = rg_time_now();
    if (exec->next_part.count)
        return rg_exec_refuse(exec, "rg_exec_begin() before the last part");
    if (!exec->params.queue)
        return rg_exec_refuse(exec, "rg_exec_begin() without rg_exec_params.queue");
    if (!slot)
        return rg_exec_refuse(exec, "rg_exec_begin() with a slot that is NULL");
    exec->begun = true;
    exec->slot = (exec->slot + 1) % exec->slot_count;
    *slot = exec->slot;
    VkResult result = rg_exec_wait(exec, exec->slot);
    rg_time_begin(exec, start);
    return result;
}

/* Returns the name of the pass if there is only one, otherwise NULL. */
static const char *pass_name(const struct rg_exec *exec, const struct exec_part *part)
{
    return part->count == 1 ? exec->plan->passes[part->first].pass->name : NULL;
}

VkResult rg_exec_wait_fence(const struct rg_exec *exec)
{
    return rg_exec_check(exec, wait_fence(exec, &exec->slots[exec->slot]), "vkWaitForFences", NULL);
}

VkResult rg_exec_submit_recorded(struct rg_exec *exec, const struct rg_frame *frame,
                                 const struct exec_part *part)
{
    const struct rg_exec_external_sync *sync = &exec->external_sync;
    VkResult result;
    struct exec_slot *slot = &exec->slots[exec->slot];
    const VkCommandBufferSubmitInfo commands = {
        .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO,
        .commandBuffer = slot->commands,
    };
    const bool is_first = part->begins && part->first == 0;
    const bool is_last = part->ends && part->first + part->count == exec->plan->pass_count;
    const char *of = pass_name(exec, part);
    const VkSubmitInfo2 info = {
        .sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2,
        .waitSemaphoreInfoCount = is_first ? sync->wait_count : 0,
        .pWaitSemaphoreInfos = sync->waits,
        .commandBufferInfoCount = 1,
        .pCommandBufferInfos = &commands,
        .signalSemaphoreInfoCount = is_last ? sync->signal_count : 0,
        .pSignalSemaphoreInfos = sync->signals,
    };
    const uint64_t start = rg_time_now();
    RG_TRY(rg_exec_record_own(exec, slot->commands, frame, part));
    RG_CALL(exec, of, ResetFences, exec->device, 1, &slot->fence);
    const uint64_t recorded = rg_time_now();
    RG_CALL(exec, of, QueueSubmit2, exec->params.queue, 1, &info, slot->fence);
    slot->submitted = true;
    slot->frame = ++exec->frame;
    slot->times.record += recorded - start;
    slot->times.submit += rg_time_now() - recorded;
fail:
    return result;
}

/* Submits each pass separately and waits for it, to time passes with the host's clock. */
static VkResult submit_alone(struct rg_exec *exec, const struct rg_frame *frame)
{
    VkResult result = VK_SUCCESS;
    struct exec_slot *slot = &exec->slots[exec->slot];
    uint64_t begin = 0;
    for (uint32_t p = 0; p < exec->plan->pass_count; p++) {
        const struct exec_part part = { .first = p, .count = 1, .begins = true, .ends = true };
        RG_TRY(rg_exec_submit_recorded(exec, frame, &part));
        const uint64_t submitted = rg_time_now();
        RG_TRY(
            rg_exec_check(exec, wait_fence(exec, slot), "vkWaitForFences", pass_name(exec, &part)));
        slot->passes[p].begin = begin;
        begin += slot->times.submit + rg_time_now() - submitted;
        slot->passes[p].end = begin;
        slot->times.submit = 0; /* already counted in the pass */
    }
fail:
    return result;
}

bool rg_exec_select_images(struct rg_exec *exec, uint32_t image_index)
{
    if (image_index >= exec->image_set_count / exec->parities)
        return false;
    exec->image_set =
        &exec->image_sets[image_index * exec->parities + exec->parity % exec->parities];
    return true;
}

void rg_exec_end_frame(struct rg_exec *exec)
{
    exec->initialized = true;
    exec->parity ^= 1;
}

VkResult rg_exec_submit(struct rg_exec *exec, const struct rg_frame *frame)
{
    return rg_exec_submit_synced(exec, frame, &(struct rg_exec_external_sync){ 0 });
}

VkResult rg_exec_submit_synced(struct rg_exec *exec, const struct rg_frame *frame,
                               const struct rg_exec_external_sync *sync)
{
    const struct exec_part whole = { .count = exec->plan->pass_count,
                                     .begins = true,
                                     .ends = true };
    VkResult result;
    if (!exec->begun || exec->next_part.count)
        return rg_exec_refuse(exec, "rg_exec_submit() without rg_exec_begin()");
    if (!sync || (sync->wait_count && !sync->waits) || (sync->signal_count && !sync->signals))
        return rg_exec_refuse(exec, "rg_exec_submit_synced() with a sync or an array that is NULL");
    exec->begun = false;
    if (rg_exec_refuse_plan(exec))
        return VK_ERROR_VALIDATION_FAILED_EXT;
    if (!rg_exec_select_images(exec, sync->image_index))
        return rg_exec_refuse(exec, "rg_exec_external_sync.image_index beyond the images");
    exec->external_sync = *sync;
    RG_TRY(rg_exec_sync_host(exec, exec->slot, RG_MEMORY_UPLOAD));
    if (exec->plan->submission_count)
        RG_TRY(rg_exec_submit_queues(exec, frame));
    else if (exec->slots[exec->slot].times.measure.clock == RG_CLOCK_SUBMITS)
        RG_TRY(submit_alone(exec, frame));
    else
        RG_TRY(rg_exec_submit_recorded(exec, frame, &whole));
    rg_exec_end_frame(exec);
fail:
    return result;
}

VkResult rg_exec_record(struct rg_exec *exec, const struct rg_exec_recording *recording,
                        const struct rg_frame *frame)
{
    const struct exec_part whole = { .count = exec->plan->pass_count,
                                     .begins = true,
                                     .ends = true };
    const uint64_t start = rg_time_now();
    VkResult result;
    if (exec->next_part.count)
        return rg_exec_refuse(exec, "rg_exec_record() before the last part");
    if (exec->plan->submission_count)
        return rg_exec_refuse(exec, "rg_exec_record() of a plan for several queues");
    if (rg_exec_refuse_plan(exec))
        return VK_ERROR_VALIDATION_FAILED_EXT;
    if (!recording->commands)
        return rg_exec_refuse(exec, "rg_exec_record() without a command buffer");
    if (recording->slot >= exec->slot_count ||
        recording->image_index >= exec->image_set_count / exec->parities)
        return rg_exec_refuse(exec, "rg_exec_record() with a slot or image_index out of range");
    struct exec_slot *slot = &exec->slots[recording->slot];
    RG_TRY(rg_exec_wait(exec, recording->slot));
    exec->slot = recording->slot;
    rg_exec_select_images(exec, recording->image_index);
    RG_TRY(rg_exec_sync_host(exec, exec->slot, RG_MEMORY_UPLOAD));
    rg_time_begin(exec, start);
    if (slot->times.measure.clock == RG_CLOCK_SUBMITS)
        slot->times.measure.clock = RG_CLOCK_NONE;
    RG_TRY(rg_exec_record_part(exec, recording->commands, frame, &whole));
    slot->times.record = rg_time_now() - start - slot->times.begin;
    slot->recorded = true;
    slot->frame = ++exec->frame;
    rg_exec_end_frame(exec);
fail:
    return result;
}

VkResult rg_exec_wait(struct rg_exec *exec, uint32_t slot)
{
    VkResult result;
    const uint64_t start = rg_time_now();
    if (slot >= exec->slot_count)
        return rg_exec_refuse(exec, "rg_exec_wait() for a slot beyond frames_in_flight");
    if (exec->slots[slot].submitted)
        RG_TRY(rg_exec_check(exec, wait_fence(exec, &exec->slots[slot]), "vkWaitForFences", NULL));
    else if (!exec->slots[slot].recorded)
        return VK_SUCCESS;
    exec->slots[slot].submitted = exec->slots[slot].recorded = false;
    rg_exec_free_retired(exec);
    RG_TRY(rg_exec_sync_host(exec, slot, RG_MEMORY_READBACK));
    RG_TRY(rg_time_finish(exec, slot, start));
fail:
    return result;
}

VkResult rg_exec_wait_all(struct rg_exec *exec)
{
    VkResult result = VK_SUCCESS;
    for (uint32_t slot = 0; slot < exec->slot_count && result == VK_SUCCESS; slot++)
        result = rg_exec_wait(exec, slot);
    return result;
}

void *rg_exec_mapped(struct rg_exec *exec, const struct rg_buffer *buffer, uint32_t slot)
{
    for (uint32_t i = 0; i < exec->plan->buffer_count && slot < exec->slot_count; i++) {
        if (exec->plan->buffers[i].buffer == buffer)
            return rg_exec_buffer(exec, i, slot)->mapped;
    }
    return NULL;
}
