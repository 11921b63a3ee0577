/* model_join.c: finds identical vertices, for smooth normals and small meshes. */
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include "src/scene/import/model_import.h"

static const uint32_t unused = UINT32_MAX;

_Static_assert(offsetof(struct mesh_vertex, position) == 0, "a position is the first bytes");
_Static_assert(sizeof(struct mesh_vertex) == 48, "no padding, so all bytes can be compared");
_Static_assert(sizeof(struct mesh_extra) == 24, "no padding, so all bytes can be compared");

static uint32_t hash(const void *key, size_t size)
{
    const unsigned char *bytes = key;
    uint64_t state = 0x9e3779b97f4a7c15;
    for (size_t i = 0; i < size; i += sizeof(uint32_t)) {
        uint32_t word;
        memcpy(&word, bytes + i, sizeof(word));
        state = (state ^ word) * 0xff51afd7ed558ccd;
        state ^= state >> 32;
    }
    return (uint32_t)state;
}

/* Whether two vertices have the same first key_size bytes and, if these are all, extras. */
static bool is_alike(const struct mesh *mesh, uint32_t a, uint32_t b, size_t key_size)
{
    const bool is_whole = key_size == sizeof(struct mesh_vertex);
    const size_t extra_size = mesh->extras && is_whole ? sizeof(*mesh->extras) : 0;
    if (memcmp(&mesh->vertices[a], &mesh->vertices[b], key_size) != 0)
        return false;
    return !extra_size || memcmp(&mesh->extras[a], &mesh->extras[b], extra_size) == 0;
}

/*
 * Returns for every vertex the index of the first one that is alike, from the last start on, in an
 * array that the caller frees; NULL when out of memory.
 */
static uint32_t *find_alike(const struct mesh *mesh, size_t key_size, const uint32_t *starts,
                            uint32_t start_count)
{
    uint32_t start = 0, next = 0;
    size_t slot_count = 2;
    while (slot_count < 2 * (size_t)mesh->vertex_count)
        slot_count *= 2;
    uint32_t *slots = calloc(slot_count, sizeof(*slots)); /* vertex + 1, 0: free */
    uint32_t *alike = malloc(((size_t)mesh->vertex_count + 1) * sizeof(*alike));
    if (!slots || !alike) {
        free(slots);
        free(alike);
        return NULL;
    }
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        const void *key = &mesh->vertices[i];
        while (next < start_count && starts[next] <= i)
            start = starts[next++];
        size_t slot = (hash(key, key_size) ^ start * 0x9e3779b1u) & (slot_count - 1);
        while (slots[slot] != 0 &&
               (slots[slot] - 1 < start || !is_alike(mesh, slots[slot] - 1, i, key_size)))
            slot = (slot + 1) & (slot_count - 1);
        if (slots[slot] == 0)
            slots[slot] = i + 1;
        alike[i] = slots[slot] - 1;
    }
    free(slots);
    return alike;
}

static bool has_no_normal(const struct mesh_vertex *vertex)
{
    return vertex->normal.x == 0 && vertex->normal.y == 0 && vertex->normal.z == 0;
}

static bool make_missing_normals(struct mesh *mesh)
{
    uint32_t first = 0;
    while (first < mesh->vertex_count && !has_no_normal(&mesh->vertices[first]))
        first++;
    if (first == mesh->vertex_count)
        return true;

    /* The same triangles with one vertex per position, regardless of colour and texture. */
    struct mesh smooth = { 0 };
    uint32_t *alike = find_alike(mesh, sizeof(vec3s), NULL, 0);
    bool is_done = alike && mesh_append(&smooth, mesh);
    if (is_done) {
        for (uint32_t i = 0; i < smooth.index_count; i++)
            smooth.indices[i] = alike[smooth.indices[i]];
        mesh_make_normals(&smooth);
        for (uint32_t i = first; i < mesh->vertex_count; i++) {
            if (has_no_normal(&mesh->vertices[i]))
                mesh->vertices[i].normal = smooth.vertices[alike[i]].normal;
        }
    }
    mesh_finish(&smooth);
    free(alike);
    return is_done;
}

/* Numbers the vertices that triangles use, in the order of first use; returns their number. */
static uint32_t renumber(const struct mesh *mesh, const uint32_t *alike, uint32_t *number)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < mesh->vertex_count; i++)
        number[i] = unused;
    for (uint32_t i = 0; i < mesh->index_count; i++) {
        uint32_t vertex = alike[mesh->indices[i]];
        if (number[vertex] == unused)
            number[vertex] = count++;
    }
    return count;
}

/* Turns each start to the least number of a vertex from there on. */
static void renumber_starts(const struct mesh *mesh, const uint32_t *number, uint32_t count,
                            uint32_t *starts, uint32_t start_count)
{
    uint32_t end = mesh->vertex_count, least = count;
    for (uint32_t k = start_count; k-- > 0;) {
        for (uint32_t i = starts[k]; i < end; i++)
            least = number[i] < least ? number[i] : least;
        end = starts[k];
        starts[k] = least;
    }
}

bool model_join_vertices(struct mesh *mesh, uint32_t *starts, uint32_t start_count)
{
    if (mesh->index_count == 0)
        return true;
    if (!make_missing_normals(mesh))
        return false;
    struct mesh joined = { 0 };
    uint32_t *number = malloc(mesh->vertex_count * sizeof(*number));
    uint32_t *alike = find_alike(mesh, sizeof(struct mesh_vertex), starts, start_count);
    bool is_done =
        number && alike && mesh_init(&joined, renumber(mesh, alike, number), mesh->index_count);
    if (is_done && mesh->extras)
        is_done = mesh_add_extras(&joined);
    if (is_done) {
        for (uint32_t i = 0; i < mesh->index_count; i++) {
            uint32_t vertex = alike[mesh->indices[i]];
            joined.indices[i] = number[vertex];
            joined.vertices[number[vertex]] = mesh->vertices[vertex];
            if (joined.extras && mesh->extras)
                joined.extras[number[vertex]] = mesh->extras[vertex];
        }
        renumber_starts(mesh, number, joined.vertex_count, starts, start_count);
        mesh_finish(mesh);
        *mesh = joined;
    } else {
        mesh_finish(&joined);
    }
    free(number);
    free(alike);
    return is_done;
}
