/* gltf_meshopt.c: decompresses buffer views (EXT_ and KHR_meshopt_compression). */
#include <meshoptimizer.h>
#include <stdlib.h>
#include <string.h>
#include "src/scene/import/gltf/gltf.h"

/* Parameters of a compressed buffer view, from its extension object. */
struct compressed {
    const char *mode, *filter;
    struct gltf_bytes from;
    size_t count, stride;
};

static bool equals(const char *word, const char *other)
{
    return strcmp(word, other) == 0;
}

/* Returns true if mode, filter and stride are valid, which meshoptimizer checks by asserts only. */
static bool is_valid(const struct compressed *compressed)
{
    const size_t stride = compressed->stride;
    if (equals(compressed->mode, "ATTRIBUTES"))
        return stride > 0 && stride <= 256 && stride % 4 == 0 &&
               (equals(compressed->filter, "NONE") ||
                (equals(compressed->filter, "OCTAHEDRAL") && (stride == 4 || stride == 8)) ||
                (equals(compressed->filter, "QUATERNION") && stride == 8) ||
                equals(compressed->filter, "EXPONENTIAL"));
    if (!equals(compressed->filter, "NONE") || (stride != 2 && stride != 4))
        return false;
    return equals(compressed->mode, "INDICES") ||
           (equals(compressed->mode, "TRIANGLES") && compressed->count % 3 == 0);
}

static bool decode(const struct compressed *compressed, uint8_t *to)
{
    const size_t count = compressed->count;
    const size_t stride = compressed->stride;
    const uint8_t *from = compressed->from.bytes;
    if (equals(compressed->mode, "TRIANGLES"))
        return meshopt_decodeIndexBuffer(to, count, stride, from, compressed->from.size) == 0;
    if (equals(compressed->mode, "INDICES"))
        return meshopt_decodeIndexSequence(to, count, stride, from, compressed->from.size) == 0;
    if (meshopt_decodeVertexBuffer(to, count, stride, from, compressed->from.size) != 0)
        return false;
    if (equals(compressed->filter, "OCTAHEDRAL"))
        meshopt_decodeFilterOct(to, count, stride);
    else if (equals(compressed->filter, "QUATERNION"))
        meshopt_decodeFilterQuat(to, count, stride);
    else if (equals(compressed->filter, "EXPONENTIAL"))
        meshopt_decodeFilterExp(to, count, stride);
    return true;
}

/* Returns true if the format version (low 4 bits of the first byte) is newer than the library's. */
static bool is_newer_version(const struct compressed *compressed)
{
    const unsigned most = equals(compressed->mode, "ATTRIBUTES") ? 0 : 1;
    return compressed->from.size > 0 && (compressed->from.bytes[0] & 15u) > most;
}

void gltf_meshopt_decode(const struct gltf_object *extension, struct gltf_bytes *view)
{
    struct gltf *gltf = extension->gltf;
    const uint64_t count = gltf_count(extension, "count", 0);
    const uint64_t stride = gltf_count(extension, "byteStride", 0);
    const struct compressed compressed = {
        .mode = gltf_string(extension, "mode", ""),
        .filter = gltf_string(extension, "filter", "NONE"),
        .from = gltf_view_bytes(extension),
        .count = (size_t)count,
        .stride = (size_t)stride,
    };
    if (gltf->status != STATUS_OK)
        return;
    if (count < 1 || count > MODEL_ELEMENT_MAX || !is_valid(&compressed)) {
        (void)gltf_fault(extension, "expected a mode, a filter and a byteStride that match");
        return;
    }
    uint8_t *bytes = malloc(compressed.count * compressed.stride);
    if (!bytes) {
        (void)gltf_out_of_memory(gltf);
    } else if (!decode(&compressed, bytes)) {
        free(bytes);
        (void)gltf_fault(extension, is_newer_version(&compressed)
                                        ? "compressed by a later version of meshoptimizer than "
                                          "this program can read; compress it with version 0.18"
                                        : "the compressed data is damaged");
    } else {
        *view = (struct gltf_bytes){ bytes, bytes, compressed.count * compressed.stride };
    }
}
