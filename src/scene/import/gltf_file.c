/* gltf_file.c: the bytes of a glTF file and of the buffers that it names. */
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/scene/import/gltf.h"

enum {
    HEAD_SIZE = 12,     /* bytes of a .glb's head */
    PART_HEAD_SIZE = 8, /* of each part's */
    PART_JSON = 0x4e4f534a,
    PART_BINARY = 0x004e4942,
};

/* Reads a whole file that may be read. */
static enum status read_all(const struct gltf_object *object, const char *path,
                            struct gltf_bytes *bytes)
{
    FILE *file = model_file_open(object->gltf->import, path);
    if (!file || fseek(file, 0, SEEK_END) != 0) {
        if (file)
            fclose(file);
        return gltf_fault(object, "%s: file not found", path);
    }
    const long size = ftell(file);
    rewind(file);
    bytes->owned = malloc(size > 0 ? (size_t)size : 1);
    bytes->size = size > 0 && bytes->owned ? fread(bytes->owned, 1, (size_t)size, file) : 0;
    bytes->bytes = bytes->owned;
    fclose(file);
    if (!bytes->owned)
        return gltf_no_memory(object->gltf);
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

/* Decodes base64 with or without its padding. Returns false for other letters. */
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
    static const char mark[] = ";base64,";
    const char *data = strstr(uri, mark);
    if (!data)
        return gltf_fault(object, "uri: expected data: with base64");
    data += sizeof(mark) - 1;
    bytes->owned = malloc(strlen(data) + 1);
    bytes->bytes = bytes->owned;
    if (!bytes->owned)
        return gltf_no_memory(object->gltf);
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
        return gltf_no_memory(object->gltf);
    char *path = NULL;
    enum status status = STATUS_OK;
    if (!model_file_clean(name, true)) {
        status =
            gltf_fault(object, "refers to %s: expected only files within the model's folder", uri);
    } else {
        path = model_file_join(object->gltf->path, name);
        status = path ? read_all(object, path, bytes) : gltf_no_memory(object->gltf);
    }
    free(path);
    free(name);
    return status;
}

/* ---- the file ---- */

static uint32_t word_at(const uint8_t *bytes)
{
    return bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 | (uint32_t)bytes[3] << 24;
}

/* Finds the two parts of a .glb. Parts of other kinds may follow. */
static enum status split(const struct gltf_object *top, struct gltf_bytes *text)
{
    const uint8_t *file = text->bytes;
    size_t size = text->size;
    if (size < HEAD_SIZE + PART_HEAD_SIZE || word_at(&file[4]) != 2)
        return gltf_fault(top, "expected binary glTF 2");
    if (word_at(&file[8]) > size || word_at(&file[8]) < HEAD_SIZE + PART_HEAD_SIZE)
        return gltf_fault(top, "the file is cut short: expected %u bytes, got %zu",
                          word_at(&file[8]), size);
    size = word_at(&file[8]);
    text->bytes = NULL;
    for (size_t at = HEAD_SIZE; size - at >= PART_HEAD_SIZE;) {
        const size_t part_size = word_at(&file[at]);
        const uint32_t kind = word_at(&file[at + 4]);
        const uint8_t *bytes = &file[at + PART_HEAD_SIZE];
        const bool is_first = at == HEAD_SIZE;
        at += PART_HEAD_SIZE;
        if (part_size > size - at)
            return gltf_fault(top, "a part of %zu bytes is longer than the file", part_size);
        if (is_first != (kind == PART_JSON))
            return gltf_fault(top, "expected JSON in the first part, and nowhere else");
        if (kind == PART_JSON)
            *text = (struct gltf_bytes){ .bytes = bytes, .size = part_size };
        else if (kind == PART_BINARY && !top->gltf->binary.bytes)
            top->gltf->binary = (struct gltf_bytes){ .bytes = bytes, .size = part_size };
        at += part_size;
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
        return gltf_no_memory(gltf);
    if (!gltf->root)
        return gltf_fault(&top, "line %d, column %d: %s", error.line, error.column, error.text);
    if (!json_is_object(gltf->root))
        return gltf_fault(&top, "expected an object of JSON");
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
    /* What has no bytes is of views that bring theirs, as compressed ones do. */
    if (gltf->status != STATUS_OK || (!uri && (index > 0 || !gltf->binary.bytes)))
        return gltf->status;
    if (!uri)
        *buffer = gltf->binary;
    else if (gltf_read_uri(&object, uri, buffer) != STATUS_OK)
        return gltf->status;
    if (size == 0 || buffer->size < size)
        return gltf_fault(&object, "byteLength: expected 1 to %zu bytes, which there are, got %llu",
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
        status = split(&top, &text);
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
        return gltf_no_memory(gltf);
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
