/* stderr_capture.c: replaces stderr by a stream that keeps the last error line. */
#define _GNU_SOURCE /* for fopencookie */
#include "src/view/stderr_capture.h"
#include <string.h>
#include <unistd.h>

/* Returns true if the line is an error message, not a warning or note. */
static bool is_error(const char *text, size_t size)
{
    static const char *const prefixes[] = { "firn: warning: ", "firn: note: " };
    for (size_t i = 0; i < sizeof(prefixes) / sizeof(prefixes[0]); i++) {
        if (size > strlen(prefixes[i]) && !strncmp(text, prefixes[i], strlen(prefixes[i])))
            return false;
    }
    return size > strlen("firn: ") && !strncmp(text, "firn: ", strlen("firn: "));
}

static ssize_t capture(void *user, const char *text, size_t size)
{
    struct stderr_capture *e = user;
    const size_t skipped = strlen("firn: ");
    if (is_error(text, size)) {
        const char *end = memchr(text, '\n', size);
        const size_t length = (end ? (size_t)(end - text) : size) - skipped;
        pthread_mutex_lock(&e->lock);
        snprintf(e->line, sizeof(e->line), "%.*s", (int)length, text + skipped);
        pthread_mutex_unlock(&e->lock);
    }
    return write(STDERR_FILENO, text, size);
}

void stderr_capture_begin(struct stderr_capture *e)
{
    FILE *stream = fopencookie(e, "w", (cookie_io_functions_t){ .write = capture });
    if (!stream || pthread_mutex_init(&e->lock, NULL) != 0) {
        if (stream)
            (void)fclose(stream);
        return;
    }
    setvbuf(stream, NULL, _IONBF, 0); /* unbuffered like stderr, so that messages appear at once */
    e->original = stderr;
    stderr = stream;
}

void stderr_capture_end(struct stderr_capture *e)
{
    FILE *stream = stderr;
    if (!e->original)
        return;
    stderr = e->original;
    (void)fclose(stream);
    pthread_mutex_destroy(&e->lock);
    *e = (struct stderr_capture){ 0 };
}

bool stderr_capture_take(struct stderr_capture *e, char line[static STDERR_CAPTURE_SIZE])
{
    *line = '\0';
    if (!e->original)
        return false;
    pthread_mutex_lock(&e->lock);
    memcpy(line, e->line, STDERR_CAPTURE_SIZE);
    *e->line = '\0';
    pthread_mutex_unlock(&e->lock);
    return *line != '\0';
}
