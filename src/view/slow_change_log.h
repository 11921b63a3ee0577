/* slow_change_log.h: log of recent changes that rebuilt the scene or a render-graph plan. */
#ifndef FIRN_VIEW_SLOW_CHANGE_LOG_H
#define FIRN_VIEW_SLOW_CHANGE_LOG_H

#include <stdint.h>

enum {
    REBUILD_LOG_COUNT = 8,  /* older messages are dropped */
    REBUILD_LOG_SIZE = 200, /* maximum bytes; longer messages are truncated */
};

struct rebuild_log {
    char messages[REBUILD_LOG_COUNT][REBUILD_LOG_SIZE]; /* ring buffer */
    uint32_t count;                                     /* messages added in total */
};

void rebuild_log_add(struct rebuild_log *log, const char *message);

/* Returns the message that is `ago` messages older than the newest; NULL if there is none. */
const char *rebuild_log_at(const struct rebuild_log *log, uint32_t ago);

#endif
