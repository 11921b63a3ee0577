/* shell_edges.c: welds vertices, exactly and, around holes, within rounding; sorts edges. */
#include "src/scene/import/shell_edges.h"
#include <cglm/struct.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    INSERTION_MAX = 24, /* maximum number of edges sorted by insertion */
};

/* Positions that differ by at most this fraction of the largest coordinate are equal within
 * rounding. */
static const float rounding = 8 * FLT_EPSILON;

static uint32_t hash_words(const void *key)
{
    uint32_t words[3];
    uint64_t state = 0x9e3779b97f4a7c15;
    memcpy(words, key, sizeof(words));
    for (int i = 0; i < 3; i++) {
        state = (state ^ words[i]) * 0xff51afd7ed558ccd;
        state ^= state >> 32;
    }
    return (uint32_t)state;
}

/* Returns a hash table of at least twice `count` slots of 0, and its number of slots - 1. */
static uint32_t *make_slots(size_t count, size_t *mask)
{
    size_t slot_count = 2;
    while (slot_count < 2 * count)
        slot_count *= 2;
    *mask = slot_count - 1;
    return calloc(slot_count, sizeof(uint32_t));
}

/* Welds vertices of exactly equal positions. */
static bool weld_exactly(struct shell_edges *edges)
{
    size_t mask;
    uint32_t *slots = make_slots(edges->vertex_count, &mask); /* point + 1, or 0 */
    uint32_t local = 0;
    for (uint32_t p = 0; slots && p < edges->part_count; p++) {
        const struct shell_part *part = &edges->parts[p];
        for (uint32_t i = 0; i < part->vertex_count; i++, local++) {
            const vec3s at = edges->mesh->vertices[part->first_vertex + i].position;
            size_t slot = hash_words(&at) & mask;
            while (slots[slot] && !glms_vec3_eqv(edges->at[slots[slot] - 1], at))
                slot = (slot + 1) & mask;
            if (!slots[slot]) {
                edges->at[edges->point_count++] = at;
                slots[slot] = edges->point_count;
            }
            edges->vertex_points[local] = slots[slot] - 1;
        }
    }
    free(slots);
    return slots != NULL;
}

/* Sets the points of all corners. */
static void list_corners(struct shell_edges *edges)
{
    uint32_t corner = 0, local = 0;
    for (uint32_t p = 0; p < edges->part_count; p++) {
        const struct shell_part *part = &edges->parts[p];
        for (uint32_t i = 0; i < part->index_count; i++, corner++) {
            const uint32_t index = part->first_index + i;
            const uint32_t vertex = edges->mesh->indices[index] - part->first_vertex;
            edges->corners[corner] = index;
            edges->points[corner] = edges->vertex_points[local + vertex];
            edges->owners[corner / 3] = p;
        }
        local += part->vertex_count;
    }
}

static int compare_edges(const void *left, const void *right)
{
    const struct shell_edge *a = left, *b = right;
    if (a->to != b->to)
        return a->to < b->to ? -1 : 1;
    return a->corner < b->corner ? -1 : a->corner > b->corner;
}

static void sort_edges(struct shell_edge *all, uint32_t count)
{
    if (count > INSERTION_MAX) {
        qsort(all, count, sizeof(*all), compare_edges);
        return;
    }
    for (uint32_t i = 1; i < count; i++) {
        const struct shell_edge edge = all[i];
        uint32_t k = i;
        for (; k > 0 && compare_edges(&all[k - 1], &edge) > 0; k--)
            all[k] = all[k - 1];
        all[k] = edge;
    }
}

/* Sets the lower and the higher point of the edge from a corner. Returns false if they are one. */
static bool edge_at(const struct shell_edges *edges, uint32_t corner, uint32_t *low, uint32_t *high)
{
    const uint32_t a = edges->points[corner];
    const uint32_t b = edges->points[corner % 3 == 2 ? corner - 2 : corner + 1];
    *low = a < b ? a : b;
    *high = a < b ? b : a;
    return a != b;
}

/* Lists the edges by counting sort on their lower points. Edges of length 0 are left out. */
static void list_edges(struct shell_edges *edges)
{
    uint32_t *starts = edges->starts;
    uint32_t low, high;
    memset(starts, 0, (edges->point_count + (size_t)1) * sizeof(*starts));
    for (uint32_t c = 0; c < edges->corner_count; c++) {
        if (edge_at(edges, c, &low, &high))
            starts[low]++;
    }
    for (uint32_t i = 0; i < edges->point_count; i++)
        starts[i + 1] += starts[i];
    for (uint32_t c = 0; c < edges->corner_count; c++) {
        if (edge_at(edges, c, &low, &high))
            edges->all[--starts[low]] = (struct shell_edge){ high, c };
    }
    for (uint32_t i = 0; i < edges->point_count; i++)
        sort_edges(&edges->all[starts[i]], starts[i + 1] - starts[i]);
}

void shell_edges_visit(const struct shell_edges *edges, void *user,
                       void (*visit)(void *user, struct shell_edge *uses, uint32_t count))
{
    for (uint32_t i = 0; i < edges->point_count; i++) {
        for (uint32_t first = edges->starts[i], end; first < edges->starts[i + 1]; first = end) {
            for (end = first + 1; end < edges->starts[i + 1]; end++) {
                if (edges->all[end].to != edges->all[first].to)
                    break;
            }
            visit(user, &edges->all[first], end - first);
        }
    }
}

/* ---- holes ---- */

struct boundary {
    const struct shell_edges *edges;
    bool *is_on; /* of each point: true on the boundary of a hole */
    bool exists;
};

static void mark_boundary(void *user, struct shell_edge *uses, uint32_t count)
{
    struct boundary *boundary = user;
    const uint32_t from = boundary->edges->points[uses->corner];
    const uint32_t corner = uses->corner;
    const uint32_t next = boundary->edges->points[corner % 3 == 2 ? corner - 2 : corner + 1];
    int64_t balance = 0;
    for (uint32_t i = 0; i < count; i++)
        balance += shell_edge_is_forward(boundary->edges, &uses[i]) ? 1 : -1;
    if (balance == 0)
        return;
    boundary->exists = true;
    boundary->is_on[from] = boundary->is_on[next] = true;
}

/* Representatives of points in a grid of cells as wide as the tolerance. */
struct grid {
    const vec3s *at;
    float cell;
    uint32_t *slots; /* point + 1, or 0 */
    size_t mask;
};

/* Returns the slot of the cell of a point, moved by a number of cells. */
static uint32_t *find_cell(const struct grid *grid, vec3s at, const int move[static 3])
{
    int32_t cell[3], other[3];
    for (int k = 0; k < 3; k++)
        cell[k] = (int32_t)floorf(at.raw[k] / grid->cell) + move[k];
    size_t slot = hash_words(cell) & grid->mask;
    for (; grid->slots[slot]; slot = (slot + 1) & grid->mask) {
        for (int k = 0; k < 3; k++)
            other[k] = (int32_t)floorf(grid->at[grid->slots[slot] - 1].raw[k] / grid->cell);
        if (memcmp(cell, other, sizeof(cell)) == 0)
            break;
    }
    return &grid->slots[slot];
}

/* Returns a representative within the tolerance of a point on every axis, or SHELL_NONE. */
static uint32_t find_representative(const struct grid *grid, vec3s at)
{
    for (int i = 0; i < 27; i++) { /* the cell itself last */
        const int k = (i + 14) % 27;
        const uint32_t found =
            *find_cell(grid, at, (const int[3]){ k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1 });
        if (found &&
            glms_vec3_max(glms_vec3_abs(glms_vec3_sub(grid->at[found - 1], at))) <= grid->cell)
            return found - 1;
    }
    return SHELL_NONE;
}

/* Moves points on boundaries to their representatives. Returns false when out of memory. */
static bool weld_boundary(struct shell_edges *edges, const bool *is_on)
{
    float largest = 0;
    for (uint32_t i = 0; i < edges->point_count; i++)
        largest = fmaxf(largest, glms_vec3_max(glms_vec3_abs(edges->at[i])));
    struct grid grid = { .at = edges->at, .cell = largest * rounding };
    uint32_t *moved = malloc((edges->point_count + (size_t)1) * sizeof(*moved));
    grid.slots = make_slots(edges->point_count, &grid.mask);
    const bool done = moved && grid.slots;
    for (uint32_t i = 0; done && i < edges->point_count; i++) {
        moved[i] = i;
        if (!is_on[i] || !(grid.cell > 0))
            continue;
        const uint32_t found = find_representative(&grid, edges->at[i]);
        if (found != SHELL_NONE)
            moved[i] = found;
        else
            *find_cell(&grid, edges->at[i], (const int[3]){ 0 }) = i + 1;
    }
    for (uint32_t p = 0, local = 0; done && p < edges->part_count; p++) {
        const struct shell_part *part = &edges->parts[p];
        for (uint32_t i = 0; i < part->vertex_count; i++, local++) {
            uint32_t *point = &edges->vertex_points[local];
            *point = moved[*point];
            edges->mesh->vertices[part->first_vertex + i].position = edges->at[*point];
        }
    }
    free(moved);
    free(grid.slots);
    return done;
}

bool shell_edges_init(struct shell_edges *edges, struct mesh *mesh, struct shell_part *parts,
                      uint32_t part_count)
{
    size_t corners = 1, vertices = 1;
    for (uint32_t i = 0; i < part_count; i++) {
        corners += parts[i].index_count;
        vertices += parts[i].vertex_count;
    }
    *edges = (struct shell_edges){
        .mesh = mesh,
        .parts = parts,
        .part_count = part_count,
        .corner_count = (uint32_t)corners - 1,
        .vertex_count = (uint32_t)vertices - 1,
        .vertex_points = malloc(vertices * sizeof(uint32_t)),
        .points = malloc(corners * sizeof(uint32_t)),
        .corners = malloc(corners * sizeof(uint32_t)),
        .owners = malloc((corners / 3 + 1) * sizeof(uint32_t)),
        .at = malloc(vertices * sizeof(vec3s)),
        .starts = malloc((vertices + 1) * sizeof(uint32_t)),
        .all = malloc(corners * sizeof(struct shell_edge)),
    };
    struct boundary boundary = { .edges = edges, .is_on = calloc(vertices, sizeof(bool)) };
    bool done = edges->vertex_points && edges->points && edges->corners && edges->owners &&
                edges->at && edges->starts && edges->all && boundary.is_on && weld_exactly(edges);
    if (done) {
        list_corners(edges);
        list_edges(edges);
        shell_edges_visit(edges, &boundary, mark_boundary);
    }
    if (done && boundary.exists) {
        done = weld_boundary(edges, boundary.is_on);
        list_corners(edges);
        list_edges(edges);
    }
    free(boundary.is_on);
    return done;
}

void shell_edges_finish(struct shell_edges *edges)
{
    free(edges->vertex_points);
    free(edges->points);
    free(edges->corners);
    free(edges->owners);
    free(edges->at);
    free(edges->starts);
    free(edges->all);
    *edges = (struct shell_edges){ 0 };
}
