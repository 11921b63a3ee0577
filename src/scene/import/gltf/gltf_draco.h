/* gltf_draco.h: C interface to the Draco mesh decompression library, which is C++. */
#ifndef FIRN_SCENE_IMPORT_GLTF_GLTF_DRACO_H
#define FIRN_SCENE_IMPORT_GLTF_GLTF_DRACO_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct gltf_draco;

/* Decodes a mesh, which gltf_draco_delete() frees. Returns NULL for bad data or lack of memory. */
struct gltf_draco *gltf_draco_new(const void *bytes, size_t size);
void gltf_draco_delete(struct gltf_draco *draco); /* NULL is fine */

uint32_t gltf_draco_vertex_count(const struct gltf_draco *draco);
uint32_t gltf_draco_index_count(const struct gltf_draco *draco);

/* Copies the vertex indices of all triangles. */
void gltf_draco_copy_indices(const struct gltf_draco *draco, uint32_t *indices);

/* Returns the number of components of an attribute, given by its unique id; 0 if there is none. */
uint32_t gltf_draco_width(const struct gltf_draco *draco, uint32_t attribute);

/* Copies an attribute as floats; normalised integers become -1 to 1. Returns false on failure. */
bool gltf_draco_copy_values(const struct gltf_draco *draco, uint32_t attribute, float *values);

#endif
