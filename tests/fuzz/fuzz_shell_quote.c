/* Quotes the input as a word of a script: a shell must parse the result as the same word. */
#include <stdlib.h>
#include <string.h>

#include "src/base/shell_quote.h"
#include "tests/fuzz/fuzz.h"

static const char special[] = "|&;<>()$`\\\"' \t\n*?[]{}~!^";

/* Parses one word by the quoting rules of POSIX (2.2 Quoting). */
static void read_word(const char *text, char *word)
{
    FUZZ_CHECK(*text != '#' && *text);
    for (const char *c = text; *c;) {
        if (*c == '\'') {
            const char *end = strchr(c + 1, '\'');
            FUZZ_CHECK(end);
            for (c++; c < end; c++)
                *word++ = *c;
            c++;
        } else if (*c == '\\') {
            FUZZ_CHECK(c[1] && c[1] != '\n');
            *word++ = c[1];
            c += 2;
        } else {
            FUZZ_CHECK(!strchr(special, *c) && (unsigned char)*c > ' ' && (unsigned char)*c < 0x7f);
            *word++ = *c++;
        }
    }
    *word = '\0';
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char *word = fuzz_text(data, size), *text = NULL;
    char *read = malloc(size + 1);
    FILE *out = open_memstream(&text, &size);
    FUZZ_CHECK(word && read && out);
    shell_quote_word(word, out);
    fclose(out);
    read_word(text, read);
    FUZZ_CHECK(strcmp(read, word) == 0);
    free(read);
    free(text);
    free(word);
    return 0;
}
