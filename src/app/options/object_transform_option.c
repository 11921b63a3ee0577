/* object_transform_option.c: parsers of --transform NODE=... and --hide NODE. */
#include "src/app/options/object_transform_option.h"
#include <math.h>
#include <stdio.h>
#include <string.h>
#include "src/app/options/option_values.h"

/* Finds the transform of a node, or adds one. Returns NULL after an error, which it logs. */
static struct object_transform *add(const struct option *option, struct setup_scene *scene,
                                    const char *value, size_t name_length)
{
    char name[MATERIAL_NAME_SIZE];
    snprintf(name, sizeof(name), "%.*s", (int)name_length, value);
    for (uint32_t i = 0; i < scene->object_transform_count; i++) {
        if (!strcmp(scene->object_transforms[i].name, name))
            return &scene->object_transforms[i];
    }
    if (!*name || scene->object_transform_count == SETUP_NODE_COUNT) {
        (void)(*name ? option_refuse_more(option, value, SETUP_NODE_COUNT)
                     : option_refuse(option, value, "the name of a node"));
        return NULL;
    }
    struct object_transform *made = &scene->object_transforms[scene->object_transform_count++];
    *made = (struct object_transform){ 0 };
    memcpy(made->name, name, sizeof(name));
    return made;
}

enum status option_transform(const struct option *option, void *at, const char *value)
{
    static const char expected[] = "NODE=X,Y,Z[,RX,RY,RZ[,SCALE]]: metres up to 1e6, degrees from "
                                   "-360 to 360, and a factor from 1e-6 to 1e6";
    const char *end = strrchr(value, '=');
    float v[OPTION_NUMBERS_MAX] = { [6] = 1.0f };
    if (!end ||
        !(option_parse_numbers(end + 1, ',', v, 3) || option_parse_numbers(end + 1, ',', v, 6) ||
          option_parse_numbers(end + 1, ',', v, 7)))
        return option_refuse(option, value, expected);
    for (int i = 0; i < 6; i++) {
        if (!(fabsf(v[i]) <= (i < 3 ? 1e6f : 360.0f)))
            return option_refuse(option, value, expected);
    }
    if (!(v[6] >= 1e-6f && v[6] <= 1e6f))
        return option_refuse(option, value, expected);
    struct object_transform *made = add(option, at, value, (size_t)(end - value));
    if (!made)
        return STATUS_USAGE;
    memcpy(made->move.raw, v, sizeof(made->move.raw));
    memcpy(made->rotate_deg.raw, &v[3], sizeof(made->rotate_deg.raw));
    made->scale = v[6];
    return STATUS_OK;
}

enum status option_hide(const struct option *option, void *at, const char *value)
{
    struct object_transform *made = add(option, at, value, strlen(value));
    if (!made)
        return STATUS_USAGE;
    made->is_hidden = true;
    return STATUS_OK;
}
