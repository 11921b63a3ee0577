/* mesh_layout.h: vertex attribute locations of struct mesh_vertex (src/scene/geometry/mesh.h). */
#ifndef SHADERS_MESH_LAYOUT_H
#define SHADERS_MESH_LAYOUT_H

#define MESH_POSITION 0
#define MESH_NORMAL   1
#define MESH_COLOR    2
#define MESH_UV       3
#define MESH_MATERIAL 4

/* bits of mesh_vertex.material */
#define MESH_TEXTURE_MASK  0xffffu  /* texture layer + 1, or 0 */
#define MESH_TILES         0xffffu  /* pool's tiles; CPU reference only */
#define MESH_UNLIT         0x10000u /* colour is emitted radiance */
#define MESH_CUTOUT        0x20000u /* alpha below one half is discarded */
#define MESH_ORBITS        0x40000u /* transformed by globals.world_from_movers */
#define MESH_SURFACE_SHIFT 19u      /* first bit: material index + 1 */
#define MESH_SURFACE_MAX   8191u

/* Size of the texture that stores struct mesh_extra. Texels of a vertex are adjacent in one row. */
#define MESH_EXTRA_WIDTH  4096 /* texels */
#define MESH_EXTRA_HEIGHT 4096 /* maximum, supported by every device */
#define MESH_EXTRA_TEXELS 2    /* texels per vertex: tangent; uv */

#endif
