/*
 * bvh.h: the scene's triangles at one time, and what a ray meets first, by Embree.
 *
 * A ray outside the object meets its front faces alone, and one inside its back faces alone: a
 * surface is never met again at the place where a ray begins, and walls inside do not count. Holes
 * of cut-out materials are no surface.
 *
 * Threads: bvh_meet() from any number at once.
 */
#ifndef FIRN_REFERENCE_BVH_H
#define FIRN_REFERENCE_BVH_H

#include <embree3/rtcore.h>
#include "src/base/status.h"
#include "src/reference/radiance.h"

enum {
    BVH_OBJECT,
    BVH_SURROUNDINGS,
    BVH_PART_COUNT,
};

#define BVH_NOWHERE UINT32_MAX /* bvh_ray.from: of no triangle */

struct bvh_ray {
    vec3s origin, dir; /* dir is unit */
    float near;        /* metres; what is nearer is not met */
    bool is_inside;    /* of the object */
    uint32_t from;     /* the object's triangle on which it begins */
};

struct bvh_hit {
    uint32_t part;              /* BVH_OBJECT ... */
    uint32_t triangle;          /* of the part's mesh */
    float distance;             /* metres */
    vec3s facet;                /* unit normal of the triangle as it is wound */
    struct mesh_vertex surface; /* the corners blended, in the world; the normal unit */
};

/* The scene with its triangles; {0} until bvh_init(). */
struct bvh {
    RTCScene scene;
    const struct radiance *radiance;

    struct bvh_part {
        const struct mesh *mesh;
        const vec3s *positions; /* in the world; the scene owns them */
    } parts[BVH_PART_COUNT];
};

/*
 * `radiance` is borrowed. `memory` is what it may take, in bytes: a scene that would need more is
 * refused before it is built. Logs: STATUS_TRY_AGAIN; *bvh is then {0}.
 */
MUST_USE enum status bvh_init(struct bvh *bvh, RTCDevice device, const struct radiance *radiance,
                              uint64_t memory);
void bvh_finish(struct bvh *bvh);

/* False where there is nothing on its way. */
bool bvh_meet(const struct bvh *bvh, const struct bvh_ray *ray, struct bvh_hit *hit);

#endif
