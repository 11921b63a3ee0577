/*
 * refract.h: what the refraction rungs (refract_*.c) share: their layers and the index.
 *
 * A rung may name what other techniques make (env_cube, ice_normal); what the chosen rung does not
 * name is culled.
 */
#ifndef TECH_REFRACT_H
#define TECH_REFRACT_H
#include "shaders/refract.h"
#include "src/tech/technique.h"

/* On the ice's front faces; 0 elsewhere. With dispersion, exit and way are those of green. */
extern const struct rg_image refract_exit;       /* unit direction in which light leaves */
extern const struct rg_image refract_refraction; /* linear radiance from there */
extern const struct rg_image refract_reflection; /* linear radiance by reflection */
extern const struct rg_image refract_fresnel;    /* share of the reflection */
/* x: how far light goes inside, metres, 0 where the rung does not know; y: how often it is totally
 * reflected there; z: 1 if so where it first could leave, else 0 */
extern const struct rg_image refract_way;

extern const struct setting_group refract_settings;

struct refract_params {
    float ior;        /* refractive index of the object, for green */
    float dispersion; /* 20 / Abbe number, as KHR_materials_dispersion has it; 0: none */
    uint32_t fresnel; /* REFRACT_FRESNEL_PAPER ... */
    float crossfade;  /* share of refraction with REFRACT_FRESNEL_CROSSFADE */
    uint32_t lookup;  /* REFRACT_LOOKUP_INFINITE ... */
    uint32_t steps;   /* of REFRACT_LOOKUP_DISTANCE */
};

/* Refractive index of the air around it (Cg Tutorial; Seipel and Nivfors 2006, eq. 2). */
#define REFRACT_IOR_AIR 1.0003f

/* How a rung draws the object (src/tech/refract.c makes its rows of this). */
struct refract_rung {
    /* Shaders for the picture and for the layers, refract_STEM.frag compiled for both; and of a
     * bumpy object, where NULL means that the rung shows no bumps. */
    const struct rg_shader *frag, *layers_frag, *bump_frag, *bump_layers_frag;
    /* NULL: refract.vert, or refract_bump.vert where bumps are shown. */
    const struct rg_shader *vert;
    const struct rg_use *uses; /* besides frame_globals and the map of bumps; ends at {0} */
    uint32_t push_size;        /* bytes; 0: nothing is pushed */
    rg_record_fn *record;      /* NULL: draws the object */
    /* Draws all pixels in which ice_normal.front shows the object, bumpy or not, instead of its
     * front faces (shaders/refract_seen.glsl): for rungs whose pixels cost much. */
    bool by_pixel;
};

/* A rung's parts of a frame. The picture's row comes before the background, which then leaves out
 * what the object hides; that of the layers after it, since surroundings may hide the object. */
technique_rows_fn refract_color_rows, refract_layer_rows;
#define REFRACT_PARTS \
    { \
        { PHASE_REFRACTION, .rows = refract_color_rows }, \
            { PHASE_LAYERS, .rows = refract_layer_rows }, \
    }

#endif
