/* embedded_page.h: the HTML page of a profile as C arrays, which embed.py generates from this
 * folder. */
#ifndef FIRN_LAB_PROFILE_PAGE_EMBEDDED_PAGE_H
#define FIRN_LAB_PROFILE_PAGE_EMBEDDED_PAGE_H

#include <stddef.h>

enum {
    PAGE_PART_COUNT = 3 /* separated by profile and sweep JSON */
};

struct page_part {
    const char *text; /* not terminated by 0 */
    size_t size;
};

extern const struct page_part page_parts[PAGE_PART_COUNT];

#endif
