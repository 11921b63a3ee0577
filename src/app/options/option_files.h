/* option_files.h: files that a command line names, and whether writing one destroys another. */
#ifndef FIRN_APP_OPTIONS_OPTION_FILES_H
#define FIRN_APP_OPTIONS_OPTION_FILES_H

#include "src/app/options/option.h"

/* Set a text as option_text() does. A row with option_input names a file that is read, a row with
 * option_report one that is written. */
option_fn option_input, option_report;

/* A file that a command reads or writes. */
struct option_file {
    const char *option; /* its name, without dashes; NULL: the file is an argument */
    const char *path;   /* "-" is stdout, which is no file here */
    bool is_written;
};

/* Refuses two outputs with one file, and an output whose file is an input, whatever their paths
 * are. Files that are not regular, such as /dev/null, may be named several times. Opens no file.
 * Logs: STATUS_USAGE. */
enum status option_check_files(const struct option_file *files, size_t count);

#endif
