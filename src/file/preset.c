/* preset.c: reads a preset, which is a text file or an image's metadata, in a reader process: the
 * parser in the child process, and the transfer to its parent. */
#include "src/file/preset.h"
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/base/path.h"
#include "src/file/exr.h"
#include "src/file/png.h"

enum {
    MAGIC_PRESET = 0x53455250,
    FILE_SIZE_MAX = 1 << 20,
};

void preset_finish(struct preset *preset)
{
    free(preset->lines);
    *preset = (struct preset){ 0 };
}

/* ---- parsing ---- */

/* Contents of a text file. Files that contain '\0' are rejected. */
struct text {
    char *bytes;
    size_t size;
};

/* Appends the first `length` characters of `assignment` to the preset, as line `number`. */
static enum status append(struct preset *preset, uint32_t number, const char *assignment,
                          size_t length)
{
    const uint32_t count = preset->count;
    if (!(count & (count - 1))) { /* full: count is 0 or 2^n */
        struct preset_line *lines =
            realloc(preset->lines, (count ? 2 * (size_t)count : 1) * sizeof(*lines));
        if (!lines)
            return log_out_of_memory("preset");
        preset->lines = lines;
    }
    struct preset_line *line = &preset->lines[preset->count++];
    *line = (struct preset_line){ .number = number };
    memcpy(line->assignment, assignment, length);
    return STATUS_OK;
}

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r';
}

/* Returns a message that describes the fault of an invalid line, or NULL if it is valid. */
static const char *check_line(const char *line, size_t length)
{
    for (size_t i = 0; i < length; i++) {
        if (line[i] < ' ' || line[i] > '~')
            return "expected printable ASCII characters";
    }
    if (length >= PRESET_LINE_SIZE)
        return "expected a line of at most 511 characters";
    return NULL;
}

static enum status append_line(struct preset *preset, const char *path, uint32_t number,
                               const char *line, size_t length)
{
    while (length && is_blank(line[0])) {
        line++;
        length--;
    }
    while (length && is_blank(line[length - 1]))
        length--;
    if (!length || line[0] == '#')
        return STATUS_OK;
    const char *wrong = check_line(line, length);
    if (wrong) {
        log_error("%s:%u: %s", path, number, wrong);
        return STATUS_DATA;
    }
    const char *equals = memchr(line, '=', length);
    if (!equals || equals == line) {
        log_error("%s:%u: expected NAME=VALUE or a comment that begins with '#', got '%.*s'", path,
                  number, (int)length, line);
        return STATUS_DATA;
    }
    return append(preset, number, line, length);
}

static enum status append_lines(struct preset *preset, const char *path, const struct text *text)
{
    enum status status = STATUS_OK;
    const char *line = text->bytes, *end = text->bytes + text->size;
    for (uint32_t number = 1; line < end && status == STATUS_OK; number++) {
        const char *next = memchr(line, '\n', (size_t)(end - line));
        if (!next)
            next = end;
        if (number > PRESET_LINE_COUNT_MAX) {
            log_error("%s: expected at most %d lines", path, PRESET_LINE_COUNT_MAX);
            return STATUS_DATA;
        }
        status = append_line(preset, path, number, line, (size_t)(next - line));
        line = next + 1;
    }
    return status;
}

static enum status read_text(const char *path, struct text *text)
{
    FILE *file = fopen(path, "rb");
    if (!file) {
        log_error("%s: %s", path, strerror(errno));
        return STATUS_NO_INPUT;
    }
    enum status status = STATUS_OK;
    text->bytes = malloc(FILE_SIZE_MAX + 1);
    if (text->bytes)
        text->size = fread(text->bytes, 1, FILE_SIZE_MAX + 1, file);
    if (!text->bytes) {
        status = log_out_of_memory(path);
    } else if (ferror(file)) {
        log_error("%s: %s", path, strerror(errno));
        status = STATUS_NO_INPUT;
    } else if (text->size > FILE_SIZE_MAX) {
        log_error("%s: expected a text file with settings, of at most 1 MiB", path);
        status = STATUS_DATA;
    }
    fclose(file);
    return status;
}

static enum status load_text(struct preset *preset, const char *path)
{
    struct text text = { 0 };
    enum status status = read_text(path, &text);
    if (status == STATUS_OK)
        status = append_lines(preset, path, &text);
    free(text.bytes);
    return status;
}

static enum status read_head(const char *path, struct image_header *head)
{
    struct exr_file *file = NULL;
    if (path_ends_in(path, ".png"))
        return png_check(path, head);
    const enum status status = exr_open(&file, path, head);
    exr_close(file);
    return status;
}

/* Returns the settings in an image's metadata: the text after the last " fov=". */
static const char *find_settings(const char *text)
{
    static const char last[] = " fov=";
    const char *found = NULL;
    while (text && (text = strstr(text, last)))
        found = text += sizeof(last) - 1;
    return found;
}

/* Adds every assignment NAME=VALUE whose name contains a dot, because all setting names do. */
static enum status append_settings(struct preset *preset, const char *settings)
{
    enum status status = STATUS_OK;
    settings += strcspn(settings, " ");
    while (*settings && status == STATUS_OK) {
        settings += strspn(settings, " ");
        const size_t length = strcspn(settings, " "), name = strcspn(settings, "= ");
        const bool is_setting = memchr(settings, '.', name) && settings[name] == '=';
        if (is_setting && length < PRESET_LINE_SIZE && !check_line(settings, length) &&
            preset->count < PRESET_LINE_COUNT_MAX)
            status = append(preset, 0, settings, length);
        settings += length;
    }
    return status;
}

static enum status load_image(struct preset *preset, const char *path)
{
    struct image_header head = { 0 };
    enum status status = read_head(path, &head);
    if (status != STATUS_OK)
        return status;
    const char *settings = find_settings(image_header_text(&head, "firn/settings"));
    if (settings) {
        status = append_settings(preset, settings);
    } else {
        log_error("%s: this image holds no settings: expected an image written by firn "
                  "render",
                  path);
        status = STATUS_DATA;
    }
    image_header_finish(&head);
    return status;
}

enum status preset_parse(struct preset *preset, const char *path)
{
    *preset = (struct preset){ 0 };
    const bool is_image = path_ends_in(path, ".exr") || path_ends_in(path, ".png");
    const enum status status = is_image ? load_image(preset, path) : load_text(preset, path);
    if (status != STATUS_OK)
        preset_finish(preset);
    return status;
}

/* ---- transfer ---- */

struct head {
    uint32_t magic, count;
};

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

enum status preset_send(const char *path, const struct pipe_sink *sink)
{
    struct preset preset;
    enum status status = preset_parse(&preset, path);
    if (status == STATUS_OK && !preset_pipe_write(sink, &preset))
        status = STATUS_WRITE;
    preset_finish(&preset);
    return status;
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
