/*
 * test_exec_random.c: random graphs leave what their tables say, to the last bit, and the
 * validation layer is silent.
 *
 * What the tables say, interpret_graph.c works out on the CPU. Plans are run carelessly: what a
 * plan says is undefined gets other content.
 *
 * Without arguments all seeds run; `test-exec_random SEED` runs one and prints its plan.
 */
#include <stdlib.h>
#include <string.h>

#include "tests/support/assertions.h"

#include "tests/support/all_features_device.h"
#include "tests/support/lavapipe.h"
#include "tests/support/run_random.h"

enum {
    SEEDS = 200,
    FRAMES = 3,
    FRAMES_IN_FLIGHT = 2,
    FEATURES = RUN_RANDOM_HISTORY | RUN_RANDOM_CONDITIONS,
};

/* Of all plans; none may stay at 0, or less would be tested than it seems. */
enum seen {
    RASTER, /* passes, as enum rg_kind */
    COMPUTE,
    TRANSFER,
    REPEATED,
    CONDITIONAL,
    CULLED,
    CLEARED, /* targets */
    KEPT,
    DISCARDED,
    UNNEEDED, /* afterwards */
    DEPTH,
    SHARED, /* plans whose resources share memory */
    PERSISTENT,
    TEXELS, /* uses */
    ARRAYS,
    VOLUMES,
    MASKED, /* targets */
    BLENDED,
    STENCIL, /* passes */
    INSTANCES,
    COUNTED,
    OWN,
    SKIPPED, /* passes, in some frame */
    COMPARED,
    SEEN_COUNT,
};

static const char *const seen_names[SEEN_COUNT] = {
    [RASTER] = "raster passes",
    [COMPUTE] = "compute passes",
    [TRANSFER] = "transfer passes",
    [REPEATED] = "repetitions",
    [CONDITIONAL] = "conditional passes",
    [CULLED] = "culled passes",
    [CLEARED] = "cleared targets",
    [KEPT] = "kept targets",
    [DISCARDED] = "targets that begin undefined",
    [UNNEEDED] = "targets that end undefined",
    [DEPTH] = "depth targets",
    [SHARED] = "plans that share memory",
    [PERSISTENT] = "persistent resources",
    [TEXELS] = "buffers seen as texels",
    [ARRAYS] = "second elements of arrays",
    [VOLUMES] = "images of three dimensions",
    [MASKED] = "targets of which channels stay",
    [BLENDED] = "targets that are blended with",
    [STENCIL] = "passes with a stencil test",
    [INSTANCES] = "passes with a word of each instance",
    [COUNTED] = "counted draws",
    [OWN] = "passes with a set of the program's own",
    [SKIPPED] = "passes skipped",
    [COMPARED] = "words compared",
};

/* ---- plans ---- */

static void clear(struct rg_plan_target *target)
{
    if (target->image != RG_NONE && target->load == VK_ATTACHMENT_LOAD_OP_DONT_CARE)
        target->load = VK_ATTACHMENT_LOAD_OP_CLEAR;
}

/* A copy of the passes in which targets that begin undefined begin cleared; `colors` are theirs. */
static struct rg_plan_pass *careless_passes(const struct rg_plan *plan,
                                            struct rg_plan_target *colors)
{
    struct rg_plan_pass *passes = calloc(plan->pass_count, sizeof(*passes));
    assert_non_null(passes);
    for (uint32_t p = 0; p < plan->pass_count; p++) {
        passes[p] = plan->passes[p];
        passes[p].color = colors;
        for (uint32_t i = 0; i < passes[p].color_count; i++, colors++) {
            *colors = plan->passes[p].color[i];
            clear(colors);
        }
        clear(&passes[p].depth);
    }
    return passes;
}

static void count_target(uint32_t *seen, const struct rg_plan_target *target)
{
    seen[KEPT] += target->load == VK_ATTACHMENT_LOAD_OP_LOAD;
    seen[CLEARED] += target->load == VK_ATTACHMENT_LOAD_OP_CLEAR;
    seen[DISCARDED] += target->load == VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    seen[UNNEEDED] += target->store == VK_ATTACHMENT_STORE_OP_DONT_CARE;
}

static void count_plan(uint32_t *seen, const struct rg_plan *plan,
                       const struct interpret_tables *tables)
{
    seen[CULLED] += plan->culled_count;
    seen[SHARED] += plan->memory_used < plan->memory_without_aliasing;
    for (uint32_t p = 0; p < plan->pass_count; p++) {
        const struct rg_plan_pass *pass = &plan->passes[p];
        seen[RASTER + pass->pass->kind]++;
        seen[REPEATED] += pass->repetition > 0;
        seen[CONDITIONAL] += pass->pass->when != NULL;
        seen[OWN] += pass->pass->set != NULL;
        seen[COUNTED] += pass->pass->kind == RG_RASTER &&
                         tables->rows[pass->pass - tables->passes].is_counted &&
                         interpret_use(pass->pass, RG_INDIRECT);
        seen[STENCIL] += pass->pass->stencil != NULL;
        seen[INSTANCES] += pass->pass->vertices != NULL;
        for (uint32_t i = 0; i < pass->color_count; i++) {
            count_target(seen, &pass->color[i]);
            const struct rg_target *target = &pass->pass->color[i];
            const bool blends =
                target->blend || (target->blend_state && target->blend_state->blendEnable);
            seen[BLENDED] += blends;
            seen[MASKED] += target->blend_state && !blends;
        }
        if (pass->depth.image == RG_NONE)
            continue;
        seen[DEPTH]++;
        count_target(seen, &pass->depth);
    }
    for (uint32_t i = 0; i < plan->use_count; i++) {
        const struct rg_use *use = plan->uses[i].use;
        seen[TEXELS] += use->texels || (use->buffer && use->access == RG_SAMPLED);
        seen[ARRAYS] += use->element > 0;
        seen[VOLUMES] += use->image && use->image->depth;
    }
    for (uint32_t i = 0; i < plan->image_count; i++)
        seen[PERSISTENT] += plan->images[i].persistent;
    for (uint32_t i = 0; i < plan->buffer_count; i++)
        seen[PERSISTENT] += plan->buffers[i].persistent;
}

/* ---- frames ---- */

struct device {
    struct gpu gpu;
    struct own_set own;
};

struct fixture {
    const struct device *device;
    struct run_random graph;
    struct run run;
    struct rg_plan plan; /* run.plan with these: */
    struct rg_plan_pass *passes;
    struct rg_plan_target *colors;
    struct interpret in;
    uint32_t *expected[FRAMES][RUN_OUTPUT_COUNT];
    uint32_t *seen; /* SEEN_COUNT */
    bool good;
};

static struct rg_frame frame_of(const struct fixture *f, uint32_t number)
{
    return (struct rg_frame){ number, &f->graph.tables, &f->plan, f->device->own.set };
}

/* Works a frame out, keeps its outputs, and gives the device the same uploads. */
static void interpret(struct fixture *f, uint32_t number)
{
    const struct rg_frame frame = frame_of(f, number);
    const struct interpret_tables *tables = &f->graph.tables;
    interpret_begin(&f->in);
    for (uint32_t i = 0; i < tables->buffer_count; i++) {
        const struct rg_buffer *buffer = &tables->buffers[i];
        if (buffer->memory != RG_MEMORY_UPLOAD)
            continue;
        run_random_fill(&f->graph, buffer, number, interpret_words(&f->in, buffer));
        void *mapped = rg_exec_mapped(f->run.exec, buffer, f->run.slot);
        if (mapped)
            memcpy(mapped, interpret_words(&f->in, buffer), (size_t)buffer->size);
    }
    interpret_frame(&f->in, &frame);
    for (uint32_t i = 0; f->graph.params.outputs[i]; i++) {
        const struct rg_buffer *buffer = f->graph.params.outputs[i];
        f->expected[number][i] = malloc((size_t)buffer->size);
        assert_non_null(f->expected[number][i]);
        memcpy(f->expected[number][i], interpret_words(&f->in, buffer), (size_t)buffer->size);
    }
    for (uint32_t p = 0; p < tables->pass_count; p++)
        f->seen[SKIPPED] += tables->passes[p].when && !tables->passes[p].when(&frame, 0);
}

static void compare(struct fixture *f, uint32_t number, uint32_t slot)
{
    for (uint32_t i = 0; f->graph.params.outputs[i]; i++) {
        const struct rg_buffer *buffer = f->graph.params.outputs[i];
        const uint32_t *words = rg_exec_mapped(f->run.exec, buffer, slot);
        assert_non_null(words);
        for (uint32_t w = 0; w < buffer->size / sizeof(*words); w++) {
            if (words[w] == f->expected[number][i][w])
                continue;
            print_error("seed %u, frame %u, %s, word %u: %08x instead of %08x\n",
                        (unsigned)f->graph.seed, number, buffer->name, w, words[w],
                        f->expected[number][i][w]);
            f->good = false;
            break;
        }
        f->seen[COMPARED] += (uint32_t)(buffer->size / sizeof(*words));
    }
}

/* Frames are submitted one after another, and each is read when its slot is needed. */
static void run_frames(struct fixture *f)
{
    for (uint32_t number = 0; number < FRAMES + FRAMES_IN_FLIGHT; number++) {
        const uint32_t slot = number % FRAMES_IN_FLIGHT;
        if (number < FRAMES)
            assert_int_equal(rg_exec_begin(f->run.exec, &f->run.slot), VK_SUCCESS);
        else
            assert_int_equal(rg_exec_wait(f->run.exec, slot), VK_SUCCESS);
        if (number >= FRAMES_IN_FLIGHT)
            compare(f, number - FRAMES_IN_FLIGHT, slot);
        if (number >= FRAMES)
            continue;
        assert_int_equal(f->run.slot, slot);
        interpret(f, number);
        const struct rg_frame frame = frame_of(f, number);
        assert_int_equal(rg_exec_submit(f->run.exec, &frame), VK_SUCCESS);
    }
}

static bool run_seed(const struct gpu *gpu, struct device *device, uint32_t seed, uint32_t *seen,
                     bool print)
{
    const struct rg_exec_set sets[] = { { &run_random_own, device->own.layout } };
    struct fixture f = { .device = device, .seen = seen, .good = true };
    const uint32_t message_count = gpu->message_count;
    assert_true(run_random_init(&f.graph, seed, FEATURES));
    f.graph.params.sets = sets;
    run_compile(&f.run, &device->gpu, &f.graph.params);
    if (print)
        rg_dump(f.run.plan, stdout);
    count_plan(seen, f.run.plan, &f.graph.tables);
    f.plan = *f.run.plan;
    f.colors = calloc(f.run.plan->color_count + 1, sizeof(*f.colors));
    assert_non_null(f.colors);
    f.plan.passes = f.passes = careless_passes(f.run.plan, f.colors);
    assert_true(interpret_init(&f.in, &f.graph.tables));
    assert_int_equal(run_create(&f.run, &f.plan), VK_SUCCESS);
    run_frames(&f);
    run_close(&f.run);
    if (gpu->message_count != message_count) {
        print_error("seed %u: the validation layer has something to say\n", seed);
        f.good = false;
    }
    for (uint32_t i = 0; i < FRAMES * RUN_OUTPUT_COUNT; i++)
        free(f.expected[i / RUN_OUTPUT_COUNT][i % RUN_OUTPUT_COUNT]);
    interpret_finish(&f.in);
    free(f.passes);
    free(f.colors);
    run_random_finish(&f.graph);
    return f.good;
}

/* With every feature, for counted draws. */
static void open_device(struct device *device, const struct gpu *gpu)
{
    all_features_device_open(&device->gpu, gpu);
    own_set_create(&device->own, &device->gpu, interpret_set_words, sizeof(interpret_set_words));
}

static void close_device(struct device *device)
{
    own_set_destroy(&device->own, &device->gpu);
    all_features_device_close(&device->gpu);
}

static void random_graphs_leave_what_their_tables_say(void **state)
{
    uint32_t seen[SEEN_COUNT] = { 0 };
    uint32_t bad = 0;
    struct device device;
    open_device(&device, *state);
    for (uint32_t seed = 0; seed < SEEDS; seed++)
        bad += !run_seed(*state, &device, seed, seen, false);
    close_device(&device);
    assert_int_equal(bad, 0);
    for (uint32_t i = 0; i < SEEN_COUNT; i++) {
        print_message("%s: %u\n", seen_names[i], seen[i]);
        assert_true(seen[i] > 0);
    }
}

static int run_one(uint32_t seed)
{
    void *gpu = NULL;
    uint32_t seen[SEEN_COUNT] = { 0 };
    if (lavapipe_open(&gpu))
        return EXIT_FAILURE;
    struct device device;
    open_device(&device, gpu);
    const bool good = run_seed(gpu, &device, seed, seen, true);
    close_device(&device);
    return lavapipe_close(&gpu) || !good ? EXIT_FAILURE : EXIT_SUCCESS;
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        ON_DEVICE(random_graphs_leave_what_their_tables_say),
    };
    if (argc > 1)
        return run_one((uint32_t)strtoul(argv[1], NULL, 10));
    return cmocka_run_group_tests(tests, NULL, NULL);
}
