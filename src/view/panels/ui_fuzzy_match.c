/* ui_fuzzy_match.c: fuzzy matching of search words. */
#include "src/view/panels/ui_fuzzy_match.h"
#include <ctype.h>
#include <string.h>
#include <strings.h>

enum {
    WITHIN = 2,              /* match distance inside another word */
    GAPS_MAX = 2,            /* maximum skipped letters per typed one */
    GAPS_PART = 2,           /* minimum typed letters per skipped one in misspelt words */
    ABBREVIATION = 3,        /* minimum length of a fuzzy word */
    MISSPELT_LENGTH_MIN = 4, /* minimum length for a wrong letter */
    MISSPELT = 8,            /* distance added for a wrong letter */
};

static bool holds(const char *text, const char *word, size_t length)
{
    for (; *text; text++) {
        if (!strncasecmp(text, word, length))
            return true;
    }
    return false;
}

bool ui_fuzzy_match_contains(const char *query, const char *const *texts, size_t text_count)
{
    for (query += strspn(query, " "); *query; query += strspn(query, " ")) {
        const size_t length = strcspn(query, " ");
        size_t i = 0;
        while (i < text_count && !holds(texts[i], query, length))
            i++;
        if (i == text_count)
            return false;
        query += length;
    }
    return true;
}

static bool begins_word(const char *text, size_t at)
{
    return isalnum((unsigned char)text[at]) && (!at || !isalnum((unsigned char)text[at - 1]));
}

static bool is_same(char a, char b)
{
    return !strncasecmp(&a, &b, 1);
}

static uint32_t minimum(uint32_t a, uint32_t b)
{
    return a < b ? a : b;
}

/* Returns the match distance of a word that occurs in the text without gaps. */
static uint32_t whole(const char *text, const char *word, size_t length)
{
    uint32_t distance = UI_FUZZY_MATCH_NONE;
    for (size_t at = 0; text[at]; at++) {
        if (!strncasecmp(text + at, word, length))
            distance = minimum(distance, !at ? 0 : begins_word(text, at) ? 1 : WITHIN);
    }
    return distance;
}

/* Counts the letters skipped in `text` to find those of `word` in order, ignoring word[wrong]. */
static uint32_t gaps(const char *text, const char *word, size_t length, size_t wrong)
{
    uint32_t count = 0;
    bool has_begun = false;
    for (size_t i = 0; i < length; i++) {
        const char *from = text;
        if (i == wrong)
            continue;
        while (*text && !is_same(*text, word[i]))
            text++;
        if (!*text)
            return UI_FUZZY_MATCH_NONE;
        count += has_begun ? (uint32_t)(text - from) : 0;
        has_begun = true;
        text++;
    }
    return count;
}

/* Finds the letters of `word` in order in `text`, from a word start. Ignores word[wrong]. Returns
 * the number of skipped letters. If not found or too many, returns UI_FUZZY_MATCH_NONE. */
static uint32_t scattered(const char *text, const char *word, size_t length, size_t wrong)
{
    uint32_t distance = UI_FUZZY_MATCH_NONE;
    const char first = word[wrong == 0 ? 1 : 0];
    for (size_t at = 0; text[at]; at++) {
        if (begins_word(text, at) && is_same(text[at], first))
            distance = minimum(distance, gaps(text + at, word, length, wrong));
    }
    const size_t most = wrong < length ? length / GAPS_PART : GAPS_MAX * length;
    return distance > most ? UI_FUZZY_MATCH_NONE : distance;
}

static uint32_t word_distance(const char *text, const char *word, size_t length, bool misspelt)
{
    uint32_t distance = whole(text, word, length);
    if (distance != UI_FUZZY_MATCH_NONE || length < ABBREVIATION)
        return distance;
    distance = scattered(text, word, length, length);
    for (size_t i = 0; misspelt && length >= MISSPELT_LENGTH_MIN && i < length; i++) {
        const uint32_t other = scattered(text, word, length, i);
        distance = minimum(distance, other == UI_FUZZY_MATCH_NONE ? other : MISSPELT + other);
    }
    return distance == UI_FUZZY_MATCH_NONE ? distance : WITHIN + 1 + distance;
}

uint32_t ui_fuzzy_match_distance(const char *query, const char *text, bool misspelt)
{
    uint32_t sum = 0;
    for (query += strspn(query, " "); *query; query += strspn(query, " ")) {
        const size_t length = strcspn(query, " ");
        const uint32_t distance = word_distance(text, query, length, misspelt);
        if (distance == UI_FUZZY_MATCH_NONE)
            return distance;
        sum += distance;
        query += length;
    }
    return sum;
}
