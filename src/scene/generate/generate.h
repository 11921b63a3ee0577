/*
 * generate.h: procedural objects, surroundings and inclusions.
 *
 * Triangle counts: each generator makes the mesh with the count closest to `triangles` that its
 * topology allows; the default counts are met exactly (Seipel and Nivfors 2006, section 4). Counts
 * above GENERATE_TRIANGLES_MAX are clamped. Closed objects are watertight (every edge belongs to
 * two triangles, which share its vertices), wound counter-clockwise seen from outside, centred at
 * the origin, with vertex normals; they are white and have material 0. Units are metres.
 *
 * Ownership: *mesh must be zeroed or finished; the caller finishes it. Errors: the functions return
 * false only when out of memory; *mesh is then zeroed.
 */
#ifndef FIRN_SCENE_GENERATE_GENERATE_H
#define FIRN_SCENE_GENERATE_GENERATE_H

#include "shaders/inclusions/bubbles.h"
#include "src/scene/bubble_intersect.h"
#include "src/scene/geometry/mesh.h"

enum {
    GENERATE_SPHERE_TRIANGLES = 960,
    GENERATE_ICE_CUBE_TRIANGLES = 4800,
    GENERATE_TEAPOT_TRIANGLES = 14400,
    GENERATE_LANDSCAPE_TRIANGLES = 2340,
    GENERATE_TRIANGLES_MAX = 1 << 20, /* about 200 MB */
    GENERATE_ORBITING_BALLS_MAX = 64,
    GENERATE_AIR_MAX = 64,
};

/* Generates a UV sphere with exact normals and the volume of the unit sphere. Vertices are slightly
 * outside the unit sphere, because flat facets enclose less volume. */
bool generate_sphere(struct mesh *mesh, uint32_t triangles);

/* Generates a rounded cube, about 1.6 m wide, of six grids of quads displaced by smooth noise. */
bool generate_ice_cube(struct mesh *mesh, uint32_t triangles);

/* Generates the Utah teapot from its 32 Bezier patches (Newell 1975). The teapot is about 2 m wide,
 * stands upright (+Y), and points its spout towards +X. It is one solid without inner walls. The
 * lid's gap and the spout's mouth are closed. Handle and spout are joined to the body. */
bool generate_teapot(struct mesh *mesh, uint32_t triangles);

/* Generates a valley between hills, 60 m wide. The valley's centre is 1.35 m below the origin. The
 * open surface faces up and is lit (not MESH_UNLIT). Its colour depends on height and slope. */
bool generate_landscape(struct mesh *mesh, uint32_t triangles);

/* Generates a level floor of pale tiles below an object. The floor shows the light that the object
 * transmits. The floor reaches the horizon, faces up, and is lit (not MESH_UNLIT). */
bool generate_floor(struct mesh *mesh, struct box object);

enum {
    GENERATE_STAGE_SIDES = 256,
    GENERATE_STAGE_RINGS = 34,
};

struct generate_stage {
    vec3s foot;       /* centre of the floor */
    float radius;     /* radius of the object; that of the floor is 300 times as large */
    float uv_scale;   /* texture repetitions per radius */
    vec3s near_color; /* vertex colour at the object */
    /* vertex colours at the horizon, clockwise from -Z as seen from above */
    vec3s far_colors[GENERATE_STAGE_SIDES];
};

/* Generates a round level floor that faces up, of concentric rings. Its vertex colours fade from
 * near_color to far_colors between 1.5 and 13 radii. Ring i, from the centre, has material i. */
bool generate_stage(struct mesh *mesh, const struct generate_stage *stage);

/* Returns the mean fraction of far_colors in a ring. */
float generate_stage_fade(uint32_t ring);

/* Generates a closed room, 11.7 x 6.3 x 9.9 m, with an off-centre table under the object. Walls,
 * floor and ceiling are tiled with coloured lines. A lamp and a window emit light. Vertex colours
 * are baked radiances (MESH_UNLIT), with shadows of the furniture. */
bool generate_room(struct mesh *mesh, struct box object);

/* Generates coloured balls (MESH_ORBITS) in a ring around a box. The box can rotate about +Y
 * without touching the balls. `count` is 1 to GENERATE_ORBITING_BALLS_MAX. */
bool generate_orbiting_balls(struct mesh *mesh, struct box box, uint32_t count);

struct generate_pool {
    float size, depth; /* water width and depth, metres */
    float ice;         /* width of floating ice, metres; 0 for none */
};

/* Generates the stone paving of a square pool at the origin, and the pool's walls above water. The
 * water level is 0. water.c draws the water, the floor and the submerged walls. */
bool generate_pool(struct mesh *mesh, const struct generate_pool *pool);

/* Generates floating ice in the pool's centre: a partly submerged ice cube of width pool->ice. */
bool generate_floating_ice(struct mesh *mesh, const struct generate_pool *pool, uint32_t triangles);

struct generate_air {
    uint32_t count, seed; /* number of planes, 1 to GENERATE_AIR_MAX */
    float size;           /* diameter of the largest bubbles, in box diagonals */
    float frequency;      /* number of the largest bubbles along the box diagonal */
    /* optional bubble opacities, 0 to 1, in GENERATE_AIR_LAYER_SIZE rows and columns, for all
     * layers; if NULL, opacities are generated */
    const float *opacity;
};

enum {
    GENERATE_AIR_LAYER_SIZE = 512, /* texture width and height, texels */
    GENERATE_AIR_LAYER_COUNT = 4,
};

/* Array texture of air planes. A texel's two bytes are the opacities of bubbles and of haze. */
struct air_layers {
    /* texels of all mip levels, in the layout of mip_levels.h; freed by the caller */
    uint8_t *texels;
    /* texels per side (a power of two), and number of layers; both 0 without air planes */
    uint32_t size, count;
};

/* Generates squares of milky air, randomly rotated about points near the box's centre. Each is as
 * wide as the box's diagonal. Texture coordinates span it. `material` is 1 + the layer index. */
bool generate_air_planes(struct mesh *mesh, struct box box, const struct generate_air *air);

/* Clips air planes to a k-DOP of the object. Returns false when out of memory; *planes is then
 * unchanged. */
bool generate_air_clip(struct mesh *planes, const struct mesh *object);

/* Generates textures for squares of milky air: haze that fades towards the edges, and bubbles of
 * three sizes. Each size is half as large and twice as frequent as the previous size. Returns false
 * when out of memory; *layers is then zeroed. */
bool generate_air_layers(struct air_layers *layers, const struct generate_air *air);

enum generate_bubbles_shape {
    GENERATE_BUBBLES_SPHERE,
    GENERATE_BUBBLES_PROLATE, /* elongated ellipsoids */
    GENERATE_BUBBLES_OBLATE,  /* flat ellipsoids */
    GENERATE_BUBBLES_CAPSULE,
    GENERATE_BUBBLES_MIXED, /* random mix of the shapes above */
    GENERATE_BUBBLES_GROWN, /* worm and egg shapes along the freezing direction */
    GENERATE_BUBBLES_SHAPE_COUNT,
};

struct generate_bubbles {
    uint32_t count, seed; /* number of bubbles, 1 to BUBBLES_COUNT_MAX */
    float size;           /* longest diameter of the largest bubble, in box diagonals */
    enum generate_bubbles_shape shape;
    float stretch; /* ratio of longest to shortest diameter, at least 1; unused by spheres */
    float rim; /* minimum distance of bubbles to the surface, relative to the box's shortest side */
};

/* Non-overlapping bubbles in object space. */
struct bubbles {
    struct bubble *all; /* the caller frees it */
    uint32_t count;
};

/* Generates many small and few large bubbles in a closed mesh. Their bounding spheres are inside if
 * the mesh is convex, else at least their centres. Bubbles without free space are omitted. Axes
 * point roughly to the centre. The shape does not change positions or longest diameters, except for
 * GENERATE_BUBBLES_GROWN: groups of parallel worms, strings of beads, and clumps of eggs. Returns
 * false when out of memory; *bubbles is then zeroed. */
bool generate_bubbles(struct bubbles *bubbles, const struct mesh *object,
                      const struct generate_bubbles *params);

struct generate_cracks {
    uint32_t count, seed;
    float size;
};

/* Generates `count` crack sheets (at most CRACKS_MAX) for an object that fills a box: about as
 * large as the box times `size`, near its centre, open, curved, irregular, partly outside. For a
 * given seed, a smaller count is a prefix of a larger one. If `custom_sheet` is not empty, all are
 * copies of this mesh, which fills the unit ball. Vertex colours are defined in
 * shaders/inclusions/cracks.h; copies of `custom_sheet` have a constant gap. */
bool generate_cracks(struct mesh *mesh, struct box box, const struct generate_cracks *params,
                     const struct mesh *custom_sheet);

#endif
