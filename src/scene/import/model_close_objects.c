/* model_close_objects.c: joins a model's refractive objects that have the same node and medium and
 * that close together. */
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/scene/import/importer.h"

/* Properties of a medium, all of which must be equal. */
struct medium_key {
    float numbers[7];
    int32_t priority;
    uint32_t is_thin; /* 1 + index of the material of a thin wall, which encloses no medium */
    uint32_t material;
};

/* Object to be joined with those of the same group and medium. */
struct member {
    uint32_t object, group, override, medium;
};

static int compare_keys(const void *left, const void *right)
{
    return memcmp(left, right, offsetof(struct medium_key, material));
}

static struct medium_key key_of(const struct material *m, uint32_t index)
{
    const bool is_from_settings = m->flags & MATERIAL_FROM_SETTINGS;
    const bool is_thin = !is_from_settings && !(m->thickness > 0);
    return (struct medium_key){
        .numbers = { m->ior, m->dispersion, m->attenuation_color.x, m->attenuation_color.y,
                     m->attenuation_color.z, m->attenuation_distance, m->scattering_optical_depth },
        .priority = m->flags & MATERIAL_HAS_PRIORITY ? m->priority : INT32_MIN,
        .is_thin = is_thin ? index + 1 : 0,
        .material = index,
    };
}

/* Returns the number of each material's medium, which the caller frees. The numbers of thin walls
 * are above the number of materials. */
static uint32_t *list_media(const struct model *model)
{
    const uint32_t count = model->material_count;
    struct medium_key *keys = calloc(count + (size_t)1, sizeof(*keys));
    uint32_t *media = calloc(count + (size_t)1, sizeof(*media));
    for (uint32_t i = 0; keys && i < count; i++)
        keys[i] = key_of(&model->materials[i], i);
    if (keys)
        qsort(keys, count, sizeof(*keys), compare_keys);
    for (uint32_t i = 0; keys && media && i < count; i++) {
        const bool is_same = i > 0 && compare_keys(&keys[i - 1], &keys[i]) == 0;
        media[keys[i].material] = is_same ? media[keys[i - 1].material] : i;
        if (keys[i].is_thin)
            media[keys[i].material] = count + keys[i].is_thin;
    }
    free(keys);
    return media;
}

static int compare_members(const void *left, const void *right)
{
    const struct member *a = left, *b = right;
    if (a->group != b->group)
        return a->group < b->group ? -1 : 1;
    if (a->override != b->override)
        return a->override < b->override ? -1 : 1;
    if (a->medium != b->medium)
        return a->medium < b->medium ? -1 : 1;
    return a->object < b->object ? -1 : 1;
}

/* Finds the shells of `count` objects of one node and medium. Sets roots[i] to the first object of
 * the same body for each object i. */
static bool find_shells(struct model_build *build, const struct member *members, uint32_t count,
                        uint32_t *roots)
{
    struct model *model = build->model;
    struct shell_part *parts = calloc(count, sizeof(*parts));
    for (uint32_t i = 0; parts && i < count; i++) {
        const uint32_t k = members[i].object;
        parts[i] = (struct shell_part){
            .first_index = model->objects[k].first_index,
            .index_count = model->objects[k].index_count,
            .first_vertex = build->objects[k].first_vertex,
            .vertex_count = build->objects[k].vertex_count,
        };
    }
    const bool is_thin = members[0].medium > model->material_count;
    const bool done =
        parts && model_shells_find(&model->object, parts, count, !is_thin && !build->is_animated,
                                   &build->import->shells);
    for (uint32_t i = 0; done && i < count; i++) {
        const uint32_t root = members[parts[i].object].object;
        roots[members[i].object] = root;
        model->objects[members[i].object].solid_count = is_thin ? 0 : parts[i].solid_count;
        model->objects[root].open_edge_count += parts[i].open_edge_count;
    }
    free(parts);
    return done;
}

/* Joins each object to its root: moves its triangles behind those of the root. */
static bool join(struct model *model, const uint32_t *roots)
{
    const uint32_t count = model->object_count;
    struct member *order = calloc(count + (size_t)1, sizeof(*order));
    struct object *objects = calloc(count + (size_t)1, sizeof(*objects));
    uint32_t *indices = malloc((model->object.index_count + (size_t)1) * sizeof(*indices));
    const bool done = order && objects && indices;
    uint32_t end = 0, joined_count = 0;
    for (uint32_t i = 0; done && i < count; i++)
        order[i] = (struct member){ .object = i, .group = roots[i] };
    if (done)
        qsort(order, count, sizeof(*order), compare_members);
    for (uint32_t i = 0; done && i < count; i++) {
        const struct object *from = &model->objects[order[i].object];
        struct object *to = &objects[joined_count - (joined_count > 0)];
        if (order[i].object == order[i].group) {
            to = &objects[joined_count++];
            *to = *from;
            to->first_index = end;
        } else {
            to->index_count += from->index_count;
            if (to->material != from->material) {
                model->materials[to->material].flags |= MATERIAL_IS_PARTIAL;
                model->materials[from->material].flags |= MATERIAL_IS_PARTIAL;
            }
        }
        memcpy(&indices[end], &model->object.indices[from->first_index],
               from->index_count * sizeof(*indices));
        end += from->index_count;
    }
    free(order);
    if (!done) {
        free(objects);
        free(indices);
        return false;
    }
    free(model->objects);
    free(model->object.indices);
    model->objects = objects;
    model->object_count = joined_count;
    model->object.indices = indices;
    return true;
}

/* Drops triangles of equal corners. */
static void drop_collapsed(struct model *model)
{
    uint32_t *indices = model->object.indices;
    uint32_t end = 0;
    for (uint32_t i = 0; i < model->object_count; i++) {
        struct object *object = &model->objects[i];
        const uint32_t first = object->first_index, count = object->index_count;
        object->first_index = end;
        for (uint32_t k = first; k < first + count; k += 3) {
            if (indices[k] == indices[k + 1] && indices[k] == indices[k + 2])
                continue;
            memmove(&indices[end], &indices[k], 3 * sizeof(*indices));
            end += 3;
        }
        object->index_count = end - object->first_index;
    }
    model->object.index_count = end;
}

/* Finds the shells of each group of objects, which are consecutive in the sorted members. */
static bool find_all_shells(struct model_build *build, struct member *members, uint32_t count,
                            uint32_t *roots)
{
    bool done = true;
    qsort(members, count, sizeof(*members), compare_members);
    for (uint32_t first = 0, end; done && first < count; first = end) {
        const struct member *a = &members[first];
        for (end = first + 1; end < count; end++) {
            const struct member *b = &members[end];
            if (b->group != a->group || b->override != a->override || b->medium != a->medium)
                break;
        }
        done = find_shells(build, a, end - first, roots);
    }
    return done;
}

/* Joins objects of different nodes that are open on their own, and closed together. */
static bool close_across_nodes(struct model_build *build, struct member *members, uint32_t *roots)
{
    struct model *model = build->model;

    struct {
        uint32_t root, open_edge_count;
    } *before = calloc(model->object_count + (size_t)1, sizeof(*before));

    uint32_t count = 0;
    for (uint32_t i = 0; before && i < model->object_count; i++) {
        const uint32_t object = members[i].object;
        before[object].root = roots[object];
        before[object].open_edge_count = model->objects[object].open_edge_count;
        if (!model->objects[roots[object]].open_edge_count)
            continue;
        members[count] = members[i];
        members[count++].group = 0;
    }
    for (uint32_t i = 0; before && i < count; i++)
        model->objects[members[i].object].open_edge_count = 0;
    const bool done = before && find_all_shells(build, members, count, roots);
    for (uint32_t i = 0; done && i < count; i++) {
        const uint32_t object = members[i].object;
        if (model->objects[roots[object]].open_edge_count)
            roots[object] = before[object].root;
        else
            before[object].open_edge_count = 0;
    }
    for (uint32_t i = 0; done && i < count; i++)
        model->objects[members[i].object].open_edge_count =
            before[members[i].object].open_edge_count;
    free(before);
    return done;
}

enum status model_build_close_objects(struct model_build *build)
{
    struct model *model = build->model;
    const uint32_t count = model->object_count;
    uint32_t *media = list_media(model);
    uint32_t *roots = malloc((count + (size_t)1) * sizeof(*roots));
    struct member *members = calloc(count + (size_t)1, sizeof(*members));
    bool done = media && roots && members, is_joined = false;
    for (uint32_t i = 0; done && i < count; i++) {
        const uint32_t override = build->objects[i].override;
        uint32_t medium = override ? 0 : media[model->objects[i].material];
        if (medium > model->material_count) /* thin walls stay separate */
            medium = model->material_count + 1 + i;
        members[i] = (struct member){ i, build->objects[i].group, override, medium };
    }
    done = done && find_all_shells(build, members, count, roots);
    if (done && !build->is_animated)
        done = close_across_nodes(build, members, roots);
    for (uint32_t i = 0; done && i < count; i++)
        is_joined = is_joined || roots[i] != i;
    if (done && is_joined)
        done = join(model, roots);
    if (done && build->import->shells.shared > 0)
        drop_collapsed(model);
    free(media);
    free(roots);
    free(members);
    return done ? STATUS_OK : log_out_of_memory(build->import->path);
}
