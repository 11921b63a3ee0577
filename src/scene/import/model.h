/*
 * model.h: model file loader and the imported model: meshes, objects, materials, cameras, lights.
 *
 * Reads .gltf and .glb (gltf.h), and .obj, .ply and .stl (obj_ply.h). All meshes are transformed
 * and merged into two: the refractive objects and the surroundings. If any mesh of a glTF file has
 * a material with KHR_materials_transmission (factor > 0), or an OBJ file's MTL file has a
 * transmissive material (docs/reference/models.md), meshes with such a material are the objects
 * and all others the surroundings; in any other file `default_role` decides. Coordinates are those
 * of the file, minus model.origin. Primitives of one instance of a mesh and one medium whose
 * shells close together are one object; a file without materials has a single object. Points and
 * lines are left out; polygons are triangulated; identical vertices are welded.
 *
 * Normals are taken from the file. Where they are missing, flat normals are computed for glTF
 * primitives, and smooth normals otherwise. Vertex colours, base colours and base colour textures
 * become mesh_vertex.color, .uv and .material. KHR_materials_unlit sets MESH_UNLIT, and so do
 * vertex colours without normals or materials in .obj and .ply files; glTF's alphaMode MASK sets
 * MESH_CUTOUT. Vertex colours and Kd of .mtl files are taken as linear, texture colours as sRGB.
 * Colours are clamped to 0 to 1, and unlit vertex colours, which are radiances, to 0 to 65504, with
 * a warning. KHR_texture_transform is applied to .uv. Warnings list the features of a glTF file
 * that are not drawn and its unsupported extensions.
 * Files that a model refers to must be within its folder. sandboxed_load.h reads untrusted models.
 *
 * The extras of a glTF node may define a box, { "firn": { "box": [[x,y,z],[x,y,z]] } }, minimum
 * corner first, in metres of the file's space, regardless of the node's transform. The first such
 * node counts.
 *
 * Ownership: a model owns its arrays; model_finish() frees them; a {0} model is fine. Threads: any.
 * Errors: one line is logged, with the file's name and the location, and *model is {0}.
 * STATUS_NO_INPUT: missing or unreadable. STATUS_TRY_AGAIN: out of memory. STATUS_DATA: unknown
 * format, unsupported required extension, syntax error, empty file, no triangles, non-finite
 * number, coordinate beyond 1e6 from model.origin, index out of range, index of refraction outside
 * 1 to 4, invalid box. Textures and animation channels that cannot be read are left out, with a
 * warning.
 */
#ifndef FIRN_SCENE_IMPORT_MODEL_H
#define FIRN_SCENE_IMPORT_MODEL_H

#include "src/base/status.h"
#include "src/scene/camera.h"
#include "src/scene/punctual_light.h"
#include "src/scene/refractive_object.h"

/* Array of square RGBA8 textures of one size, with rows from the top. Other sizes are resampled.
 * Limits: 4096 layers, 2048 texels per side, 512 MiB in total. */
struct texture_layers {
    uint8_t *texels; /* RGBA8 texels of all layers */
    /* texels per side (a power of two) and number of layers; both are 0 without textures */
    uint32_t size, count;
};

enum model_camera_kind {
    MODEL_PERSPECTIVE,
    MODEL_ORTHOGRAPHIC,
    MODEL_CAMERA_KIND_COUNT,
};

/* Camera of a model file, with its node's transform applied. */
struct model_camera {
    /* node's name, else camera's, else "" */
    char name[MATERIAL_NAME_SIZE];
    uint32_t kind; /* enum model_camera_kind */
    float height;  /* orthographic view's height, metres; else 0 */
    float aspect;  /* width / height of the view; 0 if the file does not state it */
    /* `target` is as far away as the object; fov_deg is unused for an orthographic camera */
    struct camera camera;
};

/* Animation of a model file: of nodes (including cameras), skins and morph targets. */
struct model_animation {
    char name[MATERIAL_NAME_SIZE]; /* "" if it has none */
    float seconds;                 /* duration: time of the last keyframe */
};

#define MODEL_SURROUNDINGS_ROW 2048
#define MODEL_UNDRAWN_SIZE     1024

enum model_support {
    MODEL_DRAWN,
    MODEL_APPROXIMATED, /* rendered partly or approximately */
    MODEL_IGNORED,
    MODEL_SUPPORT_COUNT,
};

/* Extension that the file uses. */
struct model_extension {
    char name[MATERIAL_NAME_SIZE];
    uint32_t support; /* enum model_support */
};

struct model {
    /* Position in the file's coordinates from which all other positions are counted, so that single
     * precision suffices far from the file's origin; 0 unless the model is far from it. */
    double origin[3];
    struct mesh object; /* all refractive objects, merged */
    struct mesh surroundings;
    struct object *objects; /* index ranges of `object`; ranks unset */
    uint32_t object_count;
    struct material *materials; /* referenced by objects and vertices */
    uint32_t material_count;
    /* First vertex of each surroundings object, ascending. Earlier vertices have no object. Zeros
     * pad the array to a multiple of MODEL_SURROUNDINGS_ROW, for upload as an image. */
    uint32_t *surroundings_starts;
    /* names of the surroundings objects' nodes; "" if unnamed */
    char (*surroundings_names)[MATERIAL_NAME_SIZE];
    uint32_t surroundings_object_count;
    struct texture_layers textures; /* sRGB colour textures of both meshes */
    struct texture_layers numbers;  /* linear (non-colour) textures (material.h) */
    struct model_camera *cameras;   /* the file's cameras, in node order */
    uint32_t camera_count;
    struct light *lights; /* the file's lights, in node order */
    uint32_t light_count;
    struct model_extension *extensions;
    uint32_t extension_count;
    uint32_t undrawn;                      /* bit i: feature model_undrawn_name(i) */
    char undrawn_text[MODEL_UNDRAWN_SIZE]; /* undrawn OBJ/PLY features, one per line */
    struct model_animation *animations;
    uint32_t animation_count;
    uint32_t animation;   /* index + 1; 0 at rest */
    struct camera camera; /* first perspective camera; valid if has_camera */
    float camera_aspect;  /* model_camera.aspect of `camera` */
    float ior;            /* object's KHR_materials_ior; valid if has_ior */
    struct box box;       /* box of refract.lookup=box; scene_load() sets it if !has_box */
    bool has_camera;
    bool has_box;
    bool has_ior;
};

enum model_role {
    MODEL_OBJECT,
    MODEL_SURROUNDINGS,
    MODEL_BY_MATERIALS, /* surroundings if the file has materials */
};

/* Animation pose of a glTF model, and the choice of its refractive objects. */
struct model_pose {
    /* animation name or number (from 0); NULL for the rest pose or if is_first is set */
    const char *animation;
    bool is_first;        /* use the first animation, if any */
    float time;           /* animation time, seconds */
    const double *origin; /* model.origin of another pose of the file; NULL to choose it */
    /* Names of the refractive objects, one per line, or NULL. Each name is of a node with a mesh,
     * or else of a material. Other meshes are surroundings unless transmissive. */
    const char *objects;
};

/* Loads a file. If no material is transmissive, all meshes have the role `default_role`. */
MUST_USE enum status model_load(struct model *model, const char *path,
                                enum model_role default_role);

/* Loads a file like model_load(), with nodes, skins and morph targets posed by `pose`. If the file
 * has no such animation, returns STATUS_DATA. */
MUST_USE enum status model_load_posed(struct model *model, const char *path,
                                      enum model_role default_role, const struct model_pose *pose);

/* Copies a model with all its arrays. When out of memory, returns false, and *to is zeroed. */
MUST_USE bool model_copy(struct model *to, const struct model *from);

/* Appends both meshes of `other` to the surroundings of *model. Renumbers textures, and resamples
 * the smaller ones. If `other` has a box, the box replaces the box of *model. `other` is always
 * zeroed. On failure *model is unchanged. Returns STATUS_TRY_AGAIN when out of memory, and
 * STATUS_DATA for more than 4096 textures or 8191 materials. */
MUST_USE enum status model_add_surroundings(struct model *model, struct model *other);

/* Adds a surroundings object whose first vertex is `start`. Add objects in ascending order of
 * `start`. Returns false when out of memory. */
MUST_USE bool model_surroundings_add_object(struct model *model, const char *name, uint32_t start);

/* Returns 1 + the index of the surroundings object that contains a vertex; 0 if there is none. */
uint32_t model_surroundings_find_object(const struct model *model, uint32_t vertex);

/* Returns the name of an undrawn feature, such as "thickness textures"; NULL past the last one. */
const char *model_undrawn_name(uint32_t index);

void model_finish(struct model *model);

#endif
