/*
 * bvh.h: bounding volume hierarchies (BVHs) of a scene, in the layout of shaders.
 *
 * Binary BVHs, built with the binned surface area heuristic (Wald 2007, On fast Construction of
 * SAH-based Bounding Volume Hierarchies): one for each part of the scene that moves rigidly. An
 * animated model has one for each object, below a top-level BVH. All data is in 16-byte words
 * (shaders/trace/bvh_layout.h), and does not depend on the number of threads.
 *
 * Ownership:     a BVH owns its arrays; bvh_finish() frees them; a {0} BVH is fine, and empty.
 * Thread-safety: several threads may call bvh_intersect() at the same time.
 */
#ifndef FIRN_SCENE_BVH_BVH_H
#define FIRN_SCENE_BVH_BVH_H

#include <stddef.h>
#include "shaders/trace/bvh_layout.h"
#include "src/base/status.h"
#include "src/scene/generate/generate.h"
#include "src/scene/import/model.h"

struct bvh_words {
    uint32_t (*all)[4];
    uint32_t count;
};

struct bvh {
    struct bvh_words nodes, triangles, corners;
    uint32_t triangle_count;
    uint32_t roots[BVH_PART_COUNT]; /* root nodes; BVH_NONE for a part without triangles */
    uint32_t shells;                /* number of refractive objects, at least 1 */
    uint32_t medium_count; /* distinct media of more than BVH_MASK_OBJECTS_MAX objects; else 0 */
    uint32_t media;        /* index in `corners` of the medium of rank 0; 0 if there is none */
    uint32_t grid;         /* index in `corners` of the horizon grid; 0 if there is none */
    vec3s grid_low, grid_scale;   /* minimum corner of the horizon grid; cells per metre */
    double costs[BVH_PART_COUNT]; /* SAH costs, in ray-triangle tests; 0 without triangles */
    uint32_t depth;               /* deepest node, counted from a root; at most BVH_DEPTH_MAX */
    bool is_closed;               /* the objects' mesh is closed: each edge has an opposite edge */
    bool
        /* no triangle's box in the surroundings overlaps the objects' box */
        surroundings_are_apart;
    bool
        /* surroundings_are_apart at any rotation about +Y; false if anything else moves */
        is_disjoint_rotating;
    bool is_stored; /* too large for texel buffers of the device; set by the caller */
    double ms;      /* duration of bvh_init(), milliseconds */
    uint32_t built, shared, refitted; /* how many object BVHs were built, copied, or refitted */
    uint32_t read; /* number of BVHs loaded from cache files, of objects and of all other parts */
};

struct bvh_two_level;

/*
 * Rest pose that all poses of an animated model share: the model, and its BVH topologies. A pose
 * keeps the topology and refits the boxes, so that its data does not depend on earlier poses. The
 * BVH of a deforming object is rebuilt once its SAH cost exceeds 1.5 times that of the rest pose;
 * that of a whole part, 1.1 times. Rigid motion and uniform scaling never cause a rebuild.
 */
struct bvh_rest_pose {
    bool by_objects;          /* one BVH per object; if false, one BVH per part, with horizons */
    struct model model;       /* only its meshes, objects and surroundings_starts */
    struct mesh_order sorted; /* triangle order of its surroundings */
    bool is_known;            /* false until the first bvh_init(), whose model is the rest pose */
    struct bvh_two_level *shapes; /* topology of each part; set by the first bvh_init() */
};

struct bvh_rest_pose *bvh_rest_pose_create(bool by_objects); /* returns NULL when out of memory */
void bvh_rest_pose_destroy(struct bvh_rest_pose *rest);

/* Moves meshes, objects, surroundings_starts and *sorted into `rest`, unless it has a rest pose. */
void bvh_rest_pose_move_from(struct bvh_rest_pose *rest, struct model *model,
                             struct mesh_order *sorted);

/* Input of bvh_init(), borrowed. Everything but `model` may be NULL or 0. */
struct bvh_params {
    const struct model *model;     /* model whose objects have ranks (medium priorities) */
    struct mesh_order sorted;      /* triangle order of its surroundings */
    const struct mesh *cracks;     /* crack sheets inside the ice */
    const struct bubbles *bubbles; /* bubbles inside the ice */
    struct bvh_rest_pose *rest;    /* rest pose of an animated model; NULL if it is not animated */
    uint32_t threads;              /* maximum number of threads; 0 for one per core */
    bool is_cached; /* cache large BVHs (for poses, those of the rest pose) in files */
};

/*
 * Builds the BVHs of a model. Logs and returns STATUS_TRY_AGAIN when out of memory, or STATUS_DATA
 * for more than BVH_TRIANGLES_MAX triangles, BVH_OBJECTS_MAX objects, or BVH_MEDIA_MAX object
 * materials; *tree is then {0}.
 */
MUST_USE enum status bvh_init(struct bvh *bvh, const struct bvh_params *params);

void bvh_finish(struct bvh *bvh);

/* Returns the number of nodes of all parts; 0 before the BVH is built. */
uint32_t bvh_node_count(const struct bvh *bvh);

/* Returns the size of the largest array (nodes, triangles or corners) in 16-byte words. */
uint32_t bvh_words_max(const struct bvh *bvh);

/* Returns the size of all arrays in bytes. */
size_t bvh_size(const struct bvh *bvh);

struct bvh_ray {
    vec3s origin, dir;
    double near;   /* minimum hit distance, exclusive, in lengths of `dir` */
    uint32_t from; /* triangle to ignore, where the ray starts; BVH_NONE for none */
};

struct bvh_hit {
    double t, u, v;    /* distance in lengths of `dir`; weights of the second and third corner */
    uint32_t triangle; /* index in the BVH's triangle array */
    uint32_t rank;     /* rank of the hit object; 0 for the surroundings */
    bool is_back;      /* the back face was hit, from inside */
};

/* Finds the nearest hit of a ray with a scene part, in its space. Returns false if it misses. */
bool bvh_intersect(const struct bvh *bvh, uint32_t part, const struct bvh_ray *ray,
                   struct bvh_hit *hit);

/* Returns the medium index of the object with this rank; 0 for the outside. */
uint32_t bvh_medium(const struct bvh *bvh, uint32_t rank);

/* Set of objects that enclose a point: the interior list of nested dielectrics (Schmidt and Budge
 * 2002). With up to BVH_MASK_OBJECTS_MAX objects it is a bit mask in the first word, bit `rank` -
 * 1; else it holds the BVH_INTERIOR_LIST_MAX highest ranks, 16 bits each, in descending order. */
struct bvh_interior_list {
    uint32_t words[BVH_INTERIOR_LIST_MAX / 2];
};

void bvh_interior_list_insert(struct bvh_interior_list *shells, const struct bvh *bvh,
                              uint32_t rank);
void bvh_interior_list_remove(struct bvh_interior_list *shells, const struct bvh *bvh,
                              uint32_t rank);
bool bvh_interior_list_contains(const struct bvh_interior_list *shells, const struct bvh *bvh,
                                uint32_t rank);

/* Returns the set of objects that enclose a point. */
struct bvh_interior_list bvh_interior_list_at(const struct bvh *bvh, vec3s point);

#endif
