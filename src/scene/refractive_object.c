/* refractive_object.c: ranks (medium priorities) of overlapping objects, and inside tests. Where
 * objects overlap, the medium of the object with the highest rank fills the overlap (Schmidt and
 * Budge 2002, Simple nested dielectrics in ray traced images). */
#include "src/scene/refractive_object.h"
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/scene/geometry/point_in_mesh.h"

/* Object during ranking. */
struct ranked {
    uint32_t object;
    int64_t priority;        /* priority from the file; INT64_MIN if the file has none */
    uint32_t depth;          /* number of enclosing objects */
    uint32_t container_rank; /* 1 + index of innermost enclosing object; 0 for none */
    /* 1 + index of the innermost object around this one (cavities count as inside); 0 for none */
    uint32_t enclosing_object;
};

struct mesh object_mesh(const struct object *object, const struct mesh *mesh)
{
    return (struct mesh){
        .vertices = mesh->vertices,
        .indices = &mesh->indices[object->first_index],
        .vertex_count = mesh->vertex_count,
        .index_count = object->index_count,
    };
}

struct box object_box(const struct object *object, const struct mesh *mesh)
{
    const struct mesh part = object_mesh(object, mesh);
    struct box box = { 0 };
    for (uint32_t i = 0; i < part.index_count; i++) {
        const vec3s p = part.vertices[part.indices[i]].position;
        box.min = i ? glms_vec3_minv(box.min, p) : p;
        box.max = i ? glms_vec3_maxv(box.max, p) : p;
    }
    return box;
}

bool object_boxes_init(struct box_tree *tree, const struct object *objects, uint32_t count)
{
    struct box *boxes = malloc((count + (size_t)1) * sizeof(*boxes));
    for (uint32_t i = 0; boxes && i < count; i++)
        boxes[i] = objects[i].box;
    const bool done = boxes && box_tree_init(tree, boxes, count);
    free(boxes);
    return done;
}

/* Maximum cost of the point-in-mesh tests of object_assign_ranks(), in triangles. For objects that
 * overlap densely, such as thousands of copies in one place, the cost is at least quadratic in
 * their number. */
#define COST_MAX (3u << 23)

/* Cost of a pair of overlapping boxes. In scenes of 2 000 to 60 000 objects, a pair takes 80 ns and
 * a triangle 9 to 27 ns. */
#define BOX_COST 8

/* Search for the objects that one object encloses. */
struct enclosure {
    struct ranked *ranking;
    const struct object *objects;
    const struct mesh *mesh;
    struct closed_mesh container; /* empty until the first candidate */
    uint32_t index;               /* of the enclosing object */
    uint64_t cost;                /* total cost of all searches */
    uint32_t *tested_by; /* per vertex: number of the last surrounds_all() call that tested it */
    uint32_t call_count; /* number of surrounds_all() calls */
    bool is_out_of_memory;
};

/* Returns true if the container surrounds all corners of `part`, and sets *is_contained to whether
 * it contains them. Ends early and returns false when the cost reaches COST_MAX. */
static bool surrounds_all(struct enclosure *enclosure, const struct mesh *part, bool *is_contained)
{
    const struct closed_mesh *container = &enclosure->container;
    const uint32_t call = ++enclosure->call_count;
    *is_contained = true;
    for (uint32_t i = 0; i < part->index_count && enclosure->cost < COST_MAX; i++) {
        const uint32_t v = part->indices[i];
        const vec3s point = part->vertices[v].position;
        enclosure->cost++;
        if (enclosure->tested_by[v] == call)
            continue;
        enclosure->tested_by[v] = call;
        enclosure->cost += closed_mesh_cost(container, point);
        if (!closed_mesh_surrounds(container, point))
            return false;
        *is_contained = *is_contained && closed_mesh_contains(container, point);
    }
    return enclosure->cost < COST_MAX;
}

/* Sets *innermost to `k` + 1 if object `k` is the smallest enclosing object so far. Of objects of
 * the same size, the last one in the file counts. */
static void update_innermost(const struct object *objects, uint32_t k, uint32_t *innermost)
{
    const float size = box_diagonal(objects[k].box);
    const float least = *innermost ? box_diagonal(objects[*innermost - 1].box) : INFINITY;
    if (size < least || (size <= least && k + 1 > *innermost))
        *innermost = k + 1;
}

/* Records whether the container encloses object `i`. Returns false to end the search. */
static bool visit_candidate(void *user, uint32_t i)
{
    struct enclosure *enclosure = user;
    const struct object *objects = enclosure->objects;
    const uint32_t k = enclosure->index;
    enclosure->cost += BOX_COST;
    if (i == k || !box_contains(&objects[k].box, &objects[i].box))
        return enclosure->cost < COST_MAX;
    const struct mesh container = object_mesh(&objects[k], enclosure->mesh);
    if (!enclosure->container.first && !closed_mesh_init(&enclosure->container, &container)) {
        enclosure->is_out_of_memory = true;
        return false;
    }
    const struct mesh part = object_mesh(&objects[i], enclosure->mesh);
    enclosure->container.mesh = &container;
    bool is_contained;
    if (surrounds_all(enclosure, &part, &is_contained)) {
        update_innermost(objects, k, &enclosure->ranking[i].enclosing_object);
        if (is_contained) {
            enclosure->ranking[i].depth++;
            update_innermost(objects, k, &enclosure->ranking[i].container_rank);
        }
    }
    return enclosure->cost < COST_MAX;
}

/* Records which objects enclose which. Returns false when out of memory. */
static bool record_enclosed(struct ranked *ranking, const struct object *objects, uint32_t count,
                            const struct mesh *mesh)
{
    struct enclosure enclosure = { .ranking = ranking, .objects = objects, .mesh = mesh };
    struct box_tree tree;
    if (!object_boxes_init(&tree, objects, count))
        return false;
    enclosure.tested_by = calloc(mesh->vertex_count + (size_t)1, sizeof(*enclosure.tested_by));
    enclosure.is_out_of_memory = !enclosure.tested_by;
    /* consecutive objects in leaf order visit the same nodes, which are in the processor's cache */
    for (uint32_t i = 0; i < count && enclosure.cost < COST_MAX && enclosure.tested_by; i++) {
        enclosure.index = tree.bvh.order[i];
        box_tree_visit(&tree, &objects[enclosure.index].box, &enclosure, visit_candidate);
        closed_mesh_finish(&enclosure.container);
    }
    if (enclosure.cost >= COST_MAX)
        log_warning("objects overlap too densely to find out which are inside which; of "
                    "overlapping objects, the last one in the file applies");
    free(enclosure.tested_by);
    box_tree_finish(&tree);
    return !enclosure.is_out_of_memory;
}

static int by_priority(const void *a, const void *b)
{
    const struct ranked *x = a;
    const struct ranked *y = b;
    if (x->priority != y->priority)
        return x->priority < y->priority ? -1 : 1;
    if (x->depth != y->depth)
        return x->depth < y->depth ? -1 : 1;
    return x->object < y->object ? -1 : 1;
}

enum status object_assign_ranks(struct object *objects, uint32_t count, const struct mesh *mesh,
                                const struct material *materials)
{
    struct ranked *ranking = calloc(count + (size_t)1, sizeof(*ranking));
    bool done = ranking != NULL;
    for (uint32_t i = 0; done && i < count; i++) {
        const struct material *material = &materials[objects[i].material];
        const bool is_stated = material->flags & MATERIAL_HAS_PRIORITY;
        ranking[i].object = i;
        ranking[i].priority = is_stated ? material->priority : INT64_MIN;
        objects[i].box = object_box(&objects[i], mesh);
    }
    if (done && count > 1)
        done = record_enclosed(ranking, objects, count, mesh);
    if (done) {
        qsort(ranking, count, sizeof(*ranking), by_priority);
        for (uint32_t i = 0; i < count; i++)
            objects[ranking[i].object].rank = i + 1;
        for (uint32_t i = 0; i < count; i++) {
            const uint32_t container_rank = ranking[i].container_rank;
            objects[ranking[i].object].container_rank =
                container_rank ? objects[container_rank - 1].rank : 0;
            objects[ranking[i].object].enclosing_object = ranking[i].enclosing_object;
        }
    }
    free(ranking);
    return done ? STATUS_OK : log_out_of_memory("objects");
}

uint32_t object_outermost(const struct object *objects, uint32_t index)
{
    while (objects[index].enclosing_object)
        index = objects[index].enclosing_object - 1;
    return index;
}

/* Returns the signed solid angle of a triangle seen from the origin, in steradians (van Oosterom
 * and Strackee 1983). If the triangle's back faces the origin, the angle is positive. */
static double solid_angle(vec3s a, vec3s b, vec3s c)
{
    const double x = (double)glms_vec3_norm(a), y = (double)glms_vec3_norm(b),
                 z = (double)glms_vec3_norm(c);
    const double volume = (double)glms_vec3_dot(a, glms_vec3_cross(b, c));
    const double base = x * y * z + (double)glms_vec3_dot(a, b) * z +
                        (double)glms_vec3_dot(b, c) * x + (double)glms_vec3_dot(c, a) * y;
    return 2.0 * atan2(volume, base);
}

bool object_contains(const struct object *object, const struct mesh *mesh, vec3s point)
{
    double sum = 0.0;
    for (uint32_t i = 0; i < object->index_count; i += 3) {
        vec3s to[3];
        for (int k = 0; k < 3; k++) {
            const uint32_t corner = mesh->indices[object->first_index + i + (uint32_t)k];
            to[k] = glms_vec3_sub(mesh->vertices[corner].position, point);
        }
        sum += solid_angle(to[0], to[1], to[2]);
    }
    return sum > 6.2831853; /* half the sphere tolerates small holes */
}

const struct object *object_of_index(const struct object *objects, uint32_t count, uint32_t index)
{
    uint32_t low = 0;
    uint32_t high = count;
    while (high - low > 1) {
        const uint32_t middle = low + (high - low) / 2;
        if (objects[middle].first_index <= index)
            low = middle;
        else
            high = middle;
    }
    return &objects[low];
}
