/* weld.c: sorts vertices by place. */
#include "src/scene/weld.h"
#include <stdlib.h>

struct placed {
    vec3s at;
    uint32_t vertex;
};

static int by_place(const void *left, const void *right)
{
    const struct placed *a = left, *b = right;
    for (int k = 0; k < 3; k++) {
        if (a->at.raw[k] < b->at.raw[k] || a->at.raw[k] > b->at.raw[k])
            return a->at.raw[k] < b->at.raw[k] ? -1 : 1;
    }
    return 0;
}

bool weld_init(struct weld *weld, const struct mesh *mesh, uint32_t first, uint32_t count)
{
    struct placed *all = malloc((count + (size_t)1) * sizeof(*all));
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
        all[i] = (struct placed){ mesh->vertices[vertex].position, vertex };
    }
    if (done)
        qsort(all, count, sizeof(*all), by_place);
    for (uint32_t i = 0; done && i < count; i++) {
        weld->count += i == 0 || by_place(&all[i - 1], &all[i]) != 0;
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
