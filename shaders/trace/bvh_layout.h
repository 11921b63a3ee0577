/*
 * bvh_layout.h: memory layout of the BVH that shaders traverse, built by src/scene/bvh/bvh.c. Every
 * buffer is an array of words of four 32-bit numbers.
 *
 * A node has two children, one word each. The first three numbers hold the child's bounding box:
 * for each axis the lower plane and, shifted left by the number of bits of a plane, the upper one,
 * quantised to the grid of the BVH. If planes have fewer than BVH_PLANE_BITS bits, the bits from
 * BVH_CONE_SHIFT on hold a cone that bounds the triangles' normals: its axis, signed, times
 * BVH_CONE_AXIS. The fourth number is the child's index: that of a node or, with BVH_LEAF, first
 * triangle << 3 | number of triangles. Its bits from BVH_CONE_SINE_SHIFT on hold the sine of the
 * cone's half angle times 2 * BVH_CONE_AXIS, or BVH_CONE_OPEN if the cone has all directions.
 *
 * Two words before the root describe the grid: its origin and the number of bits of a plane, then
 * grid steps per metre along each axis.
 *
 * A triangle has three words, the rows of an affine map to (u, v, w): u and v are the barycentric
 * weights of the second and third corner, w is the distance in front of the plane (Woop 2004,
 * DynRT). Three more words in the buffer of corners hold the corners' normals. Their fourth numbers
 * are: (1) the object's medium priority, or 0, plus BVH_OBJECT_NUMBER times its number in the layer
 * `object`; (2) the material as in mesh_layout.h; (3) the index of BVH_SURFACE_WORDS additional
 * words, or 0, plus BVH_CONTACT if the triangle is at a contact (src/scene/coincident_shells.h),
 * and BVH_CONTACT_THIN if its object is also a thin wall. These words hold three vertex colours,
 * the texture coordinates u and v of the corners, and the number of the surroundings' object times
 * 2, which is odd if BVH_EXTRA_WORDS more words follow: three tangents with handedness, and the
 * second set of texture coordinates.
 *
 * Corners of a crack store the opening there (cracks.h) as a half float in the upper half of the
 * fourth number; the lower half is 0. A bubble is stored as a triangle whose rows are: centre and
 * `stretch` (src/scene/bubble_intersect.h); axis and 1 for a capsule; (0, 0, 0, radius).
 *
 * If a scene has more than BVH_MASK_OBJECTS_MAX objects, one word per medium priority follows the
 * corners, starting with priority 0, the outside. Its first number is the object's medium, from 1.
 */
#ifndef SHADERS_TRACE_BVH_LAYOUT_H
#define SHADERS_TRACE_BVH_LAYOUT_H

#define BVH_NODE_WORDS        2
#define BVH_TRIANGLE_WORDS    3
#define BVH_CORNER_WORDS      3
#define BVH_SURFACE_WORDS     4
#define BVH_EXTRA_WORDS       5
#define BVH_OBJECT_NUMBER     0x10000u
#define BVH_CONTACT           0x80000000u
#define BVH_CONTACT_THIN      0x40000000u
#define BVH_CONTACT_MASK      0xc0000000u
#define BVH_LEAF              0x80000000u
#define BVH_NONE              0xffffffffu
#define BVH_CHILD_MASK        0x87ffffffu
#define BVH_PLANE_BITS        16
#define BVH_CONE_SHIFT        28
#define BVH_CONE_AXIS         7
#define BVH_CONE_SINE_SHIFT   27
#define BVH_CONE_OPEN         15
#define BVH_DEPTH_MAX         30
#define BVH_TRIANGLES_MAX     (1u << 24)
#define BVH_MASK_OBJECTS_MAX  32    /* maximum for sets as 32-bit masks */
#define BVH_OBJECTS_MAX       65535 /* maximum number of objects */
#define BVH_INTERIOR_LIST_MAX 8     /* maximum number of overlapping objects at a point */
#define BVH_MEDIA_MAX         255   /* maximum number of media in scenes of many objects */

/* the BVHs of a scene */
#define BVH_OBJECTS      0
#define BVH_SURROUNDINGS 1
#define BVH_MOVERS       2 /* surroundings that orbit the object */
#define BVH_INCLUSIONS   3 /* cracks and bubbles of the first object, in object space */
#define BVH_COUNT        4

#endif
