/* bundled_assets.c: table of bundled assets, and the search for their files. */
#include "src/scene/bundled_assets.h"
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/file_info.h"
#include "src/base/log.h"
#include "src/base/program.h"

const struct asset assets[] = {
    {
        .name = "ice-cube",
        .file = "ice-cube.glb",
        .kind = ASSET_SCENE,
        .environment = "alps",
        .settings = { "light.count=0", "ice_caustics.light=sun", "ice_caustics.radius=1.2",
                      "tonemap.exposure=0.9", "bubbles.count=300", "bubbles.size=0.11",
                      "bubbles.shape=grown", "bubbles.aspect=14", "cracks.count=2",
                      "cracks.seed=15", "cracks.refract=gap", "cracks.bump=0.06",
                      "cracks.clip=convex", "refract_bounce.min_throughput=0.04" },
        .help = "cube of ice on wet slate, in front of mountains",
    },
    {
        .name = "drink",
        .file = "drink.glb",
        .kind = ASSET_SCENE,
        .environment = "window",
        .settings = { "light.count=0", "ice_caustics.light=sun", "ice_caustics.radius=1.5",
                      "ground.light=traced", "ground.denoise=on", "trace.footprint=on",
                      "trace.min_branch=0.045", "lens.f_stop=32", "lens.focus=0.24" },
        .help = "tumbler of water with three ice cubes and a straw",
    },
    {
        .name = "amber",
        .file = "amber.glb",
        .kind = ASSET_SCENE,
        .help = "cherries, a leaf and a ring in a block of ice",
    },
    {
        .name = "hollow",
        .file = "hollow.glb",
        .kind = ASSET_SCENE,
        .help = "coloured knot in the cavity of a glass ball",
    },
    {
        .name = "sample",
        .file = "sample.glb",
        .kind = ASSET_SCENE,
        .help = "rounded block before stripes, to compare materials (firn sheet sample)",
    },
    {
        .name = "slate",
        .file = "slate.glb",
        .kind = ASSET_SCENE,
        .environment = "alps",
        .settings = { "light.count=0", "ice_caustics.light=sun", "ice_caustics.radius=1.2",
                      "ground.light=traced", "ground.denoise=on", "trace.footprint=on",
                      "lens.f_stop=120", "tonemap.exposure=0.9" },
        .help = "melting block of ice on wet slate, in front of mountains",
    },
    {
        .name = "studio",
        .file = "studio.exr",
        .kind = ASSET_ENVIRONMENT,
        .help = "dark studio with soft boxes",
    },
    {
        .name = "stage",
        .file = "stage.exr",
        .kind = ASSET_ENVIRONMENT,
        .help = "pool of light on dark, soft boxes, around the floor of --ground",
    },
    {
        .name = "window",
        .file = "window.exr",
        .kind = ASSET_ENVIRONMENT,
        .help = "room with warm walls and a window",
    },
    {
        .name = "alps",
        .file = "alps.exr",
        .kind = ASSET_ENVIRONMENT,
        .help = "mountains around a lake, in the morning",
    },
    {
        .name = "materials",
        .file = "materials.png",
        .kind = ASSET_SHEET,
        .help = "a block of each material",
    },
    {
        .name = "rungs",
        .file = "rungs.png",
        .kind = ASSET_SHEET,
        .help = "an ice cube by each refraction model",
    },
    { 0 },
};

const struct asset *asset_find(const char *name, enum asset_kind kind)
{
    for (const struct asset *a = assets; a->name; a++) {
        if (a->kind == kind && !strcmp(a->name, name))
            return a;
    }
    return NULL;
}

static _Thread_local const char *thread_folder;

const char *asset_set_folder(const char *folder)
{
    const char *earlier = thread_folder;
    thread_folder = folder;
    return earlier;
}

/* Returns the path of `file` in a folder, which the caller frees. If the file does not exist,
 * returns NULL. If out of memory, returns NULL and sets *lacks_memory. */
static char *join_if_exists(const char *folder, const char *file, bool *lacks_memory)
{
    const size_t size = strlen(folder) + strlen(file) + 2;
    char *path = malloc(size);
    if (!path) {
        *lacks_memory = true;
        return NULL;
    }
    snprintf(path, size, "%s/%s", folder, file);
    if (file_info_of(path).kind != FILE_MISSING)
        return path;
    free(path);
    return NULL;
}

static const char *const folders[] = { "../share/firn", "assets" };

/* Returns the path of an asset's file, or NULL if it is not found. The caller frees the path. */
static char *find_path(const struct asset *asset, bool *lacks_memory)
{
    const char *from_variable = getenv("FIRN_ASSETS");
    char folder[PROGRAM_PATH_SIZE];
    char *path = thread_folder ? join_if_exists(thread_folder, asset->file, lacks_memory) : NULL;
    if (!path && from_variable && from_variable[0])
        path = join_if_exists(from_variable, asset->file, lacks_memory);
    for (size_t i = 0; !path && i < sizeof(folders) / sizeof(folders[0]); i++) {
        if (program_path(folder, folders[i]))
            path = join_if_exists(folder, asset->file, lacks_memory);
    }
    return path;
}

bool asset_exists(const struct asset *asset)
{
    bool lacks_memory = false;
    char *path = find_path(asset, &lacks_memory);
    free(path);
    return path != NULL;
}

bool asset_is_valley(const char *name)
{
    return !strcmp(name, "valley") || !strcmp(name, "sky");
}

enum status asset_locate(const struct asset *asset, char **path)
{
    char folder[PROGRAM_PATH_SIZE] = "";
    bool lacks_memory = false;
    *path = find_path(asset, &lacks_memory);
    if (*path)
        return STATUS_OK;
    if (lacks_memory)
        return log_out_of_memory(asset->name);
    (void)program_path(folder, folders[0]);
    log_error("'%s': %s is neither in $FIRN_ASSETS nor in %s; set FIRN_ASSETS to the folder of "
              "firn's assets",
              asset->name, asset->file, folder);
    return STATUS_NO_INPUT;
}
