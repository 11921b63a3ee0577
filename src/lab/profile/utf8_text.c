/* utf8_text.c: UTF-8 aware printing and cleaning of text. */
#include "src/lab/profile/utf8_text.h"
#include <stdbool.h>
#include <string.h>

static bool is_within(unsigned char c, unsigned char low, unsigned char high)
{
    return c >= low && c <= high;
}

/* Returns the byte count of the first UTF-8 character, or 0 if invalid (Unicode, table 3-7). */
static size_t utf8_size(const char *text)
{
    static const struct {
        unsigned char first_low, first_high, second_low, second_high;
        size_t size;
    } forms[] = {
        { 0xc2, 0xdf, 0x80, 0xbf, 2 }, { 0xe0, 0xe0, 0xa0, 0xbf, 3 }, { 0xe1, 0xec, 0x80, 0xbf, 3 },
        { 0xed, 0xed, 0x80, 0x9f, 3 }, { 0xee, 0xef, 0x80, 0xbf, 3 }, { 0xf0, 0xf0, 0x90, 0xbf, 4 },
        { 0xf1, 0xf3, 0x80, 0xbf, 4 }, { 0xf4, 0xf4, 0x80, 0x8f, 4 },
    };

    const unsigned char *c = (const unsigned char *)text;

    if (c[0] < 0x80)
        return 1;
    for (size_t i = 0; i < sizeof(forms) / sizeof(forms[0]); i++) {
        if (!is_within(c[0], forms[i].first_low, forms[i].first_high))
            continue;
        bool ok = is_within(c[1], forms[i].second_low, forms[i].second_high);
        for (size_t k = 2; k < forms[i].size && ok; k++)
            ok = is_within(c[k], 0x80, 0xbf);
        return ok ? forms[i].size : 0;
    }
    return 0;
}

void profile_clean_text(char *text)
{
    while (*text) {
        const size_t size = utf8_size(text);
        if (size == 0)
            *text = '?';
        text += size > 0 ? size : 1;
    }
}

/* Prints the first character of a text. Returns a pointer to the rest. */
static const char *print_character(const char *text, FILE *out)
{
    const size_t size = utf8_size(text);
    const unsigned char first = (unsigned char)text[0];
    const unsigned char second = (unsigned char)(size > 1 ? text[1] : 0);
    /* control characters: C0, delete, C1 */
    const bool is_control = first < 0x20 || first == 0x7f || (first == 0xc2 && second < 0xa0);
    if (size == 0 || is_control)
        fputc('?', out);
    else
        fwrite(text, 1, size, out);
    return text + (size > 0 ? size : 1);
}

static const char *skip_characters(const char *text, size_t count)
{
    for (; count > 0 && *text; count--) {
        const size_t size = utf8_size(text);
        text += size > 0 ? size : 1;
    }
    return text;
}

static size_t count_characters(const char *text)
{
    size_t count = 0;
    for (; *text; text = skip_characters(text, 1))
        count++;
    return count;
}

static void print_characters(const char *text, size_t count, FILE *out)
{
    for (; count > 0 && *text; count--)
        text = print_character(text, out);
}

void profile_print_name(const char *name, uint32_t columns, FILE *out)
{
    const size_t length = count_characters(name);
    if (length <= columns) {
        print_characters(name, length, out);
        fprintf(out, "%*s", (int)(columns - length), "");
        return;
    }
    const size_t after = (columns - 1) / 2, before = columns - 1 - after;
    print_characters(name, before, out);
    fputs("…", out);
    print_characters(skip_characters(name, length - after), after, out);
}

void profile_print_wrapped(const char *text, uint32_t indent, FILE *out)
{
    size_t room = PROFILE_COLUMNS;
    while (count_characters(text) > room) {
        const char *limit = skip_characters(text, room);
        const char *end = limit;
        while (end > text && *end != ' ')
            end--;
        const char *next = end;
        while (end > text && end[-1] == ' ')
            end--;
        if (end == text) /* word longer than a line */
            next = end = limit;
        while (text < end)
            text = print_character(text, out);
        text = next + strspn(next, " ");
        fprintf(out, "\n%*s", (int)indent, "");
        room = PROFILE_COLUMNS - indent;
    }
    print_characters(text, room, out);
    fputc('\n', out);
}
