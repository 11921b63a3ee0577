/*
 * overlay_list.h: triangles that lie over a picture. For C and C++.
 */
#ifndef FIRN_VIEW_OVERLAY_LIST_H
#define FIRN_VIEW_OVERLAY_LIST_H

#include <stdint.h>

enum {
    OVERLAY_VERTEX_COUNT = 1 << 16, /* at most; of indices (uint32_t) */
    OVERLAY_INDEX_COUNT = 1 << 17,
    OVERLAY_PART_COUNT = 512,
};

struct overlay_vertex {
    float x, y;     /* pixels, from the top left corner */
    float u, v;     /* in the font's image */
    uint32_t color; /* R lowest, A highest; sRGB-encoded, not premultiplied */
};

/* Triangles within a rectangle. */
struct overlay_part {
    uint32_t first_index, index_count;
    int32_t left, top; /* pixels; not negative */
    uint32_t width, height;
};

struct overlay_list {
    uint32_t version;      /* another one whenever the list is; not 0 */
    uint32_t docked_count; /* the first of all parts, which are beside the picture */
    uint32_t part_count;   /* drawn one over another */
    struct overlay_part parts[OVERLAY_PART_COUNT];
};

#endif
