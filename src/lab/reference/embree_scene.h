/*
 * embree_scene.h: ray intersection with the scene's meshes and bubbles at one time, by Embree.
 *
 * Self-intersection is avoided without offsets: a ray ignores the triangle on which it starts. It
 * also ignores faces of the same object with the wrong orientation if they are closer than epsilon,
 * or if interpolated normals gave the ray a direction on the wrong side (`is_wrong_side`). Cracks
 * and planes of air closer than epsilon are ignored. At a contact with another shell, a face that
 * is closer than epsilon is ignored if it does not change the set of objects around the ray.
 * Bubbles are intersected analytically (src/scene/bubble_intersect.h): a ray that starts on a
 * bubble hits it again only from inside.
 *
 * Thread safety: several threads may call embree_scene_intersect() at the same time.
 */
#ifndef FIRN_LAB_REFERENCE_EMBREE_SCENE_H
#define FIRN_LAB_REFERENCE_EMBREE_SCENE_H

#include "src/base/status.h"
#include "src/lab/reference/embree_compat.h"
#include "src/lab/reference/nested_media.h"
#include "src/lab/reference/surroundings_radiance.h"

enum {
    EMBREE_SCENE_OBJECT,
    EMBREE_SCENE_SURROUNDINGS,
    EMBREE_SCENE_CRACKS,
    EMBREE_SCENE_AIR,        /* sheets of trapped air */
    EMBREE_SCENE_MESH_COUNT, /* number of triangle meshes */
    EMBREE_SCENE_BUBBLES = EMBREE_SCENE_MESH_COUNT,
    EMBREE_SCENE_FOUND_MAX = 16 /* see struct embree_scene_search */
};

#define EMBREE_SCENE_NO_ORIGIN UINT32_MAX /* the ray starts on no surface */

/* Enumerates hits on objects that are at about the same distance. */
struct embree_scene_search {
    uint32_t found[EMBREE_SCENE_FOUND_MAX]; /* last triangles found, which are not found again */
    uint32_t count;                         /* number of triangles found; may exceed the maximum */
};

struct embree_scene_ray {
    vec3s origin, dir;                        /* `dir` is unit length */
    float near;                               /* minimum hit distance, metres */
    float far;                                /* maximum hit distance, metres; 0 for infinity */
    bool is_inside;                           /* the ray starts inside `object` */
    bool is_wrong_side;                       /* interpolated normals made its direction wrong */
    uint32_t from;                            /* triangle or bubble of origin */
    uint32_t kind;                            /* EMBREE_SCENE_... of `from` */
    uint32_t object;                          /* object of `from` */
    const struct nested_media_set *inside;    /* objects around the origin; NULL if unknown */
    const struct embree_scene_search *search; /* NULL to find the closest hit */
};

struct embree_scene_hit {
    uint32_t kind;     /* EMBREE_SCENE_... that was hit */
    uint32_t triangle; /* triangle of the mesh, or bubble */
    uint32_t object;   /* object hit, or the bubbles' medium */
    float u, v;        /* weights of vertices 1 and 2 */
    float distance;    /* from the ray's origin, metres */
    vec3s facet;       /* unit geometric normal; outward for bubbles */
    /* Position derivatives dp/du and dp/dv per uv set; 0 if the set is unused or degenerate. */
    vec3s dp_du[2], dp_dv[2];
    struct mesh_extra extra;    /* {0} if the mesh has none */
    struct mesh_vertex surface; /* interpolated vertex, in world space */
};

/* Embree scene of one frame. */
struct embree_scene {
    RTCScene scene;
    const struct radiance *radiance;
    float epsilon;    /* maximum rounding error of origins, metres */
    bool is_textured; /* some object has a textured material */

    struct embree_scene_mesh {
        const struct mesh *mesh;
        const vec3s *positions; /* in world space; owned by Embree */
    } meshes[EMBREE_SCENE_MESH_COUNT];

    struct bubble *bubbles; /* in world space; may be NULL */
};

/*
 * Builds the Embree scene, which borrows `radiance`. If out of memory, or if the build needs more
 * than `memory` bytes, logs an error, zeroes *embree_scene and returns STATUS_TRY_AGAIN.
 */
MUST_USE enum status embree_scene_init(struct embree_scene *embree_scene, RTCDevice device,
                                       const struct radiance *radiance, uint64_t memory);
void embree_scene_finish(struct embree_scene *embree_scene);

static inline void embree_scene_search_add(struct embree_scene_search *search, uint32_t triangle)
{
    search->found[search->count++ % EMBREE_SCENE_FOUND_MAX] = triangle;
}

/* Returns true if a hit is on a triangle at a contact (src/scene/coincident_shells.h). */
bool embree_scene_is_at_contact(const struct embree_scene *embree_scene,
                                const struct embree_scene_hit *hit);

/* Finds the closest hit of a ray. Returns false if nothing is hit. */
bool embree_scene_intersect(const struct embree_scene *embree_scene,
                            const struct embree_scene_ray *ray, struct embree_scene_hit *hit);

#endif
