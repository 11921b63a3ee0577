/* test_exec_data.c: compute and transfer passes, buffers, imports and frames in flight. */
#include <math.h>

#include "tests/support/check.h"

#include "tests/gpu/shaders/data.h"
#include "tests/support/lavapipe.h"
#include "tests/support/painted.h"

enum {
    SIZE = 8,
    TEXELS = SIZE * SIZE,
};

/* ---- storage, sampled afterwards, copied ---- */

static const struct rg_image numbers = { .name = "numbers", .format = VK_FORMAT_R32_UINT };
static const struct rg_image next = { .name = "next", .format = VK_FORMAT_R32_UINT };
static const struct rg_buffer list = { .name = "list", .size_per_texel = sizeof(uint32_t) };

static const struct rg_buffer seed = {
    .name = "seed",
    .size = sizeof(struct data_seed),
    .memory = RG_MEMORY_UPLOAD,
};

/* parameters of vkCmdDispatchIndirect() */
static const struct rg_buffer groups = {
    .name = "groups",
    .size = sizeof(VkDispatchIndirectCommand),
    .memory = RG_MEMORY_UPLOAD,
};

#define NUMBER_BUFFER(title) \
    { \
        .name = (title), .size_per_texel = sizeof(uint32_t), .memory = RG_MEMORY_READBACK \
    }
static const struct rg_buffer numbers_out = NUMBER_BUFFER("numbers out");
static const struct rg_buffer next_out = NUMBER_BUFFER("next out");
static const struct rg_buffer list_out = NUMBER_BUFFER("list out");

static void record_all_texels(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    rg_cmd_dispatch(cmd, SIZE / DATA_GROUP, SIZE / DATA_GROUP, 1);
}

static void record_indirect(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    vkCmdDispatchIndirect(rg_cmd_vulkan(cmd), rg_cmd_buffer(cmd, &groups), 0);
}

static void record_triangles(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    painted_draw(cmd, &(struct paint_push){ ALL });
}

static void record_copy_list(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    const VkBufferCopy region = { .size = TEXELS * sizeof(uint32_t) };
    vkCmdCopyBuffer(rg_cmd_vulkan(cmd), rg_cmd_buffer(cmd, &list), rg_cmd_buffer(cmd, &list_out), 1,
                    &region);
}

#define SEED \
    { \
        .buffer = &seed, .access = RG_UNIFORM, .binding = DATA_SEED \
    }

static const struct rg_pass number_rows[] = {
    {
        .name = "fill",
        .kind = RG_COMPUTE,
        .uses =
            RG_USES(SEED, { .image = &numbers, .access = RG_STORAGE_WRITE, .binding = DATA_TEXELS },
                    { .buffer = &list, .access = RG_STORAGE_WRITE, .binding = DATA_NUMBERS }),
        .comp = &fill_comp,
        .record = record_all_texels,
    },
    {
        .name = "add",
        .kind = RG_COMPUTE,
        .uses =
            RG_USES({ .image = &numbers, .access = RG_STORAGE_READ, .binding = DATA_TEXELS },
                    { .buffer = &list, .access = RG_STORAGE_READ_WRITE, .binding = DATA_NUMBERS },
                    { .buffer = &groups, .access = RG_INDIRECT }),
        .comp = &add_comp,
        .record = record_indirect,
    },
    {
        .name = "next",
        .color[0] = { &next, RG_LOAD_DISCARD },
        .uses = RG_USES(SEED, { .image = &numbers, .access = RG_SAMPLED, .binding = DATA_TEXELS }),
        PAINTED_BY(record_triangles, &next_frag),
    },
    RUN_READ("read numbers", numbers, numbers_out),
    RUN_READ("read next", next, next_out),
    {
        .name = "copy list",
        .kind = RG_TRANSFER,
        .uses = RG_USES({ .buffer = &list, .access = RG_COPY_SRC },
                        { .buffer = &list_out, .access = RG_COPY_DST }),
        .record = record_copy_list,
    },
};

static const struct run_params number_params = {
    .technique = RG_TECHNIQUE("test", number_rows),
    .outputs = { &numbers_out, &next_out, &list_out },
};

/* What the frame of the slot is to start from. */
static void write_numbers(struct run *run, uint32_t value)
{
    *(struct data_seed *)run_data(run, &seed) = (struct data_seed){ value };
    *(VkDispatchIndirectCommand *)run_data(run, &groups) =
        (VkDispatchIndirectCommand){ SIZE / DATA_GROUP, SIZE / DATA_GROUP, 1 };
}

static void check_numbers(struct run *run, uint32_t value)
{
    const uint32_t *number = run_data(run, &numbers_out);
    const uint32_t *after = run_data(run, &next_out);
    const uint32_t *added = run_data(run, &list_out);
    for (uint32_t i = 0; i < TEXELS; i++) {
        assert_int_equal(number[i], value + i);
        assert_int_equal(after[i], value + i + value);
        assert_int_equal(added[i], 4 * (value + i));
    }
}

static void storage_is_read_back(void **state)
{
    for (unsigned way = 0; way < 4; way++) {
        struct run_params params = number_params;
        struct run run;
        params.render_passes = way & 1;
        params.sharing = way & 2 ? RG_SHARE_NOTHING : RG_SHARE_LEAST_MEMORY;
        run_open(&run, *state, &params);
        assert_int_equal(rg_exec_begin(run.exec, &run.slot), VK_SUCCESS);
        write_numbers(&run, 1000);
        assert_int_equal(rg_exec_submit(run.exec, NULL), VK_SUCCESS);
        assert_int_equal(rg_exec_wait(run.exec, run.slot), VK_SUCCESS);
        check_numbers(&run, 1000);
        run_close(&run);
    }
}

/* Frames go out without a wait but for their own slot; each has its own numbers. */
static void check_in_flight(struct gpu *gpu, uint32_t slots, bool render_passes)
{
    enum {
        FRAMES = 7
    };
    struct run_params params = number_params;
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
        write_numbers(&run, 1000 * frame);
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

static const struct rg_image up = COLOR_IMAGE("up", .width = 4, .height = 4, .mips = 2);
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
        .srcSubresource = { VK_IMAGE_ASPECT_COLOR_BIT, 1, 0, 1 },
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

/* The second row names one image twice, as source and as destination. */
static const struct rg_pass transfer_rows[] = {
    {
        .name = "up",
        .kind = RG_TRANSFER,
        .uses = RG_USES({ .buffer = &up_in, .access = RG_COPY_SRC },
                        { .image = &up, .access = RG_COPY_DST, .range.mip_count = 1 }),
        .record = record_up,
    },
    {
        .name = "both",
        .kind = RG_TRANSFER,
        .uses = RG_USES({ .buffer = &up_in, .access = RG_COPY_SRC },
                        { .image = &up, .access = RG_COPY_SRC, .range.mip_count = 1 },
                        { .image = &up, .access = RG_COPY_DST, .range.mip = 1 },
                        { .buffer = &down_out, .access = RG_COPY_DST }),
        .record = record_both,
    },
    {
        .name = "across",
        .kind = RG_TRANSFER,
        .uses = RG_USES({ .image = &up, .access = RG_COPY_SRC, .range.mip = 1 },
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
    { .name = "paint", .color[0] = { &kept, RG_LOAD_DISCARD }, PAINTED },
};

/* Adds to what has come, and hands it back. */
static const struct rg_pass take_rows[] = {
    { .name = "add", .color[0] = { &kept, RG_LOAD_KEEP, .blend = RG_BLEND_ADD }, PAINTED },
    {
        .name = "take",
        .color[0] = { &taken, RG_LOAD_DISCARD },
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
    run_open(&keep, *state,
             &(struct run_params){ .technique = RG_TECHNIQUE("keep", keep_rows), .kept = ready });
    const struct rg_exec_import object = { .image = rg_exec_image(keep.exec, &kept) };
    run_open(&take, *state,
             &(struct run_params){
                 .technique = RG_TECHNIQUE("take", take_rows),
                 .outputs = { &taken_out },
                 .kept = ready,
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_DEVICE(storage_is_read_back),          ON_DEVICE(frames_in_flight),
        ON_DEVICE(texels_go_up_and_down),         ON_DEVICE(imports_come_as_they_are),
        ON_DEVICE(images_pass_between_executors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
