/* shell_quote.c: quotes and joins command-line arguments for a shell. */
#include "src/base/shell_quote.h"
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* Returns true if a shell would parse an unquoted word as a comment or an assignment. */
static bool is_special(const char *word)
{
    static const char name[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_";
    return *word == '#' || word[strspn(word, name)] == '=';
}

void shell_quote_word(const char *word, FILE *out)
{
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                                "-_=+.,/:@%#";
    const bool is_plain = *word && strspn(word, plain) == strlen(word) && !is_special(word);
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
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    if (!out)
        return NULL;
    fputs("firn", out);
    for (; *args; args++) {
        putc(' ', out);
        shell_quote_word(*args, out);
    }
    if (fclose(out)) {
        free(text);
        text = NULL;
    }
    return text;
}
