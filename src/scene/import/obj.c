/* obj.c: reader of the polygons of OBJ files (Wavefront, Advanced Visualizer, appendix B1). Curves,
 * points and lines are skipped. Faces index positions, texture coordinates and normals separately.
 * Each distinct combination of these indices within a part becomes a vertex. */
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/scene/import/obj_ply.h"

static const uint32_t none = UINT32_MAX;

enum {
    BUCKET_COUNT = 4096, /* hash buckets of parts by name */
};

/* Vertex of a face: indices into the file's lists, or `none`. */
struct corner {
    uint32_t position, uv, normal;
    uint32_t part;
    uint32_t next; /* next at this position; later vertex */
};

struct obj_part {
    struct obj_ply_part part;
    struct obj_ply_array indices;  /* corners of the triangles */
    struct obj_ply_array polygons; /* struct polygon_range */
    uint32_t next;                 /* next in hash bucket, or `none` */
};

struct obj {
    struct obj_ply *obj_ply;
    uint32_t line; /* line number, from 1 */
    uint32_t last_index;
    struct obj_ply_array positions, colors, uvs, normals; /* 3, 4, 2, 3 floats each */
    struct obj_ply_array first;                           /* position's first corner, or `none` */
    struct obj_ply_array corners, parts;
    size_t index_count; /* of all parts */
    uint32_t buckets[BUCKET_COUNT];
    char group[MATERIAL_NAME_SIZE]; /* from the last o or g */
    uint32_t material;              /* material index + 1, or 0 */
    uint32_t part;                  /* current part, or `none` */
};

static enum status fault(const struct obj *obj, const char *what, const struct text_scan *got)
{
    char word[32];
    text_show(word, sizeof(word), got);
    log_error("%s: line %u: %s, got '%s'", obj->obj_ply->import->path, obj->line, what, word);
    return STATUS_DATA;
}

static enum status no_memory(const struct obj *obj)
{
    return log_out_of_memory(obj->obj_ply->import->path);
}

/* ---- lists ---- */

/* Sets the colour of the last position. Earlier positions without a colour become white. */
static bool add_color(struct obj *obj, const float *color)
{
    const size_t missing = obj->positions.count - obj->colors.count;
    float(*colors)[4] = obj_ply_array_add(&obj->colors, missing, sizeof(*colors));
    for (size_t i = 0; colors && i < missing; i++) {
        for (int k = 0; k < 4; k++)
            colors[i][k] = i + 1 < missing || k == 3 ? 1 : color[k];
    }
    return colors;
}

static enum status read_position(struct obj *obj, struct text_scan *line)
{
    float numbers[8];
    const struct text_scan all = text_rest(line);
    const uint32_t count = text_floats(line, numbers, 8);
    float(*position)[3] = NULL;
    if (count < 3)
        return fault(obj, "expected three coordinates", &all);
    if (obj->positions.count == MODEL_ELEMENT_MAX)
        return fault(obj, "expected at most 268435456 vertices", &all);
    position = obj_ply_array_add(&obj->positions, 1, sizeof(*position));
    if (!position)
        return no_memory(obj);
    /* x y z may be followed by a weight w and by a colour, which is a common extension. */
    const float weight = (count == 4 || count == 7) && numbers[3] != 0 ? numbers[3] : 1;
    for (int k = 0; k < 3; k++)
        (*position)[k] = numbers[k] / weight;
    if (count >= 6 && !add_color(obj, &numbers[count == 7 ? 4 : 3]))
        return no_memory(obj);
    return STATUS_OK;
}

static enum status read_vector(struct obj *obj, struct text_scan *line, struct obj_ply_array *array,
                               uint32_t size, const char *what)
{
    float numbers[3] = { 0 };
    const struct text_scan all = text_rest(line);
    const uint32_t count = text_floats(line, numbers, 3);
    if (count < size && !(size == 2 && count == 1))
        return fault(obj, what, &all);
    float *to =
        array->count < MODEL_ELEMENT_MAX ? obj_ply_array_add(array, 1, size * sizeof(float)) : NULL;
    if (!to)
        return no_memory(obj);
    memcpy(to, numbers, size * sizeof(float));
    return STATUS_OK;
}

/* ---- faces ---- */

/* Reads a list index. Positive indices count from 1. Negative indices count back from the current
 * end of the list. Too large indices are detected only after the whole file is read. */
static bool read_index(const struct obj *obj, struct text_scan *word, size_t count, uint32_t *index)
{
    int64_t number;
    if (!text_integer(word, &number) || number == 0)
        return false;
    number = number < 0 ? (int64_t)count + number : number - 1;
    if (number < 0 || number > obj->last_index)
        return false;
    *index = (uint32_t)number;
    return true;
}

static inline bool take_slash(struct text_scan *word)
{
    if (word->at == word->end || *word->at != '/')
        return false;
    word->at++;
    return true;
}

/* Reads a face corner: "1", "1/2", "1//3" or "1/2/3". */
static bool read_corner(const struct obj *obj, struct text_scan *word, struct corner *corner)
{
    *corner = (struct corner){ none, none, none, none, none };
    if (!read_index(obj, word, obj->positions.count, &corner->position))
        return false;
    if (take_slash(word)) {
        const bool has_uv = word->at < word->end && *word->at != '/' && !text_is_blank(*word->at);
        if (has_uv && !read_index(obj, word, obj->uvs.count, &corner->uv))
            return false;
        if (take_slash(word) && word->at < word->end && !text_is_blank(*word->at) &&
            !read_index(obj, word, obj->normals.count, &corner->normal))
            return false;
    }
    return word->at == word->end || text_is_blank(*word->at);
}

/* Finds or adds a corner. Returns its index, or `none` when out of memory. */
static uint32_t find_corner(struct obj *obj, const struct corner *key)
{
    if (key->position >= obj->first.count) {
        size_t missing = key->position + (size_t)1 - obj->first.count;
        missing = missing < obj->positions.count && obj->positions.count > key->position
                      ? obj->positions.count - obj->first.count
                      : missing;
        void *added = obj_ply_array_add(&obj->first, missing, sizeof(uint32_t));
        if (!added)
            return none;
        memset(added, 0xff, missing * sizeof(uint32_t));
    }
    uint32_t *first = (uint32_t *)obj->first.items + key->position;
    struct corner *corners = obj->corners.items;
    for (uint32_t i = *first; i != none; i = corners[i].next) {
        if (corners[i].uv == key->uv && corners[i].normal == key->normal &&
            corners[i].part == key->part)
            return i;
    }
    if (obj->corners.count >= MODEL_ELEMENT_MAX)
        return none;
    struct corner *added = obj_ply_array_add(&obj->corners, 1, sizeof(*added));
    if (!added)
        return none;
    *added = *key;
    added->next = *first;
    *first = (uint32_t)obj->corners.count - 1;
    return *first;
}

/* Finds or adds the part of the current group and material. Returns `none` if out of memory. */
static uint32_t find_part(struct obj *obj)
{
    uint32_t bucket = obj->material * 31;
    for (const char *c = obj->group; *c; c++)
        bucket = bucket * 31 + (unsigned char)*c;
    uint32_t *first = &obj->buckets[bucket % BUCKET_COUNT];
    const struct obj_part *parts = obj->parts.items;
    for (uint32_t i = *first; parts && i != none; i = parts[i].next) {
        if (parts[i].part.material == obj->material && !strcmp(parts[i].part.name, obj->group))
            return i;
    }
    if (obj->parts.count >= MODEL_NODE_MAX)
        return none;
    struct obj_part *added = obj_ply_array_add(&obj->parts, 1, sizeof(*added));
    if (!added)
        return none;
    *added = (struct obj_part){ .part.material = obj->material, .next = *first };
    memcpy(added->part.name, obj->group, sizeof(obj->group));
    return *first = (uint32_t)obj->parts.count - 1;
}

/* Adds a face as a triangle fan. A face of only one or two corners adds nothing. */
static enum status read_face(struct obj *obj, struct text_scan *line)
{
    uint32_t count = 0, first = none, last = none;
    struct corner corner;
    if (obj->part == none)
        obj->part = find_part(obj);
    if (obj->part == none)
        return no_memory(obj);
    struct obj_part *part = (struct obj_part *)obj->parts.items + obj->part;
    const uint32_t first_index = (uint32_t)part->indices.count;
    for (; text_skip(line); count++) {
        struct text_scan word = *line;
        if (!read_corner(obj, line, &corner)) {
            const struct text_scan got = text_word(&word);
            return fault(obj, "expected indices of existing vertices", &got);
        }
        corner.part = obj->part;
        const uint32_t index = find_corner(obj, &corner);
        if (index == none || obj->index_count + 3 > MODEL_ELEMENT_MAX)
            return no_memory(obj);
        if (count >= 2) {
            uint32_t *triangle = obj_ply_array_add(&part->indices, 3, sizeof(uint32_t));
            if (!triangle)
                return no_memory(obj);
            triangle[0] = first;
            triangle[1] = last;
            triangle[2] = index;
            obj->index_count += 3;
        }
        first = count == 0 ? index : first;
        last = index;
    }
    if (count > 3) {
        struct polygon_range *polygon = obj_ply_array_add(&part->polygons, 1, sizeof(*polygon));
        if (!polygon)
            return no_memory(obj);
        *polygon = (struct polygon_range){ first_index, count };
    }
    return STATUS_OK;
}

/* ---- materials ---- */

static void use_material(struct obj *obj, const struct text_scan *line)
{
    const struct text_scan name = text_rest(line);
    const size_t length = (size_t)(name.end - name.at);
    obj->material = 0;
    for (uint32_t i = 0; i < obj->obj_ply->material_count && obj->material == 0; i++) {
        const char *other = obj->obj_ply->materials[i].name;
        if (strlen(other) == length && !strncmp(other, name.at, length))
            obj->material = i + 1;
    }
    obj->part = none;
}

/* ---- statements ---- */

static enum status read_other(struct obj *obj, struct text_scan *line)
{
    if (text_take_word(line, "o") || text_take_word(line, "g")) {
        const struct text_scan name = text_rest(line);
        memset(obj->group, 0, sizeof(obj->group));
        text_copy(obj->group, sizeof(obj->group), &name);
        obj->part = none;
    } else if (text_take_word(line, "usemtl")) {
        use_material(obj, line);
    } else if (text_take_word(line, "mtllib")) {
        const struct text_scan name = text_rest(line);
        return mtl_read(obj->obj_ply, &name);
    } else if (text_take_word(line, "l") || text_take_word(line, "p")) {
        obj_ply_note_undrawn(obj->obj_ply->undrawn, "points and lines");
    } else if (text_take_word(line, "curv") || text_take_word(line, "curv2") ||
               text_take_word(line, "surf")) {
        obj_ply_note_undrawn(obj->obj_ply->undrawn, "free-form curves and surfaces");
    }
    return STATUS_OK;
}

static enum status read_line(struct obj *obj, struct text_scan *line)
{
    if (!text_skip(line))
        return STATUS_OK;
    const char first = *line->at;
    char second = ' ', third = ' ';
    if (line->at + 1 < line->end)
        second = line->at[1];
    if (line->at + 2 < line->end)
        third = line->at[2];
    const bool is_short = text_is_blank(second);
    const bool is_vector = first == 'v' && text_is_blank(third);
    line->at += is_short && (first == 'v' || first == 'f') ? 1 : 0;
    if (first == 'v' && is_short)
        return read_position(obj, line);
    if (first == 'f' && is_short)
        return read_face(obj, line);
    line->at += is_vector ? 2 : 0;
    if (is_vector && second == 'n')
        return read_vector(obj, line, &obj->normals, 3, "expected three components of a normal");
    if (is_vector && second == 't')
        return read_vector(obj, line, &obj->uvs, 2, "expected texture coordinates");
    return is_vector ? STATUS_OK : read_other(obj, line);
}

/* Joins continued lines: replaces backslash line continuations by blanks. */
static void join_lines(char *text, size_t size)
{
    char *end = text + size;
    for (char *at = text; (at = memchr(at, '\\', (size_t)(end - at))); at++) {
        char *next = at + 1;
        if (next < end && *next == '\r')
            next++;
        if (next < end && *next == '\n')
            next++;
        if (next > at + 1)
            memset(at, ' ', (size_t)(next - at));
    }
}

/* ---- the whole file ---- */

static enum status check_index(const struct obj *obj, uint32_t index, size_t count,
                               const char *what)
{
    if (index < count)
        return STATUS_OK;
    log_error("%s: a face refers to a %s that does not exist: %llu of %zu",
              obj->obj_ply->import->path, what, index + 1ull, count);
    return STATUS_DATA;
}

static enum status check_corners(const struct obj *obj)
{
    const struct corner *corners = obj->corners.items;
    enum status status = STATUS_OK;
    for (size_t i = 0; i < obj->corners.count && status == STATUS_OK; i++) {
        const struct corner *corner = &corners[i];
        status = check_index(obj, corner->position, obj->positions.count, "vertex");
        if (status == STATUS_OK && corner->uv != none)
            status = check_index(obj, corner->uv, obj->uvs.count, "texture coordinate");
        if (status == STATUS_OK && corner->normal != none)
            status = check_index(obj, corner->normal, obj->normals.count, "normal");
    }
    return status;
}

static bool allocate(struct obj *obj)
{
    struct obj_ply *obj_ply = obj->obj_ply;
    const size_t count = obj->corners.count + 1;
    obj_ply->positions = malloc(3 * sizeof(float) * count);
    obj_ply->indices = malloc(sizeof(uint32_t) * (obj->index_count + 1));
    obj_ply->parts = calloc(obj->parts.count + 1, sizeof(*obj_ply->parts));
    if (obj->normals.count > 0)
        obj_ply->normals = malloc(3 * sizeof(float) * count);
    if (obj->colors.count > 0)
        obj_ply->colors = malloc(4 * sizeof(float) * count);
    if (obj->uvs.count > 0)
        obj_ply->uvs = malloc(2 * sizeof(float) * count);
    return obj_ply->positions && obj_ply->indices && obj_ply->parts &&
           (obj_ply->normals || obj->normals.count == 0) &&
           (obj_ply->colors || obj->colors.count == 0) && (obj_ply->uvs || obj->uvs.count == 0);
}

/* Copies the attributes that a corner refers to. */
static void copy_vertex(const struct obj *obj, const struct corner *corner, uint32_t vertex)
{
    static const float nothing[3] = { 0 }, white[4] = { 1, 1, 1, 1 };
    const float *positions = obj->positions.items, *normals = obj->normals.items;
    const float *colors = obj->colors.items, *uvs = obj->uvs.items;
    const struct obj_ply *obj_ply = obj->obj_ply;
    const size_t at = vertex;
    memcpy(&obj_ply->positions[3 * at], &positions[3 * (size_t)corner->position],
           3 * sizeof(float));
    if (obj_ply->normals)
        memcpy(&obj_ply->normals[3 * at],
               corner->normal == none ? nothing : &normals[3 * (size_t)corner->normal],
               3 * sizeof(float));
    if (obj_ply->colors)
        memcpy(&obj_ply->colors[4 * at],
               corner->position < obj->colors.count ? &colors[4 * (size_t)corner->position] : white,
               4 * sizeof(float));
    if (obj_ply->uvs)
        memcpy(&obj_ply->uvs[2 * at], corner->uv == none ? nothing : &uvs[2 * (size_t)corner->uv],
               2 * sizeof(float));
}

/* Triangulates the polygons of a part, and appends its triangles and vertices to the file's. */
static bool append_part(struct obj *obj, const struct obj_part *from, struct obj_ply_part *part,
                        uint32_t *vertex_count, uint32_t *index_count)
{
    struct corner *corners = obj->corners.items;
    uint32_t *indices = from->indices.items;
    const struct polygon polygon = {
        .positions = obj->positions.items,
        .vertex_of = corners ? &corners->position : NULL,
        .vertex_stride = sizeof(*corners) / sizeof(uint32_t),
    };
    if (!polygon_triangulate_all(&polygon, from->polygons.items, from->polygons.count, indices))
        return false;
    *part = from->part;
    part->first_vertex = *vertex_count;
    part->first_index = *index_count;
    for (size_t i = 0; corners && i < from->indices.count; i++) {
        struct corner *corner = &corners[indices[i]];
        if (corner->next == none) {
            corner->next = (*vertex_count)++;
            part->has_uvs |= corner->uv != none;
            copy_vertex(obj, corner, corner->next);
        }
        obj->obj_ply->indices[(*index_count)++] = corner->next - part->first_vertex;
    }
    part->vertex_count = *vertex_count - part->first_vertex;
    part->index_count = *index_count - part->first_index;
    return true;
}

/* Sorts triangles and vertices by part. Sets `next` of each corner to the index of its vertex. */
static enum status sort_by_part(struct obj *obj)
{
    struct obj_ply *obj_ply = obj->obj_ply;
    const struct obj_part *parts = obj->parts.items;
    struct corner *corners = obj->corners.items;
    uint32_t vertex_count = 0, index_count = 0;
    bool done = allocate(obj);
    for (size_t i = 0; i < obj->corners.count; i++)
        corners[i].next = none;
    for (size_t i = 0; i < obj->parts.count && done; i++)
        done = append_part(obj, &parts[i], &obj_ply->parts[i], &vertex_count, &index_count);
    obj_ply->part_count = done ? (uint32_t)obj->parts.count : 0;
    return done ? STATUS_OK : no_memory(obj);
}

static enum status read_text(struct obj *obj, char *text, size_t size)
{
    struct text_scan file = { text, text + size };
    enum status status = STATUS_OK;
    memset(obj->buckets, 0xff, sizeof(obj->buckets));
    obj->part = none;
    obj->last_index = size / 4 < MODEL_ELEMENT_MAX ? (uint32_t)(size / 4) : MODEL_ELEMENT_MAX - 1;
    if (size >= 3 && !memcmp(text, "\xef\xbb\xbf", 3))
        file.at += 3; /* UTF-8 byte order mark */
    join_lines(text, size);
    while (status == STATUS_OK && file.at < file.end) {
        struct text_scan line = text_line(&file);
        obj->line++;
        status = read_line(obj, &line);
    }
    return status == STATUS_OK ? check_corners(obj) : status;
}

static void finish(struct obj *obj)
{
    free(obj->positions.items);
    free(obj->colors.items);
    free(obj->uvs.items);
    free(obj->normals.items);
    free(obj->first.items);
    free(obj->corners.items);
    struct obj_part *parts = obj->parts.items;
    for (size_t i = 0; i < obj->parts.count; i++) {
        free(parts[i].indices.items);
        free(parts[i].polygons.items);
    }
    free(parts);
    free(obj);
}

enum status obj_read(struct obj_ply *obj_ply)
{
    size_t size;
    bool is_found;
    struct obj *obj = calloc(1, sizeof(*obj));
    char *text = obj_ply_read_file(obj_ply->import, obj_ply->import->path, &size, &is_found);
    enum status status = STATUS_TRY_AGAIN;
    if (obj && text) {
        obj->obj_ply = obj_ply;
        status = read_text(obj, text, size);
    }
    free(text);
    if (status == STATUS_OK)
        status = sort_by_part(obj);
    if (obj)
        finish(obj);
    return status;
}
