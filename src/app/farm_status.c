/* farm_status.c: which frames are done. */
#include "src/app/farm_status.h"
#include <jansson.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include "src/app/output.h"
#include "src/base/log.h"
#include "src/reader/picture_reader.h"

/* A frame is as its worst file. */
enum state {
    DONE,
    STALE, /* whole, but of other settings, or by another version of firn */
    DAMAGED,
    MISSING,
    STATE_COUNT,
};

static const struct {
    const char *name, *words;
} states[STATE_COUNT] = {
    [DONE] = { "done", "" },
    [STALE] = { "stale", "complete, but made with other settings or another version of firn" },
    [DAMAGED] = { "damaged", "" },
    [MISSING] = { "missing", "" },
};

struct look {
    struct app_picture picture; /* its scene settles some of it; no name: there is none */
    const struct app_outputs *outputs;
    const struct sequence *sequence;
    struct scene scene;
    struct camera camera;
    char *newest[APP_OUTPUT_COUNT]; /* without a scene: settings of the newest file; may be NULL */
    enum state *frames;
    uint32_t counts[STATE_COUNT];
};

/* ---- files ---- */

/* The settings that a file was made with, without what differs from frame to frame; NULL if memory
 * is short. */
static char *copy_settings(const struct picture_head *head)
{
    static const char time[] = " motion.time=";
    const char *settings = picture_head_text(head, "firn/settings");
    char *text = strdup(settings ? settings : "");
    char *at = text ? strstr(text, time) : NULL;
    if (at) {
        const char *end = at + sizeof(time) - 1;
        end += strcspn(end, " ");
        memmove(at, end, strlen(end) + 1);
    }
    return text;
}

static enum state judge(const struct look *look, const struct output *output, uint32_t i,
                        const char *path)
{
    struct picture_head head;
    if (access(path, F_OK) != 0)
        return MISSING;
    if (picture_check(&head, path, &look->picture.scene.reader) != STATUS_OK)
        return DAMAGED;
    bool same = output && output_is_current(output, path, &head);
    if (!output) {
        char *settings = copy_settings(&head);
        same = settings && look->newest[i] && !strcmp(settings, look->newest[i]);
        free(settings);
    }
    picture_head_finish(&head);
    return same ? DONE : STALE;
}

static enum status look_at_frame(struct look *look, uint32_t index)
{
    const int32_t number = look->sequence->range.frames[index];
    struct output output = {
        .picture = &look->picture,
        .scene = &look->scene,
        .shot = { .camera = look->camera,
                  .time = (float)sequence_time(&look->picture.scene.settings, number) },
    };
    const bool has_scene = look->picture.scene.name != NULL;
    enum status status = has_scene ? output_describe(&output) : STATUS_OK;
    enum state worst = DONE;
    for (uint32_t i = 0; i < look->outputs->count && status == STATUS_OK; i++) {
        char *path = frame_name_make(&look->sequence->names[i], number);
        const enum state state = path ? judge(look, has_scene ? &output : NULL, i, path) : DONE;
        worst = state > worst ? state : worst;
        if (!path)
            status = log_out_of_memory(NULL);
        free(path);
    }
    look->frames[index] = worst;
    look->counts[worst]++;
    output_finish(&output);
    return status;
}

/* The newest that can be read. */
static enum status find_newest(struct look *look, uint32_t i)
{
    struct timespec best = { 0 };
    for (uint32_t f = 0; f < look->sequence->range.count; f++) {
        char *path = frame_name_make(&look->sequence->names[i], look->sequence->range.frames[f]);
        struct stat info;
        if (!path)
            return log_out_of_memory(NULL);
        const bool newer =
            stat(path, &info) == 0 && S_ISREG(info.st_mode) &&
            (info.st_mtim.tv_sec > best.tv_sec ||
             (info.st_mtim.tv_sec == best.tv_sec && info.st_mtim.tv_nsec > best.tv_nsec));
        struct picture_head head;
        if (newer && picture_check(&head, path, &look->picture.scene.reader) == STATUS_OK) {
            best = info.st_mtim;
            free(look->newest[i]);
            look->newest[i] = copy_settings(&head);
            picture_head_finish(&head);
        }
        free(path);
    }
    return STATUS_OK;
}

/* ---- words ---- */

/* As --frames takes them, from `begin` on: the index after those that it could say at once. */
static uint32_t print_run(const struct look *look, uint32_t begin, enum state state)
{
    const int32_t *frames = look->sequence->range.frames;
    const uint32_t count = look->sequence->range.count;
    const int64_t step = begin + 1 < count ? (int64_t)frames[begin + 1] - frames[begin] : 1;
    uint32_t end = begin + 1;
    while (end < count && look->frames[end] == state &&
           (int64_t)frames[end] - frames[end - 1] == step)
        end++;
    printf("%d", (int)frames[begin]);
    if (end - begin > 1)
        printf("-%d", (int)frames[end - 1]);
    if (end - begin > 1 && step != 1 && step != -1)
        printf("x%lld", (long long)llabs(step));
    return end;
}

static void print_text(const struct look *look)
{
    for (int state = 0; state < STATE_COUNT; state++) {
        const char *before = "  ";
        if (!look->counts[state])
            continue;
        printf("%-7s %6u", states[state].name, look->counts[state]);
        for (uint32_t i = 0; i < look->sequence->range.count;) {
            if (look->frames[i] != (enum state)state) {
                i++;
                continue;
            }
            printf("%s", before);
            before = ",";
            i = print_run(look, i, (enum state)state);
        }
        printf("%s%s\n", states[state].words[0] ? "  " : "", states[state].words);
    }
}

static enum status print_json(const struct look *look)
{
    json_t *frames = json_array();
    bool ok = frames != NULL;
    for (uint32_t i = 0; i < look->sequence->range.count && ok; i++)
        ok = json_array_append_new(frames, json_pack("{s:i, s:s}", "frame",
                                                     (int)look->sequence->range.frames[i], "state",
                                                     states[look->frames[i]].name)) == 0;
    json_t *json =
        ok ? json_pack("{s:i, s:i, s:i, s:i, s:O}", "done", (int)look->counts[DONE], "stale",
                       (int)look->counts[STALE], "damaged", (int)look->counts[DAMAGED], "missing",
                       (int)look->counts[MISSING], "frames", frames)
           : NULL;
    char *text = json ? json_dumps(json, JSON_INDENT(2)) : NULL;
    if (text)
        printf("%s\n", text);
    ok = text != NULL;
    free(text);
    json_decref(json);
    json_decref(frames);
    return ok ? STATUS_OK : log_out_of_memory(NULL);
}

/* ---- all of it ---- */

static enum status look_at_all(struct look *look)
{
    const uint32_t count = look->sequence->range.count;
    struct app_picture *picture = &look->picture;
    enum status status = STATUS_OK;
    look->frames = calloc(count, sizeof(*look->frames));
    if (!look->frames)
        return log_out_of_memory(NULL);
    if (picture->scene.name) {
        status = app_begin_scene(&look->scene, &picture->scene);
        if (status == STATUS_OK)
            status = app_camera(&look->camera, &look->scene, picture);
        if (status == STATUS_OK)
            app_choose_rung(picture, &look->scene, &look->camera);
        if (status == STATUS_OK)
            status = output_check_tiles(picture, look->outputs);
    } else {
        for (uint32_t i = 0; i < look->outputs->count && status == STATUS_OK; i++)
            status = find_newest(look, i);
    }
    for (uint32_t i = 0; i < count && status == STATUS_OK; i++)
        status = look_at_frame(look, i);
    return status;
}

enum status farm_status(const struct app_options *options, const struct sequence *sequence)
{
    struct look look = {
        .picture = options->picture,
        .outputs = &options->run.outputs,
        .sequence = sequence,
    };
    enum status status = look_at_all(&look);
    if (status == STATUS_OK && options->run.format == APP_FORMAT_JSON)
        status = print_json(&look);
    else if (status == STATUS_OK)
        print_text(&look);
    if (status == STATUS_OK && look.counts[DONE] < sequence->range.count)
        status = STATUS_FAILED;
    for (uint32_t i = 0; i < APP_OUTPUT_COUNT; i++)
        free(look.newest[i]);
    free(look.frames);
    scene_finish(&look.scene);
    return status;
}
