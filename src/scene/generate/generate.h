/*
 * generate.h: the built-in objects and the landscape, made by code.
 *
 * Triangle counts: each generator takes the wanted number of triangles and makes the closest
 * mesh its topology allows; the default counts are met exactly (Seipel and Nivfors 2006,
 * section 4). Wishes above GENERATE_TRIANGLES_MAX count as that. The closed objects are watertight
 * (every edge belongs to two triangles, which share its vertices), outward and consistently wound,
 * centred on the origin, with vertex normals; they are white and their material is 0.
 *
 * Ownership: *mesh must be {0} or finished before; the caller finishes it.
 * Errors:    false only when memory is short; *mesh is then {0}.
 */
#ifndef FIRN_SCENE_GENERATE_GENERATE_H
#define FIRN_SCENE_GENERATE_GENERATE_H

#include "shaders/bubbles.h"
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

/* Sphere of longitudes and latitudes, of the unit sphere's volume: the vertices lie a little
 * outside of it, the facets on it. Normals are exact. */
bool generate_sphere(struct mesh *mesh, uint32_t triangles);

/* Irregular rounded cube, about 1.6 m wide: six grids of squares, displaced by smooth noise. */
bool generate_ice_cube(struct mesh *mesh, uint32_t triangles);

/*
 * The Utah teapot from its 32 Bezier patches (Newell 1975), about 2 m wide, standing upright
 * (+Y), its spout toward +X. Solid, with no wall inside: one surface, the gap between lid and rim
 * and the spout's mouth closed, handle and spout joined to the body.
 */
bool generate_teapot(struct mesh *mesh, uint32_t triangles);

/*
 * A valley with hills around it, 60 m wide, 1.35 m below the origin in the middle; open, lit
 * (not MESH_UNLIT), coloured by height and slope, facing up.
 */
bool generate_landscape(struct mesh *mesh, uint32_t triangles);

/*
 * A level floor of pale tiles on which the object stands, as far as the eye sees: for light that
 * comes through the object. Lit, facing up.
 */
bool generate_floor(struct mesh *mesh, struct box object);

/*
 * A closed room, 11.7 x 6.3 x 9.9 m, with a table under the object, which stands off its middle.
 * Walls, floor and ceiling are tiled with coloured lines, a lamp and a window are bright; colours
 * are what is seen (MESH_UNLIT), with the shadows of furniture.
 */
bool generate_room(struct mesh *mesh, struct box object);

/*
 * Coloured balls in a ring around a box, of MESH_MOVES; `count` from 1 to GENERATE_MOVERS_MAX. They
 * stay outside the sphere around the box wherever they turn about its vertical axis.
 */
bool generate_movers(struct mesh *mesh, struct box box, uint32_t count);

struct generate_pool {
    float size, depth; /* of the water, metres */
    float ice;         /* width of what floats in it, metres; 0: nothing */
};

/* What is dry of a square pool around the origin, its water at height 0: walls down to the floor,
 * which is not there, and stone all around. */
bool generate_pool(struct mesh *mesh, const struct generate_pool *pool);

/* What floats in it: the ice cube, in the middle, as deep as its density has it were it a box; its
 * width is pool->ice. */
bool generate_floe(struct mesh *mesh, const struct generate_pool *pool, uint32_t triangles);

struct generate_air {
    uint32_t count, seed; /* of planes, from 1 to GENERATE_AIR_MAX */
    float size;           /* diameter of the largest bubbles, in diagonals of the object's box */
    float frequency;      /* of the largest bubbles along that diagonal */
};

/* Square pictures, one after another, two bytes a texel: opacity of bubbles, opacity of haze. */
struct air_layers {
    uint8_t *texels;      /* two a texel, all levels of mips.h; the caller frees it */
    uint32_t size, count; /* size is a power of two; both 0 when there are none */
};

/*
 * Squares as wide as the box's diagonal, turned in any way about points near its middle. Their
 * pictures fill them (uv); material is the layer + 1.
 */
bool generate_air_planes(struct mesh *mesh, struct box box, const struct generate_air *air);

/* Cuts off what of these squares cannot be in the object: they become polygons, or nothing. False
 * when memory is short; they are unchanged then. */
bool generate_air_cut(struct mesh *planes, const struct mesh *object);

/* Bubbles of three sizes, each half of the last and twice as frequent, and haze: dense in the
 * middle, nothing at the edges. False when memory is short; *layers is then {0}. */
bool generate_air_layers(struct air_layers *layers, const struct generate_air *air);

struct generate_bubbles {
    uint32_t count, seed; /* from 1 to BUBBLES_COUNT_MAX */
    float size;           /* diameter of the largest, in diagonals of the object's box */
};

/* Spheres in the object's space that do not overlap. */
struct bubbles {
    struct bubbles_sphere *spheres; /* the caller frees it */
    uint32_t count;
};

/*
 * Many small spheres and few large ones within a closed mesh: whole if it is convex, else at least
 * their centres. Those for which no room is found are left out. False when memory is short;
 * *bubbles is then {0}.
 */
bool generate_bubbles(struct bubbles *bubbles, const struct mesh *object,
                      const struct generate_bubbles *params);

/*
 * Sheets that crack whatever fills a box: `count` of them (at most CRACKS_MAX), about as large as
 * the box, near its centre, open, curved, irregular, reaching out of it. The seed says how they
 * lie: of two counts the smaller is the beginning of the larger.
 */
bool generate_cracks(struct mesh *mesh, struct box box, uint32_t count, uint32_t seed);

#endif
