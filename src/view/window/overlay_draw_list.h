/* overlay_draw_list.h: draw list of the user interface, shared by C and C++. */
#ifndef FIRN_VIEW_WINDOW_OVERLAY_DRAW_LIST_H
#define FIRN_VIEW_WINDOW_OVERLAY_DRAW_LIST_H

#include <stdint.h>

enum {
    OVERLAY_VERTEX_COUNT = 1 << 16, /* capacity, also of the indices (uint32_t) */
    OVERLAY_INDEX_COUNT = 1 << 17,
    OVERLAY_COMMAND_COUNT = 512,
};

struct overlay_vertex {
    float x, y;     /* pixels from the top left corner */
    float u, v;     /* texture coordinates in the font atlas */
    uint32_t color; /* RGBA8 vertex colour, R in the lowest byte; sRGB-encoded, straight alpha */
};

/* One draw command: a range of triangles and its scissor rectangle. */
struct overlay_draw_command {
    uint32_t first_index, index_count;
    int32_t left, top; /* pixels, not negative */
    uint32_t width, height;
};

struct overlay_draw_list {
    uint32_t version;       /* changes with the list; never 0 */
    uint32_t docked_count;  /* commands of docked panels come first */
    uint32_t command_count; /* drawn back to front */
    struct overlay_draw_command commands[OVERLAY_COMMAND_COUNT];
};

#endif
