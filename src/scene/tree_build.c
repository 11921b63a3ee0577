/* tree_build.c: splits sets of triangles where that makes rays cheapest, on several threads. */
#include "src/scene/tree_build.h"
#include <float.h>
#include <math.h>
#include <pthread.h>
#include <stdbool.h>

enum {
    PARALLEL_MIN = 1 << 13, /* triangles of a part that is worth a thread */
};

static struct tree_box nowhere(void)
{
    return (struct tree_box){ { FLT_MAX, FLT_MAX, FLT_MAX }, { -FLT_MAX, -FLT_MAX, -FLT_MAX } };
}

static void enclose(struct tree_box *a, const struct tree_box *b)
{
    for (int k = 0; k < 3; k++) {
        a->low[k] = a->low[k] < b->low[k] ? a->low[k] : b->low[k];
        a->high[k] = a->high[k] > b->high[k] ? a->high[k] : b->high[k];
    }
}

/* Returns half of the surface of a box; of an empty one 0. */
static float area_of(const struct tree_box *b)
{
    const float x = b->high[0] - b->low[0], y = b->high[1] - b->low[1], z = b->high[2] - b->low[2];
    return x < 0.0f ? 0.0f : x * y + y * z + z * x;
}

static float middle(const struct tree_box *b, int axis)
{
    return 0.5f * b->low[axis] + 0.5f * b->high[axis];
}

struct bin {
    struct tree_box box;
    uint32_t count;
};

/* Triangles by their middles, along each axis. */
struct bins {
    float low[3], scale[3]; /* scale 0: all middles are the same */
    struct bin all[3][TREE_BIN_COUNT];
};

struct cut {
    float cost;
    int axis; /* below 0: none */
    uint32_t bin;
};

static uint32_t bin_of(const struct bins *bins, const struct tree_box *box, int axis)
{
    const uint32_t bin = (uint32_t)((middle(box, axis) - bins->low[axis]) * bins->scale[axis]);
    return bin < TREE_BIN_COUNT ? bin : TREE_BIN_COUNT - 1;
}

static void fill_bins(struct bins *bins, const struct tree_draft *draft,
                      const struct tree_node *node)
{
    struct tree_box middles = nowhere();
    for (uint32_t i = node->first; i < node->first + node->count; i++) {
        const struct tree_box *box = &draft->boxes[draft->order[i]];
        const struct tree_box at = { { middle(box, 0), middle(box, 1), middle(box, 2) },
                                     { middle(box, 0), middle(box, 1), middle(box, 2) } };
        enclose(&middles, &at);
    }
    for (int axis = 0; axis < 3; axis++) {
        const float extent = middles.high[axis] - middles.low[axis];
        bins->low[axis] = middles.low[axis];
        bins->scale[axis] =
            extent > FLT_MIN * TREE_BIN_COUNT ? (float)TREE_BIN_COUNT / extent : 0.0f;
        for (int i = 0; i < TREE_BIN_COUNT; i++)
            bins->all[axis][i] = (struct bin){ nowhere(), 0 };
    }
    for (uint32_t i = node->first; i < node->first + node->count; i++) {
        const struct tree_box *box = &draft->boxes[draft->order[i]];
        for (int axis = 0; axis < 3; axis++) {
            struct bin *bin = &bins->all[axis][bin_of(bins, box, axis)];
            enclose(&bin->box, box);
            bin->count++;
        }
    }
}

/* Replaces *best by the cheapest cut between two bins of an axis, if that is cheaper. */
static void try_axis(struct cut *best, const struct bins *bins, int axis)
{
    const struct bin *bin = bins->all[axis];
    float right[TREE_BIN_COUNT];
    struct tree_box box = nowhere();
    uint32_t count = 0;
    for (uint32_t i = TREE_BIN_COUNT - 1; i > 0; i--) {
        enclose(&box, &bin[i].box);
        count += bin[i].count;
        right[i] = count ? area_of(&box) * (float)count : FLT_MAX;
    }
    box = nowhere();
    count = 0;
    for (uint32_t i = 1; i < TREE_BIN_COUNT; i++) {
        enclose(&box, &bin[i - 1].box);
        count += bin[i - 1].count;
        const float cost = area_of(&box) * (float)count + right[i];
        if (count && cost < best->cost)
            *best = (struct cut){ cost, axis, i };
    }
}

/* Brings the triangles before a cut to the front, and returns their number. */
static uint32_t part(struct tree_draft *draft, const struct tree_node *node,
                     const struct bins *bins, const struct cut *cut)
{
    uint32_t i = node->first, end = node->first + node->count;
    while (i < end) {
        const uint32_t triangle = draft->order[i];
        if (bin_of(bins, &draft->boxes[triangle], cut->axis) < cut->bin) {
            i++;
        } else {
            draft->order[i] = draft->order[--end];
            draft->order[end] = triangle;
        }
    }
    return i - node->first;
}

uint32_t tree_levels(uint32_t count, uint32_t leaf_max)
{
    uint32_t needed = 0;
    while (count > leaf_max) {
        count = (count + 1) / 2;
        needed++;
    }
    return needed;
}

/* Whether halves of so many triangles have leaves within the depth that is left. */
static bool has_room(const struct tree_draft *draft, uint32_t count, uint32_t left)
{
    return tree_levels(count, draft->leaf_max) + 1 < left;
}

/* Parts a node's triangles; returns how many the first child has, 0: it is a leaf. */
static uint32_t split(struct tree_draft *draft, const struct tree_node *node, uint32_t left)
{
    struct bins bins;
    const bool may_end = node->count <= draft->leaf_max;
    const float area = area_of(&node->box);
    struct cut cut = { may_end ? ((float)node->count - TREE_NODE_COST) * area : FLT_MAX, -1, 0 };
    if (node->count < 2)
        return 0;
    if (has_room(draft, node->count, left)) {
        fill_bins(&bins, draft, node);
        for (int axis = 0; axis < 3; axis++) {
            if (bins.scale[axis] > 0.0f)
                try_axis(&cut, &bins, axis);
        }
    }
    if (cut.axis < 0)
        return may_end ? 0 : node->count / 2;
    return part(draft, node, &bins, &cut);
}

/* A node to grow, and its descendants. */
struct branch {
    struct tree_draft *draft;
    uint32_t at, first, count;
    uint32_t left;  /* nodes that a way from here may still have */
    uint32_t forks; /* how often it may be parted between two threads */
};

static void *grow(void *user)
{
    const struct branch *branch = user;
    struct tree_draft *draft = branch->draft;
    struct tree_node *node = &draft->nodes[branch->at];
    pthread_t thread;
    *node = (struct tree_node){ nowhere(), branch->first, branch->count, { 0, 0 } };
    for (uint32_t i = node->first; i < node->first + node->count; i++)
        enclose(&node->box, &draft->boxes[draft->order[i]]);
    const uint32_t count = split(draft, node, branch->left);
    if (!count)
        return NULL;
    const uint32_t rest = node->count - count;
    const uint32_t forks = branch->forks ? branch->forks - 1 : 0;
    node->children[0] = branch->at + 1;
    node->children[1] = branch->at + 2 * count;
    struct branch a = { draft, node->children[0], node->first, count, branch->left - 1, forks };
    struct branch b = {
        draft, node->children[1], node->first + count, rest, branch->left - 1, forks
    };
    const bool is_beside = branch->forks && count >= PARALLEL_MIN && rest >= PARALLEL_MIN &&
                           !pthread_create(&thread, NULL, grow, &a);
    (void)grow(&b);
    if (is_beside)
        pthread_join(thread, NULL);
    else
        (void)grow(&a);
    return NULL;
}

void tree_build(struct tree_draft *draft, const struct tree_range *range, uint32_t left,
                uint32_t threads)
{
    /* Halves are rarely equal, so there are more of them than threads. */
    const uint32_t forks = threads < 2 ? 0 : threads < 4 ? 3 : 5;
    struct branch all = { draft, range->root, range->first, range->count, left, forks };
    (void)grow(&all);
}

void tree_refit(struct tree_draft *draft, uint32_t at)
{
    struct tree_node *node = &draft->nodes[at];
    node->box = nowhere();
    for (uint32_t i = 0; !node->children[0] && i < node->count; i++)
        enclose(&node->box, &draft->boxes[draft->order[node->first + i]]);
    for (uint32_t i = 0; node->children[0] && i < 2; i++) {
        tree_refit(draft, node->children[i]);
        enclose(&node->box, &draft->nodes[node->children[i]].box);
    }
}

static double sum_cost(const struct tree_draft *draft, uint32_t at)
{
    const struct tree_node *node = &draft->nodes[at];
    const double area = (double)area_of(&node->box);
    if (!node->children[0])
        return area * (double)node->count;
    return area * (double)TREE_NODE_COST + sum_cost(draft, node->children[0]) +
           sum_cost(draft, node->children[1]);
}

double tree_cost(const struct tree_draft *draft, uint32_t at)
{
    const double area = (double)area_of(&draft->nodes[at].box);
    return area > 0.0 ? sum_cost(draft, at) / area : 0.0;
}
