/* gltf_accessor.c: reads buffer views and accessors of a glTF file (glTF 2.0, 3.6). */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/scene/import/gltf/gltf.h"

/* Values of accessor.componentType, which are OpenGL constants. */
enum component {
    COMPONENT_BYTE = 5120,
    COMPONENT_UNSIGNED_BYTE,
    COMPONENT_SHORT,
    COMPONENT_UNSIGNED_SHORT,
    COMPONENT_UNSIGNED_INT = 5125,
    COMPONENT_FLOAT,
};

/* Location and layout of an accessor's elements; `bytes` is NULL if all values are 0. */
struct elements {
    const uint8_t *bytes;
    size_t stride;
    uint32_t count, width;
    uint32_t component;
    bool is_normalized;
};

struct gltf_bytes gltf_view_bytes(const struct gltf_object *object)
{
    struct gltf *gltf = object->gltf;
    const uint32_t buffer = gltf_index(object, "buffer", "buffers");
    const uint64_t offset = gltf_count(object, "byteOffset", 0);
    const uint64_t size = gltf_count(object, "byteLength", 0);
    if (buffer == gltf_none)
        (void)gltf_fault(object, "expected a buffer");
    if (gltf->status != STATUS_OK)
        return (struct gltf_bytes){ 0 };
    const struct gltf_bytes *all = &gltf->buffers[buffer];
    if (size == 0 || offset > all->size || size > all->size - offset) {
        (void)gltf_fault(
            object, "byteOffset and byteLength: expected a range within buffers[%u] of %zu bytes",
            buffer, all->size);
        return (struct gltf_bytes){ 0 };
    }
    return (struct gltf_bytes){ .bytes = all->bytes + offset, .size = (size_t)size };
}

struct gltf_bytes gltf_view(struct gltf *gltf, uint32_t index, size_t *stride)
{
    const struct gltf_object view = gltf_element(gltf, "bufferViews", index);
    struct gltf_object meshopt = gltf_extension(&view, "KHR_meshopt_compression");
    if (!meshopt.json)
        meshopt = gltf_extension(&view, "EXT_meshopt_compression");
    *stride = (size_t)gltf_count(&view, "byteStride", 0);
    if (*stride > 252)
        (void)gltf_fault(&view, "byteStride: expected at most 252");
    if (!meshopt.json)
        return gltf_view_bytes(&view);
    struct gltf_bytes *decoded = &gltf->views[index];
    if (!decoded->bytes)
        gltf_meshopt_decode(&meshopt, decoded);
    return (struct gltf_bytes){ .bytes = decoded->bytes, .size = decoded->size };
}

static size_t component_size(uint32_t component)
{
    switch (component) {
    case COMPONENT_BYTE:
    case COMPONENT_UNSIGNED_BYTE:
        return 1;
    case COMPONENT_SHORT:
    case COMPONENT_UNSIGNED_SHORT:
        return 2;
    case COMPONENT_UNSIGNED_INT:
    case COMPONENT_FLOAT:
        return 4;
    default:
        return 0;
    }
}

static uint32_t type_width(const char *type)
{
    static const struct {
        const char *type;
        uint32_t width;
    } types[] = { { "SCALAR", 1 }, { "VEC2", 2 }, { "VEC3", 3 }, { "VEC4", 4 }, { "MAT4", 16 } };

    for (size_t i = 0; i < sizeof(types) / sizeof(types[0]); i++) {
        if (strcmp(types[i].type, type) == 0)
            return types[i].width;
    }
    return 0;
}

/* Locates the elements in a buffer view; `object` has the members bufferView and byteOffset. */
static void find_bytes(const struct gltf_object *object, struct elements *elements)
{
    struct gltf *gltf = object->gltf;
    const uint32_t view = gltf_index(object, "bufferView", "bufferViews");
    const uint64_t offset = gltf_count(object, "byteOffset", 0);
    const size_t size = component_size(elements->component) * elements->width;
    if (gltf->status != STATUS_OK || view == gltf_none)
        return;
    const struct gltf_bytes bytes = gltf_view(gltf, view, &elements->stride);
    if (elements->stride == 0)
        elements->stride = size;
    const uint64_t needed = (elements->count - (uint64_t)1) * elements->stride + size;
    if (gltf->status != STATUS_OK)
        return;
    if (elements->stride < size || offset > bytes.size || needed > bytes.size - offset)
        (void)gltf_fault(object, "the %u elements extend beyond bufferViews[%u] of %zu bytes",
                         elements->count, view, bytes.size);
    else
        elements->bytes = bytes.bytes + offset;
}

static struct elements find_elements(const struct gltf_object *accessor)
{
    const uint64_t count = gltf_count(accessor, "count", 0);
    const uint64_t component = gltf_count(accessor, "componentType", 0);
    struct elements elements = {
        .count = (uint32_t)count,
        .width = type_width(gltf_string(accessor, "type", "")),
        .component = (uint32_t)component,
        .is_normalized = gltf_flag(accessor, "normalized"),
    };
    if (count < 1 || count > MODEL_ELEMENT_MAX)
        (void)gltf_fault(accessor, "count: expected 1 to %d", MODEL_ELEMENT_MAX);
    else if (elements.width == 0 || component > COMPONENT_FLOAT ||
             component_size(elements.component) == 0)
        (void)gltf_fault(accessor, "expected a type from SCALAR to VEC4, or MAT4, and a component "
                                   "type from 5120 to 5126");
    else
        find_bytes(accessor, &elements);
    return elements;
}

static uint32_t read_unsigned(const uint8_t *bytes, size_t size)
{
    uint32_t word = 0;
    for (size_t i = 0; i < size; i++)
        word |= (uint32_t)bytes[i] << (8 * i);
    return word;
}

static float read_number(const uint8_t *bytes, uint32_t component, bool is_normalized)
{
    const size_t size = component_size(component);
    const uint32_t word = read_unsigned(bytes, size);
    if (component == COMPONENT_FLOAT) {
        float number;
        memcpy(&number, bytes, sizeof(number));
        return number;
    }
    const bool is_signed = component == COMPONENT_BYTE || component == COMPONENT_SHORT;
    const float max = (float)((UINT64_C(1) << (8 * size - is_signed)) - 1);
    const float number = !is_signed  ? (float)word
                         : size == 1 ? (float)(int8_t)(uint8_t)word
                                     : (float)(int16_t)(uint16_t)word;
    return is_normalized ? fmaxf(number / max, -1) : number;
}

static void copy_element(const struct elements *from, size_t i, float *to)
{
    const size_t size = component_size(from->component);
    for (uint32_t k = 0; k < from->width; k++)
        to[k] = read_number(from->bytes + i * from->stride + k * size, from->component,
                            from->is_normalized);
}

/* Replaces the elements listed in accessor.sparse by their new values. */
static void apply_sparse(const struct gltf_object *accessor, const struct elements *all,
                         float *values)
{
    struct gltf *gltf = accessor->gltf;
    const struct gltf_object sparse = gltf_member(accessor, "sparse");
    const struct gltf_object at = gltf_member(&sparse, "indices");
    const struct gltf_object with = gltf_member(&sparse, "values");
    const uint64_t count = gltf_count(&sparse, "count", 0);
    if (!sparse.json || gltf->status != STATUS_OK)
        return;
    struct elements sparse_indices = { .count = (uint32_t)count, .width = 1 };
    sparse_indices.component = (uint32_t)gltf_count(&at, "componentType", 0);
    struct elements sparse_values = *all;
    sparse_values.count = sparse_indices.count;
    sparse_values.bytes = NULL;
    if (count < 1 || count > all->count || component_size(sparse_indices.component) == 0 ||
        sparse_indices.component == COMPONENT_FLOAT) {
        (void)gltf_fault(&sparse, "expected 1 to %u integer indices", all->count);
        return;
    }
    find_bytes(&at, &sparse_indices);
    find_bytes(&with, &sparse_values);
    if (gltf->status == STATUS_OK && (!sparse_indices.bytes || !sparse_values.bytes))
        (void)gltf_fault(&sparse, "expected bufferViews of the indices and the values");
    for (size_t i = 0; i < count && gltf->status == STATUS_OK; i++) {
        const uint32_t target = read_unsigned(sparse_indices.bytes + i * sparse_indices.stride,
                                              component_size(sparse_indices.component));
        if (target >= all->count)
            (void)gltf_fault(&at, "element %u is out of range", target);
        else
            copy_element(&sparse_values, i, &values[(size_t)target * all->width]);
    }
}

bool gltf_read_floats(struct gltf *gltf, uint32_t accessor, struct gltf_array *array)
{
    const struct gltf_object object = gltf_element(gltf, "accessors", accessor);
    const struct elements elements = find_elements(&object);
    *array = (struct gltf_array){ 0 };
    if (gltf->status != STATUS_OK)
        return false;
    float *values = calloc(elements.count, elements.width * sizeof(*values));
    if (!values) {
        (void)gltf_out_of_memory(gltf);
        return false;
    }
    for (size_t i = 0; elements.bytes && i < elements.count; i++)
        copy_element(&elements, i, &values[i * elements.width]);
    apply_sparse(&object, &elements, values);
    if (gltf->status == STATUS_OK)
        *array = (struct gltf_array){ values, elements.count, elements.width };
    else
        free(values);
    return gltf->status == STATUS_OK;
}

uint32_t *gltf_read_indices(struct gltf *gltf, uint32_t accessor, uint32_t *count)
{
    const struct gltf_object object = gltf_element(gltf, "accessors", accessor);
    const struct elements elements = find_elements(&object);
    const size_t size = component_size(elements.component);
    if (gltf->status == STATUS_OK &&
        (elements.width != 1 || !elements.bytes || elements.component == COMPONENT_FLOAT ||
         gltf_member(&object, "sparse").json))
        (void)gltf_fault(&object, "expected integer indices in a bufferView");
    if (gltf->status != STATUS_OK)
        return NULL;
    uint32_t *indices = malloc(elements.count * sizeof(*indices));
    if (!indices)
        (void)gltf_out_of_memory(gltf);
    for (size_t i = 0; indices && i < elements.count; i++)
        indices[i] = read_unsigned(elements.bytes + i * elements.stride, size);
    *count = indices ? elements.count : 0;
    return indices;
}
