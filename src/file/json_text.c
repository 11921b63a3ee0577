/* json_text.c: helpers for writing JSON, using jansson. */
#include "src/file/json_text.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"

enum {
    DIGITS = 9,         /* significant digits that restore a float exactly */
    DOUBLE_DIGITS = 15, /* significant digits that a double preserves */
};

json_t *json_text_string(const char *text)
{
    json_t *json = json_string(text);
    char *copy = json ? NULL : strdup(text);
    for (char *c = copy; c && *c; c++)
        if ((unsigned char)*c >= 0x80)
            *c = '?';
    if (copy)
        json = json_string(copy);
    free(copy);
    return json;
}

json_t *json_text_append(json_t *array, json_t *value)
{
    if (array && value && json_array_append_new(array, value) == 0)
        return array;
    if (!array)
        json_decref(value);
    json_decref(array);
    return NULL;
}

double json_text_float(float value)
{
    char text[32];
    for (int digits = 6; digits <= DIGITS; digits++) {
        snprintf(text, sizeof(text), "%.*g", digits, (double)value);
        if ((float)strtod(text, NULL) == value)
            break;
    }
    return strtod(text, NULL);
}

enum status json_text_print(json_t *root)
{
    const size_t format = JSON_INDENT(2) | JSON_REAL_PRECISION(DOUBLE_DIGITS);
    char *text = root ? json_dumps(root, format) : NULL;
    json_decref(root);
    if (!text)
        return log_out_of_memory(NULL);
    puts(text);
    free(text);
    return STATUS_OK;
}
