/*
 * generate.h: procedural objects, surroundings and inclusions.
 *
 * Triangle counts: each generator makes the mesh with the count closest to `triangles` that its
 * topology allows; the default counts are met exactly (Seipel and Nivfors 2006, section 4). Counts
 * above GENERATE_TRIANGLES_MAX are clamped. The closed objects are watertight (every edge belongs
 * to two triangles, which share its vertices), wound counter-clockwise seen from outside, centred
 * on the origin, with vertex normals; they are white and their material is 0. Units are metres.
 *
 * Ownership: *mesh must be {0} or finished; the caller finishes it.
 * Errors:    the functions return false only when out of memory; *mesh is then {0}.
 */
#ifndef FIRN_SCENE_GENERATE_GENERATE_H
#define FIRN_SCENE_GENERATE_GENERATE_H

#include "shaders/bubbles.h"
#include "src/scene/bubble.h"
#include "src/scene/mesh.h"

enum {
    GENERATE_SPHERE_TRIANGLES = 960,
    GENERATE_ICE_CUBE_TRIANGLES = 4800,
    GENERATE_TEAPOT_TRIANGLES = 14400,
    GENERATE_LANDSCAPE_TRIANGLES = 2340,
    GENERATE_TRIANGLES_MAX = 1 << 20, /* some 200 MB */
    GENERATE_MOVERS_MAX = 64,
    GENERATE_AIR_MAX = 64,
};

/* A sphere of longitudes and latitudes with the unit sphere's volume: the vertices are a little
 * outside of the unit sphere. Normals are exact. */
bool generate_sphere(struct mesh *mesh, uint32_t triangles);

/* An irregular rounded cube, about 1.6 m wide: six grids of squares, displaced by smooth noise. */
bool generate_ice_cube(struct mesh *mesh, uint32_t triangles);

/*
 * The Utah teapot from its 32 Bezier patches (Newell 1975), about 2 m wide, standing upright
 * (+Y), its spout toward +X. It is solid, one surface without inner walls: the gap between lid and
 * rim and the spout's mouth are closed, handle and spout are joined to the body.
 */
bool generate_teapot(struct mesh *mesh, uint32_t triangles);

/*
 * A valley with hills around it, 60 m wide, 1.35 m below the origin in the middle. It is an open
 * surface that faces up, lit (not MESH_UNLIT), coloured by height and slope.
 */
bool generate_landscape(struct mesh *mesh, uint32_t triangles);

/*
 * A level floor of pale tiles under the object, up to the horizon, which shows the light that the
 * object transmits. Lit, facing up.
 */
bool generate_floor(struct mesh *mesh, struct box object);

/*
 * A closed room, 11.7 x 6.3 x 9.9 m, with a table under the object, which is off its middle. Walls,
 * floor and ceiling are tiled with coloured lines, a lamp and a window are bright. Colours are
 * radiances (MESH_UNLIT) that contain the shadows of furniture.
 */
bool generate_room(struct mesh *mesh, struct box object);

/*
 * Coloured balls of MESH_MOVES in a ring around a box; `count` is from 1 to GENERATE_MOVERS_MAX.
 * They stay outside the sphere around the box at any angle about its vertical axis.
 */
bool generate_movers(struct mesh *mesh, struct box box, uint32_t count);

struct generate_pool {
    float size, depth; /* of the water, metres */
    float ice;         /* width of the floating ice, metres; 0: none */
};

/* The surroundings of a square pool around the origin, with the water at height 0: the walls' upper
 * ends and the stone around the pool. Water, floor and walls below it are drawn by water.c. */
bool generate_pool(struct mesh *mesh, const struct generate_pool *pool);

/* The floating ice: the ice cube, in the middle, of width pool->ice, as deep in the water as a box
 * of ice. */
bool generate_floe(struct mesh *mesh, const struct generate_pool *pool, uint32_t triangles);

struct generate_air {
    uint32_t count, seed; /* number of planes, from 1 to GENERATE_AIR_MAX */
    float size;           /* diameter of the largest bubbles, in diagonals of the object's box */
    float frequency;      /* of the largest bubbles along that diagonal */
    const float *cover;   /* of GENERATE_AIR_LAYER_SIZE rows, 0 to 1: opacity of bubbles in all
                             layers; NULL: they are drawn */
};

enum {
    GENERATE_AIR_LAYER_SIZE = 512, /* texels a side */
    GENERATE_AIR_LAYER_COUNT = 4,
};

/* An array of square textures, two bytes a texel: opacity of bubbles, opacity of haze. */
struct air_layers {
    uint8_t *texels;      /* all mip levels, as mips.h orders them; the caller frees it */
    uint32_t size, count; /* texels a side, a power of two; layers; both 0 if there are none */
};

/*
 * Squares as wide as the box's diagonal, rotated at random about points near its middle. Their
 * textures fill them (uv); `material` of a vertex is the layer + 1.
 */
bool generate_air_planes(struct mesh *mesh, struct box box, const struct generate_air *air);

/* Clips these squares to a hull of the object. Returns false when out of memory; they are then
 * unchanged. */
bool generate_air_cut(struct mesh *planes, const struct mesh *object);

/* Draws the textures: bubbles of three sizes, each half of the one before and twice as frequent,
 * and haze, which are dense in the middle and fade out at the edges. Returns false when out of
 * memory; *layers is then {0}. */
bool generate_air_layers(struct air_layers *layers, const struct generate_air *air);

enum generate_bubbles_shape {
    GENERATE_BUBBLES_SPHERE,
    GENERATE_BUBBLES_PROLATE, /* long ellipsoids */
    GENERATE_BUBBLES_OBLATE,  /* flat ellipsoids */
    GENERATE_BUBBLES_CAPSULE,
    GENERATE_BUBBLES_MIXED, /* each of the shapes above */
    GENERATE_BUBBLES_GROWN, /* worms and eggs, in rows along which ice grows */
    GENERATE_BUBBLES_SHAPE_COUNT,
};

struct generate_bubbles {
    uint32_t count, seed; /* number of bubbles, from 1 to BUBBLES_COUNT_MAX */
    float size;           /* longest diameter of the largest, in diagonals of the object's box */
    enum generate_bubbles_shape shape;
    float stretch; /* longest diameter by the shortest, from 1 on; not of spheres */
    float rim;     /* how far the surface is from each, in least widths of the object's box */
};

/* Bubbles in the object's space that do not overlap. */
struct bubbles {
    struct bubble *all; /* the caller frees it */
    uint32_t count;
};

/*
 * Many small bubbles and few large ones in a closed mesh: the whole spheres around them are inside
 * if it is convex, else at least their centres. Bubbles that fit nowhere are left out. Their axes
 * point more or less to the middle. The shape changes neither the places nor the longest diameters,
 * but for those that have grown: they are in groups, of worms side by side, of beads behind each
 * other, and of eggs.
 * Returns false when out of memory; *bubbles is then {0}.
 */
bool generate_bubbles(struct bubbles *bubbles, const struct mesh *object,
                      const struct generate_bubbles *params);

struct generate_cracks {
    uint32_t count, seed;
    float size;
};

/*
 * Sheets for cracks in an object that fills a box: `count` of them (at most CRACKS_MAX), about as
 * large as the box times `size`, near its centre, open, curved, irregular, partly outside of it.
 * For one seed, a smaller count gives the first sheets of a larger one. If `own` is not empty, all
 * are copies of it, which is in the unit ball. Colours are those of shaders/cracks.h; sheets of
 * `own` are as wide everywhere.
 */
bool generate_cracks(struct mesh *mesh, struct box box, const struct generate_cracks *params,
                     const struct mesh *own);

#endif
