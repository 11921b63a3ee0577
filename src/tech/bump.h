/*
 * bump.h: the ice's uneven surface: the scene's bump map, and how it is mapped.
 *
 * Seipel and Nivfors 2006, section 3.1 c: a bump map, and a mask of where melting has made the
 * surface smooth. They bend the front normal (shaders/bump.glsl) for refraction, reflection and
 * highlights; eq. 4, at the vertices, and the layer N use the mesh's normal. Back faces are smooth.
 */
#ifndef TECH_BUMP_H
#define TECH_BUMP_H
#include "shaders/bump.h"
#include "src/tech/technique.h"

/* The scene's map, imported; this size is that of the fallback. */
extern const struct rg_image bump_map;

extern const struct technique bump;
extern const struct setting_group bump_settings;

struct bump_params {
    float strength;   /* root mean square of the slopes; 0: no bumps, and the map is not read */
    float scale;      /* tiles across the object's bounding sphere, or per unit of uv */
    float mask;       /* share of the surface that is smooth */
    uint32_t mapping; /* BUMP_TRIPLANAR ... */
    uint32_t seed;
};

enum {
    BUMP_TRIPLANAR, /* along three planes of the object's space */
    BUMP_UV,        /* by the mesh's uv; without uv there are no bumps */
};

/* A use of the map in a row. */
#define BUMP_USE_MAP FRAME_SAMPLE(bump_map, BUMP_MAP, .sampler = &frame_texture_sampler)

#endif
