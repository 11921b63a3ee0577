/* render_report.c: JSON report of what firn render did with each frame. */
#include "src/app/render_report.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/file/json_text.h"
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

static json_t *files_of(const struct sequence *sequence, uint32_t output_count, int32_t frame)
{
    json_t *files = json_array();
    for (uint32_t i = 0; i < output_count && files; i++) {
        char *path = frame_name_make(&sequence->names[i], frame);
        files = json_text_append(files, path ? json_text_string(path) : NULL);
        free(path);
    }
    return files;
}

static json_t *frame_of(const struct render_report_frame *frame, int32_t number, json_t *files)
{
    return json_pack("{s:i, s:s, s:f, s:s*, s:o}", "frame", (int)number, "state",
                     state_names[frame->state], "seconds", frame->seconds, "hash",
                     frame->hash[0] ? frame->hash : NULL, "files", files);
}

static json_t *position_of(const double position[3])
{
    return json_pack("[f, f, f]", position[0], position[1], position[2]);
}

char *render_report_json(const struct report *report, const struct sequence *sequence,
                         const struct app_options *o, int code, size_t *size)
{
    json_t *frames = json_array();
    for (uint32_t i = 0; i < report->count && frames; i++) {
        const int32_t number = sequence->range.frames[i];
        frames =
            json_text_append(frames, frame_of(&report->frames[i], number,
                                              files_of(sequence, o->run.outputs.count, number)));
    }
    const struct render_report_view *view = &report->view;
    json_t *json =
        json_pack("{s:s, s:o, s:i, s:{s:o, s:o, s:f}, s:f, s:o}", "version", FIRN_VERSION, "scene",
                  json_text_string(o->image.scene.name), "code", code, "camera", "eye",
                  position_of(view->eye), "target", position_of(view->target), "fov", view->fov_deg,
                  "exposure", view->exposure, "frames", frames);
    char ground[SETUP_GROUND_NAME_SIZE];
    const struct stage_params *stage = &o->image.scene.stage;
    if (json && stage->ground != STAGE_AUTO)
        (void)json_object_set_new(json, "ground", json_string(setup_ground_name(stage, ground)));
    if (json && o->image.scene.environment)
        (void)json_object_set_new(json, "env", json_text_string(o->image.scene.environment));
    char *text = json ? json_dumps(json, JSON_INDENT(2) | JSON_REAL_PRECISION(6)) : NULL;
    json_decref(json);
    *size = text ? strlen(text) + 1 : 0;
    if (text)
        text[*size - 1] = '\n'; /* replaces the terminating 0 */
    return text;
}
