/* ui_search_synonyms.h: synonyms that users may type when they search for a setting or an action.
 */
#ifndef FIRN_VIEW_UI_UI_SEARCH_SYNONYMS_H
#define FIRN_VIEW_UI_UI_SEARCH_SYNONYMS_H

#include <stdint.h>

/* Returns the synonyms of a setting's name or an action's label; "" if there are none. */
const char *ui_search_synonyms(const char *name);

const char *
ui_search_synonyms_name(uint32_t i); /* name in row i of the table; NULL after the last */

#endif
