/* view_compare.h: what is right of the divider, and how far it is from what is left of it. */
#ifndef FIRN_VIEW_VIEW_COMPARE_H
#define FIRN_VIEW_VIEW_COMPARE_H

#include "src/view/error_map.h"
#include "src/view/history.h"
#include "src/view/still.h"
#include "src/view/truth.h"
#include "src/view/view_refine.h"

enum {
    VIEW_SIDE_SIZE = 96, /* bytes of a side's name */
};

struct view_compare {
    enum view_other other;    /* what is on the right */
    struct view_state stored; /* by a hand, with `has_stored` */
    bool has_stored;
    bool awaits_file; /* the next picture that is dropped comes to the right */
    char file_name[VIEW_SIDE_SIZE - 8];
    struct still file, traced;
    struct truth truth;
    struct view_seen truth_seen; /* by it */
    bool truth_failed;           /* of this picture; it has been said */
    bool differs;                /* the errors between both are asked for */
    struct error_map map;
    struct view_seen map_seen; /* by its job */
    uint32_t map_count;        /* samples of both sides then */
    float map_gain;
    struct still errors; /* its picture, of: */
    struct view_seen errors_seen;
    bool has_errors;
};

#endif
