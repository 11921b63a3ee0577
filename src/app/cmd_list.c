/* cmd_list.c: command firn list: prints scenes, settings, layers, devices and the like. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/app/app.h"
#include "src/base/log.h"
#include "src/file/json_text.h"
#include "src/file/sandbox.h"
#include "src/gpu/gpu.h"
#include "src/lab/reference/reference.h"
#include "src/scene/bundled_assets.h"
#include "src/scene/material_presets.h"
#include "src/settings/quality.h"
#include "src/tech/refract/cpu_reference_settings.h"
#include "src/version.h"

/* ---- lists of names ---- */

/* In this file, a NULL json_t means out of memory. jansson functions that are given NULL fail. */

/* Appends the assets of a kind. */
static json_t *append_assets(json_t *all, enum asset_kind kind)
{
    for (const struct asset *a = assets; a->name && all; a++) {
        if (a->kind == kind)
            all = json_text_append(all, json_pack("{s:s, s:s}", "name", a->name, "help", a->help));
    }
    return all;
}

static json_t *scenes(void)
{
    json_t *all = json_array();
    for (const struct scene_builtin *b = scene_builtins; b->name && all; b++)
        all = json_text_append(all, json_pack("{s:s, s:s, s:i}", "name", b->name, "help", b->help,
                                              "triangles", (int)b->triangles));
    all = append_assets(all, ASSET_SCENE);
    return json_text_append(all, json_pack("{s:s, s:s}", "name", "FILE", "help",
                                           "model file: .gltf, .glb, .obj, .ply, .stl"));
}

static json_t *environments(void)
{
    json_t *all = append_assets(json_array(), ASSET_ENVIRONMENT);
    all = json_text_append(all,
                           json_pack("{s:s, s:s}", "name", "valley", "help",
                                     "landscape of the paper, under the built-in sky; also: sky"));
    return json_text_append(all, json_pack("{s:s, s:s}", "name", "FILE", "help",
                                           "equirectangular .exr or .hdr, or six cube faces"));
}

static json_t *refraction_of(const struct technique *refraction, bool is_available)
{
    return json_pack("{s:s, s:s, s:b}", "name", refraction->refraction.name, "help",
                     refraction->help, "available", (int)is_available);
}

static json_t *refraction_models(void)
{
    json_t *all = json_array();
    for (size_t r = 0; techniques_refraction(r) && all; r++)
        all = json_text_append(all, refraction_of(techniques_refraction(r), true));
    return json_text_append(all, refraction_of(&cpu_reference_settings, reference_is_built()));
}

static json_t *rgb(vec3s color)
{
    return json_pack("[f, f, f]", json_text_float(color.x), json_text_float(color.y),
                     json_text_float(color.z));
}

static json_t *material_of(const struct material_preset *m)
{
    return json_pack("{s:s, s:s, s:f, s:f, s:o, s:o, s:f, s:s, s:s}", "name", m->name, "kind",
                     material_kind_names[m->kind], "ior", json_text_float(m->ior), "abbe",
                     json_text_float(m->abbe), "absorption", rgb(m->absorption), "color_after_1_cm",
                     rgb(material_preset_color(m)), "optical_depth",
                     json_text_float(m->optical_depth), "help", m->help, "source", m->source);
}

static json_t *materials(void)
{
    json_t *all = json_array();
    for (const struct material_preset *m = material_presets; m->name && all; m++)
        all = json_text_append(all, material_of(m));
    return all;
}

/* Prints each preset with its index, help, Abbe number, colour after 1 cm and sources. */
static enum status print_materials(void)
{
    for (const struct material_preset *m = material_presets; m->name; m++) {
        const vec3s color = material_preset_color(m);
        printf("  %-15s %-7g %s", m->name, json_text_float(m->ior), m->help);
        if (m->abbe > 0.0f)
            printf("; Abbe number %g", json_text_float(m->abbe));
        if (color.x < 0.995f || color.y < 0.995f || color.z < 0.995f)
            printf("; after 1 cm %.2f %.2f %.2f", (double)color.x, (double)color.y,
                   (double)color.z);
        printf(" [%s]\n", m->source);
    }
    return STATUS_OK;
}

/* Returns the names of a layer's EXR channels. */
static json_t *channels_of(const struct frame_layer *layer)
{
    json_t *all = json_array();
    for (uint32_t p = 0; p < frame_layer_plane_count(layer) && all; p++)
        all = json_text_append(all, json_string(layer->planes[p]));
    return all;
}

static json_t *layers(void)
{
    json_t *all = json_array();
    const struct frame_layer *layer;
    for (size_t i = 0; (layer = techniques_layer(i)) && all; i++)
        all = json_text_append(all, json_pack("{s:s, s:s, s:b, s:b, s:b, s:o}", "name", layer->name,
                                              "help", layer->help, "reference_only",
                                              !layer->image && !layer->is_traced, "traced_only",
                                              layer->needs_bvh, "integer", layer->integer,
                                              "channels", channels_of(layer)));
    return all;
}

/* Returns the quality levels, each with the settings that differ from the defaults. */
static json_t *qualities_all(void)
{
    json_t *all = json_array();
    for (uint32_t q = 0; q < QUALITY_COUNT && all; q++) {
        json_t *values = json_object();
        for (const struct quality_row *row = quality_rows; row->setting && values; row++) {
            if (row->values[q] &&
                json_object_set_new(values, row->setting, json_string(row->values[q])) != 0)
                return NULL;
        }
        all = json_text_append(all, json_pack("{s:s, s:s, s:i, s:o}", "name", qualities[q].name,
                                              "help", qualities[q].help, "samples",
                                              (int)qualities[q].samples, "settings", values));
    }
    return all;
}

/* Prints a list of names as text. */
static enum status print_names(json_t *all)
{
    size_t i;
    json_t *entry, *value;
    const char *key;
    json_array_foreach(all, i, entry)
    {
        const json_t *ior = json_object_get(entry, "ior");
        const json_int_t triangles = json_integer_value(json_object_get(entry, "triangles"));
        printf("  %-14s ", json_string_value(json_object_get(entry, "name")));
        if (ior)
            printf("%-7g ", json_real_value(ior));
        printf("%s", json_string_value(json_object_get(entry, "help")));
        if (triangles)
            printf(", %lld triangles", (long long)triangles);
        if (json_is_true(json_object_get(entry, "reference_only")))
            printf(" (only with --refraction reference)");
        if (json_is_false(json_object_get(entry, "available")))
            printf(" (not available: this build has no Embree)");
        const char *separator = ": ";
        json_object_foreach(json_object_get(entry, "settings"), key, value)
        {
            printf("%s%s=%s", separator, key, json_string_value(value));
            separator = " ";
        }
        printf("\n");
    }
    json_decref(all);
    return all ? STATUS_OK : log_out_of_memory(NULL);
}

/* ---- settings ---- */

/* Returns an integer, a number, a boolean or a string, depending on the type of the setting. */
static json_t *value_of(const struct setting *row, double value)
{
    switch (row->type) {
    case SETTING_FLOAT:
        if (setting_is_auto(row, value))
            return json_string("auto");
        return json_real(json_text_float((float)value));
    case SETTING_COUNT:
        if (setting_is_auto(row, value))
            return json_string("auto");
        return json_integer((json_int_t)value);
    case SETTING_SWITCH:
        return json_boolean(value > 0.0);
    case SETTING_CHOICE:
        return json_string(row->choices[(size_t)value]);
    }
    return NULL;
}

static json_t *choices_of(const struct setting *row)
{
    json_t *all = json_array();
    for (size_t c = 0; row->choices && row->choices[c] && all; c++)
        all = json_text_append(all, json_string(row->choices[c]));
    return all;
}

static json_t *setting_of(const struct setting *row)
{
    static const char *const types[] = {
        [SETTING_FLOAT] = "number",
        [SETTING_COUNT] = "count",
        [SETTING_SWITCH] = "switch",
        [SETTING_CHOICE] = "choice",
    };
    const bool has_range = row->type == SETTING_FLOAT || row->type == SETTING_COUNT;
    return json_pack("{s:s, s:s, s:s, s:s, s:o, s:o*, s:o*, s:s*, s:o*}", "name", row->name,
                     "label", row->label, "help", row->help, "type", types[row->type], "default",
                     value_of(row, row->initial), "min", has_range ? value_of(row, row->min) : NULL,
                     "max", has_range ? value_of(row, row->max) : NULL, "unit", row->unit,
                     "choices", row->type == SETTING_CHOICE ? choices_of(row) : NULL);
}

static json_t *settings(void)
{
    json_t *all = json_array();
    for (const struct setting *row = settings_next(NULL); row && all; row = settings_next(row))
        all = json_text_append(all, setting_of(row));
    return all;
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

/* ---- the machine ---- */

static enum status devices(json_t **all)
{
    struct gpu_device *found = NULL;
    uint32_t count = 0;
    const enum status status = gpu_list(&found, &count);
    *all = status == STATUS_OK ? json_array() : NULL;
    for (uint32_t i = 0; i < count && *all; i++) {
        const struct gpu_device *device = &found[i];
        *all = json_text_append(
            *all, json_pack("{s:i, s:s, s:s, s:s, s:b, s:b, s:s*}", "number", (int)i, "name",
                            device->name, "kind", device->kind, "vulkan", device->version, "usable",
                            device->refused[0] == '\0', "ray_queries", device->has_rays, "refused",
                            device->refused[0] ? device->refused : NULL));
    }
    free(found);
    return status == STATUS_OK && !*all ? log_out_of_memory(NULL) : status;
}

static json_t *sandbox(void)
{
    const struct sandbox_support sandbox = sandbox_query();
    return json_pack("{s:i, s:b}", "landlock", sandbox.landlock, "seccomp", (int)sandbox.seccomp);
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

/* ---- all lists ---- */

static const struct {
    const char *name;
    json_t *(*make)(void);      /* NULL for the devices */
    enum status (*print)(void); /* NULL: print_names() */
} lists[] = {
    { "scenes", scenes },
    { "environments", environments },
    { "refractions", refraction_models },
    { "materials", materials, print_materials },
    { "layers", layers },
    { "qualities", qualities_all },
    { "settings", settings, list_settings },
    { "devices", NULL, list_devices },
    { "sandbox", sandbox, list_sandbox },
    { "rungs", refraction_models }, /* former name */
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

static enum status add_json(json_t *root, size_t i)
{
    json_t *list = NULL;
    enum status status = STATUS_OK;
    if (lists[i].make)
        list = lists[i].make();
    else
        status = devices(&list);
    if (status == STATUS_OK && json_object_set_new(root, lists[i].name, list) != 0)
        status = log_out_of_memory(NULL);
    return status;
}

static enum status print_text(size_t i)
{
    printf("%s:\n", lists[i].name);
    return lists[i].print ? lists[i].print() : print_names(lists[i].make());
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
    json_t *root = o->run.format == APP_FORMAT_JSON ? json_object() : NULL;
    for (size_t i = 0; i < LIST_COUNT && status == STATUS_OK; i++) {
        if (topic ? strcmp(topic, lists[i].name) != 0 : i == FORMER_LIST)
            continue;
        status = o->run.format == APP_FORMAT_JSON ? add_json(root, i) : print_text(i);
    }
    if (status == STATUS_OK && o->run.format == APP_FORMAT_JSON)
        return json_text_print(root);
    json_decref(root);
    return status;
}
