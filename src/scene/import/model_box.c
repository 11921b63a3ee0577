/*
 * model_box.c: reads the box around the object from the extras of a glTF file's node:
 *
 *     "extras": { "firn": { "box": [[-3, 0, -4], [3, 2.5, 4]] } }
 *
 * assimp 5.2 converts extras to metadata, in which an array is metadata with meaningless keys.
 */
#include <math.h>
#include <string.h>
#include "src/base/log.h"
#include "src/scene/import/model_import.h"

static const struct aiMetadataEntry *find(const struct aiMetadata *data, const char *key)
{
    for (unsigned i = 0; data && i < data->mNumProperties; i++) {
        if (!strcmp(data->mKeys[i].data, key))
            return &data->mValues[i];
    }
    return NULL;
}

/* Returns the entry as metadata, or NULL if it has another type. */
static const struct aiMetadata *as_metadata(const struct aiMetadataEntry *entry)
{
    return entry && entry->mType == AI_AIMETADATA ? entry->mData : NULL;
}

static bool read_number(const struct aiMetadataEntry *entry, float *number)
{
    double found = HUGE_VAL;
    if (entry->mType == AI_DOUBLE)
        memcpy(&found, entry->mData, sizeof(double));
    else if (entry->mType == AI_INT32)
        found = *(const int32_t *)entry->mData;
    else if (entry->mType == AI_UINT64)
        found = (double)*(const uint64_t *)entry->mData;
    *number = (float)found;
    return fabs(found) <= MODEL_COORDINATE_MAX; /* false for NaN */
}

static bool read_corner(const struct aiMetadataEntry *entry, vec3s *corner)
{
    const struct aiMetadata *numbers = as_metadata(entry);
    bool good = numbers && numbers->mNumProperties == 3;
    for (unsigned i = 0; good && i < 3; i++)
        good = read_number(&numbers->mValues[i], &corner->raw[i]);
    return good;
}

static bool read_box(const struct aiMetadataEntry *entry, struct box *box)
{
    const struct aiMetadata *corners = as_metadata(entry);
    return corners && corners->mNumProperties == 2 &&
           read_corner(&corners->mValues[0], &box->min) &&
           read_corner(&corners->mValues[1], &box->max) && box->min.x < box->max.x &&
           box->min.y < box->max.y && box->min.z < box->max.z;
}

enum status model_box_read(const struct model_import *import, struct model *model)
{
    for (uint32_t i = 0; import->is_gltf && i < import->node_count; i++) {
        const struct aiNode *node = import->nodes[i].node;
        const struct aiMetadataEntry *box = find(as_metadata(find(node->mMetaData, "firn")), "box");
        if (!box)
            continue;
        if (!read_box(box, &model->box)) {
            log_error("%s: node \"%s\": expected extras.firn.box as [[x,y,z],[x,y,z]], metres, "
                      "minima before maxima",
                      import->path, node->mName.data);
            return STATUS_DATA;
        }
        model->has_box = true;
        return STATUS_OK;
    }
    return STATUS_OK;
}
