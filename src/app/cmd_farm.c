/* cmd_farm.c: command firn farm: distributes a sequence with Slurm or GNU parallel. */
#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/app/app.h"
#include "src/app/farm_script.h"
#include "src/app/farm_status.h"
#include "src/app/sequence_frame_list.h"
#include "src/base/log.h"
#include "src/base/process.h"
#include "src/base/program.h"
#include "src/base/shell_quote.h"
#include "src/base/text_stream.h"

enum {
    NAME_SIZE = 64,
    FARM_TASKS = 100 /* default of --tasks */
};

/* ---- checks of the arguments ---- */

/* Refuses control characters in words of scripts, because file names may contain them. */
static enum status check_words(const struct app_options *o)
{
    for (char *const *word = o->run.args; *word; word++) {
        if (shell_has_control(*word)) {
            log_error("farm: '%s' contains control characters: rename the file", *word);
            return STATUS_USAGE;
        }
    }
    return STATUS_OK;
}

static enum status check_files(const struct app_options *o)
{
    for (uint32_t i = 0; i < o->run.outputs.count; i++) {
        if (!strcmp(o->run.outputs.paths[i], "-")) {
            log_error(
                "--output: expected a file name, got '-': the stdout of tasks is not collected");
            return STATUS_USAGE;
        }
    }
    if (o->render.frames)
        return STATUS_OK;
    log_error("--frames is missing: expected the frames to draw (see --help)");
    return STATUS_USAGE;
}

/* ---- scripts ---- */

/* Makes a job name from the leading letters and digits of the first output file's name. */
static void name_job(char name[static NAME_SIZE], const char *path)
{
    const char *slash = strrchr(path, '/');
    size_t length = 0;
    for (const char *c = slash ? slash + 1 : path; *c && length + 1 < NAME_SIZE; c++) {
        if (!isalnum((unsigned char)*c) && !strchr("-_", *c))
            break;
        name[length++] = *c;
    }
    if (!length || name[0] == '-')
        snprintf(name, NAME_SIZE, "firn");
    else
        name[length] = '\0';
}

/* Returns `called` (argv[0]) if it is absolute or the shell found the program in PATH, else the
 * absolute path. */
static const char *find_program(char path[static PROGRAM_PATH_SIZE], const char *called)
{
    const bool is_relative = called[0] != '/' && strchr(called, '/');
    return is_relative && program_path(path, NULL) ? path : called;
}

static enum status run_script(const char *text)
{
    int code;
    const int error = process_run_shell(text, &code);
    if (error) {
        log_error("cannot run /bin/sh: %s", strerror(error));
        return STATUS_FAILED;
    }
    if (code == 0)
        return STATUS_OK;
    log_error("--submit: the script failed; run without --submit to print it");
    return STATUS_FAILED;
}

static enum status make_script(const struct app_options *o, const struct sequence *sequence,
                               farm_script_fn *print)
{
    char name[NAME_SIZE], path[PROGRAM_PATH_SIZE];
    const uint32_t count = sequence->range.count;
    const uint32_t max_tasks = o->farm.task_count ? o->farm.task_count : FARM_TASKS;
    const struct farm_script script = {
        .options = o,
        .frame_count = count,
        .task_count = max_tasks < count ? max_tasks : count,
        .program = find_program(path, o->run.program),
        .name = name,
    };
    struct text_stream stream;
    enum status status = STATUS_OK;

    if (shell_has_control(script.program)) {
        log_error("farm: the path of firn contains control characters: install it elsewhere");
        return STATUS_USAGE;
    }
    name_job(name, o->run.outputs.paths[0]);
    FILE *out = text_stream_open(&stream);
    if (out)
        print(&script, out);
    char *text = text_stream_close(&stream, NULL);
    if (!text) {
        status = log_out_of_memory(NULL);
    } else if (o->farm.submit) {
        status = run_script(text);
    } else {
        fputs(text, stdout); /* standard_streams_end() checks for errors */
    }
    free(text);
    return status;
}

static enum status make_parallel(const struct app_options *o, const struct sequence *sequence)
{
    for (char *const *word = o->run.args; *word; word++) {
        if (strchr(*word, '{')) {
            log_error(
                "farm parallel: '%s' contains '{', which GNU parallel replaces; use another name",
                *word);
            return STATUS_USAGE;
        }
    }
    return make_script(o, sequence, farm_script_parallel);
}

static enum status make_slurm(const struct app_options *o, const struct sequence *sequence)
{
    return make_script(o, sequence, farm_script_slurm);
}

static const struct {
    const char *name;
    enum status (*run)(const struct app_options *o, const struct sequence *sequence);
    bool is_status;
} kinds[] = {
    { "slurm", make_slurm, false },
    { "parallel", make_parallel, false },
    { "status", farm_status, true },
};

enum status app_farm(const struct app_options *options)
{
    struct app_options o = *options;
    struct sequence sequence = { 0 };
    const char *kind = o.positionals[0];
    size_t k = 0;
    while (k < sizeof(kinds) / sizeof(kinds[0]) && (!kind || strcmp(kind, kinds[k].name) != 0))
        k++;
    if (k == sizeof(kinds) / sizeof(kinds[0])) {
        log_error("farm: expected slurm, parallel or status, got '%s' (see --help)",
                  kind ? kind : "");
        return STATUS_USAGE;
    }
    o.image.scene.name = o.positionals[1];
    enum status status = setup_require_scene(&o.image.scene);
    if (status == STATUS_OK)
        status = check_words(&o);
    if (status == STATUS_OK)
        status = check_files(&o);
    if (status == STATUS_OK)
        status = sequence_parse(&sequence, &o);
    if (status == STATUS_OK && !kinds[k].is_status)
        status = sequence_check(&sequence, &o);
    if (status == STATUS_OK)
        status = kinds[k].run(&o, &sequence);
    sequence_finish(&sequence);
    return status;
}
