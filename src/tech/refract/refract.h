/*
 * refract.h: layers, settings and passes shared by the raster refraction models (refract_*.c).
 *
 * A model may read images of other techniques. Passes whose images are not read are culled.
 */
#ifndef FIRN_TECH_REFRACT_REFRACT_H
#define FIRN_TECH_REFRACT_REFRACT_H
#include "shaders/refract/refract.h"
#include "src/tech/technique.h"

/* AOV layers of the ice's front faces; 0 without ice. Exit and path are those of green light. */
extern const struct rg_image refract_exit;       /* unit exit direction of the path */
extern const struct rg_image refract_refraction; /* linear refracted radiance */
extern const struct rg_image refract_reflection; /* linear reflected radiance */
extern const struct rg_image refract_fresnel;    /* Fresnel reflectance */
/* Path of refracted light. x: length inside the object in metres, 0 if the model does not compute
 * it; y: number of total internal reflections; z: 1 if the first inner surface reflects totally */
extern const struct rg_image refract_path;

/* Written only by ray-traced models. */
extern const struct rg_image refract_media;       /* number of segments inside objects */
extern const struct rg_image refract_last_object; /* number of the last object hit */

/* Render targets of image and AOV layers. Negative highlights mark pixels without ice. */
#define REFRACT_COLOR_TARGETS \
    [REFRACT_OUT_COLOR] = { &frame_color, RG_LOAD_DISCARD }, [REFRACT_OUT_HIGHLIGHT] = { \
        &highlight_radiance, RG_LOAD_CLEAR, { .color.float32 = { -1.0f } } \
    }

/* Packed layers: models that draw a full-screen triangle write them together with the image. */
extern const struct rg_image refract_packed_path, refract_packed_light, refract_packed_counts;
#define REFRACT_PACKED_TARGETS(first) \
    [first] = { &refract_packed_path, RG_LOAD_CLEAR }, { &refract_packed_light, RG_LOAD_CLEAR }, \
    { \
        &refract_packed_counts, RG_LOAD_CLEAR \
    }

#define REFRACT_LAYER_TARGETS \
    [REFRACT_OUT_EXIT] = { &refract_exit, RG_LOAD_CLEAR }, \
    [REFRACT_OUT_REFRACTION] = { &refract_refraction, RG_LOAD_CLEAR }, \
    [REFRACT_OUT_REFLECTION] = { &refract_reflection, RG_LOAD_CLEAR }, \
    [REFRACT_OUT_FRESNEL] = { &refract_fresnel, RG_LOAD_CLEAR }, \
    [REFRACT_OUT_PATH] = { &refract_path, RG_LOAD_CLEAR }

extern const struct setting_group refract_settings;

/* Refraction model `paper`, for which `auto` settings follow Seipel and Nivfors (2006). */
extern const struct technique refract_paper;

struct refract_params {
    float ior;        /* of the object, for green */
    float outside;    /* outside: refractive index around the objects */
    float dispersion; /* dispersion: 20 / Abbe number, or 0 for none */
    float roughness;  /* roughness of the surface, the square root of GGX alpha; 0 if smooth */
    uint32_t fresnel; /* REFRACT_FRESNEL_PAPER ...; frame_resolve_settings() resolves AUTO */
    float crossfade;  /* transmitted fraction with REFRACT_FRESNEL_CROSSFADE */
    uint32_t lookup;  /* REFRACT_LOOKUP_INFINITE ... */
    uint32_t steps;   /* ray marching steps of REFRACT_LOOKUP_DISTANCE */
};

/* Refractive index of air (The Cg Tutorial; Seipel and Nivfors 2006, eq. 2). */
#define REFRACT_IOR_AIR 1.0003f

/* Returns the refractive index around the objects: refract.ior_outside, or air in a pool. */
float refract_outside(const struct scene *scene, const struct settings *settings);

/* Shaders and inputs of a raster refraction model; refract_*_passes() build its passes. */
struct refract_shaders {
    /* Fragment shaders of the image (`frag`) and of the AOV layers (`layers_frag`; of both if the
     * model packs layers), and variants with bump mapping. If the model has no bump mapping,
     * `bump_frag` is NULL. */
    const struct rg_shader *frag, *layers_frag, *bump_frag, *bump_layers_frag;
    /* Variants for textured or tinted objects (ice_normal's material images). */
    const struct rg_shader *material_frag, *material_layers_frag;
    /* Variants for nested objects, if technique_config.is_nested. */
    const struct rg_shader *nested_frag, *nested_layers_frag;
    /* Fragment shaders for scattering media (shaders/refract/refract_medium.glsl); other members
     * are not used. NULL: scattering media are rendered clear. */
    const struct refract_shaders *medium_shaders;
    /* Variants for rays that surroundings reflect to the object (ssr.c), without and with material
     * images. If NULL, such rays read the object's colour from the image. */
    const struct rg_shader *ssr_frag, *ssr_material_frag;
    /* Vertex shader. NULL selects refract.vert or refract_bump.vert, or refract_fullscreen.vert for
     * models that shade a full-screen triangle. */
    const struct rg_shader *vert;
    const struct rg_use *uses;             /* besides globals and bump map */
    const struct rg_use *wide_uses;        /* replaces `uses` if technique_config.is_wide */
    const struct rg_use *nested_uses;      /* replaces `uses` if technique_config.is_nested */
    const struct rg_use *nested_wide_uses; /* replaces `uses` if both are set */
    uint32_t push_size;                    /* push constants, bytes; 0 if none */
    rg_record_fn *record;                  /* NULL: frame_draw_object() */
};

/* Initialises the fragment shaders of a model that has bump mapping and material images. */
#define REFRACT_FRAGS(model) \
    .frag = &model##_frag, .layers_frag = &model##_aov_frag, .bump_frag = &model##_bump_frag, \
    .bump_layers_frag = &model##_bump_aov_frag, .material_frag = &model##_material_frag, \
    .material_layers_frag = &model##_material_aov_frag

/* Returns true if the scene has scattering media and a raster refraction model renders them. */
bool refract_has_medium(const struct technique_config *config);

/* Returns the model's fragment shaders for clear objects or, if refract_has_medium(), for media. */
const struct refract_shaders *refract_shaders_of(const struct technique_config *config);

/* Resource uses for material images and for scattering media; an empty use {0} ends each list. */
extern const struct rg_use refract_material_uses[], refract_medium_uses[];

/* Resource use of the environment cube for models with refract_fullscreen_mean.vert. */
#define REFRACT_USE_FULLSCREEN_CUBE \
    FRAME_SAMPLE(frame_env_cube, REFRACT_ENV_CUBE, .sampler = &frame_linear, \
                 .stages = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT)

/* Returns true if layers are requested that can be packed. */
bool refract_wants_layers(const struct technique_config *config);

/* Makes the passes that write packed layers to the layers' images. */
technique_passes_fn refract_unpack_passes;

/* Make a refraction model's passes. The image is drawn before the background, because hidden
 * background then fails the depth test. Layers follow, as the background may hide the object. */
technique_passes_fn refract_image_passes, refract_layer_passes;
#define REFRACT_PASS_GROUPS \
    { \
        { PHASE_REFRACTION, .make_passes = refract_image_passes }, \
            { PHASE_LAYERS, .make_passes = refract_layer_passes }, \
    }
#define REFRACT_PACKED_PASS_GROUPS \
    { \
        { PHASE_REFRACTION, .make_passes = refract_image_passes }, \
            { PHASE_UNPACK, .make_passes = refract_unpack_passes }, \
    }

#endif
