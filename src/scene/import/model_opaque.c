/* model_opaque.c: names and vertex ranges of the objects in a model's surroundings. */
#include <stdlib.h>
#include <string.h>
#include "src/scene/import/model.h"

static bool grow(struct model *model)
{
    const size_t count = (size_t)model->opaque_count + MODEL_OPAQUE_WIDTH;
    uint32_t *starts = realloc(model->opaque_starts, count * sizeof(*starts));
    if (starts)
        model->opaque_starts = starts;
    char(*names)[MATERIAL_NAME_SIZE] = realloc(model->opaque_names, count * sizeof(*names));
    if (names)
        model->opaque_names = names;
    if (!starts || !names)
        return false;
    memset(&starts[model->opaque_count], 0, MODEL_OPAQUE_WIDTH * sizeof(*starts));
    return true;
}

bool model_opaque_add(struct model *model, const char *name, uint32_t start)
{
    const uint32_t i = model->opaque_count;
    if (i % MODEL_OPAQUE_WIDTH == 0 && !grow(model))
        return false;
    model->opaque_starts[i] = start;
    (void)strncpy(model->opaque_names[i], name, MATERIAL_NAME_SIZE - 1);
    model->opaque_names[i][MATERIAL_NAME_SIZE - 1] = '\0';
    model->opaque_count++;
    return true;
}

uint32_t model_opaque_find(const struct model *model, uint32_t vertex)
{
    uint32_t low = 0, high = model->opaque_count;
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        if (model->opaque_starts[middle] <= vertex)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}
