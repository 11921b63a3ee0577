/* model_arrays.h: builds a model from meshes, materials and instances in memory. */
#ifndef FIRN_SCENE_IMPORT_MODEL_ARRAYS_H
#define FIRN_SCENE_IMPORT_MODEL_ARRAYS_H

#include "src/scene/geometry/affine.h"
#include "src/scene/import/model.h"

enum {
    MODEL_ARRAYS_NO_MATERIAL = -1,
};

/* Packed arrays; a mesh owns them. */
struct model_arrays_mesh {
    float *positions, *normals; /* 3 per vertex; normals may be NULL */
    float *uvs;                 /* 2 per vertex, or NULL */
    uint32_t *indices;
    uint32_t vertex_count, index_count;
};

struct model_arrays_instance {
    char name[MATERIAL_NAME_SIZE];
    uint32_t mesh;
    int32_t material; /* or MODEL_ARRAYS_NO_MATERIAL */
    struct affine world_from_mesh;
};

/* Arrays of a model; all are owned. */
struct model_arrays {
    struct model_arrays_mesh *meshes;
    struct material *materials;
    struct model_arrays_instance *instances;
    struct light *lights;
    uint32_t mesh_count, material_count, instance_count, light_count;
};

/* Checks that the values of a mesh are finite and its indices in range. Otherwise logs an error
 * that begins with `name`, and returns STATUS_DATA. */
MUST_USE enum status model_arrays_check(const struct model_arrays_mesh *mesh, const char *name);

/* Builds a model. Instances of transmissive materials become objects and all others surroundings;
 * without transmissive materials, or if no instance has a material, `default_role` decides, as for
 * files. `name` is used in messages. On failure, *model is {0}. */
MUST_USE enum status model_arrays_build(struct model *model, const struct model_arrays *arrays,
                                        enum model_role default_role, const char *name);

void model_arrays_mesh_finish(struct model_arrays_mesh *mesh);
void model_arrays_finish(struct model_arrays *arrays);

#endif
