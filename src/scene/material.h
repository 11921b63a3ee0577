/* material.h: what a surface, and the medium behind it, are made of; transparent media by name. */
#ifndef FIRN_SCENE_MATERIAL_H
#define FIRN_SCENE_MATERIAL_H

#include <cglm/types-struct.h>
#include <stdbool.h>
#include <stdint.h>

enum {
    MATERIAL_NAME_SIZE = 64, /* bytes of a name, with its end; longer ones are cut */
};

#define MATERIAL_CLOUD_MAX 1000.0f

/* The bits of material.flags. */
enum {
    MATERIAL_IS_BARE = 1,      /* of a file without materials, or built in: settings decide */
    MATERIAL_HAS_IOR = 2,      /* the file gives the index; else it is the format's default */
    MATERIAL_HAS_PRIORITY = 4, /* the file gives the priority */
    MATERIAL_IS_CUTOUT = 8,    /* alpha below the cutoff is a hole */
    MATERIAL_IS_UNLIT = 16,    /* the base colour is emitted radiance */
    MATERIAL_IS_BLENDED = 32,  /* alpha is the share of light that the surface reflects */
    MATERIAL_IS_TWO_SIDED = 64,
    MATERIAL_IS_LEGACY = 128, /* the file's index is 0: at every angle the specular colour alone
                                 says how much is reflected; `ior` is the default */
    MATERIAL_IS_FILM = 256,   /* of water on something opaque, whose colour and normal texture are
                               those of the matt base; the surface itself is even */
    MATERIAL_FLAGS = 511,
};

/* The textures of a material, by what they are multiplied with. */
enum material_texture_use {
    MATERIAL_BASE_COLOR,         /* rgb: base_color; a: alpha */
    MATERIAL_METALLIC_ROUGHNESS, /* b: metallic; g: roughness */
    MATERIAL_NORMAL,             /* rgb: the normal, 0 to 1 for -1 to 1 */
    MATERIAL_OCCLUSION,          /* r */
    MATERIAL_EMISSION,           /* rgb: emission */
    MATERIAL_TRANSMISSION,       /* r: transmission */
    MATERIAL_THICKNESS,          /* g: thickness */
    MATERIAL_SPECULAR,           /* a: specular */
    MATERIAL_SPECULAR_COLOR,     /* rgb: specular_color */
    MATERIAL_TEXTURE_COUNT,
};

/* Returns whether a use's textures are colours, so sRGB; else their texels are numbers. */
static inline bool material_texture_is_color(enum material_texture_use use)
{
    return use == MATERIAL_BASE_COLOR || use == MATERIAL_EMISSION || use == MATERIAL_SPECULAR_COLOR;
}

/* How coordinates beyond 0 to 1 are brought there. */
enum material_wrap {
    MATERIAL_REPEAT,
    MATERIAL_MIRROR,
    MATERIAL_CLAMP,
    MATERIAL_WRAP_COUNT,
};

/* A texture. Those of colours are sRGB; of others, the texels are the numbers themselves. */
struct material_texture {
    uint32_t layer; /* of model.textures or, if it is no colour, of model.numbers, + 1; 0: none, as
                       if it were 1 everywhere */
    uint32_t wrap_u, wrap_v; /* enum material_wrap */
    uint32_t uv_set;         /* 0: mesh_vertex.uv; 1: mesh_extra.uv */
    vec3s u_row, v_row;      /* its coordinates are their products with (uv, 1) of a vertex */
};

/*
 * A material in the terms of glTF 2.0 and its extensions KHR_materials_transmission, _volume, _ior,
 * _dispersion, _specular and _emissive_strength. A transmissive material bounds a medium: inside,
 * light of each channel is left by attenuation_color ^ (length / attenuation_distance).
 */
struct material {
    char name[MATERIAL_NAME_SIZE];
    uint32_t flags;
    vec3s base_color;           /* linear; tints light that passes a transmissive surface */
    float roughness;            /* 0 to 1; the width of the GGX distribution is its square */
    float transmission;         /* share of the light that is not reflected and passes; 0: opaque */
    float thickness;            /* 0: a thin wall, with the same medium on both sides */
    float ior;                  /* refractive index, 1 to 4 */
    float dispersion;           /* 20 / Abbe number, 0 to 10 */
    vec3s attenuation_color;    /* 0 to 1 */
    float attenuation_distance; /* metres; 0: the medium is clear */
    float cloud; /* scatterings of light across the object where it is cloudiest; 0: it is clear */
    int32_t priority;         /* where media overlap, the greatest one is there */
    float metallic;           /* 0 to 1; glTF's default is 1, and that of others 0 */
    float alpha;              /* 0 to 1 */
    float alpha_cutoff;       /* of a cutout: less alpha is a hole; 0 to 1 */
    vec3s emission;           /* radiance, 0 to 65504; its strength is part of it */
    float normal_scale;       /* of x and y of the normal's texture; within 65504 */
    float occlusion_strength; /* 0 to 1 */
    float specular;           /* 0 to 1; strength of the reflection of what is no metal */
    vec3s specular_color;     /* 0 to 65504; its colour at normal incidence */
    struct material_texture textures[MATERIAL_TEXTURE_COUNT];
};

/* Returns whether a texture changes how light passes a transmissive surface, or is reflected by it:
 * one of the base colour, the roughness, the transmission or the normal. */
bool material_is_dressed(const struct material *material);

/* Returns glTF's default material, white and opaque, with a name. */
struct material material_make(const char *name);

/* Brings all values into their ranges; those that are no numbers become the defaults. Returns
 * whether that changes any. */
bool material_clamp(struct material *material);

/* Returns the coefficients of Beer and Lambert's law for red, green and blue light, 1 / metre. */
vec3s material_absorption(const struct material *material);

/* A transparent medium, as --material names it. */
struct material_preset {
    const char *name;
    float ior; /* refractive index */
    const char *help;
};

extern const struct material_preset material_presets[]; /* ends at a row of zeros */

/* Returns the preset of that name, or NULL. */
const struct material_preset *material_preset_find(const char *name);

#endif
