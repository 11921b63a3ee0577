/* program.h: paths of files that are installed with the running program. */
#ifndef FIRN_BASE_PROGRAM_H
#define FIRN_BASE_PROGRAM_H

#include <stdbool.h>

enum {
    PROGRAM_PATH_SIZE = 4096
};

/* Writes the path of a file whose name is relative to the program's folder, such as
 * "../share/firn"; NULL for the program itself. Returns false if the folder is unknown or the path
 * is too long. */
bool program_path(char path[static PROGRAM_PATH_SIZE], const char *relative);

#endif
