/*
 * embree_scene.h: ray intersection with the scene's triangles and bubbles at one point in time, by
 * Embree.
 *
 * Self-intersection: a ray that starts on an object ignores the triangle on which it starts. It
 * also ignores faces of that object with the wrong orientation if they are closer than epsilon
 * (`hair`), or if interpolated normals have turned its direction to the wrong side
 * (`is_wrong_side`). Cracks and planes of air closer than epsilon are ignored, as are holes of
 * cutout materials. Bubbles are intersected analytically (src/scene/bubble.h): a ray that starts on
 * a bubble hits it again only from inside.
 *
 * Thread safety: several threads may call embree_scene_intersect() at the same time.
 */
#ifndef FIRN_REFERENCE_EMBREE_SCENE_H
#define FIRN_REFERENCE_EMBREE_SCENE_H

#include "src/base/status.h"
#include "src/reference/embree.h"
#include "src/reference/radiance.h"

enum {
    EMBREE_SCENE_OBJECT,
    EMBREE_SCENE_SURROUNDINGS,
    EMBREE_SCENE_CRACKS,
    EMBREE_SCENE_AIR,        /* sheets of trapped air */
    EMBREE_SCENE_MESH_COUNT, /* the parts above are triangle meshes */
    EMBREE_SCENE_BUBBLES = EMBREE_SCENE_MESH_COUNT,
};

#define EMBREE_SCENE_NO_ORIGIN \
    UINT32_MAX /* embree_scene_ray.from of a ray that does not start on a surface */

struct embree_scene_ray {
    vec3s origin, dir;  /* dir is unit length */
    float near;         /* metres; closer surfaces are ignored */
    bool is_inside;     /* the ray starts inside the object on whose surface its origin lies */
    bool is_wrong_side; /* its direction is on the wrong side, due to interpolated normals */
    uint32_t from;      /* triangle or bubble on which the ray starts, or EMBREE_SCENE_NO_ORIGIN */
    uint32_t part;      /* part of that primitive: EMBREE_SCENE_OBJECT ... */
    uint32_t object;    /* object of that primitive */
};

struct embree_scene_hit {
    uint32_t part; /* part that was hit: EMBREE_SCENE_OBJECT ... */
    uint32_t
        /* triangle index in the part's mesh; for EMBREE_SCENE_BUBBLES the bubble's index */
        triangle;
    uint32_t object; /* object in the scene; a bubble's medium, frame_media_count(); else 0 */
    float u, v;      /* barycentric coordinates of the triangle's second and third vertex */
    float distance;  /* from the ray's origin, metres */
    vec3s facet;     /* unit geometric normal, by the triangle's winding; outward for a bubble */
    /* Derivatives of the position by uv set; 0 if the mesh has no textures, or where degenerate. */
    vec3s u_dir[2], along_v[2];
    struct mesh_extra extra;    /* interpolated; {0} if the mesh has none */
    struct mesh_vertex surface; /* interpolated vertex in world space, with a unit normal */
};

/* The Embree scene of one frame; {0} until embree_scene_init(). */
struct embree_scene {
    RTCScene scene;
    const struct radiance *radiance;
    float epsilon;    /* epsilon, metres: largest rounding error of a ray's origin */
    bool is_textured; /* at least one object has a textured material */

    struct embree_scene_part {
        const struct mesh *mesh;
        const vec3s *positions; /* in world space; owned by Embree */
    } parts[EMBREE_SCENE_MESH_COUNT];

    struct bubble *bubbles; /* in world space; NULL if there are none */
};

/*
 * Builds the Embree scene. `radiance` is borrowed. `memory` is a limit in bytes: a larger scene is
 * refused before the build. Logs errors, returns STATUS_TRY_AGAIN and sets *bvh to {0}.
 */
MUST_USE enum status embree_scene_init(struct embree_scene *embree_scene, RTCDevice device,
                                       const struct radiance *radiance, uint64_t memory);
void embree_scene_finish(struct embree_scene *embree_scene);

/* Finds the closest hit of a ray. Returns false if nothing is hit. */
bool embree_scene_intersect(const struct embree_scene *embree_scene,
                            const struct embree_scene_ray *ray, struct embree_scene_hit *hit);

#endif
