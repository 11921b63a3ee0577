/* offer_materials.c: suggests --material for blended surfaces with names of clear materials. */
#include "src/setup/offer_materials.h"
#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/ascii.h"
#include "src/base/log.h"
#include "src/base/path.h"
#include "src/base/shell_quote.h"
#include "src/base/text_stream.h"

enum {
    OFFERS_MAX = 4, /* options in a note */
};

struct offer {
    const char *name, *preset;
};

static bool is_letter(char c)
{
    return isalpha((unsigned char)c) || (unsigned char)c >= 0x80;
}

/* Returns true if a word may begin or end between two characters: "_g", "wG". */
static bool is_boundary(char before, char after)
{
    return !is_letter(before) || !is_letter(after) ||
           (islower((unsigned char)before) && isupper((unsigned char)after));
}

static bool has_word(const char *name, const char *word)
{
    const size_t length = strlen(word);
    for (size_t i = 0; i + length <= strlen(name); i++) {
        if (ascii_begins_equal(&name[i], word, length) &&
            (i == 0 || is_boundary(name[i - 1], name[i])) &&
            is_boundary(name[i + length - 1], name[i + length]))
            return true;
    }
    return false;
}

const char *offer_material_for(const char *name)
{
    static const char *const presets[][2] = {
        { "glass", "glass" }, { "crystal", "glass" }, { "diamond", "diamond" },
        { "water", "water" }, { "ice", "ice" },
    };
    for (size_t i = 0; i < sizeof(presets) / sizeof(presets[0]); i++) {
        if (has_word(name, presets[i][0]))
            return presets[i][1];
    }
    return NULL;
}

/* Returns the option for a blended surface of an object. Its preset is NULL if there is none. */
static struct offer offer_for(const struct material *material, const char *node)
{
    const char *preset = offer_material_for(material->name);
    if (preset)
        return (struct offer){ material->name, preset };
    return (struct offer){ node, offer_material_for(node) };
}

/* Lists the options for all blended surfaces; returns their number, at most OFFERS_MAX. */
static uint32_t find_offers(const struct model *model, struct offer offers[static OFFERS_MAX])
{
    const struct mesh *mesh = &model->surroundings;
    uint32_t count = 0;
    uint32_t last_object = UINT32_MAX, last_material = 0;
    for (uint32_t i = 0; i < mesh->index_count && count < OFFERS_MAX; i += 3) {
        const uint32_t vertex = mesh->indices[i];
        const uint32_t material = mesh->vertices[vertex].material >> MESH_SURFACE_SHIFT;
        if (material == 0 || material > model->material_count ||
            !(model->materials[material - 1].flags & MATERIAL_IS_BLENDED))
            continue;
        const uint32_t object = model_surroundings_find_object(model, vertex);
        if (object == last_object && material == last_material)
            continue;
        last_object = object;
        last_material = material;
        const struct offer offer =
            offer_for(&model->materials[material - 1],
                      object > 0 ? model->surroundings_names[object - 1] : "");
        bool is_new = offer.preset != NULL;
        for (uint32_t k = 0; k < count && is_new; k++)
            is_new = strcmp(offers[k].name, offer.name) != 0;
        if (is_new)
            offers[count++] = offer;
    }
    return count;
}

void offer_materials(const char *path, const struct model *model)
{
    struct offer offers[OFFERS_MAX];
    const bool is_gltf = path_ends_in(path, ".gltf") || path_ends_in(path, ".glb");
    const uint32_t count = is_gltf ? find_offers(model, offers) : 0;
    struct text_stream stream;
    if (!count)
        return;
    FILE *out = text_stream_open(&stream);
    for (uint32_t i = 0; out && i < count; i++) {
        char option[MATERIAL_NAME_SIZE + 16];
        (void)snprintf(option, sizeof(option), "%s=%s", offers[i].name, offers[i].preset);
        fputs(" --material ", out);
        shell_quote_word(option, out);
    }
    char *text = text_stream_close(&stream, NULL);
    if (text)
        log_note("%s: alpha-blended surfaces do not refract; to draw them as clear objects, use%s",
                 path, text);
    free(text);
}
