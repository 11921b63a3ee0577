/* refract_trace.h: bindings, flags and uniforms of the ray tracer. */
#ifndef SHADERS_TRACE_REFRACT_TRACE_H
#define SHADERS_TRACE_REFRACT_TRACE_H
#include "abi.h"
#include "inclusions/medium_density.h"
#include "refract/refract.h"
#include "trace/bvh_layout.h"

/* Bindings of the ray tracer, in addition to those of surroundings.h or REFRACT_ENV_CUBE. */
#define TRACE_FRAME       12 /* struct trace_frame */
#define TRACE_NODES       13 /* BVH nodes, texel buffer (bvh_layout.h) */
#define TRACE_TRIANGLES   14
#define TRACE_CORNERS     15
#define TRACE_CUBE_POINTS 22 /* the environment cube with nearest filtering */
/* Bindings of the BVH's storage buffers, used with TRACE_HAS_STORAGE_BUFFERS. */
#define TRACE_STORED_NODES     18
#define TRACE_STORED_TRIANGLES 19
#define TRACE_STORED_CORNERS   20
#define TRACE_STRUCTURE        23 /* acceleration structure, with TRACE_QUERY */

/* Colour targets of the image pass with TRACE_DENOISE, in addition to those of refract.h. */
#define TRACE_OUT_LIGHT      2
#define TRACE_OUT_THROUGHPUT 3
#define TRACE_OUT_POSITION   4

/* bits of the specialisation constant CONSTANT_TRACE */
#define TRACE_IS_CONVEX             1     /* single convex object: rays never re-enter */
#define TRACE_HAS_CULLING           2     /* single closed object: enables face culling */
#define TRACE_HAS_MEDIA             4     /* several objects, contacts or thin walls */
#define TRACE_HAS_ROUGH             8     /* some object has a rough surface */
#define TRACE_HAS_OPACITY           16    /* some object is not fully transmissive */
#define TRACE_HAS_MATERIALS         32    /* surroundings use the material texture */
#define TRACE_HAS_HOLES             64    /* surroundings have alpha-tested or blended surfaces */
#define TRACE_HAS_MOTION            128   /* objects or surroundings may rotate */
#define TRACE_HAS_TINT              256   /* some object tints transmitted light */
#define TRACE_HAS_TEXTURED_OBJECTS  512   /* some object is textured */
#define TRACE_HAS_EXTRAS            1024  /* some vertices have a struct mesh_extra */
#define TRACE_HAS_SUN_MAPS          2048  /* sunlight from the caustic map */
#define TRACE_HAS_MANY_OBJECTS      4096  /* more than BVH_MASK_OBJECTS_MAX objects */
#define TRACE_HAS_INCLUSIONS        8192  /* first object has bubbles or cracks */
#define TRACE_HAS_SHAPES            16384 /* some bubble is not a sphere */
#define TRACE_HAS_DIFFUSE_LIGHT     32768 /* ray-traced lighting of surroundings; with TRACE_RAYS */
#define TRACE_HAS_SCATTERING        65536 /* some ice scatters; requires TRACE_RAYS */
#define TRACE_HAS_STORAGE_BUFFERS   131072 /* BVH in storage, not texel buffers */
#define TRACE_HAS_RAY_DIFFERENTIALS 262144 /* requires TRACE_RAYS */
#define TRACE_HAS_CONTACTS          524288 /* surfaces of shells coincide; with HAS_MEDIA */

/* Vectors of a medium in trace_frame.media. */
#define TRACE_IOR    0 /* rgb: refractive indices; a: roughness */
#define TRACE_ABSORB 1 /* rgb: absorption, 1/m; a: opacity */
/* rgb: tint; a: 1 for thin walls, -1 - i for scattering medium i, else 0 */
#define TRACE_TINT   2
#define TRACE_MEDIUM 3

/* Uniform data of the ray tracer in addition to struct globals; written once per frame. */
struct trace_frame {
    vec4s media[(BVH_MEDIA_MAX + 1) * TRACE_MEDIUM]; /* first the outside */
    ABI_STRUCT(medium_field) scattering_media[MEDIUM_MAX];
    vec4s guide; /* guide distribution for diffuse rays (diffuse_sampling.h) */
    vec4s objects_rotation, movers_rotation; /* vertical-axis rotations, see trace_bvh_pose() */
    uint32_t roots[BVH_COUNT];
    uint32_t bvh_mask;                          /* bit mask of non-empty BVHs */
    uint32_t inside[BVH_INTERIOR_LIST_MAX / 2]; /* medium stack at the camera */
    uint32_t media_at;     /* start of the medium table in the corners buffer */
    uint32_t sample_index; /* index of the pixel's sample */
    uint32_t ice;          /* medium priority of the ice with inclusions */
    uint32_t is_in_bubble; /* 1: camera inside a bubble */
    float crack_rms_slope; /* crack roughness, RMS slope, or 0 */
    float crack_gap;       /* maximum crack gap width, micrometres */
    float branch;          /* minimum throughput to split a path */
    float epsilon;         /* rounding error of ray origins, metres */
    float contact;         /* maximum distance of surfaces in contact, metres */
    uint32_t one; /* always 1; stops compilers from turning one-iteration loops into branches */
    uint32_t surroundings_are_apart; /* 1: surroundings are outside the objects' bounding box */
};

#endif
