/*
 * model_plain.h: contents of an OBJ, MTL or PLY file before they are converted to a model;
 * interface shared by the readers of these formats.
 *
 * Functions that return a status log one line if it is not STATUS_OK.
 */
#ifndef FIRN_SCENE_IMPORT_MODEL_PLAIN_H
#define FIRN_SCENE_IMPORT_MODEL_PLAIN_H

#include "src/scene/import/model_import.h"
#include "src/scene/import/text_scan.h"

/* Texture maps of an MTL material. */
enum plain_map_use {
    PLAIN_COLOR,     /* map_Kd */
    PLAIN_ALPHA,     /* map_d: becomes the alpha of map_Kd's texture */
    PLAIN_SPECULAR,  /* map_Ks */
    PLAIN_EMISSION,  /* map_Ke */
    PLAIN_ROUGHNESS, /* map_Pr: takes precedence over map_Ns */
    PLAIN_SHININESS, /* map_Ns: converted to roughness */
    PLAIN_METALLIC,  /* map_Pm: becomes the blue channel of the roughness texture */
    PLAIN_BUMP, /* bump, map_bump and norm: height maps, converted to normal maps, or normal maps */
    PLAIN_MAP_COUNT,
};

struct plain_map {
    char *file;                /* name as written in the file; NULL if there is no map */
    float scale[2], offset[2]; /* of texture coordinates: options -s and -o */
    float strength;            /* -bm */
    bool is_clamped;           /* -clamp on */
};

/* A material of an MTL file. */
struct plain_material {
    char *name;  /* untruncated, to match usemtl */
    vec3s color; /* Kd; multiplied with vertex colours */
    struct material material;
    struct plain_map maps[PLAIN_MAP_COUNT];
    float exponent; /* Ns */
};

/* Triangles of one group name and one material. Their indices are relative to first_vertex. */
struct plain_part {
    char name[MATERIAL_NAME_SIZE];
    uint32_t material; /* index + 1; 0 if the file assigns none */
    uint32_t first_vertex, vertex_count;
    uint32_t first_index, index_count;
    bool has_uvs;
};

enum {
    PLAIN_LIST_SIZE = MODEL_UNDRAWN_SIZE / 2,
};

struct plain {
    struct model_import *import;
    /* Vertex attributes, part by part; all but positions may be NULL. */
    float *positions; /* 3 per vertex */
    float *normals;   /* 3 per vertex; {0} if to be computed */
    float *colors;    /* RGBA per vertex, linear */
    float *uvs;       /* 2 per vertex */
    uint32_t *indices;
    struct plain_part *parts;
    uint32_t part_count;
    struct plain_material *materials;
    uint32_t material_count;
    char undrawn_materials[PLAIN_LIST_SIZE]; /* of MTL files: "disp\n-mm\n" */
    char undrawn[PLAIN_LIST_SIZE];           /* other undrawn features of the files */
};

/* Read a file into *plain, in which only .import is set; plain_finish() frees it in any case. */
MUST_USE enum status obj_read(struct plain *plain);
MUST_USE enum status ply_read(struct plain *plain);

/* Appends the materials of an MTL file that is looked up in the model's folder. */
MUST_USE enum status mtl_read(struct plain *plain, const struct text_scan *name);

/* Appends a line to a list unless it is in it already; a full list ends in "...". */
void plain_note(char list[static PLAIN_LIST_SIZE], const char *words);

/* Builds both meshes, the objects, materials and textures of a model. */
MUST_USE enum status plain_build(struct plain *plain, struct model *model,
                                 enum model_part everything_is);

/* Loads the images of materials whose parts have texture coordinates, assigns the materials'
 * textures, and transforms the texture coordinates to those of the base colour. */
MUST_USE enum status plain_load_pictures(struct plain *plain, struct model *model);

/* Returns the map whose -s and -o apply to the vertices: map_Kd, else map_d, else identity. */
const struct plain_map *plain_base_map(const struct plain_material *material);

void plain_finish(struct plain *plain);

/*
 * Reads a whole file into memory that the caller frees. Returns NULL on failure: *is_found is false
 * if the file cannot be opened, which is not logged; other failures are.
 */
char *plain_read_file(struct model_import *import, const char *path, size_t *size, bool *is_found);

/* A growable array. Zero-initialised, it is empty; the owner frees .items. */
struct plain_array {
    void *items;
    size_t count, room; /* in items */
};

/* Appends `count` items and returns the first, uninitialised; NULL when out of memory. */
void *plain_array_grow(struct plain_array *array, size_t count, size_t item_size);

static inline void *plain_array_add(struct plain_array *array, size_t count, size_t item_size)
{
    if (count > array->room - array->count)
        return plain_array_grow(array, count, item_size);
    void *place = (char *)array->items + array->count * item_size;
    array->count += count;
    return place;
}

#endif
