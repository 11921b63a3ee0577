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
#ifndef FIRN_SCENE_GENERATE_H
#define FIRN_SCENE_GENERATE_H

#include "src/scene/mesh.h"

enum {
    GENERATE_SPHERE_TRIANGLES = 960,
    GENERATE_ICE_CUBE_TRIANGLES = 4800,
    GENERATE_TEAPOT_TRIANGLES = 14400,
    GENERATE_LANDSCAPE_TRIANGLES = 2340,
    GENERATE_TRIANGLES_MAX = 1 << 20, /* some 200 MB */
    GENERATE_MOVERS_MAX = 64,
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
 * Coloured balls in a ring around a box, of MESH_MOVES; `count` from 1 to GENERATE_MOVERS_MAX. They
 * stay outside the sphere around the box wherever they turn about its vertical axis.
 */
bool generate_movers(struct mesh *mesh, struct box box, uint32_t count);

#endif
