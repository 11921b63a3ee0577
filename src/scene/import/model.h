/*
 * model.h: loads model files.
 *
 * Reads .gltf and .glb (gltf.h), and .obj and .ply (model_plain.h). All meshes are merged with
 * their transforms into two: the refractive objects and their surroundings. In a glTF file with a
 * mesh whose material has KHR_materials_transmission (factor > 0), and in an OBJ file whose MTL
 * file has a transmissive material (docs/models.md), such meshes are the objects and all others the
 * surroundings; in any other file `everything_is` decides. Coordinates are those of the file. Each
 * instance of a mesh in a node is an object; a file without materials has one alone.
 * Points and lines are left out; polygons are triangulated; identical vertices are merged.
 *
 * Normals are taken from the file, and smooth ones are made where missing. Vertex colours, base
 * colours and base colour textures become mesh_vertex.color, .uv and .material;
 * KHR_materials_unlit, and in .obj and .ply files vertex colours without normals or materials, mean
 * MESH_UNLIT; glTF's alphaMode MASK means MESH_CUTOUT. Vertex colours and .mtl's Kd are taken as
 * linear, texture colours as sRGB. Colours are clamped to 0 to 1, unlit vertex colours, which are
 * radiances, to 0 to 65504; a warning says so. KHR_texture_transform is part of .uv. Warnings name
 * what of a glTF file is not drawn, and its extensions that are not supported. Files that a model
 * names must be within its folder. decode.h reads untrusted models.
 *
 * A node's extras in a glTF file may name a box, { "firn": { "box": [[x,y,z],[x,y,z]] } }, its
 * least corner first, in metres of the file's space, independent of the node's transform. The first
 * such node counts.
 *
 * Ownership: a model owns its arrays; model_finish() frees them; a {0} model is fine.
 * Threads:   any
 * Errors:    one line is logged, with the file's name and the place, and *model is {0}:
 *            STATUS_NO_INPUT  missing or unreadable
 *            STATUS_DATA      unknown format, a required extension that is not supported, syntax
 *                             error, empty, no triangles, a number that is not finite, a coordinate
 *                             beyond 1e6, an index too large, an index of refraction not within 1
 *                             to 4, a damaged or missing texture, an invalid box
 *            STATUS_TRY_AGAIN out of memory
 */
#ifndef FIRN_SCENE_IMPORT_MODEL_H
#define FIRN_SCENE_IMPORT_MODEL_H

#include "src/base/status.h"
#include "src/scene/camera.h"
#include "src/scene/light.h"
#include "src/scene/object.h"

/*
 * Square 8-bit textures of one size, RGBA, rows from the top, one after another: at most 4096, of
 * at most 2048 texels a side, 512 MiB together. Textures of other sizes were resampled.
 */
struct texture_layers {
    uint8_t *texels;      /* size * size * 4 * count bytes */
    uint32_t size, count; /* size is a power of two; both 0 when there are none */
};

enum model_camera_kind {
    MODEL_PERSPECTIVE,
    MODEL_ORTHOGRAPHIC,
    MODEL_CAMERA_KIND_COUNT,
};

/* A camera of a file, as its node has it. */
struct model_camera {
    char name[MATERIAL_NAME_SIZE]; /* of the node, else of the camera; "" if neither has one */
    uint32_t kind;                 /* enum model_camera_kind */
    float height; /* of what an orthographic picture shows, metres; 0 of a perspective one */
    struct camera camera; /* its target is at the object's distance; the angle of an orthographic
                             one means nothing */
};

/* An animation of a file: of nodes, cameras among them, skins and morph targets. */
struct model_animation {
    char name[MATERIAL_NAME_SIZE]; /* "" if it has none */
    float seconds;                 /* time of its last key; it begins at 0 */
};

#define MODEL_OPAQUE_WIDTH 2048
#define MODEL_UNDRAWN_SIZE 1024

enum model_support {
    MODEL_DRAWN,
    MODEL_APPROXIMATED, /* drawn in part, or not as it is meant */
    MODEL_IGNORED,
    MODEL_SUPPORT_COUNT,
};

/* An extension that a file uses. */
struct model_extension {
    char name[MATERIAL_NAME_SIZE];
    uint32_t support; /* enum model_support */
};

struct model {
    struct mesh object; /* of all refractive objects, one after another */
    struct mesh surroundings;
    struct object *objects; /* parts of `object`; their ranks are not set */
    uint32_t object_count;
    struct material *materials; /* of the file, or files; objects and vertices refer to them */
    uint32_t material_count;
    uint32_t *opaque_starts; /* first vertex of each object of the surroundings, ascending; up to
                              * the first start, they are of none. In whole rows of
                              * MODEL_OPAQUE_WIDTH, which zeros fill */
    char (*opaque_names)[MATERIAL_NAME_SIZE]; /* of their nodes; "" if they have none */
    uint32_t opaque_count;
    struct texture_layers textures; /* sRGB colours, of both meshes */
    struct texture_layers numbers;  /* textures of what is no colour (material.h) */
    struct model_camera *cameras;   /* of the file, in the order of its nodes */
    uint32_t camera_count;
    struct light *lights; /* of the file, in the order of its nodes */
    uint32_t light_count;
    struct model_extension *extensions;
    uint32_t extension_count;
    uint32_t undrawn;                       /* bit i: the file has model_undrawn_name(i) */
    char undrawn_words[MODEL_UNDRAWN_SIZE]; /* what an OBJ or PLY file has that is not drawn, each
                                             * with a newline at its end */
    struct model_animation *animations;
    uint32_t animation_count;
    uint32_t animation;   /* that poses the model, + 1; 0: it is at rest */
    struct camera camera; /* the first perspective one; valid if has_camera */
    float ior;            /* KHR_materials_ior of the object; valid if has_ior */
    struct box box;       /* around the object (refract.lookup=box); valid if has_box */
    bool has_camera;
    bool has_box;
    bool has_ior;
};

enum model_part {
    MODEL_OBJECT,
    MODEL_SURROUNDINGS,
    MODEL_BY_MATERIALS, /* surroundings if the file has materials, else an object */
};

/* When a model is looked at, and what of it is an object. Only glTF files have animations. */
struct model_pose {
    const char *animation; /* its name, or its number from 0; NULL: the model is at rest, unless */
    bool is_first;         /* it is the first one, if the file has any */
    float time;            /* seconds */
    const char *objects;   /* names of nodes with meshes, or else of materials, each with a newline
                              at its end: refractive objects whatever their materials say, and if
                              there are any, nothing else without transmission is; may be NULL */
};

/* Loads a file; `everything_is` is the part of all meshes if none has a transmissive material. */
MUST_USE enum status model_load(struct model *model, const char *path,
                                enum model_part everything_is);

/* Loads a file as model_load() does, with nodes, skins and morph targets as they are at a time;
 * STATUS_DATA, too, if the file has no such animation. */
MUST_USE enum status model_load_posed(struct model *model, const char *path,
                                      enum model_part everything_is, const struct model_pose *pose);

/*
 * Appends both meshes of `other` to the surroundings of *model, renumbers textures and resamples
 * them to the larger size; the box of `other`, if any, replaces that of *model. `other` is {0}
 * afterwards in any case. On failure *model is unchanged: STATUS_TRY_AGAIN when out of memory,
 * STATUS_DATA for more than 4096 textures, or 8191 materials.
 */
MUST_USE enum status model_add_surroundings(struct model *model, struct model *other);

/* Adds an object of the surroundings, whose vertices begin at `start`, at or after the last one's.
 * Returns false when out of memory. */
MUST_USE bool model_opaque_add(struct model *model, const char *name, uint32_t start);

/* Returns the number, from 1, of the object that a vertex of the surroundings is of; 0: of none. */
uint32_t model_opaque_find(const struct model *model, uint32_t vertex);

/* Returns the name of a kind of thing that is read, but not drawn, "normal textures"; NULL after
 * the last one. */
const char *model_undrawn_name(uint32_t index);

void model_finish(struct model *model);

#endif
