/*
 * Bytes become a file of a session. Its lines are taken or refused as a whole, and what is taken
 * comes back the same from what it is written as.
 */
#include "src/view/session/session_file.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/fuzz_file.h"

static enum status load(struct session_file *session, const void *data, size_t size)
{
    char path[FUZZ_PATH_SIZE];
    struct preset lines;
    fuzz_file_write(path, "a.firn", data, size);
    enum status status = preset_parse(&lines, path);
    if (status == STATUS_OK)
        status = session_file_parse(session, &lines, "a.firn");
    FUZZ_CHECK(status == STATUS_OK || status == STATUS_DATA);
    FUZZ_CHECK(!lines.lines);
    return status;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct session_file session;
    struct session_file again;
    char *text = NULL;
    size_t text_size;
    if (load(&session, data, size) != STATUS_OK)
        return 0;
    FUZZ_CHECK(session.scene && *session.scene && session.refraction);
    FILE *out = open_memstream(&text, &text_size);
    FUZZ_CHECK(out != NULL);
    session_file_print(&session, out);
    FUZZ_CHECK(fclose(out) == 0);
    const enum status status = load(&again, text, text_size);
    if (status == STATUS_OK) { /* else a name became too long for a line */
        FUZZ_CHECK(settings_equal(&session.settings, &again.settings));
        FUZZ_CHECK(session.refraction == again.refraction);
        session_file_finish(&again);
    }
    free(text);
    session_file_finish(&session);
    return 0;
}
