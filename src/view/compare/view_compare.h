/* view_compare.h: state of the A/B comparison: side B, the reference job and the error map. */
#ifndef FIRN_VIEW_COMPARE_VIEW_COMPARE_H
#define FIRN_VIEW_COMPARE_VIEW_COMPARE_H

#include "src/view/compare/comparison_image.h"
#include "src/view/compare/flip_error_map.h"
#include "src/view/compare/reference_job.h"
#include "src/view/session/undo_stack.h"
#include "src/view/view_progressive.h"

enum {
    VIEW_SIDE_SIZE = 96, /* maximum bytes of a side's label */
};

struct view_compare {
    enum view_side_b side_b;  /* kind of image on side B */
    struct view_state stored; /* state stored by the user */
    bool has_stored;
    bool awaits_file; /* a dropped image becomes side B */
    char file_name[VIEW_SIDE_SIZE - 8];
    struct comparison_image file, reference;
    struct reference_job reference_job;
    struct view_identity reference_identity; /* view that the reference job renders */
    bool reference_failed;                   /* failure for this view; already reported */
    bool wants_error_map;                    /* the error map is requested */
    struct flip_error_map flip_map;
    struct view_identity flip_map_identity; /* view of the running error map */
    uint32_t flip_map_sample_count;         /* samples of both sides */
    struct comparison_image error_image;    /* displayed error map */
    struct view_identity error_image_identity;
    bool has_error_image;
};

#endif
