/* lists.c: firn_setting_get() and firn_layer_get(): descriptions of settings and layers. */
#include "src/lib/lib.h"
#include "src/render/frame/output_layers.h"
#include "src/settings/settings.h"

/* Writes a list entry for the caller and ends the call. `entry` is NULL past the end of the
 * list. */
static firn_status write_entry(struct lib_call *call, void *to, const void *entry, size_t size,
                               uint32_t index)
{
    if (entry)
        return lib_leave(call, lib_write(to, entry, size, "entry"));
    log_error("%u: past the end of the list", index);
    return lib_leave(call, STATUS_USAGE);
}

firn_status firn_setting_get(uint32_t index, struct firn_setting *setting)
{
    struct lib_call call;
    lib_enter_alone(&call);
    const struct setting *row = settings_next(NULL);
    for (uint32_t i = 0; i < index && row; i++)
        row = settings_next(row);
    struct firn_setting found = { .size = sizeof(found) };
    if (row) {
        found.name = row->name;
        found.label = row->label;
        found.help = row->help;
        found.unit = row->unit;
        found.choices = row->type == SETTING_CHOICE ? row->choices : NULL;
        found.type = row->type;
        found.has_auto = row->has_auto;
        found.initial = row->initial;
        found.min = row->min;
        found.max = row->max;
        found.loads_scene =
            row->affects == SETTING_AFFECTS_SCENE || row->switches == SETTING_AFFECTS_SCENE;
    }
    return write_entry(&call, setting, row ? &found : NULL, sizeof(found), index);
}

static const struct frame_layer display_layer = {
    .name = "display",
    .planes = { "R", "G", "B", "A" },
    .mean = true,
    .help = "tone-mapped image, sRGB, as in PNG files",
};

const struct frame_layer *lib_layer(uint32_t index)
{
    return index == 0 ? &frame_beauty : index == 1 ? &display_layer : techniques_layer(index - 2);
}

firn_status firn_layer_get(uint32_t index, struct firn_layer *layer)
{
    struct lib_call call;
    lib_enter_alone(&call);
    const struct frame_layer *row = lib_layer(index);
    struct firn_layer found = { .size = sizeof(found) };
    if (row) {
        found.name = index ? row->name : "beauty";
        found.help = index ? row->help : "linear radiance, and alpha; the image without layers";
        found.channels = frame_layer_plane_count(row);
        found.averages = index == 0 || row->mean;
        found.type = index == 1 ? FIRN_UINT8 : row->integer ? FIRN_UINT32 : FIRN_FLOAT32;
    }
    return write_entry(&call, layer, row ? &found : NULL, sizeof(found), index);
}
