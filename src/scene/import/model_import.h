/* model_import.h: internal interface of the model importers (glTF, OBJ, PLY): import state,
 * formats, textures, mesh building. Functions that return a status log one line unless it is
 * STATUS_OK. */
#ifndef FIRN_SCENE_IMPORT_MODEL_IMPORT_H
#define FIRN_SCENE_IMPORT_MODEL_IMPORT_H

#include <stdio.h>
#include "src/scene/import/model.h"

enum {
    MODEL_COORDINATE_MAX = 1000000,
    MODEL_NODE_MAX = 1 << 22,
    MODEL_ELEMENT_MAX = 1 << 28, /* maximum vertices or indices of one mesh */
    MODEL_TEXTURE_MAX = 4096,
    MODEL_CAMERA_MAX = 4096,
    MODEL_EXTENSION_MAX = 256,
    MODEL_LIGHT_MAX = 4096,
    MODEL_ANIMATION_MAX = 4096,
    MODEL_SECONDS_MAX = 1000000000,
    MODEL_TEXTURE_SIDE_MAX = 2048,       /* maximum texture side, texels */
    MODEL_TEXTURES_SIZE_MAX = 512 << 20, /* maximum bytes of all textures together */
    MODEL_RADIANCE_MAX = 65504,          /* maximum unlit colour: the largest half */
    MODEL_ROLE_COUNT = 2,                /* MODEL_OBJECT and MODEL_SURROUNDINGS */
};

struct model_import {
    const char *path;
    char refused_file[256];     /* first file outside the model's folder; "" if none */
    uint32_t clamped_materials; /* number of materials with clamped colours */
    uint32_t clamped_vertices;
    char missing_file[256]; /* first referenced file that does not exist; "" if none */
};

/* Model file format, identified by its lower-case suffix, such as "glb". */
struct model_format {
    const char *suffix;
    const char *name; /* for messages: "binary glTF" */
    bool is_gltf;
};

/* Finds the format by a file's suffix. Returns STATUS_DATA if the suffix is unknown, or if the
 * first bytes of the file do not match the format. */
MUST_USE enum status model_format_find(const char *path, const struct model_format **format);

/* Read a glTF file; or another format, given its suffix in lower case: "obj" or "ply". */
MUST_USE enum status model_load_gltf(struct model_import *import, struct model *model,
                                     enum model_role default_role, const struct model_pose *pose);
MUST_USE enum status model_load_obj_ply(struct model_import *import, const char *suffix,
                                        struct model *model, enum model_role default_role);

/* ---- files ---- */

/* Opens the model file, or a file in its folder that it refers to. Returns NULL if the file is
 * missing or outside the folder, and records it in *user, a struct model_import. */
FILE *model_file_open(void *user, const char *path);

/* Converts a file reference to a relative path, in place. glTF uses URIs, with %20 for a space;
 * other formats may contain Windows paths. Returns false if the path leaves the folder: "../a",
 * "/a", "https://a", and "file:a" as a URI. */
MUST_USE bool model_file_clean(char *name, bool is_uri);

/* Returns the path of a file in the model's folder, which the caller frees, or NULL. */
char *model_file_join(const char *model, const char *name);

/* ---- textures ---- */

/* Conversion of an image of an MTL file to the texel layout of a glTF texture. */
enum model_texture_conversion {
    MODEL_TEXTURE_SAME,
    MODEL_TEXTURE_TO_ALPHA,  /* alpha map: from the image's alpha or grey; colour becomes white */
    MODEL_TEXTURE_ROUGHNESS, /* roughness map in G; B is 1: the metallic factor applies */
    /* as MODEL_TEXTURE_ROUGHNESS, converted from factors on the Phong exponent Ns */
    MODEL_TEXTURE_NS_TO_ROUGHNESS,
    MODEL_TEXTURE_METALLIC,   /* metallic map in B; G is 1: the roughness factor applies */
    MODEL_TEXTURE_TO_NORMALS, /* height map to normal map; bluish images are normal maps already */
};

/* Image that becomes a texture layer: encoded bytes, or a file if they are NULL. */
struct model_texture {
    const char *name; /* for messages */
    const uint8_t *bytes;
    size_t size;
    char *file;
    enum model_texture_conversion change;
    float exponent; /* Ns for MODEL_TEXTURE_NS_TO_ROUGHNESS */
    /* File of a second image that replaces one channel: alpha after MODEL_TEXTURE_TO_ALPHA, blue
     * after MODEL_TEXTURE_METALLIC; NULL if there is none. */
    char *other;
    enum model_texture_conversion other_change;
};

/* Decodes images and resamples them to layers of one size, as sRGB colours or linear numbers. */
MUST_USE enum status model_texture_load(const char *path, const struct model_texture *textures,
                                        uint32_t count, bool are_numbers,
                                        struct texture_layers *layers);

/* Returns the name of an image's format, such as "KTX2", if it is not supported; else NULL. */
const char *model_texture_unsupported_format(const struct model_texture *texture);

/* Converts RGBA texels as texture->change specifies. Returns false when out of memory. */
MUST_USE bool model_texture_convert(uint8_t *texels, int width, int height,
                                    const struct model_texture *texture);

/* Returns the GGX roughness that matches a Phong exponent Ns. */
float mtl_roughness_from_exponent(float exponent);

/* Copies two texture arrays into one of the larger texel size; the caller frees both->texels. */
MUST_USE enum status model_texture_merge(struct texture_layers *both,
                                         const struct texture_layers *first,
                                         const struct texture_layers *second, bool are_numbers);

/* ---- meshes ---- */

/* Triangles of one material in the space of their node. All arrays are borrowed. */
struct model_shape {
    const char *name;       /* for messages: "mesh 0" */
    const float *positions; /* 3 per vertex */
    const float *normals;   /* normals, 3 floats per vertex; NULL to compute them */
    const float *colors;    /* linear RGBA per vertex; or NULL */
    const float *uvs;       /* UVs: 2 of every uv_stride floats; may be NULL */
    uint32_t uv_stride;
    const float *other_uvs; /* UVs for mesh_extra.uv, 2 per vertex; may be NULL */
    const float *tangents;  /* glTF tangents, 4 floats per vertex; may be NULL */
    bool is_flipped;        /* v = 0 is the texture's bottom */
    const uint32_t *indices;
    uint32_t vertex_count, index_count;
    vec3s color;       /* colour multiplied with vertex colours */
    uint32_t material; /* mesh_vertex.material */
};

/* The two meshes of a model under construction. */
struct model_build {
    struct model_import *import;
    struct model *model;
    struct mesh *meshes[MODEL_ROLE_COUNT];
    uint64_t vertex_count[MODEL_ROLE_COUNT], index_count[MODEL_ROLE_COUNT];
    bool has_extras[MODEL_ROLE_COUNT]; /* set before the meshes are allocated */
    const char *surroundings_name;     /* name of the next object; NULL to continue the last one */
};

/* Checks that the numbers of a shape are finite and its indices in range. */
MUST_USE enum status model_shape_check(const struct model_import *import,
                                       const struct model_shape *shape);

void model_build_init(struct model_build *build, struct model_import *import, struct model *model);

/* Build the meshes: count every shape, allocate the meshes, add the shapes in the counted order,
 * and end, which computes missing normals and welds identical vertices. */
MUST_USE enum status model_build_count(struct model_build *build, enum model_role role,
                                       uint64_t vertex_count, uint64_t index_count);
MUST_USE enum status model_build_allocate(struct model_build *build);
MUST_USE enum status model_build_add(struct model_build *build, enum model_role role,
                                     const struct model_shape *shape, mat4s model_from_shape);
MUST_USE enum status model_build_end(struct model_build *build);

/* Adds the only object of a file that is one object as a whole, with MATERIAL_FROM_SETTINGS. */
MUST_USE enum status model_build_default_object(struct model_build *build);

/* Computes missing ({0}) normals and welds identical vertices, except across surroundings objects,
 * whose first vertices are in `starts`, which is updated. Returns false when out of memory. */
MUST_USE bool model_weld_vertices(struct mesh *mesh, uint32_t *starts, uint32_t start_count);

/* Clamps a finite colour to 0 to 1, or to MODEL_RADIANCE_MAX if it is unlit. Returns true if it
 * changed. Non-finite colours are left unchanged. */
bool model_color_clamp(vec3s *color, bool is_unlit);

/* Logs a warning if colours of the file were clamped. Call it only for accepted files. */
void model_color_warn(const struct model_import *import);

#endif
