/* refract_trace.h: shared by refract_trace.c and refract_trace*.{glsl,frag}. */
#ifndef SHADERS_REFRACT_TRACE_H
#define SHADERS_REFRACT_TRACE_H
#include "abi.h"
#include "cloud.h"
#include "refract.h"
#include "tree.h"

/* Bindings, besides those of background.h and REFRACT_ENV_CUBE, which are not used together. */
#define TRACE_FRAME        12 /* struct trace_frame */
#define TRACE_NODES        13 /* the words of tree.h */
#define TRACE_TRIANGLES    14
#define TRACE_CORNERS      15
#define TRACE_FIRST_OBJECT 21 /* the layer `object`; of the layers' pass */
#define TRACE_CUBE_POINTS  22 /* the environment cube without a filter */
/* The words, too, if TRACE_IS_STORED. */
#define TRACE_STORED_NODES     18
#define TRACE_STORED_TRIANGLES 19
#define TRACE_STORED_CORNERS   20
#define TRACE_STRUCTURE        23 /* acceleration structure, with TRACE_QUERY */

/* Of the layers' pass, besides those of refract.h. */
#define TRACE_OUT_MEDIA 5
#define TRACE_OUT_LAST  6

/* Of the picture's pass with TRACE_SMOOTH, besides those of refract.h: trace_smooth.glsl. */
#define TRACE_OUT_GATHERED 2
#define TRACE_OUT_SHARE    3
#define TRACE_OUT_PLACE    4

/* CONSTANT_TRACE, bits */
#define TRACE_IS_CONVEX      1   /* one convex object: what leaves it does not enter again */
#define TRACE_HAS_CULLING    2   /* one closed object: a ray meets only faces that it can see */
#define TRACE_HAS_MEDIA      4   /* several objects, or thin walls */
#define TRACE_HAS_ROUGH      8   /* some object is rough */
#define TRACE_HAS_SHINE      16  /* some object is not wholly transmissive */
#define TRACE_HAS_MATERIALS  32  /* surroundings have rows in the texture of materials */
#define TRACE_HAS_HOLES      64  /* surroundings have holes, or blended surfaces */
#define TRACE_HAS_MOTION     128 /* objects, or what is around them, may turn */
#define TRACE_HAS_TINT       256 /* some object tints the light that passes its surface */
#define TRACE_HAS_DRESS      512 /* some object has textures (dress.h); needs TRACE_HAS_MATERIALS */
#define TRACE_HAS_EXTRAS     1024   /* some vertices have struct mesh_extra */
#define TRACE_HAS_SUN        2048   /* the sun's light goes by the map of ice_caustics.h */
#define TRACE_HAS_MANY       4096   /* more than TREE_SHELLS_FEW objects */
#define TRACE_HAS_INCLUSIONS 8192   /* bubbles or cracks in the first object */
#define TRACE_HAS_SHAPES     16384  /* some bubble is no sphere */
#define TRACE_HAS_GROUND     32768  /* light on surroundings is traced; with TRACE_RAYS */
#define TRACE_HAS_CLOUD      65536  /* some ice is cloudy; with TRACE_RAYS */
#define TRACE_IS_STORED      131072 /* the words of trees are in storage buffers */
#define TRACE_HAS_FOOTPRINT  262144 /* trace_footprint.glsl; with TRACE_RAYS */

/* The texels of a medium in trace_frame.media. */
#define TRACE_IOR    0 /* of red, green and blue light; roughness */
#define TRACE_ABSORB 1 /* 1 / metre; shine */
#define TRACE_TINT   2 /* of light that passes the surface; 1: thin, below 0: -1 - its cloud */
#define TRACE_MEDIUM 3

#define TRACE_CLOUDS_MAX 8

/* What a frame needs, besides struct globals; written once a frame. */
struct trace_frame {
    vec4s media[(TREE_MEDIA_MAX + 1) * TRACE_MEDIUM]; /* by medium; the first one is outside */
    ABI_STRUCT(cloud_place) clouds[TRACE_CLOUDS_MAX];
    vec4s guide;                     /* as of ground.h */
    vec4s objects_turn, movers_turn; /* trace_pose() of trace_tree.glsl */
    vec4s grid_low, grid_scale;      /* struct tree; w: 0 */
    uint32_t roots[TREE_PART_COUNT];
    uint32_t parts;                       /* that have triangles, a bit each */
    uint32_t inside[TREE_NESTED_MAX / 2]; /* struct tree_shells of the eye */
    uint32_t media_at, grid_at;           /* struct tree */
    uint32_t sample_index;                /* of the picture, from 0 */
    uint32_t ice;                         /* rank of the object that has the inclusions */
    uint32_t is_in_bubble;                /* 1: the eye is */
    float crack_slope;                    /* of the roughness of cracks; 0: they are smooth */
    float crack_gap;                      /* in their middle, micrometres */
    float branch;                         /* share of a path's light that is followed apart */
    float hair;        /* metres: how near a ray's origin may be to a face by rounding alone */
    uint32_t one;      /* 1: compilers must not know */
    uint32_t is_apart; /* 1: nothing that is around the objects is in a box around them */
};

#endif
