/* gltf_file.c: builder of small glTF files in static memory, and a loader that captures the log. */
#include "tests/support/gltf_file.h"
#include <stdio.h>
#include <string.h>
#include <unistd.h>
#include "tests/support/assertions.h"

enum {
    TEXT_SIZE = 16384,
};

static uint8_t data[1 << 16];
static size_t data_size;
static char views[TEXT_SIZE], accessors[TEXT_SIZE];
static uint32_t view_count, accessor_count;

static void append(char *list, const char *format, ...) __attribute__((format(printf, 2, 3)));

static void append(char *list, const char *format, ...)
{
    const size_t length = strlen(list);
    va_list arguments;
    va_start(arguments, format);
    const int more = vsnprintf(list + length, TEXT_SIZE - length, format, arguments);
    va_end(arguments);
    assert_true(more >= 0 && (size_t)more < TEXT_SIZE - length);
}

void gltf_file_begin(void)
{
    data_size = 0;
    views[0] = '\0';
    accessors[0] = '\0';
    view_count = 0;
    accessor_count = 0;
}

uint32_t gltf_file_view(const void *bytes, size_t size, const char *extra)
{
    assert_true(data_size + size + 4 <= sizeof(data));
    memcpy(&data[data_size], bytes, size);
    append(views, "%s{'buffer':0,'byteOffset':%zu,'byteLength':%zu%s}", view_count ? "," : "",
           data_size, size, extra);
    data_size += (size + 3) & ~(size_t)3;
    return view_count++;
}

uint32_t gltf_file_accessor(uint32_t view, enum gltf_file_component component, uint32_t count,
                            const char *type, const char *extra)
{
    append(accessors, "%s{'componentType':%d,'count':%u,'type':'%s'", accessor_count ? "," : "",
           (int)component, count, type);
    if (view != UINT32_MAX)
        append(accessors, ",'bufferView':%u", view);
    append(accessors, "%s}", extra);
    return accessor_count++;
}

uint32_t gltf_file_add(const void *bytes, size_t size, enum gltf_file_component component,
                       uint32_t count, const char *type)
{
    return gltf_file_accessor(gltf_file_view(bytes, size, ""), component, count, type, "");
}

uint32_t gltf_file_floats(const float *numbers, uint32_t count, const char *type)
{
    const uint32_t width = type[0] == 'S' ? 1 : type[0] == 'M' ? 16 : (uint32_t)(type[3] - '0');
    return gltf_file_add(numbers, sizeof(*numbers) * width * count, GLTF_FILE_FLOAT, count, type);
}

static void write_file(const char *path, const void *bytes, size_t size)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

void gltf_file_write(const char *format, ...)
{
    static char text[4 * TEXT_SIZE];
    static char top[TEXT_SIZE];
    va_list arguments;
    va_start(arguments, format);
    const int length = vsnprintf(top, sizeof(top), format, arguments);
    va_end(arguments);
    assert_true(length >= 0 && length < (int)sizeof(top));
    (void)snprintf(text, sizeof(text),
                   "{'asset':{'version':'2.0'},'buffers':[{'uri':'m.bin','byteLength':%zu}],"
                   "'bufferViews':[%s],'accessors':[%s],%s}",
                   data_size, views, accessors, top);
    for (char *c = text; *c; c++)
        *c = (char)(*c == '\'' ? '"' : *c);
    write_file("m.gltf", text, strlen(text));
    write_file("m.bin", data, data_size);
}

enum status gltf_file_load(struct model *model, char said[static GLTF_FILE_SAID])
{
    fflush(stderr);
    const int kept = dup(STDERR_FILENO);
    FILE *caught = tmpfile();
    assert_true(kept >= 0 && caught);
    dup2(fileno(caught), STDERR_FILENO);
    const enum status status = model_load(model, "m.gltf", MODEL_SURROUNDINGS);
    dup2(kept, STDERR_FILENO);
    close(kept);
    rewind(caught);
    said[fread(said, 1, GLTF_FILE_SAID - 1, caught)] = '\0';
    fclose(caught);
    return status;
}

enum status gltf_file_material(struct model *model, const char *material, const char *more,
                               char said[static GLTF_FILE_SAID])
{
    static const float corners[9] = { 0, 0, 0, 1, 0, 0, 0, 1, 0 };
    static const float uvs[6] = { 0, 0, 1, 0, 0, 1 };
    gltf_file_begin();
    gltf_file_floats(corners, 3, "VEC3");
    gltf_file_floats(uvs, 3, "VEC2");
    gltf_file_write("'nodes':[{'mesh':0}],'meshes':[{'primitives':[{'attributes':{'POSITION':0,"
                    "'TEXCOORD_0':1,'TEXCOORD_1':1},'material':0}]}],'materials':[{%s}]%s",
                    material, more);
    return gltf_file_load(model, said);
}
