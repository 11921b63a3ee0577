/* world_position.c: conversion between positions of the file and positions relative to
 * model.origin. */
#include "src/scene/world_position.h"
#include <stdio.h>
#include <stdlib.h>
#include "src/scene/geometry/affine.h"

enum {
    DIGITS_MAX = 15, /* significant digits that a double preserves */
};

bool world_position_is_far(const struct model *model)
{
    bool is_far = false;
    for (int k = 0; k < 3; k++)
        is_far = is_far || model->origin[k] < 0 || model->origin[k] > 0;
    return is_far;
}

int world_position_digits(const struct model *model, int near)
{
    return world_position_is_far(model) ? DIGITS_MAX : near;
}

double world_position_axis(const struct model *model, vec3s relative, int axis)
{
    const double origin = model->origin[axis];
    const float offset = relative.raw[axis];
    char text[32];
    double position = (double)offset;
    if (!world_position_is_far(model))
        return position;
    for (int digits = 6; digits <= DIGITS_MAX; digits++) {
        snprintf(text, sizeof(text), "%.*g", digits, origin + (double)offset);
        position = strtod(text, NULL);
        if ((float)(position - origin) == offset)
            break;
    }
    return position;
}

vec3s world_position_relative(const struct model *model, const double position[static 3])
{
    return affine_relative(position, model->origin);
}
