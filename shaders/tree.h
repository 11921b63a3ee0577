/*
 * tree.h: the layout of trees of triangles (src/scene/tree.h), in words of four 32-bit numbers.
 *
 * A node has two children, each of one word. Its first three numbers have the planes of the child's
 * box across each axis, the low one and, so many bits higher, the high one, in steps of the part's
 * grid. Where planes have less than TREE_PLANE_BITS, the cone of the triangles' normals follows
 * from TREE_CONE_SHIFT on: TREE_CONE_AXIS times a mean normal, signed. The fourth number is the
 * child: a node, or, with TREE_LEAF, the first triangle << 3 | number of triangles; from
 * TREE_SINE_SHIFT on it has 2 * TREE_CONE_AXIS times the sine of the widest angle to that normal,
 * or TREE_CONE_OPEN: all directions.
 *
 * Before the root of a part is its grid: the corner where planes are 0, and the bits of a plane;
 * steps a metre along each axis.
 *
 * A triangle has three words, the rows of an affine map to (u, v, w): u and v are the weights of
 * the second and third corner, w is the distance before its plane (Woop 2004, DynRT). Its corners
 * have three more: a normal each, and in the fourth numbers the rank of the object or 0, and
 * TREE_NUMBER times its number in the layer `object`, the material as in mesh.h, of objects the
 * object's own, and the place of TREE_SURFACE_WORDS more words, or 0: three colours and, in what is
 * left, the u and v of the three corners. The last number is that of the surroundings' object times
 * 2, and odd if TREE_EXTRA_WORDS more follow: three tangents with their sides, and the second u and
 * v. From TREE_HORIZON_SHIFT on the place has bits of its own: TREE_HORIZON_STEPS times the sine of
 * the elevation above the triangle's outer side beyond which no triangle of the objects is seen
 * from it, or TREE_HORIZON_UNKNOWN (src/scene/tree_horizon.h).
 *
 * Corners of a crack have in the upper half of the fourth number how open it is there (cracks.h), a
 * half float, and 0 in the lower one. A bubble is a triangle whose rows are its centre and
 * `stretch` (src/scene/bubble.h), its axis and 1 for a capsule, and (0, 0, 0, radius).
 *
 * Of a single object with horizons, TREE_GRID_WORDS are behind the corners: its box in TREE_GRID
 * cells each way, x first, 8 in a number. A cell has the greatest horizon of the triangles in it,
 * above the plane of any normal between those of their corners.
 *
 * Where a scene has more than TREE_SHELLS_FEW objects, a word for each rank is behind the corners,
 * the one of rank 0 for the outside: its first number is the object's medium, from 1 on.
 */
#ifndef SHADERS_TREE_H
#define SHADERS_TREE_H

#define TREE_NODE_WORDS      2
#define TREE_TRIANGLE_WORDS  3
#define TREE_CORNER_WORDS    3
#define TREE_SURFACE_WORDS   4
#define TREE_EXTRA_WORDS     5
#define TREE_NUMBER          0x10000u
#define TREE_LEAF            0x80000000u
#define TREE_NOTHING         0xffffffffu
#define TREE_CHILD_MASK      0x87ffffffu
#define TREE_PLANE_BITS      16
#define TREE_CONE_SHIFT      28
#define TREE_CONE_AXIS       7
#define TREE_SINE_SHIFT      27
#define TREE_CONE_OPEN       15
#define TREE_SURFACE_MASK    0x0fffffffu
#define TREE_HORIZON_SHIFT   28
#define TREE_HORIZON_STEPS   14
#define TREE_HORIZON_UNKNOWN 15
#define TREE_GRID            16
#define TREE_GRID_WORDS      (TREE_GRID * TREE_GRID * TREE_GRID / 32)
#define TREE_DEPTH_MAX       30
#define TREE_TRIANGLES_MAX   (1u << 24)
#define TREE_SHELLS_FEW      32    /* objects that bits of a word tell apart */
#define TREE_SHELLS_MAX      65535 /* objects; 16 bits each */
#define TREE_NESTED_MAX      8     /* of more than a few objects, those that a point is inside */
#define TREE_MEDIA_MAX       255   /* materials of more than a few objects */

/* parts of a scene */
#define TREE_OBJECTS      0
#define TREE_SURROUNDINGS 1
#define TREE_MOVERS       2 /* surroundings that move around the object */
#define TREE_INCLUSIONS   3 /* cracks and bubbles of the first object, in its space */
#define TREE_PART_COUNT   4

#endif
