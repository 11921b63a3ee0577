/* shell_nesting.c: finds the innermost shell around each shell. A ray upwards from the highest
 * point of a shell first hits either the inside of that shell, or the outside of a sibling, which
 * reaches higher. Therefore, shells are visited from the highest to the lowest. */
#include "src/scene/import/shell_nesting.h"
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>
#include "src/scene/bvh/bvh_build.h"

enum {
    STACK_MAX = 2 * BVH_DEPTH_MAX, /* maximum number of pending BVH nodes */
};

struct nesting {
    const struct shell_nesting *input;
    struct bvh_builder bvh;
    uint32_t *triangles; /* triangle of each box of the BVH */
};

/* First hit of a ray upwards. */
struct hit {
    double y;
    uint32_t shell; /* SHELL_NONE if nothing is hit */
    bool is_upper;  /* the shell's winding makes the triangle face upwards */
};

/* Returns twice the signed area of the triangle a, b, p in the xz plane, but never 0. Swapping a
 * and b exactly negates it, so that a ray through an edge hits exactly one of two triangles. */
static double side_of(vec3s a, vec3s b, vec3s p)
{
    const bool is_swapped = a.x > b.x || (a.x >= b.x && a.z > b.z);
    const vec3s from = is_swapped ? b : a, to = is_swapped ? a : b;
    double area = ((double)to.x - (double)from.x) * ((double)p.z - (double)from.z) -
                  ((double)to.z - (double)from.z) * ((double)p.x - (double)from.x);
    area = fabs(area) > 0 ? area : 0x1p-500;
    return is_swapped ? -area : area;
}

static void hit_triangle(const struct nesting *nesting, uint32_t triangle, vec3s from,
                         uint32_t self, struct hit *hit)
{
    const struct shell_nesting *input = nesting->input;
    const struct shell_edges *edges = input->edges;
    vec3s v[3];
    double w[3], sum = 0, y = 0;
    if (input->shell_of[triangle] == self)
        return;
    for (uint32_t i = 0; i < 3; i++)
        v[i] = edges->at[edges->points[3 * triangle + i]];
    for (int i = 0; i < 3; i++) {
        w[i] = side_of(v[(i + 1) % 3], v[(i + 2) % 3], from);
        if (w[i] * w[0] < 0)
            return;
        sum += w[i];
    }
    for (int i = 0; i < 3; i++)
        y += w[i] / sum * (double)v[i].y;
    /* the y component of the normal has the sign opposite to the area in the xz plane */
    if (y > (double)from.y && y < hit->y)
        *hit = (struct hit){ y, input->shell_of[triangle], (sum < 0) ^ input->is_turned[triangle] };
}

static struct hit cast_up(const struct nesting *nesting, vec3s from, uint32_t self)
{
    struct hit hit = { HUGE_VAL, SHELL_NONE, false };
    uint32_t stack[STACK_MAX], depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
        const struct bvh_node *node = &nesting->bvh.nodes[stack[--depth]];
        const struct bvh_box *box = &node->box;
        /* the same sides are open as in side_of(), where z is higher and x is lower by rounding */
        if (from.x <= box->low[0] || from.x > box->high[0] || from.z < box->low[2] ||
            from.z >= box->high[2] || from.y > box->high[1] || (double)box->low[1] > hit.y)
            continue;
        if (!node->children[0]) {
            for (uint32_t i = node->first; i < node->first + node->count; i++)
                hit_triangle(nesting, nesting->triangles[nesting->bvh.order[i]], from, self, &hit);
            continue;
        }
        const struct bvh_node *a = &nesting->bvh.nodes[node->children[0]];
        const struct bvh_node *b = &nesting->bvh.nodes[node->children[1]];
        const uint32_t lower = a->box.low[1] < b->box.low[1] ? 0 : 1;
        stack[depth++] = node->children[1 - lower];
        stack[depth++] = node->children[lower];
    }
    return hit;
}

/* Builds a BVH of the triangles of all solid shells. */
static bool build_bvh(struct nesting *nesting)
{
    const struct shell_nesting *input = nesting->input;
    const struct shell_edges *edges = input->edges;
    const uint32_t triangle_count = edges->corner_count / 3;
    struct bvh_builder *bvh = &nesting->bvh;
    uint32_t count = 0;
    nesting->triangles = malloc((triangle_count + (size_t)1) * sizeof(uint32_t));
    *bvh = (struct bvh_builder){
        .boxes = malloc((triangle_count + (size_t)1) * sizeof(*bvh->boxes)),
        .order = malloc((triangle_count + (size_t)1) * sizeof(*bvh->order)),
        .nodes = malloc((2 * (size_t)triangle_count + 1) * sizeof(*bvh->nodes)),
        .leaf_max = BVH_LEAF_MAX,
    };
    if (!nesting->triangles || !bvh->boxes || !bvh->order || !bvh->nodes)
        return false;
    for (uint32_t i = 0; i < triangle_count; i++) {
        struct bvh_box box;
        if (!input->shells[input->shell_of[i]].is_solid)
            continue;
        for (int k = 0; k < 3; k++) {
            const uint32_t *points = &edges->points[(size_t)3 * i];
            const float a = edges->at[points[0]].raw[k];
            const float b = edges->at[points[1]].raw[k];
            const float c = edges->at[points[2]].raw[k];
            box.low[k] = fminf(a, fminf(b, c));
            box.high[k] = fmaxf(a, fmaxf(b, c));
        }
        bvh->boxes[count] = box;
        bvh->order[count] = count;
        nesting->triangles[count++] = i;
    }
    bvh_build(bvh, &(struct bvh_range){ 0, count, 0 }, BVH_DEPTH_MAX, 1);
    return true;
}

struct ordered_shell {
    float top;
    uint32_t shell;
};

static int by_height(const void *left, const void *right)
{
    const struct ordered_shell *a = left, *b = right;
    if (a->top > b->top || a->top < b->top)
        return a->top > b->top ? -1 : 1;
    return a->shell < b->shell ? -1 : 1;
}

/* Orients shell `i`, whose innermost container is known. */
static void orient(struct shell *shells, uint32_t i, uint32_t container)
{
    struct shell *shell = &shells[i];
    const struct shell *around = container == SHELL_NONE ? NULL : &shells[container];
    const bool is_in_solid = around && !around->is_cavity;
    const bool is_negative = shell->volume < 0;
    /* in a solid that was inside out, cavities were, too */
    shell->is_flipped = is_in_solid ? !is_negative && around->is_flipped : is_negative;
    shell->is_cavity = is_in_solid && is_negative != shell->is_flipped;
    shell->container = container;
}

bool shell_nesting_orient(const struct shell_nesting *input)
{
    struct nesting nesting = { .input = input };
    struct shell *shells = input->shells;
    const uint32_t shell_count = input->shell_count;
    struct ordered_shell *order = malloc((shell_count + (size_t)1) * sizeof(*order));
    uint32_t count = 0, negative_count = 0;
    for (uint32_t i = 0; order && i < shell_count; i++) {
        shells[i].container = SHELL_NONE;
        if (!shells[i].is_solid)
            continue;
        order[count++] = (struct ordered_shell){ shells[i].top.y, i };
        negative_count += shells[i].volume < 0;
    }
    bool done = order;
    if (done && negative_count > 0 && count > 1)
        done = build_bvh(&nesting);
    if (done)
        qsort(order, count, sizeof(*order), by_height);
    for (uint32_t i = 0; done && negative_count > 0 && i < count; i++) {
        const uint32_t index = order[i].shell;
        const struct hit hit = count > 1 ? cast_up(&nesting, shells[index].top, index)
                                         : (struct hit){ .shell = SHELL_NONE };
        uint32_t container = SHELL_NONE;
        if (hit.shell != SHELL_NONE) {
            const struct shell *other = &shells[hit.shell];
            const bool is_inside = hit.is_upper == (other->volume > 0);
            container = is_inside ? hit.shell : other->container;
        }
        orient(shells, index, container);
    }
    free(order);
    free(nesting.triangles);
    free(nesting.bvh.boxes);
    free(nesting.bvh.order);
    free(nesting.bvh.nodes);
    return done;
}
