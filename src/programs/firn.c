/* firn.c: entry point of firn <command> [options] [SCENE]: parses the command and runs it. */
#include <stdio.h>
#include <string.h>
#include "src/app/app.h"
#include "src/base/log.h"
#include "src/base/standard_streams.h"
#include "src/base/suggest.h"
#include "src/gpu/gpu_fallback.h"
#include "src/scene/import/sandboxed_load.h"

static const struct {
    const char *name;
    enum app_command command;
    enum status (*run)(const struct app_options *options);
    const char *help;
} commands[] = {
    { "render", APP_RENDER, app_render, "render an image to EXR and PNG files" },
    { "view", APP_VIEW, app_view, "show a scene in a window" },
    { "profile", APP_PROFILE, app_profile, "measure the time of each pass of a frame" },
    { "graph", APP_GRAPH, app_graph, "print the compiled plan of a frame; needs no device" },
    { "diff", APP_DIFF, app_diff, "measure how much two images differ" },
    { "ladder", APP_LADDER, app_ladder,
      "compare every refraction model with the ray traced reference" },
    { "sheet", APP_SHEET, app_sheet,
      "draw one image per material or value of a setting, side by side" },
    { "farm", APP_FARM, app_farm, "render a sequence on many machines, by Slurm or GNU parallel" },
    { "merge", APP_MERGE, app_merge, "join the tiles of an image" },
    { "info", APP_INFO, app_info, "print the contents of a scene or model file; needs no device" },
    { "selftest", APP_SELFTEST, app_selftest,
      "test this machine: list devices, draw five images and compare them" },
    { "list", APP_LIST, app_list,
      "print the scenes, refraction models, materials, layers, settings, devices and sandbox" },
};

enum {
    COMMAND_COUNT = sizeof(commands) / sizeof(commands[0])
};

static void print_help(FILE *out)
{
    fprintf(out, "firn: renders ice, glass and water, and measures the error of each image\n\n"
                 "Examples:\n"
                 "  firn render ice-cube -o ice.exr -o ice.png\n"
                 "  firn diff reference.exr ice.exr\n"
                 "  firn ladder sphere -o ladder.png\n"
                 "  firn list settings\n\n"
                 "Commands:\n");
    for (size_t i = 0; i < COMMAND_COUNT; i++)
        fprintf(out, "  %-8s %s\n", commands[i].name, commands[i].help);
    fprintf(out, "  %-8s %s\n\n", "help",
            "this text, or the options of a command: firn help render");
    fprintf(out,
            "Options:\n  -h, --help     this text\n      --version  the version; with --verbose "
            "also how it was built\n");
}

static size_t find_command(const char *name)
{
    size_t i = 0;
    while (i < COMMAND_COUNT && strcmp(commands[i].name, name) != 0)
        i++;
    return i;
}

static enum status unknown(const char *word)
{
    char hint[SUGGEST_HINT_SIZE];
    struct suggest suggest = { .word = word };
    for (size_t i = 0; i < COMMAND_COUNT; i++)
        suggest_offer(&suggest, commands[i].name);
    log_error("unknown command '%s'%s (see --help)", word, suggest_hint(&suggest, hint));
    return STATUS_USAGE;
}

static enum status help(const char *name)
{
    size_t i = name ? find_command(name) : COMMAND_COUNT;
    if (name && i == COMMAND_COUNT)
        return unknown(name);
    if (name)
        app_help(commands[i].command);
    else
        print_help(stdout);
    return STATUS_OK;
}

static enum status run(int argc, char **argv)
{
    struct app_options options;
    bool done;
    if (argc < 2) {
        log_error("no command: expected render, view, profile, graph, diff, ladder, sheet, farm, "
                  "merge, info, selftest or list (see --help)");
        return STATUS_USAGE;
    }
    if (!strcmp(argv[1], "--help") || !strcmp(argv[1], "-h") || !strcmp(argv[1], "help"))
        return help(argc > 2 ? argv[2] : NULL);
    if (!strcmp(argv[1], "--version"))
        return app_version(argc > 2 ? argv[2] : NULL);
    size_t i = find_command(argv[1]);
    if (i == COMMAND_COUNT)
        return unknown(argv[1]);
    enum status status = app_parse(&options, commands[i].command, argc - 2, argv + 2, &done);
    options.run.program = argv[0];
    options.run.args = argv + 1;
    if (status == STATUS_OK && !done)
        status = commands[i].run(&options);
    return status;
}

int main(int argc, char **argv)
{
    if (reader_is_child(argc, argv))
        return sandboxed_load_main(argc, argv);
    standard_streams_begin();
    gpu_fallback_prepare();
    return (int)standard_streams_end(run(argc, argv));
}
