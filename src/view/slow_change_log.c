/* slow_change_log.c: ring buffer of messages about rebuilds. */
#include "src/view/slow_change_log.h"
#include <stddef.h>
#include <stdio.h>

void rebuild_log_add(struct rebuild_log *log, const char *message)
{
    snprintf(log->messages[log->count++ % REBUILD_LOG_COUNT], REBUILD_LOG_SIZE, "%s", message);
}

const char *rebuild_log_at(const struct rebuild_log *log, uint32_t ago)
{
    if (ago >= log->count || ago >= REBUILD_LOG_COUNT)
        return NULL;
    return log->messages[(log->count - 1 - ago) % REBUILD_LOG_COUNT];
}
