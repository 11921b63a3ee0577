/* gltf_node.c: reads the node hierarchy of a glTF file's scene and computes world transforms. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/scene/import/gltf/gltf.h"

static struct affine local_transform(const struct gltf_node *node)
{
    return node->has_matrix ? node->matrix
                            : affine_compose(node->translation, node->rotation, node->scale);
}

/* Normalises a quaternion. Returns false if its length is 0 or not finite. */
static bool normalize(double rotation[static 4])
{
    double length = 0;
    for (int k = 0; k < 4; k++)
        length += rotation[k] * rotation[k];
    length = sqrt(length);
    for (int k = 0; k < 4 && length > 0; k++)
        rotation[k] /= length;
    return length > 0 && isfinite(length);
}

static void copy_floats(double *to, const float *from, size_t count)
{
    for (size_t k = 0; from && k < count; k++)
        to[k] = (double)from[k];
}

/* Returns an instance attribute with `width` components per instance; NULL if absent or invalid. */
static float *read_instances(const struct gltf_object *attributes, const char *name, uint32_t width,
                             uint32_t *count)
{
    const uint32_t accessor = gltf_index(attributes, name, "accessors");
    struct gltf_array array;
    if (accessor == gltf_none || !gltf_read_floats(attributes->gltf, accessor, &array))
        return NULL;
    if (array.width == width && (*count == 0 || *count == array.count)) {
        *count = array.count;
        return array.values;
    }
    (void)gltf_fault(attributes,
                     "%s: expected as many elements as the other attributes, of %u numbers", name,
                     width);
    free(array.values);
    return NULL;
}

/* Reads EXT_mesh_gpu_instancing, whose attributes give a transform for each instance of a mesh. */
static void read_instancing(const struct gltf_object *object, struct gltf_node *node)
{
    const struct gltf_object instancing = gltf_extension(object, "EXT_mesh_gpu_instancing");
    const struct gltf_object attributes = gltf_member(&instancing, "attributes");
    uint32_t count = 0;
    float *translations = read_instances(&attributes, "TRANSLATION", 3, &count);
    float *rotations = read_instances(&attributes, "ROTATION", 4, &count);
    float *scales = read_instances(&attributes, "SCALE", 3, &count);
    if (count > 0)
        node->instances = calloc(count, sizeof(*node->instances));
    if (count > 0 && !node->instances)
        (void)gltf_out_of_memory(object->gltf);
    for (size_t i = 0; node->instances && i < count; i++) {
        struct gltf_node instance = { .scale = { 1, 1, 1 }, .rotation = { 0, 0, 0, 1 } };
        copy_floats(instance.translation, translations ? &translations[3 * i] : NULL, 3);
        copy_floats(instance.rotation, rotations ? &rotations[4 * i] : NULL, 4);
        copy_floats(instance.scale, scales ? &scales[3 * i] : NULL, 3);
        if (!normalize(instance.rotation))
            memcpy(instance.rotation, (const double[4]){ 0, 0, 0, 1 }, sizeof(instance.rotation));
        node->instances[i] = local_transform(&instance);
    }
    node->instance_count = node->instances ? count : 0;
    free(translations);
    free(rotations);
    free(scales);
}

/* Reads the morph target weights of a node or, if it has none, those of its mesh. */
static void read_weights(const struct gltf_object *object, struct gltf_node *node)
{
    struct gltf *gltf = object->gltf;
    if (node->mesh == gltf_none)
        return;
    const struct gltf_object mesh = gltf_element(gltf, "meshes", node->mesh);
    const struct gltf_object primitive = gltf_item(&mesh, "primitives", 0);
    const uint32_t count = gltf_length(&primitive, "targets");
    node->weights = calloc(count + (size_t)1, sizeof(*node->weights));
    if (!node->weights) {
        (void)gltf_out_of_memory(gltf);
        return;
    }
    node->weight_count = count;
    if (count > 0 && !gltf_floats(object, "weights", node->weights, count))
        (void)gltf_floats(&mesh, "weights", node->weights, count);
}

static void read_node(struct gltf *gltf, uint32_t index)
{
    const struct gltf_object object = gltf_element(gltf, "nodes", index);
    struct gltf_node *node = &gltf->nodes[index];
    double matrix[16];
    *node = (struct gltf_node){
        .scale = { 1, 1, 1 },
        .rotation = { 0, 0, 0, 1 },
        .mesh = gltf_index(&object, "mesh", "meshes"),
        .camera = gltf_index(&object, "camera", "cameras"),
        .skin = gltf_index(&object, "skin", "skins"),
        .parent = gltf_none,
    };
    (void)snprintf(node->name, sizeof(node->name), "%s", gltf_string(&object, "name", ""));
    node->has_matrix = gltf_doubles(&object, "matrix", matrix, 16);
    if (node->has_matrix)
        node->matrix = affine_from_columns(matrix);
    (void)gltf_doubles(&object, "translation", node->translation, 3);
    (void)gltf_doubles(&object, "rotation", node->rotation, 4);
    (void)gltf_doubles(&object, "scale", node->scale, 3);
    if (!normalize(node->rotation))
        (void)gltf_fault(&object, "rotation: expected a unit quaternion");
    read_instancing(&object, node);
    read_weights(&object, node);
}

/* Appends a node to the order in which nodes of the scene are visited. */
static void list_node(struct gltf *gltf, const struct gltf_object *owner, uint32_t index,
                      uint32_t parent)
{
    if (index == gltf_none)
        return;
    struct gltf_node *node = &gltf->nodes[index];
    if (node->is_listed) {
        (void)gltf_fault(owner, "nodes[%u] occurs twice in the scene", index);
        return;
    }
    node->is_listed = true;
    node->parent = parent;
    gltf->order[gltf->order_count++] = index;
}

/* Lists the scene's root nodes. If the file has no scene, lists all nodes without a parent. */
static void list_roots(struct gltf *gltf)
{
    const struct gltf_object top = gltf_top(gltf);
    uint32_t scene = gltf_index(&top, "scene", "scenes");
    if (scene == gltf_none && gltf_list_length(gltf, "scenes") > 0)
        scene = 0;
    if (gltf_list_length(gltf, "scenes") > 1)
        gltf->undrawn |= 1u << GLTF_OTHER_SCENES;
    if (scene != gltf_none) {
        const struct gltf_object object = gltf_element(gltf, "scenes", scene);
        const uint32_t count = gltf_length(&object, "nodes");
        for (uint32_t i = 0; i < count && gltf->status == STATUS_OK; i++)
            list_node(gltf, &object, gltf_index_at(&object, "nodes", i, "nodes"), gltf_none);
        return;
    }
    bool *is_child = calloc(gltf->node_count + (size_t)1, sizeof(*is_child));
    if (!is_child) {
        (void)gltf_out_of_memory(gltf);
        return;
    }
    for (uint32_t i = 0; i < gltf->node_count && gltf->status == STATUS_OK; i++) {
        const struct gltf_object object = gltf_element(gltf, "nodes", i);
        const uint32_t count = gltf_length(&object, "children");
        for (uint32_t k = 0; k < count && gltf->status == STATUS_OK; k++) {
            const uint32_t child = gltf_index_at(&object, "children", k, "nodes");
            if (child != gltf_none)
                is_child[child] = true;
        }
    }
    for (uint32_t i = 0; i < gltf->node_count && gltf->status == STATUS_OK; i++)
        list_node(gltf, &top, is_child[i] ? gltf_none : i, gltf_none);
    free(is_child);
}

/* Lists nodes breadth first rather than recursively, because a file may nest them deeply. */
static void list_nodes(struct gltf *gltf)
{
    list_roots(gltf);
    for (uint32_t i = 0; i < gltf->order_count && gltf->status == STATUS_OK; i++) {
        const struct gltf_object object = gltf_element(gltf, "nodes", gltf->order[i]);
        const uint32_t count = gltf_length(&object, "children");
        for (uint32_t k = 0; k < count && gltf->status == STATUS_OK; k++)
            list_node(gltf, &object, gltf_index_at(&object, "children", k, "nodes"), i);
    }
}

static void compute_transforms(struct gltf *gltf)
{
    for (uint32_t i = 0; i < gltf->order_count && gltf->status == STATUS_OK; i++) {
        struct gltf_node *node = &gltf->nodes[gltf->order[i]];
        const struct affine local = local_transform(node);
        node->model_from_node = local;
        if (node->parent != gltf_none)
            node->model_from_node =
                affine_multiply(&gltf->nodes[gltf->order[node->parent]].model_from_node, &local);
    }
}

enum status gltf_nodes_read(struct gltf *gltf)
{
    gltf->node_count = gltf_list_length(gltf, "nodes");
    gltf->nodes = calloc(gltf->node_count + (size_t)1, sizeof(*gltf->nodes));
    gltf->order = calloc(gltf->node_count + (size_t)1, sizeof(*gltf->order));
    if (!gltf->nodes || !gltf->order) {
        gltf->node_count = 0;
        return gltf_out_of_memory(gltf);
    }
    for (uint32_t i = 0; i < gltf->node_count && gltf->status == STATUS_OK; i++)
        read_node(gltf, i);
    if (gltf->animation != gltf_none && gltf->status == STATUS_OK)
        gltf_animate(gltf, gltf->animation, gltf->time);
    else if (gltf_list_length(gltf, "animations") > 0)
        gltf->undrawn |= 1u << GLTF_ANIMATION;
    if (gltf->status == STATUS_OK)
        list_nodes(gltf);
    compute_transforms(gltf);
    return gltf->status;
}
