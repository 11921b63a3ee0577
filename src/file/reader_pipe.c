/* reader_pipe.c: byte stream between a reader process and its parent, and messages about invalid
 * data. */
#include "src/file/reader_pipe.h"

enum {
    MAGIC_END = 0x444e4546,
};

const char *pipe_fault_text(enum pipe_fault fault)
{
    static const char *const words[PIPE_FAULT_COUNT] = {
        [PIPE_OK] = "the expected data",
        [PIPE_SHORT] = "less data than announced",
        [PIPE_MEMORY] = "more data than fits into memory",
        [PIPE_LARGE] = "more data than the limit",
        [PIPE_HEAD] = "an unexpected kind of data",
        [PIPE_SIZE] = "counts or sizes out of range",
        [PIPE_NUMBER] = "a number that is not finite or too large",
        [PIPE_INDEX] = "an index beyond the vertices",
        [PIPE_MATERIAL] = "a material that does not exist",
        [PIPE_CAMERA] = "a camera, a box or an index of refraction out of range",
        [PIPE_TEXEL] = "a texel out of range",
        [PIPE_TEXT] = "a metadata text or a channel name out of range",
        [PIPE_END] = "more data than announced",
    };
    return words[fault];
}

bool pipe_write(const struct pipe_sink *sink, const void *bytes, size_t size)
{
    return size == 0 || sink->write(sink->user, bytes, size);
}

enum pipe_fault pipe_read(const struct pipe_source *source, void *bytes, size_t size)
{
    return size == 0 || source->read(source->user, bytes, size) ? PIPE_OK : PIPE_SHORT;
}

bool pipe_write_end(const struct pipe_sink *sink)
{
    const uint32_t end = MAGIC_END;
    return pipe_write(sink, &end, sizeof(end));
}

enum pipe_fault pipe_read_end(const struct pipe_source *source)
{
    uint32_t end = 0;
    const enum pipe_fault fault = pipe_read(source, &end, sizeof(end));
    if (fault != PIPE_OK)
        return fault;
    return end == MAGIC_END ? PIPE_OK : PIPE_END;
}
