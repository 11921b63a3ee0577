/*
 * model_import.h: shared by the files behind model.h: the state while a model file is read.
 *
 * Functions that return a status log one line if it is not STATUS_OK.
 */
#ifndef FIRN_SCENE_IMPORT_MODEL_IMPORT_H
#define FIRN_SCENE_IMPORT_MODEL_IMPORT_H

#include <stdio.h>
#include "src/scene/import/model.h"

enum {
    MODEL_COORDINATE_MAX = 1000000,
    MODEL_NODE_MAX = 1 << 22,
    MODEL_ELEMENT_MAX = 1 << 28, /* vertices, and indices, of one part */
    MODEL_TEXTURE_MAX = 4096,
    MODEL_CAMERA_MAX = 4096,
    MODEL_EXTENSION_MAX = 256,
    MODEL_LIGHT_MAX = 4096,
    MODEL_ANIMATION_MAX = 4096,
    MODEL_SECONDS_MAX = 1000000000,
    MODEL_TEXTURE_SIDE_MAX = 2048,       /* texels */
    MODEL_TEXTURES_SIZE_MAX = 512 << 20, /* bytes of all textures */
    MODEL_RADIANCE_MAX = 65504,          /* of unlit colours: the largest half; others: 1 */
    MODEL_PART_COUNT = 2,                /* of enum model_part */
};

struct model_import {
    const char *path;
    char refused[256]; /* the first named file that is outside the model's folder; "": none */
    uint32_t clamped_materials; /* whose colour model_color_clamp() has changed */
    uint32_t clamped_vertices;
    char missed[256]; /* the first named file that does not exist; "": none */
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

/* Read a file of glTF; of another format, with a suffix in lower case, "obj" or "ply". */
MUST_USE enum status model_load_gltf(struct model_import *import, struct model *model,
                                     enum model_part everything_is, const struct model_pose *pose);
MUST_USE enum status model_load_plain(struct model_import *import, const char *suffix,
                                      struct model *model, enum model_part everything_is);

/* ---- files ---- */

/* Opens the model, or a file in its folder that it names, and notes others in *user, a struct
 * model_import. NULL: it is not there, or not allowed. */
FILE *model_file_open(void *user, const char *path);

/*
 * Converts a file's name to a path, in place: glTF has URIs, with %20 for a space; other formats
 * may have paths of Windows. Returns false if the path leaves the folder: "../a", "/a",
 * "https://a", and as a URI "file:a".
 */
MUST_USE bool model_file_clean(char *name, bool is_uri);

/* Returns the path of a file in the model's folder; the caller frees it. NULL: out of memory. */
char *model_file_join(const char *model, const char *name);

/* ---- textures ---- */

/* What a picture of an MTL file is turned into. */
enum model_picture_change {
    MODEL_PICTURE_SAME,
    MODEL_PICTURE_TO_ALPHA,        /* white, with the picture's alpha or grey as alpha */
    MODEL_PICTURE_ROUGHNESS,       /* roughness in green; the metallic factor is left as it is */
    MODEL_PICTURE_NS_TO_ROUGHNESS, /* as that, of factors on Ns */
    MODEL_PICTURE_METALLIC,        /* metallic in blue; the factor of roughness is left as it is */
    MODEL_PICTURE_TO_NORMALS,      /* heights to normals; normals, which are blue, stay */
};

/* A picture that becomes a layer: encoded bytes, or if they are NULL, a file. */
struct model_picture {
    const char *name; /* for messages */
    const uint8_t *bytes;
    size_t size;
    char *file;
    enum model_picture_change change;
    float exponent; /* of MODEL_PICTURE_NS_TO_ROUGHNESS */
    char *other;    /* a file that replaces one channel of the picture, alpha after
                     * MODEL_PICTURE_TO_ALPHA or blue after MODEL_PICTURE_METALLIC; NULL: none */
    enum model_picture_change other_change;
};

/* Loads pictures as layers of one size, of sRGB colours or of numbers. */
MUST_USE enum status model_picture_load(const char *path, const struct model_picture *pictures,
                                        uint32_t count, bool are_numbers,
                                        struct texture_layers *layers);

/* Returns the name of a picture's format if it is a known one that cannot be read, "KTX2", else
 * NULL. */
const char *model_picture_unread(const struct model_picture *picture);

/* Changes RGBA texels as the picture says. Returns false when out of memory. */
MUST_USE bool model_picture_convert(uint8_t *texels, int width, int height,
                                    const struct model_picture *picture);

/* Returns the roughness whose highlight is that of an exponent of Phong's, Ns. */
float model_roughness_of(float exponent);

/* Copies the textures of both, resampled to the larger size; the caller frees both->texels. On
 * failure *both is {0}. */
MUST_USE enum status model_picture_merge(struct texture_layers *both,
                                         const struct texture_layers *first,
                                         const struct texture_layers *second, bool are_numbers);

/* ---- meshes ---- */

/* Triangles of one material, in the space of their node. All is borrowed. */
struct model_shape {
    const char *name;       /* for messages: "mesh 0" */
    const float *positions; /* 3 of each vertex */
    const float *normals;   /* 3; NULL: they are made */
    const float *colors;    /* 4, linear; may be NULL */
    const float *uvs;       /* the first 2 of uv_stride; may be NULL */
    uint32_t uv_stride;
    const float *other_uvs; /* 2, mesh_extra.uv; may be NULL */
    const float *tangents;  /* 4, as glTF has them; may be NULL */
    bool is_flipped;        /* v = 0 is the bottom of the texture */
    const uint32_t *indices;
    uint32_t vertex_count, index_count;
    vec3s color;       /* times the vertices' */
    uint32_t material; /* mesh_vertex.material */
};

/* The two meshes of a model while they are filled. */
struct model_build {
    struct model_import *import;
    struct model *model;
    struct mesh *meshes[MODEL_PART_COUNT];
    uint64_t vertex_count[MODEL_PART_COUNT], index_count[MODEL_PART_COUNT];
    bool has_extras[MODEL_PART_COUNT]; /* set before the meshes are allocated */
    const char *opaque; /* name of the object of the surroundings that the next shape begins; NULL:
                         * it belongs to the last one */
};

/* Checks that the numbers of a shape are finite, and its indices in range. */
MUST_USE enum status model_shape_check(const struct model_import *import,
                                       const struct model_shape *shape);

void model_build_init(struct model_build *build, struct model_import *import, struct model *model);

/* Counts what model_build_add() will add; then the meshes are allocated; then all is added in the
 * same order; then equal vertices are merged. */
MUST_USE enum status model_build_count(struct model_build *build, enum model_part part,
                                       uint64_t vertex_count, uint64_t index_count);
MUST_USE enum status model_build_allocate(struct model_build *build);
MUST_USE enum status model_build_add(struct model_build *build, enum model_part part,
                                     const struct model_shape *shape, mat4s model_from_shape);
MUST_USE enum status model_build_end(struct model_build *build);

/* Lists the materials of a file of which all is an object or surroundings: the object's is the last
 * one, left to the settings. */
MUST_USE enum status model_build_bare_object(struct model_build *build);

/* Makes the normals that are {0} and merges equal vertices, but those of different objects of the
 * surroundings: `starts` has the first vertex of each, before and afterwards. Returns false when
 * out of memory. */
MUST_USE bool model_join_vertices(struct mesh *mesh, uint32_t *starts, uint32_t start_count);

/* Clamps a finite colour to 0 to 1 or, if it is unlit, MODEL_RADIANCE_MAX; returns whether that
 * changes it. One that is not finite stays. */
bool model_color_clamp(vec3s *color, bool is_unlit);

/* Logs a warning if colours of the file were clamped. For files that are accepted. */
void model_color_warn(const struct model_import *import);

#endif
