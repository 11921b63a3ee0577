/*
 * test_exec_record.c: frames in the program's own command buffers, with its own fences and timeline
 * semaphores, and secondary command buffers recorded in several threads.
 */
#include <pthread.h>
#include <stdatomic.h>
#include <string.h>

#include "tests/support/assertions.h"
#include "tests/support/feature_graphs.h"
#include "tests/support/lavapipe.h"

enum {
    SLOT_COUNT = 3,
    FRAME_COUNT = 12,
    THREAD_COUNT = 4,
};

/* ---- the program's own frames ---- */

static const struct rg_image texels = { .name = "texels", .format = VK_FORMAT_R32_UINT };
static const struct rg_buffer numbers = { .name = "numbers", .size_per_texel = 4 };
static const struct rg_buffer numbers_out = FEATURE_NUMBERS("numbers out");
static const struct rg_buffer texels_out = FEATURE_NUMBERS("texels out");

static const struct rg_pass rows[] = {
    { .name = "fill", FEATURE_FILL(texels, numbers) },
    FEATURE_COPY("read numbers", numbers, numbers_out),
};
static const struct rg_pass other_rows[] = {
    { .name = "fill", FEATURE_FILL(texels, numbers) },
    RUN_READ("read texels", texels, texels_out),
    FEATURE_COPY("read numbers", numbers, numbers_out),
};

static const struct run_params params = {
    .technique = RG_TECHNIQUE("test", rows),
    .outputs = { &numbers_out },
    .frames_in_flight = SLOT_COUNT,
    .measure = { RG_CLOCK_STREAM, true },
};
static const struct run_params other_params = {
    .technique = RG_TECHNIQUE("test", other_rows),
    .outputs = { &numbers_out, &texels_out },
    .frames_in_flight = SLOT_COUNT,
    .measure = { RG_CLOCK_STREAM, true },
};

/* Command buffers and fences by slot, and a timeline semaphore for the test that needs one: the
 * synchronization validation of some releases ignores that the host has waited for a value. */
struct frames {
    struct gpu *gpu;
    VkCommandPool pool;
    VkCommandBuffer commands[SLOT_COUNT];
    VkFence fences[SLOT_COUNT];
    VkSemaphore timeline;
};

static void frames_init(struct frames *f, struct gpu *gpu)
{
    const VkSemaphoreTypeCreateInfo type = {
        .sType = VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO,
        .semaphoreType = VK_SEMAPHORE_TYPE_TIMELINE,
    };
    f->gpu = gpu;
    assert_int_equal(
        vkCreateCommandPool(gpu->device,
                            &(VkCommandPoolCreateInfo){
                                .sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                .flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT,
                                .queueFamilyIndex = gpu->queue_family,
                            },
                            NULL, &f->pool),
        VK_SUCCESS);
    assert_int_equal(
        vkAllocateCommandBuffers(gpu->device,
                                 &(VkCommandBufferAllocateInfo){
                                     .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                     .commandPool = f->pool,
                                     .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                     .commandBufferCount = SLOT_COUNT,
                                 },
                                 f->commands),
        VK_SUCCESS);
    assert_int_equal(vkCreateSemaphore(gpu->device,
                                       &(VkSemaphoreCreateInfo){
                                           .sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO,
                                           .pNext = &type,
                                       },
                                       NULL, &f->timeline),
                     VK_SUCCESS);
    for (uint32_t i = 0; i < SLOT_COUNT; i++)
        assert_int_equal(
            vkCreateFence(gpu->device,
                          &(VkFenceCreateInfo){ .sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO },
                          NULL, &f->fences[i]),
            VK_SUCCESS);
}

static void frames_finish(struct frames *f)
{
    for (uint32_t i = 0; i < SLOT_COUNT; i++)
        vkDestroyFence(f->gpu->device, f->fences[i], NULL);
    vkDestroySemaphore(f->gpu->device, f->timeline, NULL);
    vkDestroyCommandPool(f->gpu->device, f->pool, NULL);
}

/* Waits for a frame, and prepares its fence for the next one of the slot. */
static void await_frame(const struct frames *f, uint64_t number)
{
    const VkFence *fence = &f->fences[number % SLOT_COUNT];
    assert_int_equal(vkWaitForFences(f->gpu->device, 1, fence, VK_TRUE, UINT64_MAX), VK_SUCCESS);
    assert_int_equal(vkResetFences(f->gpu->device, 1, fence), VK_SUCCESS);
}

/* Records frame `number` between the program's own commands, and submits it. */
static void record_frame(struct frames *f, struct run *run, uint64_t number)
{
    const uint32_t slot = (uint32_t)(number % SLOT_COUNT);
    VkCommandBuffer commands = f->commands[slot];
    const VkCommandBufferBeginInfo begin = {
        .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
        .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT,
    };
    const VkCommandBufferSubmitInfo buffer = {
        .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO,
        .commandBuffer = commands,
    };
    const VkSubmitInfo2 submit = {
        .sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2,
        .commandBufferInfoCount = 1,
        .pCommandBufferInfos = &buffer,
    };
    run->slot = slot;
    *(struct data_seed *)run_data(run, &feature_seed) = (struct data_seed){ (uint32_t)number + 1 };
    assert_int_equal(vkBeginCommandBuffer(commands, &begin), VK_SUCCESS);
    assert_int_equal(
        rg_exec_record(run->exec, &(struct rg_exec_recording){ commands, slot, 0 }, NULL),
        VK_SUCCESS);
    assert_int_equal(vkEndCommandBuffer(commands), VK_SUCCESS);
    assert_int_equal(vkQueueSubmit2(f->gpu->queue, 1, &submit, f->fences[slot]), VK_SUCCESS);
}

static void check_numbers(struct run *run, uint64_t number)
{
    run->slot = (uint32_t)(number % SLOT_COUNT);
    assert_int_equal(rg_exec_wait(run->exec, run->slot), VK_SUCCESS);
    const uint32_t *read = run_data(run, &numbers_out);
    for (uint32_t i = 0; i < FEATURE_TEXELS; i++)
        assert_int_equal(read[i], 3 * (i + number + 1));
}

/* Plans change while frames are in flight. */
static void program_records_and_submits(void **state)
{
    for (unsigned way = 0; way < RUN_VARIANT_COUNT; way++) {
        const struct run_params plans[] = { run_variant(&params, way),
                                            run_variant(&other_params, way) };
        struct frames frames;
        struct run run;
        frames_init(&frames, *state);
        run_open(&run, *state, &plans[0]);
        for (uint64_t number = 0; number < FRAME_COUNT; number++) {
            if (number >= SLOT_COUNT) {
                await_frame(&frames, number - SLOT_COUNT);
                check_numbers(&run, number - SLOT_COUNT);
            }
            record_frame(&frames, &run, number);
            if (number % 4 == 3)
                run_update(&run, &plans[number / 4 % 2]);
        }
        for (uint64_t number = FRAME_COUNT - SLOT_COUNT; number < FRAME_COUNT; number++) {
            await_frame(&frames, number);
            check_numbers(&run, number);
        }
        run_close(&run);
        frames_finish(&frames);
    }
}

/* The frame waits for a value that the host signals later, and signals the next one. */
static void frames_wait_for_timelines(void **state)
{
    struct frames frames;
    struct run run;
    frames_init(&frames, *state);
    run_open(&run, *state, &params);
    const VkSemaphoreSubmitInfo wait = {
        .sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO,
        .semaphore = frames.timeline,
        .value = 1,
        .stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
    };
    VkSemaphoreSubmitInfo signal = wait;
    signal.value = 2;
    assert_int_equal(rg_exec_begin(run.exec, &run.slot), VK_SUCCESS);
    *(struct data_seed *)run_data(&run, &feature_seed) = (struct data_seed){ 1 };
    assert_int_equal(
        rg_exec_submit_synced(run.exec, NULL,
                              &(struct rg_exec_external_sync){ 0, 1, 1, &wait, &signal }),
        VK_SUCCESS);
    run_update(&run, &other_params); /* which does not wait for this frame */
    const uint64_t finished = 2;
    const VkSemaphoreWaitInfo info = {
        .sType = VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO,
        .semaphoreCount = 1,
        .pSemaphores = &frames.timeline,
        .pValues = &finished,
    };
    assert_int_equal(vkWaitSemaphores(run.gpu->device, &info, 50000000), VK_TIMEOUT);
    assert_int_equal(vkSignalSemaphore(run.gpu->device,
                                       &(VkSemaphoreSignalInfo){
                                           .sType = VK_STRUCTURE_TYPE_SEMAPHORE_SIGNAL_INFO,
                                           .semaphore = frames.timeline,
                                           .value = 1,
                                       }),
                     VK_SUCCESS);
    assert_int_equal(vkWaitSemaphores(run.gpu->device, &info, 10000000000), VK_SUCCESS);
    check_numbers(&run, 0);
    run_close(&run);
    frames_finish(&frames);
}

/* ---- secondary command buffers ---- */

static const struct rg_image picture = COLOR_IMAGE("picture");
static const struct rg_image depth = { .name = "depth", .format = VK_FORMAT_D32_SFLOAT };
static const struct rg_buffer picture_out = COLOR_BUFFER("picture out");

/* One thread's command buffer, which draws a column of the image. */
struct column {
    pthread_t thread;
    const struct rg_cmd *cmd;
    VkCommandPool pool;
    VkCommandBuffer commands;
    uint32_t index;
    VkResult result;
};

static struct column columns[THREAD_COUNT];

static void draw_column(struct rg_cmd *cmd, void *user)
{
    const struct column *column = user;
    const float from = -1.0F + 2.0F * (float)column->index / THREAD_COUNT;
    const struct paint_push push = {
        .color = painted_color((float)column->index, 2, 3, 1),
        .from = { { from, -1 } },
        .to = { { from + 2.0F / THREAD_COUNT, 1 } },
    };
    painted_draw(cmd, &push);
}

static atomic_int waiting; /* threads that have not begun */
static rg_secondary_fn *record_column_by = draw_column;

static void *record_column(void *user)
{
    struct column *column = user;
    column->result =
        rg_cmd_record_secondary(column->cmd, column->commands, record_column_by, column);
    return NULL;
}

static void record_columns(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    VkCommandBuffer commands[THREAD_COUNT];
    (void)frame;
    for (uint32_t i = 0; i < THREAD_COUNT; i++) {
        columns[i].cmd = cmd;
        assert_int_equal(pthread_create(&columns[i].thread, NULL, record_column, &columns[i]), 0);
    }
    for (uint32_t i = 0; i < THREAD_COUNT; i++) {
        assert_int_equal(pthread_join(columns[i].thread, NULL), 0);
        assert_int_equal(columns[i].result, VK_SUCCESS);
        commands[i] = columns[i].commands;
    }
    rg_cmd_execute(cmd, commands, THREAD_COUNT);
}

static const struct rg_pass column_rows[] = {
    {
        .name = "columns",
        .color = RG_TARGETS({ &picture, RG_LOAD_CLEAR }),
        .depth = { &depth, RG_LOAD_CLEAR, .clear.depthStencil.depth = 1 },
        PAINTED_BY(record_columns, &paint_frag),
        .secondary = true,
    },
    RUN_READ("read", picture, picture_out),
};

static void check_columns(struct run *run)
{
    for (uint32_t i = 0; i < FEATURE_TEXELS; i++) {
        const uint32_t column = i % FEATURE_SIZE * THREAD_COUNT / FEATURE_SIZE;
        painted_check(run, &picture_out, i, painted_color((float)column, 2, 3, 1));
    }
}

static void make_columns(const struct gpu *gpu)
{
    for (uint32_t i = 0; i < THREAD_COUNT; i++) {
        const VkCommandPoolCreateInfo pool = {
            .sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
            .flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT,
            .queueFamilyIndex = gpu->queue_family,
        };
        columns[i] = (struct column){ .index = i };
        assert_int_equal(vkCreateCommandPool(gpu->device, &pool, NULL, &columns[i].pool),
                         VK_SUCCESS);
        const VkCommandBufferAllocateInfo info = {
            .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
            .commandPool = columns[i].pool,
            .level = VK_COMMAND_BUFFER_LEVEL_SECONDARY,
            .commandBufferCount = 1,
        };
        assert_int_equal(vkAllocateCommandBuffers(gpu->device, &info, &columns[i].commands),
                         VK_SUCCESS);
    }
}

static void destroy_columns(const struct gpu *gpu)
{
    for (uint32_t i = 0; i < THREAD_COUNT; i++)
        vkDestroyCommandPool(gpu->device, columns[i].pool, NULL);
}

static void threads_record_a_pass(void **state)
{
    const struct gpu *gpu = *state;
    make_columns(gpu);
    PAINTED_VARIANTS(state, column_rows, NULL, check_columns, .outputs = { &picture_out },
                     .measure = { RG_CLOCK_STREAM, true });
    destroy_columns(gpu);
}

static void record_undeclared(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    assert_int_equal(rg_cmd_record_secondary(cmd, VK_NULL_HANDLE, draw_column, NULL),
                     VK_ERROR_VALIDATION_FAILED_EXT);
    rg_cmd_execute(cmd, NULL, 1);
}

static void record_outside(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    painted_draw(cmd, &(struct paint_push){ ALL });
}

/* Expects that a frame with this record function of the first row is refused. */
static void check_refused(struct gpu *gpu, bool secondary, rg_record_fn *record, const char *why)
{
    struct rg_pass undeclared[] = { column_rows[0], column_rows[1] };
    struct run run;
    undeclared[0].secondary = secondary;
    undeclared[0].record = record;
    run_open(&run, gpu,
             &(struct run_params){
                 .technique = RG_TECHNIQUE("test", undeclared),
                 .outputs = { &picture_out },
             });
    assert_int_equal(rg_exec_begin(run.exec, &run.slot), VK_SUCCESS);
    assert_int_equal(rg_exec_submit(run.exec, NULL), VK_ERROR_VALIDATION_FAILED_EXT);
    assert_non_null(strstr(run.line, why));
    run_close(&run);
}

/* Misuses a command in all threads at a time. */
static void dispatch_in_column(struct rg_cmd *cmd, void *user)
{
    (void)user;
    for (waiting--; waiting > 0;)
        ;
    rg_cmd_dispatch(cmd, 1, 1, 1);
}

static void threads_are_checked(void **state)
{
    struct run run;
    make_columns(*state);
    record_column_by = dispatch_in_column;
    run_open(&run, *state,
             &(struct run_params){
                 .technique = RG_TECHNIQUE("test", column_rows),
                 .outputs = { &picture_out },
             });
    for (int frame = 1; frame <= 20; frame++) {
        waiting = THREAD_COUNT;
        assert_int_equal(rg_exec_begin(run.exec, &run.slot), VK_SUCCESS);
        assert_int_equal(rg_exec_submit(run.exec, NULL), VK_ERROR_VALIDATION_FAILED_EXT);
        assert_non_null(strstr(run.line, "columns: a dispatch needs a compute row"));
        assert_int_equal(run.line_count, frame);
    }
    run_close(&run);
    destroy_columns(*state);
    record_column_by = draw_column;
}

static void secondary_rows_are_checked(void **state)
{
    check_refused(*state, false, record_undeclared,
                  "columns: rg_cmd_record_secondary() needs rg_pass.secondary");
    check_refused(*state, true, record_outside,
                  "columns: rg_cmd_push() outside of rg_cmd_record_secondary()");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_DEVICE(program_records_and_submits), ON_DEVICE(frames_wait_for_timelines),
        ON_DEVICE(threads_record_a_pass),       ON_DEVICE(secondary_rows_are_checked),
        ON_DEVICE(threads_are_checked),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
