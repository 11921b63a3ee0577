/* model_doubled_faces.c: drops the back faces of refractive objects that are modelled twice, once
 * with each winding, to be seen from both sides. Such a shell bounds no volume. */
#include <cglm/struct.h>
#include <math.h>
#include <meshoptimizer.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/scene/import/importer.h"

/* Net volume of an object's triangles, as a fraction of the sum of their absolute volumes, above
 * which not all faces are doubled. */
static const double balanced = 1e-3;

/* Triangle by its welded corners, in ascending order. */
struct face {
    uint32_t points[3];
    uint32_t triangle;
    bool is_odd; /* the winding is that of an odd permutation of `points` */
};

static int compare_faces(const void *left, const void *right)
{
    const struct face *a = left, *b = right;
    for (int k = 0; k < 3; k++) {
        if (a->points[k] != b->points[k])
            return a->points[k] < b->points[k] ? -1 : 1;
    }
    return (a->triangle > b->triangle) - (a->triangle < b->triangle);
}

static struct face face_of(const uint32_t *corners, const uint32_t *points, uint32_t triangle)
{
    struct face face = { .triangle = triangle };
    for (int k = 0; k < 3; k++)
        face.points[k] = points[corners[k]];
    for (int k = 0; k < 3; k++) {
        const int a = k == 1 ? 1 : 0; /* compares 0 and 1, 1 and 2, 0 and 1 */
        if (face.points[a] <= face.points[a + 1])
            continue;
        const uint32_t lower = face.points[a + 1];
        face.points[a + 1] = face.points[a];
        face.points[a] = lower;
        face.is_odd = !face.is_odd;
    }
    return face;
}

/* Returns true if the volumes of an object's triangles cancel out. */
static bool may_be_doubled(const struct mesh *mesh, const struct object *object)
{
    const uint32_t *corners = &mesh->indices[object->first_index];
    double sum = 0, all = 0;
    for (uint32_t i = 0; i < object->index_count; i += 3) {
        vec3s sides[3];
        for (uint32_t k = 0; k < 3; k++)
            sides[k] = glms_vec3_sub(mesh->vertices[corners[i + k]].position,
                                     mesh->vertices[corners[0]].position);
        const double volume = (double)glms_vec3_dot(sides[0], glms_vec3_cross(sides[1], sides[2]));
        sum += volume;
        all += fabs(volume);
    }
    return fabs(sum) <= balanced * all;
}

/* Marks the triangles to drop in `is_dropped`. Returns false unless each face of nonzero area
 * occurs equally often with both windings. */
static bool mark_doubles(struct face *faces, uint32_t count, bool *is_dropped)
{
    uint32_t doubled = 0;
    qsort(faces, count, sizeof(*faces), compare_faces);
    for (uint32_t first = 0, end; first < count; first = end) {
        const uint32_t *points = faces[first].points;
        int64_t balance = 0;
        for (end = first;
             end < count && memcmp(faces[end].points, points, sizeof(faces->points)) == 0; end++)
            balance += faces[end].is_odd ? 1 : -1;
        if (points[0] == points[1] || points[1] == points[2])
            continue;
        if (balance != 0)
            return false;
        for (uint32_t i = first + 1; i < end; i++)
            is_dropped[faces[i].triangle] = true;
        doubled++;
    }
    return doubled > 0;
}

/* Moves the triangles of an object to `end`, without doubled ones. Returns false when out of
 * memory. */
static bool compact(struct model *model, struct object *object, const uint32_t *points,
                    uint32_t end, uint32_t *dropped)
{
    uint32_t *indices = &model->object.indices[object->first_index],
             *to = &model->object.indices[end];
    const uint32_t count = object->index_count / 3;
    struct face *faces = NULL;
    bool *is_dropped = NULL;
    if (may_be_doubled(&model->object, object)) {
        faces = malloc((count + (size_t)1) * sizeof(*faces));
        is_dropped = calloc(count + (size_t)1, sizeof(*is_dropped));
        for (uint32_t i = 0; faces && i < count; i++)
            faces[i] = face_of(&indices[(size_t)3 * i], points, i);
        if (!faces || !is_dropped) {
            free(faces);
            free(is_dropped);
            return false;
        }
    }
    const bool is_doubled = faces && mark_doubles(faces, count, is_dropped);
    object->first_index = end;
    object->index_count = 0;
    for (size_t i = 0; i < count; i++) {
        if (is_doubled && is_dropped[i])
            continue;
        memmove(&to[object->index_count], &indices[3 * i], 3 * sizeof(*indices));
        object->index_count += 3;
    }
    *dropped += count - object->index_count / 3;
    free(faces);
    free(is_dropped);
    return true;
}

bool model_drop_doubled_faces(struct model *model, uint32_t *dropped)
{
    struct mesh *mesh = &model->object;
    uint32_t *points = malloc((mesh->vertex_count + (size_t)1) * sizeof(*points));
    uint32_t end = 0;
    bool done = points;
    if (done && mesh->index_count > 0)
        (void)meshopt_generateVertexRemapMulti(
            points, mesh->indices, mesh->index_count, mesh->vertex_count,
            &(struct meshopt_Stream){ mesh->vertices, sizeof(vec3s), sizeof(*mesh->vertices) }, 1);
    for (uint32_t i = 0; done && i < model->object_count; i++) {
        done = compact(model, &model->objects[i], points, end, dropped);
        end += model->objects[i].index_count;
    }
    if (done && model->object_count > 0)
        mesh->index_count = end;
    free(points);
    return done;
}
