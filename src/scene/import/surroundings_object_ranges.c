/* surroundings_object_ranges.c: names and vertex ranges of the objects in a model's surroundings.
 */
#include <stdlib.h>
#include <string.h>
#include "src/scene/import/model.h"

static bool grow(struct model *model)
{
    const size_t count = (size_t)model->surroundings_object_count + MODEL_SURROUNDINGS_ROW;
    uint32_t *starts = realloc(model->surroundings_starts, count * sizeof(*starts));
    if (starts)
        model->surroundings_starts = starts;
    char(*names)[MATERIAL_NAME_SIZE] = realloc(model->surroundings_names, count * sizeof(*names));
    if (names)
        model->surroundings_names = names;
    if (!starts || !names)
        return false;
    memset(&starts[model->surroundings_object_count], 0, MODEL_SURROUNDINGS_ROW * sizeof(*starts));
    return true;
}

bool model_surroundings_add_object(struct model *model, const char *name, uint32_t start)
{
    const uint32_t i = model->surroundings_object_count;
    if (i % MODEL_SURROUNDINGS_ROW == 0 && !grow(model))
        return false;
    model->surroundings_starts[i] = start;
    (void)strncpy(model->surroundings_names[i], name, MATERIAL_NAME_SIZE - 1);
    model->surroundings_names[i][MATERIAL_NAME_SIZE - 1] = '\0';
    model->surroundings_object_count++;
    return true;
}

uint32_t model_surroundings_find_object(const struct model *model, uint32_t vertex)
{
    uint32_t low = 0, high = model->surroundings_object_count;
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        if (model->surroundings_starts[middle] <= vertex)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}
