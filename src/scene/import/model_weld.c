/* model_weld.c: welds identical vertices of a mesh with meshoptimizer; computes missing normals. */
#include <meshoptimizer.h>
#include <stddef.h>
#include <stdlib.h>
#include "src/scene/import/importer.h"

static const uint32_t unused = UINT32_MAX;

_Static_assert(offsetof(struct mesh_vertex, position) == 0, "a position is the first bytes");
_Static_assert(sizeof(struct mesh_vertex) == 48, "no padding, so all bytes can be compared");
_Static_assert(sizeof(struct mesh_extra) == 24, "no padding, so all bytes can be compared");

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
    const struct meshopt_Stream positions = { mesh->vertices, sizeof(vec3s),
                                              sizeof(*mesh->vertices) };
    struct mesh smooth = { 0 };
    uint32_t *new_index = malloc(mesh->vertex_count * sizeof(*new_index));
    const bool is_done = new_index && mesh_append(&smooth, mesh);
    if (is_done) {
        smooth.vertex_count = (uint32_t)meshopt_generateVertexRemapMulti(
            new_index, mesh->indices, mesh->index_count, mesh->vertex_count, &positions, 1);
        meshopt_remapVertexBuffer(smooth.vertices, mesh->vertices, mesh->vertex_count,
                                  sizeof(*mesh->vertices), new_index);
        meshopt_remapIndexBuffer(smooth.indices, mesh->indices, mesh->index_count, new_index);
        mesh_make_normals(&smooth);
        for (uint32_t i = first; i < mesh->vertex_count; i++) {
            if (has_no_normal(&mesh->vertices[i]) && new_index[i] != unused)
                mesh->vertices[i].normal = smooth.vertices[new_index[i]].normal;
        }
    }
    mesh_finish(&smooth);
    free(new_index);
    return is_done;
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

/* Maps each vertex to its index in the welded mesh, in order of first use. `objects` has space for
 * an object number per vertex. Returns the number of welded vertices. */
static uint32_t find_identical(const struct mesh *mesh, const uint32_t *starts,
                               uint32_t start_count, uint32_t *objects, uint32_t *new_index)
{
    const struct meshopt_Stream streams[] = {
        { mesh->vertices, sizeof(*mesh->vertices), sizeof(*mesh->vertices) },
        { objects, sizeof(*objects), sizeof(*objects) },
        { mesh->extras, sizeof(*mesh->extras), sizeof(*mesh->extras) },
    };
    uint32_t object = 0;
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        while (object < start_count && starts[object] <= i)
            object++;
        objects[i] = object;
    }
    return (uint32_t)meshopt_generateVertexRemapMulti(new_index, mesh->indices, mesh->index_count,
                                                      mesh->vertex_count, streams,
                                                      mesh->extras ? 3 : 2);
}

bool model_weld_vertices(struct mesh *mesh, uint32_t *starts, uint32_t start_count)
{
    if (mesh->index_count == 0)
        return true;
    if (!compute_missing_normals(mesh))
        return false;
    struct mesh welded = { 0 };
    uint32_t *new_index = malloc(mesh->vertex_count * sizeof(*new_index));
    uint32_t *objects = malloc(mesh->vertex_count * sizeof(*objects));
    bool is_done = new_index && objects &&
                   mesh_init(&welded, find_identical(mesh, starts, start_count, objects, new_index),
                             mesh->index_count);
    if (is_done && mesh->extras)
        is_done = mesh_add_extras(&welded);
    if (is_done) {
        meshopt_remapIndexBuffer(welded.indices, mesh->indices, mesh->index_count, new_index);
        meshopt_remapVertexBuffer(welded.vertices, mesh->vertices, mesh->vertex_count,
                                  sizeof(*mesh->vertices), new_index);
        if (mesh->extras)
            meshopt_remapVertexBuffer(welded.extras, mesh->extras, mesh->vertex_count,
                                      sizeof(*mesh->extras), new_index);
        update_starts(mesh, new_index, welded.vertex_count, starts, start_count);
        mesh_finish(mesh);
        *mesh = welded;
    } else {
        mesh_finish(&welded);
    }
    free(new_index);
    free(objects);
    return is_done;
}
