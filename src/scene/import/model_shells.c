/* model_shells.c: finds the shells of a medium's triangles, joins parts that close together, and
 * orients shells. */
#include "src/scene/import/model_shells.h"
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/scene/import/shell_nesting.h"

enum {
    FOLDED_USES_MAX = 16, /* maximum number of triangles at an edge that are tested for folds */
};

/* Area of the boundary of a hole, as a fraction of its squared length, below which the boundary is
 * a seam between vertices that do not match (T-junctions). */
static const double seam = 1e-5;

/* Cosine between the planes of two triangles that are folded onto each other. */
static const float folded_cosine = 0.999f;

/* Volume of a shell, as a fraction of area ^ 1.5, below which the shell is flat. */
static const double flat = 1e-12;

/* Disjoint-set forest of triangles. Parity 1: wound opposite to the parent. */
struct forest {
    uint32_t *parents;
    uint8_t *parities;
};

/* Two triangles with the same corners and opposite windings. */
struct coincident {
    uint32_t first, second;
};

/* State of the search. */
struct search {
    struct shell_edges edges;
    uint32_t *objects; /* parent of each part in a disjoint-set forest; the root is the first */
    struct forest triangles;
    bool *is_open;      /* of each triangle: true at the boundary of a hole */
    bool *is_ambiguous; /* of each triangle: true if its shell cannot be oriented */
    bool *is_turned;    /* of each triangle: true if wound opposite to most of its shell */
    struct shell_edge *boundary;
    uint32_t boundary_count, boundary_capacity;
    struct coincident *coincident;
    uint32_t coincident_count, coincident_capacity;
    bool is_out_of_memory;
    uint32_t *shell_of; /* index of each triangle's shell */
    struct shell *shells;
    uint32_t shell_count;
};

static vec3s corner_at(const struct shell_edges *edges, uint32_t corner)
{
    return edges->at[edges->points[corner]];
}

static uint32_t find_object(uint32_t *parents, uint32_t i)
{
    while (parents[i] != i) {
        parents[i] = parents[parents[i]];
        i = parents[i];
    }
    return i;
}

static void join_objects(uint32_t *parents, uint32_t a, uint32_t b)
{
    a = find_object(parents, a);
    b = find_object(parents, b);
    parents[a > b ? a : b] = a < b ? a : b;
}

/* Returns the root of a triangle. Sets *parity to 1 if the triangle is wound opposite to it. */
static uint32_t find_triangle(struct forest *forest, uint32_t i, uint8_t *parity)
{
    uint8_t sum = 0;
    while (forest->parents[i] != i) {
        const uint32_t parent = forest->parents[i];
        forest->parities[i] ^= forest->parities[parent];
        forest->parents[i] = forest->parents[parent];
        sum ^= forest->parities[i];
        i = forest->parents[i];
    }
    *parity = sum;
    return i;
}

/* Joins the shells of two triangles. Returns false if they contradict each other's winding. */
static bool join_triangles(struct forest *forest, uint32_t a, uint32_t b, uint8_t parity)
{
    uint8_t of_a, of_b;
    a = find_triangle(forest, a, &of_a);
    b = find_triangle(forest, b, &of_b);
    parity ^= of_a ^ of_b;
    if (a == b)
        return parity == 0;
    forest->parents[a > b ? a : b] = a < b ? a : b;
    forest->parities[a > b ? a : b] = parity;
    return true;
}

/* Joins the objects that are open at an edge and that close it together. */
static void visit_objects(void *user, struct shell_edge *uses, uint32_t count)
{
    struct search *search = user;
    const struct shell_edges *edges = &search->edges;
    int64_t all = 0;
    uint32_t first = SHELL_NONE;
    for (uint32_t i = 0; i < count; i++)
        all += shell_edge_is_forward(edges, &uses[i]) ? 1 : -1;
    for (uint32_t i = 0, end; i < count && all == 0; i = end) {
        const uint32_t owner = edges->owners[uses[i].corner / 3];
        int64_t own = 0;
        for (end = i; end < count && edges->owners[uses[end].corner / 3] == owner; end++)
            own += shell_edge_is_forward(edges, &uses[end]) ? 1 : -1;
        if (own == 0)
            continue;
        if (first == SHELL_NONE)
            first = owner;
        join_objects(search->objects, first, owner);
    }
}

static void add_to_boundary(struct search *search, const struct shell_edge *use)
{
    if (search->boundary_count == search->boundary_capacity) {
        const size_t capacity = 2 * (size_t)search->boundary_capacity + 64;
        struct shell_edge *grown = realloc(search->boundary, capacity * sizeof(*grown));
        search->is_out_of_memory = search->is_out_of_memory || !grown;
        if (!grown)
            return;
        search->boundary = grown;
        search->boundary_capacity = (uint32_t)capacity;
    }
    search->boundary[search->boundary_count++] = *use;
}

static uint32_t next_corner(uint32_t corner)
{
    return corner % 3 == 2 ? corner - 2 : corner + 1;
}

/* Returns the corner of the triangle that is not on an edge. */
static uint32_t opposite_corner(const struct shell_edge *use)
{
    return use->corner % 3 == 0 ? use->corner + 2 : use->corner - 1;
}

static void add_coincident(struct search *search, struct coincident pair)
{
    if (search->coincident_count == search->coincident_capacity) {
        const size_t capacity = 2 * (size_t)search->coincident_capacity + 64;
        struct coincident *grown = realloc(search->coincident, capacity * sizeof(*grown));
        search->is_out_of_memory = search->is_out_of_memory || !grown;
        if (!grown)
            return;
        search->coincident = grown;
        search->coincident_capacity = (uint32_t)capacity;
    }
    search->coincident[search->coincident_count++] = pair;
}

/* Returns the unit vector from an edge to the opposite corner, perpendicular to the edge. */
static vec3s height_of(const struct shell_edges *edges, const struct shell_edge *use)
{
    const vec3s from = corner_at(edges, use->corner);
    const vec3s side = glms_vec3_sub(corner_at(edges, opposite_corner(use)), from);
    const vec3s along =
        glms_vec3_normalize(glms_vec3_sub(corner_at(edges, next_corner(use->corner)), from));
    return glms_vec3_normalize(glms_vec3_muladds(along, -glms_vec3_dot(side, along), side));
}

/* Returns true if two triangles of opposite windings are at the same side of their common edge, so
 * that they face each other or are the two sides of a sheet. */
static bool are_folded(const struct shell_edges *edges, const struct shell_edge *a,
                       const struct shell_edge *b)
{
    return shell_edge_is_forward(edges, a) != shell_edge_is_forward(edges, b) &&
           glms_vec3_dot(height_of(edges, a), height_of(edges, b)) > folded_cosine;
}

/* If the triangle of use `index` is folded onto another one, returns the index of the nearest use
 * that closes a shell with it without a fold. Returns `count` if there is none. */
static uint32_t find_partner(const struct shell_edges *edges, const struct shell_edge *uses,
                             uint32_t count, uint32_t index, uint32_t matched)
{
    const bool is_forward = shell_edge_is_forward(edges, &uses[index]);
    bool is_folded = false;
    uint32_t found = count;
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t distance = i < index ? index - i : i - index;
        if (shell_edge_is_forward(edges, &uses[i]) == is_forward)
            continue;
        if (are_folded(edges, &uses[i], &uses[index]))
            is_folded = true;
        else if (!(matched >> i & 1) &&
                 (found == count || distance < (found < index ? index - found : found - index)))
            found = i;
    }
    return is_folded ? found : count;
}

/* Lists the pairs of coincident triangles of one part at an edge of several triangles, only at the
 * edge between their lower two points. Joins folded triangles with others of their shells.
 * Returns the number of the remaining uses, which are moved to the front. */
static uint32_t visit_folded(struct search *search, struct shell_edge *uses, uint32_t count)
{
    const struct shell_edges *edges = &search->edges;
    uint32_t matched = 0, left = 0;
    edges->parts[edges->owners[uses->corner / 3]].solid_count = 1;
    if (count > FOLDED_USES_MAX)
        return count;
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t triangle = uses[i].corner / 3;
        for (uint32_t k = 0; k < i && edges->points[opposite_corner(&uses[i])] > uses[i].to; k++) {
            const uint32_t other = uses[k].corner / 3;
            if (edges->points[opposite_corner(&uses[k])] ==
                    edges->points[opposite_corner(&uses[i])] &&
                are_folded(edges, &uses[k], &uses[i]) &&
                edges->owners[other] == edges->owners[triangle])
                add_coincident(search, (struct coincident){ other, triangle });
        }
        const uint32_t partner =
            matched >> i & 1 ? count : find_partner(edges, uses, count, i, matched);
        if (partner == count)
            continue;
        (void)join_triangles(&search->triangles, triangle, uses[partner].corner / 3, 0);
        matched |= 1u << i | 1u << partner;
    }
    for (uint32_t i = 0; i < count; i++) {
        if (!(matched >> i & 1))
            uses[left++] = uses[i];
    }
    return left;
}

/* Joins the triangles at an edge. Each use is matched with the last unmatched opposite one before
 * it, because the triangles of a shell are usually consecutive. `uses` holds the stack of unmatched
 * ones, which all have the same direction. */
static void visit_triangles(void *user, struct shell_edge *uses, uint32_t count)
{
    struct search *search = user;
    const struct shell_edges *edges = &search->edges;
    uint32_t depth = 0;
    const uint32_t a = uses[0].corner / 3, b = uses[count > 1].corner / 3;
    const uint32_t left = count > 2 ? visit_folded(search, uses, count) : count;
    for (uint32_t i = 0; i < left; i++) {
        const struct shell_edge use = uses[i];
        const bool is_forward = shell_edge_is_forward(edges, &use);
        if (depth > 0 && shell_edge_is_forward(edges, &uses[depth - 1]) != is_forward)
            (void)join_triangles(&search->triangles, uses[--depth].corner / 3, use.corner / 3, 0);
        else
            uses[depth++] = use;
    }
    if (count == 2 && depth == 2) { /* wound inconsistently */
        join_objects(search->objects, edges->owners[a], edges->owners[b]);
        if (!join_triangles(&search->triangles, a, b, 1))
            search->is_ambiguous[a] = true;
        return;
    }
    for (uint32_t i = 0; i < depth; i++)
        add_to_boundary(search, &uses[i]);
}

/* ---- holes ---- */

/* Edges of the boundary that are connected: their vector area and length. */
struct loop {
    double area[3];
    double length;
    uint32_t first; /* 1 + index of the first edge; 0 before it */
};

static double length_of(const double v[static 3])
{
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

static void add_to_loop(struct loop *loop, vec3s a, vec3s b)
{
    for (int k = 0; k < 3; k++) {
        const int u = (k + 1) % 3, v = (k + 2) % 3;
        loop->area[k] +=
            0.5 * ((double)a.raw[u] * (double)b.raw[v] - (double)a.raw[v] * (double)b.raw[u]);
    }
    loop->length += (double)glms_vec3_distance(a, b);
}

/* Counts an edge of a hole, or joins the triangles and objects at a seam. */
static void close_edge(struct search *search, struct loop *loop, uint32_t index)
{
    const struct shell_edges *edges = &search->edges;
    const uint32_t triangle = search->boundary[index].corner / 3;
    if (length_of(loop->area) > seam * loop->length * loop->length) {
        search->is_open[triangle] = true;
        edges->parts[edges->owners[triangle]].open_edge_count++;
        return;
    }
    if (!loop->first)
        loop->first = index + 1;
    const uint32_t first = search->boundary[loop->first - 1].corner / 3;
    (void)join_triangles(&search->triangles, first, triangle, 0);
    join_objects(search->objects, edges->owners[first], edges->owners[triangle]);
}

/* Tells holes from seams, whose boundary encloses no area. */
static bool close_seams(struct search *search)
{
    const struct shell_edges *edges = &search->edges;
    uint32_t *parents = malloc((edges->point_count + (size_t)1) * sizeof(*parents));
    struct loop *loops = calloc(edges->point_count + (size_t)1, sizeof(*loops));
    const bool done = parents && loops;
    for (uint32_t i = 0; done && i < edges->point_count; i++)
        parents[i] = i;
    for (uint32_t i = 0; done && i < search->boundary_count; i++) {
        const uint32_t corner = search->boundary[i].corner;
        join_objects(parents, edges->points[corner], edges->points[next_corner(corner)]);
    }
    for (uint32_t i = 0; done && i < search->boundary_count; i++) {
        const uint32_t corner = search->boundary[i].corner;
        const vec3s a = glms_vec3_sub(corner_at(edges, corner), edges->at[0]);
        const vec3s b = glms_vec3_sub(corner_at(edges, next_corner(corner)), edges->at[0]);
        add_to_loop(&loops[find_object(parents, edges->points[corner])], a, b);
    }
    for (uint32_t i = 0; done && i < search->boundary_count; i++) {
        const uint32_t corner = search->boundary[i].corner;
        close_edge(search, &loops[find_object(parents, edges->points[corner])], i);
    }
    free(parents);
    free(loops);
    return done;
}

/* ---- shells ---- */

/* Computes the vector area of a triangle, and returns the volume between it and a point. */
static double measure_triangle(const struct shell_edges *edges, uint32_t triangle, vec3s from,
                               double area[static 3])
{
    double side[3][3];
    for (uint32_t i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++)
            side[i][k] = (double)corner_at(edges, 3 * triangle + i).raw[k] - (double)from.raw[k];
    }
    double volume = 0;
    for (int k = 0; k < 3; k++) {
        const int u = (k + 1) % 3, v = (k + 2) % 3;
        area[k] = 0.5 * ((side[1][u] - side[0][u]) * (side[2][v] - side[0][v]) -
                         (side[1][v] - side[0][v]) * (side[2][u] - side[0][u]));
        volume += area[k] * side[0][k] / 3;
    }
    return volume;
}

/* Adds a triangle to its shell, whose winding is that of its first triangle. */
static void add_triangle(struct search *search, uint32_t triangle, uint8_t parity)
{
    const struct shell_edges *edges = &search->edges;
    struct shell *shell = &search->shells[search->shell_of[triangle]];
    double area[3];
    const double volume = measure_triangle(edges, triangle, edges->at[0], area);
    shell->volume += parity ? -volume : volume;
    shell->area += length_of(area);
    shell->is_closed = shell->is_closed && !search->is_open[triangle];
    shell->triangle_count++;
    shell->turned_count += parity;
    for (uint32_t i = 0; i < 3; i++) {
        const vec3s at = corner_at(edges, 3 * triangle + i);
        if (shell->triangle_count == 1 || at.y > shell->top.y)
            shell->top = at;
    }
}

/* Lists the shells, and finds out which of them bound a volume. */
static bool list_shells(struct search *search)
{
    const uint32_t count = search->edges.corner_count / 3;
    uint8_t parity;
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t root = find_triangle(&search->triangles, i, &parity);
        search->shell_of[i] = root == i ? search->shell_count++ : search->shell_of[root];
    }
    search->shells = calloc(search->shell_count + (size_t)1, sizeof(*search->shells));
    for (uint32_t i = 0; search->shells && i < search->shell_count; i++)
        search->shells[i].is_closed = true;
    for (uint32_t i = 0; search->shells && i < count; i++) {
        (void)find_triangle(&search->triangles, i, &parity);
        search->shells[search->shell_of[i]].part = search->edges.owners[i];
        add_triangle(search, i, parity);
    }
    for (uint32_t i = 0; search->shells && i < count; i++) {
        if (search->is_ambiguous[i])
            search->shells[search->shell_of[i]].is_closed = false;
    }
    for (uint32_t i = 0; search->shells && i < search->shell_count; i++) {
        struct shell *shell = &search->shells[i];
        shell->is_inverse = shell->turned_count > shell->triangle_count / 2;
        shell->volume = shell->is_inverse ? -shell->volume : shell->volume;
        shell->is_solid = shell->is_closed && fabs(shell->volume) > flat * pow(shell->area, 1.5);
    }
    for (uint32_t i = 0; search->shells && i < count; i++) {
        (void)find_triangle(&search->triangles, i, &parity);
        search->is_turned[i] = parity ^ search->shells[search->shell_of[i]].is_inverse;
    }
    return search->shells;
}

/* ---- winding ---- */

static void swap_corners(struct search *search, uint32_t triangle)
{
    uint32_t *indices = search->edges.mesh->indices;
    const uint32_t *corners = &search->edges.corners[(size_t)3 * triangle];
    const uint32_t second = indices[corners[1]];
    indices[corners[1]] = indices[corners[2]];
    indices[corners[2]] = second;
}

/* Negates the normals of a shell's vertices that are not yet marked in `is_done`. */
static void turn_normals(struct search *search, uint32_t triangle, bool *is_done)
{
    struct mesh *mesh = search->edges.mesh;
    for (uint32_t i = 0; i < 3; i++) {
        const uint32_t vertex = mesh->indices[search->edges.corners[3 * triangle + i]];
        const uint32_t first = search->edges.parts[0].first_vertex;
        if (is_done[vertex - first])
            continue;
        is_done[vertex - first] = true;
        mesh->vertices[vertex].normal = glms_vec3_negate(mesh->vertices[vertex].normal);
        if (mesh->extras)
            mesh->extras[vertex].side = -mesh->extras[vertex].side;
    }
}

/* Adds how well the normals of a triangle agree with its winding. */
static void compare_normals(struct search *search, uint32_t triangle, bool is_swapped)
{
    const struct mesh *mesh = search->edges.mesh;
    double area[3], agreement = 0;
    (void)measure_triangle(&search->edges, triangle, search->edges.at[0], area);
    for (uint32_t i = 0; i < 3; i++) {
        const uint32_t index = search->edges.corners[3 * triangle + i];
        const vec3s normal = mesh->vertices[mesh->indices[index]].normal;
        for (int k = 0; k < 3; k++)
            agreement += area[k] * (double)normal.raw[k];
    }
    search->shells[search->shell_of[triangle]].agreement += is_swapped ? -agreement : agreement;
}

/* Returns true if some but not all triangles of a shell are wound opposite to the first one. */
static bool is_inconsistent(const struct shell *shell)
{
    return shell->turned_count % shell->triangle_count > 0;
}

/* Returns true if triangles of a shell are flipped. */
static bool is_changed(const struct shell *shell)
{
    return shell->is_solid && (shell->is_flipped || is_inconsistent(shell));
}

/* Flips the triangles of shells, and normals that then oppose the winding. */
static bool apply_winding(struct search *search, struct shell_counts *counts)
{
    const struct shell_edges *edges = &search->edges;
    const struct shell_part *last = &edges->parts[edges->part_count - 1];
    const uint32_t triangle_count = edges->corner_count / 3;
    bool *is_done =
        calloc(last->first_vertex + last->vertex_count - edges->parts[0].first_vertex + (size_t)1,
               sizeof(*is_done));
    for (uint32_t i = 0; is_done && i < triangle_count; i++) {
        const struct shell *shell = &search->shells[search->shell_of[i]];
        if (!shell->is_solid)
            continue;
        const bool is_swapped = search->is_turned[i] ^ shell->is_flipped;
        compare_normals(search, i, is_swapped);
        if (is_swapped)
            swap_corners(search, i);
    }
    for (uint32_t i = 0; is_done && i < triangle_count; i++) {
        const struct shell *shell = &search->shells[search->shell_of[i]];
        if (is_changed(shell) && shell->agreement < 0)
            turn_normals(search, i, is_done);
    }
    for (uint32_t i = 0; is_done && i < search->shell_count; i++) {
        const struct shell *shell = &search->shells[i];
        counts->unified += is_changed(shell) && is_inconsistent(shell);
        counts->flipped += is_changed(shell) && !is_inconsistent(shell);
    }
    free(is_done);
    return is_done != NULL;
}

/* ---- shared faces ---- */

/* Returns true if a triangle belongs to a shell that bounds a medium from outside. */
static bool is_of_solid(const struct search *search, uint32_t triangle)
{
    const struct shell *shell = &search->shells[search->shell_of[triangle]];
    return shell->is_solid && !shell->is_cavity;
}

/* Makes the corners of a triangle equal. Returns false if they already were. */
static bool collapse(struct search *search, uint32_t triangle)
{
    uint32_t *indices = search->edges.mesh->indices;
    const uint32_t *corners = &search->edges.corners[(size_t)3 * triangle];
    const uint32_t first = indices[corners[0]];
    if (indices[corners[1]] == first)
        return false;
    indices[corners[1]] = first;
    indices[corners[2]] = first;
    return true;
}

/* Collapses pairs of coincident triangles of different solids, which are inside their medium. */
static void collapse_shared(struct search *search, struct shell_counts *counts)
{
    for (uint32_t i = 0; i < search->coincident_count; i++) {
        const uint32_t a = search->coincident[i].first, b = search->coincident[i].second;
        const struct shell *of_a = &search->shells[search->shell_of[a]],
                           *of_b = &search->shells[search->shell_of[b]];
        const bool is_opposite =
            (search->is_turned[a] ^ of_a->is_flipped) == (search->is_turned[b] ^ of_b->is_flipped);
        if (of_a == of_b || !is_of_solid(search, a) || !is_of_solid(search, b) || !is_opposite)
            continue;
        counts->shared += collapse(search, a);
        counts->shared += collapse(search, b);
    }
}

/* Counts the solids of each object. */
static void count_solids(struct search *search)
{
    struct shell_part *parts = search->edges.parts;
    for (uint32_t i = 0; i < search->shell_count; i++) {
        const struct shell *shell = &search->shells[i];
        parts[parts[shell->part].object].solid_count += shell->is_solid && !shell->is_cavity;
    }
    for (uint32_t i = 0; i < search->shell_count; i++) {
        const struct shell *shell = &search->shells[i];
        if (!shell->is_solid && shell->area > 0)
            parts[parts[shell->part].object].solid_count = 0;
    }
}

static bool allocate(struct search *search)
{
    const struct shell_edges *edges = &search->edges;
    const size_t triangles = edges->corner_count / 3 + (size_t)1;
    search->objects = malloc((edges->part_count + (size_t)1) * sizeof(*search->objects));
    search->triangles.parents = malloc(triangles * sizeof(uint32_t));
    search->triangles.parities = calloc(triangles, sizeof(uint8_t));
    search->is_open = calloc(triangles, sizeof(bool));
    search->is_ambiguous = calloc(triangles, sizeof(bool));
    search->is_turned = calloc(triangles, sizeof(bool));
    search->shell_of = malloc(triangles * sizeof(uint32_t));
    if (!search->objects || !search->triangles.parents || !search->triangles.parities ||
        !search->is_open || !search->is_ambiguous || !search->is_turned || !search->shell_of)
        return false;
    for (uint32_t i = 0; i < edges->part_count; i++)
        search->objects[i] = i;
    for (uint32_t i = 0; i + 1 < triangles; i++)
        search->triangles.parents[i] = i;
    return true;
}

static void finish(struct search *search)
{
    shell_edges_finish(&search->edges);
    free(search->objects);
    free(search->triangles.parents);
    free(search->triangles.parities);
    free(search->is_open);
    free(search->is_ambiguous);
    free(search->is_turned);
    free(search->boundary);
    free(search->coincident);
    free(search->shell_of);
    free(search->shells);
}

bool model_shells_find(struct mesh *mesh, struct shell_part *parts, uint32_t part_count,
                       bool collapses_shared, struct shell_counts *counts)
{
    struct search search = { 0 };
    bool done = shell_edges_init(&search.edges, mesh, parts, part_count) && allocate(&search);
    if (done) {
        shell_edges_visit(&search.edges, &search, visit_objects);
        shell_edges_visit(&search.edges, &search, visit_triangles);
        done = !search.is_out_of_memory && close_seams(&search) && list_shells(&search) &&
               shell_nesting_orient(&(struct shell_nesting){
                   .edges = &search.edges,
                   .shell_of = search.shell_of,
                   .is_turned = search.is_turned,
                   .shells = search.shells,
                   .shell_count = search.shell_count,
               }) &&
               apply_winding(&search, counts);
    }
    if (done && collapses_shared)
        collapse_shared(&search, counts);
    for (uint32_t i = 0; done && i < search.shell_count; i++) {
        const struct shell *shell = &search.shells[i];
        if (shell->is_cavity)
            join_objects(search.objects, shell->part, search.shells[shell->container].part);
    }
    for (uint32_t i = 0; done && i < part_count; i++)
        parts[i].object = find_object(search.objects, i);
    if (done)
        count_solids(&search);
    finish(&search);
    return done;
}
