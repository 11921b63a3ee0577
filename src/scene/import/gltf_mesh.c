/* gltf_mesh.c: the triangles of a glTF file's meshes (glTF 2.0, 3.7). */
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/scene/import/gltf.h"

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
    *primitive = (struct gltf_primitive){ 0 };
}

/* Returns an attribute's numbers, `width` of each vertex, or of 3 or 4 if that is 4; NULL if it is
 * absent, or after a fault. */
static float *read_attribute(const struct gltf_object *object, const char *name, uint32_t width,
                             uint32_t vertex_count)
{
    struct gltf *gltf = object->gltf;
    const struct gltf_object attributes = gltf_member(object, "attributes");
    const uint32_t accessor = gltf_index(&attributes, name, "accessors");
    struct gltf_array array;
    if (accessor == gltf_none || !gltf_read_floats(gltf, accessor, &array))
        return NULL;
    const bool is_padded = width == 4 && array.width == 3;
    if (array.count != vertex_count || (array.width != width && !is_padded)) {
        (void)gltf_fault(&attributes, "%s: expected %u elements of %u numbers, got %u of %u", name,
                         vertex_count, width, array.count, array.width);
        free(array.values);
        return NULL;
    }
    if (!is_padded)
        return array.values;
    float *padded = calloc(array.count, 4 * sizeof(*padded));
    if (!padded)
        (void)gltf_no_memory(gltf);
    for (size_t i = 0; padded && i < array.count; i++)
        memcpy(&padded[4 * i], &array.values[3 * i], 3 * sizeof(*padded));
    free(array.values);
    return padded;
}

static void read_uvs(const struct gltf_object *object, struct gltf_primitive *primitive)
{
    const struct gltf_material *material = &object->gltf->materials[primitive->material];
    char name[32];
    if (material->image == gltf_none)
        return;
    (void)snprintf(name, sizeof(name), "TEXCOORD_%u", material->uv_set);
    primitive->uvs = read_attribute(object, name, 2, primitive->vertex_count);
    for (size_t i = 0; primitive->uvs && i < primitive->vertex_count; i++) {
        float *uv = &primitive->uvs[2 * i];
        const vec3s in = { { uv[0], uv[1], 1 } };
        uv[0] = glms_vec3_dot(material->uv_rows[0], in);
        uv[1] = glms_vec3_dot(material->uv_rows[1], in);
    }
}

/* Converts a strip or a fan to triangles. `count` is that of its corners. */
static void cut(struct gltf_primitive *primitive, enum mode mode, uint32_t count)
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

static void read_indices(const struct gltf_object *object, struct gltf_primitive *primitive,
                         enum mode mode)
{
    struct gltf *gltf = object->gltf;
    const uint32_t accessor = gltf_index(object, "indices", "accessors");
    uint32_t count = primitive->vertex_count;
    if (gltf->status != STATUS_OK)
        return;
    if (accessor != gltf_none) {
        primitive->indices = gltf_read_indices(gltf, accessor, &count);
    } else {
        primitive->indices = malloc(count * sizeof(*primitive->indices));
        for (uint32_t i = 0; primitive->indices && i < count; i++)
            primitive->indices[i] = i;
    }
    primitive->index_count = count - count % 3;
    if (primitive->indices && mode != MODE_TRIANGLES)
        cut(primitive, mode, count);
    if (!primitive->indices)
        (void)gltf_no_memory(gltf);
}

static enum status read_primitive(const struct gltf_object *object,
                                  struct gltf_primitive *primitive)
{
    struct gltf *gltf = object->gltf;
    const uint64_t mode = gltf_count(object, "mode", MODE_TRIANGLES);
    const struct gltf_object attributes = gltf_member(object, "attributes");
    const uint32_t positions = gltf_index(&attributes, "POSITION", "accessors");
    const uint32_t material = gltf_index(object, "material", "materials");
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
    if (count > MODEL_ELEMENT_MAX)
        return gltf_fault(&accessor, "count: expected 1 to %d", MODEL_ELEMENT_MAX);
    if (gltf->status != STATUS_OK)
        return gltf->status;
    primitive->material = material == gltf_none ? gltf->material_count - 1 : material;
    primitive->vertex_count = (uint32_t)count;
    primitive->positions = read_attribute(object, "POSITION", 3, primitive->vertex_count);
    primitive->normals = read_attribute(object, "NORMAL", 3, primitive->vertex_count);
    primitive->colors = read_attribute(object, "COLOR_0", 4, primitive->vertex_count);
    read_uvs(object, primitive);
    read_indices(object, primitive, (enum mode)mode);
    gltf->undrawn |= gltf_length(object, "targets") > 0 ? 1u << GLTF_MORPH : 0;
    return gltf->status;
}

static enum status read_mesh(struct gltf *gltf, uint32_t index)
{
    const struct gltf_object object = gltf_element(gltf, "meshes", index);
    const uint32_t count = gltf_length(&object, "primitives");
    struct gltf_mesh *mesh = &gltf->meshes[index];
    mesh->primitives = calloc(count + (size_t)1, sizeof(*mesh->primitives));
    if (!mesh->primitives)
        return gltf_no_memory(gltf);
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
        return gltf_no_memory(gltf);
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
