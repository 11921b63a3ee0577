/* options.c: the table of command-line options, and its parser. */
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/app/app.h"
#include "src/app/options/command_options.h"
#include "src/app/options/image_options.h"
#include "src/app/options/node_material_option.h"
#include "src/app/options/object_transform_option.h"
#include "src/app/options/option_help.h"
#include "src/app/options/option_values.h"
#include "src/app/options/output_path_conflicts.h"
#include "src/app/options/set_option.h"
#include "src/base/log.h"
#include "src/base/shell_quote.h"
#include "src/base/suggest.h"
#include "src/lab/metric/flip_filter.h"
#include "src/lib/image_session.h"

#include "src/setup/aov_to_png.h"
#include "src/setup/apply_preset.h"
#include "src/tech/refract/cpu_reference_settings.h"
#include "src/tech/refract/refract.h"
#include "src/tech/refract/refract_bounce.h"
#include "src/tech/trace/refract_trace.h"

/* ---- the table ---- */

enum {
    TASKS_MAX = 1000 /* Slurm's default MaxArraySize is 1001 */
};

#define FRAMES  (APP_RENDER | APP_GRAPH | APP_PROFILE | APP_VIEW | APP_FARM)
#define IMAGES  (FRAMES | APP_LADDER | APP_SHEET)
#define READERS (IMAGES | APP_DIFF | APP_MERGE | APP_INFO)
#define FILES   (APP_RENDER | APP_GRAPH | APP_VIEW | APP_FARM)
#define DEVICES ((FRAMES & ~(unsigned)APP_GRAPH) | APP_LADDER | APP_SHEET | APP_SELFTEST)

/* NOLINTBEGIN(bugprone-macro-parentheses): a type cannot be in parentheses */
/* Initialisers of an option's `offset` and `set`. Compilation fails if `field` is not a `type`. */
#define AT(type, field, set) \
    _Generic(((struct app_options *)0)->field, type : offsetof(struct app_options, field)), set
/* NOLINTEND(bugprone-macro-parentheses) */
#define FLAG(field)        AT(bool, field, option_flag)
#define TEXT(field)        AT(const char *, field, option_text)
#define INPUT(field)       AT(const char *, field, option_input)
#define REPORT(field)      AT(const char *, field, option_report)
#define COUNT(field)       AT(uint32_t, field, option_count)
#define FLOAT(field)       AT(float, field, option_float)
#define DOUBLE(field)      AT(double, field, option_double)
#define IMAGE(set)         AT(struct setup_image, image, set)
#define SCENE(set)         AT(struct setup_scene, image.scene, set)
#define VECTOR(field, set) AT(struct setup_vector, image.field, set)
#define POSITION(field)    AT(struct setup_position, image.field, option_position)
#define OUTPUTS            AT(struct setup_outputs, run.outputs, option_output)
#define FORMAT             AT(enum app_format, run.format, option_format)
#define SWEEP              AT(struct app_sweeps, sweeps, option_sweep)
#define VIEW(set)          AT(struct setup_window, window, set)
#define DIFF(set)          AT(struct app_diff, diff, set)
#define FARM(set)          AT(struct app_farm, farm, set)

static const char *const image_endings[] = { ".exr", ".png", NULL };
static const char *const exr_ending[] = { ".exr", NULL };
static const char *const overlays[] = { "", "on", "off", NULL }; /* by enum setup_overlay */

static const struct option options[] = {
    { "Output", "output", 'o', "FILE", APP_RENDER | APP_FARM, OUTPUTS,
      "output file, .exr or .png; - is an EXR on stdout; repeatable (default: firn.exr)",
      .max = SETUP_OUTPUT_COUNT, .words = image_endings, .unit = ", or -" },
    { "Output", "output", 'o', "FILE", APP_LADDER, OUTPUTS,
      "report: .png contact sheet or .exr layers; repeatable", .max = SETUP_OUTPUT_COUNT,
      .words = image_endings },
    { "Output", "output", 'o', "FILE", APP_SHEET, OUTPUTS, "output file, .png (default: sheet.png)",
      .max = 1, .words = &image_endings[1] },
    { "Output", "output", 'o', "FILE", APP_MERGE, OUTPUTS,
      "output file, .exr, or - for stdout (default: merged.exr)", .max = 1, .words = exr_ending,
      .unit = ", or -" },
    { "Output", "sweep", 0, "NAME=A,B,...", APP_SHEET, SWEEP,
      "setting and values, one image per value; repeatable (default: one per material)" },
    { "Output", "size", 's', "WxH", APP_SHEET, IMAGE(option_size),
      "size of each image, pixels, 1x1 to 16384x16384 (default: 320x240)" },
    { "Output", "size", 's', "WxH", FRAMES, IMAGE(option_size),
      "size of the image, pixels, 1x1 to 16384x16384 (default: 1024x768)" },
    { "Output", "size", 's', "WxH", APP_LADDER, IMAGE(option_size),
      "size of the image, pixels, 1x1 to 16384x16384 (default: 512x512)" },
    { "Output", "samples", 'n', "N|auto", APP_RENDER | APP_FARM, IMAGE(option_samples),
      "samples per pixel, 1 to 65536; auto: 4 to 64 by noise (default: by --quality)" },
    { "Output", "samples", 'n', "N", APP_GRAPH | APP_LADDER | APP_SHEET, COUNT(image.samples),
      "samples per pixel, 1 to 65536 (default: 1)", 1, 65536 },
    { "Output", "noise", 0, "LEVEL", APP_RENDER, DOUBLE(render.noise),
      "reference: stop at this mean standard error of clamped (0..1) RGB (default: none)", 1e-6,
      0.5 },
    { "Output", "time", 0, "SECONDS", APP_RENDER, DOUBLE(render.seconds),
      "reference: seconds after which no more samples are started (default: no limit)", 1e-3, 1e9,
      " seconds" },
    { "Output", "keep-sums", 0, NULL, APP_RENDER, FLAG(render.keep_sums),
      "reference: store the sample sums of a.exr in a.sums.exr, for --resume to continue" },
    { "Output", "samples", 'n', "N", APP_VIEW, COUNT(image.samples),
      "samples per pixel of a still view, 1 to 65536 (default: 64; 1 with --frames)", 1, 65536 },
    { "Output", "pixel-filter", 0, "FILTER", FILES | APP_LADDER | APP_SHEET,
      AT(struct setup_image, image, option_pixel_filter),
      "pixel filter: box, point or blackman-harris (default: by --quality)" },
    { "Output", "aov", 0, "LIST", FILES, IMAGE(option_aov),
      "additional EXR layers (AOVs), separated by commas, or all; see firn list layers" },
    { "Output", "tiles", 0, "CxR", APP_RENDER | APP_FARM, IMAGE(option_tiles),
      "draw in tiles, columns x rows, 1x1 to 16x16: less memory, identical output" },
    { "Output", "tile", 0, "I", APP_RENDER | APP_FARM, COUNT(image.tile),
      "draw only one tile, with this number from 1; firn merge joins the files", 1, 256 },
    { "Output", "interleaved", 0, NULL, APP_RENDER | APP_FARM, FLAG(image.interleaved),
      "interleave the tiles' pixels, for images above the device's limit; mips differ" },
    { "Output", "show", 0, "LAYER", APP_RENDER | APP_FARM, IMAGE(option_show),
      "layer that PNG files show instead of the image; see firn list layers" },
    { "Output", "ocio", 0, "CONFIG,VIEW", APP_RENDER | APP_FARM, IMAGE(option_ocio),
      "OpenColorIO config and [DISPLAY/]VIEW of PNG files, instead of --tone-curve" },
    { "Output", "png-bits", 0, "8|16", APP_RENDER | APP_FARM, IMAGE(option_png_bits),
      "bits per channel of PNG files (default: 8)" },
    { "Window", "frames", 0, "N", APP_VIEW, COUNT(window.frame_count),
      "frames until the window closes, 1 to 1000000000 (default: no limit)", 1, 1000000000 },
    { "Window", "time-step", 0, "SECONDS", APP_VIEW, DOUBLE(window.time_step),
      "scene time per frame, seconds, 0 to 3600 (default: real time)", 0, 3600, " seconds" },
    { "Window", "screenshot", 0, "FILE", APP_VIEW, OUTPUTS,
      "file for the last frame, .png or .exr, written at the end; repeatable",
      .max = SETUP_OUTPUT_COUNT, .words = image_endings, .unit = ", or -" },
    { "Window", "present", 0, "MODE", APP_VIEW, VIEW(option_present),
      "present mode: fifo, mailbox, immediate (default: fifo)" },
    { "Window", "overlay", 0, "on|off", APP_VIEW,
      AT(enum setup_overlay, window.overlay, option_word),
      "panels beside the image (default: on; off with --frames or --screenshot)", .min = 1,
      .words = overlays },
    { "Window", "ui-scale", 0, "FACTOR", APP_VIEW, FLOAT(window.ui_scale),
      "scale of text and panels, 0.5 to 4; also Ctrl + and - (default: the desktop's)",
      (double)SETUP_UI_SCALE_MIN, (double)SETUP_UI_SCALE_MAX },
    { "Window", "theme", 0, "dark|light", APP_VIEW, AT(uint32_t, window.theme, option_word),
      "colours of the panels; key Ctrl T (default: dark)", .words = app_themes },
    { "Window", "ui-dump", 0, "FILE", APP_VIEW, TEXT(window.ui_dump),
      "file for the pixel positions of all controls, rewritten when they change" },
    { "Window", "session", 0, "FILE", APP_VIEW, INPUT(window.session),
      "session file, saved with Ctrl S, to open instead of SCENE" },
    { "Window", "split", 0, "MODEL", APP_VIEW, IMAGE(option_split),
      "refraction model to compare with, right of a divider; keys W, [ and ]" },
    { "Window", "watch", 0, "[=FOLDER]", APP_VIEW, VIEW(option_watch),
      "folder of shaders that are recompiled and reloaded when saved (default: shaders)" },
    { "Sequence", "frames", 0, "LIST", APP_RENDER | APP_FARM, TEXT(render.frames),
      "frames to render: A, A-B, A-BxN (every Nth) or A-B,C; use -o a.####.exr" },
    { "Sequence", "chunk", 0, "K/N", APP_RENDER, AT(struct app_render, render, option_chunk),
      "render only part K of N of the frames, to distribute them over machines" },
    { "Sequence", "resume", 0, NULL, APP_RENDER, FLAG(render.resume),
      "skip frames whose files are complete and were rendered with the same options" },
    { "Sequence", "json", 0, "FILE", APP_RENDER, REPORT(render.json),
      "JSON report with state, seconds and hash of each frame; - is stdout" },
    { "Farm", "tasks", 0, "N", APP_FARM, COUNT(farm.task_count),
      "number of jobs, 1 to 1000 (default: one per frame, at most 100)", 1, TASKS_MAX },
    { "Farm", "submit", 0, NULL, APP_FARM, FLAG(farm.submit),
      "run the script instead of printing it" },
    { "Farm", "sbatch", 0, "OPTION", APP_FARM, FARM(option_farm_sbatch),
      "additional option for sbatch, such as --time=2:00:00; repeatable" },
    { "Farm", "hosts", 0, "LIST", APP_FARM, FARM(option_farm_hosts),
      "ssh hosts, separated by commas; : is this machine (default: :)" },
    { "Runs", "runs", 'n', "N", APP_PROFILE, COUNT(profile.run_count),
      "number of measured runs, 1 to 100000 (default: 30)", 1, 100000 },
    { "Runs", "warmup", 0, "N", APP_PROFILE, COUNT(profile.warmup),
      "number of warm-up runs, which are not measured, 0 to 100000 (default: 5)", 0, 100000 },
    { "Runs", "time-step", 0, "SECONDS", APP_PROFILE, DOUBLE(profile.time_step),
      "scene time between runs, seconds, 0 to 3600; 0 repeats one frame (default: 0)", 0, 3600,
      " seconds" },
    { "Runs", "clock", 0, "CLOCK", APP_PROFILE, AT(enum rg_clock, profile.clock, option_clock),
      "timer: timestamps, submits (each pass submitted alone) or auto (submits on CPU devices, "
      "else timestamps; default)" },
    { "Runs", "startup", 0, NULL, APP_PROFILE, FLAG(profile.startup),
      "measure the start-up of a first image by phases, instead of runs" },
    { "Runs", "sweep", 0, "NAME=A,B,...", APP_PROFILE, SWEEP,
      "setting or option, and values to profile; repeatable: profiles all combinations" },
    { "Runs", "baseline", 0, "FILE", APP_PROFILE, INPUT(profile.baseline),
      "profile from --json to compare with; exit code 1 if a pass is slower" },
    { "Runs", "threshold", 0, "PERCENT", APP_PROFILE, DOUBLE(profile.threshold),
      "smallest change from the --baseline that counts, percent, 0 to 1000 (default: 5)", 0, 1000,
      " percent" },
    { "Reports", "sort", 0, NULL, APP_PROFILE, FLAG(profile.sort),
      "sort the table by median time, slowest pass first" },
    { "Reports", "json", 0, "FILE", APP_PROFILE, REPORT(profile.json),
      "JSON report with all samples; - prints it to stdout instead of the table" },
    { "Reports", "csv", 0, "FILE", APP_PROFILE, REPORT(profile.csv),
      "CSV report: one line per run and pass, or medians of a sweep" },
    { "Reports", "trace", 0, "FILE", APP_PROFILE, REPORT(profile.trace),
      "Chrome trace: timeline of all runs, for Perfetto (ui.perfetto.dev)" },
    { "Reports", "capture", 0, NULL, APP_PROFILE, FLAG(profile.capture),
      "RenderDoc capture of one frame; start firn from RenderDoc" },
    { "Ladder", "rungs", 0, "LIST", APP_LADDER,
      AT(struct app_ladder, ladder, option_refraction_models),
      "refraction models, separated by commas; see firn list refractions (default: all)" },
    { "Ladder", "runs", 0, "N", APP_LADDER, COUNT(ladder.run_count),
      "timed frames per refraction model, 0 to 10000; 0 for no timing (default: 10)", 0, 10000 },
    { "Ladder", "furnace", 0, NULL, APP_LADDER, FLAG(ladder.furnace),
      "white furnace test; exit code 1 if a refraction model gains or loses light" },
    { "Ladder", "whole", 0, NULL, APP_LADDER, FLAG(ladder.whole),
      "include bubbles, cracks, air, bumps and frost; list errors by inclusion" },
    { "Ladder", "truth", 0, "FILE", APP_LADDER, INPUT(ladder.reference_image),
      "second reference: an image of the same view by another renderer" },
    { "Rendering", "refraction", 'r', "MODEL", FRAMES | APP_SHEET, IMAGE(option_refraction),
      "refraction model, such as bounce; see firn list refractions (default: by scene)" },
    { "Rendering", "quality", 0, "LEVEL", IMAGES, IMAGE(option_quality),
      "quality level: draft, normal or high (default: high in render and view)" },
    { "Rendering", "material", 'm', "NAME", IMAGES, SCENE(option_material),
      "material, such as ruby:rough or NODE=glass[,ior=1.5,...]; see firn list materials" },
    { "Rendering", "plain", 0, NULL, IMAGES, FLAG(image.scene.plain),
      "no cracks, air, bubbles, bumps, frost or highlights, except those of --set" },
    { "Rendering", "tone-curve", 0, "CURVE", IMAGES, SCENE(option_tone_curve),
      "tone curve of PNG files: neutral, agx, aces, hable or clip (default: neutral)" },
    { "Rendering", "exposure", 0, "auto|EV", IMAGES, SCENE(option_stops),
      "exposure of PNG files and windows, stops (default: auto for models, else 0)" },
    { "Rendering", "preset", 0, "FILE", IMAGES, INPUT(image.scene.preset),
      "settings from NAME=VALUE lines, from an image that firn wrote, or `paper`" },
    { "Rendering", "set", 0, "NAME=VALUE", IMAGES, SCENE(option_set),
      "value of a setting; see firn list settings; repeatable" },
    { "Scene", "up", 0, "AXIS", IMAGES, SCENE(option_up),
      "up axis of the model file, y or z; does not affect --surroundings (default: y)" },
    { "Scene", "scale", 0, "X", IMAGES, SCENE(option_scale),
      "scale of the model file, 1e-6 to 1e6; does not affect --surroundings (default: 1)" },
    { "Scene", "rotate", 0, "X,Y,Z", IMAGES, SCENE(option_rotate),
      "rotation of the model about X, Y, Z, degrees; does not affect --surroundings" },
    { "Scene", "transform", 0, "NODE=X,Y,Z", IMAGES, SCENE(option_transform),
      "moves a node, metres; [,RX,RY,RZ[,S]] also rotates, degrees, and scales it" },
    { "Scene", "hide", 0, "NODE", IMAGES, SCENE(option_hide),
      "leaves out a node of the model file; repeatable" },
    { "Scene", "animation", 0, "NAME|N", IMAGES | APP_INFO, TEXT(image.scene.animation),
      "animation of the model file: name, number from 0, or none (default: the first)" },
    { "Scene", "env", 'e', "FILE", IMAGES, INPUT(image.scene.environment),
      "environment: name, .exr, .hdr or cube faces (default: sky; stage for models)" },
    { "Scene", "env-rotate", 0, "DEG", IMAGES, FLOAT(image.scene.env_rotate),
      "rotation of the --env panorama about +Y, degrees, -360 to 360 (default: 0)", -360, 360,
      " degrees" },
    { "Scene", "env-exposure", 0, "EV", IMAGES, FLOAT(image.scene.env_exposure),
      "exposure of the --env file, stops, -16 to 16 (default: 0)", -16, 16, " stops" },
    { "Scene", "surroundings", 0, "FILE", IMAGES, INPUT(image.scene.surroundings),
      "model file that surrounds the object (default: the scene's own surroundings)" },
    { "Scene", "ground", 0, "GROUND", IMAGES | APP_INFO,
      AT(struct stage_params, image.scene.ground, option_ground),
      "floor of a model: none, shadow, studio, slate, wood or R,G,B (default: auto)" },
    { "Scene", "cracks", 0, "FILE", IMAGES, INPUT(image.scene.cracks),
      "model file of a crack; cracks.count copies of it are placed at random" },
    { "Scene", "bump", 0, "FILE", IMAGES, INPUT(image.scene.bump),
      "height map of bumps, tiled over the surface: .exr, .hdr or .png (default: noise)" },
    { "Scene", "bump-mask", 0, "FILE", IMAGES, INPUT(image.scene.bump_mask),
      "mask image, white where the surface has no bumps (default: noise; see bump.mask)" },
    { "Scene", "air", 0, "FILE", IMAGES, INPUT(image.scene.air),
      "texture of the planes of bubbles: white is bubble, black is ice (default: random)" },
    { "Scene", "background", 0, "R,G,B", IMAGES, SCENE(option_background),
      "linear colour instead of the sky; beside --env behind it all; none: transparent" },
    { "Camera", "camera", 0, "NAME|N", IMAGES, TEXT(image.camera),
      "camera of the model file: name, or number from 0, see firn info (default: first)" },
    { "Camera", "orbit", 0, "AZ,EL,DIST", IMAGES, VECTOR(orbit, option_orbit),
      "orbit camera: azimuth and elevation, degrees; distance to the target, metres" },
    { "Camera", "eye", 0, "X,Y,Z", IMAGES, POSITION(eye),
      "position of the camera, metres, in the coordinates of the model file" },
    { "Camera", "target", 0, "X,Y,Z", IMAGES, POSITION(target),
      "point that the camera looks at, as --eye (default: the object's centre)" },
    { "Camera", "fov", 0, "DEGREES", IMAGES, FLOAT(image.fov_deg),
      "vertical field of view, degrees, 1 to 170 (default: the file's, else 24 or 45)", 1, 170,
      " degrees" },
    { "Device", "device", 'd', "N|NAME", DEVICES, TEXT(run.gpu.device),
      "Vulkan device, number or part of its name; see firn list devices (default: a GPU)" },
    { "Device", "validate", 0, NULL, DEVICES, FLAG(run.gpu.validate),
      "enable the Vulkan validation layer, with synchronization validation" },
    { "Device", "no-cache", 0, NULL, DEVICES | APP_INFO, FLAG(run.gpu.no_cache),
      "do not cache compiled pipelines and large BVHs in $XDG_CACHE_HOME/firn" },
    { "Reading", "load-seconds", 0, "N", READERS, COUNT(image.scene.reader.seconds),
      "limit of CPU time per file, seconds, 1 to 3600 (default: 60)", 1, 3600, " seconds" },
    { "Reading", "load-memory", 0, "GiB", READERS, COUNT(image.scene.reader.memory_gib),
      "memory limit per file, GiB, 1 to 1024 (default: 4)", 1, 1024, " GiB" },
    { "Reading", "sandbox", 0, "on|off", READERS, SCENE(option_sandbox),
      "sandbox of the processes that read files; off is for debugging (default: on)" },
    { "Comparison", "mask", 0, "FILE", APP_DIFF | APP_LADDER, INPUT(mask.file),
      "mask image, .exr or .png: only pixels with A above 0 are compared (default: none)" },
    { "Comparison", "mask-channel", 0, "NAME", APP_DIFF | APP_LADDER, TEXT(mask.channel),
      "channel of the --mask image (default: A)" },
    { "Comparison", "exposure", 0, "STOPS", APP_DIFF, DIFF(option_exposure),
      "exposure of EXR and HDR files, -40 to 40 stops, for LDR-FLIP instead of HDR-FLIP" },
    { "Comparison", "curve", 0, "NAME", APP_DIFF, AT(enum flip_curve, diff.curve, option_word),
      "tone curve of HDR-FLIP: aces, hable or reinhard (default: aces)",
      .words = flip_curve_names },
    { "Comparison", "ppd", 0, "N", APP_DIFF, FLOAT(diff.ppd),
      "pixels per degree of the viewer's field of view, 1 to 400 (default: 67)", 1, FLIP_PPD_MAX,
      " pixels per degree" },
    { "Result", "output", 'o', "FILE", APP_DIFF, OUTPUTS,
      "error image, .png heat map or .exr as numbers; repeatable", .max = SETUP_OUTPUT_COUNT,
      .words = image_endings },
    { "Result", "fail-above", 0, "METRIC=N", APP_DIFF, DIFF(option_fail_above),
      "limit of flip, rmse, relmse, mae or angle (degrees); above it the exit code is 1" },
    { "Format", "html", 0, NULL, APP_GRAPH, FORMAT,
      "HTML page of passes and memory instead of text" },
    { "Format", "json", 0, NULL, APP_GRAPH | APP_DIFF | APP_LADDER | APP_FARM | APP_INFO, FORMAT,
      "JSON with all data instead of text" },
    { "Format", "json", 0, NULL, APP_LIST, FORMAT, "JSON instead of text: a key for each list" },
    { "Format", "preset", 0, NULL, APP_LIST, FORMAT,
      "settings as a file for --preset, with every line commented out" },
    { "Other", "quiet", 'q', NULL, IMAGES | APP_MERGE, FLAG(run.quiet), "no progress or notes" },
};

enum {
    OPTION_COUNT = sizeof(options) / sizeof(options[0])
};

void app_help(enum app_command command)
{
    option_help(command, options, OPTION_COUNT);
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

static enum status refuse_option(const char *word, enum app_command command)
{
    char name[SUGGEST_NAME_SIZE];
    struct suggest suggest = { .word = name };
    const size_t length = strcspn(word, "=");
    const size_t dashes = strspn(word, "-");
    snprintf(name, sizeof(name), "%.*s", (int)(length - dashes), word + dashes);
    for (size_t i = 0; i < OPTION_COUNT; i++) {
        if (options[i].commands & command)
            suggest_offer(&suggest, options[i].name);
    }
    if (suggest.best)
        log_error("unknown option '%.*s': did you mean '--%s'? (see --help)", (int)length, word,
                  suggest.best);
    else
        log_error("unknown option '%.*s' (see --help)", (int)length, word);
    return STATUS_USAGE;
}

/* Splits "--name=value", "--name value", "-x value" or "-xvalue" into an option and its value. */
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
    if (!option)
        return refuse_option(argv[*index], command);
    if (!option->value && value) {
        log_error("--%s: expected no value, got '%s' (see --help)", option->name, value);
        return STATUS_USAGE;
    }
    const bool needs_value = option->value && !value && !option_is_optional(option);
    if (needs_value)
        value = argv[++*index]; /* argv ends at NULL */
    if (needs_value && !value) {
        log_error("--%s: expected %s, got nothing (see --help)", option->name, option->value);
        return STATUS_USAGE;
    }
    return option->set(option, (char *)o + option->offset, value);
}

/* Adds a positional argument. Most commands accept only SCENE, but some accept several. */
static enum status add_positional(struct app_options *o, enum app_command command, const char *word)
{
    const bool is_scene = command & (IMAGES | APP_INFO) & ~(unsigned)APP_FARM;
    if (command == APP_SELFTEST) {
        log_error("unexpected argument '%s' (see --help)", word);
        return STATUS_USAGE;
    }
    const uint32_t most = command & (APP_DIFF | APP_FARM) ? 2
                          : command == APP_MERGE          ? APP_POSITIONAL_COUNT - 1
                                                          : 1;
    const char **args = is_scene ? &o->image.scene.name : o->positionals;
    uint32_t count = 0;
    while (count < most && args[count])
        count++;
    if (count < most) {
        args[count] = word;
        return STATUS_OK;
    }
    if (most > 1)
        log_error("unexpected argument '%s': expected at most %u (see --help)", word, most);
    else
        log_error("unexpected argument '%s': the %s is already '%s'", word,
                  is_scene ? "scene" : "list", args[0]);
    return STATUS_USAGE;
}

static enum status refuse_traced(const struct setup_image *image)
{
    if (image->refraction != &cpu_reference_settings)
        return STATUS_OK;
    log_error("--refraction: only firn render supports 'reference'; choose another refraction "
              "model");
    return STATUS_USAGE;
}

/* Checks that the refraction model draws all requested layers. Call it after option parsing. */
static enum status check_layers(struct setup_image *image)
{
    uint64_t made = 0;
    for (uint32_t i = 0; techniques_layer(i); i++) {
        const struct frame_layer *layer = techniques_layer(i);
        const bool is_made = image_session_has_layer(image->refraction, layer) ||
                             (!image->is_refraction_named && /* it may become trace */
                              image_session_has_layer(&refract_trace, layer));
        const bool is_shown = image->show == layer;
        made |= is_made ? UINT64_C(1) << i : 0;
        if (is_made || !(image->layers & UINT64_C(1) << i || is_shown))
            continue;
        log_error("--%s: layer '%s' is not available with --refraction %s (firn list layers)",
                  is_shown ? "show" : "aov", layer->name, image->refraction->refraction.name);
        return STATUS_USAGE;
    }
    if (image->all_layers)
        image->layers = made;
    return STATUS_OK;
}

void app_default_output(struct app_options *o, enum app_command command)
{
    const struct {
        unsigned commands;
        const char *name;
    } defaults[] = {
        { APP_RENDER | APP_FARM, o->render.frames ? "firn.####.exr" : "firn.exr" },
        { APP_MERGE, "merged.exr" },
        { APP_SHEET, "sheet.png" },
    };

    for (size_t i = 0; i < sizeof(defaults) / sizeof(defaults[0]); i++) {
        if (defaults[i].commands & command && !o->run.outputs.count)
            o->run.outputs.paths[o->run.outputs.count++] = defaults[i].name;
    }
}

/* Checks that the exposure is stated only once. */
static enum status check_exposure(const struct setup_exposure *exposure)
{
    if (!exposure->is_option || !exposure->is_set)
        return STATUS_OK;
    log_error("--exposure conflicts with --set tonemap.exposure: state the exposure once");
    return STATUS_USAGE;
}

/* Checks that no output file is also an input or another output. */
static enum status check_files(const struct app_options *o, enum app_command command)
{
    struct option_file files[OPTION_COUNT + SETUP_OUTPUT_COUNT + APP_POSITIONAL_COUNT + 2];
    char *sums = o->render.keep_sums ? option_sums_file(option_sums_image(o)) : NULL;
    size_t count = 0;
    for (size_t i = 0; i < OPTION_COUNT; i++) {
        const bool is_input = options[i].set == option_input;
        if (!(options[i].commands & command) || !(is_input || options[i].set == option_report))
            continue;
        const char *path = *(const char *const *)((const char *)o + options[i].offset);
        if (path)
            files[count++] = (struct option_file){ options[i].name, path, !is_input };
    }
    for (uint32_t i = 0; i < o->run.outputs.count; i++)
        files[count++] = (struct option_file){ command == APP_VIEW ? "screenshot" : "output",
                                               o->run.outputs.paths[i], true };
    if (o->image.scene.name && !scene_is_known(o->image.scene.name))
        files[count++] = (struct option_file){ NULL, o->image.scene.name, false };
    for (size_t i = 0; i < APP_POSITIONAL_COUNT && o->positionals[i]; i++)
        files[count++] = (struct option_file){ NULL, o->positionals[i], false };
    if (sums)
        files[count++] = (struct option_file){ "keep-sums", sums, true };
    const enum status status = option_check_files(files, count);
    free(sums);
    return status;
}

static void init_defaults(struct app_options *o, enum app_command command)
{
    *o = (struct app_options){
        .image = {
            .scene = {
                .reader = { .program = "/proc/self/exe" },
                .settings = settings_default(),
            },
            .refraction = &refract_bounce,
            .width = 1024,
            .height = 768,
            .samples = 1,
        },
        .window = { .present = VK_PRESENT_MODE_FIFO_KHR },
        .profile = { .warmup = 5, .run_count = 30, .threshold = APP_PROFILE_THRESHOLD },
        .ladder = { .run_count = 10 },
    };
    if (command & (APP_RENDER | APP_FARM))
        o->image.samples = 0; /* option_check_reference() sets the default */
    if (command == APP_VIEW)
        o->image.samples = 0; /* the viewer sets the default */
    if (command == APP_LADDER) {
        option_ladder_settings(&o->image.scene.settings);
        o->image.width = o->image.height = 512;
    }
    if (command == APP_SHEET) {
        o->image.width = 320;
        o->image.height = 240;
    }
}

enum status app_parse(struct app_options *o, enum app_command command, int argc, char **argv,
                      bool *done)
{
    bool options_ended = false;
    *done = false;
    init_defaults(o, command);
    for (int i = 0; i < argc; i++) {
        enum status status = STATUS_OK;
        const char *word = argv[i];
        if (!options_ended && (!strcmp(word, "--help") || !strcmp(word, "-h"))) {
            app_help(command);
            *done = true;
            return STATUS_OK;
        }
        if (!options_ended && !strcmp(word, "--")) {
            options_ended = true;
        } else if (!options_ended && word[0] == '-' && word[1]) {
            status = parse_option(o, command, argv, &i);
        } else {
            status = add_positional(o, command, word);
        }
        if (status != STATUS_OK)
            return status;
    }
    if (!(command & (APP_RENDER | APP_FARM)) && refuse_traced(&o->image) != STATUS_OK)
        return STATUS_USAGE;
    o->image.scene.quiet = o->run.quiet;
    if (o->ladder.whole)
        option_ladder_whole(&o->image.scene);
    if (command != APP_FARM) /* firn farm adds its default output later */
        app_default_output(o, command);
    enum status status = check_layers(&o->image);
    const bool rests = command == APP_VIEW && !o->window.frame_count;
    if (command & (APP_RENDER | APP_FARM) || rests)
        option_default_quality(o, command);
    if (status == STATUS_OK && command & (APP_RENDER | APP_FARM))
        status = option_check_reference(o);
    if (status == STATUS_OK)
        status = check_files(o, command);
    if (status == STATUS_OK)
        status = check_exposure(&o->image.scene.exposure);
    return status == STATUS_OK ? setup_apply_preset(&o->image.scene) : status;
}

void app_print_render_arguments(char *const *args, enum app_command command, uint32_t skip,
                                FILE *out)
{
    bool options_ended = false;
    for (; *args; args++) {
        const char *value = "";
        const bool is_option = !options_ended && args[0][0] == '-' && args[0][1];
        const bool is_last = is_option && !strcmp(*args, "--");
        const struct option *option = is_option && !is_last ? split(*args, command, &value) : NULL;
        const bool has_next = option && option->value && !value && !option_is_optional(option);
        const bool skipped = !is_option && skip > 0;
        options_ended = options_ended || is_last;
        skip -= skipped;
        if (!skipped && (!option || option->commands & APP_RENDER)) {
            putc(' ', out);
            shell_quote_word(*args, out);
            if (has_next) {
                putc(' ', out);
                shell_quote_word(args[1], out);
            }
        }
        args += has_next;
    }
}

/* Sets only options whose fields are in struct setup_image. */
enum status app_set_option(struct setup_image *image, const char *name, const char *value)
{
    const struct option *option = find_long(name, strlen(name), APP_GRAPH);
    char assignment[256];
    _Static_assert(offsetof(struct app_options, image) == 0,
                   "offsets are those in struct app_image");
    if (option && option->offset < sizeof(*image) && strcmp(name, "set") != 0) {
        const enum status status = option->set(option, (char *)image + option->offset, value);
        if (status == STATUS_OK && !strcmp(name, "preset"))
            return setup_apply_preset(&image->scene);
        return status == STATUS_OK ? refuse_traced(image) : status;
    }
    snprintf(assignment, sizeof(assignment), "%s=%s", name, value);
    return option_set(option, &image->scene, assignment);
}

/* ---- options of the library ---- */

void option_init_render(struct setup_image *image)
{
    struct app_options o;
    init_defaults(&o, APP_RENDER);
    *image = o.image;
}

/* Options that the library refuses: a renderer sets them, or they describe output files. */
static bool is_of_files(const struct option *option)
{
    static const char *const names[] = { "size",        "aov",      "show", "tiles", "tile",
                                         "interleaved", "png-bits", "ocio", NULL };
    return option_find_word(names, sizeof(names) / sizeof(names[0]) - 1, option->name) >= 0;
}

enum status option_set_render(struct setup_image *image, const char *name, const char *value)
{
    const struct option *option = find_long(name, strlen(name), APP_RENDER);
    char assignment[256];
    if (!option && strchr(name, '.')) {
        if (snprintf(assignment, sizeof(assignment), "%s=%s", name, value) <
            (int)sizeof(assignment))
            return option_set(option, &image->scene, assignment);
        log_error("%.64s: the value is too long", name);
        return STATUS_USAGE;
    }
    if (!option)
        return refuse_option(name, APP_RENDER);
    if (option->offset >= sizeof(*image) || is_of_files(option)) {
        log_error("--%s: not an option of a scene; it is for files that firn render writes",
                  option->name);
        return STATUS_USAGE;
    }
    if (!option->value && *value) {
        log_error("--%s: expected no value, got '%s'", option->name, value);
        return STATUS_USAGE;
    }
    return option->set(option, (char *)image + option->offset, option->value ? value : NULL);
}

enum status option_set_node_material(struct setup_scene *scene, const char *value)
{
    return option_node_material(find_long("material", 8, APP_RENDER), scene, value);
}

bool option_is_of_scene(const char *name)
{
    const struct option *option = find_long(name, strlen(name), APP_RENDER);
    _Static_assert(offsetof(struct app_options, image.scene) == 0, "the scene comes first");
    return option && option->offset < sizeof(struct setup_scene);
}

enum status option_complete_render(struct setup_image *image)
{
    struct app_options o;
    init_defaults(&o, APP_RENDER);
    o.image = *image;
    enum status status = check_layers(&o.image);
    option_default_quality(&o, APP_RENDER);
    if (status == STATUS_OK)
        status = option_check_reference(&o);
    if (status == STATUS_OK)
        status = check_exposure(&o.image.scene.exposure);
    if (status == STATUS_OK)
        status = setup_apply_preset(&o.image.scene);
    *image = o.image;
    return status;
}
