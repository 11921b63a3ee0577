/* vertex_weld.c: welds vertices after sorting them by position. */
#include "src/scene/geometry/vertex_weld.h"
#include <stdlib.h>

struct welded_vertex {
    vec3s at;
    uint32_t vertex;
};

static int compare_positions(const void *left, const void *right)
{
    const struct welded_vertex *a = left, *b = right;
    for (int k = 0; k < 3; k++) {
        if (a->at.raw[k] < b->at.raw[k] || a->at.raw[k] > b->at.raw[k])
            return a->at.raw[k] < b->at.raw[k] ? -1 : 1;
    }
    return 0;
}

bool vertex_weld_init(struct vertex_weld *vertex_weld, const struct mesh *mesh, uint32_t first,
                      uint32_t count)
{
    struct welded_vertex *all = malloc((count + (size_t)1) * sizeof(*all));
    *vertex_weld = (struct vertex_weld){
        .points = malloc((mesh->vertex_count + (size_t)1) * sizeof(*vertex_weld->points)),
        .corners = malloc((count + (size_t)1) * sizeof(*vertex_weld->corners)),
        .corner_count = count,
    };
    const bool done = all && vertex_weld->points && vertex_weld->corners;
    for (uint32_t i = 0; done && i < mesh->vertex_count; i++)
        vertex_weld->points[i] = VERTEX_WELD_NONE;
    for (uint32_t i = 0; done && i < count; i++) {
        const uint32_t vertex = mesh->indices[first + i];
        all[i] = (struct welded_vertex){ mesh->vertices[vertex].position, vertex };
    }
    if (done)
        qsort(all, count, sizeof(*all), compare_positions);
    for (uint32_t i = 0; done && i < count; i++) {
        vertex_weld->count += i == 0 || compare_positions(&all[i - 1], &all[i]) != 0;
        vertex_weld->points[all[i].vertex] = vertex_weld->count - 1;
    }
    for (uint32_t i = 0; done && i < count; i++)
        vertex_weld->corners[i] = vertex_weld->points[mesh->indices[first + i]];
    free(all);
    if (!done)
        vertex_weld_finish(vertex_weld);
    return done;
}

void vertex_weld_finish(struct vertex_weld *vertex_weld)
{
    free(vertex_weld->points);
    free(vertex_weld->corners);
    *vertex_weld = (struct vertex_weld){ 0 };
}
