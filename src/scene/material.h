/* material.h: surface materials and the media behind them, as in glTF. */
#ifndef FIRN_SCENE_MATERIAL_H
#define FIRN_SCENE_MATERIAL_H

#include <stdbool.h>
#include "shaders/material_layout.h"

enum {
    /* size of a name in bytes, terminator included; longer ones are truncated */
    MATERIAL_NAME_SIZE = 64,
};

#define MATERIAL_SCATTERING_MAX 1000.0f
#define MATERIAL_CLASS_MAX      65535

/* Bits of material.flags. */
enum {
    MATERIAL_FROM_SETTINGS = 1, /* the settings, not the file, define the material */
    MATERIAL_HAS_IOR = 2,       /* the file sets the refractive index */
    MATERIAL_HAS_PRIORITY = 4,  /* the file sets the priority */
    MATERIAL_IS_CUTOUT = 8,     /* alpha mask: hole below the cutoff */
    MATERIAL_IS_UNLIT = 16,     /* the base colour is emitted radiance */
    MATERIAL_IS_BLENDED = 32,   /* alpha is the fraction of light that the surface reflects */
    MATERIAL_IS_TWO_SIDED = 64,
    /* legacy refractive index 0; specular_color is the reflectance at normal incidence */
    MATERIAL_IS_LEGACY = 128,
    MATERIAL_IS_WATER_LAYER = 256, /* opaque base with colour and normal map, under a water layer */
    /* an object has this material and others, so surface parameters are looked up per triangle */
    MATERIAL_IS_PARTIAL = 512,
    MATERIAL_SCATTERS_EVENLY = 1024, /* the scattering medium has the same density everywhere */
    MATERIAL_FLAGS = 2047,           /* flags that a model file can set */
    /* shows the environment behind it, darkened by shadows and brightened by caustics */
    MATERIAL_IS_SHADOW_CATCHER = 2048,
};

/* Returns true if textures of this use hold sRGB colours. Other textures are linear. */
static inline bool material_texture_is_color(uint32_t use)
{
    return use == MATERIAL_BASE_COLOR || use == MATERIAL_EMISSION || use == MATERIAL_SPECULAR_COLOR;
}

/* Texture and its transform. Colour textures are sRGB, others linear. */
struct material_texture {
    uint32_t layer; /* layer index + 1, in model.textures (colours) or model.numbers; 0 for none */
    uint32_t wrap_u, wrap_v; /* MATERIAL_REPEAT, ... */
    uint32_t uv_set;         /* texture coordinate set: 0 for mesh_vertex.uv, 1 for mesh_extra.uv */
    vec3s u_row, v_row;      /* rows of the uv transform, multiplied by (u, v, 1) */
};

/* Material as in glTF 2.0 with KHR_materials_transmission, _volume, _ior, _dispersion, _specular,
 * _clearcoat and _emissive_strength. If the surface is transmissive, the medium behind it transmits
 * attenuation_color ^ (length / attenuation_distance) per channel. */
struct material {
    char name[MATERIAL_NAME_SIZE];
    uint32_t flags;
    vec3s base_color;   /* linear; tints transmitted light */
    float roughness;    /* roughness, the square root of GGX alpha */
    float transmission; /* fraction of the non-reflected light that is transmitted; 0 if opaque */
    float thickness;    /* volume thickness; 0 for a thin wall, which encloses no medium */
    float ior;          /* refractive index, 1 to 4 */
    float dispersion;   /* dispersion as 20 / Abbe number, 0 to 10 */
    vec3s attenuation_color;    /* colour after attenuation_distance, 0 to 1 */
    float attenuation_distance; /* metres; 0 for a clear medium */
    float
        /* scattering optical depth across the object at maximum density; 0 if clear */
        scattering_optical_depth;
    uint32_t class_id;        /* number of layer `class`: extras.class of the file, or 0 */
    int32_t priority;         /* medium priority; the highest fills the space where media overlap */
    float metallic;           /* metallic factor, 0 to 1; glTF's default is 1 */
    float alpha;              /* 0 to 1 */
    float alpha_cutoff;       /* alpha below which a texel of a mask is a hole, 0 to 1 */
    vec3s emission;           /* emitted radiance, strength included, 0 to 65504 */
    float normal_scale;       /* factor on x and y of the normal map, -65504 to 65504 */
    float occlusion_strength; /* 0 to 1 */
    float specular;           /* dielectric specular strength, 0 to 1 */
    vec3s specular_color;     /* colour of specular reflection at normal incidence, 0 to 65504 */
    float coat;               /* strength of a clear coat over an opaque surface, 0 to 1 */
    float coat_roughness;
    struct material_texture textures[MATERIAL_TEXTURE_COUNT];
};

/* Returns true if the parameters of a transmissive surface vary over an object: if a texture
 * affects transmission or reflection (base colour, roughness, transmission or normal), or for
 * MATERIAL_IS_PARTIAL. */
bool material_is_textured(const struct material *material);

/* Returns glTF's default material, white and opaque, with a name. */
struct material material_make(const char *name);

/* Clamps all values, and replaces NaN with defaults. Returns true if anything changed. */
bool material_clamp(struct material *material);

/* Returns the absorption coefficients of Beer-Lambert's law for R, G and B, 1 / metre. */
vec3s material_absorption(const struct material *material);

#endif
