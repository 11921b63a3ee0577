/* tree_shells.c: sets of enclosing objects (interior lists of nested dielectrics). */
#include "src/scene/tree.h"

enum {
    CROSSINGS_MAX = 4096, /* maximum hits of the ray that finds enclosing objects */
    HALF = 16,            /* bits per rank; a 32-bit word holds two */
};

uint32_t tree_medium(const struct tree *tree, uint32_t rank)
{
    return tree->media ? tree->corners.all[tree->media + rank][0] : rank;
}

static uint32_t rank_at(const struct tree_shells *shells, uint32_t i)
{
    return shells->words[i / 2] >> (i % 2 * HALF) & 0xffff;
}

static void set_rank(struct tree_shells *shells, uint32_t i, uint32_t rank)
{
    shells->words[i / 2] &= ~(0xffffu << (i % 2 * HALF));
    shells->words[i / 2] |= rank << (i % 2 * HALF);
}

void tree_shells_put(struct tree_shells *shells, const struct tree *tree, uint32_t rank)
{
    if (tree->shells <= TREE_SHELLS_FEW) {
        shells->words[0] |= 1u << (rank - 1);
        return;
    }
    for (uint32_t i = 0; i < TREE_NESTED_MAX; i++) {
        const uint32_t found = rank_at(shells, i);
        if (found == rank)
            return;
        if (found > rank)
            continue;
        set_rank(shells, i, rank);
        rank = found;
    }
}

void tree_shells_remove(struct tree_shells *shells, const struct tree *tree, uint32_t rank)
{
    if (tree->shells <= TREE_SHELLS_FEW) {
        shells->words[0] &= ~(1u << (rank - 1));
        return;
    }
    uint32_t kept = 0;
    for (uint32_t i = 0; i < TREE_NESTED_MAX; i++) {
        const uint32_t found = rank_at(shells, i);
        if (found != rank)
            set_rank(shells, kept++, found);
    }
    if (kept < TREE_NESTED_MAX)
        set_rank(shells, kept, 0);
}

bool tree_shells_has(const struct tree_shells *shells, const struct tree *tree, uint32_t rank)
{
    if (tree->shells <= TREE_SHELLS_FEW)
        return shells->words[0] >> (rank - 1) & 1;
    for (uint32_t i = 0; i < TREE_NESTED_MAX; i++) {
        if (rank_at(shells, i) == rank)
            return true;
    }
    return false;
}

struct tree_shells tree_immerse(const struct tree *tree, vec3s point)
{
    struct tree_ray ray = { point, { { 0.36f, 0.8f, 0.48f } }, 0.0, TREE_NOTHING };
    struct tree_hit hit;
    struct tree_shells entered = { 0 }, inside = { 0 };
    for (int i = 0; i < CROSSINGS_MAX && tree_meet(tree, TREE_OBJECTS, &ray, &hit); i++) {
        if (!hit.is_back)
            tree_shells_put(&entered, tree, hit.rank);
        else if (!tree_shells_has(&entered, tree, hit.rank))
            tree_shells_put(&inside, tree, hit.rank);
        else
            tree_shells_remove(&entered, tree, hit.rank);
        ray.near = hit.t;
        ray.from = hit.triangle;
    }
    return inside;
}
