/* coincident_shells.h: finds faces that shells of one or several objects share, exactly or within a
 * small distance. Ray tracers treat the surfaces of such a contact as one interface. */
#ifndef FIRN_SCENE_COINCIDENT_SHELLS_H
#define FIRN_SCENE_COINCIDENT_SHELLS_H

#include "src/scene/refractive_object.h"

enum {
    COINCIDENT_PAIRS_MAX = 8 /* maximum number of recorded pairs of objects */
};

/* Minimum cosine of incidence when distances from a surface are converted to those along a ray. */
#define COINCIDENT_COSINE_MIN 0.0625f

/* Two objects that share faces; `first` is below `second`. */
struct coincident_pair {
    uint32_t first, second;
};

/* Contacts between shells; zeroed if there are none. */
struct coincident_shells {
    uint32_t *triangles; /* bit mask of triangles at contacts; NULL if there are none */
    float epsilon;       /* maximum distance of surfaces in contact, metres */
    struct coincident_pair pairs[COINCIDENT_PAIRS_MAX];
    uint32_t pair_count;
    bool has_more_pairs; /* there may be further pairs */
};

/* Finds the contacts between the shells of a mesh. Returns false when out of memory. */
MUST_USE bool coincident_shells_find(struct coincident_shells *shells, const struct object *objects,
                                     uint32_t count, const struct mesh *mesh);
void coincident_shells_finish(struct coincident_shells *shells);

/* Returns true if a triangle of the objects' mesh is at a contact. */
static inline bool coincident_shells_has(const struct coincident_shells *shells, uint32_t triangle)
{
    return shells->triangles && shells->triangles[triangle / 32] >> triangle % 32 & 1;
}

#endif
