/* model_assimp.h: shared by the files that read .obj and .ply by assimp: the state meanwhile. */
#ifndef FIRN_SCENE_IMPORT_MODEL_ASSIMP_H
#define FIRN_SCENE_IMPORT_MODEL_ASSIMP_H

#include <assimp/scene.h>
#include "src/scene/import/model_import.h"

struct model_material {
    vec3s color;       /* linear */
    uint32_t layer;    /* texture layer + 1; 0: none */
    uint32_t uv_index; /* set of texture coordinates */
    bool is_textured;
    struct material material; /* what of it a medium needs */
    bool is_made_up;          /* made by assimp for a file without materials */
};

struct model_node {
    const struct aiNode *node;
    mat4s model_from_node;
};

struct model_assimp {
    struct model_import *import;
    const struct aiScene *scene;
    struct model_material *materials; /* scene->mNumMaterials of them */
    struct model_node *nodes;         /* parents first */
    uint32_t node_count;
};

/* Checks all numbers and indices of the file before assimp processes them. */
MUST_USE enum status model_mesh_check(const struct model_assimp *assimp);

/* Fills in one of the two meshes. The faces must be triangles, lines or points. */
MUST_USE enum status model_mesh_build(const struct model_assimp *assimp, struct model *model,
                                      enum model_part everything_is);

/* Fills in assimp->materials, except for the layers. Returns false when out of memory. */
MUST_USE bool model_material_read(struct model_assimp *assimp);

/* Returns the name of the base colour texture and its set of coordinates; false if there is
 * none. */
bool model_material_texture(const struct aiMaterial *material, struct aiString *name,
                            uint32_t *uv_index);

/* Loads the textures of materials whose meshes have texture coordinates, and sets their layers. */
MUST_USE enum status model_texture_load(struct model_assimp *assimp, struct texture_layers *layers);

#endif
