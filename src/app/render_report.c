/* render_report.c: JSON report of what firn render did with each frame. */
#include "src/app/render_report.h"
#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/version.h"

static const char *const state_names[RENDER_REPORT_STATE_COUNT] = {
    [RENDER_REPORT_NOT_STARTED] = "left",
    [RENDER_REPORT_DRAWN] = "drawn",
    [RENDER_REPORT_CURRENT] = "current",
    [RENDER_REPORT_FAILED] = "failed",
};

enum status render_report_init(struct report *report, uint32_t count)
{
    *report = (struct report){ .frames = calloc(count + 1, sizeof(*report->frames)) };
    if (!report->frames) {
        return log_out_of_memory(NULL);
    }
    report->count = count;
    return STATUS_OK;
}

void render_report_finish(struct report *report)
{
    free(report->frames);
    *report = (struct report){ 0 };
}

static uint64_t add_text(uint64_t hash, const char *text)
{
    /* hashes the terminating 0 as well, so that "a" "bc" and "ab" "c" differ */
    for (size_t i = 0; i <= strlen(text); i++)
        hash = (hash ^ (unsigned char)text[i]) * UINT64_C(0x100000001b3);
    return hash;
}

void render_report_hash(const char *settings, char hash[static 17])
{
    const uint64_t start = UINT64_C(0xcbf29ce484222325);
    snprintf(hash, 17, "%016llx",
             (unsigned long long)add_text(add_text(start, FIRN_VERSION), settings));
}

bool render_report_is_mixed(const struct report *report)
{
    uint32_t counts[RENDER_REPORT_STATE_COUNT] = { 0 };
    for (uint32_t i = 0; i < report->count; i++)
        counts[report->frames[i].state]++;
    return counts[RENDER_REPORT_FAILED] > 0 &&
           counts[RENDER_REPORT_DRAWN] + counts[RENDER_REPORT_CURRENT] > 0;
}

/* Returns a JSON string. If the text is not UTF-8, non-ASCII bytes become '?'. */
static json_t *word(const char *text)
{
    json_t *json = json_string(text);
    char *copy = json ? NULL : strdup(text);
    for (char *c = copy; c && *c; c++) {
        if ((unsigned char)*c >= 0x80)
            *c = '?';
    }
    if (copy)
        json = json_string(copy);
    free(copy);
    return json;
}

static json_t *files_of(const struct sequence *sequence, uint32_t output_count, int32_t frame)
{
    json_t *files = json_array();
    for (uint32_t i = 0; i < output_count && files; i++) {
        char *path = frame_name_make(&sequence->names[i], frame);
        const bool ok = path && json_array_append_new(files, word(path)) == 0;
        free(path);
        if (!ok) {
            json_decref(files);
            files = NULL;
        }
    }
    return files;
}

static json_t *frame_of(const struct render_report_frame *frame, int32_t number, json_t *files)
{
    return json_pack("{s:i, s:s, s:f, s:s*, s:o}", "frame", (int)number, "state",
                     state_names[frame->state], "seconds", frame->seconds, "hash",
                     frame->hash[0] ? frame->hash : NULL, "files", files);
}

char *render_report_json(const struct report *report, const struct sequence *sequence,
                         const struct app_options *o, int code, size_t *size)
{
    json_t *frames = json_array();
    bool ok = frames != NULL;
    for (uint32_t i = 0; i < report->count && ok; i++) {
        const int32_t number = sequence->range.frames[i];
        json_t *files = files_of(sequence, o->run.outputs.count, number);
        ok = files &&
             json_array_append_new(frames, frame_of(&report->frames[i], number, files)) == 0;
    }
    json_t *json = ok ? json_pack("{s:s, s:o, s:i, s:O}", "version", FIRN_VERSION, "scene",
                                  word(o->image.scene.name), "code", code, "frames", frames)
                      : NULL;
    char *text = json ? json_dumps(json, JSON_INDENT(2) | JSON_REAL_PRECISION(6)) : NULL;
    json_decref(json);
    json_decref(frames);
    *size = text ? strlen(text) + 1 : 0;
    if (text)
        text[*size - 1] = '\n'; /* replaces the terminating 0 */
    return text;
}
