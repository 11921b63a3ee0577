/* cmd_list.c: command firn list: prints scenes, settings, layers, devices and the like. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/app/app.h"
#include "src/app/list_json.h"
#include "src/base/log.h"
#include "src/file/sandbox.h"
#include "src/gpu/gpu.h"
#include "src/lab/reference/reference.h"
#include "src/scene/bundled_assets.h"
#include "src/scene/material.h"
#include "src/settings/quality.h"
#include "src/tech/refract/cpu_reference_settings.h"
#include "src/version.h"

static void print_assets(enum asset_kind kind)
{
    for (const struct asset *a = assets; a->name; a++) {
        if (a->kind == kind)
            printf("  %-14s %s\n", a->name, a->help);
    }
}

static enum status list_scenes(void)
{
    for (const struct scene_builtin *b = scene_builtins; b->name; b++) {
        printf("  %-14s %s", b->name, b->help);
        if (b->triangles)
            printf(", %u triangles", b->triangles);
        printf("\n");
    }
    print_assets(ASSET_SCENE);
    printf("  %-14s %s\n", "FILE", "model file: .gltf, .glb, .obj, .ply");
    return STATUS_OK;
}

static enum status list_environments(void)
{
    print_assets(ASSET_ENVIRONMENT);
    printf("  %-14s %s\n", "valley", "landscape of the paper, under the built-in sky; also: sky");
    printf("  %-14s %s\n", "FILE", "equirectangular .exr or .hdr, or a strip of six cube faces");
    return STATUS_OK;
}

static enum status list_refraction_models(void)
{
    const struct technique *refraction;
    for (size_t r = 0; (refraction = techniques_refraction(r)); r++)
        printf("  %-14s %s\n", refraction->refraction.name, refraction->help);
    printf("  %-14s %s%s\n", cpu_reference_settings.refraction.name, cpu_reference_settings.help,
           reference_is_built() ? "" : " (not available: this build has no Embree)");
    return STATUS_OK;
}

static enum status list_materials(void)
{
    for (const struct material_preset *m = material_presets; m->name; m++)
        printf("  %-14s %-7g %s\n", m->name, (double)m->ior, m->help);
    return STATUS_OK;
}

static enum status list_qualities(void)
{
    for (uint32_t q = 0; q < QUALITY_COUNT; q++) {
        printf("  %-14s %s", qualities[q].name, qualities[q].help);
        const char *separator = ": ";
        for (const struct quality_row *row = quality_rows; row->setting; row++) {
            if (row->values[q]) {
                printf("%s%s=%s", separator, row->setting, row->values[q]);
                separator = " ";
            }
        }
        printf("\n");
    }
    return STATUS_OK;
}

static enum status list_layers(void)
{
    const struct frame_layer *layer;
    for (size_t i = 0; (layer = techniques_layer(i)); i++)
        printf("  %-14s %s%s\n", layer->name, layer->help,
               layer->image ? "" : " (only with --refraction reference)");
    return STATUS_OK;
}

/* Prints the separator and a range such as "0 to 16 metres". Prints nothing for a switch. */
static void print_range(const struct setting *row, const char *separator)
{
    if (row->type == SETTING_FLOAT || row->type == SETTING_COUNT)
        printf("%s%s%.7g to %.7g%s%s", separator, row->has_auto ? "auto or " : "", row->min,
               row->max, row->unit ? " " : "", row->unit ? row->unit : "");
    for (size_t c = 0; row->choices && row->choices[c]; c++)
        printf("%s%s", c ? ", " : separator, row->choices[c]);
}

/* Prints all settings as a file for --preset, with every line commented out. */
static enum status print_preset(void)
{
    const struct settings defaults = settings_default();
    printf("# All settings of firn %s, with their defaults. Remove the '#' of a line to change its "
           "setting.\n",
           FIRN_VERSION);
    for (const struct setting *row = settings_next(NULL); row; row = settings_next(row)) {
        printf("\n# %s", row->help);
        print_range(row, row->choices ? "; one of " : "; ");
        printf("%s\n#%s=", row->type == SETTING_SWITCH ? "; on or off" : "", row->name);
        settings_print(&defaults, row, stdout);
        printf("\n");
    }
    return STATUS_OK;
}

static enum status list_settings(void)
{
    const struct settings defaults = settings_default();
    for (const struct setting *row = settings_next(NULL); row; row = settings_next(row)) {
        printf("  %-22s %s; default ", row->name, row->help);
        settings_print(&defaults, row, stdout);
        print_range(row, row->choices ? ", one of " : ", ");
        printf(row->renamed_from ? "; formerly %s\n" : "\n", row->renamed_from);
    }
    return STATUS_OK;
}

/* Describes how the refraction model `trace` follows rays on a usable device. */
static const char *ray_traversal(const struct gpu_device *device)
{
    if (!device->has_rays)
        return "; traces rays in firn's BVH";
    return device->type == VK_PHYSICAL_DEVICE_TYPE_CPU
               ? "; traces rays in firn's BVH, or with trace.traversal=query by its ray queries"
               : "; traces rays by its ray queries";
}

static enum status list_devices(void)
{
    struct gpu_device *devices = NULL;
    uint32_t count = 0;
    enum status status = gpu_list(&devices, &count);
    for (uint32_t i = 0; i < count; i++)
        printf("  %u  %s (%s), Vulkan %s%s%s\n", i, devices[i].name, devices[i].kind,
               devices[i].version,
               devices[i].refused[0] ? "; not usable: " : ray_traversal(&devices[i]),
               devices[i].refused);
    if (status == STATUS_OK && !count)
        printf("  none: install a Vulkan driver (on Debian: mesa-vulkan-drivers)\n");
    free(devices);
    return status;
}

static enum status list_sandbox(void)
{
    const struct sandbox_support sandbox = sandbox_query();
    if (sandbox.landlock)
        printf(
            "  %-14s version %d: a reader opens its file, or the folder of a model, and no other\n",
            "Landlock", sandbox.landlock);
    else
        printf("  %-14s not in this kernel: a reader can open any file that you can read\n",
               "Landlock");
    printf("  %-14s %s\n", "seccomp",
           sandbox.seccomp ? "a reader starts no process, opens no socket, writes no file"
                           : "not in this kernel: a reader can start processes and open sockets");
    return STATUS_OK;
}

static const struct {
    const char *name;
    enum status (*print)(void);
} lists[] = {
    { "scenes", list_scenes },
    { "environments", list_environments },
    { "refractions", list_refraction_models },
    { "materials", list_materials },
    { "layers", list_layers },
    { "qualities", list_qualities },
    { "settings", list_settings },
    { "devices", list_devices },
    { "sandbox", list_sandbox },
    { "rungs", list_refraction_models }, /* former name */
};

enum {
    LIST_COUNT = sizeof(lists) / sizeof(lists[0]),
    FORMER_LIST = LIST_COUNT - 1 /* printed only by name */
};

static enum status check_topic(const char *topic)
{
    for (size_t i = 0; i < LIST_COUNT; i++) {
        if (!topic || !strcmp(topic, lists[i].name))
            return STATUS_OK;
    }
    log_error(
        "list: expected scenes, environments, refractions, materials, layers, qualities, settings, "
        "devices or sandbox, got '%s'",
        topic);
    return STATUS_USAGE;
}

enum status app_list(const struct app_options *o)
{
    const char *topic = o->positionals[0];
    const bool is_preset = o->run.format == APP_FORMAT_PRESET;
    enum status status = check_topic(topic);
    if (status == STATUS_OK && is_preset && (!topic || strcmp(topic, "settings") != 0)) {
        log_error("--preset: only available as firn list settings --preset");
        return STATUS_USAGE;
    }
    if (status == STATUS_OK && is_preset)
        return print_preset();
    if (status == STATUS_OK && o->run.format == APP_FORMAT_JSON)
        return list_json(topic);
    for (size_t i = 0; i < LIST_COUNT && status == STATUS_OK; i++) {
        if (topic ? strcmp(topic, lists[i].name) != 0 : i == FORMER_LIST)
            continue;
        printf("%s:\n", lists[i].name);
        status = lists[i].print();
    }
    return status;
}
