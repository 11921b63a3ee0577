/*
 * fuzz_model_pipe.c: uses the input as the data that a reader process sends: alone, or inserted
 * into a valid stream. Whatever they are, a model that is taken is one that every pass may draw.
 */
#include <string.h>

#include "src/file/image_receive.h"
#include "src/scene/import/model_pipe.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/fuzz_scene.h"
#include "tests/fuzz/fuzz_stream.h"
#include "tests/support/memory_pipe.h"

enum {
    SIZE_MAX_OF_ALL = 1 << 20,
};

static void read_model(struct memory_pipe *stream)
{
    const struct pipe_source source = { memory_pipe_read, stream, SIZE_MAX_OF_ALL };
    struct model model;
    if (model_pipe_read_model(&source, &model) != PIPE_OK) {
        fuzz_check_no_model(&model);
        return;
    }
    fuzz_check_model(&model);
    model_finish(&model);
}

static void read_environment(struct memory_pipe *stream)
{
    const struct pipe_source source = { memory_pipe_read, stream, SIZE_MAX_OF_ALL };
    struct environment environment;
    if (model_pipe_read_environment(&source, &environment) != PIPE_OK) {
        fuzz_check_no_environment(&environment);
        return;
    }
    fuzz_check_environment(&environment);
    environment_finish(&environment);
}

static void read_head(struct memory_pipe *stream)
{
    const struct pipe_source source = { memory_pipe_read, stream, SIZE_MAX_OF_ALL };
    struct image_header head;
    const bool is_whole = image_pipe_read_header(&source, &head) == PIPE_OK;
    FUZZ_CHECK(is_whole == (head.image.planes != NULL));
    for (uint32_t p = 0; p < head.image.plane_count; p++)
        FUZZ_CHECK(memchr(head.image.planes[p].name, 0, IMAGE_NAME_SIZE));
    FUZZ_CHECK(!head.has_window || head.window.x + head.image.width <= head.window.width);
    image_header_finish(&head);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct memory_pipe stream = { .size = 0 };
    if (size == 0)
        return 0;
    const bool is_model = data[0] & 1, is_head = data[0] & 4;
    if (data[0] & 2) {
        stream.size = size - 1 < MEMORY_PIPE_SIZE ? size - 1 : MEMORY_PIPE_SIZE;
        memcpy(stream.bytes, data + 1, stream.size);
    } else {
        if (is_head)
            fuzz_stream_make_head(&stream);
        else
            fuzz_stream_make(&stream, is_model);
        fuzz_stream_edit(&stream, data + 1, size - 1);
    }
    if (is_head)
        read_head(&stream);
    else if (is_model)
        read_model(&stream);
    else
        read_environment(&stream);
    return 0;
}
