/*
 * bump.h: the ice's uneven surface: a map that comes with the scene, and how it lies on it.
 *
 * Seipel and Nivfors 2006, section 3.1 c: a bump map, and a mask of where melting has made the
 * surface smooth. They bend the front normal (shaders/bump.glsl) with which rungs refract and
 * reflect and lights shine; eq. 4, at the vertices, and the layer N keep the mesh's normal. The
 * back faces are smooth.
 */
#ifndef TECH_BUMP_H
#define TECH_BUMP_H
#include "shaders/bump.h"
#include "src/tech/technique.h"

/* Imported; the size is that of the stand-in where the scene has none. */
extern const struct rg_image bump_map;

extern const struct technique bump;
extern const struct setting_group bump_settings;

struct bump_params {
    float strength;   /* root mean square of the slopes; 0: no bumps, no map is read */
    float scale;      /* tiles across the object's bounding sphere, or a unit of uv */
    float mask;       /* share of the surface that is smooth */
    uint32_t mapping; /* BUMP_TRIPLANAR ... */
    uint32_t seed;
};

enum {
    BUMP_TRIPLANAR, /* along three planes of the object's space */
    BUMP_UV,        /* by the mesh's uv; where it has none there are no bumps */
};

/* The use of the map. */
#define BUMP_USE_MAP FRAME_SAMPLE(bump_map, BUMP_MAP, .sampler = &frame_texture_sampler)

#endif
