/* scene_objects.h: list of a scene's refractive and opaque objects, picking by a ray, and the
 * outline of an object in the image. */
#ifndef FIRN_VIEW_SCENE_OBJECTS_H
#define FIRN_VIEW_SCENE_OBJECTS_H

#include "src/setup/setup.h"
#include "src/view/view_renderers.h"

#define SCENE_OBJECT_NONE UINT32_MAX

struct scene_object {
    char name[MATERIAL_NAME_SIZE];       /* of the node; "" if it has none */
    char label[MATERIAL_NAME_SIZE + 16]; /* name or a replacement for it */
    char material[MATERIAL_NAME_SIZE];   /* "" if unknown */
    bool is_refractive, is_hidden;
    bool is_of_file; /* a node of the model file, neither stage nor other surroundings */
    uint32_t triangle_count, open_edge_count;
    struct box box;
};

/* Visible objects, indexed by ID - 1 of the layer `object`, followed by hidden objects. */
struct scene_objects {
    struct scene_object *all;
    uint32_t count;
    uint32_t open_count; /* refractive objects with holes */
    uint64_t version;    /* version of the viewport at the last update */
    const void *of;      /* viewport at the last update */
};

void scene_objects_finish(struct scene_objects *list); /* {0} is fine */

/* Updates the list if the viewport has changed. If out of memory, the list is empty. */
void scene_objects_update(struct scene_objects *list, const struct viewport *p);

/* Returns the index of the first object of a name, or SCENE_OBJECT_NONE. */
uint32_t scene_objects_find(const struct scene_objects *list, const char *name);

/* Returns the matrix from the space of the refractive objects' mesh to world space. */
mat4s scene_objects_matrix(const struct viewport *p, float time);

/* Returns the index of the visible object at a point of the image, in fractions of its width and
 * height, or SCENE_OBJECT_NONE. *at is the point hit. Transparent texels count as surface. */
uint32_t scene_objects_pick(const struct viewport *p, float time, float x, float y, vec3s *at);

enum {
    OBJECT_OUTLINE_MAX = 3000, /* maximum line segments */
};

/* Silhouette of an object, also where others hide it: segments from (x, y) to (z, w) in fractions
 * of the image's width and height. */
struct object_outline {
    vec4s lines[OBJECT_OUTLINE_MAX];
    uint32_t count;
    uint32_t object; /* object that `lines` outline in the view below */
    struct camera camera;
    float time;
    uint64_t version;
};

/* Computes the outline of an object unless it is up to date. SCENE_OBJECT_NONE clears it. */
void object_outline_update(struct object_outline *outline, const struct viewport *p, float time,
                           uint32_t object);

#endif
