/*
 * model.h: a model file as firn needs it.
 *
 * Reads .gltf .glb .obj .ply, and what else assimp can. All meshes are merged with their transforms
 * into two: the refractive object and its surroundings. In a glTF file with a mesh whose material
 * has KHR_materials_transmission (factor > 0) such meshes are the object and all others the
 * surroundings; in any other file everything is the object, or the surroundings, as
 * `everything_is` says. Coordinates stay as they are in the file. Points and lines are left out;
 * polygons are cut into triangles; vertices alike bit by bit become one.
 *
 * Normals are taken from the file and made (smooth) where missing. Vertex colours, base colours
 * and base colour textures become mesh_vertex.color, .uv and .material; KHR_materials_unlit, and
 * in .obj and .ply files vertex colours without normals or materials, mean MESH_UNLIT; glTF's
 * alphaMode MASK means MESH_CUTOUT. Vertex colours and .mtl's Kd are taken as linear, texture
 * colours as sRGB. KHR_texture_transform and a texture's own way to repeat are ignored. What
 * files a model names must lie within its folder. decode.h reads models that nobody vouches for.
 *
 * A node's extras in a glTF file may name a box, { "firn": { "box": [[x,y,z],[x,y,z]] } }, its
 * least corner first, in metres of the file's space whatever the node's place. The first counts.
 *
 * Ownership: model_finish() frees what a model holds; a {0} model is fine.
 * Threads:   one model_load() at a time in a process (assimp's log has no owner)
 * Errors:    one line is logged, with the file's name and the place, and *model is {0}:
 *            STATUS_NO_INPUT  missing or unreadable
 *            STATUS_DATA      of no known kind, cannot be parsed, empty, no triangles, a number
 *                             not finite, a coordinate beyond 1e6, an index too large, an index
 *                             of refraction not within 1 to 4, a bad or missing picture, a box
 *                             that is none
 *            STATUS_TRY_AGAIN out of memory
 */
#ifndef FIRN_SCENE_IMPORT_MODEL_H
#define FIRN_SCENE_IMPORT_MODEL_H

#include "src/base/status.h"
#include "src/scene/camera.h"
#include "src/scene/mesh.h"

/*
 * Square 8-bit sRGB pictures of one size, RGBA, rows from the top, one after another: at most 4096,
 * of at most 2048 texels a side, 512 MiB together. Pictures of other sizes have been resampled.
 */
struct texture_layers {
    uint8_t *texels;      /* size * size * 4 * count bytes */
    uint32_t size, count; /* size is a power of two; both 0 when there are none */
};

struct model {
    struct mesh object;
    struct mesh surroundings;
    struct texture_layers textures; /* of both meshes */
    struct camera camera;           /* valid if has_camera; target as far as the object */
    float ior;                      /* KHR_materials_ior of the object; valid if has_ior */
    struct box box;                 /* around the object (refract.lookup=box); valid if has_box */
    bool has_camera;
    bool has_box;
    bool has_ior;
};

enum model_part {
    MODEL_OBJECT,
    MODEL_SURROUNDINGS,
};

MUST_USE enum status model_load(struct model *model, const char *path,
                                enum model_part everything_is);

/*
 * Appends everything of `other` (its object too, as surroundings) to the surroundings of *model,
 * renumbering textures and bringing them to the larger size; its box counts before that of *model.
 * `other` is left {0} in any case; *model is unchanged on failure: STATUS_TRY_AGAIN when memory is
 * short, STATUS_DATA when there would be more than 4096 textures.
 */
MUST_USE enum status model_add_surroundings(struct model *model, struct model *other);

void model_finish(struct model *model);

#endif
