/*
 * test_exec_mistakes.c: what a programmer gets wrong in tables, imports and record functions. Each
 * mistake is a fault of the compiler, or an error that the executor logs with the names of pass and
 * resource; the next frame is drawn as if nothing had happened.
 *
 * Nobody but a device or its validation layer can know: a wrong layout in the program's own Vulkan
 * commands, too few workgroups, an upload written after the submit. Legal, if seldom meant: history
 * read after its write, a stride that is less than the end of an attribute.
 */
#include <string.h>

#include "tests/support/assertions.h"

#include "tests/gpu/shaders/data.h"
#include "tests/gpu/shaders/paint.h"
#include "tests/gpu/test_shaders.h"
#include "tests/support/lavapipe.h"
#include "tests/support/run_graph.h"

#define RGBA VK_FORMAT_R8G8B8A8_UNORM

static const struct rg_image picture = { .name = "picture", .format = RGBA };
static const struct rg_image other = { .name = "other", .format = RGBA };
static const struct rg_image slices = { .name = "slices", .format = RGBA, .layers = 2 };
static const struct rg_image shade = { .name = "shade", .format = VK_FORMAT_D32_SFLOAT };
static const struct rg_image texels = { .name = "texels", .format = VK_FORMAT_R32_UINT };
static const struct rg_image floats = { .name = "floats", .format = VK_FORMAT_R32_SFLOAT };
static const struct rg_buffer seed = { "seed", 4, .memory = RG_MEMORY_UPLOAD };
static const struct rg_buffer numbers = { "numbers", 256 };
static const struct rg_buffer commands = { "commands", 64, .memory = RG_MEMORY_UPLOAD };
static const struct rg_buffer pixels = { .name = "pixels",
                                         .size_per_texel = 4,
                                         .memory = RG_MEMORY_READBACK };
static const struct rg_buffer marks = { "marks", 8, .memory = RG_MEMORY_READBACK };
static const struct rg_sampler shadow = { .compare = VK_COMPARE_OP_LESS };

static const VkVertexInputAttributeDescription position = { 2, 0, VK_FORMAT_R32G32_SFLOAT, 0 };
static const struct rg_vertex_layout vertices = { 8, 1, &position };

/* ---- mistakes in tables ---- */

static void record_nothing(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)cmd;
    (void)frame;
}

#define SEED \
    { \
        .buffer = &seed, .access = RG_UNIFORM, .binding = DATA_SEED \
    }
#define NUMBERS \
    { \
        .buffer = &numbers, .access = RG_STORAGE_WRITE, .binding = DATA_NUMBERS \
    }
#define TEXELS \
    { \
        .image = &texels, .access = RG_STORAGE_WRITE, .binding = DATA_TEXELS \
    }
#define FETCH(from) \
    { \
        .image = &(from), .access = RG_SAMPLED, .binding = PAINT_SOURCE \
    }
#define CLEAR(to) \
    { \
        .name = "clear", .kind = RG_TRANSFER, .record = record_nothing, \
        .uses = RG_USES({ .image = &(to), .access = RG_COPY_DST }) \
    }
#define COMPUTES(shader, ...) \
    { \
        .name = "work", .kind = RG_COMPUTE, .comp = &(shader), .record = record_nothing, \
        .uses = RG_USES(__VA_ARGS__) \
    }
#define DRAWS(to, load_, ...) \
    { \
        .name = "work", .color = RG_TARGETS({ &(to), load_ }), .vert = &paint_vert, \
        .frag = &fetch_frag, .push_size = sizeof(struct paint_push), .record = record_nothing, \
        .uses = RG_USES(__VA_ARGS__) \
    }

static const struct table_mistake {
    const char *text;
    struct rg_pass rows[2];
    struct rg_output output; /* by default texels */
} table_mistakes[] = {
    { "(work): Seed binding differs from that of the shader; binding 0 of 'fill_comp' is not",
      { COMPUTES(fill_comp, NUMBERS, TEXELS) } },
    { "(work): Numbers binding differs from that of the shader; binding 1 of 'fill_comp' is not in "
      "the row; no shader uses binding 7 ('numbers')",
      { COMPUTES(fill_comp, SEED, TEXELS,
                 { .buffer = &numbers, .access = RG_STORAGE_WRITE, .binding = 7 }) } },
    { "(work): texels binding differs from that of the shader; binding 2: format R32_UINT is not",
      { COMPUTES(fill_comp, SEED, NUMBERS,
                 { .image = &floats, .access = RG_STORAGE_WRITE, .binding = DATA_TEXELS }) } },
    /* the shader stores to what the row says that it reads, and counts in what it should store */
    { "(work): numbers access differs from that of the shader; binding 1: 'fill_comp' stores to "
      "'Numbers': expected RG_STORAGE_WRITE",
      { COMPUTES(fill_comp, SEED, TEXELS,
                 { .buffer = &numbers, .access = RG_STORAGE_READ, .binding = DATA_NUMBERS }) } },
    { "(work): numbers access differs from that of the shader; binding 1: 'add_comp' loads from "
      "'Numbers': expected RG_STORAGE_READ_WRITE",
      { CLEAR(texels),
        COMPUTES(add_comp, NUMBERS,
                 { .image = &texels, .access = RG_STORAGE_READ, .binding = DATA_TEXELS }) },
      { .buffer = &numbers, .access = RG_COPY_SRC } },
    { "(work): source binding differs from that of the shader; binding 3: 'slices' is a 2D array",
      { CLEAR(slices), DRAWS(picture, RG_LOAD_KEEP, FETCH(slices)) } },
    { "(work): source binding differs from that of the shader; binding 3: name the stage of "
      "'fetch_frag' in .stages of 'other'",
      { CLEAR(other), DRAWS(picture, RG_LOAD_DISCARD,
                            { .image = &other,
                              .access = RG_SAMPLED,
                              .binding = PAINT_SOURCE,
                              .stages = VK_SHADER_STAGE_VERTEX_BIT }) } },
    { "(work): source binding differs from that of the shader; binding 3: 'fetch_frag' does not "
      "compare depths: remove rg_sampler.compare of 'shade'",
      { CLEAR(shade), DRAWS(picture, RG_LOAD_DISCARD,
                            { .image = &shade,
                              .access = RG_SAMPLED,
                              .binding = PAINT_SOURCE,
                              .sampler = &shadow }) } },
    { "(work): shadow binding differs from that of the shader; binding 5: 'shadow_samplers_comp' "
      "compares depths: set rg_sampler.compare of 'shade'",
      { CLEAR(shade),
        COMPUTES(shadow_samplers_comp, TEXELS,
                 { .image = &shade, .access = RG_SAMPLED, .binding = DATA_SAMPLERS }) } },
    { "(work): picture has conflicting uses in one pass; 'color' and 'sampled at binding 3'",
      { CLEAR(picture), DRAWS(picture, RG_LOAD_KEEP, FETCH(picture)) } },
    { "(work): picture is read before anything writes it; clear it",
      { CLEAR(other), DRAWS(picture, RG_LOAD_KEEP, FETCH(other)) } },
    { "(work): position vertex attribute differs from that of the shader; location 2 of "
      "'paint_mesh_vert' is in no vertex layout",
      { { .name = "work",
          .depth = { &shade, RG_LOAD_CLEAR },
          .vert = &paint_mesh_vert,
          .record = record_nothing } } },
    { "numbers access does not fit; the CPU can only read RG_MEMORY_READBACK buffers",
      { COMPUTES(fill_comp, SEED, NUMBERS, TEXELS) },
      { .buffer = &numbers, .access = RG_HOST_READ } },
};

static void tables_have_faults(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof(table_mistakes) / sizeof(table_mistakes[0]); i++) {
        const struct table_mistake *m = &table_mistakes[i];
        const struct rg_technique technique = {
            .name = "mistake",
            .passes = m->rows,
            .pass_count = m->rows[1].name ? 2 : 1,
        };
        const struct rg_output texels_output = { .image = &texels, .access = RG_COPY_SRC };
        bool found = false;
        struct rg_plan *plan = rg_compile(&(struct rg_compile_params){
            .techniques = (const struct rg_technique *const[]){ &technique },
            .technique_count = 1,
            .view = { 8, 8 },
            .outputs = m->output.access ? &m->output : &texels_output,
            .output_count = 1,
        });
        assert_non_null(plan);
        for (uint32_t f = 0; f < plan->fault_count; f++) {
            char text[512];
            rg_fault_text(&plan->faults[f], text, sizeof(text));
            found = found || strstr(text, m->text);
        }
        if (!found)
            print_error("expected: %s\n", m->text);
        if (!found)
            rg_dump(plan, stderr);
        assert_true(found);
        rg_plan_destroy(plan);
    }
}

/* ---- mistakes in record functions ---- */

struct rg_frame {
    const struct frame_mistake *mistake; /* NULL: a good frame */
    struct rg_mesh mesh;
};

/* A wrong command of one row, in place of what the row records. */
struct frame_mistake {
    const char *row;
    rg_record_fn *record;
    const char *text;
};

/* Records the mistake if it is one of this row. */
static bool is_wrong(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    if (!frame->mistake || strcmp(frame->mistake->row, rg_cmd_pass(cmd)->name) != 0)
        return false;
    frame->mistake->record(cmd, frame);
    return true;
}

static void record_compute(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    if (!is_wrong(cmd, frame))
        rg_cmd_dispatch(cmd, 2, 2, 1);
}

static void record_draw(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    const struct paint_push push = { { { 1, 1, 1, 1 } }, { { -1, -1 } }, { { 1, 1 } }, 0 };
    if (is_wrong(cmd, frame))
        return;
    rg_cmd_push(cmd, &push, sizeof(push));
    rg_cmd_draw(cmd, 6);
}

static void record_mesh(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    if (!is_wrong(cmd, frame))
        rg_cmd_draw_mesh(cmd, &frame->mesh);
}

static void record_own(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)is_wrong(cmd, frame);
}

static void record_copy(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    if (!is_wrong(cmd, frame))
        rg_cmd_copy_image_to_buffer(cmd, &picture, &pixels, 0);
}

static void record_fill(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    rg_cmd_fill_buffer(cmd, &marks, 4, 4, 7);
}

static const struct rg_pass frame_rows[] = {
    { .name = "compute",
      .kind = RG_COMPUTE,
      .uses = RG_USES(SEED, NUMBERS, TEXELS, { .buffer = &commands, .access = RG_INDIRECT }),
      .comp = &fill_comp,
      .record = record_compute },
    { .name = "draw",
      .color = RG_TARGETS({ &picture, RG_LOAD_CLEAR }),
      .uses = RG_USES({ .buffer = &numbers, .access = RG_INDIRECT },
                      { .buffer = &commands, .access = RG_INDIRECT }),
      .vert = &paint_vert,
      .frag = &paint_frag,
      .push_size = sizeof(struct paint_push),
      .record = record_draw },
    { .name = "mesh",
      .depth = { &shade, RG_LOAD_CLEAR },
      .vert = &paint_mesh_vert,
      .vertices = &vertices,
      .record = record_mesh },
    { .name = "own", .depth = { &shade, RG_LOAD_KEEP }, .record = record_own },
    { .name = "copy",
      .kind = RG_TRANSFER,
      .uses = RG_USES({ .image = &picture, .access = RG_COPY_SRC },
                      { .image = &shade, .access = RG_COPY_SRC },
                      { .buffer = &pixels, .access = RG_COPY_DST }),
      .record = record_copy },
    { .name = "fill",
      .kind = RG_TRANSFER,
      .uses = RG_USES({ .buffer = &marks, .access = RG_COPY_DST }),
      .record = record_fill },
};

#define WRONG(name, ...) \
    static void name(struct rg_cmd *cmd, const struct rg_frame *frame) \
    { \
        (void)frame; \
        __VA_ARGS__; \
    }
#define A_SET ((VkDescriptorSet)(uintptr_t)1)

static const uint32_t words[16];
static struct rg_mesh incomplete; /* without any buffer */

WRONG(draw, rg_cmd_draw(cmd, 3))
WRONG(dispatch, rg_cmd_dispatch(cmd, 1, 1, 1))
WRONG(count_undeclared, rg_cmd_dispatch_indirect(cmd, &numbers, 0))
WRONG(count_at_end, rg_cmd_dispatch_indirect(cmd, &commands, 56))
WRONG(count_between, rg_cmd_dispatch_indirect(cmd, &commands, 2))
WRONG(find_image, (void)rg_cmd_image(cmd, &other))
WRONG(find_buffer, (void)rg_cmd_buffer(cmd, &pixels))
WRONG(copy_undeclared, rg_cmd_copy_image_to_buffer(cmd, &other, &pixels, 0))
WRONG(upload_undeclared, rg_cmd_copy_buffer_to_image(cmd, &seed, 0, &texels))
WRONG(push, rg_cmd_push(cmd, words, 4))
WRONG(push_null, rg_cmd_push(cmd, NULL, sizeof(struct paint_push)))
WRONG(bind_set, rg_cmd_bind_set(cmd, A_SET))
WRONG(bind_null_set, rg_cmd_bind_set(cmd, VK_NULL_HANDLE))
WRONG(bind_null, rg_cmd_bind_pipeline(cmd, VK_NULL_HANDLE))
WRONG(scissor, rg_cmd_scissor(cmd, (VkRect2D){ 0 }))
WRONG(viewport, rg_cmd_viewport(cmd, NULL))
WRONG(draw_null_count, rg_cmd_draw_indirect_count(cmd, NULL))
WRONG(draw_null_mesh, rg_cmd_draw_mesh(cmd, NULL))
WRONG(draw_incomplete, rg_cmd_draw_mesh_part(cmd, &incomplete, 0, 3))
WRONG(draw_beyond, rg_cmd_draw_mesh_part(cmd, &frame->mesh, 1, 3))
WRONG(copy_beyond, rg_cmd_copy_image_to_buffer(cmd, &picture, &pixels, 4))
WRONG(copy_between, rg_cmd_copy_image_to_buffer(cmd, &picture, &pixels, 2))
WRONG(fill_beyond, rg_cmd_fill_buffer(cmd, &pixels, 4, 256, 0))
WRONG(fill_between, rg_cmd_fill_buffer(cmd, &pixels, 0, 6, 0))
WRONG(fill_undeclared, rg_cmd_fill_buffer(cmd, &numbers, 0, 4, 0))
WRONG(draw_too_many,
      rg_cmd_draw_indirect_count(cmd, &(struct rg_indirect_count){ .commands = &numbers,
                                                                   .count = &commands,
                                                                   .max_count = 17 }))
WRONG(draw_uncounted, rg_cmd_draw_indirect_count(cmd, &(struct rg_indirect_count){
                                                          .commands = &numbers, .count = &seed }))

static const struct frame_mistake frame_mistakes[] = {
    { "compute", draw, "compute: a draw needs a raster row, not a compute row" },
    { "compute", count_undeclared, "compute: the row's uses have no access 'indirect' of numbers" },
    { "compute", count_at_end,
      "compute: a read of indirect parameters of 12 bytes at offset 56 exceeds the 64 bytes of "
      "commands" },
    { "compute", count_between,
      "compute: a read of indirect parameters at offset 2, not a "
      "multiple of 4 of commands" },
    { "compute", find_image, "compute: the row's uses have no access 'of any kind' of other" },
    { "compute", find_buffer, "compute: the row's uses have no access 'of any kind' of pixels" },
    { "compute", upload_undeclared,
      "compute: the row's uses have no access 'copy destination' of texels" },
    { "compute", push, "compute: rg_cmd_push() of 4 bytes, where push_size is 0" },
    { "compute", bind_set, "compute: rg_cmd_bind_set() of a set in a row without .set" },
    { "compute", bind_null_set, "compute: rg_cmd_bind_set() of VK_NULL_HANDLE" },
    { "compute", scissor, "compute: rg_cmd_scissor() needs a raster row, not a compute row" },
    { "draw", dispatch, "draw: a dispatch needs a compute row, not a raster row" },
    { "draw", draw, "draw: a draw before rg_cmd_push(): the row has push constants" },
    { "draw", push, "draw: rg_cmd_push() of 4 bytes, where push_size is 48" },
    { "draw", push_null, "draw: rg_cmd_push() of 48 bytes at NULL, where push_size is 48" },
    { "draw", bind_null, "draw: rg_cmd_bind_pipeline() of VK_NULL_HANDLE" },
    { "draw", draw_too_many,
      "draw: a read of indirect parameters of 272 bytes at offset 0 exceeds "
      "the 256 bytes of numbers" },
    { "draw", viewport, "draw: rg_cmd_viewport() with a viewport that is NULL" },
    { "draw", draw_null_count, "draw: an indirect draw with count parameters that are NULL" },
    { "draw", draw_uncounted, "draw: the row's uses have no access 'indirect' of seed" },
    { "mesh", draw_null_mesh, "mesh: a draw of a mesh that is NULL or lacks buffers" },
    { "mesh", draw_incomplete, "mesh: a draw of a mesh that is NULL or lacks buffers" },
    { "mesh", draw_beyond, "mesh: a draw of indices 1 to 3 of a mesh with 3" },
    { "mesh", draw, "mesh: a draw, but the row has .vertices: expected a draw of a mesh" },
    { "own", draw, "own: a draw before rg_cmd_bind_pipeline(): the row has no shaders" },
    { "copy", copy_undeclared, "copy: the row's uses have no access 'copy source' of other" },
    { "copy", copy_beyond, "copy: copy of 256 bytes at offset 4 exceeds the 256 bytes of pixels" },
    { "copy", copy_between, "copy: copy at offset 2, not a multiple of 4 of pixels" },
    { "copy", fill_beyond, "copy: fill of 256 bytes at offset 4 exceeds the 256 bytes of pixels" },
    { "copy", fill_between, "copy: fill that ends at offset 6, not a multiple of 4 of pixels" },
    { "copy", fill_undeclared,
      "copy: the row's uses have no access 'copy destination' of numbers" },
};

static void check_line(const struct run *run, const char *text)
{
    if (!strstr(run->line, text))
        print_error("expected: %s\nfound: %s\n", text, run->line);
    assert_non_null(strstr(run->line, text));
}

static void open_frames(struct run *run, struct gpu *gpu, struct rg_mesh *mesh,
                        struct gpu_buffer buffers[2])
{
    static const float corners[] = { -1, -1, 1, -1, -1, 1 };
    static const uint32_t indices[] = { 0, 1, 2 };
    const struct run_params params = {
        .technique = RG_TECHNIQUE("frames", frame_rows),
        .outputs = { &pixels, &marks },
        .kept = { { .image = &texels, .access = RG_COPY_SRC },
                  { .buffer = &numbers, .access = RG_COPY_SRC } },
    };
    assert_int_equal(gpu_buffer_create(gpu, &buffers[0], VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, corners,
                                       sizeof(corners), "mesh"),
                     STATUS_OK);
    assert_int_equal(gpu_buffer_create(gpu, &buffers[1], VK_BUFFER_USAGE_INDEX_BUFFER_BIT, indices,
                                       sizeof(indices), "mesh"),
                     STATUS_OK);
    *mesh = (struct rg_mesh){ buffers[0].buffer, buffers[1].buffer, 3 };
    run_open(run, gpu, &params);
}

static void frames_are_refused(void **state)
{
    struct run run;
    struct gpu_buffer buffers[2];
    struct rg_frame frame = { 0 };
    open_frames(&run, *state, &frame.mesh, buffers);
    for (size_t i = 0; i < sizeof(frame_mistakes) / sizeof(frame_mistakes[0]); i++) {
        frame.mistake = &frame_mistakes[i];
        run.line_count = 0;
        assert_int_equal(rg_exec_begin(run.exec, &run.slot), VK_SUCCESS);
        assert_int_equal(rg_exec_submit(run.exec, &frame), VK_ERROR_VALIDATION_FAILED_EXT);
        assert_int_equal(run.line_count, 1);
        check_line(&run, frame_mistakes[i].text);
        frame.mistake = NULL;
        run_frame(&run, &frame);
        assert_int_equal(*(uint32_t *)run_data(&run, &pixels), UINT32_MAX);
        assert_int_equal(((uint32_t *)run_data(&run, &marks))[1], 7);
    }
    run_close(&run);
    gpu_buffer_destroy(*state, &buffers[0]);
    gpu_buffer_destroy(*state, &buffers[1]);
}

static void calls_are_refused(void **state)
{
    struct run run;
    struct gpu_buffer buffers[2];
    struct rg_frame frame = { 0 };
    open_frames(&run, *state, &frame.mesh, buffers);
    assert_int_equal(rg_exec_submit(run.exec, &frame), VK_ERROR_VALIDATION_FAILED_EXT);
    check_line(&run, "rg_exec_submit() without rg_exec_begin() of a frame");
    assert_int_equal(rg_exec_submit_part(run.exec, &frame, 1), VK_ERROR_VALIDATION_FAILED_EXT);
    check_line(&run, "rg_exec_submit_part() without rg_exec_begin()");
    assert_int_equal(rg_exec_wait(run.exec, 7), VK_ERROR_VALIDATION_FAILED_EXT);
    check_line(&run, "rg_exec_wait() for a slot beyond frames_in_flight");
    assert_null(rg_exec_mapped(run.exec, &pixels, 7));
    assert_int_equal(rg_exec_begin(run.exec, NULL), VK_ERROR_VALIDATION_FAILED_EXT);
    check_line(&run, "rg_exec_begin() with a slot that is NULL");
    assert_int_equal(rg_exec_begin(run.exec, &run.slot), VK_SUCCESS);
    assert_int_equal(rg_exec_submit_synced(run.exec, &frame, NULL), VK_ERROR_VALIDATION_FAILED_EXT);
    check_line(&run, "rg_exec_submit_synced() with a sync or an array that is NULL");
    assert_int_equal(rg_exec_submit_synced(run.exec, &frame,
                                           &(struct rg_exec_external_sync){ .image_index = 1 }),
                     VK_ERROR_VALIDATION_FAILED_EXT);
    check_line(&run, "rg_exec_external_sync.image_index beyond the images");
    rg_exec_set_region(run.exec,
                       &(struct rg_exec_region){ { { 0 }, { 9, 1 } }, { { 0 }, { 1, 1 } } });
    check_line(&run, "rg_exec_set_region() outside of the view");
    assert_int_equal(rg_exec_record(run.exec, &(struct rg_exec_recording){ 0 }, &frame),
                     VK_ERROR_VALIDATION_FAILED_EXT);
    check_line(&run, "rg_exec_record() without a command buffer");
    assert_int_equal(rg_exec_update(run.exec, NULL), VK_ERROR_INITIALIZATION_FAILED);
    check_line(&run, "rg_exec_update of params without a plan");
    run_frame(&run, &frame);
    rg_plan_destroy(run.plan);
    assert_int_equal(rg_exec_begin(run.exec, &run.slot), VK_SUCCESS);
    assert_int_equal(rg_exec_submit(run.exec, &frame), VK_ERROR_VALIDATION_FAILED_EXT);
    check_line(&run, "a frame of a plan after its rg_plan_destroy()");
    run.plan = NULL; /* freed by the update */
    run_update(&run, &run.params);
    run_frame(&run, &frame);
    run_close(&run);
    gpu_buffer_destroy(*state, &buffers[0]);
    gpu_buffer_destroy(*state, &buffers[1]);
}

static void a_frame_needs_a_queue(void **state)
{
    const struct run_params params = {
        .technique = { "fill", &frame_rows[5], 1 },
        .outputs = { &marks },
    };
    struct gpu gpu = *(struct gpu *)*state;
    struct run run;
    gpu.queue = VK_NULL_HANDLE;
    run_open(&run, &gpu, &params);
    assert_int_equal(rg_exec_begin(run.exec, &run.slot), VK_ERROR_VALIDATION_FAILED_EXT);
    check_line(&run, "rg_exec_begin() without rg_exec_params.queue");
    run_close(&run);
}

/* ---- mistakes in plans for several queues ---- */

static const struct rg_pass queue_rows[] = {
    { .name = "fill",
      .kind = RG_TRANSFER,
      .queue = RG_QUEUE_TRANSFER,
      .uses = RG_USES({ .buffer = &marks, .access = RG_COPY_DST }),
      .record = record_fill },
};

static void queues_are_checked(void **state)
{
    const struct rg_frame frame = { 0 };
    struct run_params params = {
        .technique = RG_TECHNIQUE("queues", queue_rows),
        .outputs = { &marks },
        .queues = 1 << RG_QUEUE_TRANSFER,
    };
    struct run run;
    run_open(&run, *state, &params);
    assert_int_equal(rg_exec_record(run.exec, &(struct rg_exec_recording){ 0 }, &frame),
                     VK_ERROR_VALIDATION_FAILED_EXT);
    check_line(&run, "rg_exec_record() of a plan for several queues");
    assert_int_equal(rg_exec_begin(run.exec, &run.slot), VK_SUCCESS);
    assert_int_equal(rg_exec_submit_part(run.exec, &frame, 1), VK_ERROR_VALIDATION_FAILED_EXT);
    check_line(&run, "rg_exec_submit_part() of a plan for several queues");
    run_frame(&run, &frame);
    assert_int_equal(((uint32_t *)run_data(&run, &marks))[1], 7);
    run_close(&run);

    params.transfer = &(struct rg_exec_queue){ VK_NULL_HANDLE, 0 };
    run_compile(&run, *state, &params);
    assert_int_equal(run_create(&run, run.plan), VK_ERROR_INITIALIZATION_FAILED);
    check_line(&run, "params without a queue that the plan uses");
    run_close(&run);
}

/* ---- mistakes in imports ---- */

static const struct rg_pass import_rows[] = {
    { .name = "read",
      .kind = RG_TRANSFER,
      .queue = RG_QUEUE_TRANSFER,
      .uses = RG_USES({ .image = &picture, .access = RG_COPY_SRC },
                      { .buffer = &pixels, .access = RG_COPY_DST }),
      .record = record_nothing },
};
static const struct rg_pass buffer_rows[] = {
    { .name = "read",
      .kind = RG_TRANSFER,
      .queue = RG_QUEUE_TRANSFER,
      .uses = RG_USES({ .buffer = &numbers, .access = RG_COPY_SRC },
                      { .buffer = &pixels, .access = RG_COPY_DST }),
      .record = record_nothing },
};

/* Checks the message about an import, NULL for none. `transfer` is NULL for the main queue only. */
static void check_import(struct gpu *gpu, const struct rg_exec_import *object,
                         const struct rg_exec_queue *transfer, const char *text)
{
    const bool is_image = !object->buffer;
    const struct rg_import import = {
        .image = is_image ? &picture : NULL,
        .buffer = is_image ? NULL : &numbers,
        .access = RG_COPY_SRC,
    };
    const struct run_params params = {
        .technique = { "import", is_image ? import_rows : buffer_rows, 1 },
        .outputs = { &pixels },
        .imports = &import,
        .objects = object,
        .import_count = 1,
        .queues = transfer ? 1 << RG_QUEUE_TRANSFER : 0,
        .transfer = transfer,
    };
    struct run run;
    run_compile(&run, gpu, &params);
    assert_int_equal(run_create(&run, run.plan),
                     text ? VK_ERROR_INITIALIZATION_FAILED : VK_SUCCESS);
    if (text)
        check_line(&run, text);
    run_close(&run);
}

static void imports_are_checked(void **state)
{
    struct gpu *gpu = *state;
    /* never used, because the executor is not created */
    const struct rg_exec_queue transfer = { gpu->queue, gpu->queue_family + 1 };
    struct gpu_buffer buffer;
    const VkImageCreateInfo good = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
        .imageType = VK_IMAGE_TYPE_2D,
        .format = RGBA,
        .extent = { 8, 8, 1 },
        .mipLevels = 1,
        .arrayLayers = 1,
        .samples = VK_SAMPLE_COUNT_1_BIT,
        .usage = VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
    };
    VkImageCreateInfo bad[] = { good, good, good, good };
    VkImage image;
    assert_int_equal(vkCreateImage(gpu->device, &good, NULL, &image), VK_SUCCESS);
    bad[0].format = VK_FORMAT_R16_SFLOAT;
    bad[1].extent.height = 4;
    bad[2].usage = VK_IMAGE_USAGE_SAMPLED_BIT;
    bad[3].samples = VK_SAMPLE_COUNT_4_BIT;
    static const char *const texts[] = {
        "format 76, where the plan has 37, in the import of picture",
        "extent.height 4, where the plan has 8, in the import of picture",
        "usage 4, where the plan has 1, in the import of picture",
        "samples 4, where the plan has 1, in the import of picture",
    };
    for (int i = 0; i < 4; i++)
        check_import(gpu, &(struct rg_exec_import){ .image = image, .image_info = &bad[i] }, NULL,
                     texts[i]);
    const struct rg_exec_import known = { .image = image, .image_info = &good };
    check_import(gpu, &known, NULL, NULL);
    check_import(gpu, &known, &transfer,
                 "sharingMode 0, where the plan has 1, in the import of picture");
    check_import(gpu, &(struct rg_exec_import){ 0 }, NULL,
                 "VK_NULL_HANDLE as the import of picture");
    vkDestroyImage(gpu->device, image, NULL);

    assert_int_equal(gpu_buffer_create(gpu, &buffer, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, words,
                                       sizeof(words), "mesh"),
                     STATUS_OK);
    check_import(gpu, &(struct rg_exec_import){ .buffer = buffer.buffer }, NULL,
                 "size 64, where the plan has 256, in the import of numbers");
    const VkBufferCreateInfo info = { .size = 256, .usage = VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT };
    check_import(gpu, &(struct rg_exec_import){ .buffer = buffer.buffer, .buffer_info = &info },
                 &transfer, "sharingMode 0, where the plan has 1, in the import of numbers");
    check_import(gpu, &(struct rg_exec_import){ .buffer = buffer.buffer, .buffer_info = &info },
                 NULL, "usage 16, where the plan has 1, in the import of numbers");
    gpu_buffer_destroy(gpu, &buffer);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tables_have_faults), ON_DEVICE(frames_are_refused),
        ON_DEVICE(calls_are_refused),         ON_DEVICE(a_frame_needs_a_queue),
        ON_DEVICE(queues_are_checked),        ON_DEVICE(imports_are_checked),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
