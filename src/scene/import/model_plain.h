/*
 * model_plain.h: shared by the readers of OBJ, MTL and PLY: what a file holds until it becomes
 * meshes.
 *
 * Functions that return a status log one line if it is not STATUS_OK.
 */
#ifndef FIRN_SCENE_IMPORT_MODEL_PLAIN_H
#define FIRN_SCENE_IMPORT_MODEL_PLAIN_H

#include "src/scene/import/model_import.h"
#include "src/scene/import/text_scan.h"

/* The pictures of an MTL file's material. */
enum plain_map_use {
    PLAIN_COLOR,     /* map_Kd */
    PLAIN_ALPHA,     /* map_d: becomes the alpha of map_Kd's picture */
    PLAIN_SPECULAR,  /* map_Ks */
    PLAIN_EMISSION,  /* map_Ke */
    PLAIN_ROUGHNESS, /* map_Pr: counts instead of map_Ns */
    PLAIN_SHININESS, /* map_Ns: becomes roughness */
    PLAIN_METALLIC,  /* map_Pm: becomes the blue of that of roughness */
    PLAIN_BUMP,      /* bump, map_bump and norm: heights, which become normals, or normals */
    PLAIN_MAP_COUNT,
};

struct plain_map {
    char *file;                /* as it is named; NULL: none */
    float scale[2], offset[2]; /* of the coordinates: -s and -o */
    float strength;            /* -bm */
    bool is_clamped;           /* -clamp on */
};

/* A material of an MTL file. */
struct plain_material {
    char *name;  /* whole, for usemtl */
    vec3s color; /* Kd; times the vertices' */
    struct material material;
    struct plain_map maps[PLAIN_MAP_COUNT];
    float exponent; /* Ns */
};

/* Triangles with one name and one material. Their indices count from the part's first vertex. */
struct plain_part {
    char name[MATERIAL_NAME_SIZE];
    uint32_t material; /* index + 1; 0: the file gives none */
    uint32_t first_vertex, vertex_count;
    uint32_t first_index, index_count;
    bool has_uvs;
};

enum {
    PLAIN_LIST_SIZE = MODEL_UNDRAWN_SIZE / 2,
};

struct plain {
    struct model_import *import;
    /* Of the vertices, part by part; all but positions may be NULL. */
    float *positions; /* 3 */
    float *normals;   /* 3; {0}: to be made */
    float *colors;    /* 4, linear */
    float *uvs;       /* 2 */
    uint32_t *indices;
    struct plain_part *parts;
    uint32_t part_count;
    struct plain_material *materials;
    uint32_t material_count;
    char undrawn_materials[PLAIN_LIST_SIZE]; /* what of an MTL file is not drawn: "disp\n-mm\n" */
    char undrawn[PLAIN_LIST_SIZE];           /* what else of the files is not drawn */
};

/* Read a file into *plain, which is {0} but for .import; plain_finish() frees it in any case. */
MUST_USE enum status obj_read(struct plain *plain);
MUST_USE enum status ply_read(struct plain *plain);

/* Appends the materials of an MTL file. The folder is the model's. */
MUST_USE enum status mtl_read(struct plain *plain, const struct text_scan *name);

/* Appends words and a newline to a list, unless it has them; a full list ends in "...". */
void plain_note(char list[static PLAIN_LIST_SIZE], const char *words);

/* Builds both meshes, objects, materials and textures of a model. */
MUST_USE enum status plain_build(struct plain *plain, struct model *model,
                                 enum model_part everything_is);

/* Loads the pictures of materials whose parts have texture coordinates, sets the materials'
 * textures, and moves the coordinates to those of the base colour. */
MUST_USE enum status plain_load_pictures(struct plain *plain, struct model *model);

/* Returns the map whose coordinates those of the vertices become: of the colour, else of alpha. */
const struct plain_map *plain_base_map(const struct plain_material *material);

void plain_finish(struct plain *plain);

/*
 * Reads a whole file, which the caller frees. On failure returns NULL; *is_found tells whether the
 * file was there and could be opened, then a line is logged.
 */
char *plain_read_file(struct model_import *import, const char *path, size_t *size, bool *is_found);

/* An array that grows. Fields that are 0 are an empty one; the owner frees .items. */
struct plain_array {
    void *items;
    size_t count, room; /* items */
};

/* Returns the place of `count` new items at the end; NULL when out of memory. */
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
