/*
 * preset.h: settings from a file, through a reader process (reader.h, with its errors).
 *
 * A file whose name ends in .exr or .png is a picture of firn, whose settings are taken. Any other
 * file is text: NAME=VALUE on each line, blank lines, and lines that begin with '#'. Whether there
 * are such settings is not looked at here.
 */
#ifndef FIRN_READER_PRESET_H
#define FIRN_READER_PRESET_H

#include "src/reader/reader.h"

enum {
    PRESET_LINE_COUNT_MAX = 1 << 16,
    PRESET_LINE_SIZE = 512, /* bytes of an assignment, '\0' included */
};

struct preset_line {
    uint32_t number; /* of the line in the file, from 1; 0: the file is a picture */
    char assignment[PRESET_LINE_SIZE]; /* "name=value", printable ASCII */
};

struct preset {
    struct preset_line *lines;
    uint32_t count;
};

/* Reads a file. On failure *preset is {0}. */
MUST_USE enum status preset_read(struct preset *preset, const char *path,
                                 const struct reader_params *params);

void preset_finish(struct preset *preset); /* {0} is fine */

/* ---- in the child ---- */

/* Parses a file. On failure *preset is {0}. */
MUST_USE enum status preset_load(struct preset *preset, const char *path);

MUST_USE enum status preset_send(const char *path, const struct pipe_sink *sink);

/* ---- both ---- */

MUST_USE bool preset_pipe_write(const struct pipe_sink *sink, const struct preset *preset);
MUST_USE enum pipe_fault preset_pipe_read(const struct pipe_source *source, struct preset *preset);

#endif
