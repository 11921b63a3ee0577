/* importer.h: declares the internal interface of the model importers (glTF, OBJ, PLY, STL): import
 * state, formats, textures, mesh building. If a function returns a status other than STATUS_OK, it
 * has logged one line. */
#ifndef FIRN_SCENE_IMPORT_IMPORTER_H
#define FIRN_SCENE_IMPORT_IMPORTER_H

#include <stdio.h>
#include "src/scene/geometry/affine.h"
#include "src/scene/import/model.h"
#include "src/scene/import/model_shells.h"

enum {
    MODEL_COORDINATE_MAX = 1000000, /* maximum distance of a vertex from model.origin, per axis */
    MODEL_ORIGIN_MAX = 1000000000,  /* maximum coordinate of model.origin, and of cameras from it */
    MODEL_NODE_MAX = 1 << 22,
    MODEL_ELEMENT_MAX = 1 << 28, /* maximum vertices or indices per mesh */
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

/* Parts of a file that cannot be read and that the model is drawn without. */
struct model_loss {
    char first[256]; /* location and reason of the first one */
    uint32_t count;
};

struct model_import {
    const char *path;
    struct model_loss textures, channels; /* channels of animations */
    const double *origin;                 /* model_pose.origin; may be NULL */
    char refused_file[256];               /* first file outside folder, else "" */
    uint32_t clamped_materials;           /* number of materials with clamped colours */
    uint32_t clamped_vertices;
    uint32_t collapsed_triangles; /* degenerate triangles of far shapes */
    uint32_t doubled_triangles;   /* dropped by model_drop_doubled_faces() */
    struct shell_counts shells;   /* numbers of changed shells */
    char missing_file[256];       /* first referenced file that cannot be opened, else "" */
    bool has_large_texture;       /* a warning about downsampling was logged */
};

/* Model file format, identified by its lower-case suffix, such as "glb". */
struct model_format {
    const char *suffix;
    const char *name; /* for messages: "binary glTF" */
    bool is_gltf;
};

/* Finds the format of a model file by the file's suffix. If the suffix is unknown, or the file's
 * first bytes do not match the format, returns STATUS_DATA. */
MUST_USE enum status model_format_find(const char *path, const struct model_format **format);

/* Loads a glTF file, posed by `pose`. */
MUST_USE enum status model_load_gltf(struct model_import *import, struct model *model,
                                     enum model_role default_role, const struct model_pose *pose);
/* Loads an OBJ, PLY or STL file; `suffix` is "obj", "ply" or "stl". */
MUST_USE enum status model_load_obj_ply(struct model_import *import, const char *suffix,
                                        struct model *model, enum model_role default_role);

/* ---- files ---- */

/* Opens the model file or a file that the model refers to. `user` is a struct model_import. If the
 * file cannot be opened or is outside the model's folder, records its name in *user and returns
 * NULL. */
FILE *model_file_open(void *user, const char *path);

/* Returns a description of why model_file_open() returned NULL for a file. */
const char *model_file_fault(const char *path);

/* Converts a file reference (URI, Windows path or other path) to a relative path, in place. If the
 * path leaves the model's folder, returns false: "../a", "/a", "https://a", URI "file:a". */
MUST_USE bool model_file_clean(char *name, bool is_uri);

/* Returns a file's path in the model's folder, freed by the caller; NULL when out of memory. */
char *model_file_join(const char *model, const char *name);

/* ---- textures ---- */

/* Conversion of an image of an MTL file to the texel layout of a glTF texture. */
enum model_texture_conversion {
    MODEL_TEXTURE_SAME,
    MODEL_TEXTURE_TO_ALPHA,   /* white; alpha from alpha or grey */
    MODEL_TEXTURE_TO_NORMALS, /* height map, unless already normals */
};

/* Image of a texture layer: encoded in memory if `bytes` is set, else in a file. */
struct model_texture {
    const char *name; /* for messages */
    const uint8_t *bytes;
    size_t size;
    char *file;
    enum model_texture_conversion change;
    bool is_normal_map;
    char *alpha; /* file of a second image whose alpha or grey replaces alpha, or NULL */
};

/* Decodes images as sRGB colours or linear numbers. Resamples all to layers of one size. An image
 * that cannot be decoded becomes a neutral layer and is recorded in import->textures. */
MUST_USE enum status model_texture_load(struct model_import *import,
                                        const struct model_texture *textures, uint32_t count,
                                        bool are_numbers, struct texture_layers *layers);

/* Records a part of the file that the model is drawn without. */
void model_loss_add(struct model_loss *loss, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* Logs a warning for each kind of lost parts and lists it in model->undrawn_text. Call it only for
 * accepted files. */
void model_loss_warn(const struct model_import *import, struct model *model);

/* Returns the name of an image's unsupported format, such as "KTX2"; NULL if it is supported. */
const char *model_texture_unsupported_format(const struct model_texture *texture);

/* Merges two texture arrays, resampled to the larger size; the caller frees both->texels. */
MUST_USE enum status model_texture_merge(struct texture_layers *both,
                                         const struct texture_layers *first,
                                         const struct texture_layers *second, bool are_numbers);

/* ---- meshes ---- */

/* Triangles of one material in the space of their node. All arrays are borrowed. */
struct model_shape {
    const char *name;       /* for messages: "mesh 0" */
    const float *positions; /* 3 per vertex */
    const float *normals;   /* 3 per vertex; NULL to compute */
    const float *colors;    /* linear RGBA per vertex; or NULL */
    const float *uvs;       /* 2 per uv_stride floats; or NULL */
    uint32_t uv_stride;
    const float *other_uvs; /* mesh_extra.uv, 2 per vertex; or NULL */
    const float *tangents;  /* 4 per vertex, or NULL */
    bool is_flipped;        /* v = 0 at the bottom */
    const uint32_t *indices;
    uint32_t vertex_count, index_count;
    vec3s color;       /* colour multiplied with vertex colours */
    uint32_t material; /* mesh_vertex.material */
};

/* Refractive object under construction. */
struct model_build_object {
    uint32_t group;    /* objects of equal groups (consecutive) and media may close together */
    uint32_t override; /* equal and not 0: the same medium, whatever the materials; 0 for none */
    uint32_t first_vertex, vertex_count;
};

/* The two meshes of a model under construction. */
struct model_build {
    struct model_import *import;
    struct model *model;
    struct mesh *meshes[MODEL_ROLE_COUNT];
    uint64_t vertex_count[MODEL_ROLE_COUNT], index_count[MODEL_ROLE_COUNT];
    bool has_extras[MODEL_ROLE_COUNT];  /* set before the meshes are allocated */
    const char *surroundings_name;      /* next object's; NULL continues the last */
    struct model_build_object *objects; /* model->object_count elements; owned */
    uint32_t object_capacity;
    bool is_animated; /* nodes move, so objects of different nodes stay separate */
    double low[MODEL_ROLE_COUNT][3], high[MODEL_ROLE_COUNT][3]; /* bounds; low > high if empty */
};

/* Checks that the numbers of a shape are finite and its indices in range. */
MUST_USE enum status model_shape_check(const struct model_import *import,
                                       const struct model_shape *shape);

void model_build_init(struct model_build *build, struct model_import *import, struct model *model);

/* Counts a shape's vertices and indices. Count all shapes before allocating the meshes. */
MUST_USE enum status model_build_count(struct model_build *build, enum model_role role,
                                       uint64_t vertex_count, uint64_t index_count);
/* Extends the bounds of a mesh by the transformed box of `vertex_count` positions; without any, by
 * the transformed point (0, 0, 0). */
void model_build_extend(struct model_build *build, enum model_role role, const float *positions,
                        uint32_t vertex_count, const struct affine *model_from_shape);
/* Chooses model.origin by the bounds, and allocates the counted meshes. */
MUST_USE enum status model_build_allocate(struct model_build *build);
/* Adds a shape to an allocated mesh. `model_from_shape` is relative to model.origin. Add the shapes
 * in the order in which they were counted. */
MUST_USE enum status model_build_add(struct model_build *build, enum model_role role,
                                     const struct model_shape *shape,
                                     const struct affine *model_from_shape);
/* Adds a refractive object, whose triangles must be added to the mesh afterwards. Sets its first
 * index, and the first vertex of `params`. */
MUST_USE enum status model_build_add_object(struct model_build *build, const struct object *object,
                                            const struct model_build_object *params);

/* Adds one object for the whole file, with the material MATERIAL_FROM_SETTINGS. */
MUST_USE enum status model_build_default_object(struct model_build *build);

/* Keeps one of each pair of faces of opposite winding in objects that consist of such pairs, and
 * adds the number of the others to *dropped. Returns false when out of memory. */
MUST_USE bool model_drop_doubled_faces(struct model *model, uint32_t *dropped);

/* Joins objects that close together, and orients their shells. Needs the model's materials. */
MUST_USE enum status model_build_close_objects(struct model_build *build);

/* Completes the objects and meshes of a model: closes objects, computes missing normals, and welds
 * identical vertices. */
MUST_USE enum status model_build_end(struct model_build *build);

void model_build_finish(struct model_build *build);

/* Computes missing (zero) normals. Welds identical vertices within each surroundings object, and
 * updates `starts`, the objects' first vertices. Returns false when out of memory. */
MUST_USE bool model_weld_vertices(struct mesh *mesh, uint32_t *starts, uint32_t start_count);

/* Clamps a finite colour to the range 0 to 1. If `is_unlit`, the maximum is MODEL_RADIANCE_MAX.
 * Non-finite colours stay unchanged. Returns true if the colour changed. */
bool model_color_clamp(vec3s *color, bool is_unlit);

/* Logs warnings of clamped colours and collapsed triangles. Call it only for accepted files. */
void model_build_warn(const struct model_import *import);

#endif
