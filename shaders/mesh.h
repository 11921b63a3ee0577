/* mesh.h: locations of the fields of struct mesh_vertex (src/scene/mesh.h) in vertex shaders. */
#ifndef SHADERS_MESH_H
#define SHADERS_MESH_H

#define MESH_POSITION 0
#define MESH_NORMAL   1
#define MESH_COLOR    2
#define MESH_UV       3
#define MESH_MATERIAL 4

/* the bits of mesh_vertex.material */
#define MESH_TEXTURE_MASK  0xffffu  /* texture layer + 1; 0: none */
#define MESH_TILES         0xffffu  /* as texture: the tiles of a pool, in the reference alone */
#define MESH_UNLIT         0x10000u /* the colour is emitted radiance, not lit */
#define MESH_CUTOUT        0x20000u /* texels with alpha below one half are holes */
#define MESH_MOVES         0x40000u /* transformed by globals.world_from_movers */
#define MESH_SURFACE_SHIFT 19u      /* bits from here: index of the material + 1; 0: none */
#define MESH_SURFACE_MAX   8191u

/* The texture of struct mesh_extra: a vertex's texels follow each other, row after row. */
#define MESH_EXTRA_WIDTH  4096 /* texels */
#define MESH_EXTRA_HEIGHT 4096 /* at most, as every device has it */
#define MESH_EXTRA_TEXELS 2    /* of a vertex: tangent; uv */

#endif
