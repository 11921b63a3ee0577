/* log.c: error, warning and note messages on stderr or to a thread's sink. */
#include "src/base/log.h"
#include <stdarg.h>
#include <stdio.h>

static _Thread_local struct log_sink *thread_sink;

struct log_sink *log_set_sink(struct log_sink *sink)
{
    struct log_sink *earlier = thread_sink;
    thread_sink = sink;
    return earlier;
}

struct log_sink *log_get_sink(void)
{
    return thread_sink;
}

/* If the character at `text` is unsafe to print, returns its length in bytes, otherwise 0. Unsafe
 * characters can control a terminal or disguise text. They are UTF-8 control characters (C0, C1,
 * DEL), line and paragraph separators, and bidirectional controls. */
static size_t control_size(const unsigned char *text)
{
    if (text[0] < 0x20 || text[0] == 0x7f)
        return 1;
    if (text[0] == 0xc2 && text[1] >= 0x80 && text[1] <= 0x9f)
        return 2;
    if (text[0] == 0xd8 && text[1] == 0x9c) /* U+061C */
        return 2;
    if (text[0] == 0xe2 && text[1] == 0x80)
        return text[2] == 0x8e || text[2] == 0x8f || (text[2] >= 0xa8 && text[2] <= 0xae) ? 3 : 0;
    if (text[0] == 0xe2 && text[1] == 0x81)
        return text[2] >= 0xa6 && text[2] <= 0xa9 ? 3 : 0; /* U+2066 to U+2069 */
    return 0;
}

void log_sanitize(char *text)
{
    char *end = text;
    for (const char *next = text; *next;) {
        const size_t size = control_size((const unsigned char *)next);
        *end = *next;
        if (size)
            *end = '?';
        end++;
        next += size ? size : 1;
    }
    *end = '\0';
}

static void write_line(enum log_level level, const char *format, va_list *arguments)
{
    static const char *const prefixes[] = { "", "warning: ", "note: " };
    char line[2048];
    vsnprintf(line, sizeof(line), format, *arguments);
    log_sanitize(line);
    if (thread_sink)
        thread_sink->write(thread_sink, level, line);
    else
        fprintf(stderr, "firn: %s%s\n", prefixes[level], line);
}

void log_error(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    write_line(LOG_ERROR, format, &arguments);
    va_end(arguments);
}

void log_warning(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    write_line(LOG_WARNING, format, &arguments);
    va_end(arguments);
}

void log_note(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    write_line(LOG_NOTE, format, &arguments);
    va_end(arguments);
}
