/* clip_sheet_to_mesh.c: clips a sheet of triangles to the inside of a closed mesh. */
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>
#include "src/scene/geometry/point_in_mesh.h"

/* Growing list of clipped triangles. */
struct cut {
    const struct closed_mesh *closed_mesh;
    float step; /* maximum side length near the surface, metres */
    struct mesh_vertex *vertices;
    uint32_t count, room;
    bool failed; /* out of memory */
};

static struct mesh_vertex between(const struct mesh_vertex *a, const struct mesh_vertex *b, float t)
{
    vec3s normal = glms_vec3_lerp(a->normal, b->normal, t);
    return (struct mesh_vertex){
        .position = glms_vec3_lerp(a->position, b->position, t),
        .normal = glms_vec3_norm2(normal) > 0.0F ? glms_vec3_normalize(normal) : a->normal,
        .color = glms_vec3_lerp(a->color, b->color, t),
        .uv = glms_vec2_lerp(a->uv, b->uv, t),
        .material = a->material,
    };
}

static void emit(struct cut *cut, const struct mesh_vertex *a, const struct mesh_vertex *b,
                 const struct mesh_vertex *c)
{
    if (cut->room - cut->count < 3 && !cut->failed) {
        uint32_t room = cut->room < UINT32_MAX / 2 - 1024 ? 2 * cut->room + 1024 : 0;
        struct mesh_vertex *vertices =
            room ? realloc(cut->vertices, room * sizeof(*vertices)) : NULL;
        cut->failed = !vertices;
        cut->vertices = vertices ? vertices : cut->vertices;
        cut->room = vertices ? room : cut->room;
    }
    if (cut->failed)
        return;
    cut->vertices[cut->count++] = *a;
    cut->vertices[cut->count++] = *b;
    cut->vertices[cut->count++] = *c;
}

/* Returns the vertex where an edge leaves the closed mesh, by bisection. */
static struct mesh_vertex find_exit(const struct closed_mesh *closed_mesh,
                                    const struct mesh_vertex *inside,
                                    const struct mesh_vertex *outside)
{
    float in = 0.0F;
    float out = 1.0F;
    for (int i = 0; i < 20; i++) {
        float midpoint = (in + out) / 2.0F;
        vec3s p = glms_vec3_lerp(inside->position, outside->position, midpoint);
        if (closed_mesh_contains(closed_mesh, p))
            in = midpoint;
        else
            out = midpoint;
    }
    return between(inside, outside, in);
}

static void clip_to_surface(struct cut *cut, const struct mesh_vertex corner[3])
{
    struct mesh_vertex polygon[4]; /* clipped polygon */
    int count = 0;
    for (int k = 0; k < 3; k++) {
        const struct mesh_vertex *a = &corner[k];
        const struct mesh_vertex *b = &corner[(k + 1) % 3];
        bool a_inside = closed_mesh_contains(cut->closed_mesh, a->position);
        bool b_inside = closed_mesh_contains(cut->closed_mesh, b->position);
        if (a_inside)
            polygon[count++] = *a;
        if (a_inside != b_inside)
            polygon[count++] =
                a_inside ? find_exit(cut->closed_mesh, a, b) : find_exit(cut->closed_mesh, b, a);
    }
    if (count >= 3)
        emit(cut, &polygon[0], &polygon[1], &polygon[2]);
    if (count == 4)
        emit(cut, &polygon[0], &polygon[2], &polygon[3]);
}

static struct box box_of(const struct mesh_vertex corner[3])
{
    struct box box = { corner[0].position, corner[0].position };
    for (int k = 1; k < 3; k++) {
        box.min = glms_vec3_minv(box.min, corner[k].position);
        box.max = glms_vec3_maxv(box.max, corner[k].position);
    }
    return box;
}

/* Bisects a triangle at its longest side, recursively. Adjacent triangles bisect their common side
 * at one point, which avoids cracks. */
static void bisect(struct cut *cut, const struct mesh_vertex corner[3])
{
    int longest = 0;
    float length = 0.0F;
    for (int k = 0; k < 3; k++) {
        float side = glms_vec3_distance(corner[k].position, corner[(k + 1) % 3].position);
        longest = side > length ? k : longest;
        length = fmaxf(side, length);
    }
    if (!closed_mesh_may_overlap(cut->closed_mesh, box_of(corner))) {
        if (closed_mesh_contains(cut->closed_mesh, corner[0].position))
            emit(cut, &corner[0], &corner[1], &corner[2]);
        return;
    }
    const struct mesh_vertex *a = &corner[longest];
    const struct mesh_vertex *b = &corner[(longest + 1) % 3];
    const struct mesh_vertex *c = &corner[(longest + 2) % 3];
    const struct mesh_vertex midpoint = between(a, b, 0.5F);
    float half = fmaxf(glms_vec3_distance(midpoint.position, a->position),
                       glms_vec3_distance(midpoint.position, b->position));
    /* second condition: float precision is exhausted */
    if (length <= cut->step || !(half < 0.75F * length)) {
        clip_to_surface(cut, corner);
        return;
    }
    bisect(cut, (const struct mesh_vertex[]){ *a, midpoint, *c });
    bisect(cut, (const struct mesh_vertex[]){ midpoint, *b, *c });
}

bool closed_mesh_clip(const struct closed_mesh *closed_mesh, struct mesh *sheet, float step)
{
    struct cut cut = { .closed_mesh = closed_mesh, .step = step };
    struct mesh mesh = { 0 };
    for (uint32_t i = 0; i + 2 < sheet->index_count && !cut.failed; i += 3) {
        struct mesh_vertex corner[3];
        for (uint32_t k = 0; k < 3; k++)
            corner[k] = sheet->vertices[sheet->indices[i + k]];
        bisect(&cut, corner);
    }
    bool done = !cut.failed && mesh_init(&mesh, cut.count, cut.count);
    for (uint32_t i = 0; i < cut.count && done; i++) {
        mesh.vertices[i] = cut.vertices[i];
        mesh.indices[i] = i;
    }
    free(cut.vertices);
    if (done) {
        mesh_finish(sheet);
        *sheet = mesh;
    }
    return done;
}
