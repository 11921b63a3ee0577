/* node_material_option.c: parser of --material NODE=NAME[,KEY=VALUE...]. */
#include "src/app/options/node_material_option.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/app/options/option_values.h"
#include "src/base/log.h"
#include "src/base/suggest.h"
#include "src/scene/material_presets.h"

static const struct key {
    const char *name;
    size_t offset; /* offset of a float in struct material */
    float min, max;
} keys[] = {
    { "ior", offsetof(struct material, ior), 1, 4 },
    { "roughness", offsetof(struct material, roughness), 0, 1 },
    { "transmission", offsetof(struct material, transmission), 0, 1 },
    { "thickness", offsetof(struct material, thickness), 0, 1e6f },
    { "dispersion", offsetof(struct material, dispersion), 0, 10 },
};

enum {
    KEY_COUNT = sizeof(keys) / sizeof(keys[0]),
    PARAMETER_SIZE = 64, /* maximum length of "key=value", bytes */
};

static bool is_word(const char *word, size_t length, const char *name)
{
    return strlen(name) == length && !strncmp(word, name, length);
}

static enum status refuse_key(const char *parameters, const char *word)
{
    char name[SUGGEST_NAME_SIZE], hint[SUGGEST_HINT_SIZE];
    struct suggest suggest = { .word = name };
    snprintf(name, sizeof(name), "%.*s", (int)strcspn(word, "=,"), word);
    for (size_t k = 0; k < KEY_COUNT; k++)
        suggest_offer(&suggest, keys[k].name);
    log_error("--material %s: unknown key '%s'%s; expected ior, roughness, transmission, thickness "
              "or dispersion",
              parameters, name, suggest_hint(&suggest, hint));
    return STATUS_USAGE;
}

/* Parses and sets one parameter of a material, such as "ior=1.52". */
static enum status set_key(struct material_override *made, const char *word, size_t length)
{
    char text[PARAMETER_SIZE];
    const size_t name_length = strcspn(word, "=,");
    const struct key *key = NULL;
    float number;
    for (size_t k = 0; k < KEY_COUNT; k++) {
        if (is_word(word, name_length, keys[k].name))
            key = &keys[k];
    }
    if (!key)
        return refuse_key(made->words, word);
    const char *value = &word[name_length] + (word[name_length] == '=');
    snprintf(text, sizeof(text), "%.*s", (int)(length - (size_t)(value - word)), value);
    if (!option_parse_numbers(text, ',', &number, 1) || number < key->min || number > key->max) {
        log_error("--material %s: %s: expected %g to %g, got '%s'", made->words, key->name,
                  (double)key->min, (double)key->max, text);
        return STATUS_USAGE;
    }
    memcpy((char *)&made->material + key->offset, &number, sizeof(number));
    return STATUS_OK;
}

/* Finds the material name after "NODE=" in an option's value. Returns NULL if there is none. */
static const char *find_material(const char *value, struct material_choice *choice)
{
    for (const char *end = strchr(value, '='); end; end = strchr(end + 1, '=')) {
        if (material_choice_parse(choice, end + 1, strcspn(end + 1, ",")))
            return end;
    }
    return NULL;
}

enum status option_node_material(const struct option *option, struct setup_scene *scene,
                                 const char *value)
{
    struct material_choice choice;
    const char *end = find_material(value, &choice);
    if (scene->material_override_count == SETUP_NODE_COUNT)
        return option_refuse_more(option, value, SETUP_NODE_COUNT);
    if (!end) {
        const char *name = strchr(value, '=') + 1;
        return option_refuse_name(option, OPTION_MATERIALS, name, strcspn(name, ","));
    }
    struct material_override *made = &scene->material_overrides[scene->material_override_count];
    *made = (struct material_override){ .material = material_of_choice(&choice) };
    if (snprintf(made->words, sizeof(made->words), "%s", value) >= MATERIAL_OVERRIDE_SIZE)
        return option_refuse(option, value, "at most 255 bytes");
    snprintf(made->name, sizeof(made->name), "%.*s", (int)(end - value), value);
    if (!made->name[0])
        return option_refuse(option, value, "the name of a node before '='");
    enum status status = STATUS_OK;
    for (const char *word = &end[1 + strcspn(&end[1], ",")]; *word && status == STATUS_OK;) {
        const size_t length = strcspn(++word, ",");
        status = set_key(made, word, length);
        word += length;
    }
    scene->material_override_count += status == STATUS_OK;
    return status;
}
