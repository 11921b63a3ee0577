/* json_text.h: helpers for writing JSON. A NULL value means out of memory. */
#ifndef FIRN_FILE_JSON_TEXT_H
#define FIRN_FILE_JSON_TEXT_H

#include <jansson.h>
#include "src/base/status.h"

/* Returns a JSON string. If the text is not UTF-8, non-ASCII bytes become '?'. */
json_t *json_text_string(const char *text);

/* Moves a value to the end of an array; on failure frees both and returns NULL. */
json_t *json_text_append(json_t *array, json_t *value);

/* Returns the shortest decimal number that rounds to the float: 1.31, not 1.30999994. */
double json_text_float(float value);

/* Prints a value on stdout, and frees it. Logs and returns STATUS_TRY_AGAIN if it is NULL. */
MUST_USE enum status json_text_print(json_t *root);

#endif
