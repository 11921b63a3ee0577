/* gltf_draco.h: meshes compressed by Draco, for C; the decoder is a library in C++. */
#ifndef FIRN_SCENE_IMPORT_GLTF_DRACO_H
#define FIRN_SCENE_IMPORT_GLTF_DRACO_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct gltf_draco;

/* Decodes a mesh, which gltf_draco_delete() frees. Returns NULL if the bytes are no mesh, or memory
 * is short. */
struct gltf_draco *gltf_draco_new(const void *bytes, size_t size);
void gltf_draco_delete(struct gltf_draco *draco); /* NULL is fine */

uint32_t gltf_draco_vertex_count(const struct gltf_draco *draco);
uint32_t gltf_draco_index_count(const struct gltf_draco *draco);

/* Copies the indices of all triangles. */
void gltf_draco_copy_indices(const struct gltf_draco *draco, uint32_t *indices);

/* Returns the number of components of an attribute, by its identifier; 0 if there is none. */
uint32_t gltf_draco_width(const struct gltf_draco *draco, uint32_t attribute);

/* Copies an attribute of all vertices; normalised integers become -1 to 1. Returns false if they
 * cannot be converted. */
bool gltf_draco_copy_values(const struct gltf_draco *draco, uint32_t attribute, float *values);

#endif
