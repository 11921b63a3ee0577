/* list_json.h: what firn list prints, as JSON. */
#ifndef FIRN_APP_LIST_JSON_H
#define FIRN_APP_LIST_JSON_H

#include "src/base/status.h"

/* Prints an object with a key for each list, or for that of one topic, on stdout. Logs; the
 * statuses are those of gpu_list(), and STATUS_TRY_AGAIN. */
MUST_USE enum status list_json(const char *topic); /* may be NULL */

#endif
