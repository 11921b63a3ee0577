/* list_json.h: prints the lists of firn list as JSON. */
#ifndef FIRN_APP_LIST_JSON_H
#define FIRN_APP_LIST_JSON_H

#include "src/base/status.h"

/* Prints all lists, or only the list `topic`, as a JSON object on stdout. If this fails, logs an
 * error and returns a status of gpu_list() or STATUS_TRY_AGAIN. */
MUST_USE enum status list_json(const char *topic); /* may be NULL */

#endif
