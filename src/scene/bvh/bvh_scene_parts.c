/* bvh_scene_parts.c: triangle lists of scene parts, and tests for overlap and for closed meshes. */
#include "src/scene/bvh/bvh_scene_parts.h"
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static uint32_t triangle_count(const struct bvh_part *part)
{
    return part->mesh ? part->mesh->index_count / 3 : 0;
}

const struct bubble *bvh_bubble(const struct bvh_part *part, uint32_t triangle)
{
    const uint32_t count = triangle_count(part);
    return triangle < count || !part->bubbles ? NULL : &part->bubbles->all[triangle - count];
}

const struct mesh_vertex *bvh_corner(const struct bvh_part *part, uint32_t triangle, uint32_t k)
{
    return &part->mesh->vertices[part->mesh->indices[(size_t)triangle * 3 + k]];
}

struct bvh_box bvh_triangle_box(const struct bvh_part *part, uint32_t triangle)
{
    struct bvh_box box;
    const struct bubble *bubble = bvh_bubble(part, triangle);
    const struct box around = bubble ? bubble_box(bubble) : (struct box){ 0 };
    for (int k = 0; k < 3 && bubble; k++) {
        const float room = 1e-4f * (around.max.raw[k] - around.min.raw[k]);
        box.low[k] = around.min.raw[k] - room;
        box.high[k] = around.max.raw[k] + room;
    }
    for (int k = 0; k < 3 && !bubble; k++) {
        const float a = bvh_corner(part, triangle, 0)->position.raw[k];
        const float b = bvh_corner(part, triangle, 1)->position.raw[k];
        const float c = bvh_corner(part, triangle, 2)->position.raw[k];
        box.low[k] = fminf(a, fminf(b, c));
        box.high[k] = fmaxf(a, fmaxf(b, c));
    }
    return box;
}

/* Returns the mesh's triangle indices in model file order, or NULL when out of memory. */
static uint32_t *inverse_order(const struct bvh_part *part, const struct mesh_order *sorted)
{
    const uint32_t count = triangle_count(part) + (part->bubbles ? part->bubbles->count : 0);
    uint32_t *inverse = calloc(count + (size_t)1, sizeof(*inverse));
    for (uint32_t i = 0; inverse && i < count; i++)
        inverse[i] = i;
    for (uint32_t i = 0; inverse && sorted && i < sorted->count; i++)
        inverse[sorted->all[i]] = i;
    return inverse;
}

/* Returns the index of a triangle's object, or 0 for inclusions and scenes without objects. */
static uint32_t owner_of(const struct bvh_part *part, uint32_t triangle)
{
    const struct model *model = part->model;
    if (part->is_inclusion)
        return 0;
    if (!part->is_object)
        return model_surroundings_find_object(model, part->mesh->indices[(size_t)triangle * 3]);
    if (!model->object_count)
        return 0;
    return (uint32_t)(object_of_index(model->objects, model->object_count, triangle * 3) -
                      model->objects);
}

/* Starts a new group of triangles wherever the owning object changes. */
static bool list_groups(struct bvh_part *part, bool by_objects)
{
    uint32_t last = 0;
    part->firsts = malloc((part->count + (size_t)2) * sizeof(*part->firsts));
    for (uint32_t i = 0; part->firsts && i < part->count; i++) {
        const uint32_t owner = by_objects ? owner_of(part, part->triangles[i]) : 0;
        if (i == 0 || owner != last)
            part->firsts[part->group_count++] = i;
        last = owner;
    }
    if (part->firsts)
        part->firsts[part->group_count] = part->count;
    return part->firsts;
}

static bool list_triangles(struct bvh_part *part, const struct mesh_order *sorted, bool moves)
{
    const uint32_t count = triangle_count(part) + (part->bubbles ? part->bubbles->count : 0);
    part->triangles = inverse_order(part, sorted);
    for (uint32_t i = 0; part->triangles && i < count; i++) {
        const uint32_t at = part->triangles[i];
        const bool is_mover = !part->is_object && !part->is_inclusion &&
                              bvh_corner(part, at, 0)->material & MESH_ORBITS;
        if (is_mover == moves)
            part->triangles[part->count++] = at;
    }
    return part->triangles;
}

bool bvh_parts_init(struct bvh_part parts[static BVH_COUNT], const struct bvh_params *params,
                    bool by_objects)
{
    const struct model *model = params->model;
    const struct bvh_part all[BVH_COUNT] = {
        [BVH_OBJECTS] = { .model = model,
                          .mesh = &model->object,
                          .contacts = params->contacts,
                          .is_object = true },
        [BVH_SURROUNDINGS] = { .model = model, .mesh = &model->surroundings },
        [BVH_MOVERS] = { .model = model, .mesh = &model->surroundings },
        [BVH_INCLUSIONS] = { .model = model,
                             .mesh = params->cracks,
                             .bubbles = params->bubbles,
                             .is_inclusion = true },
    };
    bool done = true;
    memcpy(parts, all, sizeof(all));
    for (uint32_t i = 0; i < BVH_COUNT && done; i++) {
        const bool is_surroundings = i == BVH_SURROUNDINGS || i == BVH_MOVERS;
        done =
            list_triangles(&parts[i], is_surroundings ? &params->sorted : NULL, i == BVH_MOVERS) &&
            list_groups(&parts[i], by_objects);
    }
    return done;
}

void bvh_parts_finish(struct bvh_part parts[static BVH_COUNT])
{
    for (int i = 0; i < BVH_COUNT; i++) {
        free(parts[i].triangles);
        free(parts[i].firsts);
    }
}

static struct bvh_box box_of(const struct bvh_part *part)
{
    struct bvh_box box = { { FLT_MAX, FLT_MAX, FLT_MAX }, { -FLT_MAX, -FLT_MAX, -FLT_MAX } };
    for (uint32_t i = 0; i < part->count; i++) {
        const struct bvh_box triangle_box = bvh_triangle_box(part, part->triangles[i]);
        for (int k = 0; k < 3; k++) {
            box.low[k] = fminf(box.low[k], triangle_box.low[k]);
            box.high[k] = fmaxf(box.high[k], triangle_box.high[k]);
        }
    }
    return box;
}

static bool surroundings_are_apart(const struct bvh_part *part, const struct bvh_box *box)
{
    for (uint32_t i = 0; i < part->count; i++) {
        const struct bvh_box triangle_box = bvh_triangle_box(part, part->triangles[i]);
        bool overlaps = true;
        for (int k = 0; k < 3; k++)
            overlaps = overlaps && triangle_box.low[k] <= box->high[k] &&
                       triangle_box.high[k] >= box->low[k];
        if (overlaps)
            return false;
    }
    return true;
}

/* Extends a box so that it contains its rotations by any angle about its vertical axis. */
static void extend_to_rotations(struct bvh_box *box)
{
    const float x = 0.5f * (box->high[0] - box->low[0]), z = 0.5f * (box->high[2] - box->low[2]);
    const float radius = 1.001f * hypotf(x, z); /* margin for rounding */
    for (int k = 0; k < 3; k += 2) {
        const float middle = 0.5f * (box->low[k] + box->high[k]);
        box->low[k] = middle - radius;
        box->high[k] = middle + radius;
    }
}

bool bvh_parts_are_disjoint(const struct bvh_part parts[static BVH_COUNT], bool rotates)
{
    struct bvh_box box = box_of(&parts[BVH_OBJECTS]);
    if (rotates && parts[BVH_OBJECTS].count)
        extend_to_rotations(&box);
    return surroundings_are_apart(&parts[BVH_SURROUNDINGS], &box) &&
           surroundings_are_apart(&parts[BVH_MOVERS], &box) &&
           !(rotates && parts[BVH_MOVERS].count);
}

/* Returns a hash of the edge from `a` to `b`. Coordinates 0 and -0 are treated as equal. */
static uint64_t edge_hash(const float *a, const float *b)
{
    uint64_t hash = 0x9e3779b97f4a7c15u;
    for (int k = 0; k < 6; k++) {
        const float x = (k < 3 ? a[k] : b[k - 3]) + 0.0f;
        uint32_t bits;
        memcpy(&bits, &x, sizeof(bits));
        hash = (hash ^ bits) * 0xff51afd7ed558ccdu;
        hash ^= hash >> 29;
    }
    return hash * 0xc4ceb9fe1a85ec53u ^ hash >> 32;
}

/* Sums hashes in which an edge and its opposite edge cancel. The sum is 0 for a closed mesh. */
bool bvh_part_is_closed(const struct bvh_part *part)
{
    uint64_t sum = 0;
    for (uint32_t i = 0; i < triangle_count(part); i++) {
        for (uint32_t k = 0; k < 3; k++) {
            const float *a = bvh_corner(part, i, k)->position.raw;
            const float *b = bvh_corner(part, i, (k + 1) % 3)->position.raw;
            sum += edge_hash(a, b) - edge_hash(b, a);
        }
    }
    return sum == 0;
}
