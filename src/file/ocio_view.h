/*
 * ocio_view.h: a view of an OpenColorIO config, baked to a 3D lookup table (lattice). A reader
 * process reads the config and its files and bakes the lattice (reader_process.h describes the
 * errors).
 */
#ifndef FIRN_FILE_OCIO_VIEW_H
#define FIRN_FILE_OCIO_VIEW_H

#include <stdbool.h>
#include "src/file/reader_process.h"

/* Display colours for logarithmically spaced linear Rec. 709 colours. */
struct ocio_view {
    float *lattice; /* RGB, red varies fastest; NULL if no view is loaded */
};

/* Loads a view. `name` is that of a view of the config's default display, or DISPLAY/VIEW. If this
 * build has no OpenColorIO, returns STATUS_NO_DEVICE. On failure, *view is zeroed. */
MUST_USE enum status ocio_view_load(struct ocio_view *view, const char *config, const char *name,
                                    const struct reader_params *params);

void ocio_view_finish(struct ocio_view *view);

/* Converts a linear colour to the encoded colour that the view shows, which may exceed 0 to 1.
 * Interpolates linearly in the lattice, from 0 to 147; brighter colours are clamped. */
void ocio_view_apply(const struct ocio_view *view, const float linear[static 3],
                     float shown[static 3]);

/* Bakes a view in the child process and sends its lattice. */
MUST_USE enum status ocio_view_send(const char *config, const char *name,
                                    const struct pipe_sink *sink);

#endif
