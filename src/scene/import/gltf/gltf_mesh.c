/* gltf_mesh.c: reads the primitives of glTF meshes (glTF 2.0, 3.7), with or without Draco. */
#include <cglm/struct.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/scene/import/gltf/gltf.h"
#include "src/scene/import/gltf/gltf_draco.h"

enum mode {
    MODE_POINTS,
    MODE_TRIANGLES = 4,
    MODE_STRIP,
    MODE_FAN,
    MODE_COUNT,
};

void gltf_primitive_finish(struct gltf_primitive *primitive)
{
    free(primitive->indices);
    free(primitive->positions);
    free(primitive->normals);
    free(primitive->colors);
    free(primitive->uvs);
    free(primitive->other_uvs);
    free(primitive->tangents);
    free(primitive->joints);
    free(primitive->weights);
    for (uint32_t i = 0; i < primitive->target_count; i++) {
        free(primitive->targets[i].positions);
        free(primitive->targets[i].normals);
    }
    free(primitive->targets);
    *primitive = (struct gltf_primitive){ 0 };
}

/* Primitive of the file; `draco` is NULL unless its data is Draco-compressed. */
struct source {
    struct gltf_object object, attributes, ids;
    struct gltf_draco *draco;
    uint32_t vertex_count;
};

/* Reads an attribute from Draco data. Returns false if the attribute is stored uncompressed. */
static bool read_draco(const struct source *source, const char *name, struct gltf_array *array)
{
    struct gltf *gltf = source->object.gltf;
    const uint64_t id = gltf_count(&source->ids, name, UINT32_MAX);
    if (!source->draco || id >= UINT32_MAX)
        return false;
    array->count = source->vertex_count;
    array->width = gltf_draco_width(source->draco, (uint32_t)id);
    array->values = malloc((array->width + (size_t)1) * array->count * sizeof(*array->values));
    if (!array->values)
        (void)gltf_out_of_memory(gltf);
    else if (array->width == 0 ||
             !gltf_draco_copy_values(source->draco, (uint32_t)id, array->values))
        (void)gltf_fault(&source->ids, "%s: the mesh has no such attribute", name);
    return true;
}

/* Returns an attribute with `width` components per vertex. If it is absent or a fault occurs,
 * returns NULL. If `width` is 4, attributes of 3 components are padded with 0. */
static float *read_attribute(const struct source *source, const char *name, uint32_t width)
{
    struct gltf *gltf = source->object.gltf;
    const uint32_t accessor = gltf_index(&source->attributes, name, "accessors");
    struct gltf_array array = { 0 };
    if (accessor == gltf_none)
        return NULL;
    if (!read_draco(source, name, &array) && !gltf_read_floats(gltf, accessor, &array))
        return NULL;
    const bool is_padded = width == 4 && array.width == 3;
    if (array.count != source->vertex_count || (array.width != width && !is_padded))
        (void)gltf_fault(&source->attributes,
                         "%s: expected %u elements of %u numbers, got %u of %u", name,
                         source->vertex_count, width, array.count, array.width);
    float *padded = NULL;
    if (is_padded && gltf->status == STATUS_OK) {
        padded = calloc(array.count, 4 * sizeof(*padded));
        if (!padded)
            (void)gltf_out_of_memory(gltf);
        for (size_t i = 0; padded && i < array.count; i++)
            memcpy(&padded[4 * i], &array.values[3 * i], 3 * sizeof(*padded));
    }
    if (!is_padded && gltf->status == STATUS_OK)
        return array.values;
    free(array.values);
    return padded;
}

static void read_uvs(const struct source *source, struct gltf_primitive *primitive)
{
    const struct gltf_material *material = &source->object.gltf->materials[primitive->material];
    char name[32];
    if (material->other_uv_set != gltf_none) {
        (void)snprintf(name, sizeof(name), "TEXCOORD_%u", material->other_uv_set);
        primitive->other_uvs = read_attribute(source, name, 2);
    }
    if (material->textures[MATERIAL_NORMAL].image != gltf_none)
        primitive->tangents = read_attribute(source, "TANGENT", 4);
    if (material->uv_set == gltf_none)
        return;
    (void)snprintf(name, sizeof(name), "TEXCOORD_%u", material->uv_set);
    primitive->uvs = read_attribute(source, name, 2);
    for (size_t i = 0; primitive->uvs && i < primitive->vertex_count; i++) {
        float *uv = &primitive->uvs[2 * i];
        const vec3s in = { { uv[0], uv[1], 1 } };
        uv[0] = glms_vec3_dot(material->uv_rows[0], in);
        uv[1] = glms_vec3_dot(material->uv_rows[1], in);
    }
}

/* Converts a triangle strip or fan with `count` corners to a triangle list. */
static void cut_to_triangles(struct gltf_primitive *primitive, enum mode mode, uint32_t count)
{
    const uint32_t triangles = count < 3 ? 0 : count - 2;
    const uint32_t *from = primitive->indices;
    uint32_t *to = malloc((triangles * (size_t)3 + 1) * sizeof(*to));
    primitive->index_count = 0;
    for (uint32_t i = 0; to && i < triangles; i++) {
        const uint32_t odd = i & 1;
        uint32_t *corners = &to[primitive->index_count];
        corners[0] = mode == MODE_FAN ? from[i + 1] : from[i];
        corners[1] = mode == MODE_FAN ? from[i + 2] : from[i + 1 + odd];
        corners[2] = mode == MODE_FAN ? from[0] : from[i + 2 - odd];
        primitive->index_count += 3;
    }
    free(primitive->indices);
    primitive->indices = to;
}

static void read_indices(const struct source *source, struct gltf_primitive *primitive,
                         enum mode mode)
{
    struct gltf *gltf = source->object.gltf;
    const uint32_t accessor = gltf_index(&source->object, "indices", "accessors");
    uint32_t count = primitive->vertex_count;
    if (gltf->status != STATUS_OK)
        return;
    if (source->draco) {
        count = gltf_draco_index_count(source->draco);
        primitive->indices = malloc((count + (size_t)1) * sizeof(*primitive->indices));
        if (primitive->indices)
            gltf_draco_copy_indices(source->draco, primitive->indices);
        mode = MODE_TRIANGLES; /* Draco decodes strips to triangles */
    } else if (accessor != gltf_none) {
        primitive->indices = gltf_read_indices(gltf, accessor, &count);
    } else {
        primitive->indices = malloc(count * sizeof(*primitive->indices));
        for (uint32_t i = 0; primitive->indices && i < count; i++)
            primitive->indices[i] = i;
    }
    primitive->index_count = count - count % 3;
    if (primitive->indices && mode != MODE_TRIANGLES)
        cut_to_triangles(primitive, mode, count);
    if (!primitive->indices)
        (void)gltf_out_of_memory(gltf);
}

/* Decodes the Draco data of a primitive, if it has any. */
static void open_draco(struct source *source)
{
    struct gltf *gltf = source->object.gltf;
    const struct gltf_object draco = gltf_extension(&source->object, "KHR_draco_mesh_compression");
    const uint32_t view = gltf_index(&draco, "bufferView", "bufferViews");
    size_t stride;
    if (!draco.json || gltf->status != STATUS_OK)
        return;
    if (view == gltf_none) {
        (void)gltf_fault(&draco, "expected a bufferView");
        return;
    }
    const struct gltf_bytes bytes = gltf_view(gltf, view, &stride);
    if (gltf->status != STATUS_OK)
        return;
    source->ids = gltf_member(&draco, "attributes");
    source->draco = gltf_draco_new(bytes.bytes, bytes.size);
    if (!source->draco)
        (void)gltf_fault(&draco, "the compressed data is damaged");
    else if (gltf_draco_vertex_count(source->draco) != source->vertex_count)
        (void)gltf_fault(&draco, "expected %u vertices, got %u", source->vertex_count,
                         gltf_draco_vertex_count(source->draco));
}

static void read_targets(const struct source *source, struct gltf_primitive *primitive)
{
    static const char *const ignored[] = { "COLOR_0", "TEXCOORD_0", "TEXCOORD_1" };
    const uint32_t count = gltf_length(&source->object, "targets");
    primitive->targets = calloc(count + (size_t)1, sizeof(*primitive->targets));
    if (!primitive->targets) {
        (void)gltf_out_of_memory(source->object.gltf);
        return;
    }
    primitive->target_count = count;
    for (uint32_t i = 0; i < count; i++) {
        const struct source target = {
            .object = source->object,
            .attributes = gltf_item(&source->object, "targets", i),
            .vertex_count = source->vertex_count,
        };
        for (size_t k = 0; k < sizeof(ignored) / sizeof(ignored[0]); k++) {
            if (json_object_get(target.attributes.json, ignored[k]))
                source->object.gltf->undrawn |= 1u << GLTF_MORPHED_COLORS;
        }
        primitive->targets[i].positions = read_attribute(&target, "POSITION", 3);
        primitive->targets[i].normals = read_attribute(&target, "NORMAL", 3);
    }
}

static void read_joints(const struct source *source, struct gltf_primitive *primitive)
{
    primitive->joints = read_attribute(source, "JOINTS_0", 4);
    primitive->weights = read_attribute(source, "WEIGHTS_0", 4);
    if (!primitive->joints != !primitive->weights)
        (void)gltf_fault(&source->attributes, "expected both JOINTS_0 and WEIGHTS_0, or neither");
    if (json_object_get(source->attributes.json, "COLOR_1"))
        source->object.gltf->undrawn |= 1u << GLTF_MORE_COLORS;
    if (json_object_get(source->attributes.json, "JOINTS_1"))
        source->object.gltf->undrawn |= 1u << GLTF_MORE_JOINTS;
}

static void read_arrays(struct source *source, struct gltf_primitive *primitive, enum mode mode)
{
    open_draco(source);
    if (source->object.gltf->status == STATUS_OK) {
        primitive->vertex_count = source->vertex_count;
        primitive->positions = read_attribute(source, "POSITION", 3);
        primitive->normals = read_attribute(source, "NORMAL", 3);
        primitive->colors = read_attribute(source, "COLOR_0", 4);
        read_joints(source, primitive);
        read_targets(source, primitive);
        read_uvs(source, primitive);
        read_indices(source, primitive, mode);
    }
    gltf_draco_delete(source->draco);
}

static enum status read_primitive(const struct gltf_object *object,
                                  struct gltf_primitive *primitive)
{
    struct gltf *gltf = object->gltf;
    const uint64_t mode = gltf_count(object, "mode", MODE_TRIANGLES);
    const uint32_t material = gltf_index(object, "material", "materials");
    struct source source = { .object = *object, .attributes = gltf_member(object, "attributes") };
    const uint32_t positions = gltf_index(&source.attributes, "POSITION", "accessors");
    *primitive = (struct gltf_primitive){ 0 };
    if (mode >= MODE_COUNT)
        return gltf_fault(object, "mode: expected 0 to 6");
    if (mode < MODE_TRIANGLES) {
        gltf->undrawn |= 1u << GLTF_POINTS;
        return gltf->status;
    }
    if (positions == gltf_none)
        return gltf_fault(object, "expected an attribute POSITION");
    const struct gltf_object accessor = gltf_element(gltf, "accessors", positions);
    const uint64_t count = gltf_count(&accessor, "count", 0);
    if (count < 1 || count > MODEL_ELEMENT_MAX)
        return gltf_fault(&accessor, "count: expected 1 to %d", MODEL_ELEMENT_MAX);
    if (gltf->status != STATUS_OK)
        return gltf->status;
    source.vertex_count = (uint32_t)count;
    primitive->material = material == gltf_none ? gltf->material_count - 1 : material;
    read_arrays(&source, primitive, (enum mode)mode);
    return gltf->status;
}

static enum status read_mesh(struct gltf *gltf, uint32_t index)
{
    const struct gltf_object object = gltf_element(gltf, "meshes", index);
    const uint32_t count = gltf_length(&object, "primitives");
    struct gltf_mesh *mesh = &gltf->meshes[index];
    mesh->primitives = calloc(count + (size_t)1, sizeof(*mesh->primitives));
    if (!mesh->primitives)
        return gltf_out_of_memory(gltf);
    mesh->count = count;
    for (uint32_t i = 0; i < count && gltf->status == STATUS_OK; i++) {
        const struct gltf_object primitive = gltf_item(&object, "primitives", i);
        (void)read_primitive(&primitive, &mesh->primitives[i]);
    }
    return gltf->status;
}

enum status gltf_meshes_read(struct gltf *gltf)
{
    gltf->mesh_count = gltf_list_length(gltf, "meshes");
    gltf->meshes = calloc(gltf->mesh_count + (size_t)1, sizeof(*gltf->meshes));
    if (!gltf->meshes) {
        gltf->mesh_count = 0;
        return gltf_out_of_memory(gltf);
    }
    for (uint32_t i = 0; i < gltf->order_count && gltf->status == STATUS_OK; i++) {
        const uint32_t mesh = gltf->nodes[gltf->order[i]].mesh;
        if (mesh == gltf_none || gltf->meshes[mesh].is_used)
            continue;
        gltf->meshes[mesh].is_used = true;
        (void)read_mesh(gltf, mesh);
    }
    return gltf->status;
}
