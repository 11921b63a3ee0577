/* material.h: transparent materials by name. */
#ifndef FIRN_SCENE_MATERIAL_H
#define FIRN_SCENE_MATERIAL_H

struct material {
    const char *name;
    float ior; /* refractive index */
    const char *help;
};

extern const struct material materials[]; /* ends at a row of zeros */

/* Returns the material of that name, or NULL. */
const struct material *material_find(const char *name);

#endif
