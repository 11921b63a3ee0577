/*
 * bvh_two_level.c: builds two-level BVHs, copies them between similar objects, and refits them.
 *
 * Each group of triangles (an object) has a BVH, and a top-level BVH joins their roots. Objects
 * that are copies of each other share one build: the topology is copied and refitted. A pose refits
 * the rest pose's topology, which costs O(n) instead of a build.
 */
#include "src/scene/bvh/bvh_two_level.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/scene/bvh/bvh_topology_cache.h"
#include "src/scene/geometry/fit_similarity.h"

enum {
    LEVELS_FREE = 4, /* extra depth of the top-level BVH */
    KNOWN_MAX = 64,  /* maximum number of recent groups to compare a new group with */
};

/* Group of triangles in file order. */
struct group {
    const struct bvh_part *part;
    uint32_t first, count;
};

static const float *position_of(const void *of, uint32_t corner)
{
    const struct group *group = of;
    const uint32_t triangle = group->part->triangles[group->first + corner / 3];
    return bvh_corner(group->part, triangle, corner % 3)->position.raw;
}

static struct similarity_transform_corners corners_of(const struct group *group)
{
    return (struct similarity_transform_corners){ group, position_of, 3 * group->count };
}

static struct similarity_transform_anchor find_anchor(const struct bvh_part *part, uint32_t first,
                                                      uint32_t count)
{
    const struct group group = { part, first, count };
    const struct similarity_transform_corners corners = corners_of(&group);
    return similarity_transform_anchor_find(&corners);
}

/* Returns true if `group` is a copy of `recent` under a similarity transform, within rounding. */
static bool is_similar(const struct group *recent, const struct similarity_transform_anchor *anchor,
                       const struct group *group)
{
    const struct similarity_transform_corners before = corners_of(recent),
                                              after = corners_of(group);
    struct similarity_transform motion;
    if (recent->count != group->count ||
        !similarity_transform_find(&motion, anchor, &before, &after))
        return false;
    for (uint32_t i = 0; i < after.count; i++) {
        const float *to = position_of(group, i);
        double room = 1e-4 * motion.length;
        for (int k = 0; k < 3; k++)
            room = fmax(room, 1e-6 * fabs((double)to[k]));
        if (!(similarity_transform_error(&motion, position_of(recent, i), to) <= room))
            return false;
    }
    return true;
}

static bool allocate(struct bvh_two_level *hierarchy, const struct bvh_part *part,
                     uint32_t group_count, uint32_t slot_count)
{
    *hierarchy = (struct bvh_two_level){
        .builder = { .boxes = malloc((part->count + (size_t)1) * sizeof(*hierarchy->builder.boxes)),
                     .order = malloc((part->count + (size_t)1) * sizeof(*hierarchy->builder.order)),
                     .nodes = malloc((slot_count + (size_t)1) * sizeof(*hierarchy->builder.nodes)),
                     .leaf_max = BVH_LEAF_MAX },
        .groups = malloc((group_count + (size_t)1) * sizeof(*hierarchy->groups)),
        .count = part->count,
        .group_count = group_count,
    };
    if (!hierarchy->builder.boxes || !hierarchy->builder.order || !hierarchy->builder.nodes ||
        !hierarchy->groups)
        return false;
    for (uint32_t i = 0; i < part->count; i++) {
        hierarchy->builder.boxes[i] = bvh_triangle_box(part, part->triangles[i]);
        hierarchy->builder.order[i] = i;
    }
    return true;
}

static void free_boxes(struct bvh_two_level *hierarchy)
{
    free(hierarchy->builder.boxes);
    hierarchy->builder.boxes = NULL;
}

void bvh_two_level_finish(struct bvh_two_level *hierarchy)
{
    free_boxes(hierarchy);
    free(hierarchy->builder.order);
    free(hierarchy->builder.nodes);
    free(hierarchy->groups);
    *hierarchy = (struct bvh_two_level){ 0 };
}

/* Copies the subtree at node `at` to the next free slots, and offsets its triangles by `shift`. */
static uint32_t copy_nodes(struct bvh_node *to, uint32_t *next, const struct bvh_node *from,
                           uint32_t at, uint32_t shift)
{
    const uint32_t copy = (*next)++;
    to[copy] = from[at];
    to[copy].first += shift;
    for (int i = 0; i < 2 && from[at].children[0]; i++)
        to[copy].children[i] = copy_nodes(to, next, from, from[at].children[i], shift);
    return copy;
}

/* Builds a BVH over the roots of the groups. */
static bool build_top_level(struct bvh_two_level *hierarchy)
{
    const uint32_t count = hierarchy->group_count;
    struct bvh_builder top = {
        .boxes = malloc((count + (size_t)1) * sizeof(*top.boxes)),
        .order = malloc((count + (size_t)1) * sizeof(*top.order)),
        .nodes = malloc((2 * (size_t)count + 1) * sizeof(*top.nodes)),
        .leaf_max = 1,
    };
    const bool done = top.boxes && top.order && top.nodes;
    for (uint32_t i = 0; i < count && done; i++) {
        top.boxes[i] = hierarchy->builder.nodes[hierarchy->groups[i].root].box;
        top.order[i] = i;
    }
    const struct bvh_range all = { 0, count, 0 };
    if (done && count > 1)
        bvh_build(&top, &all, BVH_DEPTH_MAX - hierarchy->depth, 1);
    for (uint32_t i = 0; i < 2 * count - 1 && done && count > 1; i++) {
        struct bvh_node *node = &hierarchy->builder.nodes[hierarchy->node_count + i];
        *node = top.nodes[i];
        for (int k = 0; k < 2 && node->children[0]; k++) {
            const struct bvh_node *child = &top.nodes[node->children[k]];
            node->children[k] = child->children[0]
                                    ? hierarchy->node_count + node->children[k]
                                    : hierarchy->groups[top.order[child->first]].root;
        }
    }
    hierarchy->root = count > 1 ? hierarchy->node_count : count ? hierarchy->groups[0].root : 0;
    hierarchy->node_count += count > 1 ? 2 * count - 1 : 0;
    free(top.boxes);
    free(top.order);
    free(top.nodes);
    return done;
}

/* Returns the maximum depth of a group's BVH. Stores the number of groups in *group_count. If
 * separate BVHs of the groups would make the whole BVH too deep, *group_count is 1. */
static uint32_t decide_depth(const struct bvh_part *part, uint32_t *group_count)
{
    const uint32_t above =
        part->group_count > 1 ? bvh_balanced_depth(part->group_count, 1) + LEVELS_FREE : 0;
    bool fits = above < BVH_DEPTH_MAX;
    for (uint32_t i = 0; i < part->group_count && fits; i++) {
        const uint32_t count = part->firsts[i + 1] - part->firsts[i];
        fits = bvh_balanced_depth(count, BVH_LEAF_MAX) + 1 < BVH_DEPTH_MAX - above;
    }
    *group_count = fits ? part->group_count : 1;
    return fits ? BVH_DEPTH_MAX - above : BVH_DEPTH_MAX;
}

/* Ring buffer of recently built groups, whose topology similar groups copy. */
struct recent {
    uint32_t groups[KNOWN_MAX];
    struct similarity_transform_anchor anchors[KNOWN_MAX];
    uint32_t count;
};

/* Copies the topology of a similar recent group. Returns false if there is none. */
static bool copy_similar(struct bvh_two_level *hierarchy, const struct bvh_part *part,
                         const struct recent *recent, struct bvh_range *range)
{
    const uint32_t end = recent->count < KNOWN_MAX ? recent->count : KNOWN_MAX;
    const struct group group = { part, range->first, range->count };
    for (uint32_t i = 0; i < end; i++) {
        const struct bvh_range *other = &hierarchy->groups[recent->groups[i]];
        const struct group model = { part, other->first, other->count };
        if (other->count != range->count || !is_similar(&model, &recent->anchors[i], &group))
            continue;
        const uint32_t shift = range->first - other->first;
        uint32_t next = range->root;
        (void)copy_nodes(hierarchy->builder.nodes, &next, hierarchy->builder.nodes, other->root,
                         shift);
        for (uint32_t k = 0; k < range->count; k++)
            hierarchy->builder.order[range->first + k] =
                hierarchy->builder.order[other->first + k] + shift;
        bvh_refit(&hierarchy->builder, range->root);
        return true;
    }
    return false;
}

static void init_groups(struct bvh_two_level *hierarchy, const struct bvh_part *part)
{
    const bool is_single = hierarchy->group_count == 1;
    for (uint32_t i = 0; i < hierarchy->group_count; i++) {
        const uint32_t first = is_single ? 0 : part->firsts[i];
        const uint32_t end = is_single ? part->count : part->firsts[i + 1];
        hierarchy->groups[i] = (struct bvh_range){ first, end - first, 2 * first + 1 };
    }
}

/* Builds the BVHs of all groups. */
static void build_groups(struct bvh_two_level *hierarchy, const struct bvh_part *part,
                         struct bvh_build_stats *work)
{
    struct recent recent = { .count = 0 };
    for (uint32_t i = 0; i < hierarchy->group_count; i++) {
        struct bvh_range *range = &hierarchy->groups[i];
        if (copy_similar(hierarchy, part, &recent, range)) {
            work->shared++;
            continue;
        }
        bvh_build(&hierarchy->builder, range, hierarchy->depth, work->threads);
        work->built++;
        if (hierarchy->group_count == 1)
            continue;
        const uint32_t slot = recent.count++ % KNOWN_MAX;
        recent.groups[slot] = i;
        recent.anchors[slot] = find_anchor(part, range->first, range->count);
    }
}

/* Loads all group BVHs of a large part from the cache. If that fails, builds and caches them. */
static void load_groups(struct bvh_two_level *hierarchy, const struct bvh_part *part,
                        struct bvh_build_stats *work)
{
    const bool is_cached = work->is_cached && part->count >= BVH_CACHE_MIN;
    const uint64_t key = is_cached ? bvh_cache_key(part) : 0;
    if (is_cached && bvh_cache_load(hierarchy, key)) {
        work->read += hierarchy->group_count;
        return;
    }
    build_groups(hierarchy, part, work);
    if (is_cached)
        bvh_cache_save(hierarchy, key);
}

bool bvh_two_level_build(struct bvh_two_level *hierarchy, const struct bvh_part *part,
                         struct bvh_build_stats *work)
{
    uint32_t group_count;
    const uint32_t depth = decide_depth(part, &group_count);
    group_count = part->count ? group_count : 0;
    if (!allocate(hierarchy, part, group_count, 2 * part->count + 1 + 2 * group_count))
        return false;
    hierarchy->depth = depth;
    hierarchy->node_count = 2 * part->count + 1;
    init_groups(hierarchy, part);
    load_groups(hierarchy, part, work);
    const bool done = build_top_level(hierarchy);
    free_boxes(hierarchy);
    return done;
}

bool bvh_two_level_pack(struct bvh_two_level *hierarchy)
{
    uint32_t next = 1;
    struct bvh_node *nodes = malloc((hierarchy->node_count + (size_t)1) * sizeof(*nodes));
    if (!nodes)
        return false;
    for (uint32_t i = 0; i < hierarchy->group_count; i++) {
        struct bvh_range *range = &hierarchy->groups[i];
        range->root = copy_nodes(nodes, &next, hierarchy->builder.nodes, range->root, 0);
    }
    free(hierarchy->builder.nodes);
    hierarchy->node_count = next;
    struct bvh_node *smaller = realloc(nodes, next * sizeof(*nodes));
    hierarchy->builder.nodes = smaller ? smaller : nodes;
    return true;
}

static bool has_groups_of(const struct bvh_part *part, const struct bvh_part *rest)
{
    return part->count == rest->count && part->group_count == rest->group_count &&
           !memcmp(part->firsts, rest->firsts, (part->group_count + (size_t)1) * sizeof(uint32_t));
}

/* Returns true if a group has deformed and its refitted BVH has become too expensive. */
static bool is_degraded(const struct bvh_two_level *hierarchy, const struct bvh_part *part,
                        const struct bvh_two_level *rest, const struct bvh_part *rest_part,
                        uint32_t index, double cost_growth_max)
{
    const struct bvh_range *range = &rest->groups[index];
    const double before = bvh_sah_cost(&rest->builder, range->root);
    if (!(bvh_sah_cost(&hierarchy->builder, hierarchy->groups[index].root) >
          cost_growth_max * before))
        return false;
    const struct group recent = { rest_part, range->first, range->count };
    const struct group group = { part, range->first, range->count };
    const struct similarity_transform_anchor anchor =
        find_anchor(rest_part, range->first, range->count);
    return !is_similar(&recent, &anchor, &group);
}

bool bvh_two_level_refit(struct bvh_two_level *hierarchy, const struct bvh_part *part,
                         const struct bvh_two_level *rest, const struct bvh_part *rest_part,
                         struct bvh_build_stats *work)
{
    const uint32_t group_count = rest->group_count;
    if (!has_groups_of(part, rest_part))
        return bvh_two_level_build(hierarchy, part, work);
    if (!allocate(hierarchy, part, group_count, rest->node_count + 2 * (part->count + group_count)))
        return false;
    hierarchy->depth = rest->depth;
    hierarchy->node_count = rest->node_count + 2 * part->count;
    memcpy(hierarchy->builder.order, rest->builder.order,
           part->count * sizeof(*rest->builder.order));
    memcpy(hierarchy->builder.nodes, rest->builder.nodes,
           rest->node_count * sizeof(*rest->builder.nodes));
    memcpy(hierarchy->groups, rest->groups, group_count * sizeof(*rest->groups));
    for (uint32_t i = 0; i < group_count; i++) {
        struct bvh_range *range = &hierarchy->groups[i];
        bvh_refit(&hierarchy->builder, range->root);
        if (!is_degraded(hierarchy, part, rest, rest_part, i, work->cost_growth_max)) {
            work->refitted++;
            continue;
        }
        range->root = rest->node_count + 2 * range->first;
        bvh_build(&hierarchy->builder, range, hierarchy->depth, work->threads);
        work->built++;
    }
    const bool done = build_top_level(hierarchy);
    free_boxes(hierarchy);
    return done;
}
