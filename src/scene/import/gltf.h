/*
 * gltf.h: shared by the files that read glTF 2.0 (.gltf, .glb), gltf_*.c: the state meanwhile.
 *
 * The JSON is parsed by jansson. Its values are reached through struct gltf_object, which knows
 * where in the file it is, and by functions that check type and range. The first fault is logged,
 * as "FILE: materials[3]: expected ...", and kept in gltf.status; functions after a fault return
 * their fallbacks, so that callers need to look at the status only before they rely on a value.
 */
#ifndef FIRN_SCENE_IMPORT_GLTF_H
#define FIRN_SCENE_IMPORT_GLTF_H

#include <jansson.h>
#include "src/scene/import/model_import.h"

enum {
    GLTF_PLACE_SIZE = 96,
};

/* An index of nothing. */
static const uint32_t gltf_none = UINT32_MAX;

/* Bytes that are borrowed unless `owned` is set. */
struct gltf_bytes {
    const uint8_t *bytes; /* may be NULL */
    uint8_t *owned;
    size_t size;
};

/* What a morph target adds, times its weight, to each vertex; 3 numbers, or NULL. Owned. */
struct gltf_target {
    float *positions, *normals;
};

/* Triangles of one material, all arrays owned. */
struct gltf_primitive {
    uint32_t material; /* index into gltf.materials */
    uint32_t vertex_count, index_count;
    uint32_t *indices;
    float *positions;
    float *normals;   /* NULL: none, as in those below */
    float *colors;    /* 4 of each vertex */
    float *uvs;       /* mesh_vertex.uv; 2 */
    float *other_uvs; /* mesh_extra.uv; 2 */
    float *tangents;  /* 4 */
    float *joints;    /* 4 indices of joints of the node's skin */
    float *weights;   /* of them, 4; both or none are there */
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
    vec3s translation, scale;
    versors rotation;
    mat4s matrix; /* valid if has_matrix; else the three above are */
    bool has_matrix;
    bool is_listed;
    uint32_t parent; /* position in gltf.order, or gltf_none */
    uint32_t mesh, camera, skin;
    float *weights; /* of the mesh's morph targets; owned */
    uint32_t weight_count;
    mat4s model_from_node;
    mat4s *instances; /* node_from_instance, instance_count of them; owned */
    uint32_t instance_count;
};

/* A texture as a material names it. */
struct gltf_texture {
    uint32_t image;  /* or gltf_none */
    uint32_t uv_set; /* of the vertices */
    uint32_t wrap_u, wrap_v;
    vec3s rows[2]; /* transform of coordinates (u, v, 1) */
};

struct gltf_material {
    struct material material; /* its layers are set by gltf_textures_read() */
    uint32_t mesh_flags;      /* MESH_UNLIT, MESH_CUTOUT */
    struct gltf_texture textures[MATERIAL_TEXTURE_COUNT];
    uint32_t uv_set;       /* of which mesh_vertex.uv is made, or gltf_none */
    vec3s uv_rows[2];      /* how */
    uint32_t other_uv_set; /* of which mesh_extra.uv is made, as it is, or gltf_none */
    float ior;             /* as the file has it; 0: not given, or legacy */
};

/* What a file has, and this program reads but does not draw. */
enum gltf_undrawn {
    GLTF_CLEAR_ALPHA, /* of transmissive materials, as the next five */
    GLTF_CLEAR_EMISSION,
    GLTF_CLEAR_METALLIC,
    GLTF_CLEAR_OCCLUSION,
    GLTF_CLEAR_SPECULAR,
    GLTF_CLEAR_THICKNESS,
    GLTF_OTHER_SET,
    GLTF_PICTURELESS,
    GLTF_UNSMOOTHED,
    GLTF_BARE_COLORS,
    GLTF_ANIMATION,
    GLTF_MORE_COLORS,
    GLTF_MORE_JOINTS,
    GLTF_MORPHED_COLORS,
    GLTF_POINTS,
    GLTF_MORE_SCENES,
    GLTF_UNDRAWN_COUNT,
};

struct gltf {
    const char *path;
    struct model_import *import;
    enum status status; /* of the first fault */
    uint8_t *file;      /* all bytes */
    json_t *root;
    struct gltf_bytes binary;   /* the second part of a .glb */
    struct gltf_bytes *buffers; /* as many as there are */
    struct gltf_bytes *views;   /* those that had to be decompressed; others are {0} */
    struct gltf_node *nodes;
    uint32_t node_count;
    uint32_t animation;  /* that moves the nodes, or gltf_none: they are at rest */
    float time;          /* of it, seconds */
    const char *objects; /* struct model_pose; NULL: none */
    uint32_t *order;     /* nodes of the scene, parents first */
    uint32_t order_count;
    struct gltf_mesh *meshes;
    uint32_t mesh_count;
    struct gltf_material *materials; /* one more than the file has, the default */
    uint32_t material_count;
    uint32_t undrawn;       /* bits of enum gltf_undrawn */
    uint32_t clamped_count; /* materials with numbers out of range */
};

/* ---- JSON ---- */

/* An object of the file. Of one that is not there, all members are absent. */
struct gltf_object {
    struct gltf *gltf;
    const json_t *json; /* NULL: it is not there */
    char place[GLTF_PLACE_SIZE];
};

/* Logs "FILE: PLACE: ..." unless there was a fault before, and returns STATUS_DATA. */
enum status gltf_fault(const struct gltf_object *object, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* Notes that memory is short. */
enum status gltf_no_memory(struct gltf *gltf);

struct gltf_object gltf_top(struct gltf *gltf);
/* Returns an element of an array of the top, "nodes". */
struct gltf_object gltf_element(struct gltf *gltf, const char *list, uint32_t index);
struct gltf_object gltf_member(const struct gltf_object *object, const char *key);
struct gltf_object gltf_extension(const struct gltf_object *object, const char *name);
struct gltf_object gltf_item(const struct gltf_object *object, const char *key, uint32_t index);

/* Returns the number of elements of a member that is an array, or 0 if it is absent. */
uint32_t gltf_length(const struct gltf_object *object, const char *key);
uint32_t gltf_list_length(struct gltf *gltf, const char *list);

/* Return a member's value, or the fallback if it is absent. */
float gltf_number(const struct gltf_object *object, const char *key, float fallback);
bool gltf_flag(const struct gltf_object *object, const char *key);
uint64_t gltf_count(const struct gltf_object *object, const char *key, uint64_t fallback);
const char *gltf_string(const struct gltf_object *object, const char *key, const char *fallback);

/* Returns an index into an array of the top, or gltf_none if it is absent. */
uint32_t gltf_index(const struct gltf_object *object, const char *key, const char *list);
/* The same for an element of a member that is an array. */
uint32_t gltf_index_at(const struct gltf_object *object, const char *key, uint32_t index,
                       const char *list);

/* Copies a member that is an array of `count` numbers. Returns false if it is absent or wrong. */
bool gltf_floats(const struct gltf_object *object, const char *key, float *numbers, uint32_t count);

/* ---- bytes ---- */

/* Opens the file and its buffers, and checks the version. */
MUST_USE enum status gltf_open(struct gltf *gltf);
void gltf_close(struct gltf *gltf);

/* Reads the bytes of a URI. "data:" is decoded, and others are files in the model's folder. */
enum status gltf_read_uri(const struct gltf_object *object, const char *uri,
                          struct gltf_bytes *bytes);

/* Returns the bytes of a buffer view; *stride is 0 if there is none. After a fault they are {0}. */
struct gltf_bytes gltf_view(struct gltf *gltf, uint32_t index, size_t *stride);

/* Returns those that the fields buffer, byteOffset and byteLength of an object describe. */
struct gltf_bytes gltf_view_bytes(const struct gltf_object *object);

/* Decompresses a view by its EXT_ or KHR_meshopt_compression; `view` owns the bytes. */
void gltf_meshopt_decode(const struct gltf_object *extension, struct gltf_bytes *view);

/* ---- accessors ---- */

/* Numbers that an accessor describes; `values` is owned. */
struct gltf_array {
    float *values;
    uint32_t count, width; /* elements; numbers of each */
};

/* Reads an accessor as floats; normalised integers become -1 to 1. After a fault returns false, and
 * *array is {0}. */
MUST_USE bool gltf_read_floats(struct gltf *gltf, uint32_t accessor, struct gltf_array *array);

/* Reads an accessor of scalars as unsigned integers, which the caller frees; NULL after a fault. */
uint32_t *gltf_read_indices(struct gltf *gltf, uint32_t accessor, uint32_t *count);

/* ---- the scene ---- */

MUST_USE enum status gltf_extensions_check(struct gltf *gltf);
/* Lists the extensions that the file uses, each once, and what is not drawn, in *model. */
MUST_USE enum status gltf_extensions_read(struct gltf *gltf, struct model *model);
/* Logs warnings: what is read, but not drawn, and what is not supported. Last of all, for files
 * that are accepted, because of others only the first line reaches the user. */
void gltf_warn(const struct gltf *gltf, const struct model *model);

/* Checks indices everywhere in the file, for what the scene does not use is not read. */
MUST_USE enum status gltf_check(struct gltf *gltf);
MUST_USE enum status gltf_nodes_read(struct gltf *gltf);
/* Returns an animation by its name or its number from 0; gltf_none after a fault. */
uint32_t gltf_animation_find(struct gltf *gltf, const char *name);

/* Lists the animations of the file in *model. */
MUST_USE enum status gltf_animations_read(struct gltf *gltf, struct model *model);

/* Moves nodes to where an animation has them at a time, seconds. */
void gltf_animate(struct gltf *gltf, uint32_t index, float time);

/* Whether morph targets or a skin change a primitive of a node's mesh; and its positions and
 * normals then, all else {0}. With a skin they are in the space of the model. The caller finishes
 * *posed, also after a fault. */
bool gltf_is_posed(const struct gltf_node *node, const struct gltf_primitive *primitive);
MUST_USE enum status gltf_pose(struct gltf *gltf, const struct gltf_node *node,
                               const struct gltf_primitive *primitive,
                               struct gltf_primitive *posed);

MUST_USE enum status gltf_materials_read(struct gltf *gltf);
/* Reads the textures of a material. */
void gltf_material_textures(const struct gltf_object *object, struct gltf_material *material);
/* Reads the meshes that nodes of the scene have. */
MUST_USE enum status gltf_meshes_read(struct gltf *gltf);
void gltf_primitive_finish(struct gltf_primitive *primitive);
MUST_USE enum status gltf_textures_read(struct gltf *gltf, struct model *model);
MUST_USE enum status gltf_build(struct gltf *gltf, struct model *model,
                                enum model_part everything_is);
/* Reads the cameras of the scene into *model, whose object must be filled in. */
MUST_USE enum status gltf_cameras_read(struct gltf *gltf, struct model *model);
/* Reads the lights of the scene into *model. */
MUST_USE enum status gltf_lights_read(struct gltf *gltf, struct model *model);
/* Reads the box of the first node that names one into *model. */
MUST_USE enum status gltf_box_read(struct gltf *gltf, struct model *model);

#endif
