/*
 * model_import.h: shared by the files behind model.h: the state while a model file is read.
 *
 * Functions that return a status log one line if it is not STATUS_OK.
 */
#ifndef FIRN_SCENE_IMPORT_MODEL_IMPORT_H
#define FIRN_SCENE_IMPORT_MODEL_IMPORT_H

#include <assimp/scene.h>
#include <stdio.h>
#include "src/scene/import/model.h"

enum {
    MODEL_COORDINATE_MAX = 1000000,
    MODEL_NODE_MAX = 1 << 22,
    MODEL_ELEMENT_MAX = 1 << 28, /* vertices, and indices, of one part */
    MODEL_TEXTURE_MAX = 4096,
    MODEL_TEXTURE_SIDE_MAX = 2048,       /* texels */
    MODEL_TEXTURES_SIZE_MAX = 512 << 20, /* bytes of all textures */
    MODEL_RADIANCE_MAX = 65504,          /* of unlit colours: the largest half; others: 1 */
};

struct model_material {
    struct material material; /* what the file says of it */
    vec3s color;              /* base colour factor, linear */
    uint32_t flags;           /* MESH_UNLIT, MESH_CUTOUT */
    uint32_t layer;           /* texture layer + 1; 0: none */
    uint32_t uv_index;        /* set of texture coordinates */
    float ior;                /* 0: not given */
    bool is_textured;
    bool is_transmissive;
    bool is_made_up; /* made by assimp for a file without materials */
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
    char refused[256]; /* the first named file that is outside the model's folder; "": none */
    uint32_t clamped_materials; /* whose colour model_color_clamp() has changed */
    uint32_t clamped_vertices;
    bool misses_file; /* a named file does not exist */
    bool is_gltf;
};

/* A format, by a suffix in lower case: "glb". */
struct model_format {
    const char *suffix;
    const char *name; /* for messages: "binary glTF" */
    bool is_gltf;
};

/* Returns the format of a file's suffix in *format; STATUS_DATA if there is none, or if the file
 * does not begin as the format does. */
MUST_USE enum status model_format_find(const char *path, const struct model_format **format);

/* Opens the model, or a file in its folder that it names, and notes others in *user, a struct
 * model_import; a model_parser_open_fn. */
FILE *model_file_open(void *user, const char *path);

/*
 * Converts a file's name to a path, in place: glTF has URIs, with %20 for a space; other formats
 * may have paths of Windows. Returns false if the path leaves the folder: "../a", "/a",
 * "https://a", and as a URI "file:a".
 */
MUST_USE bool model_file_clean(char *name, bool is_uri);

/* Checks all numbers and indices of the file before assimp processes them. */
MUST_USE enum status model_mesh_check(const struct model_import *import);

/* Fills in the two meshes, has_ior and ior. The faces must be triangles, lines or points. */
MUST_USE enum status model_mesh_build(struct model_import *import, struct model *model,
                                      enum model_part everything_is);

/* Makes the normals that are {0} and merges equal vertices. Returns false when out of memory. */
MUST_USE bool model_join_vertices(struct mesh *mesh);

/* Clamps a finite colour to 0 to 1 or, if it is unlit, MODEL_RADIANCE_MAX; returns whether that
 * changes it. One that is not finite stays. */
bool model_color_clamp(vec3s *color, bool is_unlit);

/* Logs a warning if colours of the file were clamped. For files that are accepted. */
void model_color_warn(const struct model_import *import);

/* Fills import->materials, except for the layers. Returns false when out of memory. */
MUST_USE bool model_material_read(struct model_import *import);

/* Returns the name of the base colour texture and its set of coordinates; false if there is
 * none. */
bool model_material_texture(const struct aiMaterial *material, struct aiString *name,
                            uint32_t *uv_index);

/* Loads the textures of materials whose meshes have texture coordinates, and sets their layers. */
MUST_USE enum status model_texture_load(struct model_import *import, struct texture_layers *layers);

/* Copies the textures of both, resampled to the larger size; the caller frees both->texels. On
 * failure *both is {0}. */
MUST_USE enum status model_texture_merge(struct texture_layers *both,
                                         const struct texture_layers *first,
                                         const struct texture_layers *second);

/* Reads the first perspective camera into *model, whose object must be filled in. */
MUST_USE enum status model_camera_read(const struct model_import *import, struct model *model);

/* Reads the box of the first node that names one into *model. */
MUST_USE enum status model_box_read(const struct model_import *import, struct model *model);

#endif
