/* reloads.c: ring buffer of messages about slow changes. */
#include "src/view/reloads.h"
#include <stddef.h>
#include <stdio.h>

void reloads_add(struct reloads *reloads, const char *words)
{
    snprintf(reloads->words[reloads->count++ % RELOAD_COUNT], RELOAD_SIZE, "%s", words);
}

const char *reloads_at(const struct reloads *reloads, uint32_t ago)
{
    if (ago >= reloads->count || ago >= RELOAD_COUNT)
        return NULL;
    return reloads->words[(reloads->count - 1 - ago) % RELOAD_COUNT];
}
