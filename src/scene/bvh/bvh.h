/*
 * bvh.h: bounding volume hierarchies (BVHs) of a scene, in the GPU's memory layout.
 *
 * Binary BVHs, built with the binned surface area heuristic (Wald 2007, On fast Construction of
 * SAH-based Bounding Volume Hierarchies): one for each part of the scene that moves rigidly. An
 * animated model has one for each object, below a top-level BVH. All data is in 16-byte words
 * (shaders/trace/bvh_layout.h), and does not depend on the number of threads.
 *
 * Ownership: a BVH owns its arrays; bvh_finish() frees them; a zeroed BVH is valid and empty.
 * Thread-safety: several threads may call bvh_intersect() at the same time.
 */
#ifndef FIRN_SCENE_BVH_BVH_H
#define FIRN_SCENE_BVH_BVH_H

#include <stddef.h>
#include "shaders/trace/bvh_layout.h"
#include "src/base/status.h"
#include "src/scene/coincident_shells.h"
#include "src/scene/generate/generate.h"
#include "src/scene/import/model.h"

struct bvh_words {
    uint32_t (*all)[4];
    uint32_t count;
};

struct bvh {
    struct bvh_words nodes, triangles, corners;
    uint32_t triangle_count;
    uint32_t roots[BVH_COUNT]; /* root nodes; BVH_NONE for empty parts */
    uint32_t object_count;     /* number of refractive objects, >= 1 */
    /* number of distinct media; 0 if there is no medium table */
    uint32_t medium_count;
    uint32_t media; /* start of the medium table in `corners`; 0 if there is none */
    /* SAH costs, in ray-triangle tests; 0 for parts without triangles */
    double costs[BVH_COUNT];
    uint32_t depth; /* maximum node depth from a root, at most BVH_DEPTH_MAX */
    bool is_closed; /* true if the objects' mesh is closed (each edge has an opposite) */
    /* true if no triangle of the surroundings overlaps the objects' bounding box */
    bool surroundings_are_apart;
    bool is_disjoint_rotating; /* surroundings_are_apart holds for all object rotations about +Y */
    bool has_contacts;         /* some triangles have BVH_CONTACT */
    bool is_stored; /* BVH is too large for the device's texel buffers; set by the caller */
    double ms;      /* duration of bvh_init(), milliseconds */
    /* numbers of object BVHs that were built, copied from similar objects, or refitted */
    uint32_t built, shared, refitted;
    uint32_t read; /* number of BVHs loaded from cache files */
};

struct bvh_two_level;

/* Rest pose that all poses of an animated model share: the model, and its BVH topologies. A pose
 * keeps the topology and refits the boxes, so that its data does not depend on earlier poses. The
 * BVH of a deforming object is rebuilt once its SAH cost exceeds 1.5 times that of the rest pose
 * (1.1 times for a BVH of a whole part). Rigid motion and uniform scaling never cause a rebuild. */
struct bvh_rest_pose {
    bool by_objects;    /* true if each object has its own BVH */
    struct model model; /* model of which only meshes, objects and surroundings_starts are set */
    struct mesh_order sorted;          /* triangle order of the surroundings */
    bool is_known;                     /* true after bvh_rest_pose_move_from() */
    struct bvh_two_level *hierarchies; /* each scene part's BVH topology, set by bvh_init() */
};

struct bvh_rest_pose *bvh_rest_pose_create(bool by_objects); /* returns NULL when out of memory */
void bvh_rest_pose_destroy(struct bvh_rest_pose *rest);

/* Moves the mesh data of `model` and *sorted into `rest`, unless `rest` already has a model. */
void bvh_rest_pose_move_from(struct bvh_rest_pose *rest, struct model *model,
                             struct mesh_order *sorted);

/* Input of bvh_init(), borrowed. Everything but `model` may be NULL or 0. */
struct bvh_params {
    const struct model *model;                /* model with ranked objects (medium priorities) */
    struct mesh_order sorted;                 /* triangle order of the surroundings */
    const struct mesh *cracks;                /* crack sheets inside the ice */
    const struct bubbles *bubbles;            /* bubbles inside the ice */
    const struct coincident_shells *contacts; /* contacts between the objects' surfaces */
    struct bvh_rest_pose *rest;               /* rest pose; NULL without animation */
    uint32_t threads;                         /* maximum number of threads; 0 for one per core */
    bool is_cached; /* true to cache large BVHs in files; only rest-pose BVHs if animated */
};

/* Builds the BVHs of a model. If this fails, logs an error and zeroes *bvh. Returns
 * STATUS_TRY_AGAIN if out of memory, STATUS_DATA if there are too many triangles
 * (BVH_TRIANGLES_MAX), objects (BVH_OBJECTS_MAX) or materials (BVH_MEDIA_MAX). */
MUST_USE enum status bvh_init(struct bvh *bvh, const struct bvh_params *params);

void bvh_finish(struct bvh *bvh);

/* Returns the number of nodes of all scene parts; 0 before bvh_init(). */
uint32_t bvh_node_count(const struct bvh *bvh);

/* Returns the size of the largest of the node, triangle and corner arrays, in 16-byte words. */
uint32_t bvh_words_max(const struct bvh *bvh);

size_t bvh_size(const struct bvh *bvh);

struct bvh_ray {
    vec3s origin, dir;
    double near; /* distance that a hit must exceed, in lengths of `dir` */
    /* hits at the distance `near` also count if their triangle has a higher index; or BVH_NONE */
    uint32_t from;
};

struct bvh_hit {
    /* hit distance in lengths of `dir`; barycentric coordinates of the second and third corner */
    double t, u, v;
    uint32_t triangle; /* index in the BVH's triangle array */
    uint32_t rank;     /* medium priority (rank) of the hit object; 0 for surroundings */
    bool is_back;      /* the back face was hit */
};

/* Finds a ray's nearest hit in a scene part, in the part's own space. Of equally distant hits,
 * finds the triangle of lowest index. Returns false for a miss. */
bool bvh_intersect(const struct bvh *bvh, uint32_t part, const struct bvh_ray *ray,
                   struct bvh_hit *hit);

/* Returns the medium index of the object with medium priority `rank`; 0 for the air outside. */
uint32_t bvh_medium(const struct bvh *bvh, uint32_t rank);

/* Interior list of nested dielectrics (Schmidt and Budge 2002): priorities (ranks) of the objects
 * that enclose a point. For up to BVH_MASK_OBJECTS_MAX objects, words[0] is a mask; an object sets
 * bit rank-1. For more, `words` holds the highest ranks in descending order, 16 bits each. */
struct bvh_interior_list {
    uint32_t words[BVH_INTERIOR_LIST_MAX / 2];
};

void bvh_interior_list_insert(struct bvh_interior_list *list, const struct bvh *bvh, uint32_t rank);
void bvh_interior_list_remove(struct bvh_interior_list *list, const struct bvh *bvh, uint32_t rank);
bool bvh_interior_list_contains(const struct bvh_interior_list *list, const struct bvh *bvh,
                                uint32_t rank);

struct bvh_interior_list bvh_interior_list_at(const struct bvh *bvh, vec3s point);

#endif
