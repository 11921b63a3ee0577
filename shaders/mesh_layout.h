/* mesh_layout.h: vertex attribute locations of struct mesh_vertex (src/scene/geometry/mesh.h). */
#ifndef SHADERS_MESH_LAYOUT_H
#define SHADERS_MESH_LAYOUT_H

#define MESH_POSITION 0
#define MESH_NORMAL   1
#define MESH_COLOR    2
#define MESH_UV       3
#define MESH_MATERIAL 4

/* bits of mesh_vertex.material */
#define MESH_TEXTURE_MASK  0xffffu  /* texture layer + 1; 0 if there is none */
#define MESH_TILES         0xffffu  /* texture value of a pool's tiles; reference only */
#define MESH_UNLIT         0x10000u /* the colour is emitted radiance, not lit */
#define MESH_CUTOUT        0x20000u /* alpha below one half is discarded */
#define MESH_ORBITS        0x40000u /* transformed by globals.world_from_movers */
#define MESH_SURFACE_SHIFT 19u      /* from this bit on: material index + 1; 0 if there is none */
#define MESH_SURFACE_MAX   8191u

/* Layout of the texture of struct mesh_extra: texels of a vertex are consecutive, row by row. */
#define MESH_EXTRA_WIDTH  4096 /* texels */
#define MESH_EXTRA_HEIGHT 4096 /* maximum, supported by every device */
#define MESH_EXTRA_TEXELS 2    /* texels per vertex: tangent; uv */

#endif
