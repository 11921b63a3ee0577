/* obj_ply.h: contents of an OBJ, MTL, PLY or STL file before conversion to a model, and functions
 * that the readers share. If a function returns a status other than STATUS_OK, it logs one line. */
#ifndef FIRN_SCENE_IMPORT_OBJ_PLY_H
#define FIRN_SCENE_IMPORT_OBJ_PLY_H

#include "src/scene/import/importer.h"
#include "src/scene/import/text_scan.h"

/* Texture maps of an MTL material. */
enum mtl_map_use {
    MTL_MAP_COLOR,    /* map_Kd */
    MTL_MAP_ALPHA,    /* map_d: alpha of map_Kd's texture */
    MTL_MAP_SPECULAR, /* map_Ks */
    MTL_MAP_EMISSION, /* map_Ke */
    /* bump, map_bump, norm: height or normal maps */
    MTL_MAP_BUMP,
    MTL_MAP_COUNT,
};

struct mtl_map {
    char *file;                /* as in the file, or NULL */
    float scale[2], offset[2]; /* texture coordinate options -s and -o */
    float strength;            /* option -bm */
    bool is_clamped;           /* option -clamp on */
};

/* Material of an MTL file. */
struct mtl_material {
    char *name;  /* untruncated name, to match usemtl */
    vec3s color; /* Kd, multiplied with vertex colours */
    struct material material;
    struct mtl_map maps[MTL_MAP_COUNT];
};

/* Triangles with the same group name and material. Their indices are relative to first_vertex. */
struct obj_ply_part {
    char name[MATERIAL_NAME_SIZE];
    uint32_t material; /* material index + 1, or 0 */
    uint32_t first_vertex, vertex_count;
    uint32_t first_index, index_count;
    bool has_uvs;
};

enum {
    OBJ_PLY_LIST_SIZE = MODEL_UNDRAWN_SIZE / 2,
};

struct obj_ply {
    struct model_import *import;
    /* Vertex attributes, grouped by part; all but positions may be NULL. */
    float *positions; /* 3 per vertex */
    float *normals;   /* 3 per vertex; 0 if missing */
    float *colors;    /* linear RGBA per vertex */
    float *uvs;       /* 2 per vertex */
    uint32_t *indices;
    struct obj_ply_part *parts;
    uint32_t part_count;
    struct mtl_material *materials;
    uint32_t material_count;
    uint32_t library_count;                    /* number of MTL files read */
    char undrawn_materials[OBJ_PLY_LIST_SIZE]; /* undrawn features of MTL files: "disp\n-mm\n" */
    char undrawn[OBJ_PLY_LIST_SIZE];           /* other undrawn features of the files */
};

/* Reads a file. Only .import may be set in *obj_ply. The caller frees the contents, also after a
 * failure. */
MUST_USE enum status obj_read(struct obj_ply *obj_ply);
MUST_USE enum status ply_read(struct obj_ply *obj_ply);
MUST_USE enum status stl_read(struct obj_ply *obj_ply);

/* Appends the materials of the MTL file `name` in the model's folder. */
MUST_USE enum status mtl_read(struct obj_ply *obj_ply, const struct text_scan *name);

/* Appends a line to a list unless it is already there. If the list is full, appends "...". */
void obj_ply_note_undrawn(char list[static OBJ_PLY_LIST_SIZE], const char *words);

/* Loads the images of all materials whose parts have texture coordinates. Sets the materials'
 * textures. Converts the texture coordinates to those of the base colour map. */
MUST_USE enum status mtl_textures_load(struct obj_ply *obj_ply, struct model *model);

/* Returns map_Kd, else map_d, else an identity map. Its options -s and -o apply to all vertices. */
const struct mtl_map *mtl_base_map(const struct mtl_material *material);

/* Reads a whole file into memory that the caller frees. On failure, logs an error and returns NULL.
 * If the file cannot be opened, sets *is_found to false, logs nothing and returns NULL. */
char *obj_ply_read_file(struct model_import *import, const char *path, size_t *size,
                        bool *is_found);

/* Growable array, empty if zeroed; its owner frees .items. */
struct obj_ply_array {
    void *items;
    size_t count, room; /* numbers of items used and allocated */
};

/* Appends `count` uninitialised items and returns the first; NULL when out of memory. */
void *obj_ply_array_grow(struct obj_ply_array *array, size_t count, size_t item_size);

static inline void *obj_ply_array_add(struct obj_ply_array *array, size_t count, size_t item_size)
{
    if (count > array->room - array->count)
        return obj_ply_array_grow(array, count, item_size);
    void *added = (char *)array->items + array->count * item_size;
    array->count += count;
    return added;
}

/* ---- triangulation of polygons by ear clipping ---- */

struct polygon {
    const float *positions;    /* 3 per vertex */
    const uint32_t *vertex_of; /* corners are vertices if NULL */
    uint32_t vertex_stride;    /* elements per corner in vertex_of */
};

/* Polygon of more than three corners within an index list. */
struct polygon_range {
    /* first index of the polygon's triangle fan, and number of its corners */
    uint32_t first_index, count;
};

/* Replaces the triangle fans of polygons by ear-clipping triangulations with the same corners and
 * winding. The fan of corners c has 3 (count - 2) indices: c0 c1 c2, c0 c2 c3, ... Convex polygons
 * keep the fan; in others no triangle lies outside, if the polygon is planar and simple. Returns
 * false when out of memory. */
bool polygon_triangulate_all(const struct polygon *polygon, const struct polygon_range *polygons,
                             size_t count, uint32_t *indices);

#endif
