/* formatted_output.c: formatted output with UTF-8 validation and escaped names. */
#include <inttypes.h>
#include <stdarg.h>
#include "graph/dump/dump_internal.h"

enum {
    REPLACEMENT = 0xfffd
};

uint32_t rg_dump_decode_utf8(const char **text)
{
    const unsigned char *s = (const unsigned char *)*text;
    uint32_t length = *s < 0x80   ? 1
                      : *s < 0xc2 ? 0
                      : *s < 0xe0 ? 2
                      : *s < 0xf0 ? 3
                      : *s < 0xf5 ? 4
                                  : 0;
    uint32_t c = length == 1 ? *s : *s & 0xffu >> (length + 1);
    for (uint32_t i = 1; i < length; i++) {
        if ((s[i] & 0xc0) != 0x80) /* also rejects the terminating 0 */
            length = 0;
        else
            c = c << 6 | (s[i] & 0x3fu);
    }
    bool too_long = (length == 3 && c < 0x800) || (length == 4 && c < 0x10000);
    bool surrogate = c >= 0xd800 && c < 0xe000;
    if (!length || too_long || (length > 1 && surrogate) || c > 0x10ffff) {
        *text += 1;
        return REPLACEMENT;
    }
    *text += length;
    return c;
}

uint32_t rg_dump_printable(uint32_t character)
{
    bool control = character < 0x20 || (character >= 0x7f && character < 0xa0);
    return control || character == 0xfffe || character == 0xffff ? REPLACEMENT : character;
}

void rg_dump_utf8(FILE *out, uint32_t character)
{
    static const unsigned char leads[] = { 0, 0xc0, 0xe0, 0xf0 };
    int rest = character < 0x80 ? 0 : character < 0x800 ? 1 : character < 0x10000 ? 2 : 3;
    fputc((int)(leads[rest] | character >> (6 * rest)), out);
    while (rest--)
        fputc((int)(0x80 | (character >> (6 * rest) & 0x3f)), out);
}

static void put_bytes(FILE *out, VkDeviceSize size)
{
    static const char *const units[] = { "B", "KiB", "MiB", "GiB", "TiB" };
    size_t unit = 0;
    VkDeviceSize rest = 0;
    for (; size >= 1024 && unit + 1 < sizeof(units) / sizeof(units[0]); size /= 1024, unit++)
        rest = size % 1024;
    fprintf(out, "%" PRIu64, size);
    if (unit)
        fprintf(out, ".%" PRIu64, rest * 10 / 1024);
    fprintf(out, " %s", units[unit]);
}

void rg_dump_print(const struct rg_dump *d, const char *text, ...)
{
    va_list arguments;
    va_start(arguments, text);
    for (; *text; text++) {
        if (*text != '%')
            fputc(*text, d->out);
        else if (*++text == 'u')
            fprintf(d->out, "%u", va_arg(arguments, uint32_t));
        else if (*text == 'z')
            fprintf(d->out, "%" PRIu64, va_arg(arguments, VkDeviceSize));
        else if (*text == 'b')
            put_bytes(d->out, va_arg(arguments, VkDeviceSize));
        else if (*text == 's')
            fputs(va_arg(arguments, const char *), d->out);
        else
            d->name(d->out, va_arg(arguments, const char *));
    }
    va_end(arguments);
}
