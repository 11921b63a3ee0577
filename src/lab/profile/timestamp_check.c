/* timestamp_check.c: times test passes by GPU timestamps and by the CPU's clock. */
#include "src/lab/profile/timestamp_check.h"
#include <math.h>
#include <stdio.h>
#include "graph/rg_cmd.h"
#include "shaders/embedded.h"
#include "shaders/output/timestamp_check.h"
#include "src/base/log.h"

enum {
    SIDE = 250, /* no multiple of a rasteriser's tile */
    HEAVY = 16, /* heavy over light passes' work */
    GROUP_COUNT = 256,
    FRAME_COUNT = 3, /* frames per clock and attempt */
    TRY_COUNT = 20,
    FIRST_ROUNDS = 16,
    ROUNDS_MAX = 1 << 22,
    ENOUGH_MS = 6, /* far above a submit's cost, ms */
};

struct rg_frame {
    uint32_t rounds; /* light passes' loop iterations */
};

static const struct rg_image first = {
    .name = "timestamp_check.first",
    .format = VK_FORMAT_R8G8B8A8_UNORM,
};
static const struct rg_image second = {
    .name = "timestamp_check.second",
    .format = VK_FORMAT_R8G8B8A8_UNORM,
};
static const struct rg_buffer numbers = {
    .name = "timestamp_check.numbers",
    .size = sizeof(float) * GROUP_COUNT * TIMESTAMP_CHECK_GROUP,
};
static const struct rg_buffer copied = {
    .name = "timestamp_check.copied",
    .size_per_texel = 4,
    .memory = RG_MEMORY_READBACK,
};

static const struct rg_buffer untouched = { .name = "timestamp_check.untouched", .size = 4 };

static void push(struct rg_cmd *cmd, uint32_t rounds)
{
    rg_cmd_push(cmd, &(struct timestamp_check_push){ rounds }, sizeof(struct timestamp_check_push));
}

static void record_light(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    push(cmd, frame->rounds);
    rg_cmd_draw(cmd, 3);
}

static void record_heavy(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    push(cmd, frame->rounds * HEAVY);
    rg_cmd_draw(cmd, 3);
}

static void record_compute(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    push(cmd, frame->rounds * HEAVY);
    rg_cmd_dispatch(cmd, GROUP_COUNT, 1, 1);
}

static void record_copy(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    rg_cmd_copy_image_to_buffer(cmd, &second, &copied, 0);
}

static void record_nothing(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)cmd;
    (void)frame;
}

#define SCREEN(title, target, load, record_function) \
    { \
        .name = "timestamp_check." title, .color = RG_TARGETS({ &(target), (load) }), \
        .vert = &fullscreen_vert, .frag = &timestamp_check_frag, \
        .push_size = sizeof(struct timestamp_check_push), .record = (record_function), \
    }

static const struct rg_pass passes[TIMESTAMP_CHECK_PASS_COUNT] = {
    SCREEN("heavy", first, RG_LOAD_DISCARD, record_heavy),
    SCREEN("same_target", first, RG_LOAD_KEEP, record_light),
    {
        .name = "timestamp_check.compute",
        .kind = RG_COMPUTE,
        .uses = RG_USES(
            { .buffer = &numbers, .access = RG_STORAGE_WRITE, .binding = TIMESTAMP_CHECK_NUMBERS }),
        .comp = &timestamp_check_comp,
        .push_size = sizeof(struct timestamp_check_push),
        .record = record_compute,
    },
    SCREEN("light", second, RG_LOAD_DISCARD, record_light),
    SCREEN("heavy_again", second, RG_LOAD_KEEP, record_heavy),
    {
        .name = "timestamp_check.copy",
        .kind = RG_TRANSFER,
        .uses = RG_USES({ .image = &second, .access = RG_COPY_SRC },
                        { .buffer = &copied, .access = RG_COPY_DST }),
        .record = record_copy,
    },
    {
        .name = "timestamp_check.nothing",
        .kind = RG_TRANSFER,
        .uses = RG_USES({ .buffer = &untouched, .access = RG_COPY_DST }),
        .record = record_nothing,
    },
};

struct test {
    struct rg_plan *plan;
    struct rg_exec *exec;
    struct rg_frame frame;
    struct rg_times times; /* of the last frame */
};

static void log_exec(void *user, const char *what, VkResult result)
{
    (void)user;
    (void)gpu_failed(what, result);
}

static struct rg_plan *compile(const struct rg_device *device)
{
    static const struct rg_technique technique = RG_TECHNIQUE("timestamp_check", passes);
    const struct rg_technique *const techniques[] = { &technique };
    const struct rg_output outputs[] = {
        { .image = &first, .access = RG_SAMPLED },
        { .buffer = &numbers, .access = RG_COPY_SRC },
        { .buffer = &copied, .access = RG_HOST_READ },
        { .buffer = &untouched, .access = RG_COPY_SRC },
    };
    return rg_compile(&(struct rg_compile_params){
        .techniques = techniques,
        .technique_count = 1,
        .view = { SIDE, SIDE },
        .outputs = outputs,
        .output_count = sizeof(outputs) / sizeof(outputs[0]),
        .device = device,
        .sharing = RG_SHARE_NOTHING,
    });
}

static enum status open_test(struct test *test, const struct gpu *gpu)
{
    const struct rg_vulkan vulkan = {
        gpu->instance,
        vkGetInstanceProcAddr,
        gpu->physical,
        gpu->device,
    };
    const struct rg_device device = rg_exec_device(&vulkan);
    VkResult result = VK_ERROR_OUT_OF_HOST_MEMORY;
    test->plan = compile(&device);
    if (!test->plan)
        return gpu_failed("testing the device's timestamps", result);
    test->exec = rg_exec_create(
        &(struct rg_exec_params){
            .plan = test->plan,
            .instance = gpu->instance,
            .get_proc_addr = vkGetInstanceProcAddr,
            .physical = gpu->physical,
            .device = gpu->device,
            .queue = gpu->queue,
            .queue_family = gpu->queue_family,
            .pipeline_cache = gpu->pipeline_cache,
            .frames_in_flight = 1,
            .render_passes = gpu->validated,
            .measured = true,
            .statistics = gpu->has_statistics,
            .log = log_exec,
        },
        &result);
    return gpu_status(result);
}

static VkResult draw(struct test *test, enum rg_clock clock, bool statistics)
{
    uint32_t slot;
    rg_exec_measure(test->exec, &(struct rg_measure){ clock, statistics });
    VkResult result = rg_exec_begin(test->exec, &slot);
    if (result == VK_SUCCESS)
        result = rg_exec_submit(test->exec, &test->frame);
    if (result == VK_SUCCESS)
        result = rg_exec_wait(test->exec, slot);
    test->times = rg_exec_times(test->exec);
    return result;
}

static double pass_ms(const struct test *test, uint32_t pass)
{
    const struct rg_pass_time *time = &test->times.passes[pass];
    return (double)(time->end - time->begin) * 1e-6;
}

/* Doubles the work until a heavy pass takes at least ENOUGH_MS milliseconds. */
static VkResult find_rounds(struct test *test)
{
    test->frame.rounds = FIRST_ROUNDS;
    /* Warm-up, in which the driver compiles the shaders. */
    VkResult result = draw(test, RG_CLOCK_SUBMITS, false);
    while (result == VK_SUCCESS && test->frame.rounds < ROUNDS_MAX / HEAVY) {
        result = draw(test, RG_CLOCK_SUBMITS, false);
        if (result != VK_SUCCESS || pass_ms(test, 0) >= ENOUGH_MS)
            break;
        test->frame.rounds *= 2;
    }
    return result;
}

/* Measures frames with both clocks alternately. Updates each pass's minimum time over all attempts.
 * Minimums are used, because other load only adds time. */
static VkResult update_minimums(struct test *test, struct timestamp_check_times *times,
                                bool is_first)
{
    const enum rg_clock clocks[] = { RG_CLOCK_SUBMITS, RG_CLOCK_EXACT };

    double *const minimums[] = { times->alone, times->stamped };
    VkResult result = VK_SUCCESS;
    for (uint32_t f = 0; f < 2 * FRAME_COUNT && result == VK_SUCCESS; f++) {
        result = draw(test, clocks[f % 2], false);
        for (uint32_t p = 0; p < TIMESTAMP_CHECK_PASS_COUNT && result == VK_SUCCESS; p++) {
            double *best = &minimums[f % 2][p];
            *best = is_first && f < 2 ? pass_ms(test, p) : fmin(*best, pass_ms(test, p));
        }
    }
    return result;
}

double timestamp_check_error(const struct timestamp_check_times *times)
{
    const double submit = times->alone[TIMESTAMP_CHECK_PASS_COUNT - 1];
    double all = 0;
    double worst = 0;
    for (uint32_t p = 0; p < TIMESTAMP_CHECK_PASS_COUNT - 1; p++)
        all += times->alone[p] - submit;
    for (uint32_t p = 0; p < TIMESTAMP_CHECK_PASS_COUNT - 1; p++) {
        const double alone = times->alone[p] - submit;
        const double error = fabs(times->stamped[p] - alone) / fmax(alone, all / 10);
        worst = fmax(worst, error);
    }
    return worst;
}

/* Repeats the test until both clocks agree. Usually one attempt suffices. Repeating helps, because
 * interference by other load is temporary, whereas driver errors persist. */
static VkResult judge(struct test *test, uint32_t try_count, struct profile_clock *clock)
{
    struct timestamp_check_times times = { 0 };
    const bool is_stamped = rg_exec_has_clock(test->exec, RG_CLOCK_EXACT);
    double error = (double)INFINITY;
    VkResult result = VK_SUCCESS;
    for (uint32_t i = 0; i < try_count && error > TIMESTAMP_CHECK_TOLERANCE; i++) {
        result = update_minimums(test, &times, i == 0);
        if (result != VK_SUCCESS || !is_stamped)
            break;
        error = timestamp_check_error(&times);
    }
    if (result != VK_SUCCESS)
        return result;
    clock->clock = error <= TIMESTAMP_CHECK_TOLERANCE ? RG_CLOCK_EXACT : RG_CLOCK_SUBMITS;
    clock->submit_cost = times.alone[TIMESTAMP_CHECK_PASS_COUNT - 1];
    if (is_stamped)
        snprintf(clock->reason, sizeof(clock->reason),
                 "in a test, timestamps and passes submitted alone differ by %.1f %% at most",
                 100 * error);
    else
        snprintf(clock->reason, sizeof(clock->reason), "the device has no timestamps");
    return result;
}

static VkResult count_fragments(struct test *test, struct profile_clock *clock)
{
    VkResult result = draw(test, RG_CLOCK_NONE, true);
    if (result == VK_SUCCESS) {
        const struct rg_pass_time *heavy = &test->times.passes[0];
        clock->fragments_are_exact = test->times.measure.statistics &&
                                     heavy->fragments == heavy->samples &&
                                     heavy->samples == (uint64_t)SIDE * SIDE;
    }
    return result;
}

enum status timestamp_check_run(struct gpu *gpu, enum rg_clock chosen, struct profile_clock *clock)
{
    struct test test = { 0 };
    *clock = (struct profile_clock){ .clock = RG_CLOCK_SUBMITS };
    enum status status = open_test(&test, gpu);
    if (status == STATUS_OK) {
        VkResult result = find_rounds(&test);
        if (result == VK_SUCCESS)
            result = judge(&test, chosen == RG_CLOCK_SUBMITS ? 1 : TRY_COUNT, clock);
        if (result == VK_SUCCESS)
            result = count_fragments(&test, clock);
        if (result != VK_SUCCESS)
            status = gpu_status(result);
    }
    rg_exec_destroy(test.exec);
    rg_plan_destroy(test.plan);
    return status;
}
