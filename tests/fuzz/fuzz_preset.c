/*
 * fuzz_preset.c: reads the input as a preset, and as the data of the reader process of a preset.
 * Every line that is taken is text, and settings take it or refuse it as a file's.
 */
#include "src/file/preset.h"
#include "src/settings/settings.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/fuzz_file.h"

/* All that is sent, in one piece. */
struct stream {
    unsigned char *bytes;
    size_t size, at;
};

static bool put(void *user, const void *bytes, size_t size)
{
    struct stream *stream = user;
    unsigned char *all = realloc(stream->bytes, stream->size + size);
    FUZZ_CHECK(all != NULL && size > 0);
    memcpy(all + stream->size, bytes, size);
    stream->bytes = all;
    stream->size += size;
    return true;
}

static bool take(void *user, void *bytes, size_t size)
{
    struct stream *stream = user;
    if (!stream->bytes || size > stream->size - stream->at)
        return false;
    memcpy(bytes, stream->bytes + stream->at, size);
    stream->at += size;
    return true;
}

static void check(const struct preset *preset)
{
    struct settings settings = settings_default();
    for (uint32_t i = 0; i < preset->count; i++) {
        const struct settings_location location = { "a.txt", preset->lines[i].number };
        FUZZ_CHECK(memchr(preset->lines[i].assignment, '\0', PRESET_LINE_SIZE));
        const enum status status =
            settings_assign(&settings, preset->lines[i].assignment, SETTING_PRESET, &location);
        FUZZ_CHECK(status == STATUS_OK || status == STATUS_DATA);
    }
}

static void send(const struct preset *preset)
{
    struct stream stream = { 0 };
    struct preset again;
    FUZZ_CHECK(preset_pipe_write(&(struct pipe_sink){ put, &stream }, preset));
    FUZZ_CHECK(preset_pipe_read(&(struct pipe_source){ take, &stream, SIZE_MAX }, &again) ==
               PIPE_OK);
    FUZZ_CHECK(stream.at == stream.size && again.count == preset->count);
    for (uint32_t i = 0; i < preset->count; i++)
        FUZZ_CHECK(again.lines[i].number == preset->lines[i].number &&
                   !strcmp(again.lines[i].assignment, preset->lines[i].assignment));
    preset_finish(&again);
    free(stream.bytes);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char path[FUZZ_PATH_SIZE];
    struct preset preset;
    fuzz_file_write(path, "a.txt", data, size);
    const enum status status = preset_parse(&preset, path);
    FUZZ_CHECK(status == STATUS_OK || (status == STATUS_DATA && !preset.lines));
    if (status == STATUS_OK) {
        check(&preset);
        send(&preset);
    }
    preset_finish(&preset);
    struct stream stream = { (unsigned char *)fuzz_text(data, size), size, 0 };
    if (preset_pipe_read(&(struct pipe_source){ take, &stream, SIZE_MAX }, &preset) == PIPE_OK)
        check(&preset);
    preset_finish(&preset);
    free(stream.bytes);
    return 0;
}
