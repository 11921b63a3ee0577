/* model_weld.c: welds identical vertices of a mesh by a hash table; computes missing normals. */
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include "src/scene/import/importer.h"

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

/* Returns true if the first key_size bytes of two vertices are equal. If key_size includes the
 * whole vertex, the vertices' extras must also be equal. */
static bool is_identical(const struct mesh *mesh, uint32_t a, uint32_t b, size_t key_size)
{
    const bool is_whole = key_size == sizeof(struct mesh_vertex);
    const size_t extra_size = mesh->extras && is_whole ? sizeof(*mesh->extras) : 0;
    if (memcmp(&mesh->vertices[a], &mesh->vertices[b], key_size) != 0)
        return false;
    return !extra_size || memcmp(&mesh->extras[a], &mesh->extras[b], extra_size) == 0;
}

/* Returns, for each vertex, the index of the first identical vertex in its surroundings object. The
 * caller frees the array. Returns NULL when out of memory. */
static uint32_t *find_identical(const struct mesh *mesh, size_t key_size, const uint32_t *starts,
                                uint32_t start_count)
{
    uint32_t start = 0, next = 0;
    size_t slot_count = 2;
    while (slot_count < 2 * (size_t)mesh->vertex_count)
        slot_count *= 2;
    uint32_t *slots = calloc(slot_count, sizeof(*slots)); /* vertex index + 1, or 0 */
    uint32_t *identical = malloc(((size_t)mesh->vertex_count + 1) * sizeof(*identical));
    if (!slots || !identical) {
        free(slots);
        free(identical);
        return NULL;
    }
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        const void *key = &mesh->vertices[i];
        while (next < start_count && starts[next] <= i)
            start = starts[next++];
        size_t slot = (hash(key, key_size) ^ start * 0x9e3779b1u) & (slot_count - 1);
        while (slots[slot] != 0 &&
               (slots[slot] - 1 < start || !is_identical(mesh, slots[slot] - 1, i, key_size)))
            slot = (slot + 1) & (slot_count - 1);
        if (slots[slot] == 0)
            slots[slot] = i + 1;
        identical[i] = slots[slot] - 1;
    }
    free(slots);
    return identical;
}

static bool has_no_normal(const struct mesh_vertex *vertex)
{
    return vertex->normal.x == 0 && vertex->normal.y == 0 && vertex->normal.z == 0;
}

static bool compute_missing_normals(struct mesh *mesh)
{
    uint32_t first = 0;
    while (first < mesh->vertex_count && !has_no_normal(&mesh->vertices[first]))
        first++;
    if (first == mesh->vertex_count)
        return true;

    /* Welds a copy by position only, so that normals are smooth across colour and texture seams. */
    struct mesh smooth = { 0 };
    uint32_t *identical = find_identical(mesh, sizeof(vec3s), NULL, 0);
    bool is_done = identical && mesh_append(&smooth, mesh);
    if (is_done) {
        for (uint32_t i = 0; i < smooth.index_count; i++)
            smooth.indices[i] = identical[smooth.indices[i]];
        mesh_make_normals(&smooth);
        for (uint32_t i = first; i < mesh->vertex_count; i++) {
            if (has_no_normal(&mesh->vertices[i]))
                mesh->vertices[i].normal = smooth.vertices[identical[i]].normal;
        }
    }
    mesh_finish(&smooth);
    free(identical);
    return is_done;
}

/* Numbers the vertices used by triangles in order of first use. Returns their count. */
static uint32_t renumber(const struct mesh *mesh, const uint32_t *identical, uint32_t *new_index)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < mesh->vertex_count; i++)
        new_index[i] = unused;
    for (uint32_t i = 0; i < mesh->index_count; i++) {
        uint32_t vertex = identical[mesh->indices[i]];
        if (new_index[vertex] == unused)
            new_index[vertex] = count++;
    }
    return count;
}

/* Sets each object's first vertex to the smallest new index in that object or any later one. */
static void update_starts(const struct mesh *mesh, const uint32_t *new_index, uint32_t count,
                          uint32_t *starts, uint32_t start_count)
{
    uint32_t end = mesh->vertex_count, smallest = count;
    for (uint32_t k = start_count; k-- > 0;) {
        for (uint32_t i = starts[k]; i < end; i++)
            smallest = new_index[i] < smallest ? new_index[i] : smallest;
        end = starts[k];
        starts[k] = smallest;
    }
}

bool model_weld_vertices(struct mesh *mesh, uint32_t *starts, uint32_t start_count)
{
    if (mesh->index_count == 0)
        return true;
    if (!compute_missing_normals(mesh))
        return false;
    struct mesh welded = { 0 };
    uint32_t *new_index = malloc(mesh->vertex_count * sizeof(*new_index));
    uint32_t *identical = find_identical(mesh, sizeof(struct mesh_vertex), starts, start_count);
    bool is_done = new_index && identical &&
                   mesh_init(&welded, renumber(mesh, identical, new_index), mesh->index_count);
    if (is_done && mesh->extras)
        is_done = mesh_add_extras(&welded);
    if (is_done) {
        for (uint32_t i = 0; i < mesh->index_count; i++) {
            uint32_t vertex = identical[mesh->indices[i]];
            welded.indices[i] = new_index[vertex];
            welded.vertices[new_index[vertex]] = mesh->vertices[vertex];
            if (welded.extras && mesh->extras)
                welded.extras[new_index[vertex]] = mesh->extras[vertex];
        }
        update_starts(mesh, new_index, welded.vertex_count, starts, start_count);
        mesh_finish(mesh);
        *mesh = welded;
    } else {
        mesh_finish(&welded);
    }
    free(new_index);
    free(identical);
    return is_done;
}
