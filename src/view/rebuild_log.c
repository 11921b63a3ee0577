/* rebuild_log.c: ring buffer of messages about slow changes. */
#include "src/view/rebuild_log.h"
#include <stddef.h>
#include <stdio.h>

void rebuild_log_add(struct rebuild_log *reloads, const char *words)
{
    snprintf(reloads->words[reloads->count++ % REBUILD_LOG_COUNT], REBUILD_LOG_SIZE, "%s", words);
}

const char *rebuild_log_at(const struct rebuild_log *reloads, uint32_t ago)
{
    if (ago >= reloads->count || ago >= REBUILD_LOG_COUNT)
        return NULL;
    return reloads->words[(reloads->count - 1 - ago) % REBUILD_LOG_COUNT];
}
