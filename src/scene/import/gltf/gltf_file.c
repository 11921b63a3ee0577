/* gltf_file.c: opens a glTF file: .glb chunks, JSON, buffers and data URIs. */
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/scene/import/gltf/gltf.h"

enum {
    HEADER_SIZE = 12,      /* .glb header size, bytes */
    CHUNK_HEADER_SIZE = 8, /* chunk header size, bytes */
    CHUNK_JSON = 0x4e4f534a,
    CHUNK_BINARY = 0x004e4942,
};

/* Reads a whole file. Logs a fault if the model may not refer to the file. */
static enum status read_all(const struct gltf_object *object, const char *path,
                            struct gltf_bytes *bytes)
{
    FILE *file = model_file_open(object->gltf->import, path);
    if (!file || fseek(file, 0, SEEK_END) != 0) {
        if (file)
            fclose(file);
        return gltf_fault(object, "%s: %s", path, model_file_fault(path));
    }
    const long size = ftell(file);
    rewind(file);
    bytes->owned = malloc(size > 0 ? (size_t)size : 1);
    bytes->size = size > 0 && bytes->owned ? fread(bytes->owned, 1, (size_t)size, file) : 0;
    bytes->bytes = bytes->owned;
    fclose(file);
    if (!bytes->owned)
        return gltf_out_of_memory(object->gltf);
    return size > 0 && bytes->size == (size_t)size
               ? STATUS_OK
               : gltf_fault(object, "%s: the file cannot be read", path);
}

/* ---- URIs ---- */

static int base64_digit(char c)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const char *found = c ? strchr(digits, c) : NULL;
    return found ? (int)(found - digits) : -1;
}

/* Decodes base64 with or without padding. Returns false for invalid characters or lengths. */
static bool decode_base64(const char *text, struct gltf_bytes *bytes)
{
    uint32_t bits = 0;
    uint32_t bit_count = 0;
    size_t length = strlen(text);
    while (length > 0 && text[length - 1] == '=')
        length--;
    for (size_t i = 0; i < length; i++) {
        const int digit = base64_digit(text[i]);
        if (digit < 0)
            return false;
        bits = bits << 6 | (uint32_t)digit;
        bit_count += 6;
        if (bit_count >= 8) {
            bit_count -= 8;
            bytes->owned[bytes->size++] = (uint8_t)(bits >> bit_count);
        }
    }
    return length % 4 != 1;
}

static enum status read_data(const struct gltf_object *object, const char *uri,
                             struct gltf_bytes *bytes)
{
    static const char marker[] = ";base64,";
    const char *data = strstr(uri, marker);
    if (!data)
        return gltf_fault(object, "uri: expected a data: URI with base64");
    data += sizeof(marker) - 1;
    bytes->owned = malloc(strlen(data) + 1);
    bytes->bytes = bytes->owned;
    if (!bytes->owned)
        return gltf_out_of_memory(object->gltf);
    return decode_base64(data, bytes) ? STATUS_OK : gltf_fault(object, "uri: invalid base64");
}

enum status gltf_read_uri(const struct gltf_object *object, const char *uri,
                          struct gltf_bytes *bytes)
{
    *bytes = (struct gltf_bytes){ 0 };
    if (strncmp(uri, "data:", 5) == 0)
        return read_data(object, uri, bytes);
    char *name = strdup(uri);
    if (!name)
        return gltf_out_of_memory(object->gltf);
    char *path = NULL;
    enum status status = STATUS_OK;
    if (!model_file_clean(name, true)) {
        status =
            gltf_fault(object, "refers to %s: expected only files within the model's folder", uri);
    } else {
        path = model_file_join(object->gltf->path, name);
        status = path ? read_all(object, path, bytes) : gltf_out_of_memory(object->gltf);
    }
    free(path);
    free(name);
    return status;
}

/* ---- the file ---- */

static uint32_t read_u32(const uint8_t *bytes)
{
    return bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 | (uint32_t)bytes[3] << 24;
}

/* Finds the JSON chunk and the binary chunk of a .glb file. Skips chunks of other types. */
static enum status find_chunks(const struct gltf_object *top, struct gltf_bytes *text)
{
    const uint8_t *file = text->bytes;
    size_t size = text->size;
    if (size < HEADER_SIZE + CHUNK_HEADER_SIZE || read_u32(&file[4]) != 2)
        return gltf_fault(top, "expected binary glTF 2");
    if (read_u32(&file[8]) > size || read_u32(&file[8]) < HEADER_SIZE + CHUNK_HEADER_SIZE)
        return gltf_fault(top, "the file is cut short: expected %u bytes, got %zu",
                          read_u32(&file[8]), size);
    size = read_u32(&file[8]);
    text->bytes = NULL;
    for (size_t at = HEADER_SIZE; size - at >= CHUNK_HEADER_SIZE;) {
        const size_t chunk_size = read_u32(&file[at]);
        const uint32_t kind = read_u32(&file[at + 4]);
        const uint8_t *bytes = &file[at + CHUNK_HEADER_SIZE];
        const bool is_first = at == HEADER_SIZE;
        at += CHUNK_HEADER_SIZE;
        if (chunk_size > size - at)
            return gltf_fault(top, "a chunk of %zu bytes extends beyond the end of the file",
                              chunk_size);
        if (is_first != (kind == CHUNK_JSON))
            return gltf_fault(top, "expected JSON in the first chunk only");
        if (kind == CHUNK_JSON)
            *text = (struct gltf_bytes){ .bytes = bytes, .size = chunk_size };
        else if (kind == CHUNK_BINARY && !top->gltf->binary.bytes)
            top->gltf->binary = (struct gltf_bytes){ .bytes = bytes, .size = chunk_size };
        at += chunk_size;
    }
    return STATUS_OK;
}

static enum status parse(struct gltf *gltf, struct gltf_bytes text)
{
    struct gltf_object top = gltf_top(gltf);
    json_error_t error;
    if (!text.bytes)
        return gltf_fault(&top, "expected JSON");
    if (text.size >= 3 && memcmp(text.bytes, "\xef\xbb\xbf", 3) == 0) {
        text.bytes += 3;
        text.size -= 3;
    }
    gltf->root = json_loadb((const char *)text.bytes, text.size, JSON_ALLOW_NUL, &error);
    if (!gltf->root && json_error_code(&error) == json_error_out_of_memory)
        return gltf_out_of_memory(gltf);
    if (!gltf->root)
        return gltf_fault(&top, "line %d, column %d: %s", error.line, error.column, error.text);
    if (!json_is_object(gltf->root))
        return gltf_fault(&top, "expected a JSON object");
    top = gltf_top(gltf);
    const struct gltf_object asset = gltf_member(&top, "asset");
    const char *version = gltf_string(&asset, "version", "");
    if (strncmp(version, "2.", 2) != 0 ||
        strcmp(gltf_string(&asset, "minVersion", "2.0"), "2.0") != 0)
        return gltf_fault(&asset, "expected version 2.0 of glTF, got \"%.16s\"", version);
    return gltf->status;
}

static enum status read_buffer(struct gltf *gltf, uint32_t index)
{
    const struct gltf_object object = gltf_element(gltf, "buffers", index);
    const char *uri = gltf_string(&object, "uri", NULL);
    const uint64_t size = gltf_count(&object, "byteLength", 0);
    struct gltf_bytes *buffer = &gltf->buffers[index];
    /* Buffers without data are allowed, for example if all their views are compressed by meshopt.
     */
    if (gltf->status != STATUS_OK || (!uri && (index > 0 || !gltf->binary.bytes)))
        return gltf->status;
    if (!uri)
        *buffer = gltf->binary;
    else if (gltf_read_uri(&object, uri, buffer) != STATUS_OK)
        return gltf->status;
    if (size == 0 || buffer->size < size)
        return gltf_fault(&object, "byteLength: expected 1 to %zu, the size of the data, got %llu",
                          buffer->size, (unsigned long long)size);
    buffer->size = (size_t)size;
    return gltf->status;
}

enum status gltf_open(struct gltf *gltf)
{
    const struct gltf_object top = gltf_top(gltf);
    struct gltf_bytes text = { 0 };
    enum status status = read_all(&top, gltf->path, &text);
    gltf->file = text.owned;
    if (status == STATUS_OK && text.size >= 4 && memcmp(text.bytes, "glTF", 4) == 0)
        status = find_chunks(&top, &text);
    if (status == STATUS_OK)
        status = parse(gltf, text);
    if (status == STATUS_OK)
        status = gltf_extensions_check(gltf);
    if (status != STATUS_OK)
        return status;
    const uint32_t count = gltf_list_length(gltf, "buffers");
    gltf->buffers = calloc(count + (size_t)1, sizeof(*gltf->buffers));
    gltf->views = calloc(gltf_list_length(gltf, "bufferViews") + (size_t)1, sizeof(*gltf->views));
    if (!gltf->buffers || !gltf->views)
        return gltf_out_of_memory(gltf);
    for (uint32_t i = 0; i < count && gltf->status == STATUS_OK; i++)
        (void)read_buffer(gltf, i);
    return gltf->status;
}

void gltf_close(struct gltf *gltf)
{
    for (uint32_t i = 0; gltf->buffers && i < gltf_list_length(gltf, "buffers"); i++)
        free(gltf->buffers[i].owned);
    for (uint32_t i = 0; gltf->views && i < gltf_list_length(gltf, "bufferViews"); i++)
        free(gltf->views[i].owned);
    for (uint32_t i = 0; i < gltf->mesh_count; i++) {
        for (uint32_t k = 0; k < gltf->meshes[i].count; k++)
            gltf_primitive_finish(&gltf->meshes[i].primitives[k]);
        free(gltf->meshes[i].primitives);
    }
    for (uint32_t i = 0; i < gltf->node_count; i++) {
        free(gltf->nodes[i].instances);
        free(gltf->nodes[i].weights);
    }
    free(gltf->buffers);
    free(gltf->views);
    free(gltf->meshes);
    free(gltf->materials);
    free(gltf->nodes);
    free(gltf->order);
    free(gltf->file);
    json_decref(gltf->root);
}
