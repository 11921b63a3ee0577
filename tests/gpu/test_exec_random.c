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
    ROWS = 28,   /* random ones */
    MOST = 40,   /* with those that make the outputs */
    OUTPUTS = 4, /* two images of floats and two buffers of integers */
    RECENT = 6,  /* how far back rows read, for short lifetimes */
    FRAMES = 3,
};

struct graph {
    uint64_t state; /* of the random numbers */
    struct rg_image colors[MOST], integers[MOST];
    struct rg_buffer buffers[MOST];
    uint32_t color_count, integer_count, buffer_count, row_count;
    struct rg_use uses[MOST][3];
    struct rg_target targets[MOST];
    struct paint_push paints[MOST];
    struct rg_pass rows[MOST];
    struct rg_buffer outputs[OUTPUTS];
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
    char *name = g->names[g->name_count];
    (void)snprintf(name, sizeof(g->names[0]), "%u", g->name_count++);
    return name;
}

static const struct rg_image *new_image(struct graph *g, bool is_color)
{
    struct rg_image *image =
        is_color ? &g->colors[g->color_count++] : &g->integers[g->integer_count++];
    *image = (struct rg_image){
        .name = new_name(g),
        .format = is_color ? VK_FORMAT_R32G32B32A32_SFLOAT : VK_FORMAT_R32_UINT,
    };
    return image;
}

static const struct rg_buffer *new_buffer(struct graph *g)
{
    g->buffers[g->buffer_count] = (struct rg_buffer){ .name = new_name(g), .size_per_texel = 4 };
    return &g->buffers[g->buffer_count++];
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
    row->queue = (enum rg_queue)below(g, (uint32_t)kind + 1);
    return row;
}

static void use(struct rg_pass *row, uint32_t i, struct rg_use use)
{
    ((struct rg_use *)(uintptr_t)row->uses)[i] = use;
}

/* Adds a row that draws an image of floats: a colour, plus the texels of an earlier image. */
static void draw(struct graph *g)
{
    const uint32_t index = g->row_count;
    struct rg_pass *row = new_row(g, RG_RASTER, painted_record);
    const bool fetches = g->color_count && below(g, 4);
    if (fetches)
        use(row, 0, (struct rg_use)PAINTED_SOURCE(g->colors[recent(g, g->color_count)]));
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

/* Adds a row that writes a buffer of integers to a new image. */
static void store(struct graph *g, uint32_t buffer)
{
    struct rg_pass *row = new_row(g, RG_COMPUTE, record_groups);
    row->comp = &copy_comp;
    use(row, 0,
        (struct rg_use){
            .buffer = &g->buffers[buffer], .access = RG_STORAGE_READ, .binding = DATA_NUMBERS });
    use(row, 1,
        (struct rg_use){
            .image = new_image(g, false), .access = RG_STORAGE_WRITE, .binding = DATA_TEXELS });
}

/* Adds a row that adds an image's numbers to a buffer. */
static void add(struct graph *g)
{
    struct rg_pass *row = new_row(g, RG_COMPUTE, record_groups);
    row->comp = &add_comp;
    use(row, 0,
        (struct rg_use){ .buffer = &g->buffers[recent(g, g->buffer_count)],
                         .access = RG_STORAGE_READ_WRITE,
                         .binding = DATA_NUMBERS });
    use(row, 1,
        (struct rg_use){ .image = &g->integers[recent(g, g->integer_count)],
                         .access = RG_STORAGE_READ,
                         .binding = DATA_TEXELS });
}

/* Adds a row that copies an image to a buffer. */
static void copy(struct graph *g, const struct rg_image *image, const struct rg_buffer *buffer)
{
    struct rg_pass *row = new_row(g, RG_TRANSFER, run_record_read);
    use(row, 0, (struct rg_use){ .image = image, .access = RG_COPY_SRC });
    use(row, 1, (struct rg_use){ .buffer = buffer, .access = RG_COPY_DST });
}

static void make(struct graph *g, uint32_t seed)
{
    *g = (struct graph){ .state = seed };
    while (g->row_count < ROWS) {
        const uint32_t choice = below(g, 6);
        if (choice < 2)
            draw(g);
        else if (choice == 2 || !g->buffer_count)
            use(new_row(g, RG_TRANSFER, record_fill), 0,
                (struct rg_use){ .buffer = new_buffer(g), .access = RG_COPY_DST });
        else if (choice == 3 || !g->integer_count)
            store(g, recent(g, g->buffer_count));
        else if (choice == 4)
            add(g);
        else
            copy(g, &g->integers[recent(g, g->integer_count)], new_buffer(g));
    }
    for (uint32_t i = 0; i < OUTPUTS; i++) {
        g->outputs[i] = (struct rg_buffer){ .name = new_name(g),
                                            .size_per_texel = i < 2 ? 16 : 4,
                                            .memory = RG_MEMORY_READBACK };
        if (i < 2)
            draw(g);
        else
            store(g, recent(g, g->buffer_count));
        copy(g, i < 2 ? &g->colors[g->color_count - 1] : &g->integers[g->integer_count - 1],
             &g->outputs[i]);
    }
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
    };
    const struct rg_frame frame = { .rows = g->rows, .paints = g->paints };
    struct run run;
    for (uint32_t i = 0; i < OUTPUTS; i++)
        params.outputs[i] = &g->outputs[i];
    run_open(&run, gpu, &params);
    for (uint32_t i = 0; i < FRAMES; i++) {
        assert_int_equal(rg_exec_begin(run.exec, &run.slot), VK_SUCCESS);
        assert_int_equal(rg_exec_submit(run.exec, &frame), VK_SUCCESS);
    }
    assert_int_equal(rg_exec_wait_all(run.exec), VK_SUCCESS);
    for (uint32_t i = 0; i < OUTPUTS; i++) {
        const size_t size = (size_t)SIDE * SIDE * g->outputs[i].size_per_texel;
        if (compares)
            assert_memory_equal(expected, run_data(&run, &g->outputs[i]), size);
        else
            memcpy(expected, run_data(&run, &g->outputs[i]), size);
        expected += size;
    }
    assert_true(!queues == !run.plan->submission_count);
    const VkDeviceSize saved = run.plan->memory_without_aliasing - run.plan->memory_used;
    run_close(&run);
    return saved;
}

static void results_do_not_depend_on_memory_or_queues(void **state)
{
    const VkFlags all = 1 << RG_QUEUE_COMPUTE | 1 << RG_QUEUE_TRANSFER;
    unsigned char *expected = malloc((size_t)SIDE * SIDE * 16 * OUTPUTS);
    struct graph *g = malloc(sizeof(*g));
    VkDeviceSize saved = 0;
    assert_true(expected && g);
    for (uint32_t seed = 1; seed <= SEEDS; seed++) {
        make(g, seed);
        run_graph(*state, g, RG_SHARE_NOTHING, 0, expected, false);
        saved += run_graph(*state, g, RG_SHARE_FEWEST_BATCHES, 0, expected, true);
        run_graph(*state, g, RG_SHARE_FEWEST_BATCHES, all, expected, true);
    }
    assert_true(saved >= (VkDeviceSize)SEEDS * SIDE * SIDE * 4);
    free(g);
    free(expected);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_DEVICE(results_do_not_depend_on_memory_or_queues),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
