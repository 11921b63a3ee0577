/* option_help.c: the text that --help prints for a command. */
#include "src/app/options/option_help.h"
#include <stdio.h>
#include <string.h>
#include "src/app/options/option_values.h"

static const char *const examples[] = {
    [APP_RENDER] = ("  firn render ice-cube -o ice.exr -o ice.png\n"
                    "  firn render statue.glb --env studio.hdr --samples 16 -o statue.png\n"
                    "  firn render sphere --refraction one-sided --aov exit -o sphere.exr\n"
                    "  firn render ice-cube --frames 0-99 --resume -o turn.####.png\n"),
    [APP_GRAPH] = ("  firn graph ice-cube\n"
                   "  firn graph ice-cube --html > plan.html\n"
                   "  firn graph ice-cube --refraction one-sided --json > plan.json\n"),
    [APP_VIEW] = ("  firn view ice-cube\n"
                  "  firn view statue.glb --env studio.hdr --set motion.ice=0\n"
                  "  firn view sphere --frames 100 --time-step 0.04 --screenshot last.png\n"),
    [APP_PROFILE] = ("  firn profile ice-cube\n"
                     "  firn profile ice-cube --trace trace.json\n"
                     "  firn profile ice-cube --json before.json\n"
                     "  firn profile ice-cube --baseline before.json\n"
                     "  firn profile ice-cube --sweep cracks.count=1,4,16,64\n"),
    [APP_DIFF] = ("  firn diff reference.exr test.exr\n"
                  "  firn diff before.png after.png -o errors.png\n"
                  "  firn diff a.exr b.exr --mask a.exr --mask-channel thickness.Z --json\n"
                  "  firn diff golden.exr new.exr --fail-above flip=0.01 --fail-above angle=0.1\n"),
    [APP_LADDER] = ("  firn ladder\n"
                    "  firn ladder sphere --size 256x256 -o ladder.png -o ladder.exr\n"
                    "  firn ladder statue.glb --rungs paper,search,bounce --runs 0 --json\n"
                    "  firn ladder valley --whole --rungs bounce\n"
                    "  firn ladder valley --furnace\n"),
    [APP_SHEET] = ("  firn sheet sample -o materials.png\n"
                   "  firn sheet sphere --sweep refract.crossfade=0,0.5,1 "
                   "--set refract.fresnel=crossfade -o fade.png\n"
                   "  firn sheet room --sweep refraction=paper,bounce --sweep "
                   "refract.lookup=infinite,box\n"),
    [APP_FARM] = ("  firn farm slurm ice-cube --frames 1-250 -o turn.####.exr\n"
                  "  firn farm slurm ice-cube --frames 1-250 -o turn.####.exr --tasks 25 "
                  "--sbatch --time=1:00:00\n"
                  "  firn farm parallel ice-cube --frames 1-250 -o turn.####.exr "
                  "--hosts one,two,:\n"
                  "  firn farm status ice-cube --frames 1-250 -o turn.####.exr\n"),
    [APP_MERGE] = ("  firn render ice-cube --size 16384x8192 --tiles 4x2 --tile 1 -o tile.1.exr\n"
                   "  firn merge tile.*.exr -o still.exr\n"),
    [APP_INFO] = ("  firn info drink\n"
                  "  firn info statue.glb --json\n"),
    [APP_SELFTEST] = ("  firn selftest\n"
                      "  firn selftest --device 0\n"),
    [APP_LIST] = ("  firn list\n"
                  "  firn list settings\n"
                  "  firn list settings --json\n"
                  "  firn list settings --preset > look.txt\n"),
};

static const char *const usages[] = {
    [APP_RENDER] = "firn render [options] SCENE: render an image to EXR and PNG files",
    [APP_GRAPH] = "firn graph [options] SCENE: print the compiled plan of a frame; needs no device",
    [APP_VIEW] = "firn view [options] [SCENE]: show a scene in a window; F1 lists the keys",
    [APP_PROFILE] = "firn profile [options] SCENE: measure the time of each pass of a frame",
    [APP_DIFF] = "firn diff [options] REFERENCE TEST: measure how much two images differ",
    [APP_LADDER] = ("firn ladder [options] [SCENE]: compare every refraction model with the ray "
                    "traced reference"),
    [APP_SHEET] = "firn sheet [options] SCENE: draw one image per value of a setting, side by side",
    [APP_FARM] =
        "firn farm slurm|parallel|status [options] SCENE: render a sequence on many machines",
    [APP_MERGE] = "firn merge [options] TILE...: join the tiles of an image",
    [APP_INFO] = "firn info [options] SCENE: print the contents of a scene or model file",
    [APP_SELFTEST] =
        "firn selftest [options]: test this machine: list devices, draw and compare five images",
    [APP_LIST] = ("firn list [options] "
                  "[scenes|environments|refractions|materials|layers|qualities|settings|"
                  "devices|sandbox]: print available names, settings and devices"),
};

void option_help(enum app_command command, const struct option *options, size_t count)
{
    const char *group = "";
    printf("%s\n\nExamples:\n%s", usages[command], examples[command]);
    if (strstr(usages[command], "SCENE"))
        printf("\nSCENE is a name (firn list scenes) or a model file "
               "(.gltf .glb .obj .ply .stl).\n");
    if (command == APP_VIEW)
        printf("The default SCENE is ice-cube.\n");
    if (command == APP_FARM)
        printf("\nslurm prints a shell script that submits the frames to Slurm, parallel prints "
               "one for GNU\nparallel. status lists which frames are complete, with exit code 0 if "
               "all are.\n");
    if (command == APP_LADDER)
        printf("\nThe default SCENE is valley. firn ladder draws the smooth object alone, "
               "with\nrefract.fresnel=exact and refract.lookup=distance; --set changes these "
               "settings.\n--whole draws ice with all its inclusions, and cracks as air gaps.\n");
    if (command == APP_DIFF)
        printf(
            "\nREFERENCE and TEST are both .exr or .hdr, or both .png, and have the same size.\n");
    for (size_t i = 0; i < count; i++) {
        const struct option *option = &options[i];
        char left[64];
        if (!(option->commands & command))
            continue;
        if (strcmp(group, option->group) != 0)
            printf("\n%s:\n", option->group);
        group = option->group;
        snprintf(left, sizeof(left), "--%s%s%s", option->name,
                 option_is_optional(option) ? "" : " ", option->value ? option->value : "");
        if (option->letter)
            printf("  -%c, %-22s %s\n", option->letter, left, option->help);
        else
            printf("      %-22s %s\n", left, option->help);
    }
    printf("  -h, %-22s %s\n", "--help", "this text");
}
