/* view_compare.h: state of the A/B comparison: side B, the reference job and the error map. */
#ifndef FIRN_VIEW_VIEW_COMPARE_H
#define FIRN_VIEW_VIEW_COMPARE_H

#include "src/view/comparison_image.h"
#include "src/view/flip_error_map.h"
#include "src/view/reference_job.h"
#include "src/view/undo_stack.h"
#include "src/view/view_progressive.h"

enum {
    VIEW_SIDE_SIZE = 96, /* maximum bytes of a side's label */
};

struct view_compare {
    enum view_side_b other;   /* kind of image on side B */
    struct view_state stored; /* state stored by the user; valid with `has_stored` */
    bool has_stored;
    bool awaits_file; /* the next dropped image becomes side B */
    char file_name[VIEW_SIDE_SIZE - 8];
    struct comparison_image file, traced;
    struct reference_job truth;
    struct view_identity view_reference_seen; /* view that the reference job renders */
    bool reference_failed;                    /* failure for this view; already reported */
    bool differs;                             /* the error map is requested */
    struct flip_error_map map;
    struct view_identity map_seen; /* view that the error map is computed for */
    uint32_t map_count;            /* samples of both sides when the error map was started */
    float map_gain;
    struct comparison_image errors; /* displayed error map, of the view errors_seen */
    struct view_identity errors_seen;
    bool has_errors;
};

#endif
