/*
 * bvh.h: ray intersection with the scene's triangles and bubbles at one point in time, by Embree.
 *
 * Self-intersection: a ray that starts on an object ignores the triangle on which it starts. It
 * also ignores faces of that object with the wrong orientation if they are closer than epsilon
 * (`hair`), or if interpolated normals have turned its direction to the wrong side (`is_astray`).
 * Cracks and planes of air closer than epsilon are ignored, as are holes of cutout materials.
 * Bubbles are intersected analytically (src/scene/bubble.h): a ray that starts on a bubble hits it
 * again only from inside.
 *
 * Thread safety: several threads may call bvh_meet() at the same time.
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
    BVH_AIR,        /* sheets of trapped air */
    BVH_MESH_COUNT, /* the parts above are triangle meshes */
    BVH_BUBBLES = BVH_MESH_COUNT,
};

#define BVH_NOWHERE UINT32_MAX /* bvh_ray.from of a ray that does not start on a surface */

struct bvh_ray {
    vec3s origin, dir; /* dir is unit length */
    float near;        /* metres; closer surfaces are ignored */
    bool is_inside;    /* the ray starts inside the object on whose surface its origin lies */
    bool is_astray;    /* its direction is on the wrong side, due to interpolated normals */
    uint32_t from;     /* triangle or bubble on which the ray starts, or BVH_NOWHERE */
    uint32_t part;     /* part of that primitive: BVH_OBJECT ... */
    uint32_t object;   /* object of that primitive */
};

struct bvh_hit {
    uint32_t part;     /* part that was hit: BVH_OBJECT ... */
    uint32_t triangle; /* triangle index in the part's mesh; for BVH_BUBBLES the bubble's index */
    uint32_t object;   /* object in the scene; a bubble's medium, frame_media_count(); else 0 */
    float u, v;        /* barycentric coordinates of the triangle's second and third vertex */
    float distance;    /* from the ray's origin, metres */
    vec3s facet;       /* unit geometric normal, by the triangle's winding; outward for a bubble */
    /* Derivatives of the position by uv set; 0 if the mesh has no textures, or where degenerate. */
    vec3s along_u[2], along_v[2];
    struct mesh_extra extra;    /* interpolated; {0} if the mesh has none */
    struct mesh_vertex surface; /* interpolated vertex in world space, with a unit normal */
};

/* The Embree scene of one frame; {0} until bvh_init(). */
struct bvh {
    RTCScene scene;
    const struct radiance *radiance;
    float hair;      /* epsilon, metres: largest rounding error of a ray's origin */
    bool is_dressed; /* at least one object has a textured material */

    struct bvh_part {
        const struct mesh *mesh;
        const vec3s *positions; /* in world space; owned by Embree */
    } parts[BVH_MESH_COUNT];

    struct bubble *bubbles; /* in world space; NULL if there are none */
};

/*
 * Builds the Embree scene. `radiance` is borrowed. `memory` is a limit in bytes: a larger scene is
 * refused before the build. Logs errors, returns STATUS_TRY_AGAIN and sets *bvh to {0}.
 */
MUST_USE enum status bvh_init(struct bvh *bvh, RTCDevice device, const struct radiance *radiance,
                              uint64_t memory);
void bvh_finish(struct bvh *bvh);

/* Finds the closest hit of a ray. Returns false if nothing is hit. */
bool bvh_meet(const struct bvh *bvh, const struct bvh_ray *ray, struct bvh_hit *hit);

#endif
