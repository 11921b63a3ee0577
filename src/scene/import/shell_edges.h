/* shell_edges.h: welded points and edges of the triangles that may bound one medium. */
#ifndef FIRN_SCENE_IMPORT_SHELL_EDGES_H
#define FIRN_SCENE_IMPORT_SHELL_EDGES_H

#include "src/scene/geometry/mesh.h"

#define SHELL_NONE UINT32_MAX

/* Triangles of a primitive: ranges of mesh->indices and of the vertices that these refer to. */
struct shell_part {
    uint32_t first_index, index_count;
    uint32_t first_vertex, vertex_count;
    uint32_t object;          /* result: index of the first part of the same object */
    uint32_t open_edge_count; /* result: number of edges around holes */
    uint32_t solid_count;     /* result: as of the object, at its first part */
};

/* Use of an edge by the triangle that owns `corner`, which is the first corner of the edge. */
struct shell_edge {
    uint32_t to; /* the edge's higher point */
    uint32_t corner;
};

struct shell_edges {
    struct mesh *mesh;
    struct shell_part *parts;
    uint32_t part_count;
    uint32_t corner_count, point_count, vertex_count;
    uint32_t *vertex_points; /* welded point of each vertex of the parts */
    uint32_t *points;        /* welded point of each corner */
    uint32_t *corners;       /* index into mesh->indices of each corner */
    uint32_t *owners;        /* part of each triangle */
    vec3s *at;               /* position of each point */
    uint32_t *starts;        /* first edge of each lower point; point_count + 1 elements */
    struct shell_edge *all;  /* edges by lower point, higher point and corner */
};

/* Welds the vertices of the parts, and lists the edges. Returns false when out of memory. */
bool shell_edges_init(struct shell_edges *edges, struct mesh *mesh, struct shell_part *parts,
                      uint32_t part_count);
void shell_edges_finish(struct shell_edges *edges);

/* Calls `visit` for each edge, with its uses in ascending order of corners. */
void shell_edges_visit(const struct shell_edges *edges, void *user,
                       void (*visit)(void *user, struct shell_edge *uses, uint32_t count));

/* Returns true if the use's triangle traverses the edge from its lower to its higher point. */
static inline bool shell_edge_is_forward(const struct shell_edges *edges,
                                         const struct shell_edge *use)
{
    return edges->points[use->corner] != use->to;
}

#endif
