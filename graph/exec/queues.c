/* queues.c: submits the passes of a frame to several queues, ordered by timeline semaphores. */
#include "graph/exec/executor_internal.h"

/* Creates a timeline semaphore, which later plans share, and a command pool for a queue. */
static VkResult make_queue(struct rg_exec *exec, enum rg_queue queue, VkCommandPool *pool)
{
    const VkSemaphoreTypeCreateInfo timeline = {
        .sType = VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO,
        .semaphoreType = VK_SEMAPHORE_TYPE_TIMELINE,
    };
    VkResult result;
    RG_KEY(exec, queue);
    RG_MAKE(exec, NULL, SEMAPHORE, CreateSemaphore, &exec->timelines[queue],
            &(VkSemaphoreCreateInfo){ .sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO,
                                      .pNext = &timeline });
    RG_MAKE(exec, NULL, COMMAND_POOL, CreateCommandPool, pool,
            &(VkCommandPoolCreateInfo){
                .sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                .flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT,
                .queueFamilyIndex = rg_exec_queue_of(exec, queue).family,
            });
fail:
    return result;
}

VkResult rg_exec_make_queues(struct rg_exec *exec)
{
    const struct rg_plan *plan = exec->plan;
    VkCommandPool pools[RG_QUEUE_COUNT] = { VK_NULL_HANDLE };
    VkResult result = VK_SUCCESS;
    for (uint32_t s = 0; s < plan->submission_count; s++) {
        const enum rg_queue queue = plan->submissions[s].queue;
        if (!rg_exec_queue_of(exec, queue).queue)
            return rg_exec_check(exec, VK_ERROR_INITIALIZATION_FAILED,
                                 "params without a queue that the plan uses", NULL);
        if (!pools[queue])
            RG_TRY(make_queue(exec, queue, &pools[queue]));
    }
    for (uint32_t i = 0; i < exec->slot_count && plan->submission_count; i++) {
        VkCommandBuffer *commands;
        if (!RG_MAKE_ARRAY(exec, commands, plan->submission_count))
            return VK_ERROR_OUT_OF_HOST_MEMORY;
        for (uint32_t s = 0; s < plan->submission_count; s++)
            RG_CALL(exec, NULL, AllocateCommandBuffers, exec->device,
                    &(VkCommandBufferAllocateInfo){
                        .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                        .commandPool = pools[plan->submissions[s].queue],
                        .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                        .commandBufferCount = 1,
                    },
                    &commands[s]);
        exec->slots[i].submissions = commands;
    }
fail:
    return result;
}

void rg_exec_wait_for_queues(const struct rg_exec *exec)
{
    for (uint32_t i = 0; i < RG_QUEUE_COUNT; i++) {
        if (exec->timelines[i])
            (void)exec->vk.QueueWaitIdle(rg_exec_queue_of(exec, i).queue);
    }
}

static VkSemaphoreSubmitInfo semaphore_info(const struct rg_exec *exec, enum rg_queue queue,
                                            uint32_t submission)
{
    return (VkSemaphoreSubmitInfo){
        .sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO,
        .semaphore = exec->timelines[queue],
        .value = exec->timeline + submission + 1,
        .stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
    };
}

/* Submits a recorded submission. The first one has the waits of the application, the last one its
 * signals and the fence of the slot. */
static VkResult submit(struct rg_exec *exec, uint32_t index)
{
    const struct rg_submission *submission = &exec->plan->submissions[index];
    const struct exec_slot *slot = &exec->slots[exec->slot];
    const struct rg_exec_external_sync *sync = &exec->external_sync;
    const bool is_first = index == 0;
    const bool is_last = index + 1 == exec->plan->submission_count;
    const VkSemaphoreSubmitInfo signal = semaphore_info(exec, submission->queue, index);
    VkSemaphoreSubmitInfo waits[RG_QUEUE_COUNT];
    uint32_t wait_count = 0;
    for (uint32_t i = 0; i < RG_QUEUE_COUNT; i++) {
        if (submission->waits[i])
            waits[wait_count++] = semaphore_info(exec, (enum rg_queue)i, submission->waits[i] - 1);
    }
    VkResult result;
    RG_CALL(exec, NULL, QueueSubmit2, rg_exec_queue_of(exec, submission->queue).queue, 1,
            &(VkSubmitInfo2){
                .sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2,
                .waitSemaphoreInfoCount = is_first ? sync->wait_count : wait_count,
                .pWaitSemaphoreInfos = is_first ? sync->waits : waits,
                .commandBufferInfoCount = 1,
                .pCommandBufferInfos =
                    &(VkCommandBufferSubmitInfo){
                        .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO,
                        .commandBuffer = slot->submissions[index],
                    },
                .signalSemaphoreInfoCount = is_last ? sync->signal_count : 1,
                .pSignalSemaphoreInfos = is_last ? sync->signals : &signal,
            },
            is_last ? slot->fence : VK_NULL_HANDLE);
fail:
    return result;
}

VkResult rg_exec_submit_queues(struct rg_exec *exec, const struct rg_frame *frame)
{
    const struct rg_plan *plan = exec->plan;
    struct exec_slot *slot = &exec->slots[exec->slot];
    VkResult result;
    const uint64_t start = rg_time_now();
    for (uint32_t i = 0; i < plan->submission_count; i++) {
        const struct exec_part part = {
            .first = plan->submissions[i].first_pass,
            .count = plan->submissions[i].pass_count,
            .begins = true,
            .ends = true,
        };
        RG_TRY(rg_exec_record_own(exec, slot->submissions[i], frame, &part));
    }
    RG_CALL(exec, NULL, ResetFences, exec->device, 1, &slot->fence);
    const uint64_t recorded = rg_time_now();
    for (uint32_t i = 0; i < plan->submission_count; i++)
        RG_TRY(submit(exec, i));
    exec->timeline += plan->submission_count;
    slot->submitted = true;
    slot->frame = ++exec->frame;
    slot->times.record += recorded - start;
    slot->times.submit += rg_time_now() - recorded;
fail:
    return result;
}
