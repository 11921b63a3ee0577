/* option_values.c: numbers on the command line. */
#include "src/app/options/option_values.h"
#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include "src/base/log.h"

enum status option_refuse(const char *option, const char *value, const char *wanted)
{
    log_error("--%s %s: %s", option, value, wanted);
    return STATUS_USAGE;
}

bool option_parse_numbers(const char *text, char separator, float *numbers, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        char *end;
        if (isspace((unsigned char)*text))
            return false;
        double value = strtod(text, &end);
        bool last = i + 1 == count;
        if (end == text || !(fabs(value) <= 1e30) || *end != (last ? '\0' : separator))
            return false;
        numbers[i] = (float)value;
        text = end + !last;
    }
    return true;
}

bool option_parse_count(const char *text, uint32_t min, uint32_t max, uint32_t *count,
                        const char **rest)
{
    char *end;
    if (!isdigit((unsigned char)*text))
        return false;
    errno = 0;
    unsigned long value = strtoul(text, &end, 10);
    if (errno || value < min || value > max)
        return false;
    *count = (uint32_t)value;
    *rest = end;
    return true;
}
