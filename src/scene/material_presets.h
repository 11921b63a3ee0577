/* material_presets.h: library of transparent media with measured refractive indices, dispersion and
 * absorption, named by --material. */
#ifndef FIRN_SCENE_MATERIAL_PRESETS_H
#define FIRN_SCENE_MATERIAL_PRESETS_H

#include <stddef.h>
#include "src/scene/material.h"

/* Thickness for which colours of media are stated, metres. */
#define MATERIAL_COLOR_LENGTH 0.01f

/* Groups of presets, in the order of the table. */
enum material_kind {
    MATERIAL_KIND_WATER, /* ice and water */
    MATERIAL_KIND_GLASS,
    MATERIAL_KIND_PLASTIC,
    MATERIAL_KIND_CRYSTAL,
    MATERIAL_KIND_LIQUID,
    MATERIAL_KIND_GAS,
    MATERIAL_KIND_COUNT,
};

/* Inclusions of a preset. */
enum material_inclusions {
    MATERIAL_CLEAR,      /* none */
    MATERIAL_ICE,        /* bubbles, cracks, planes of fine bubbles, bumps */
    MATERIAL_WHITE_CORE, /* as ice, with a scattering medium that is densest in the core */
    MATERIAL_MILKY,      /* an even scattering medium, and nothing else */
};

/* Preset of a transparent medium. */
struct material_preset {
    const char *name;
    enum material_kind kind;
    float ior;        /* refractive index at 587.6 nm */
    float abbe;       /* Abbe number; 0 for no dispersion */
    vec3s absorption; /* absorption coefficients for linear sRGB, 1 / metre */
    enum material_inclusions inclusions;
    float optical_depth; /* of the scattering medium, across the object's width */
    const char *help;
    const char *source; /* authors and year of index, Abbe number and absorption */
};

extern const struct material_preset material_presets[]; /* terminated by a zero entry */
extern const char *const material_kind_names[MATERIAL_KIND_COUNT];

/* Finish of a surface, appended to the name of a preset: "glass:frosted". */
struct material_finish {
    const char *name;
    float roughness;
    const char *help;
};

extern const struct material_finish material_finishes[]; /* terminated by a zero entry */

/* Preset and finish that a name such as "glass" or "glass:frosted" selects. */
struct material_choice {
    const struct material_preset *preset; /* NULL if the name is unknown */
    const struct material_finish *finish; /* NULL for a smooth surface */
};

/* Parses the first `length` characters of a name. Returns false if preset or finish are unknown. */
bool material_choice_parse(struct material_choice *choice, const char *name, size_t length);

/* Returns the colour of light after MATERIAL_COLOR_LENGTH in a medium, linear sRGB. */
vec3s material_preset_color(const struct material_preset *preset);

/* Returns the dispersion of KHR_materials_dispersion, 20 / Abbe number, or 0 for none. */
float material_preset_dispersion(const struct material_preset *preset);

/* Returns a material with the parameters of a choice and a solid interior. */
struct material material_of_choice(const struct material_choice *choice);

#endif
