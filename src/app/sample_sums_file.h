/* sample_sums_file.h: stores the sample sums of a path-traced image, which --resume continues. The
 * sums of a.exr are in a.sums.exr, with the metadata of a.exr. reference_sample_sums.h describes
 * the planes. A sandboxed reader process parses a.sums.exr. */
#ifndef FIRN_APP_SAMPLE_SUMS_FILE_H
#define FIRN_APP_SAMPLE_SUMS_FILE_H

#include "src/base/signals.h"
#include "src/lab/reference/reference.h"
#include "src/setup/image_output.h"

struct sample_sums_file {
    const char *path; /* option_sums_file() of the image */
    const struct output *output;
    const char *device;
    struct signals *stop; /* held while the file is written */
    double written;       /* last write, seconds; 0 before */
    double cost;          /* its duration, seconds */
};

/* Implements reference_load_fn; `user` is a struct sample_sums_file. If the file is missing, loads
 * 0 samples. Refuses too many samples, and sums of another image or firn version. */
MUST_USE enum status sample_sums_file_load(void *user, struct reference_sums *sums);

/* Implements reference_save_fn. Always writes the last sums. Writes earlier sums only while writing
 * takes at most a tenth of the run time. Logs errors. */
MUST_USE enum status sample_sums_file_store(void *user, const struct reference_sums *sums,
                                            bool is_last);

#endif
