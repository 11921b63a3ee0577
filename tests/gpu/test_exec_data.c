/* test_exec_data.c: compute and transfer passes, buffers, imports and frames in flight. */
#include <math.h>

#include "tests/support/assertions.h"

#include "tests/support/feature_graphs.h"
#include "tests/support/lavapipe.h"

enum {
    TEXELS = FEATURE_TEXELS,
};

/* ---- storage ---- */

static void write_seed(struct run *run, uint32_t value)
{
    *(struct data_seed *)run_data(run, &feature_seed) = (struct data_seed){ value };
}

static void check_numbers(struct run *run, uint32_t value)
{
    const struct rg_buffer *const *outputs = run->params.outputs;
    const uint32_t *number = run_data(run, outputs[STORAGE_NUMBERS_OUT]);
    const uint32_t *after = run_data(run, outputs[STORAGE_NEXT_OUT]);
    const uint32_t *added = run_data(run, outputs[STORAGE_LIST_OUT]);
    for (uint32_t i = 0; i < TEXELS; i++) {
        assert_int_equal(number[i], value + i);
        assert_int_equal(after[i], value + i + value);
        assert_int_equal(added[i], 4 * (value + i));
    }
}

static void storage_is_read_back(void **state)
{
    for (unsigned way = 0; way < RUN_VARIANT_COUNT; way++) {
        const struct run_params params = run_variant(&feature_storage.params, way);
        struct run run;
        run_open(&run, *state, &params);
        assert_int_equal(rg_exec_begin(run.exec, &run.slot), VK_SUCCESS);
        write_seed(&run, 1000);
        assert_int_equal(rg_exec_submit(run.exec, NULL), VK_SUCCESS);
        assert_int_equal(rg_exec_wait(run.exec, run.slot), VK_SUCCESS);
        check_numbers(&run, 1000);
        run_close(&run);
    }
}

static void buffer_is_sampled(void **state)
{
    for (unsigned way = 0; way < RUN_VARIANT_COUNT; way++) {
        const struct run_params params = run_variant(&feature_texels.params, way);
        struct run run;
        run_open(&run, *state, &params);
        for (uint32_t frame = 0; frame < 3; frame++) {
            assert_int_equal(rg_exec_begin(run.exec, &run.slot), VK_SUCCESS);
            write_seed(&run, 500 + frame);
            assert_int_equal(rg_exec_submit(run.exec, NULL), VK_SUCCESS);
            assert_int_equal(rg_exec_wait(run.exec, run.slot), VK_SUCCESS);
            const uint32_t *number = run_data(&run, run.params.outputs[0]);
            for (uint32_t i = 0; i < TEXELS; i++)
                assert_int_equal(number[i], 6 * (500 + frame + TEXELS - 1 - i));
        }
        run_close(&run);
    }
}

/* Frames go out without a wait but for their own slot; each has its own numbers. */
static void check_in_flight(struct gpu *gpu, uint32_t slots, bool render_passes)
{
    enum {
        FRAMES = 7
    };
    struct run_params params = feature_storage.params;
    struct run run;
    params.frames_in_flight = slots;
    params.render_passes = render_passes;
    run_open(&run, gpu, &params);
    for (uint32_t frame = 0; frame < FRAMES + slots; frame++) {
        run.slot = frame % slots;
        if (frame >= FRAMES)
            assert_int_equal(rg_exec_wait(run.exec, run.slot), VK_SUCCESS);
        else
            assert_int_equal(rg_exec_begin(run.exec, &run.slot), VK_SUCCESS);
        assert_int_equal(run.slot, frame % slots);
        if (frame >= slots)
            check_numbers(&run, 1000 * (frame - slots));
        if (frame >= FRAMES)
            continue;
        write_seed(&run, 1000 * frame);
        assert_int_equal(rg_exec_submit(run.exec, NULL), VK_SUCCESS);
    }
    run_close(&run);
}

static void frames_in_flight(void **state)
{
    for (uint32_t slots = 1; slots <= 3; slots++) {
        check_in_flight(*state, slots, false);
        check_in_flight(*state, slots, true);
    }
}

/* ---- transfer ---- */

static const struct rg_image up =
    COLOR_IMAGE("up", .width = 4, .height = 4, .mips = 2, .layers = 2);
static const struct rg_image across = COLOR_IMAGE("across", .width = 2, .height = 2);

enum {
    UP_0 = 3, /* texels before mip 0 in the upload buffer, and so on */
    UP_1 = UP_0 + 16,
    DOWN_0 = 5,
    DOWN_1 = DOWN_0 + 16,
    UP_COUNT = UP_1 + 4,
    DOWN_COUNT = DOWN_1 + 4,
};

static const struct rg_buffer up_in = {
    .name = "up in",
    .size = UP_COUNT * sizeof(vec4s),
    .memory = RG_MEMORY_UPLOAD,
};
static const struct rg_buffer down_out = {
    .name = "down out",
    .size = DOWN_COUNT * sizeof(vec4s),
    .memory = RG_MEMORY_READBACK,
};

static void record_up(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    rg_cmd_copy_buffer_to_image(cmd, &up_in, UP_0 * sizeof(vec4s), &up);
}

static void record_both(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    rg_cmd_copy_buffer_to_image(cmd, &up_in, UP_1 * sizeof(vec4s), &up);
    rg_cmd_copy_image_to_buffer(cmd, &up, &down_out, DOWN_0 * sizeof(vec4s));
}

static void record_across(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    const VkImageCopy region = {
        .srcSubresource = { VK_IMAGE_ASPECT_COLOR_BIT, 1, 1, 1 },
        .dstSubresource = { VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1 },
        .extent = { 2, 2, 1 },
    };
    vkCmdCopyImage(rg_cmd_vulkan(cmd), rg_cmd_image(cmd, &up), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                   rg_cmd_image(cmd, &across), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
}

static void record_down(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    rg_cmd_copy_image_to_buffer(cmd, &across, &down_out, DOWN_1 * sizeof(vec4s));
}

/* Of layer 1. The second row names one image twice, as source and as destination. */
static const struct rg_pass transfer_rows[] = {
    {
        .name = "up",
        .kind = RG_TRANSFER,
        .uses = RG_USES({ .buffer = &up_in, .access = RG_COPY_SRC },
                        { .image = &up, .access = RG_COPY_DST, .range = { 0, 0, 1, 1, 1 } }),
        .record = record_up,
    },
    {
        .name = "both",
        .kind = RG_TRANSFER,
        .uses = RG_USES({ .buffer = &up_in, .access = RG_COPY_SRC },
                        { .image = &up, .access = RG_COPY_SRC, .range = { 0, 0, 1, 1, 1 } },
                        { .image = &up, .access = RG_COPY_DST, .range = { 0, 1, 1, 1, 1 } },
                        { .buffer = &down_out, .access = RG_COPY_DST }),
        .record = record_both,
    },
    {
        .name = "across",
        .kind = RG_TRANSFER,
        .uses = RG_USES({ .image = &up, .access = RG_COPY_SRC, .range = { 0, 1, 1, 1, 1 } },
                        { .image = &across, .access = RG_COPY_DST }),
        .record = record_across,
    },
    {
        .name = "down",
        .kind = RG_TRANSFER,
        .uses = RG_USES({ .image = &across, .access = RG_COPY_SRC },
                        { .buffer = &down_out, .access = RG_COPY_DST, .partial = true }),
        .record = record_down,
    },
};

static void texels_go_up_and_down(void **state)
{
    const struct run_params params = {
        .technique = RG_TECHNIQUE("test", transfer_rows),
        .outputs = { &down_out },
    };
    struct run run;
    run_open(&run, *state, &params);
    assert_int_equal(rg_exec_begin(run.exec, &run.slot), VK_SUCCESS);
    vec4s *texels = run_data(&run, &up_in);
    for (int i = 0; i < UP_COUNT; i++)
        texels[i] = painted_color((float)i, (float)(i * i), -(float)i, 1);
    assert_int_equal(rg_exec_submit(run.exec, NULL), VK_SUCCESS);
    assert_int_equal(rg_exec_wait(run.exec, run.slot), VK_SUCCESS);
    const vec4s *back = run_data(&run, &down_out);
    assert_memory_equal(back + DOWN_0, texels + UP_0, 16 * sizeof(vec4s));
    assert_memory_equal(back + DOWN_1, texels + UP_1, 4 * sizeof(vec4s));
    run_close(&run);
}

/* ---- imports ---- */

/* Declared otherwise than it comes. */
static const struct rg_image texture =
    COLOR_IMAGE("texture", .width = 1, .height = 1, .array = true);
static const struct rg_buffer words = { .name = "words", .size = 4 };
static const struct rg_buffer words_out = {
    .name = "words out",
    .size = 256,
    .memory = RG_MEMORY_READBACK,
};

enum {
    LAYERS = 3,
    MIPS = 3,
};

static const struct rg_buffer levels_out = {
    .name = "levels out",
    .size = sizeof(vec4s) * LAYERS * MIPS,
    .memory = RG_MEMORY_READBACK,
};

static void record_levels(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    rg_cmd_dispatch(cmd, MIPS, LAYERS, 1);
}

static void record_words(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    vkCmdCopyBuffer(rg_cmd_vulkan(cmd), rg_cmd_buffer(cmd, &words), rg_cmd_buffer(cmd, &words_out),
                    1, &(VkBufferCopy){ .size = 256 });
}

static const struct rg_pass import_rows[] = {
    {
        .name = "levels",
        .kind = RG_COMPUTE,
        .uses =
            RG_USES({ .image = &texture, .access = RG_SAMPLED, .binding = DATA_IMAGE },
                    { .buffer = &levels_out, .access = RG_STORAGE_WRITE, .binding = DATA_COLORS }),
        .comp = &levels_comp,
        .record = record_levels,
    },
    {
        .name = "words",
        .kind = RG_TRANSFER,
        .uses = RG_USES({ .buffer = &words, .access = RG_COPY_SRC },
                        { .buffer = &words_out, .access = RG_COPY_DST }),
        .record = record_words,
    },
};

static const struct rg_import imports[] = {
    { .image = &texture, .access = RG_SAMPLED, .extent = { 4, 4 }, .layers = LAYERS, .mips = MIPS },
    { .buffer = &words, .access = RG_COPY_SRC, .size = 256 },
};

/* Of layers that slope each another way; the blits that make mips round a little. */
static void check_levels(struct run *run)
{
    const vec4s *levels = run_data(run, &levels_out);
    for (int layer = 0; layer < LAYERS; layer++) {
        for (int mip = 0; mip < MIPS; mip++) {
            const vec4s *level = &levels[layer * MIPS + mip];
            const double mean = ((1 << mip) - 1) * 0.5;
            CHECK_NEAR(level->x, 100 * layer + mean * (layer + 1), 1e-3);
            CHECK_NEAR(level->y, mean, 1e-3);
        }
    }
}

static void imports_come_as_they_are(void **state)
{
    struct gpu *gpu = *state;
    struct gpu_image image;
    struct gpu_buffer buffer;
    vec4s texels[LAYERS][4][4];
    unsigned char bytes[256];
    for (int i = 0; i < LAYERS * 16; i++) {
        const int layer = i / 16;
        texels[layer][i / 4 % 4][i % 4] =
            painted_color((float)(100 * layer + i % 4 * (layer + 1)), (float)(i / 4 % 4), 0, 0);
    }
    for (int i = 0; i < 256; i++)
        bytes[i] = (unsigned char)(i * 7);
    const struct gpu_image_params image_params = {
        .name = "texture",
        .format = VK_FORMAT_R32G32B32A32_SFLOAT,
        .width = 4,
        .height = 4,
        .layers = LAYERS,
        .mipmaps = true,
        .texels = texels,
        .texels_size = sizeof(texels),
    };
    assert_int_equal(gpu_image_create(gpu, &image, &image_params), STATUS_OK);
    assert_int_equal(
        gpu_buffer_create(gpu, &buffer, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, bytes, 256, "words"),
        STATUS_OK);
    const struct rg_exec_import objects[] = {
        { .image = image.image },
        { .buffer = buffer.buffer },
    };
    const struct run_params params = {
        .technique = RG_TECHNIQUE("test", import_rows),
        .outputs = { &levels_out, &words_out },
        .imports = imports,
        .objects = objects,
        .import_count = 2,
    };
    struct run run;
    run_open(&run, gpu, &params);
    for (int frame = 0; frame < 3; frame++) {
        run_frame(&run, NULL);
        check_levels(&run);
        assert_memory_equal(run_data(&run, &words_out), bytes, 256);
    }
    run_close(&run);
    gpu_image_destroy(gpu, &image);
    gpu_buffer_destroy(gpu, &buffer);
}

/* ---- what one executor leaves, another one takes ---- */

static const struct rg_image kept = COLOR_IMAGE("kept");
static const struct rg_image taken = COLOR_IMAGE("taken");
static const struct rg_buffer taken_out = COLOR_BUFFER("taken out");

static const struct rg_pass keep_rows[] = {
    { .name = "paint", .color = RG_TARGETS({ &kept, RG_LOAD_DISCARD }), PAINTED },
};

/* Adds to what has come, and hands it back. */
static const struct rg_pass take_rows[] = {
    { .name = "add", .color = RG_TARGETS({ &kept, RG_LOAD_KEEP, .blend = RG_BLEND_ADD }), PAINTED },
    {
        .name = "take",
        .color = RG_TARGETS({ &taken, RG_LOAD_DISCARD }),
        .uses = RG_USES({ .image = &kept, .access = RG_SAMPLED, .binding = PAINT_SOURCE }),
        PAINTED_BY(painted_record, &fetch_frag),
    },
    RUN_READ("read", taken, taken_out),
};

static void images_pass_between_executors(void **state)
{
    static const struct rg_import import = { .image = &kept, .access = RG_SAMPLED };
    static const struct paint_push paints[] = {
        { .color = { { 1, 2, 3, 4 } }, ALL },
        { .color = { { 100, 0, 0, 0 } }, ALL },
    };
    const struct rg_output ready = { .image = &kept, .access = RG_SAMPLED };
    struct run keep;
    struct run take;
    run_open(
        &keep, *state,
        &(struct run_params){ .technique = RG_TECHNIQUE("keep", keep_rows), .kept = { ready } });
    const struct rg_exec_import object = { .image = rg_exec_image(keep.exec, &kept) };
    run_open(&take, *state,
             &(struct run_params){
                 .technique = RG_TECHNIQUE("take", take_rows),
                 .outputs = { &taken_out },
                 .kept = { ready },
                 .imports = &import,
                 .objects = &object,
                 .import_count = 1,
             });
    for (uint32_t frame = 0; frame < 5; frame++) {
        /* the first executor runs again before the fourth frame, unwaited for */
        const struct rg_frame first = { .rows = keep_rows, .paints = paints };
        const struct rg_frame second = { .rows = take_rows, .paints = paints };
        if (frame % 3 == 0) {
            assert_int_equal(rg_exec_begin(keep.exec, &keep.slot), VK_SUCCESS);
            assert_int_equal(rg_exec_submit(keep.exec, &first), VK_SUCCESS);
        }
        run_frame(&take, &second);
        const float sum = (float)(frame % 3 + 1);
        painted_check_all(&take, &taken_out, TEXELS,
                          painted_color(1 + sum + 100, 2 + 2 * sum, 3 + 3 * sum, 4 + 4 * sum));
    }
    run_close(&take);
    run_close(&keep);
}

/* ---- and so do images and buffers that a graph adds to ---- */

#define IMPORTS_PAINTS(value) \
    { \
        [IMPORTS_ADD] = { .color = { { (value), 1, 0, 0 } }, LEFT_HALF }, \
        [IMPORTS_LOOK] = { ALL }, \
    }

static void begin_imports(struct run *run, uint32_t number, struct rg_frame *frame)
{
    static const struct paint_push paints[][IMPORTS_PAINT_COUNT] = {
        IMPORTS_PAINTS(1), IMPORTS_PAINTS(2), IMPORTS_PAINTS(3),
        IMPORTS_PAINTS(4), IMPORTS_PAINTS(5),
    };
    frame->paints = paints[number];
    write_seed(run, 100 * (number + 1));
}

/* They came with 50 in every channel, and a thousand times its index in every number. */
static void check_imports(struct run *run, uint32_t number)
{
    const struct rg_buffer *const *outputs = run->params.outputs;
    const uint32_t *totals = run_data(run, outputs[IMPORTS_TOTALS_OUT]);
    const uint32_t frames = number + 1;
    const uint32_t sum = frames * (frames + 1) / 2;
    for (uint32_t i = 0; i < TEXELS; i++) {
        painted_check(run, outputs[IMPORTS_SEEN_OUT], i,
                      i % 8 < 4 ? painted_color(50.0F + (float)sum, 50.0F + (float)frames, 50, 50)
                                : painted_color(50, 50, 50, 50));
        assert_int_equal(totals[i], 1000 * i + 100 * sum + frames * i);
    }
}

static void imports_are_added_to(void **state)
{
    static const struct painted_series series = { 5, begin_imports, check_imports };
    for (unsigned way = 0; way < RUN_VARIANT_COUNT; way++) {
        struct gpu *gpu = *state;
        struct gpu_image image;
        struct gpu_buffer buffer;
        vec4s texels[TEXELS];
        uint32_t numbers[TEXELS];
        for (uint32_t i = 0; i < TEXELS; i++) {
            texels[i] = painted_color(50, 50, 50, 50);
            numbers[i] = 1000 * i;
        }
        const struct gpu_image_params image_params = {
            .name = "picture",
            .format = VK_FORMAT_R32G32B32A32_SFLOAT,
            .width = FEATURE_SIZE,
            .height = FEATURE_SIZE,
            .texels = texels,
            .texels_size = sizeof(texels),
            .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT,
        };
        assert_int_equal(gpu_image_create(gpu, &image, &image_params), STATUS_OK);
        assert_int_equal(
            gpu_buffer_create(gpu, &buffer,
                              VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                              numbers, sizeof(numbers), "totals"),
            STATUS_OK);
        const struct rg_exec_import objects[] = {
            { .image = image.image },
            { .buffer = buffer.buffer },
        };
        struct run_params params = run_variant(&feature_imports.params, way);
        params.objects = objects;
        painted_series(gpu, &params, &series);
        gpu_image_destroy(gpu, &image);
        gpu_buffer_destroy(gpu, &buffer);
    }
}

/* ---- indirect ---- */

static struct rg_mesh indirect_mesh;

static void begin_indirect(struct run *run, uint32_t number, struct rg_frame *frame)
{
    frame->mesh = indirect_mesh;
    write_seed(run, number);
}

/* The triangles are the halves of the view below and above a diagonal. */
static void check_indirect(struct run *run, uint32_t number)
{
    const struct rg_buffer *const *outputs = run->params.outputs;
    const uint32_t *numbers = run_data(run, outputs[INDIRECT_NUMBERS_OUT]);
    for (uint32_t i = 0; i < TEXELS; i++) {
        const uint32_t x = i % FEATURE_SIZE;
        const uint32_t y = i / FEATURE_SIZE;
        const float drawn = number > (x > y) ? 1 : 0;
        assert_int_equal(numbers[i], number + i);
        if (x == y)
            continue;
        painted_check(run, outputs[INDIRECT_DRAWN_OUT], i,
                      painted_color(drawn, drawn, drawn, drawn));
        painted_check(run, outputs[INDIRECT_MESH_OUT], i,
                      painted_color(drawn, drawn, drawn, drawn));
    }
}

/* As many triangles as the number of the frame. */
static void commands_come_from_shaders(void **state)
{
    static const struct painted_series series = { 3, begin_indirect, check_indirect };
    static const vec2s vertices[] = { { { -1, -1 } }, { { -1, 1 } }, { { 1, 1 } }, { { 1, -1 } } };
    static const uint32_t indices[] = { 0, 1, 2, 0, 2, 3 };
    struct gpu *gpu = *state;
    struct gpu_buffer vertex_buffer;
    struct gpu_buffer index_buffer;
    assert_int_equal(gpu_buffer_create(gpu, &vertex_buffer, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT,
                                       vertices, sizeof(vertices), "vertices"),
                     STATUS_OK);
    assert_int_equal(gpu_buffer_create(gpu, &index_buffer, VK_BUFFER_USAGE_INDEX_BUFFER_BIT,
                                       indices, sizeof(indices), "indices"),
                     STATUS_OK);
    indirect_mesh = (struct rg_mesh){ vertex_buffer.buffer, index_buffer.buffer, 0 };
    painted_series_variants(gpu, &feature_indirect.params, &series);
    gpu_buffer_destroy(gpu, &vertex_buffer);
    gpu_buffer_destroy(gpu, &index_buffer);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_DEVICE(buffer_is_sampled),        ON_DEVICE(storage_is_read_back),
        ON_DEVICE(frames_in_flight),         ON_DEVICE(texels_go_up_and_down),
        ON_DEVICE(imports_come_as_they_are), ON_DEVICE(images_pass_between_executors),
        ON_DEVICE(imports_are_added_to),     ON_DEVICE(commands_come_from_shaders),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
