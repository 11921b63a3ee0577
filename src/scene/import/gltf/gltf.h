/*
 * gltf.h: internal interface of the glTF 2.0 importer (.gltf, .glb), shared by gltf_*.c.
 *
 * jansson parses the JSON. Values are accessed through struct gltf_object, which holds its location
 * in the file, and through functions that check type and range. The first fault is logged as "FILE:
 * materials[3]: expected ..." and kept in gltf.status. After a fault, functions return their
 * fallback values, so callers only need to check the status before they rely on a value. Faults of
 * textures and animations reject no file: between gltf_attempt_begin() and gltf_attempt_end(),
 * faults are recorded instead of logged.
 */
#ifndef FIRN_SCENE_IMPORT_GLTF_GLTF_H
#define FIRN_SCENE_IMPORT_GLTF_GLTF_H

#include <jansson.h>
#include "src/scene/geometry/affine.h"
#include "src/scene/import/importer.h"

enum {
    GLTF_LOCATION_SIZE = 96,
};

/* Index value for "none". */
static const uint32_t gltf_none = UINT32_MAX;

/* Byte range, which is borrowed unless `owned` is set. */
struct gltf_bytes {
    const uint8_t *bytes;
    uint8_t *owned;
    size_t size;
};

/* Vertex displacements of a morph target: owned arrays of 3 floats per vertex, NULL if absent. */
struct gltf_target {
    float *positions, *normals;
};

/* Triangles of one material (a glTF primitive). All arrays are owned. */
struct gltf_primitive {
    uint32_t material; /* index into gltf.materials */
    uint32_t vertex_count, index_count;
    uint32_t *indices;
    float *positions;
    float *normals;   /* 3 per vertex; NULL if absent */
    float *colors;    /* RGBA, 4 per vertex */
    float *uvs;       /* mesh_vertex.uv, 2 per vertex */
    float *other_uvs; /* mesh_extra.uv, 2 per vertex */
    float *tangents;  /* tangent and bitangent's sign per vertex */
    float *joints;    /* 4 skin joint indices per vertex */
    float *weights;   /* 4 per vertex; NULL without `joints` */
    struct gltf_target *targets;
    uint32_t target_count;
};

struct gltf_mesh {
    struct gltf_primitive *primitives;
    uint32_t count;
    bool is_used;
};

struct gltf_node {
    char name[MATERIAL_NAME_SIZE];
    double translation[3], scale[3];
    double rotation[4];   /* unit quaternion: x, y, z, w */
    struct affine matrix; /* used instead of TRS if has_matrix */
    bool has_matrix;
    bool is_listed;
    uint32_t parent; /* index into gltf.order, or gltf_none */
    uint32_t mesh, camera, skin;
    float *weights; /* owned morph target weights */
    uint32_t weight_count;
    struct affine model_from_node; /* in the file's coordinates, not relative to model.origin */
    struct affine *instances; /* node_from_instance transforms, instance_count of them; owned */
    uint32_t instance_count;
};

/* A texture reference of a material (textureInfo in glTF). */
struct gltf_texture {
    uint32_t image;  /* index of the image, or gltf_none */
    uint32_t uv_set; /* n of TEXCOORD_n */
    uint32_t wrap_u, wrap_v;
    vec3s rows[2]; /* KHR_texture_transform rows for (u, v, 1) */
};

struct gltf_material {
    struct material material; /* gltf_images_read() sets its texture layers */
    uint32_t mesh_flags;      /* bits MESH_UNLIT, MESH_CUTOUT */
    struct gltf_texture textures[MATERIAL_TEXTURE_COUNT];
    uint32_t uv_set;       /* n of mesh_vertex.uv's TEXCOORD_n, or gltf_none */
    vec3s uv_rows[2];      /* transform of set `uv_set` to mesh_vertex.uv */
    uint32_t other_uv_set; /* n of mesh_extra.uv's TEXCOORD_n, or gltf_none */
    float ior;             /* index of refraction; 0 if absent */
};

/* Features of a file that the importer recognises but the renderer does not draw. */
enum gltf_undrawn {
    GLTF_TRANSMISSIVE_ALPHA, /* alpha of transmissive materials */
    GLTF_TRANSMISSIVE_EMISSION,
    GLTF_TRANSMISSIVE_METALLIC,
    GLTF_TRANSMISSIVE_OCCLUSION,
    GLTF_TRANSMISSIVE_COAT,
    GLTF_TRANSMISSIVE_SPECULAR,
    GLTF_TRANSMISSIVE_THICKNESS,
    GLTF_COAT_NORMAL,
    GLTF_ATTENUATION_DISTANCE,
    GLTF_THIRD_UV_SET,
    GLTF_NO_IMAGE,
    GLTF_NEAREST_FILTER,
    GLTF_COLORS_WITHOUT_MATERIAL,
    GLTF_ANIMATION,
    GLTF_MORE_COLORS,
    GLTF_MORE_JOINTS,
    GLTF_MORPHED_COLORS,
    GLTF_POINTS,
    GLTF_OTHER_SCENES,
    GLTF_UNDRAWN_COUNT,
};

struct gltf {
    const char *path;
    struct model_import *import;
    enum status status; /* of the first fault */
    uint8_t *file;      /* contents of the whole file */
    json_t *root;
    struct gltf_bytes binary;   /* binary chunk of a .glb file */
    struct gltf_bytes *buffers; /* one per buffer of the file */
    struct gltf_bytes *views;   /* decompressed buffer views, else {0} */
    struct gltf_node *nodes;
    uint32_t node_count;
    uint32_t animation;  /* playing animation; gltf_none at rest */
    float time;          /* animation time, seconds */
    const char *objects; /* model_pose.objects; NULL if there are none */
    uint32_t *order;     /* nodes of the scene, parents first */
    uint32_t order_count;
    struct gltf_mesh *meshes;
    uint32_t mesh_count;
    struct gltf_material *materials; /* file's materials, then the default */
    uint32_t material_count;
    double origin[3];        /* model.origin, known after the first pass of gltf_build() */
    uint32_t undrawn;        /* bits 1 << enum gltf_undrawn */
    uint32_t clamped_count;  /* materials with factors out of range */
    bool has_unordered_keys; /* keyframes with repeated or decreasing times */
    bool has_weight_sums;    /* skin weights whose sum is not 1 */
    struct model_loss
        *attempt; /* records faults between gltf_attempt_begin() and _end(); or NULL */
};

/* ---- JSON ---- */

/* JSON object in the file. An absent object is treated as one without members. */
struct gltf_object {
    struct gltf *gltf;
    const json_t *json; /* NULL if the object is absent */
    char location[GLTF_LOCATION_SIZE];
};

/* Logs "FILE: LOCATION: ..." unless a fault was logged earlier, and returns STATUS_DATA. */
enum status gltf_fault(const struct gltf_object *object, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* Begins an attempt to read what the model can be drawn without. Faults are recorded in *loss.
 * After an earlier fault of the file, it does nothing. */
void gltf_attempt_begin(struct gltf *gltf, struct model_loss *loss);
/* Ends an attempt, and clears the status if only the attempt had a fault. Returns true if there was
 * no fault. */
bool gltf_attempt_end(struct gltf *gltf);

/* Logs that memory ran out, unless a fault was logged earlier, and returns gltf->status. */
enum status gltf_out_of_memory(struct gltf *gltf);

struct gltf_object gltf_top(struct gltf *gltf);
/* Returns element `index` of a top-level array such as "nodes". */
struct gltf_object gltf_element(struct gltf *gltf, const char *list, uint32_t index);
struct gltf_object gltf_member(const struct gltf_object *object, const char *key);
struct gltf_object gltf_extension(const struct gltf_object *object, const char *name);
struct gltf_object gltf_item(const struct gltf_object *object, const char *key, uint32_t index);

/* Returns the length of a member array; 0 if it is absent. */
uint32_t gltf_length(const struct gltf_object *object, const char *key);
uint32_t gltf_list_length(struct gltf *gltf, const char *list);

/* Returns a member's value, or `fallback` if the member is absent. */
float gltf_number(const struct gltf_object *object, const char *key, float fallback);
bool gltf_flag(const struct gltf_object *object, const char *key);
uint64_t gltf_count(const struct gltf_object *object, const char *key, uint64_t fallback);
const char *gltf_string(const struct gltf_object *object, const char *key, const char *fallback);

/* Returns a member that is an index into the top-level array `list`; gltf_none if it is absent. */
uint32_t gltf_index(const struct gltf_object *object, const char *key, const char *list);
/* Returns element `index` of a member array that holds indices into the top-level array `list`. */
uint32_t gltf_index_at(const struct gltf_object *object, const char *key, uint32_t index,
                       const char *list);

/* Copies a member that is an array of `count` numbers, each in the range of a float. Returns false
 * if the member is absent or invalid. */
bool gltf_floats(const struct gltf_object *object, const char *key, float *numbers, uint32_t count);
bool gltf_doubles(const struct gltf_object *object, const char *key, double *numbers,
                  uint32_t count);

/* ---- bytes ---- */

/* Opens the file, checks its version and required extensions, and reads its buffers. */
MUST_USE enum status gltf_open(struct gltf *gltf);
void gltf_close(struct gltf *gltf);

/* Reads the bytes of a URI: decodes a "data:" URI, or reads a file in the model's folder. */
enum status gltf_read_uri(const struct gltf_object *object, const char *uri,
                          struct gltf_bytes *bytes);

/* Returns a buffer view's bytes, or none after a fault. *stride is 0 if the view has no stride. */
struct gltf_bytes gltf_view(struct gltf *gltf, uint32_t index, size_t *stride);

/* Returns the bytes given by an object's members buffer, byteOffset and byteLength. */
struct gltf_bytes gltf_view_bytes(const struct gltf_object *object);

/* Decompresses a buffer view with EXT_ or KHR_meshopt_compression; `view` owns the result. */
void gltf_meshopt_decode(const struct gltf_object *extension, struct gltf_bytes *view);

/* ---- accessors ---- */

/* Values of an accessor as floats; `values` is owned. */
struct gltf_array {
    float *values;
    uint32_t count, width; /* elements; components per element */
};

/* Reads an accessor as floats; normalised integers become -1 to 1. Returns false after a fault. */
MUST_USE bool gltf_read_floats(struct gltf *gltf, uint32_t accessor, struct gltf_array *array);

/* Returns the values of an unsigned integer accessor, freed by the caller; NULL after a fault. */
uint32_t *gltf_read_indices(struct gltf *gltf, uint32_t accessor, uint32_t *count);

/* ---- the scene ---- */

MUST_USE enum status gltf_extensions_check(struct gltf *gltf);
/* Lists in *model the extensions that the file uses and its features that are not drawn. */
MUST_USE enum status gltf_extensions_read(struct gltf *gltf, struct model *model);
/* Logs warnings about undrawn features and unsupported extensions. The file must be accepted,
 * because the user sees only the first logged line of a rejected file. */
void gltf_warn(const struct gltf *gltf, const struct model *model);

/* Checks all indices in the file, including those in unused meshes, skins and cameras. */
MUST_USE enum status gltf_validate(struct gltf *gltf);
MUST_USE enum status gltf_nodes_read(struct gltf *gltf);
/* Returns the index of the animation with that name or number (from 0); gltf_none after a fault. */
uint32_t gltf_animation_find(struct gltf *gltf, const char *name);

/* Lists the animations of the file in *model. */
MUST_USE enum status gltf_animations_read(struct gltf *gltf, struct model *model);

/* Sets the transforms and morph weights of nodes to those of an animation at `time` (seconds). */
void gltf_animate(struct gltf *gltf, uint32_t index, float time);

/* Returns true if morph targets or a skin deform a primitive of a node's mesh. */
bool gltf_is_deformed(const struct gltf_node *node, const struct gltf_primitive *primitive);
/* Stores the deformed positions and normals in *posed, and zeroes other members. If the mesh is
 * skinned, the results are in model space, relative to gltf.origin. The caller frees *posed, even
 * after a fault. */
MUST_USE enum status gltf_skin_morph(struct gltf *gltf, const struct gltf_node *node,
                                     const struct gltf_primitive *primitive,
                                     struct gltf_primitive *posed);

/* Gives each corner of a primitive a vertex of its own, so that triangles share no normals. Drops
 * tangents. The indices must be in range. Returns false when out of memory. */
MUST_USE bool gltf_split_corners(struct gltf_primitive *primitive);
/* Returns the normals of the triangles whose corners are consecutive vertices, 3 numbers per
 * vertex, freed by the caller; NULL when out of memory. */
float *gltf_flat_normals(const float *positions, uint32_t vertex_count);

MUST_USE enum status gltf_materials_read(struct gltf *gltf);
/* Reads the texture references of a material. */
void gltf_texture_info_read(const struct gltf_object *object, struct gltf_material *material);
/* Reads the meshes that nodes of the scene refer to. */
MUST_USE enum status gltf_meshes_read(struct gltf *gltf);
void gltf_primitive_finish(struct gltf_primitive *primitive);
MUST_USE enum status gltf_images_read(struct gltf *gltf, struct model *model);
MUST_USE enum status gltf_build(struct gltf *gltf, struct model *model,
                                enum model_role default_role);
/* Reads the cameras of the scene into *model, whose object mesh must be complete. */
MUST_USE enum status gltf_cameras_read(struct gltf *gltf, struct model *model);
/* Reads the punctual lights of the scene into *model. */
MUST_USE enum status gltf_lights_read(struct gltf *gltf, struct model *model);
/* Reads the environment lookup box of the first node with extras.firn.box into *model. */
MUST_USE enum status gltf_box_read(struct gltf *gltf, struct model *model);

#endif
