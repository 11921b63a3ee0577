/* gltf_meshopt.c: buffer views compressed by meshoptimizer (EXT_ and KHR_meshopt_compression). */
#include <meshoptimizer.h>
#include <stdlib.h>
#include <string.h>
#include "src/scene/import/gltf.h"

/* A view as the extension describes it. */
struct packed {
    const char *mode, *filter;
    struct gltf_bytes from;
    size_t count, stride;
};

static bool is(const char *word, const char *other)
{
    return strcmp(word, other) == 0;
}

/* The decoder asserts these, so that they must hold before. */
static bool is_sound(const struct packed *packed)
{
    const size_t stride = packed->stride;
    if (is(packed->mode, "ATTRIBUTES"))
        return stride > 0 && stride <= 256 && stride % 4 == 0 &&
               (is(packed->filter, "NONE") ||
                (is(packed->filter, "OCTAHEDRAL") && (stride == 4 || stride == 8)) ||
                (is(packed->filter, "QUATERNION") && stride == 8) ||
                is(packed->filter, "EXPONENTIAL"));
    if (!is(packed->filter, "NONE") || (stride != 2 && stride != 4))
        return false;
    return is(packed->mode, "INDICES") || (is(packed->mode, "TRIANGLES") && packed->count % 3 == 0);
}

static bool decode(const struct packed *packed, uint8_t *to)
{
    const size_t count = packed->count;
    const size_t stride = packed->stride;
    const uint8_t *from = packed->from.bytes;
    if (is(packed->mode, "TRIANGLES"))
        return meshopt_decodeIndexBuffer(to, count, stride, from, packed->from.size) == 0;
    if (is(packed->mode, "INDICES"))
        return meshopt_decodeIndexSequence(to, count, stride, from, packed->from.size) == 0;
    if (meshopt_decodeVertexBuffer(to, count, stride, from, packed->from.size) != 0)
        return false;
    if (is(packed->filter, "OCTAHEDRAL"))
        meshopt_decodeFilterOct(to, count, stride);
    else if (is(packed->filter, "QUATERNION"))
        meshopt_decodeFilterQuat(to, count, stride);
    else if (is(packed->filter, "EXPONENTIAL"))
        meshopt_decodeFilterExp(to, count, stride);
    return true;
}

/* Whether the first byte, whose lower half is a version, is of one that the library cannot read. */
static bool is_later(const struct packed *packed)
{
    const unsigned most = is(packed->mode, "ATTRIBUTES") ? 0 : 1;
    return packed->from.size > 0 && (packed->from.bytes[0] & 15u) > most;
}

void gltf_meshopt_decode(const struct gltf_object *extension, struct gltf_bytes *view)
{
    struct gltf *gltf = extension->gltf;
    const uint64_t count = gltf_count(extension, "count", 0);
    const uint64_t stride = gltf_count(extension, "byteStride", 0);
    const struct packed packed = {
        .mode = gltf_string(extension, "mode", ""),
        .filter = gltf_string(extension, "filter", "NONE"),
        .from = gltf_view_bytes(extension),
        .count = (size_t)count,
        .stride = (size_t)stride,
    };
    if (gltf->status != STATUS_OK)
        return;
    if (count < 1 || count > MODEL_ELEMENT_MAX || !is_sound(&packed)) {
        (void)gltf_fault(extension, "expected a mode, a filter and a stride that fit each other");
        return;
    }
    uint8_t *bytes = malloc(packed.count * packed.stride);
    if (!bytes) {
        (void)gltf_no_memory(gltf);
    } else if (!decode(&packed, bytes)) {
        free(bytes);
        (void)gltf_fault(extension, is_later(&packed)
                                        ? "compressed by a later version of meshoptimizer than "
                                          "this program can read; compress it with version 0.18"
                                        : "the compressed bytes are damaged");
    } else {
        *view = (struct gltf_bytes){ bytes, bytes, packed.count * packed.stride };
    }
}
