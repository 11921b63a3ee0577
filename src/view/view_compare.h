/* view_compare.h: state of the A/B comparison: side B, the reference job and the error map. */
#ifndef FIRN_VIEW_VIEW_COMPARE_H
#define FIRN_VIEW_VIEW_COMPARE_H

#include "src/view/error_map.h"
#include "src/view/history.h"
#include "src/view/still.h"
#include "src/view/truth.h"
#include "src/view/view_refine.h"

enum {
    VIEW_SIDE_SIZE = 96, /* maximum bytes of a side's label */
};

struct view_compare {
    enum view_other other;    /* kind of image on side B */
    struct view_state stored; /* state stored by the user; valid with `has_stored` */
    bool has_stored;
    bool awaits_file; /* the next dropped image becomes side B */
    char file_name[VIEW_SIDE_SIZE - 8];
    struct still file, traced;
    struct truth truth;
    struct view_seen truth_seen; /* view that the reference job renders */
    bool truth_failed;           /* failure for this view; already reported */
    bool differs;                /* the error map is requested */
    struct error_map map;
    struct view_seen map_seen; /* view that the error map is computed for */
    uint32_t map_count;        /* samples of both sides when the error map was started */
    float map_gain;
    struct still errors; /* displayed error map, of the view errors_seen */
    struct view_seen errors_seen;
    bool has_errors;
};

#endif
