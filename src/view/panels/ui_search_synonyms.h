/* ui_search_synonyms.h: search synonyms of settings and actions. */
#ifndef FIRN_VIEW_PANELS_UI_SEARCH_SYNONYMS_H
#define FIRN_VIEW_PANELS_UI_SEARCH_SYNONYMS_H

#include <stdint.h>

/* Returns the synonyms of a setting's name or an action's label; "" if there are none. */
const char *ui_search_synonyms(const char *name);

const char *ui_search_synonyms_name(uint32_t i); /* NULL after the last */

#endif
