/* test_exec_random.c: random graphs give bit-identical results with and without aliasing of their
 * images, and on several queues. Each image or buffer has several pages of memory. */
#include "tests/support/assertions.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/gpu/shaders/data.h"
#include "tests/support/lavapipe.h"
#include "tests/support/rectangle_rows.h"

enum {
    SIDE = 128, /* texels; an image of integers has 64 KiB */
    SEEDS = 12,
    ROWS = 28,  /* random ones */
    MOST = 40,  /* with those that make the outputs */
    RECENT = 6, /* how far back rows read, for short lifetimes */
    FRAMES = 3,
};

static const struct rg_buffer outputs[] = {
    { "floats", 0, 16, RG_MEMORY_READBACK },
    { "integers", 0, 4, RG_MEMORY_READBACK },
};

struct graph {
    uint64_t state; /* of the random numbers */
    struct rg_image colors[MOST], integers[MOST];
    struct rg_buffer buffers[MOST];
    uint32_t color_count, integer_count, buffer_count, row_count, use_count;
    struct rg_use uses[MOST][3];
    struct rg_target targets[MOST];
    struct paint_push paints[MOST];
    struct rg_pass rows[MOST];
    char names[4 * MOST][8];
    uint32_t name_count;
};

static uint32_t below(struct graph *g, uint32_t limit)
{
    g->state = g->state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (uint32_t)(g->state >> 33) % limit;
}

/* Returns the index of one of the newest `count` elements. */
static uint32_t recent(struct graph *g, uint32_t count)
{
    return count - 1 - below(g, count < RECENT ? count : RECENT);
}

static const char *new_name(struct graph *g)
{
    (void)snprintf(g->names[g->name_count], sizeof(g->names[0]), "%u", g->name_count);
    return g->names[g->name_count++];
}

static const struct rg_image *new_image(struct graph *g, bool is_color)
{
    struct rg_image *image =
        is_color ? &g->colors[g->color_count++] : &g->integers[g->integer_count++];
    image->name = new_name(g);
    image->format = is_color ? VK_FORMAT_R32G32B32A32_SFLOAT : VK_FORMAT_R32_UINT;
    return image;
}

static void record_fill(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    const struct rg_pass *row = rg_cmd_pass(cmd);
    rg_cmd_fill_buffer(cmd, row->uses[0].buffer, 0, SIDE * SIDE * 4,
                       (uint32_t)(row - frame->rows) + 1);
}

static void record_groups(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    rg_cmd_dispatch(cmd, SIDE / DATA_GROUP, SIDE / DATA_GROUP, 1);
}

static struct rg_pass *new_row(struct graph *g, enum rg_kind kind, rg_record_fn *record)
{
    struct rg_pass *row = &g->rows[g->row_count];
    *row = (struct rg_pass){ .name = new_name(g), .kind = kind, .record = record };
    row->uses = g->uses[g->row_count++];
    g->use_count = 0;
    row->queue = (enum rg_queue)below(g, (uint32_t)kind + 1);
    return row;
}

/* Adds a use of an image or a buffer, the other one being NULL, to the newest row. */
static void use(struct graph *g, const struct rg_image *image, const struct rg_buffer *buffer,
                enum rg_access access, uint16_t binding)
{
    g->uses[g->row_count - 1][g->use_count++] = (struct rg_use){ image, buffer, access, binding };
}

/* Adds a row that draws an image of floats: a colour, plus the texels of an earlier image. */
static void draw(struct graph *g)
{
    const uint32_t index = g->row_count;
    struct rg_pass *row = new_row(g, RG_RASTER, painted_record);
    const bool fetches = g->color_count && below(g, 4);
    if (fetches)
        use(g, &g->colors[recent(g, g->color_count)], NULL, RG_SAMPLED, PAINT_SOURCE);
    g->targets[index] = (struct rg_target){ .image = new_image(g, true), .load = RG_LOAD_CLEAR };
    g->paints[index] = (struct paint_push){ .color = painted_color((float)index, 1, 2, 3), ALL };
    if (below(g, 2))
        g->paints[index].to.x = 0; /* only half of it */
    row->color = &g->targets[index];
    row->color_count = 1;
    row->vert = &paint_vert;
    row->frag = fetches ? &fetch_frag : &paint_frag;
    row->push_size = sizeof(struct paint_push);
}

/* Adds a row that adds an image's numbers to a buffer, or stores a buffer to a new image. */
static void compute(struct graph *g, bool adds)
{
    new_row(g, RG_COMPUTE, record_groups)->comp = adds ? &add_comp : &copy_comp;
    use(g, NULL, &g->buffers[recent(g, g->buffer_count)],
        adds ? RG_STORAGE_READ_WRITE : RG_STORAGE_READ, DATA_NUMBERS);
    use(g, adds ? &g->integers[recent(g, g->integer_count)] : new_image(g, false), NULL,
        adds ? RG_STORAGE_READ : RG_STORAGE_WRITE, DATA_TEXELS);
}

static void copy(struct graph *g, const struct rg_image *image, const struct rg_buffer *buffer)
{
    new_row(g, RG_TRANSFER, run_record_read);
    use(g, image, NULL, RG_COPY_SRC, 0);
    use(g, NULL, buffer, RG_COPY_DST, 0);
}

static void fill(struct graph *g)
{
    new_row(g, RG_TRANSFER, record_fill);
    use(g, NULL, &g->buffers[g->buffer_count++], RG_COPY_DST, 0);
}

static void make(struct graph *g, uint32_t seed)
{
    *g = (struct graph){ .state = seed };
    for (uint32_t i = 0; i < MOST; i++)
        g->buffers[i] = (struct rg_buffer){ .name = new_name(g), .size_per_texel = 4 };
    while (g->row_count < ROWS) {
        const uint32_t choice = below(g, 6);
        if (choice < 2)
            draw(g);
        else if (choice == 2 || !g->buffer_count)
            fill(g);
        else if (choice < 5)
            compute(g, choice == 3 && g->integer_count);
        else if (!g->integer_count)
            compute(g, false);
        else
            copy(g, &g->integers[recent(g, g->integer_count)], &g->buffers[g->buffer_count++]);
    }
    draw(g);
    copy(g, &g->colors[g->color_count - 1], &outputs[0]);
    compute(g, false);
    copy(g, &g->integers[g->integer_count - 1], &outputs[1]);
}

/* Runs frames, and compares the last one's outputs with `expected`, or stores them there. Returns
 * how many bytes the plan saves by aliasing. */
static VkDeviceSize run_graph(struct gpu *gpu, const struct graph *g, enum rg_sharing sharing,
                              VkFlags queues, unsigned char *expected, bool compares)
{
    struct run_params params = {
        .technique = { "random", g->rows, g->row_count },
        .view = { SIDE, SIDE },
        .sharing = sharing,
        .queues = queues,
        .outputs = { &outputs[0], &outputs[1] },
    };
    const struct rg_frame frame = { .rows = g->rows, .paints = g->paints };
    struct run run;
    run_open(&run, gpu, &params);
    for (uint32_t i = 0; i < FRAMES; i++) {
        assert_int_equal(rg_exec_begin(run.exec, &run.slot), VK_SUCCESS);
        assert_int_equal(rg_exec_submit(run.exec, &frame), VK_SUCCESS);
    }
    assert_int_equal(rg_exec_wait_all(run.exec), VK_SUCCESS);
    for (uint32_t i = 0; i < 2; i++) {
        const size_t size = (size_t)SIDE * SIDE * outputs[i].size_per_texel;
        if (compares)
            assert_memory_equal(expected, run_data(&run, &outputs[i]), size);
        else
            memcpy(expected, run_data(&run, &outputs[i]), size);
        expected += size;
    }
    assert_true(!queues == !run.plan->submission_count);
    const VkDeviceSize saved = run.plan->memory_without_aliasing - run.plan->memory_used;
    run_close(&run);
    return saved;
}

static void results_do_not_depend_on_memory(void **state)
{
    unsigned char *expected = malloc((size_t)SIDE * SIDE * 20);
    struct graph *g = malloc(sizeof(*g));
    VkDeviceSize saved = 0;
    assert_true(expected && g);
    for (uint32_t seed = 1; seed <= SEEDS; seed++) {
        make(g, seed);
        run_graph(*state, g, RG_SHARE_NOTHING, 0, expected, false);
        saved += run_graph(*state, g, RG_SHARE_FEWEST_BATCHES, 0, expected, true);
    }
    assert_true(saved >= (VkDeviceSize)SEEDS * SIDE * SIDE * 4);
    free(g);
    free(expected);
}

static void results_do_not_depend_on_queues(void **state)
{
    const VkFlags all = 1 << RG_QUEUE_COMPUTE | 1 << RG_QUEUE_TRANSFER;
    unsigned char *expected = malloc((size_t)SIDE * SIDE * 20);
    struct graph *g = malloc(sizeof(*g));
    assert_true(expected && g);
    for (uint32_t seed = 1; seed <= SEEDS; seed++) {
        make(g, seed);
        run_graph(*state, g, RG_SHARE_FEWEST_BATCHES, 0, expected, false);
        run_graph(*state, g, RG_SHARE_FEWEST_BATCHES, all, expected, true);
    }
    free(g);
    free(expected);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_DEVICE(results_do_not_depend_on_memory),
        cmocka_unit_test_setup_teardown(results_do_not_depend_on_queues,
                                        lavapipe_open_for_timelines, lavapipe_close),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
