/*
 * session.h: all that a window shows, as a file that can be opened again.
 *
 * A line of text for each thing, NAME=VALUE, as in a preset: settings by their names, those of B
 * behind "b."; and what session.c's table has. Bytes of names that are not ASCII, and '%', are %XX.
 *
 * The file is split into lines by a reader process (preset.h). What it says is checked here.
 */
#ifndef FIRN_VIEW_SESSION_H
#define FIRN_VIEW_SESSION_H

#include <stdio.h>
#include "src/reader/preset.h"
#include "src/scene/camera.h"
#include "src/view/history.h"

enum {
    SESSION_BOOKMARK_COUNT = 4,
};

struct session {
    struct preset lines;     /* own the names */
    const char *scene;       /* an asset, a built-in scene or a file; NULL: not said */
    const char *environment; /* NULL: the scene's own */
    float env_exposure;      /* stops */
    struct view_state state;
    bool has_camera;
    struct camera camera;
    bool bookmarked[SESSION_BOOKMARK_COUNT];
    struct camera bookmarks[SESSION_BOOKMARK_COUNT];
    float time; /* of the scene, seconds */
};

/* Parses lines, which it takes over; `path` is for messages. Logs: STATUS_DATA. On failure *session
 * is {0}, and so it may be before. */
MUST_USE enum status session_parse(struct session *session, struct preset *lines, const char *path);

void session_print(const struct session *session, FILE *out);
void session_finish(struct session *session); /* {0} is fine */

#endif
