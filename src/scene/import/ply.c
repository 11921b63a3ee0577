/* ply.c: reader of PLY files (Turk 1994): vertices, faces and triangle strips, ASCII or binary. */
#include <assert.h>
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/scene/import/obj_ply.h"

enum format {
    FORMAT_TEXT,
    FORMAT_LITTLE,
    FORMAT_BIG,
    FORMAT_COUNT,
};

enum {
    ELEMENT_MAX = 64,
    PROPERTY_MAX = 256, /* maximum properties of all elements together */
};

/* Meaning of a property, with consecutive values for the components of a vector. */
enum slot {
    SLOT_X,
    SLOT_NX = SLOT_X + 3,
    SLOT_RED = SLOT_NX + 3,
    SLOT_U = SLOT_RED + 3,
    SLOT_CORNERS = SLOT_U + 2, /* vertices of a face or strips */
    SLOT_COUNT,
    SLOT_OTHER = SLOT_COUNT,
};

struct type {
    const char *names[2];
    uint32_t size;
    bool is_signed, is_float;
};

static const struct type types[] = {
    { { "char", "int8" }, 1, true, false },    { { "uchar", "uint8" }, 1, false, false },
    { { "short", "int16" }, 2, true, false },  { { "ushort", "uint16" }, 2, false, false },
    { { "int", "int32" }, 4, true, false },    { { "uint", "uint32" }, 4, false, false },
    { { "float", "float32" }, 4, true, true }, { { "double", "float64" }, 8, true, true },
};

struct property {
    const struct type *type;
    const struct type *count; /* list length's type; NULL for scalars */
    enum slot slot;
};

enum kind {
    KIND_OTHER,
    KIND_VERTEX,
    KIND_FACE,
    KIND_STRIPS,
};

struct element {
    char name[32];
    enum kind kind;
    uint64_t count;
    uint32_t first, property_count;
};

struct ply {
    struct obj_ply *obj_ply;
    uint32_t format;
    struct element elements[ELEMENT_MAX];
    uint32_t element_count;
    struct property properties[PROPERTY_MAX];
    uint32_t property_count;
    uint32_t vertex_count;
    struct obj_ply_array indices, polygons;
    const struct element *element; /* current element and row, for messages */
    uint64_t row;
};

static enum status fault(const struct ply *ply, const char *what, const struct text_scan *got)
{
    char word[32];
    text_show(word, sizeof(word), got);
    log_error("%s: header: %s, got '%s'", ply->obj_ply->import->path, what, word);
    return STATUS_DATA;
}

static enum status bad_row(const struct ply *ply, const char *what)
{
    log_error("%s: %s %llu: %s", ply->obj_ply->import->path, ply->element->name,
              (unsigned long long)ply->row, what);
    return STATUS_DATA;
}

static enum status no_memory(const struct ply *ply)
{
    return log_out_of_memory(ply->obj_ply->import->path);
}

/* ---- header ---- */

static enum status read_format(struct ply *ply, struct text_scan *line)
{
    static const char *const names[FORMAT_COUNT] = {
        [FORMAT_TEXT] = "ascii",
        [FORMAT_LITTLE] = "binary_little_endian",
        [FORMAT_BIG] = "binary_big_endian",
    };
    const struct text_scan all = text_rest(line);
    for (ply->format = 0; ply->format < FORMAT_COUNT; ply->format++) {
        if (text_take_word(line, names[ply->format]))
            return STATUS_OK;
    }
    return fault(ply, "expected ascii, binary_little_endian or binary_big_endian", &all);
}

/* Records an element that is not drawn. */
static void note_element(struct obj_ply *obj_ply, const char *name)
{
    char words[48];
    const bool is_edge = !strcmp(name, "edge");
    (void)snprintf(words, sizeof(words), is_edge ? "points and lines" : "elements '%s'", name);
    obj_ply_note_undrawn(obj_ply->undrawn, words);
}

static enum status read_element(struct ply *ply, struct text_scan *line)
{
    const struct text_scan all = text_rest(line);
    struct element *element = &ply->elements[ply->element_count];
    const struct text_scan name = text_word(line);
    int64_t count;
    if (!text_integer(line, &count) || count < 0 || text_skip(line))
        return fault(ply, "expected the name of an element and its count", &all);
    if (ply->element_count == ELEMENT_MAX)
        return fault(ply, "expected at most 64 elements", &all);
    *element = (struct element){ .count = (uint64_t)count, .first = ply->property_count };
    text_show(element->name, sizeof(element->name), &name);
    if (!strcmp(element->name, "vertex"))
        element->kind = KIND_VERTEX;
    else if (!strcmp(element->name, "face"))
        element->kind = KIND_FACE;
    else if (!strcmp(element->name, "tristrips"))
        element->kind = KIND_STRIPS;
    else if (count > 0)
        note_element(ply->obj_ply, element->name);
    ply->element_count++;
    return STATUS_OK;
}

static enum slot slot_of(enum kind kind, bool is_list, struct text_scan *name)
{
    static const char *const names[SLOT_COUNT][3] = {
        { "x" },
        { "y" },
        { "z" },
        { "nx" },
        { "ny" },
        { "nz" },
        { "red", "r", "diffuse_red" },
        { "green", "g", "diffuse_green" },
        { "blue", "b", "diffuse_blue" },
        { "u", "s", "texture_u" },
        { "v", "t", "texture_v" },
        { "vertex_indices", "vertex_index" },
    };
    if (kind == KIND_OTHER || is_list != (kind != KIND_VERTEX))
        return SLOT_OTHER;
    for (uint32_t i = 0; i < 3 * SLOT_COUNT; i++) {
        const char *known = names[i / 3][i % 3];
        const bool is_corners = i / 3 == SLOT_CORNERS;
        if (known && is_corners == is_list && text_take_word(name, known))
            return i / 3;
    }
    return SLOT_OTHER;
}

static const struct type *read_type(struct text_scan *line)
{
    for (size_t i = 0; i < sizeof(types) / sizeof(types[0]); i++) {
        if (text_take_word(line, types[i].names[0]) || text_take_word(line, types[i].names[1]))
            return &types[i];
    }
    return NULL;
}

/* Records a property that is not drawn, unless note_element() has recorded its element. */
static void note_property(struct obj_ply *obj_ply, const struct element *element,
                          struct text_scan *name)
{
    static const char *const owners[] = {
        [KIND_VERTEX] = "vertices",
        [KIND_FACE] = "faces",
        [KIND_STRIPS] = "strips",
    };
    static const char *const colors[] = { "red", "green", "blue", "alpha" };
    char word[32], words[64];
    if (element->kind == KIND_OTHER || element->count == 0)
        return;
    const struct text_scan own = text_word(name);
    text_show(word, sizeof(word), &own);
    const char *description = word;
    for (size_t i = 0; i < sizeof(colors) / sizeof(colors[0]) && element->kind == KIND_FACE; i++)
        description = strcmp(word, colors[i]) ? description : "colours";
    if (element->kind == KIND_FACE && !strcmp(word, "texcoord"))
        description = "texture coordinates";
    (void)snprintf(words, sizeof(words), "%s of %s", description, owners[element->kind]);
    obj_ply_note_undrawn(obj_ply->undrawn, words);
}

static enum status read_property(struct ply *ply, struct text_scan *line)
{
    const struct text_scan all = text_rest(line);
    struct property property = { 0 };
    const bool is_list = text_take_word(line, "list");
    if (is_list)
        property.count = read_type(line);
    property.type = read_type(line);
    if (!property.type || (is_list && (!property.count || property.count->is_float)))
        return fault(ply, "expected the type of the property", &all);
    if (ply->element_count == 0 || ply->property_count == PROPERTY_MAX)
        return fault(ply, "expected at most 256 properties, each after its element", &all);
    struct element *element = &ply->elements[ply->element_count - 1];
    property.slot = slot_of(element->kind, is_list, line);
    if (property.slot == SLOT_OTHER)
        note_property(ply->obj_ply, element, line);
    ply->properties[ply->property_count++] = property;
    element->property_count++;
    return STATUS_OK;
}

/* Handles "comment TextureFile NAME", by which MeshLab names the file's texture. */
static enum status read_comment(struct ply *ply, struct text_scan *line)
{
    struct obj_ply *obj_ply = ply->obj_ply;
    if (!text_take_word(line, "TextureFile") || obj_ply->material_count > 0)
        return STATUS_OK;
    const struct text_scan name = text_rest(line);
    const size_t size = (size_t)(name.end - name.at) + 1;
    obj_ply->materials = calloc(1, sizeof(*obj_ply->materials));
    if (!obj_ply->materials)
        return no_memory(ply);
    struct mtl_material *material = obj_ply->materials;
    obj_ply->material_count = 1;
    material->color = glms_vec3_one();
    material->material = material_make("");
    material->maps[MTL_MAP_COLOR] = (struct mtl_map){ .scale = { 1, 1 }, .strength = 1 };
    material->maps[MTL_MAP_COLOR].file = malloc(size);
    if (!material->maps[MTL_MAP_COLOR].file)
        return no_memory(ply);
    text_copy(material->maps[MTL_MAP_COLOR].file, size, &name);
    return STATUS_OK;
}

static enum status read_header(struct ply *ply, struct text_scan *file)
{
    enum status status = STATUS_OK;
    ply->format = FORMAT_COUNT;
    while (status == STATUS_OK && file->at < file->end) {
        struct text_scan line = text_line(file);
        if (text_take_word(&line, "end_header"))
            return ply->format < FORMAT_COUNT ? STATUS_OK : fault(ply, "expected a format", &line);
        if (text_take_word(&line, "format"))
            status = read_format(ply, &line);
        else if (text_take_word(&line, "element"))
            status = read_element(ply, &line);
        else if (text_take_word(&line, "property"))
            status = read_property(ply, &line);
        else if (text_take_word(&line, "comment"))
            status = read_comment(ply, &line);
    }
    return status == STATUS_OK ? fault(ply, "expected end_header", file) : status;
}

/* ---- values ---- */

static double decode(const struct type *type, uint64_t bits)
{
    assert(type->size > 0);
    if (type->is_float && type->size == 4) {
        const uint32_t low = (uint32_t)bits;
        float number;
        memcpy(&number, &low, sizeof(number));
        return (double)number;
    }
    if (type->is_float) {
        double number;
        memcpy(&number, &bits, sizeof(number));
        return number;
    }
    const uint64_t sign = type->is_signed ? (uint64_t)1 << (8 * type->size - 1) : 0;
    return bits & sign ? -(double)(2 * sign - bits) : (double)bits;
}

/* Reads a value. Returns false at the end of the file or if there is no number. */
static bool read_value(const struct ply *ply, struct text_scan *body, const struct type *type,
                       double *value)
{
    if (ply->format == FORMAT_TEXT) {
        float number;
        int64_t integer;
        struct text_scan next = *body;
        if (!type->is_float && text_integer(&next, &integer) &&
            (next.at == next.end || text_is_blank(*next.at))) {
            *body = next;
            *value = (double)integer;
            return true;
        }
        const bool is_number = text_float(body, &number);
        *value = is_number ? (double)number : 0;
        return is_number;
    }
    uint64_t bits = 0;
    if ((size_t)(body->end - body->at) < type->size)
        return false;
    for (uint32_t i = 0; i < type->size; i++) {
        const uint32_t byte = ply->format == FORMAT_BIG ? i : type->size - 1 - i;
        bits = bits << 8 | (unsigned char)body->at[byte];
    }
    body->at += type->size;
    *value = decode(type, bits);
    return true;
}

/* Reads the length of a list and checks that the file is long enough for its values. */
static bool read_length(const struct ply *ply, struct text_scan *body,
                        const struct property *property, uint64_t *length)
{
    double value;
    const uint64_t size = ply->format == FORMAT_TEXT ? 1 : property->type->size;
    if (!read_value(ply, body, property->count, &value) || !(value >= 0))
        return false;
    *length = (uint64_t)value;
    return *length <= (uint64_t)(body->end - body->at) / size;
}

/* ---- vertices ---- */

static bool has_slot(const struct ply *ply, const struct element *element, enum slot slot)
{
    for (uint32_t i = 0; i < element->property_count; i++) {
        if (ply->properties[element->first + i].slot == slot)
            return true;
    }
    return false;
}

static enum status allocate_vertices(struct ply *ply, const struct element *element)
{
    struct obj_ply *obj_ply = ply->obj_ply;
    const size_t count = (size_t)element->count + 1;
    ply->element = element;
    if (obj_ply->positions)
        return bad_row(ply, "expected only one element with vertices");
    if (!has_slot(ply, element, SLOT_X) || !has_slot(ply, element, SLOT_X + 1) ||
        !has_slot(ply, element, SLOT_X + 2))
        return bad_row(ply, "expected the properties x, y and z");
    obj_ply->positions = calloc(count, 3 * sizeof(float));
    if (has_slot(ply, element, SLOT_NX))
        obj_ply->normals = calloc(count, 3 * sizeof(float));
    if (has_slot(ply, element, SLOT_RED))
        obj_ply->colors = calloc(count, 4 * sizeof(float));
    if (has_slot(ply, element, SLOT_U))
        obj_ply->uvs = calloc(count, 2 * sizeof(float));
    ply->vertex_count = (uint32_t)element->count;
    return obj_ply->positions && (obj_ply->normals || !has_slot(ply, element, SLOT_NX)) &&
                   (obj_ply->colors || !has_slot(ply, element, SLOT_RED)) &&
                   (obj_ply->uvs || !has_slot(ply, element, SLOT_U))
               ? STATUS_OK
               : no_memory(ply);
}

static void store_value(const struct ply *ply, const struct property *property, double value)
{
    const struct obj_ply *obj_ply = ply->obj_ply;
    const struct type *type = property->type;
    const size_t row = (size_t)ply->row;
    const enum slot slot = property->slot;
    if (slot < SLOT_NX)
        obj_ply->positions[3 * row + slot] = (float)value;
    else if (slot < SLOT_RED && obj_ply->normals)
        obj_ply->normals[3 * row + slot - SLOT_NX] = (float)value;
    else if (slot >= SLOT_RED && slot < SLOT_U && obj_ply->colors)
        obj_ply->colors[4 * row + slot - SLOT_RED] =
            (float)(type->is_float
                        ? value
                        : value / (double)((1ull << (8 * type->size - type->is_signed)) - 1));
    else if (slot >= SLOT_U && slot < SLOT_CORNERS && obj_ply->uvs)
        obj_ply->uvs[2 * row + slot - SLOT_U] = (float)value;
}

/* ---- triangles ---- */

static enum status add_corners(struct ply *ply, uint32_t a, uint32_t b, uint32_t c)
{
    uint32_t *triangle = ply->indices.count + 3 <= MODEL_ELEMENT_MAX
                             ? obj_ply_array_add(&ply->indices, 3, sizeof(*triangle))
                             : NULL;
    if (!triangle)
        return no_memory(ply);
    triangle[0] = a;
    triangle[1] = b;
    triangle[2] = c;
    return STATUS_OK;
}

/* Reads a face and cuts it into a triangle fan, or reads triangle strips separated by -1. */
static enum status read_corners(struct ply *ply, struct text_scan *body,
                                const struct property *property, uint64_t length)
{
    const bool is_face = ply->element->kind == KIND_FACE;
    const uint32_t first_index = (uint32_t)ply->indices.count;
    uint32_t corners[2] = { 0 };
    uint64_t count = 0; /* corners of this face or strip */
    enum status status = STATUS_OK;
    for (uint64_t i = 0; i < length && status == STATUS_OK; i++) {
        double value;
        if (!read_value(ply, body, property->type, &value))
            return bad_row(ply, "the file ends early, or a number is missing");
        if (!is_face && value < 0) {
            count = 0;
            continue;
        }
        if (!(value >= 0 && value < MODEL_ELEMENT_MAX))
            return bad_row(ply, "a face refers to a vertex that does not exist");
        const uint32_t c = (uint32_t)value;
        const bool is_odd = !is_face && count & 1;
        const bool is_flat = /* degenerate triangles join two strips */
            !is_face && (corners[0] == corners[1] || corners[0] == c || corners[1] == c);
        if (count >= 2 && !is_flat)
            status = add_corners(ply, corners[is_odd], corners[!is_odd], c);
        if (count < 2)
            corners[count] = c;
        else if (!is_face)
            corners[0] = corners[1];
        if (count >= 2)
            corners[1] = c;
        count++;
    }
    if (status == STATUS_OK && is_face && count > 3) {
        struct polygon_range *polygon = obj_ply_array_add(&ply->polygons, 1, sizeof(*polygon));
        if (!polygon)
            return no_memory(ply);
        *polygon = (struct polygon_range){ first_index, (uint32_t)count };
    }
    return status;
}

/* ---- rows ---- */

static enum status read_row(struct ply *ply, struct text_scan *body)
{
    const struct property *properties = &ply->properties[ply->element->first];
    for (uint32_t i = 0; i < ply->element->property_count; i++) {
        const struct property *property = &properties[i];
        uint64_t length = 1;
        double value;
        if (property->count && !read_length(ply, body, property, &length))
            return bad_row(ply, "the file ends early, or a list has no valid length");
        if (property->slot == SLOT_CORNERS) {
            const enum status status = read_corners(ply, body, property, length);
            if (status != STATUS_OK)
                return status;
            continue;
        }
        for (uint64_t k = 0; k < length; k++) {
            if (!read_value(ply, body, property->type, &value))
                return bad_row(ply, "the file ends early, or a number is missing");
        }
        if (!property->count && ply->element->kind == KIND_VERTEX)
            store_value(ply, property, value);
    }
    return STATUS_OK;
}

/* Reads all elements. Rejects a count for which the file is too short, at one byte per element.
 * Skips elements without properties, because the file has no bytes for them. */
static enum status read_elements(struct ply *ply, struct text_scan *body)
{
    enum status status = STATUS_OK;
    for (uint32_t i = 0; i < ply->element_count && status == STATUS_OK; i++) {
        const struct element *element = &ply->elements[i];
        ply->element = element;
        ply->row = 0;
        if (element->property_count == 0)
            continue;
        if (element->count > (uint64_t)(body->end - body->at) + 1 ||
            element->count > MODEL_ELEMENT_MAX)
            return bad_row(ply, "the file is too short for the count in its header");
        if (element->kind == KIND_VERTEX)
            status = allocate_vertices(ply, element);
        for (; ply->row < element->count && status == STATUS_OK; ply->row++)
            status = read_row(ply, body);
    }
    return status;
}

/* ---- the whole file ---- */

static enum status finish_triangles(struct ply *ply)
{
    const struct polygon polygon = { .positions = ply->obj_ply->positions };
    uint32_t *indices = ply->indices.items;
    for (size_t i = 0; i < ply->indices.count; i++) {
        if (indices[i] >= ply->vertex_count) {
            log_error("%s: a face refers to a vertex that does not exist",
                      ply->obj_ply->import->path);
            return STATUS_DATA;
        }
    }
    if (!polygon_triangulate_all(&polygon, ply->polygons.items, ply->polygons.count, indices))
        return no_memory(ply);
    ply->obj_ply->parts = calloc(1, sizeof(*ply->obj_ply->parts));
    if (!ply->obj_ply->parts)
        return no_memory(ply);
    ply->obj_ply->part_count = 1;
    ply->obj_ply->indices = indices;
    ply->obj_ply->parts[0] = (struct obj_ply_part){
        .material = ply->obj_ply->material_count,
        .vertex_count = ply->vertex_count,
        .index_count = (uint32_t)ply->indices.count,
        .has_uvs = ply->obj_ply->uvs,
    };
    for (size_t i = 0; ply->obj_ply->colors && i < ply->vertex_count; i++)
        ply->obj_ply->colors[4 * i + 3] = 1;
    ply->indices.items = NULL; /* moved to ply->obj_ply */
    return STATUS_OK;
}

/* Replaces line breaks by blanks, because ASCII values may be split into lines anywhere. */
static void join_lines(const struct ply *ply, char *text, const struct text_scan *body)
{
    if (ply->format != FORMAT_TEXT)
        return;
    for (char *c = text + (body->at - text); c < body->end; c++)
        *c = (char)(text_is_break(*c) ? ' ' : *c);
}

enum status ply_read(struct obj_ply *obj_ply)
{
    size_t size = 0;
    bool is_found;
    struct ply *ply = calloc(1, sizeof(*ply));
    char *text = obj_ply_read_file(obj_ply->import, obj_ply->import->path, &size, &is_found);
    enum status status = STATUS_TRY_AGAIN;
    if (ply && text) {
        struct text_scan file = { text, text + size };
        ply->obj_ply = obj_ply;
        status = read_header(ply, &file);
        if (status == STATUS_OK) {
            join_lines(ply, text, &file);
            status = read_elements(ply, &file);
        }
        if (status == STATUS_OK)
            status = finish_triangles(ply);
    }
    if (ply) {
        free(ply->indices.items);
        free(ply->polygons.items);
    }
    free(ply);
    free(text);
    return status;
}
