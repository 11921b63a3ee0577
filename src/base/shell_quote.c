/* shell_quote.c: quotes and joins command-line arguments for a shell. */
#include "src/base/shell_quote.h"
#include <stdbool.h>
#include <string.h>
#include "src/base/text_stream.h"

void shell_quote_word(const char *word, FILE *out)
{
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                                "-_=+.,/:@%#";
    const bool is_plain = *word && strspn(word, plain) == strlen(word) && *word != '#';
    fputs(is_plain ? "" : "'", out);
    for (const char *c = word; *c; c++)
        fputs(*c == '\'' ? "'\\''" : (const char[]){ *c, '\0' }, out);
    fputs(is_plain ? "" : "'", out);
}

bool shell_has_control(const char *word)
{
    for (; *word; word++) {
        if ((unsigned char)*word < ' ' || *word == 0x7f)
            return true;
    }
    return false;
}

char *shell_quote_join(char *const *args)
{
    struct text_stream stream;
    FILE *out = text_stream_open(&stream);
    if (out)
        fputs("firn", out);
    for (; out && *args; args++) {
        putc(' ', out);
        shell_quote_word(*args, out);
    }
    return text_stream_close(&stream, NULL);
}
