/* app.h: the program's commands, and the parsed command-line options. */
#ifndef FIRN_APP_APP_H
#define FIRN_APP_APP_H

#include <stdbool.h>
#include <stdio.h>
#include "graph/rg_profile.h"
#include "src/base/status.h"
#include "src/lab/metric/layer_comparison.h"
#include "src/setup/setup.h"

enum {
    APP_POSITIONAL_COUNT = 256, /* positional arguments, including the final NULL */
    APP_SWEEP_COUNT = 4,        /* maximum number of --sweep */
    APP_SBATCH_COUNT = 16,      /* maximum number of --sbatch */
    APP_PROFILE_THRESHOLD = 5,  /* default of --threshold, percent */
};

/* Output format of commands that print. */
enum app_format {
    APP_FORMAT_TEXT,
    APP_FORMAT_JSON,
    APP_FORMAT_HTML,
    APP_FORMAT_PRESET,
    APP_FORMAT_COUNT,
};

/* Device, output files and format of a command. */
struct app_run {
    struct gpu_params gpu;
    struct setup_outputs outputs;
    enum app_format format;
    bool quiet;
    const char *program; /* argv[0] */
    char *const *args;   /* from the command on; NULL-terminated */
};

/* Options of firn render. Of these, firn farm accepts only --frames. */
struct app_render {
    const char *frames;          /* unparsed; NULL: a single image */
    uint32_t chunk, chunk_count; /* chunk number from 1; 0: all */
    bool resume;
    bool keep_sums;        /* see sample_sums_file.h */
    double noise, seconds; /* noise and time limits of the path tracer; 0 means no limit */
    const char *json;      /* report file, or NULL */
};

/* Options of firn profile. */
struct app_profile {
    enum rg_clock clock; /* RG_CLOCK_NONE: chosen by the device's type */
    uint32_t warmup, run_count;
    double time_step;               /* seconds of scene time per run */
    const char *json, *csv, *trace; /* report files, or NULL */
    const char *baseline;           /* profile to compare with, or NULL */
    double threshold;               /* smallest relevant change of a median, percent */
    bool sort;                      /* slowest pass first */
    bool capture;
    bool startup; /* time of each phase of a first image, instead of runs */
};

/* Options of firn profile and firn sheet. */
struct app_sweeps {
    const char *texts[APP_SWEEP_COUNT]; /* "name=a,b,c" */
    uint32_t count;
};

/* Options of firn diff and of firn ladder --truth. */
struct app_mask {
    const char *file, *channel; /* NULL: all pixels, "A" */
};

/* Options of firn diff. */
struct app_diff {
    bool has_exposure;
    float exposure; /* stops */
    float ppd;      /* pixels per degree; 0: FLIP_PPD */
    enum flip_curve curve;
    bool has_limit[COMPARISON_METRIC_COUNT];
    double limits[COMPARISON_METRIC_COUNT];
};

/* Options of firn ladder. */
struct app_ladder {
    uint64_t refraction_models; /* bit i: techniques_refraction(i); 0: all */
    uint32_t run_count;         /* timed frames per refraction model */
    bool furnace;
    bool whole;                  /* with the inclusions of ice */
    const char *reference_image; /* image file, or NULL */
};

/* Options of firn farm. */
struct app_farm {
    uint32_t task_count; /* job count; 0: one per frame */
    const char *hosts;   /* ssh hosts; NULL: this machine */
    const char *sbatch[APP_SBATCH_COUNT];
    uint32_t sbatch_count;
    bool submit;
};

/* All command-line options; app_parse() sets the defaults that are not zero. */
struct app_options {
    struct setup_image image;
    struct app_run run;
    const char *positionals[APP_POSITIONAL_COUNT]; /* other arguments, NULL-terminated */
    struct app_render render;
    struct setup_window window;
    struct app_profile profile;
    struct app_sweeps sweeps;
    struct app_mask mask;
    struct app_diff diff;
    struct app_ladder ladder;
    struct app_farm farm;
};

/* Names of the window's colour themes, NULL-terminated. */
extern const char *const app_themes[];

enum app_command {
    APP_RENDER = 1,
    APP_GRAPH = 2,
    APP_LIST = 4,
    APP_VIEW = 8,
    APP_PROFILE = 16,
    APP_DIFF = 32,
    APP_LADDER = 64,
    APP_SHEET = 128,
    APP_FARM = 256,
    APP_MERGE = 512,
    APP_INFO = 1024,
    APP_SELFTEST = 2048,
};

/* Parses the arguments after the command. If an argument is invalid, logs an error in one line and
 * returns STATUS_USAGE. If help is requested, prints it and sets *done. */
MUST_USE enum status app_parse(struct app_options *options, enum app_command command, int argc,
                               char **argv, bool *done);

/* Prints those arguments of a command that firn render also accepts, except the first `skip`
 * positional arguments. Each argument is preceded by a space and quoted for a shell. */
void app_print_render_arguments(char *const *args, enum app_command command, uint32_t skip,
                                FILE *out);

/* Prints the help of a command on stdout. */
void app_help(enum app_command command);

enum status app_render(const struct app_options *options);
enum status app_graph(const struct app_options *options);
enum status app_info(const struct app_options *options);
enum status app_list(const struct app_options *options);
enum status app_profile(const struct app_options *options);
/* Replaces this process by firn-view. Returns only on failure, which is logged. */
enum status app_view(const struct app_options *options);
enum status app_diff(const struct app_options *options);
enum status app_ladder(const struct app_options *options);
enum status app_sheet(const struct app_options *options);
enum status app_farm(const struct app_options *options);
enum status app_merge(const struct app_options *options);
enum status app_selftest(const struct app_options *options);
/* Prints the version; if `option` is "--verbose", also the build. `option` may be NULL. */
enum status app_version(const char *option);

/* Sets an image option ("size") or a setting ("cracks.count") by its name. `value` is in
 * command-line syntax. If the name or value is invalid, logs an error and returns STATUS_USAGE. */
MUST_USE enum status app_set_option(struct setup_image *image, const char *name, const char *value);

/* Adds the command's default output file if the options name no output. */
void app_default_output(struct app_options *o, enum app_command command);

#endif
