/* options.c: the table of options, parsed and explained. */
#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/app/app.h"
#include "src/app/layer_picture.h"
#include "src/app/options/option_diff.h"
#include "src/app/options/option_farm.h"
#include "src/app/options/option_ladder.h"
#include "src/app/options/option_picture.h"
#include "src/app/options/option_profile.h"
#include "src/app/options/option_values.h"
#include "src/app/options/option_view.h"
#include "src/app/shell_words.h"
#include "src/base/log.h"
#include "src/reference/reference.h"
#include "src/scene/material.h"
#include "src/tech/refract.h"
#include "src/tech/refract_reference.h"

struct option {
    const char *group; /* heading in the help */
    const char *name;  /* without dashes */
    char letter;       /* 0: none */
    const char *value; /* NULL: takes none; "[=VALUE]": may be left out, and is then NULL */
    unsigned commands; /* enum app_command */
    option_fn *set;
    const char *help;
};

/* ---- the table ---- */

#define FRAMES   (APP_RENDER | APP_GRAPH | APP_PROFILE | APP_VIEW | APP_FARM)
#define PICTURES (FRAMES | APP_LADDER | APP_SHEET)
#define SCENES   (PICTURES | APP_BAKE)
#define FILES    (APP_RENDER | APP_GRAPH | APP_VIEW | APP_FARM)
#define DEVICES  ((FRAMES & ~(unsigned)APP_GRAPH) | APP_LADDER | APP_BAKE | APP_SHEET)

static const struct option options[] = {
    { "Output", "output", 'o', "FILE", APP_RENDER | APP_FARM, option_output,
      "write FILE.exr or FILE.png, may be repeated; - is an EXR on stdout (firn.exr)" },
    { "Output", "output", 'o', "FILE", APP_LADDER, option_ladder_output,
      "FILE.png: contact sheet, .exr: layers, .svg: plot, .html: page; may be repeated" },
    { "Output", "output", 'o', "FILE", APP_BAKE, option_bake_output,
      "write FILE.exr; - is stdout (env.exr)" },
    { "Output", "output", 'o', "FILE", APP_SHEET, option_sheet_output,
      "write FILE.png (sheet.png)" },
    { "Output", "output", 'o', "FILE", APP_MERGE, option_bake_output,
      "write FILE.exr; - is stdout (merged.exr)" },
    { "Output", "sweep", 0, "NAME=A,B,...", APP_SHEET, option_sweep,
      "one picture for each; of several all products (every material)" },
    { "Output", "size", 's', "WxH", APP_SHEET, option_size, "pixels of each picture (320x240)" },
    { "Output", "size", 's', "N", APP_BAKE, option_bake_size, "texels along a face's sides (512)" },
    { "Output", "size", 's', "WxH", FRAMES, option_size, "pixels (1024x768)" },
    { "Output", "size", 's', "WxH", APP_LADDER, option_size, "pixels (512x512)" },
    { "Output", "samples", 'n', "N", FILES | APP_LADDER | APP_SHEET, option_samples,
      "samples a pixel (1); a window shows one, its screenshots have all" },
    { "Output", "aov", 0, "LIST", FILES, option_aov,
      "extra layers of the EXR: names with commas between (firn list layers), or all" },
    { "Output", "tiles", 0, "CxR", APP_RENDER | APP_FARM, option_tiles,
      "draw it in C x R tiles, one after another, with less memory: the same bytes" },
    { "Output", "tile", 0, "I", APP_RENDER | APP_FARM, option_tile,
      "only that tile, from 1; firn merge puts the files together" },
    { "Output", "interleaved", 0, NULL, APP_RENDER | APP_FARM, option_interleaved,
      "every Cth pixel of every Rth row: beyond a device's images, not the same" },
    { "Output", "show", 0, "LAYER", APP_RENDER | APP_FARM, option_show,
      "what PNG files show in place of the picture: one layer (firn list layers)" },
    { "Window", "frames", 0, "N", APP_VIEW, option_frame_count, "end after so many frames" },
    { "Window", "time-step", 0, "SECONDS", APP_VIEW, option_time_step,
      "so much time between frames, however long they take" },
    { "Window", "screenshot", 0, "FILE", APP_VIEW, option_screenshot,
      "at the end write the last frame to FILE.png or FILE.exr, may be repeated" },
    { "Window", "present", 0, "MODE", APP_VIEW, option_present,
      "fifo (no tearing), mailbox (the newest, too), immediate (fifo)" },
    { "Window", "fps-limit", 0, "N", APP_VIEW, option_fps_limit,
      "at most so many frames a second" },
    { "Window", "overlay", 0, "on|off", APP_VIEW, option_overlay,
      "panels over the picture (on, but off with --frames and --screenshot)" },
    { "Window", "split", 0, "RUNG", APP_VIEW, option_split,
      "on the right of a divider: --refraction is on its left (S, [ and ] there)" },
    { "Window", "watch", 0, "[=FOLDER]", APP_VIEW, option_watch,
      "compile shaders there when they are saved, and show them (shaders)" },
    { "Sequence", "frames", 0, "LIST", APP_RENDER | APP_FARM, option_frames,
      "A-B, A-BxN (every Nth), A, or A-B,C,...; to -o a.####.exr or a.%04d.exr" },
    { "Sequence", "chunk", 0, "K/N", APP_RENDER, option_chunk,
      "only part K of N of these frames, for several machines" },
    { "Sequence", "resume", 0, NULL, APP_RENDER, option_resume,
      "draw only what is not there yet, whole and with the same options" },
    { "Sequence", "json", 0, "FILE", APP_RENDER, option_json,
      "write what became of each frame: state, seconds, hash; - is stdout" },
    { "Farm", "tasks", 0, "N", APP_FARM, option_farm_tasks,
      "jobs that share the frames (one for each frame, at most 100)" },
    { "Farm", "submit", 0, NULL, APP_FARM, option_farm_submit,
      "run the script at once in place of printing it" },
    { "Farm", "sbatch", 0, "OPTION", APP_FARM, option_farm_sbatch,
      "an option of sbatch, such as --time=2:00:00; may be repeated" },
    { "Farm", "hosts", 0, "LIST", APP_FARM, option_farm_hosts,
      "for ssh, with commas between, : is this machine (:)" },
    { "Runs", "runs", 'n', "N", APP_PROFILE, option_runs, "runs that count (30)" },
    { "Runs", "warmup", 0, "N", APP_PROFILE, option_warmup, "runs before them (5)" },
    { "Runs", "time-step", 0, "SECONDS", APP_PROFILE, option_time_step,
      "of the scene, from run to run (0: every run draws the same)" },
    { "Runs", "clock", 0, "CLOCK", APP_PROFILE, option_clock,
      "timestamps, submits (each pass alone), auto: what is truthful (auto)" },
    { "Runs", "sweep", 0, "NAME=A,B,...", APP_PROFILE, option_sweep,
      "profile each value of a setting, size, ...; of several all products" },
    { "Runs", "baseline", 0, "FILE", APP_PROFILE, option_baseline,
      "compare with what --json wrote; exit code 1 if anything is slower" },
    { "Reports", "each", 0, NULL, APP_PROFILE, option_each,
      "a line for each repetition of a pass, such as cube faces" },
    { "Reports", "json", 0, "FILE", APP_PROFILE, option_json,
      "write everything, with all samples; - is stdout in place of the table" },
    { "Reports", "csv", 0, "FILE", APP_PROFILE, option_csv, "write a line for each run and pass" },
    { "Reports", "trace", 0, "FILE", APP_PROFILE, option_trace,
      "write a Chrome trace, for Perfetto, Tracy or speedscope" },
    { "Reports", "html", 0, "FILE", APP_PROFILE, option_html, "write a page with plots" },
    { "Reports", "capture", 0, NULL, APP_PROFILE, option_capture,
      "let RenderDoc capture a frame; start firn from it" },
    { "Ladder", "rungs", 0, "LIST", APP_LADDER, option_rungs,
      "only these rungs, with commas between (firn list rungs)" },
    { "Ladder", "runs", 0, "N", APP_LADDER, option_costs,
      "frames of each rung against the clock (10); 0: costs are not measured" },
    { "Ladder", "furnace", 0, NULL, APP_LADDER, option_furnace,
      "surroundings of 1: what takes no light shows 1; exit code 1 where it does not" },
    { "Ladder", "truth", 0, "FILE", APP_LADDER, option_truth,
      "a picture of the same view by another program, to compare with, too" },
    { "Picture", "refraction", 'r', "RUNG", FRAMES | APP_SHEET, option_refraction,
      "paper, bounce, reference, ...: firn list rungs (paper)" },
    { "Picture", "material", 'm', "NAME", PICTURES, option_material,
      "ice, water, glass, ... (ice)" },
    { "Picture", "set", 0, "NAME=VALUE", SCENES, option_set,
      "a setting (firn list settings), may be repeated" },
    { "Scene", "env", 'e', "FILE", SCENES, option_env,
      "equirectangular .exr or .hdr around the scene; or what firn bake made of it" },
    { "Scene", "surroundings", 0, "FILE", SCENES, option_surroundings,
      "a model around the object" },
    { "Scene", "background", 0, "R,G,B", SCENES, option_background,
      "one linear colour for the sky" },
    { "Scene", "load-seconds", 0, "N", PICTURES, option_load_seconds,
      "reading a file may take so long (10); what reads it is a process of its own" },
    { "Scene", "load-memory", 0, "GiB", PICTURES, option_load_memory, "... and so much (4)" },
    { "Camera", "orbit", 0, "AZ,EL,DIST", PICTURES, option_orbit,
      "degrees, degrees, metres, around the target" },
    { "Camera", "eye", 0, "X,Y,Z", PICTURES, option_eye, "where the camera stands, metres" },
    { "Camera", "target", 0, "X,Y,Z", PICTURES, option_target,
      "what it looks at (the object's centre)" },
    { "Camera", "fov", 0, "DEGREES", PICTURES, option_fov, "vertical angle of view (45)" },
    { "Device", "device", 'd', "N|NAME", DEVICES, option_device,
      "number or part of the name (firn list devices)" },
    { "Device", "validate", 0, NULL, DEVICES, option_validate,
      "Vulkan validation and synchronization validation" },
    { "Device", "no-cache", 0, NULL, DEVICES, option_no_cache,
      "do not keep compiled pipelines in $XDG_CACHE_HOME/firn" },
    { "Device", "sharing", 0, "HOW", SCENES, option_sharing,
      "share memory: batches (where it costs none), memory, nothing (batches)" },
    { "Comparison", "mask", 0, "FILE", APP_DIFF | APP_LADDER, option_mask,
      "only pixels count where its A (of an EXR or PNG) is above 0" },
    { "Comparison", "mask-channel", 0, "NAME", APP_DIFF | APP_LADDER, option_mask_channel,
      "another channel of the mask" },
    { "Comparison", "exposure", 0, "STOPS", APP_DIFF, option_exposure,
      "LDR-FLIP of EXR and HDR files too, exposed so and clamped; else HDR-FLIP" },
    { "Comparison", "curve", 0, "NAME", APP_DIFF, option_curve,
      "that HDR-FLIP shows pictures by: aces, hable or reinhard (aces)" },
    { "Comparison", "ppd", 0, "N", APP_DIFF, option_ppd,
      "pixels per degree that the viewer sees, 1 to 400 (67)" },
    { "Result", "output", 'o', "FILE", APP_DIFF, option_error_picture,
      "write the errors: FILE.png in colours, FILE.exr as numbers; may be repeated" },
    { "Result", "fail-above", 0, "METRIC=N", APP_DIFF, option_fail_above,
      "exit code 1 if flip, rmse, relmse, mae, angle (degrees) is above; may be repeated" },
    { "Format", "dot", 0, NULL, APP_GRAPH, option_format_dot,
      "print a Graphviz digraph, not text" },
    { "Format", "html", 0, NULL, APP_GRAPH, option_format_html,
      "print a page that shows passes and memory" },
    { "Format", "json", 0, NULL, APP_GRAPH | APP_DIFF | APP_LADDER | APP_FARM, option_format_json,
      "print JSON, with everything" },
    { "Other", "quiet", 'q', NULL, SCENES | APP_MERGE, option_quiet, "no progress" },
};

enum {
    OPTION_COUNT = sizeof(options) / sizeof(options[0])
};

static const char *const examples[] = {
    [APP_RENDER] = ("  firn render ice-cube -o ice.exr -o ice.png\n"
                    "  firn render statue.glb --env studio.hdr --samples 16 -o statue.png\n"
                    "  firn render sphere --refraction one-sided --aov exit -o sphere.exr\n"
                    "  firn render ice-cube --frames 0-99 --resume -o turn.####.png\n"),
    [APP_GRAPH] = ("  firn graph ice-cube\n"
                   "  firn graph ice-cube --html > plan.html\n"
                   "  firn graph ice-cube --refraction one-sided --dot | dot -Tsvg > plan.svg\n"),
    [APP_VIEW] = ("  firn view ice-cube\n"
                  "  firn view statue.glb --env studio.hdr --set motion.ice=0\n"
                  "  firn view sphere --frames 100 --time-step 0.04 --screenshot last.png\n"),
    [APP_PROFILE] = ("  firn profile ice-cube\n"
                     "  firn profile ice-cube --json before.json --html before.html\n"
                     "  firn profile ice-cube --baseline before.json\n"
                     "  firn profile ice-cube --sweep cracks.count=1,4,16,64\n"
                     "  firn profile paper\n"),
    [APP_DIFF] = ("  firn diff reference.exr test.exr\n"
                  "  firn diff before.png after.png -o errors.png\n"
                  "  firn diff a.exr b.exr --mask a.exr --mask-channel thickness.Z --json\n"
                  "  firn diff golden.exr new.exr --fail-above flip=0.01 --fail-above angle=0.1\n"),
    [APP_LADDER] = ("  firn ladder\n"
                    "  firn ladder sphere --size 256x256 -o ladder.html -o ladder.exr\n"
                    "  firn ladder statue.glb --rungs paper,search,bounce --runs 0 --json\n"
                    "  firn ladder ice-cube --furnace\n"),
    [APP_BAKE] = ("  firn bake room -o env.exr\n"
                  "  firn bake room --size 1024 -o fine.exr\n"
                  "  firn render room --env env.exr -o room.png\n"),
    [APP_SHEET] = ("  firn sheet teapot -o materials.png\n"
                   "  firn sheet sphere --sweep refract.crossfade=0,0.5,1 "
                   "--set refract.fresnel=crossfade -o fade.png\n"
                   "  firn sheet room --sweep refraction=paper,bounce --sweep "
                   "refract.lookup=infinite,box\n"),
    [APP_FARM] = ("  firn farm slurm ice-cube --frames 1-250 -o turn.####.exr\n"
                  "  firn farm slurm ice-cube --frames 1-250 -o turn.####.exr --tasks 25 "
                  "--sbatch --time=1:00:00\n"
                  "  firn farm parallel ice-cube --frames 1-250 -o turn.####.exr "
                  "--hosts one,two,:\n"
                  "  firn farm status ice-cube --frames 1-250 -o turn.####.exr\n"
                  "  firn farm status turn.####.exr --frames 1-250\n"),
    [APP_MERGE] = ("  firn render ice-cube --size 16384x8192 --tiles 4x2 --tile 1 -o tile.1.exr\n"
                   "  firn merge tile.*.exr -o still.exr\n"),
    [APP_LIST] = ("  firn list\n"
                  "  firn list settings\n"),
};

static const char *const usages[] = {
    [APP_RENDER] = "firn render [options] SCENE: draw a picture, to EXR and PNG",
    [APP_GRAPH] = "firn graph [options] SCENE: print the compiled plan of a frame; needs no device",
    [APP_VIEW] = "firn view [options] SCENE: show it in a window; F1 prints what keys do there",
    [APP_PROFILE] = "firn profile [options] SCENE: measure what each pass of a frame costs",
    [APP_DIFF] = "firn diff [options] REFERENCE TEST: how far two pictures are apart",
    [APP_LADDER] = "firn ladder [options] [SCENE]: how far every rung is from the traced truth",
    [APP_BAKE] = "firn bake [options] SCENE: draw what surrounds its object, six ways",
    [APP_SHEET] = "firn sheet [options] SCENE: one picture for each value, side by side",
    [APP_FARM] = "firn farm slurm|parallel|status [options] SCENE: a sequence on many machines",
    [APP_MERGE] = "firn merge [options] TILE...: put the tiles of a picture together",
    [APP_LIST] = "firn list [scenes|rungs|materials|layers|settings|devices]: what there is",
};

/* Its value comes with '=' or not at all. */
static bool is_optional(const struct option *option)
{
    return option->value && option->value[0] == '[';
}

void app_help(enum app_command command)
{
    const char *group = "";
    printf("%s\n\nExamples:\n%s", usages[command], examples[command]);
    if (command & SCENES)
        printf("\nSCENE is ice-cube, sphere, teapot, room, pool, or a model file (.gltf .glb .obj "
               ".ply).\n");
    if (command == APP_PROFILE)
        printf("firn profile paper repeats the measurements of the paper.\n");
    if (command == APP_BAKE)
        printf(
            "\nThe file is a strip of six faces, +X -X +Y -Y +Z -Z from the top, in half: R, G, B "
            "and\nA = 1 / distance from the object's centre, metres. --env takes it.\n");
    if (command == APP_FARM)
        printf("slurm prints a script for sh that gives the frames to Slurm, parallel one for GNU "
               "parallel;\nstatus says which frames are there, with exit code 0 if all are. Of "
               "files alone, without\nSCENE, it compares their settings with those of the newest "
               "file.\n");
    if (command == APP_LADDER)
        printf("\nWithout SCENE it is the ice cube: the smooth object alone, with "
               "refract.fresnel=exact and\n"
               "refract.lookup=distance, unless --set says otherwise.\n");
    if (command == APP_DIFF)
        printf("\nREFERENCE and TEST are both .exr or .hdr, or both .png, and of one size.\n");
    for (size_t i = 0; i < OPTION_COUNT; i++) {
        const struct option *option = &options[i];
        char left[64];
        if (!(option->commands & command))
            continue;
        if (strcmp(group, option->group) != 0)
            printf("\n%s:\n", option->group);
        group = option->group;
        snprintf(left, sizeof(left), "--%s%s%s", option->name, is_optional(option) ? "" : " ",
                 option->value ? option->value : "");
        if (option->letter)
            printf("  -%c, %-22s %s\n", option->letter, left, option->help);
        else
            printf("      %-22s %s\n", left, option->help);
    }
    printf("  -h, %-22s %s\n", "--help", "this text");
}

/* ---- parsing ---- */

static const struct option *find_long(const char *name, size_t length, enum app_command command)
{
    for (size_t i = 0; i < OPTION_COUNT; i++) {
        if ((options[i].commands & command) && strlen(options[i].name) == length &&
            !strncmp(options[i].name, name, length))
            return &options[i];
    }
    return NULL;
}

static const struct option *find_letter(char letter, enum app_command command)
{
    for (size_t i = 0; i < OPTION_COUNT; i++) {
        if ((options[i].commands & command) && letter && options[i].letter == letter)
            return &options[i];
    }
    return NULL;
}

/* "--name=value", "--name value", "-x value", "-xvalue": the option and its value. */
static const struct option *split(const char *word, enum app_command command, const char **value)
{
    const struct option *option;
    *value = NULL;
    if (word[1] == '-') {
        size_t length = strcspn(word + 2, "=");
        option = find_long(word + 2, length, command);
        if (word[2 + length])
            *value = &word[2 + length + 1];
    } else {
        option = find_letter(word[1], command);
        if (word[2])
            *value = &word[2];
    }
    return option;
}

static enum status parse_option(struct app_options *o, enum app_command command, char **argv,
                                int *index)
{
    const char *value;
    const struct option *option = split(argv[*index], command, &value);
    if (!option) {
        log_error("unknown option %s (see --help)", argv[*index]);
        return STATUS_USAGE;
    }
    if (!option->value && value) {
        log_error("--%s takes no value (see --help)", option->name);
        return STATUS_USAGE;
    }
    const bool wanted = option->value && !value && !is_optional(option);
    if (wanted)
        value = argv[++*index]; /* argv ends at NULL */
    if (wanted && !value) {
        log_error("--%s: %s is missing (see --help)", option->name, option->value);
        return STATUS_USAGE;
    }
    return option->set(o, value);
}

static enum status add_positional(struct app_options *o, enum app_command command, const char *word)
{
    const uint32_t most = command & (APP_DIFF | APP_FARM) ? 2
                          : command == APP_MERGE          ? APP_POSITIONAL_COUNT - 1
                                                          : 1;
    uint32_t count = 0;
    while (count < most && o->positionals[count])
        count++;
    if (count < most) {
        o->positionals[count] = word;
        return STATUS_OK;
    }
    if (most > 1)
        log_error("%s: only %u of these are wanted", word, most);
    else
        log_error("%s: only one of these is wanted, %s is there already", word, o->positionals[0]);
    return STATUS_USAGE;
}

static enum status refuse_traced(const struct app_options *o)
{
    if (o->rung != &refract_reference)
        return STATUS_OK;
    log_error("--refraction reference: it is traced, only firn render does that");
    return STATUS_USAGE;
}

/* What cannot be said before all words are read: who draws which layers. */
static enum status settle_layers(struct app_options *o)
{
    uint32_t made = 0;
    for (uint32_t i = 0; techniques_layer(i); i++) {
        const struct frame_layer *layer = techniques_layer(i);
        const bool is_made =
            o->rung == &refract_reference ? reference_makes(layer) : layer->image != NULL;
        made |= is_made ? 1u << i : 0;
        if (is_made || !((o->layers & 1u << i) || o->show == layer))
            continue;
        log_error("--%s %s: --refraction %s does not make it (firn list layers)",
                  o->show == layer ? "show" : "aov", layer->name, o->rung->rung.name);
        return STATUS_USAGE;
    }
    if (o->all_layers)
        o->layers = made;
    return STATUS_OK;
}

enum status app_parse(struct app_options *o, enum app_command command, int argc, char **argv,
                      bool *done)
{
    bool only_words = false;
    *done = false;
    *o = (struct app_options){
        .settings = settings_default(),
        .rung = techniques_rung(0),
        .warmup = 5,
        .run_count = 30,
    };
    if (command == APP_LADDER)
        option_ladder_defaults(o);
    for (int i = 0; i < argc; i++) {
        enum status status = STATUS_OK;
        const char *word = argv[i];
        if (!only_words && (!strcmp(word, "--help") || !strcmp(word, "-h"))) {
            app_help(command);
            *done = true;
            return STATUS_OK;
        }
        if (!only_words && !strcmp(word, "--")) {
            only_words = true;
        } else if (!only_words && word[0] == '-' && word[1]) {
            status = parse_option(o, command, argv, &i);
        } else {
            status = add_positional(o, command, word);
        }
        if (status != STATUS_OK)
            return status;
    }
    if (!(command & (APP_RENDER | APP_FARM)) && refuse_traced(o) != STATUS_OK)
        return STATUS_USAGE;
    return settle_layers(o);
}

void app_print_render_words(char *const *words, enum app_command command, uint32_t skip, FILE *out)
{
    bool only_words = false;
    for (; *words; words++) {
        const char *value = "";
        const bool is_option = !only_words && words[0][0] == '-' && words[0][1];
        const bool is_last = is_option && !strcmp(*words, "--");
        const struct option *option = is_option && !is_last ? split(*words, command, &value) : NULL;
        const bool has_next = option && option->value && !value && !is_optional(option);
        const bool skipped = !is_option && skip > 0;
        only_words = only_words || is_last;
        skip -= skipped;
        if (!skipped && (!option || option->commands & APP_RENDER)) {
            putc(' ', out);
            shell_words_quote(*words, out);
            if (has_next) {
                putc(' ', out);
                shell_words_quote(words[1], out);
            }
        }
        words += has_next;
    }
}

/* Options that say what is drawn. */
enum status app_set(struct app_options *o, const char *name, const char *value)
{
    const struct option *option = find_long(name, strlen(name), APP_GRAPH);
    char assignment[256];
    if (option && option->value && strcmp(name, "set") != 0) {
        const enum status status = option->set(o, value);
        return status == STATUS_OK ? refuse_traced(o) : status;
    }
    snprintf(assignment, sizeof(assignment), "%s=%s", name, value);
    return option_set(o, assignment);
}
