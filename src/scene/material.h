/* material.h: transparent materials by name. */
#ifndef FIRN_SCENE_MATERIAL_H
#define FIRN_SCENE_MATERIAL_H

struct material {
    const char *name;
    float ior; /* refractive index */
    const char *help;
};

extern const struct material materials[]; /* ends at a row of zeros */

/* NULL if there is none of that name. */
const struct material *material_find(const char *name);

#endif
