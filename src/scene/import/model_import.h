/*
 * model_import.h: what the files behind model.h share: a model file while it is being read.
 *
 * Every function that returns a status has logged its one line when that is not STATUS_OK.
 */
#ifndef FIRN_SCENE_IMPORT_MODEL_IMPORT_H
#define FIRN_SCENE_IMPORT_MODEL_IMPORT_H

#include <assimp/cfileio.h>
#include <assimp/scene.h>
#include "src/scene/import/model.h"

enum {
    MODEL_COORDINATE_MAX = 1000000,
    MODEL_NODE_MAX = 1 << 22,
    MODEL_ELEMENT_MAX = 1 << 28, /* vertices, and indices, of one part */
    MODEL_TEXTURE_MAX = 4096,
    MODEL_TEXTURE_SIDE_MAX = 2048,       /* texels */
    MODEL_TEXTURES_SIZE_MAX = 512 << 20, /* bytes, of all */
};

struct model_material {
    vec3s color;       /* base colour factor, linear */
    uint32_t flags;    /* MESH_UNLIT, MESH_CUTOUT */
    uint32_t layer;    /* texture layer + 1; 0: none */
    uint32_t uv_index; /* set of texture coordinates */
    float ior;         /* 0: not given */
    bool is_textured;
    bool is_transmissive;
    bool is_made_up; /* by assimp, for want of any in the file */
};

struct model_node {
    const struct aiNode *node;
    mat4s model_from_node;
};

struct model_import {
    const char *path;
    const struct aiScene *scene;
    struct model_material *materials; /* scene->mNumMaterials of them */
    struct model_node *nodes;         /* parents first */
    uint32_t node_count;
    char refused[256]; /* the first file outside the model's folder that it names; "": none */
    bool misses_file;  /* one that it names is not there */
    bool is_gltf;
    bool is_plain; /* .obj or .ply */
};

/* Reads files in the model's folder, and notes in *import, which is borrowed, who asks for more. */
struct aiFileIO model_file_io(struct model_import *import);

/*
 * In place: glTF names files by URIs, with %20 for a space; others may come from Windows. False if
 * it leads out of the folder: "../a", "/a", "https://a", and as a URI "file:a".
 */
MUST_USE bool model_file_clean(char *name, bool is_uri);

/* Checks all numbers and indices as they came, so that assimp itself may work on them. */
MUST_USE enum status model_mesh_check(const struct model_import *import);

/* Fills in the two meshes, has_ior and ior. The faces must be triangles, lines or points. */
MUST_USE enum status model_mesh_build(const struct model_import *import, struct model *model,
                                      enum model_part everything_is);

/* Makes the normals that are {0} and joins equal vertices. False when memory is short. */
MUST_USE bool model_join_vertices(struct mesh *mesh);

/* Fills in import->materials but for the layers. False when memory is short. */
MUST_USE bool model_material_read(struct model_import *import);

/* The name of the base colour texture and its set of coordinates. False if there is none. */
bool model_material_texture(const struct aiMaterial *material, struct aiString *name,
                            uint32_t *uv_index);

/* Loads the pictures that materials with texture coordinates use, and sets their layers. */
MUST_USE enum status model_texture_load(struct model_import *import, struct texture_layers *layers);

/* Makes a copy of both, at the larger size; the caller frees both->texels. {0} on failure. */
MUST_USE enum status model_texture_merge(struct texture_layers *both,
                                         const struct texture_layers *first,
                                         const struct texture_layers *second);

/* Looks for the first perspective camera. The object's mesh must be there. */
MUST_USE enum status model_camera_read(const struct model_import *import, struct model *model);

/* Looks for the first node that names a box. */
MUST_USE enum status model_box_read(const struct model_import *import, struct model *model);

#endif
