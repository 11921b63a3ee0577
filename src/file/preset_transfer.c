/* preset_transfer.c: transfers a preset between processes: the number of lines, then all lines. */
#include "src/file/preset_transfer.h"
#include <stdlib.h>
#include <string.h>

enum {
    MAGIC_PRESET = 0x53455250,
};

struct head {
    uint32_t magic, count;
};

struct line {
    uint32_t number, length; /* line number; assignment length without '\0' */
};

void preset_finish(struct preset *preset)
{
    free(preset->lines);
    *preset = (struct preset){ 0 };
}

bool preset_pipe_write(const struct pipe_sink *sink, const struct preset *preset)
{
    const struct head head = { MAGIC_PRESET, preset->count };
    bool done = pipe_write(sink, &head, sizeof(head));
    for (uint32_t i = 0; i < preset->count && done; i++) {
        const struct preset_line *from = &preset->lines[i];
        const struct line line = { from->number, (uint32_t)strlen(from->assignment) };
        done = pipe_write(sink, &line, sizeof(line)) &&
               pipe_write(sink, from->assignment, line.length);
    }
    return done && pipe_write_end(sink);
}

static bool is_text(const char *text, size_t length)
{
    for (size_t i = 0; i < length; i++) {
        if (text[i] < ' ' || text[i] > '~')
            return false;
    }
    return true;
}

static enum pipe_fault read_line(const struct pipe_source *source, struct preset_line *line)
{
    struct line sent;
    enum pipe_fault fault = pipe_read(source, &sent, sizeof(sent));
    if (fault == PIPE_OK && sent.length >= sizeof(line->assignment))
        fault = PIPE_TEXT;
    if (fault == PIPE_OK)
        fault = pipe_read(source, line->assignment, sent.length);
    if (fault != PIPE_OK)
        return fault;
    line->number = sent.number;
    line->assignment[sent.length] = '\0';
    return is_text(line->assignment, sent.length) ? PIPE_OK : PIPE_TEXT;
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
    for (uint32_t i = 0; i < head.count && fault == PIPE_OK; i++)
        fault = read_line(source, &preset->lines[i]);
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
