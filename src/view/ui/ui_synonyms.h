/* ui_synonyms.h: what a person may type for a setting or an action that has another name. */
#ifndef FIRN_VIEW_UI_UI_SYNONYMS_H
#define FIRN_VIEW_UI_UI_SYNONYMS_H

#include <stdint.h>

/* Returns the words for the name of a setting or the label of an action; "": there are none. */
const char *ui_synonyms(const char *name);

const char *ui_synonyms_name(uint32_t i); /* row i of the table; NULL: there are no more */

#endif
