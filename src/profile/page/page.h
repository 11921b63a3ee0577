/* page.h: the text of the page of a profile, made of the files beside this one by embed.py. */
#ifndef FIRN_PROFILE_PAGE_H
#define FIRN_PROFILE_PAGE_H

#include <stddef.h>

enum {
    PAGE_PART_COUNT = 3 /* data goes between: of the profile, then of the sweep */
};

struct page_part {
    const char *text; /* no 0 at its end */
    size_t size;
};

extern const struct page_part page_parts[PAGE_PART_COUNT];

#endif
