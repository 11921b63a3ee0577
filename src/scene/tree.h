/*
 * tree.h: a scene's triangles in trees of boxes, in the layout that shaders read.
 *
 * Binary trees by the surface area heuristic (Wald 2007, On fast Construction of SAH-based
 * Bounding Volume Hierarchies), one for each part of the scene that moves as a whole; of a model
 * that has poses, it has the trees of all objects below one of their boxes. Everything lies in
 * words of four 32-bit numbers (shaders/tree.h). The same scene gives the same words for any
 * number of threads.
 *
 * Ownership:     a tree owns its words; tree_finish() frees them; a {0} tree is fine, and empty.
 * Thread-safety: several threads may call tree_meet() at the same time.
 */
#ifndef FIRN_SCENE_TREE_H
#define FIRN_SCENE_TREE_H

#include <stddef.h>
#include "shaders/tree.h"
#include "src/base/status.h"
#include "src/scene/generate/generate.h"
#include "src/scene/import/model.h"

struct tree_words {
    uint32_t (*all)[4];
    uint32_t count;
};

struct tree {
    struct tree_words nodes, triangles, corners;
    uint32_t triangle_count;
    uint32_t roots[TREE_PART_COUNT]; /* nodes; TREE_NOTHING: the part has no triangles */
    uint32_t shells;                 /* objects */
    uint32_t medium_count;           /* materials of more than TREE_SHELLS_FEW objects, or 0 */
    uint32_t media;                  /* among the corners: the word of rank 0, or 0 */
    uint32_t grid;                   /* among the corners: the first of TREE_GRID_WORDS, or 0 */
    vec3s grid_low, grid_scale;      /* corner of the grid; cells a metre */
    double costs[TREE_PART_COUNT];   /* of a ray that meets a part's box, in tests of a triangle,
                                        by the surface area heuristic; 0: no triangles */
    uint32_t depth;                  /* most nodes on a way from a root; at most TREE_DEPTH_MAX */
    bool is_closed; /* each side of a triangle of the objects is that of another one, reversed */
    bool is_apart;  /* no box around a triangle of the surroundings meets that around the objects */
    bool is_apart_turning; /* nor that around all turns of it about its vertical axis; nothing moves
                              around the objects */
    bool is_stored;        /* a device's buffers of texels are too small for it; set by its user */
    double ms;             /* time that tree_init() took */
    uint32_t built, shared,
        fitted;    /* trees of objects: built by tree_init(); those of alike objects
                                       that it built; kept from the model at rest */
    uint32_t read; /* from files of an earlier run, of objects and all others */
};

struct tree_shape;

/*
 * What the poses of a model have in common: the model at rest, and the shapes of its trees. In a
 * pose a tree keeps its shape, and its boxes are fitted to the triangles; so the words of a pose do
 * not depend on the poses before. What is not moved, turned or scaled evenly, but deformed, gets a
 * new tree once its own costs rays half as much again as at rest, or, if it is a part's, a tenth.
 */
struct tree_rest {
    bool by_objects;           /* each object has a tree, and those that are alike share a shape;
                                  else parts have one, and horizons */
    struct model model;        /* its meshes, objects and opaque_starts alone */
    struct mesh_order sorted;  /* of its surroundings */
    bool is_known;             /* false: the first tree_init() has the model at rest itself */
    struct tree_shape *shapes; /* of the parts; found by the first tree_init() */
};

struct tree_rest *tree_rest_create(bool by_objects); /* NULL: out of memory */
void tree_rest_destroy(struct tree_rest *rest);

/* Takes the model at rest, unless it is known: its meshes, objects and opaque_starts, which *model
 * then lacks, and *sorted. */
void tree_rest_take(struct tree_rest *rest, struct model *model, struct mesh_order *sorted);

/* All is borrowed, and what is not the model may be NULL or 0. */
struct tree_params {
    const struct model *model;     /* its objects have ranks */
    struct mesh_order sorted;      /* of its surroundings */
    const struct mesh *cracks;     /* in the ice */
    const struct bubbles *bubbles; /* in the ice */
    struct tree_rest *rest;        /* of a model that has poses; NULL: it has none */
    uint32_t threads;              /* at most; 0: one for each core */
    bool is_cached; /* large trees, of poses those at rest, are kept in files between runs */
};

/*
 * Builds the trees of a model. Logs and returns STATUS_TRY_AGAIN when out of memory, or
 * STATUS_DATA for more than TREE_TRIANGLES_MAX triangles, TREE_SHELLS_MAX objects, or
 * TREE_MEDIA_MAX materials of them; *tree is then {0}.
 */
MUST_USE enum status tree_init(struct tree *tree, const struct tree_params *params);

void tree_finish(struct tree *tree);

/* Returns the number of nodes of all parts; 0: the tree has not been built. */
uint32_t tree_node_count(const struct tree *tree);

/* Returns the number of words of the nodes, triangles or corners, of which there are most. */
uint32_t tree_words_most(const struct tree *tree);

/* Returns the bytes of all words. */
size_t tree_size(const struct tree *tree);

struct tree_ray {
    vec3s origin, dir;
    double near;   /* in lengths of `dir`; what is not farther is not met */
    uint32_t from; /* a triangle that is not met; TREE_NOTHING: none */
};

struct tree_hit {
    double t, u, v; /* in lengths of the ray's direction; weights of the second and third corner */
    uint32_t triangle; /* of the tree */
    uint32_t rank;     /* of the object; 0: of the surroundings */
    bool is_back;      /* seen from inside */
};

/* Finds the first triangle of a part that a ray meets; the part is at rest. Returns false if there
 * is none. */
bool tree_meet(const struct tree *tree, uint32_t part, const struct tree_ray *ray,
               struct tree_hit *hit);

/* Returns the index of the medium of the object of a rank; 0: that of the outside. */
uint32_t tree_medium(const struct tree *tree, uint32_t rank);

/* A set of objects: with up to TREE_SHELLS_FEW in the tree a bit of the first word for each rank
 * from 1 on; else the TREE_NESTED_MAX greatest ranks, 16 bits each, the greatest one first. */
struct tree_shells {
    uint32_t words[TREE_NESTED_MAX / 2];
};

void tree_shells_put(struct tree_shells *shells, const struct tree *tree, uint32_t rank);
void tree_shells_remove(struct tree_shells *shells, const struct tree *tree, uint32_t rank);
bool tree_shells_has(const struct tree_shells *shells, const struct tree *tree, uint32_t rank);

/* Returns the objects that a point is inside. */
struct tree_shells tree_immerse(const struct tree *tree, vec3s point);

#endif
