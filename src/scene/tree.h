/*
 * tree.h: bounding volume hierarchies (BVHs) of a scene, in the layout of shaders.
 *
 * Binary BVHs, built with the binned surface area heuristic (Wald 2007, On fast Construction of
 * SAH-based Bounding Volume Hierarchies): one for each part of the scene that moves rigidly. An
 * animated model has one for each object, below a top-level BVH. All data is in 16-byte words
 * (shaders/tree.h), and does not depend on the number of threads.
 *
 * Ownership:     a BVH owns its arrays; tree_finish() frees them; a {0} BVH is fine, and empty.
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
    uint32_t roots[TREE_PART_COUNT]; /* root nodes; TREE_NOTHING for a part without triangles */
    uint32_t shells;                 /* number of refractive objects, at least 1 */
    uint32_t medium_count;      /* distinct media of more than TREE_SHELLS_FEW objects; else 0 */
    uint32_t media;             /* index in `corners` of the medium of rank 0; 0 if there is none */
    uint32_t grid;              /* index in `corners` of the horizon grid; 0 if there is none */
    vec3s grid_low, grid_scale; /* minimum corner of the horizon grid; cells per metre */
    double costs[TREE_PART_COUNT]; /* SAH costs, in ray-triangle tests; 0 without triangles */
    uint32_t depth;                /* deepest node, counted from a root; at most TREE_DEPTH_MAX */
    bool is_closed;                /* the objects' mesh is closed: each edge has an opposite edge */
    bool is_apart;         /* no triangle's box in the surroundings overlaps the objects' box */
    bool is_apart_turning; /* is_apart at any rotation about +Y; false if anything else moves */
    bool is_stored;        /* too large for texel buffers of the device; set by the caller */
    double ms;             /* duration of tree_init(), milliseconds */
    uint32_t built, shared, fitted; /* how many object BVHs were built, copied, or refitted */
    uint32_t read; /* number of BVHs loaded from cache files, of objects and of all other parts */
};

struct tree_shape;

/*
 * Rest pose that all poses of an animated model share: the model, and its BVH topologies. A pose
 * keeps the topology and refits the boxes, so that its data does not depend on earlier poses. The
 * BVH of a deforming object is rebuilt once its SAH cost exceeds 1.5 times that of the rest pose;
 * that of a whole part, 1.1 times. Rigid motion and uniform scaling never cause a rebuild.
 */
struct tree_rest {
    bool by_objects;           /* one BVH per object; if false, one BVH per part, with horizons */
    struct model model;        /* only its meshes, objects and opaque_starts */
    struct mesh_order sorted;  /* triangle order of its surroundings */
    bool is_known;             /* false until the first tree_init(), whose model is the rest pose */
    struct tree_shape *shapes; /* topology of each part; set by the first tree_init() */
};

struct tree_rest *tree_rest_create(bool by_objects); /* returns NULL when out of memory */
void tree_rest_destroy(struct tree_rest *rest);

/* Moves meshes, objects, opaque_starts and *sorted into `rest`, unless it has a rest pose. */
void tree_rest_take(struct tree_rest *rest, struct model *model, struct mesh_order *sorted);

/* Input of tree_init(), borrowed. Everything but `model` may be NULL or 0. */
struct tree_params {
    const struct model *model;     /* model whose objects have ranks (medium priorities) */
    struct mesh_order sorted;      /* triangle order of its surroundings */
    const struct mesh *cracks;     /* crack sheets inside the ice */
    const struct bubbles *bubbles; /* bubbles inside the ice */
    struct tree_rest *rest;        /* rest pose of an animated model; NULL if it is not animated */
    uint32_t threads;              /* maximum number of threads; 0 for one per core */
    bool is_cached; /* cache large BVHs (for poses, those of the rest pose) in files */
};

/*
 * Builds the BVHs of a model. Logs and returns STATUS_TRY_AGAIN when out of memory, or STATUS_DATA
 * for more than TREE_TRIANGLES_MAX triangles, TREE_SHELLS_MAX objects, or TREE_MEDIA_MAX object
 * materials; *tree is then {0}.
 */
MUST_USE enum status tree_init(struct tree *tree, const struct tree_params *params);

void tree_finish(struct tree *tree);

/* Returns the number of nodes of all parts; 0 before the BVH is built. */
uint32_t tree_node_count(const struct tree *tree);

/* Returns the size of the largest array (nodes, triangles or corners) in 16-byte words. */
uint32_t tree_words_most(const struct tree *tree);

/* Returns the size of all arrays in bytes. */
size_t tree_size(const struct tree *tree);

struct tree_ray {
    vec3s origin, dir;
    double near;   /* minimum hit distance, exclusive, in lengths of `dir` */
    uint32_t from; /* triangle to ignore, where the ray starts; TREE_NOTHING for none */
};

struct tree_hit {
    double t, u, v;    /* distance in lengths of `dir`; weights of the second and third corner */
    uint32_t triangle; /* index in the BVH's triangle array */
    uint32_t rank;     /* rank of the hit object; 0 for the surroundings */
    bool is_back;      /* the back face was hit, from inside */
};

/* Finds the nearest hit of a ray with a scene part, in its space. Returns false if it misses. */
bool tree_meet(const struct tree *tree, uint32_t part, const struct tree_ray *ray,
               struct tree_hit *hit);

/* Returns the medium index of the object with this rank; 0 for the outside. */
uint32_t tree_medium(const struct tree *tree, uint32_t rank);

/* Set of objects that enclose a point: the interior list of nested dielectrics (Schmidt and Budge
 * 2002). With up to TREE_SHELLS_FEW objects it is a bit mask in the first word, bit `rank` - 1;
 * else it holds the TREE_NESTED_MAX highest ranks, 16 bits each, in descending order. */
struct tree_shells {
    uint32_t words[TREE_NESTED_MAX / 2];
};

void tree_shells_put(struct tree_shells *shells, const struct tree *tree, uint32_t rank);
void tree_shells_remove(struct tree_shells *shells, const struct tree *tree, uint32_t rank);
bool tree_shells_has(const struct tree_shells *shells, const struct tree *tree, uint32_t rank);

/* Returns the set of objects that enclose a point. */
struct tree_shells tree_immerse(const struct tree *tree, vec3s point);

#endif
