/* farm_status.c: finds out which frames of a sequence are complete. */
#include "src/app/farm_status.h"
#include <jansson.h>
#include <stdlib.h>
#include "src/base/file_info.h"
#include "src/base/log.h"
#include "src/file/image_receive.h"
#include "src/setup/image_output.h"

/* States of a file, from best to worst. A frame has the state of its worst file. */
enum state {
    DONE,
    STALE, /* complete, but with other settings */
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

struct job {
    struct setup_image image;
    const struct setup_outputs *outputs;
    const struct sequence *sequence;
    struct scene scene;
    struct camera camera;
    enum state *frames;
    uint32_t counts[STATE_COUNT];
};

/* ---- files ---- */

static enum state check_file(const struct job *job, const struct output *output, const char *path)
{
    struct image_header head;
    if (file_info_of(path).kind == FILE_MISSING)
        return MISSING;
    if (image_reader_check(&head, path, &job->image.scene.reader) != STATUS_OK)
        return DAMAGED;
    const bool same = output_is_current(output, path, &head);
    image_header_finish(&head);
    return same ? DONE : STALE;
}

static enum status check_frame(struct job *job, uint32_t index)
{
    const int32_t number = job->sequence->range.frames[index];
    struct output output = {
        .image = &job->image,
        .scene = &job->scene,
        .shot = { .camera = job->camera,
                  .time = (float)sequence_time(&job->image.scene.settings, number) },
    };
    enum status status = output_describe(&output);
    enum state worst = DONE;
    for (uint32_t i = 0; i < job->outputs->count && status == STATUS_OK; i++) {
        char *path = frame_name_make(&job->sequence->names[i], number);
        const enum state state = path ? check_file(job, &output, path) : DONE;
        worst = state > worst ? state : worst;
        if (!path)
            status = log_out_of_memory(NULL);
        free(path);
    }
    job->frames[index] = worst;
    job->counts[worst]++;
    output_finish(&output);
    return status;
}

/* ---- report ---- */

/* Prints frames of equal state from index `begin`, such as "1-9x2". Returns the next index. */
static uint32_t print_run(const struct job *job, uint32_t begin, enum state state)
{
    const int32_t *frames = job->sequence->range.frames;
    const uint32_t count = job->sequence->range.count;
    const int64_t step = begin + 1 < count ? (int64_t)frames[begin + 1] - frames[begin] : 1;
    uint32_t end = begin + 1;
    while (end < count && job->frames[end] == state &&
           (int64_t)frames[end] - frames[end - 1] == step)
        end++;
    printf("%d", (int)frames[begin]);
    if (end - begin > 1)
        printf("-%d", (int)frames[end - 1]);
    if (end - begin > 1 && step != 1 && step != -1)
        printf("x%lld", (long long)llabs(step));
    return end;
}

static void print_text(const struct job *job)
{
    for (int state = 0; state < STATE_COUNT; state++) {
        const char *before = "  ";
        if (!job->counts[state])
            continue;
        printf("%-7s %6u", states[state].name, job->counts[state]);
        for (uint32_t i = 0; i < job->sequence->range.count;) {
            if (job->frames[i] != (enum state)state) {
                i++;
                continue;
            }
            printf("%s", before);
            before = ",";
            i = print_run(job, i, (enum state)state);
        }
        printf("%s%s\n", states[state].words[0] ? "  " : "", states[state].words);
    }
}

static enum status print_json(const struct job *job)
{
    json_t *frames = json_array();
    bool ok = frames != NULL;
    for (uint32_t i = 0; i < job->sequence->range.count && ok; i++)
        ok = json_array_append_new(frames, json_pack("{s:i, s:s}", "frame",
                                                     (int)job->sequence->range.frames[i], "state",
                                                     states[job->frames[i]].name)) == 0;
    json_t *json =
        ok ? json_pack("{s:i, s:i, s:i, s:i, s:O}", "done", (int)job->counts[DONE], "stale",
                       (int)job->counts[STALE], "damaged", (int)job->counts[DAMAGED], "missing",
                       (int)job->counts[MISSING], "frames", frames)
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

/* ---- all frames ---- */

static enum status check_frames(struct job *job)
{
    const uint32_t count = job->sequence->range.count;
    struct setup_image *image = &job->image;
    enum status status;
    job->frames = calloc(count, sizeof(*job->frames));
    if (!job->frames)
        return log_out_of_memory(NULL);
    status = setup_begin_scene(&job->scene, &image->scene);
    if (status == STATUS_OK)
        status = setup_camera(&job->camera, &job->scene, image);
    if (status == STATUS_OK)
        status = setup_choose_exposure(image, &job->scene, &job->camera);
    if (status == STATUS_OK)
        setup_choose_refraction(image, &job->scene, &job->camera);
    if (status == STATUS_OK)
        status = output_check_tiles(image, job->outputs);
    for (uint32_t i = 0; i < count && status == STATUS_OK; i++)
        status = check_frame(job, i);
    return status;
}

enum status farm_status(const struct app_options *options, const struct sequence *sequence)
{
    struct job job = {
        .image = options->image,
        .outputs = &options->run.outputs,
        .sequence = sequence,
    };
    enum status status = check_frames(&job);
    if (status == STATUS_OK && options->run.format == APP_FORMAT_JSON)
        status = print_json(&job);
    else if (status == STATUS_OK)
        print_text(&job);
    if (status == STATUS_OK && job.counts[DONE] < sequence->range.count)
        status = STATUS_FAILED;
    free(job.frames);
    scene_finish(&job.scene);
    return status;
}
