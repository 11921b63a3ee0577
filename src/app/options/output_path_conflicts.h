/* output_path_conflicts.h: checks that outputs of a command do not overwrite its other files. */
#ifndef FIRN_APP_OPTIONS_OUTPUT_PATH_CONFLICTS_H
#define FIRN_APP_OPTIONS_OUTPUT_PATH_CONFLICTS_H

#include "src/app/options/option.h"

/* Setters of file paths: option_input for a file that is read, option_report for one written. */
option_fn option_input, option_report;

/* A file that a command reads or writes. */
struct option_file {
    const char *option; /* option name; NULL for an argument */
    const char *path;   /* "-" (stdout) is not checked */
    bool is_written;
};

/* Logs and returns STATUS_USAGE if two outputs go to one file, or an output overwrites an input.
 * Recognises different spellings of a path. Files that are not regular, such as /dev/null, may be
 * named several times. Opens no file. */
enum status option_check_files(const struct option_file *files, size_t count);

#endif
