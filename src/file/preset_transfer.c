/* preset_transfer.c: transfers a preset between processes: their number, then all lines. */
#include "src/file/preset_transfer.h"
#include <stdlib.h>
#include <string.h>

enum {
    MAGIC_PRESET = 0x53455250,
};

struct head {
    uint32_t magic, count;
};

void preset_finish(struct preset *preset)
{
    free(preset->lines);
    *preset = (struct preset){ 0 };
}

bool preset_pipe_write(const struct pipe_sink *sink, const struct preset *preset)
{
    const struct head head = { MAGIC_PRESET, preset->count };
    return pipe_write(sink, &head, sizeof(head)) &&
           pipe_write(sink, preset->lines, preset->count * sizeof(*preset->lines)) &&
           pipe_write_end(sink);
}

static bool is_text(const struct preset_line *line)
{
    const char *end = memchr(line->assignment, '\0', sizeof(line->assignment));
    for (const char *c = line->assignment; c < end; c++) {
        if (*c < ' ' || *c > '~')
            return false;
    }
    return end;
}

enum pipe_fault preset_pipe_read(const struct pipe_source *source, struct preset *preset)
{
    struct head head;
    *preset = (struct preset){ 0 };
    enum pipe_fault fault = pipe_read(source, &head, sizeof(head));
    if (fault == PIPE_OK && head.magic != MAGIC_PRESET)
        fault = PIPE_HEAD;
    if (fault == PIPE_OK && head.count > PRESET_LINE_COUNT_MAX)
        fault = PIPE_SIZE;
    if (fault != PIPE_OK)
        return fault;
    preset->lines = calloc((size_t)head.count + 1, sizeof(*preset->lines));
    if (!preset->lines)
        return PIPE_MEMORY;
    preset->count = head.count;
    fault = pipe_read(source, preset->lines, head.count * sizeof(*preset->lines));
    for (uint32_t i = 0; i < head.count && fault == PIPE_OK; i++)
        fault = is_text(&preset->lines[i]) ? PIPE_OK : PIPE_TEXT;
    if (fault == PIPE_OK)
        fault = pipe_read_end(source);
    if (fault != PIPE_OK)
        preset_finish(preset);
    return fault;
}

enum status preset_read(struct preset *preset, const char *path, const struct reader_params *params)
{
    struct reader *reader;
    *preset = (struct preset){ 0 };
    const enum status status = reader_start(&reader, params, READER_PRESET, path);
    if (status != STATUS_OK)
        return status;
    const struct pipe_source source = reader_source(reader);
    const enum status ended = reader_end(reader, preset_pipe_read(&source, preset));
    if (ended != STATUS_OK)
        preset_finish(preset);
    return ended;
}
