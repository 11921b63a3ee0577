/*
 * sums_file.h: the sums of a reference in a file beside its picture, from which --resume goes on.
 *
 * The file of a.exr is a.sums.exr: planes as reference_sums.h says, and the picture's texts. It is
 * read by a reader process, as all files that others may have made.
 */
#ifndef FIRN_APP_SUMS_FILE_H
#define FIRN_APP_SUMS_FILE_H

#include "src/app/output.h"
#include "src/app/signals.h"
#include "src/reference/reference.h"

struct sums_file {
    const char *path; /* option_sums_file() of the picture */
    const struct output *output;
    const char *device;
    struct signals *stop; /* held while the file is written */
    double written;       /* clock_seconds() at the end of the last write; 0: none */
    double cost;          /* seconds of that write */
};

/* A reference_load_fn: `user` is the struct sums_file. The sums of another picture or version, or
 * of more samples, are refused: STATUS_DATA. Without a file there are no samples. Logs. */
MUST_USE enum status sums_file_load(void *user, struct reference_sums *sums);

/* A reference_keep_fn: writes the file, unless it took a tenth of the time since the last write or
 * more and is not the last. Logs. */
MUST_USE enum status sums_file_keep(void *user, const struct reference_sums *sums, bool is_last);

#endif
