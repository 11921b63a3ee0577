/*
 * session_file.h: session file: scene, settings, camera and time of a window, to be opened again.
 *
 * It has one line NAME=VALUE per entry, like a preset: settings by name, and the entries of
 * session_file.c. Non-ASCII bytes and '%' in names are percent-encoded. A reader process splits the
 * file into lines (preset.h); values are checked here.
 */
#ifndef FIRN_VIEW_SESSION_SESSION_FILE_H
#define FIRN_VIEW_SESSION_SESSION_FILE_H

#include <stdio.h>
#include "src/file/preset.h"
#include "src/scene/camera.h"
#include "src/scene/geometry/object_transform.h"
#include "src/settings/settings.h"
#include "src/setup/setup.h"

struct technique;

struct session_file {
    struct preset lines;     /* owns the strings */
    const char *scene;       /* name or file; NULL if missing */
    const char *environment; /* NULL to use the scene's own */
    float env_rotate;        /* degrees */
    float env_exposure;      /* stops */
    const struct technique *refraction;
    struct settings settings;
    struct camera camera; /* .fov_deg 0 if missing */
    float time;           /* scene time, seconds */
    struct object_transform object_transforms[SETUP_NODE_COUNT];
    uint32_t object_transform_count;
};

/* Parses a session file and takes ownership of `lines`. `path` is the file name in messages. On
 * failure, logs an error, zeroes *session and returns STATUS_DATA. */
MUST_USE enum status session_file_parse(struct session_file *session, struct preset *lines,
                                        const char *path);

void session_file_print(const struct session_file *session, FILE *out);
void session_file_finish(struct session_file *session); /* {0} is fine */

#endif
