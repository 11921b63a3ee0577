/* stl.c: reader of STL files, ASCII or binary. Vertices are welded by position. The winding decides
 * which side of a facet is outside; its normal is ignored. Vertex normals are smooth over facets
 * whose normals differ by less than the crease angle. */
#include <cglm/struct.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/scene/import/obj_ply.h"

enum {
    HEADER_SIZE = 84, /* binary header with the facet count, bytes */
    FACET_SIZE = 50,  /* binary facet: normal, three corners, attribute */
    CORNERS_AT = 12,
    ATTRIBUTE_AT = 48,
    SLOTS_MIN = 1024,
    DEGREE_MAX = 1024, /* maximum facets at a point for smooth normals */
};

#define CREASE_COSINE 0.766f /* of 40 degrees */

struct stl {
    struct obj_ply *obj_ply;
    struct obj_ply_array positions, indices;
    uint32_t *slots; /* hash table of vertex indices + 1; 0 for empty slots */
    size_t slot_count;
    bool has_line;   /* locations are lines, else facets */
    uint32_t number; /* current line or facet, from 1 */
};

static enum status fault(const struct stl *stl, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* Logs "FILE: line N: ..." or "FILE: facet N: ...". */
static enum status fault(const struct stl *stl, const char *format, ...)
{
    char text[160];
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(text, sizeof(text), format, arguments);
    va_end(arguments);
    log_error("%s: %s %u: %s", stl->obj_ply->import->path, stl->has_line ? "line" : "facet",
              stl->number, text);
    return STATUS_DATA;
}

/* ---- vertices ---- */

static bool is_equal(const float *a, const float *b)
{
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

static size_t find_slot(const struct stl *stl, const float *position)
{
    const float *positions = stl->positions.items;
    uint32_t words[3];
    memcpy(words, position, sizeof(words));
    uint64_t hash = 0x9e3779b97f4a7c15;
    for (int k = 0; k < 3; k++) {
        hash = (hash ^ words[k]) * 0xff51afd7ed558ccd;
        hash ^= hash >> 32;
    }
    size_t slot = hash & (stl->slot_count - 1);
    while (stl->slots[slot] != 0 &&
           !is_equal(&positions[3 * (size_t)(stl->slots[slot] - 1)], position))
        slot = (slot + 1) & (stl->slot_count - 1);
    return slot;
}

/* Doubles the hash table. Returns false when out of memory. */
static bool grow_slots(struct stl *stl)
{
    const size_t slot_count = stl->slot_count > 0 ? 2 * stl->slot_count : SLOTS_MIN;
    uint32_t *slots = calloc(slot_count, sizeof(*slots));
    if (!slots)
        return false;
    free(stl->slots);
    stl->slots = slots;
    stl->slot_count = slot_count;
    for (size_t i = 0; i < stl->positions.count / 3; i++)
        slots[find_slot(stl, (const float *)stl->positions.items + 3 * i)] = (uint32_t)i + 1;
    return true;
}

/* Adds a triangle corner, and its vertex unless one at this position exists. */
static enum status add_corner(struct stl *stl, const float *position)
{
    float at[3];
    for (int k = 0; k < 3; k++) {
        at[k] = position[k] + 0.0F; /* -0 becomes 0 */
        if (!(fabsf(at[k]) <= (float)MODEL_COORDINATE_MAX))
            return fault(stl, "expected coordinates from %d to %d, got %g", -MODEL_COORDINATE_MAX,
                         MODEL_COORDINATE_MAX, (double)at[k]);
    }
    if (2 * (stl->positions.count / 3) >= stl->slot_count && !grow_slots(stl))
        return log_out_of_memory(stl->obj_ply->import->path);
    const size_t slot = find_slot(stl, at);
    uint32_t *index = obj_ply_array_add(&stl->indices, 1, sizeof(*index));
    if (index && stl->slots[slot] == 0) {
        float *added = obj_ply_array_add(&stl->positions, 3, sizeof(*added));
        index = added ? index : NULL;
        if (added)
            memcpy(added, at, sizeof(at));
        stl->slots[slot] = (uint32_t)(stl->positions.count / 3);
    }
    if (!index)
        return log_out_of_memory(stl->obj_ply->import->path);
    *index = stl->slots[slot] - 1;
    return STATUS_OK;
}

/* ---- binary ---- */

static uint32_t read_u32(const char *bytes)
{
    uint32_t value = 0;
    for (int i = 3; i >= 0; i--)
        value = value << 8 | (uint8_t)bytes[i];
    return value;
}

static enum status read_binary(struct stl *stl, const char *bytes, size_t size)
{
    const uint32_t facet_count = size >= HEADER_SIZE ? read_u32(&bytes[HEADER_SIZE - 4]) : 0;
    const uint64_t wanted = HEADER_SIZE + (uint64_t)facet_count * FACET_SIZE;
    enum status status = STATUS_OK;
    bool has_attributes = false;
    if (size < wanted) {
        log_error("%s: the file is cut short, or not STL: expected %llu bytes for %u facets, got "
                  "%zu",
                  stl->obj_ply->import->path, (unsigned long long)wanted, facet_count, size);
        return STATUS_DATA;
    }
    for (uint32_t i = 0; i < facet_count && status == STATUS_OK; i++) {
        const char *facet = &bytes[HEADER_SIZE + (size_t)i * FACET_SIZE];
        stl->number = i + 1;
        for (size_t k = 0; k < 3 && status == STATUS_OK; k++) {
            float position[3];
            for (size_t c = 0; c < 3; c++) {
                const uint32_t word = read_u32(&facet[CORNERS_AT + 4 * (3 * k + c)]);
                memcpy(&position[c], &word, sizeof(word));
            }
            status = add_corner(stl, position);
        }
        has_attributes |= facet[ATTRIBUTE_AT] != 0 || facet[ATTRIBUTE_AT + 1] != 0;
    }
    if (has_attributes)
        obj_ply_note_undrawn(stl->obj_ply->undrawn, "colours of facets");
    return status;
}

/* ---- ASCII ---- */

enum state {
    IN_FILE,
    IN_SOLID,
    IN_FACET,
    IN_LOOP,
    STATE_COUNT,
};

static const struct keyword {
    const char *word;
    enum state from, to;
} keywords[] = {
    { "solid", IN_FILE, IN_SOLID },    { "facet", IN_SOLID, IN_FACET },
    { "outer", IN_FACET, IN_LOOP },    { "vertex", IN_LOOP, IN_LOOP },
    { "endloop", IN_LOOP, IN_FACET },  { "endfacet", IN_FACET, IN_SOLID },
    { "endsolid", IN_SOLID, IN_FILE },
};

/* Takes the next word of a line, which must be allowed in a state. Returns NULL after a fault. */
static const struct keyword *take_keyword(const struct stl *stl, struct text_scan *line,
                                          enum state state)
{
    static const char *const expected[STATE_COUNT] = {
        [IN_FILE] = "solid",
        [IN_SOLID] = "facet or endsolid",
        [IN_FACET] = "outer loop or endfacet",
        [IN_LOOP] = "vertex or endloop",
    };
    char got[32];
    for (size_t i = 0; i < sizeof(keywords) / sizeof(keywords[0]); i++) {
        if (keywords[i].from == state && text_take_word(line, keywords[i].word))
            return &keywords[i];
    }
    const struct text_scan word = text_word(line);
    text_show(got, sizeof(got), &word);
    (void)fault(stl, "expected %s, got '%s'", expected[state], got);
    return NULL;
}

/* Reads what follows a keyword. `corners` counts the corners of the current loop. */
static enum status read_arguments(struct stl *stl, const struct keyword *keyword,
                                  struct text_scan *line, uint32_t *corners)
{
    float position[3];
    if (keyword->to == IN_FACET && keyword->from == IN_SOLID && text_take_word(line, "normal")) {
        for (int k = 0; k < 3; k++)
            (void)text_word(line); /* not a number for degenerate facets of some exporters */
    }
    if (keyword->from == IN_FILE || keyword->to == IN_FILE)
        line->at = line->end; /* the solid's name */
    if (keyword->from == IN_FACET && keyword->to == IN_LOOP) {
        (void)text_take_word(line, "loop");
        *corners = 0;
    }
    if (keyword->from != IN_LOOP)
        return STATUS_OK;
    if (keyword->to == IN_FACET)
        return *corners == 3 ? STATUS_OK : fault(stl, "expected 3 vertices, got %u", *corners);
    for (int k = 0; k < 3; k++) {
        if (!text_float(line, &position[k]))
            return fault(stl, "vertex: expected 3 numbers");
    }
    (*corners)++;
    return *corners > 3 ? fault(stl, "expected 3 vertices, got more") : add_corner(stl, position);
}

static enum status read_text(struct stl *stl, const char *text, size_t size)
{
    struct text_scan file = { text, text + size };
    enum state state = IN_FILE;
    enum status status = STATUS_OK;
    uint32_t corners = 0;
    stl->has_line = true;
    if (size >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0)
        file.at += 3;
    while (file.at < file.end && status == STATUS_OK) {
        struct text_scan line = text_line(&file);
        stl->number++;
        while (status == STATUS_OK && text_skip(&line)) {
            const struct keyword *keyword = take_keyword(stl, &line, state);
            if (!keyword)
                return STATUS_DATA;
            state = keyword->to;
            status = read_arguments(stl, keyword, &line, &corners);
        }
    }
    if (status == STATUS_OK && state != IN_FILE)
        return fault(stl, "the file is cut short: expected endsolid");
    return status;
}

/* ---- normals ---- */

/* Facets at each point: `list[starts[i]]` to `list[starts[i + 1] - 1]`; normals, times twice the
 * area. All arrays are owned. */
struct facets {
    uint32_t *starts, *list;
    vec3s *normals;
};

static void facets_finish(struct facets *facets)
{
    free(facets->starts);
    free(facets->list);
    free(facets->normals);
}

/* Returns false when out of memory. The caller calls facets_finish() in any case. */
static bool facets_init(struct facets *facets, const struct stl *stl)
{
    const size_t corner_count = stl->indices.count;
    const size_t point_count = stl->positions.count / 3;
    const uint32_t *indices = stl->indices.items;
    const vec3s *points = stl->positions.items;
    *facets = (struct facets){
        .starts = calloc(point_count + 2, sizeof(*facets->starts)),
        .list = malloc((corner_count + 1) * sizeof(*facets->list)),
        .normals = malloc((corner_count / 3 + 1) * sizeof(*facets->normals)),
    };
    if (!facets->starts || !facets->list || !facets->normals)
        return false;
    for (size_t i = 0; i < corner_count; i++)
        facets->starts[indices[i] + 2]++;
    for (size_t i = 2; i < point_count + 2; i++)
        facets->starts[i] += facets->starts[i - 1];
    for (size_t i = 0; i < corner_count; i++)
        facets->list[facets->starts[indices[i] + 1]++] = (uint32_t)(i / 3);
    for (size_t i = 0; i < corner_count / 3; i++) {
        const vec3s a = points[indices[3 * i]];
        facets->normals[i] = glms_vec3_cross(glms_vec3_sub(points[indices[3 * i + 1]], a),
                                             glms_vec3_sub(points[indices[3 * i + 2]], a));
    }
    return true;
}

/* Returns the sum of the normals at a point within the crease angle of a facet's normal. */
static vec3s smooth_normal(const struct facets *facets, uint32_t point, size_t facet)
{
    const uint32_t first = facets->starts[point];
    const uint32_t end = facets->starts[point + 1];
    const vec3s own = glms_vec3_normalize(facets->normals[facet]);
    vec3s sum = glms_vec3_zero();
    if (end - first > DEGREE_MAX)
        return facets->normals[facet];
    for (uint32_t i = first; i < end; i++) {
        const vec3s other = facets->normals[facets->list[i]];
        if (glms_vec3_dot(own, glms_vec3_normalize(other)) > CREASE_COSINE)
            sum = glms_vec3_add(sum, other);
    }
    return sum;
}

/* Stores a vertex with a normal for each corner in stl->obj_ply. Equal vertices are welded when the
 * model is built. */
static enum status store_corners(struct stl *stl)
{
    struct obj_ply *obj_ply = stl->obj_ply;
    const size_t count = stl->indices.count;
    const uint32_t *indices = stl->indices.items;
    struct facets facets;
    enum status status = STATUS_OK;
    obj_ply->positions = malloc(3 * (count + 1) * sizeof(*obj_ply->positions));
    obj_ply->normals = malloc(3 * (count + 1) * sizeof(*obj_ply->normals));
    obj_ply->indices = malloc((count + 1) * sizeof(*obj_ply->indices));
    obj_ply->parts = calloc(1, sizeof(*obj_ply->parts));
    if (!facets_init(&facets, stl) || !obj_ply->positions || !obj_ply->normals ||
        !obj_ply->indices || !obj_ply->parts)
        status = log_out_of_memory(obj_ply->import->path);
    for (size_t i = 0; i < count && status == STATUS_OK; i++) {
        const vec3s normal = smooth_normal(&facets, indices[i], i / 3);
        memcpy(&obj_ply->positions[3 * i], (const vec3s *)stl->positions.items + indices[i],
               sizeof(normal));
        memcpy(&obj_ply->normals[3 * i], &normal, sizeof(normal));
        obj_ply->indices[i] = (uint32_t)i;
    }
    facets_finish(&facets);
    if (status != STATUS_OK)
        return status;
    obj_ply->part_count = 1;
    obj_ply->parts[0].vertex_count = (uint32_t)count;
    obj_ply->parts[0].index_count = (uint32_t)count;
    return STATUS_OK;
}

/* ---- the whole file ---- */

/* Returns true if a file is ASCII. Binary files may begin with "solid", too, but their size fits
 * the facet count. */
static bool is_text(const char *bytes, size_t size)
{
    struct text_scan scan = { bytes, bytes + size };
    if (size >= HEADER_SIZE &&
        size == HEADER_SIZE + (uint64_t)read_u32(&bytes[HEADER_SIZE - 4]) * FACET_SIZE)
        return false;
    if (size >= 3 && memcmp(bytes, "\xef\xbb\xbf", 3) == 0)
        scan.at += 3;
    while (scan.at < scan.end && (text_is_blank(*scan.at) || text_is_break(*scan.at)))
        scan.at++;
    struct text_scan line = text_line(&scan);
    return text_take_word(&line, "solid") && !memchr(bytes, 0, size < 512 ? size : 512);
}

enum status stl_read(struct obj_ply *obj_ply)
{
    struct stl stl = { .obj_ply = obj_ply };
    size_t size = 0;
    bool is_found;
    char *bytes = obj_ply_read_file(obj_ply->import, obj_ply->import->path, &size, &is_found);
    enum status status = STATUS_TRY_AGAIN;
    if (bytes)
        status =
            is_text(bytes, size) ? read_text(&stl, bytes, size) : read_binary(&stl, bytes, size);
    free(bytes);
    free(stl.slots);
    if (status == STATUS_OK)
        status = store_corners(&stl);
    free(stl.positions.items);
    free(stl.indices.items);
    return status;
}
