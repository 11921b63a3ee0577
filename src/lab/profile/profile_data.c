/* profile_data.c: allocates and frees struct profile. */
#include "src/lab/profile/profile_data.h"
#include <stdio.h>
#include <stdlib.h>
#include "src/base/log.h"

enum {
    ROWS_AFTER_PASSES = 3
};

static bool make_samples(struct profile_row *row, uint32_t run_count)
{
    row->ms = calloc(run_count, sizeof(*row->ms));
    row->begin_ms = calloc(run_count, sizeof(*row->begin_ms));
    row->record_ms = calloc(run_count, sizeof(*row->record_ms));
    return row->ms && row->begin_ms && row->record_ms;
}

enum status profile_make_rows(struct profile *p)
{
    static const struct {
        const char *name;
        enum profile_kind kind;
    } after[ROWS_AFTER_PASSES] = {
        { "record", PROFILE_HOST },
        { "submit", PROFILE_HOST },
        { "unattributed", PROFILE_UNATTRIBUTED },
    };

    bool is_made = true;
    p->rows = calloc((size_t)p->pass_count + ROWS_AFTER_PASSES, sizeof(*p->rows));
    p->row_count = p->rows ? p->pass_count + ROWS_AFTER_PASSES : 0;
    p->frame = calloc(p->run_count, sizeof(*p->frame));
    p->plain = calloc(p->run_count, sizeof(*p->plain));
    p->wait = calloc(p->run_count, sizeof(*p->wait));
    for (uint32_t i = 0; i < p->row_count; i++)
        is_made = make_samples(&p->rows[i], p->run_count) && is_made;
    for (uint32_t i = 0; i < ROWS_AFTER_PASSES && p->rows; i++) {
        struct profile_row *row = &p->rows[p->pass_count + i];
        snprintf(row->name, sizeof(row->name), "%s", after[i].name);
        row->kind = after[i].kind;
        row->repetition_count = 1;
    }
    if (p->rows && p->frame && p->plain && p->wait && is_made)
        return STATUS_OK;
    return log_out_of_memory(NULL);
}

void profile_finish(struct profile *p)
{
    for (uint32_t i = 0; i < p->row_count; i++) {
        free(p->rows[i].ms);
        free(p->rows[i].begin_ms);
        free(p->rows[i].record_ms);
    }
    free(p->rows);
    free(p->residents);
    free(p->settings);
    free(p->frame);
    free(p->plain);
    free(p->wait);
    free(p->command);
    free(p->scene);
    *p = (struct profile){ 0 };
}
