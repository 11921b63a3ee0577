/* bvh_enclosing_objects.c: lists of the objects that enclose a point, for nested dielectrics. */
#include "src/scene/bvh/bvh.h"

enum {
    CROSSINGS_MAX = 4096, /* maximum hits of the inside-test ray */
    HALF = 16,            /* bits per rank (medium priority) */
};

uint32_t bvh_medium(const struct bvh *bvh, uint32_t rank)
{
    return bvh->media ? bvh->corners.all[bvh->media + rank][0] : rank;
}

static uint32_t rank_at(const struct bvh_interior_list *list, uint32_t i)
{
    return list->words[i / 2] >> (i % 2 * HALF) & 0xffff;
}

static void set_rank(struct bvh_interior_list *list, uint32_t i, uint32_t rank)
{
    list->words[i / 2] &= ~(0xffffu << (i % 2 * HALF));
    list->words[i / 2] |= rank << (i % 2 * HALF);
}

void bvh_interior_list_insert(struct bvh_interior_list *list, const struct bvh *bvh, uint32_t rank)
{
    if (bvh->object_count <= BVH_MASK_OBJECTS_MAX) {
        list->words[0] |= 1u << (rank - 1);
        return;
    }
    for (uint32_t i = 0; i < BVH_INTERIOR_LIST_MAX; i++) {
        const uint32_t found = rank_at(list, i);
        if (found == rank)
            return;
        if (found > rank)
            continue;
        set_rank(list, i, rank);
        rank = found;
    }
}

void bvh_interior_list_remove(struct bvh_interior_list *list, const struct bvh *bvh, uint32_t rank)
{
    if (bvh->object_count <= BVH_MASK_OBJECTS_MAX) {
        list->words[0] &= ~(1u << (rank - 1));
        return;
    }
    uint32_t count = 0;
    for (uint32_t i = 0; i < BVH_INTERIOR_LIST_MAX; i++) {
        const uint32_t found = rank_at(list, i);
        if (found != rank)
            set_rank(list, count++, found);
    }
    if (count < BVH_INTERIOR_LIST_MAX)
        set_rank(list, count, 0);
}

bool bvh_interior_list_contains(const struct bvh_interior_list *list, const struct bvh *bvh,
                                uint32_t rank)
{
    if (bvh->object_count <= BVH_MASK_OBJECTS_MAX)
        return list->words[0] >> (rank - 1) & 1;
    for (uint32_t i = 0; i < BVH_INTERIOR_LIST_MAX; i++) {
        if (rank_at(list, i) == rank)
            return true;
    }
    return false;
}

struct bvh_interior_list bvh_interior_list_at(const struct bvh *bvh, vec3s point)
{
    struct bvh_ray ray = { point, { { 0.36f, 0.8f, 0.48f } }, 0.0, BVH_NONE };
    struct bvh_hit hit;
    struct bvh_interior_list entered = { 0 }, inside = { 0 };
    for (int i = 0; i < CROSSINGS_MAX && bvh_intersect(bvh, BVH_OBJECTS, &ray, &hit); i++) {
        if (!hit.is_back)
            bvh_interior_list_insert(&entered, bvh, hit.rank);
        else if (!bvh_interior_list_contains(&entered, bvh, hit.rank))
            bvh_interior_list_insert(&inside, bvh, hit.rank);
        else
            bvh_interior_list_remove(&entered, bvh, hit.rank);
        ray.near = hit.t;
        ray.from = hit.triangle;
    }
    return inside;
}
