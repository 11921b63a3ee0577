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

/* Checks that all outputs are different files and that no output overwrites an input. If not, logs
 * an error and returns STATUS_USAGE. Recognises different spellings of a path. Special files, such
 * as /dev/null, may be named several times. Opens no file. */
enum status option_check_files(const struct option_file *files, size_t count);

#endif
