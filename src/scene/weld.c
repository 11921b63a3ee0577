/* weld.c: welds vertices by sorting them by position. */
#include "src/scene/weld.h"
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

bool weld_init(struct weld *weld, const struct mesh *mesh, uint32_t first, uint32_t count)
{
    struct welded_vertex *all = malloc((count + (size_t)1) * sizeof(*all));
    *weld = (struct weld){
        .points = malloc((mesh->vertex_count + (size_t)1) * sizeof(*weld->points)),
        .corners = malloc((count + (size_t)1) * sizeof(*weld->corners)),
        .corner_count = count,
    };
    const bool done = all && weld->points && weld->corners;
    for (uint32_t i = 0; done && i < mesh->vertex_count; i++)
        weld->points[i] = WELD_NONE;
    for (uint32_t i = 0; done && i < count; i++) {
        const uint32_t vertex = mesh->indices[first + i];
        all[i] = (struct welded_vertex){ mesh->vertices[vertex].position, vertex };
    }
    if (done)
        qsort(all, count, sizeof(*all), compare_positions);
    for (uint32_t i = 0; done && i < count; i++) {
        weld->count += i == 0 || compare_positions(&all[i - 1], &all[i]) != 0;
        weld->points[all[i].vertex] = weld->count - 1;
    }
    for (uint32_t i = 0; done && i < count; i++)
        weld->corners[i] = weld->points[mesh->indices[first + i]];
    free(all);
    if (!done)
        weld_finish(weld);
    return done;
}

void weld_finish(struct weld *weld)
{
    free(weld->points);
    free(weld->corners);
    *weld = (struct weld){ 0 };
}
