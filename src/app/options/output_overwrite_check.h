/* output_overwrite_check.h: checks that no output of a command overwrites another of its files. */
#ifndef FIRN_APP_OPTIONS_OUTPUT_OVERWRITE_CHECK_H
#define FIRN_APP_OPTIONS_OUTPUT_OVERWRITE_CHECK_H

#include "src/app/options/option.h"

/* Set a string like option_text(). Options with option_input() name files that are read; options
 * with option_report() name files that are written. */
option_fn option_input, option_report;

/* A file that a command reads or writes. */
struct option_file {
    const char *option; /* option name; NULL for an argument */
    const char *path;   /* "-" (stdout) is not checked */
    bool is_written;
};

/* Refuses two outputs to one file, and an output that overwrites an input, even if their paths are
 * spelt differently. Files that are not regular, such as /dev/null, may be named several times.
 * Opens no file. Logs a conflict and returns STATUS_USAGE. */
enum status option_check_files(const struct option_file *files, size_t count);

#endif
