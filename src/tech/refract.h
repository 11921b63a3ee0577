/*
 * refract.h: what the refraction rungs (refract_*.c) share: layers, settings and rows.
 *
 * A rung may use images of other techniques (env_cube, ice_normal); passes whose images the chosen
 * rung does not use are culled.
 */
#ifndef TECH_REFRACT_H
#define TECH_REFRACT_H
#include "shaders/refract.h"
#include "src/tech/technique.h"

/* The layers, on the ice's front faces; 0 elsewhere. With dispersion, exit and way are of green. */
extern const struct rg_image refract_exit;       /* unit direction in which light leaves */
extern const struct rg_image refract_refraction; /* linear radiance seen by refraction */
extern const struct rg_image refract_reflection; /* linear radiance seen by reflection */
extern const struct rg_image refract_fresnel;    /* share of light that is reflected */
/* x: length of the path inside, metres, 0 if the rung does not compute it; y: number of total
 * reflections on it; z: 1 if light is totally reflected at its first inner surface, else 0 */
extern const struct rg_image refract_way;

extern const struct setting_group refract_settings;

struct refract_params {
    float ior;        /* refractive index of the object, for green */
    float outside;    /* of what is around it; REFRACT_IOR_AIR: 1 around files with materials */
    float dispersion; /* 20 / Abbe number, as in KHR_materials_dispersion; 0: none */
    uint32_t fresnel; /* REFRACT_FRESNEL_PAPER ...; frame_settle() replaces AUTO, here and in: */
    float crossfade;  /* share of refraction with REFRACT_FRESNEL_CROSSFADE */
    uint32_t lookup;  /* REFRACT_LOOKUP_INFINITE ... */
    uint32_t steps;   /* iterations of REFRACT_LOOKUP_DISTANCE */
};

/* Refractive index of air (The Cg Tutorial; Seipel and Nivfors 2006, eq. 2). */
#define REFRACT_IOR_AIR 1.0003f

/* Returns the refractive index around the objects: refract.outside, but that of air in a pool. */
float refract_outside(const struct scene *scene, const struct settings *settings);

/* The shaders of a rung that draws clouds (shaders/refract_cloud.glsl), as in: */
struct refract_cloudy {
    const struct rg_shader *frag, *layers_frag, *bump_frag, *bump_layers_frag, *dress_frag,
        *dress_layers_frag, *nested_frag, *nested_layers_frag, *mirror_frag, *mirror_dress_frag;
};

/* How a rung draws the object; refract_color_rows() and refract_layer_rows() make its rows. */
struct refract_rung {
    /* Shaders for the picture and for the layers, both compiled from refract_STEM.frag, without and
     * with bumps. NULL for bumps: the rung shows no bumps. */
    const struct rg_shader *frag, *layers_frag, *bump_frag, *bump_layers_frag;
    /* The same with ice_normal's dress. NULL: the rung draws no tints and textures of objects. */
    const struct rg_shader *dress_frag, *dress_layers_frag;
    /* The same with bodies in bodies, if technique_choice.is_nested. */
    const struct rg_shader *nested_frag, *nested_layers_frag;
    const struct refract_cloudy *cloudy; /* NULL: cloudy ice is clear */
    /* What rays that surroundings mirror see of the object, without and with dress (mirror.c), with
     * the rung's `vert` and `uses`. NULL: they see what the eye does. */
    const struct rg_shader *mirror_frag, *mirror_dress_frag;
    /* NULL: refract.vert, or refract_bump.vert where bumps are shown; refract_seen.vert for rungs
     * by pixel. */
    const struct rg_shader *vert;
    const struct rg_use *uses;        /* besides frame_globals and the bump map; ends at {0} */
    const struct rg_use *wide_uses;   /* replace `uses` if technique_choice.is_wide; NULL: never */
    const struct rg_use *nested_uses; /* likewise, if technique_choice.is_nested */
    const struct rg_use *nested_wide_uses; /* if both are true */
    uint32_t push_size;                    /* bytes of push constants; 0: none */
    rg_record_fn *record;                  /* NULL: frame_draw_object() */
};

/* Returns whether a rung draws clouds, of a scene that has some. */
bool refract_is_cloudy(const struct technique *rung, const struct scene *scene,
                       const struct settings *settings);

/* Uses of rows that draw dress, and clouds; they end at {0}. */
extern const struct rg_use refract_dress_uses[], refract_cloud_uses[];

/* What a rung of this kind chooses: it draws tints and textures of objects if it has a shader for
 * them, but not with bumps. */
void refract_choose(struct technique_choice *choice, const struct scene *scene);

/* The environment cube of rungs with refract_seen_mean.vert. */
#define REFRACT_USE_SEEN_CUBE \
    FRAME_SAMPLE(frame_env_cube, REFRACT_ENV_CUBE, .sampler = &frame_linear, \
                 .stages = VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | \
                           VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT)

/* A rung's parts of a frame. The picture's row is drawn before the background, so that the depth
 * test rejects hidden background; the layers' row after it, since surroundings may hide the
 * object. */
technique_rows_fn refract_color_rows, refract_layer_rows;
#define REFRACT_PARTS \
    { \
        { PHASE_REFRACTION, .rows = refract_color_rows }, \
            { PHASE_LAYERS, .rows = refract_layer_rows }, \
    }

#endif
