/* optics_ask.h: asks the shader optics.comp, and reads the vectors that it is compared with. */
#ifndef TESTS_OPTICS_ASK_H
#define TESTS_OPTICS_ASK_H

#include <jansson.h>
#include <math.h>
#include <string.h>

#include "tests/support/assertions.h"

#include "tests/gpu/shaders/optics.h"
#include "tests/gpu/test_shaders.h"
#include "tests/support/run_graph.h"

_Static_assert(sizeof(struct optics_question) == 152, "as tight as scalar layout");
_Static_assert(sizeof(struct optics_answer) == 128, "as tight as scalar layout");

/* what floats on the device leave of the vectors' digits */
static const double tolerance = 1e-5;

/* ---- asking the shader ---- */

enum {
    QUESTIONS_MAX = 1024,
};

struct rg_frame {
    uint32_t count;
};

#define BUFFER(title, type, where) \
    { \
        .name = (title), .size = QUESTIONS_MAX * sizeof(type), .memory = (where) \
    }
static const struct rg_buffer questions_in =
    BUFFER("questions in", struct optics_question, RG_MEMORY_UPLOAD);
static const struct rg_buffer questions =
    BUFFER("questions", struct optics_question, RG_MEMORY_DEVICE);
static const struct rg_buffer answers = BUFFER("answers", struct optics_answer, RG_MEMORY_DEVICE);
static const struct rg_buffer answers_out =
    BUFFER("answers out", struct optics_answer, RG_MEMORY_READBACK);

static inline void record_copy(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    const struct rg_use *uses = rg_cmd_pass(cmd)->uses;
    const VkBufferCopy region = { .size = uses[0].buffer->size };
    vkCmdCopyBuffer(rg_cmd_vulkan(cmd), rg_cmd_buffer(cmd, uses[0].buffer),
                    rg_cmd_buffer(cmd, uses[1].buffer), 1, &region);
}

static inline void record_answer(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    rg_cmd_dispatch(cmd, frame->count, 1, 1);
}

static const struct rg_pass rows[] = {
    {
        .name = "up",
        .kind = RG_TRANSFER,
        .uses = RG_USES({ .buffer = &questions_in, .access = RG_COPY_SRC },
                        { .buffer = &questions, .access = RG_COPY_DST }),
        .record = record_copy,
    },
    {
        .name = "answer",
        .kind = RG_COMPUTE,
        .uses = RG_USES(
            { .buffer = &questions, .access = RG_STORAGE_READ, .binding = OPTICS_QUESTIONS },
            { .buffer = &answers, .access = RG_STORAGE_WRITE, .binding = OPTICS_ANSWERS }),
        .comp = &optics_comp,
        .record = record_answer,
    },
    {
        .name = "down",
        .kind = RG_TRANSFER,
        .uses = RG_USES({ .buffer = &answers, .access = RG_COPY_SRC },
                        { .buffer = &answers_out, .access = RG_COPY_DST }),
        .record = record_copy,
    },
};

static inline void ask(struct gpu *gpu, const struct optics_question *asked,
                       struct optics_answer *answered, uint32_t count)
{
    const struct rg_frame frame = { count };
    struct run run;
    assert_in_range(count, 1, QUESTIONS_MAX);
    run_open(&run, gpu,
             &(struct run_params){
                 .technique = RG_TECHNIQUE("optics", rows),
                 .outputs = { &answers_out },
             });
    assert_int_equal(rg_exec_begin(run.exec, &run.slot), VK_SUCCESS);
    memcpy(run_data(&run, &questions_in), asked, count * sizeof(*asked));
    assert_int_equal(rg_exec_submit(run.exec, &frame), VK_SUCCESS);
    assert_int_equal(rg_exec_wait(run.exec, run.slot), VK_SUCCESS);
    memcpy(answered, run_data(&run, &answers_out), count * sizeof(*answered));
    run_close(&run);
}

/* ---- reading the vectors ---- */

/* Of tests/data/oracles.json. */
static inline json_t *load(const char *path)
{
    json_error_t error;
    json_t *oracles = json_load_file(path, 0, &error);
    if (!oracles)
        fail_msg("%s: line %d: %s", path, error.line, error.text);
    return oracles;
}

/* The array of that name, which has `count` elements. */
static inline json_t *get_cases(const json_t *oracles, const char *name, size_t count)
{
    json_t *cases = json_object_get(oracles, name);
    assert_int_equal(json_array_size(cases), count);
    return cases;
}

static inline double get_number(const json_t *row, const char *name)
{
    const json_t *number = json_object_get(row, name);
    assert_true(json_is_number(number));
    return json_number_value(number);
}

static inline vec3s get_vector(const json_t *row, const char *name)
{
    const json_t *vector = json_object_get(row, name);
    vec3s v;
    assert_int_equal(json_array_size(vector), 3);
    for (size_t i = 0; i < 3; i++)
        v.raw[i] = (float)json_number_value(json_array_get(vector, i));
    return v;
}

static inline void check_vector(vec3s got, vec3s wanted)
{
    for (size_t i = 0; i < 3; i++)
        CHECK_NEAR(got.raw[i], wanted.raw[i], tolerance);
}

#endif
