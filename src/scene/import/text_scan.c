/* text_scan.c: tokeniser for text model files, with a locale-independent number parser. */
#include "src/scene/import/text_scan.h"
#include <math.h>
#include <string.h>
#include <strings.h>

enum {
    DIGITS_MAX = 18, /* decimal digits in 63 bits */
    POWER_MAX = 22,  /* largest exact power of ten */
    EXPONENT_MAX = 10000,
};

struct text_scan text_line(struct text_scan *scan)
{
    struct text_scan line = *scan;
    const char *end = scan->end;
    const char *at = scan->at;
    while (at < end && !text_is_break(*at))
        at++;
    line.end = at;
    if (at < end)
        at += *at == '\r' && at + 1 < end && at[1] == '\n' ? 2 : 1;
    scan->at = at;
    return line;
}

struct text_scan text_word(struct text_scan *scan)
{
    (void)text_skip(scan);
    struct text_scan word = { scan->at, scan->at };
    while (word.end < scan->end && !text_is_blank(*word.end))
        word.end++;
    scan->at = word.end;
    return word;
}

bool text_take_word(struct text_scan *scan, const char *word)
{
    struct text_scan next = *scan;
    const struct text_scan found = text_word(&next);
    const size_t length = strlen(word);
    if ((size_t)(found.end - found.at) != length || strncasecmp(found.at, word, length) != 0)
        return false;
    *scan = next;
    return true;
}

struct text_scan text_rest(const struct text_scan *line)
{
    struct text_scan rest = *line;
    (void)text_skip(&rest);
    while (rest.end > rest.at && text_is_blank(rest.end[-1]))
        rest.end--;
    return rest;
}

/* Returns digits * 10^exponent, with an error of a few ulp if |exponent| exceeds POWER_MAX. */
static double scale(uint64_t digits, int64_t exponent)
{
    static const double powers[POWER_MAX + 1] = {
        1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
        1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22,
    };
    if (digits == 0)
        return 0;
    if (exponent >= 0 && exponent <= POWER_MAX)
        return (double)digits * powers[exponent];
    if (exponent < 0 && exponent >= -POWER_MAX)
        return (double)digits / powers[-exponent];
    /* Scales in two steps, so that no power overflows or underflows before the product does. */
    const int64_t half = exponent / 2;
    return (double)digits * pow(10, (double)half) * pow(10, (double)(exponent - half));
}

/* Reads "nan", "inf" or "infinity". Later range checks reject these with a specific message. */
static bool read_word(struct text_scan *scan, double *value)
{
    static const struct {
        const char *word;
        double value;
    } words[] = { { "nan", (double)NAN },
                  { "inf", (double)INFINITY },
                  { "infinity", (double)INFINITY } };

    for (size_t i = 0; i < sizeof(words) / sizeof(words[0]); i++) {
        if (text_take_word(scan, words[i].word)) {
            *value = words[i].value;
            return true;
        }
    }
    return false;
}

static int64_t read_exponent(const char **at, const char *end)
{
    const char *next = *at + 1;
    const bool is_negative = next < end && *next == '-';
    int64_t exponent = 0;
    next += next < end && (*next == '-' || *next == '+');
    if (next == end || *next < '0' || *next > '9')
        return 0;
    for (; next < end && *next >= '0' && *next <= '9'; next++)
        exponent = exponent < EXPONENT_MAX ? exponent * 10 + (*next - '0') : exponent;
    *at = next;
    return is_negative ? -exponent : exponent;
}

bool text_float(struct text_scan *scan, float *value)
{
    (void)text_skip(scan);
    const char *at = scan->at;
    const char *end = scan->end;
    const bool is_negative = at < end && *at == '-';
    uint64_t digits = 0;
    int64_t exponent = 0;
    double magnitude;
    at += at < end && (*at == '-' || *at == '+');
    const char *first = at;
    const char *point = NULL;
    uint32_t count = 0;
    for (; at < end; at++) {
        const uint32_t digit = (uint32_t)(unsigned char)*at - '0';
        if (digit <= 9) {
            if (count < DIGITS_MAX)
                digits = digits * 10 + digit;
            exponent += (count >= DIGITS_MAX) - (point != NULL);
            count += digits > 0;
        } else if (*at == '.' && !point) {
            point = at;
        } else {
            break;
        }
    }
    if (at - first > (point != NULL)) {
        if (at < end && (*at == 'e' || *at == 'E'))
            exponent += read_exponent(&at, end);
        magnitude = scale(digits, exponent);
    } else {
        struct text_scan word = { first, end };
        if (!read_word(&word, &magnitude))
            return false;
        at = word.at;
    }
    if (at < end && !text_is_blank(*at) && !text_is_break(*at))
        return false;
    *value = (float)(is_negative ? -magnitude : magnitude);
    scan->at = at;
    return true;
}

bool text_integer(struct text_scan *scan, int64_t *value)
{
    (void)text_skip(scan);
    const char *at = scan->at;
    const bool is_negative = at < scan->end && *at == '-';
    at += at < scan->end && (*at == '-' || *at == '+');
    const char *first = at;
    int64_t number = 0;
    for (; at < scan->end && *at >= '0' && *at <= '9'; at++)
        number = number <= INT64_MAX / 20 ? number * 10 + (*at - '0') : number;
    if (at == first)
        return false;
    *value = is_negative ? -number : number;
    scan->at = at;
    return true;
}

uint32_t text_floats(struct text_scan *scan, float *values, uint32_t max)
{
    uint32_t count = 0;
    float value;
    for (; text_float(scan, &value); count++) {
        if (count < max)
            values[count] = value;
    }
    return count;
}

void text_show(char *to, size_t size, const struct text_scan *text)
{
    text_copy(to, size, text);
    for (char *c = to; *c; c++)
        if (*c < ' ' || *c > '~')
            *c = '?';
}

void text_copy(char *to, size_t size, const struct text_scan *text)
{
    size_t length = (size_t)(text->end - text->at);
    if (length >= size)
        length = size - 1;
    for (size_t i = 0; i < length; i++)
        to[i] = text->at[i];
    for (size_t i = 0; i < length; i++) {
        if (to[i] == '\0')
            to[i] = ' ';
    }
    to[length] = '\0';
}
