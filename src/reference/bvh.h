/*
 * bvh.h: intersects rays with the scene's triangles and bubbles at one time, by Embree.
 *
 * A ray that begins on an object's surface does not intersect the triangle on which it begins, nor,
 * very near or if it is astray, faces of that object that it could only see from the other side.
 * Cracks and planes of air are not intersected where they are nearer to its origin than `hair`,
 * nor are holes of cut-out materials. Bubbles are exact (src/scene/bubble.h): a ray that begins on
 * one meets it again only where it leaves its inside.
 *
 * Thread-safety: several threads may call bvh_meet() at the same time.
 */
#ifndef FIRN_REFERENCE_BVH_H
#define FIRN_REFERENCE_BVH_H

#include "src/base/status.h"
#include "src/reference/embree.h"
#include "src/reference/radiance.h"

enum {
    BVH_OBJECT,
    BVH_SURROUNDINGS,
    BVH_CRACKS,
    BVH_AIR,        /* planes of air */
    BVH_MESH_COUNT, /* the parts above are meshes */
    BVH_BUBBLES = BVH_MESH_COUNT,
};

#define BVH_NOWHERE UINT32_MAX /* bvh_ray.from: the ray begins on no triangle */

struct bvh_ray {
    vec3s origin, dir; /* dir is unit */
    float near;        /* metres; nearer surfaces are ignored */
    bool is_inside;    /* the ray begins inside the object on whose surface it begins */
    bool is_astray;    /* its direction is on the other side of the triangle, which only the
                          interpolated normal allows */
    uint32_t from;   /* the objects' triangle, or the bubble, on which it begins, or BVH_NOWHERE */
    uint32_t part;   /* of that: BVH_OBJECT ... */
    uint32_t object; /* of that triangle */
};

struct bvh_hit {
    uint32_t part;     /* BVH_OBJECT ... */
    uint32_t triangle; /* of the part's mesh; of BVH_BUBBLES: the bubble */
    uint32_t object;   /* of the scene; of a bubble: that of its medium, frame_media_count();
                          of other parts: 0 */
    float u, v;        /* shares of the triangle's second and third vertex */
    float distance;    /* metres */
    vec3s facet;       /* unit normal of the triangle, by its winding; of a bubble: outward */
    vec3s along_u[2], along_v[2]; /* derivatives of the world position by the vertices' uv, and by
                                     that of their extras, of the surroundings, and of objects if
                                     any has textures; 0 without an area in the texture */
    struct mesh_extra extra;      /* interpolated; {0} if there are none */
    struct mesh_vertex surface;   /* interpolated vertices in the world; the normal is unit */
};

/* The hierarchy of a scene; {0} until bvh_init(). */
struct bvh {
    RTCScene scene;
    const struct radiance *radiance;
    float hair;      /* metres: how near a ray's origin may be to a face by rounding alone */
    bool is_dressed; /* some object's material has textures */

    struct bvh_part {
        const struct mesh *mesh;
        const vec3s *positions; /* in the world; owned by Embree's scene */
    } parts[BVH_MESH_COUNT];

    struct bubble *bubbles; /* in the world; NULL: none */
};

/*
 * Builds the hierarchy. `radiance` is borrowed. `memory` is a limit in bytes: a scene that would
 * need more is refused before it is built. Logs and returns STATUS_TRY_AGAIN; *bvh is then {0}.
 */
MUST_USE enum status bvh_init(struct bvh *bvh, RTCDevice device, const struct radiance *radiance,
                              uint64_t memory);
void bvh_finish(struct bvh *bvh);

/* Finds the first intersection of a ray; returns false if there is none. */
bool bvh_meet(const struct bvh *bvh, const struct bvh_ray *ray, struct bvh_hit *hit);

#endif
