/*
 * preset.h: presets: settings stored in a text file or an image, read in a reader process
 * (reader_process.h).
 *
 * A file with the suffix .exr or .png is an image written by firn, whose metadata holds settings.
 * Any other file is text: lines NAME=VALUE, blank lines, and comment lines that begin with '#'.
 * Setting names are not checked here.
 */
#ifndef FIRN_FILE_PRESET_H
#define FIRN_FILE_PRESET_H

#include "src/file/reader_process.h"

enum {
    PRESET_LINE_COUNT_MAX = 1 << 16,
    PRESET_LINE_SIZE = 512, /* bytes of an assignment with '\0' */
};

struct preset_line {
    uint32_t number;                   /* from 1; 0 for an image */
    char assignment[PRESET_LINE_SIZE]; /* "name=value", printable ASCII */
};

struct preset {
    struct preset_line *lines;
    uint32_t count;
};

/* Reads a preset file in a reader process. On failure *preset is zeroed. */
MUST_USE enum status preset_read(struct preset *preset, const char *path,
                                 const struct reader_params *params);

void preset_finish(struct preset *preset); /* {0} is fine */

/* Parses a preset file, in the child process. On failure *preset is zeroed. */
MUST_USE enum status preset_parse(struct preset *preset, const char *path);

MUST_USE enum status preset_send(const char *path, const struct pipe_sink *sink);

MUST_USE bool preset_pipe_write(const struct pipe_sink *sink, const struct preset *preset);
MUST_USE enum pipe_fault preset_pipe_read(const struct pipe_source *source, struct preset *preset);

#endif
