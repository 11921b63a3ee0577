/*
 * bump.h: bump mapping of the ice's surface.
 *
 * A bump map and a mask of areas smoothed by melting (Seipel and Nivfors 2006, section 3.1 c)
 * perturb the normals of front faces for refraction, reflection and highlights
 * (shaders/lighting/bump_fragment_normal.glsl). Fresnel reflectance at vertices (eq. 4) and the AOV
 * layer N use the mesh's normals. Back faces are not bump-mapped.
 */
#ifndef FIRN_TECH_LIGHTING_BUMP_H
#define FIRN_TECH_LIGHTING_BUMP_H
#include "shaders/lighting/bump.h"
#include "src/tech/technique.h"

/* Imported bump map of the scene. The declared size is that of the fallback image. */
extern const struct rg_image bump_map;

extern const struct technique bump;
extern const struct setting_group bump_settings;

struct bump_params {
    float strength;   /* RMS slope; 0: no bumps */
    float scale;      /* tiles per object or uv unit */
    float mask;       /* smooth fraction of the surface */
    uint32_t mapping; /* BUMP_TRIPLANAR, ... */
    uint32_t seed;
};

enum {
    BUMP_TRIPLANAR, /* blended projections along object axes */
    BUMP_UV,        /* needs uv; otherwise no bumps */
};

/* Binding of the bump map in a pass's uses. */
#define BUMP_USE_MAP FRAME_SAMPLE(bump_map, BUMP_MAP, .sampler = &frame_texture_sampler)

#endif
