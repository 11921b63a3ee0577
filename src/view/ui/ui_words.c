/* ui_words.c: words in texts. */
#include "src/view/ui/ui_words.h"
#include <string.h>
#include <strings.h>

static bool holds(const char *text, const char *word, size_t length)
{
    for (; *text; text++) {
        if (!strncasecmp(text, word, length))
            return true;
    }
    return false;
}

bool ui_words_fit(const char *words, const char *const *texts, size_t text_count)
{
    for (words += strspn(words, " "); *words; words += strspn(words, " ")) {
        const size_t length = strcspn(words, " ");
        size_t i = 0;
        while (i < text_count && !holds(texts[i], words, length))
            i++;
        if (i == text_count)
            return false;
        words += length;
    }
    return true;
}
