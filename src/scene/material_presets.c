/* material_presets.c: table of transparent media, and the parser of their names.
 *
 * Indices and Abbe numbers are computed from the dispersion formulas of the cited data sets, as
 * collected on refractiveindex.info. Absorption is computed from the cited spectra for D65 and the
 * linear sRGB colours after 1 cm (ice and water: 1 m), with the colour matching functions of Wyman
 * et al. 2013. Narasimhan et al. 2006 measured red, green and blue. Where a preset states the
 * colour of an example, its absorption is a choice, because it varies from piece to piece.
 *
 * "CRC Handbook": concentrative properties of aqueous solutions. "GIA": gem reference of the
 * Gemological Institute of America. Schumann 2009, Gemstones of the World: dispersion from C to F.
 */
#include "src/scene/material_presets.h"
#include <cglm/struct.h>
#include <math.h>
#include <string.h>

const char *const material_kind_names[] = {
    [MATERIAL_KIND_WATER] = "ice and water", [MATERIAL_KIND_GLASS] = "glass",
    [MATERIAL_KIND_PLASTIC] = "plastic",     [MATERIAL_KIND_CRYSTAL] = "crystal",
    [MATERIAL_KIND_LIQUID] = "liquid",       [MATERIAL_KIND_GAS] = "gas",
};

const struct material_finish material_finishes[] = {
    { "rough", 0.2f, "lightly ground surface, roughness 0.2" },
    { "frosted", 0.5f, "sandblasted surface, roughness 0.5" },
    { 0 },
};

const struct material_preset material_presets[] = {
    {
        .name = "ice",
        .kind = MATERIAL_KIND_WATER,
        .ior = 1.3091f,
        .inclusions = MATERIAL_ICE,
        .help = "frozen water with bubbles and cracks",
        .source = "Seipel and Nivfors 2006",
    },
    {
        .name = "clear-ice",
        .kind = MATERIAL_KIND_WATER,
        .ior = 1.3098f,
        .abbe = 53.2f,
        .absorption = { { 0.204f, 0.043f, 0.0f } },
        .help = "ice without bubbles and cracks",
        .source = "Warren and Brandt 2008",
    },
    {
        .name = "cloudy-ice",
        .kind = MATERIAL_KIND_WATER,
        .ior = 1.3098f,
        .abbe = 53.2f,
        .absorption = { { 0.204f, 0.043f, 0.0f } },
        .inclusions = MATERIAL_WHITE_CORE,
        .optical_depth = 8.0f,
        .help = "ice with a white core of fine bubbles; cloudiness of an example",
        .source = "Warren and Brandt 2008",
    },
    {
        .name = "glacier-ice",
        .kind = MATERIAL_KIND_WATER,
        .ior = 1.3098f,
        .abbe = 53.2f,
        .absorption = { { 0.204f, 0.043f, 0.0f } },
        .inclusions = MATERIAL_WHITE_CORE,
        .optical_depth = 1.5f,
        .help = "old ice with few bubbles, blue from metres on; cloudiness of an example",
        .source = "Warren and Brandt 2008",
    },
    {
        .name = "water",
        .kind = MATERIAL_KIND_WATER,
        .ior = 1.333f,
        .help = "water at 20 degrees Celsius, without absorption",
        .source = "Fernando and Kilgard 2003",
    },
    {
        .name = "pure-water",
        .kind = MATERIAL_KIND_WATER,
        .ior = 1.3334f,
        .abbe = 55.8f,
        .absorption = { { 0.293f, 0.048f, 0.0f } },
        .help = "water at 20 degrees Celsius, blue from metres on",
        .source = "Daimon and Masumura 2007; absorption: Pope and Fry 1997",
    },
    {
        .name = "sea-water",
        .kind = MATERIAL_KIND_WATER,
        .ior = 1.3395f,
        .abbe = 54.9f,
        .absorption = { { 0.293f, 0.048f, 0.0f } },
        .help = "clear ocean water, salinity 35 g/kg, 20 degrees Celsius; absorption of pure water",
        .source = "Quan and Fry 1995; absorption: Pope and Fry 1997",
    },
    {
        .name = "glass",
        .kind = MATERIAL_KIND_GLASS,
        .ior = 1.5f,
        .help = "window glass, without absorption; with a rough surface glass:rough or "
                "glass:frosted, as any other name",
        .source = "Fernando and Kilgard 2003",
    },
    {
        .name = "window-glass",
        .kind = MATERIAL_KIND_GLASS,
        .ior = 1.5234f,
        .abbe = 64.0f,
        .absorption = { { 13.9f, 4.6f, 5.3f } },
        .help = "float glass, green at its edges",
        .source = "Rubin 1985",
    },
    {
        .name = "low-iron-glass",
        .kind = MATERIAL_KIND_GLASS,
        .ior = 1.5234f,
        .abbe = 64.0f,
        .absorption = { { 3.11f, 1.05f, 1.18f } },
        .help = "clear float glass",
        .source = "Rubin 1985",
    },
    {
        .name = "green-glass",
        .kind = MATERIAL_KIND_GLASS,
        .ior = 1.5234f,
        .abbe = 64.0f,
        .absorption = { { 66.0f, 25.8f, 27.0f } },
        .help = "green float glass",
        .source = "Rubin 1985",
    },
    {
        .name = "bronze-glass",
        .kind = MATERIAL_KIND_GLASS,
        .ior = 1.5234f,
        .abbe = 64.0f,
        .absorption = { { 73.4f, 95.4f, 121.0f } },
        .help = "bronze float glass",
        .source = "Rubin 1985",
    },
    {
        .name = "grey-glass",
        .kind = MATERIAL_KIND_GLASS,
        .ior = 1.5234f,
        .abbe = 64.0f,
        .absorption = { { 134.0f, 126.0f, 118.0f } },
        .help = "grey float glass",
        .source = "Rubin 1985",
    },
    {
        .name = "borosilicate",
        .kind = MATERIAL_KIND_GLASS,
        .ior = 1.4715f,
        .abbe = 66.0f,
        .absorption = { { 0.2f, 0.36f, 0.95f } },
        .help = "heat-resistant glass of ovens and laboratories",
        .source = "Schott data sheet BOROFLOAT 33",
    },
    {
        .name = "fused-silica",
        .kind = MATERIAL_KIND_GLASS,
        .ior = 1.4585f,
        .abbe = 67.8f,
        .help = "glass of pure silicon dioxide",
        .source = "Malitson 1965",
    },
    {
        .name = "lead-crystal",
        .kind = MATERIAL_KIND_GLASS,
        .ior = 1.5481f,
        .abbe = 45.7f,
        .absorption = { { 0.14f, 0.13f, 0.17f } },
        .help = "cut lead glass; figures of a light flint",
        .source = "Schott data sheet LLF1",
    },
    {
        .name = "bk7",
        .kind = MATERIAL_KIND_GLASS,
        .ior = 1.5168f,
        .abbe = 64.2f,
        .absorption = { { 0.23f, 0.18f, 0.3f } },
        .help = "borosilicate crown, the most common optical glass",
        .source = "Schott data sheet N-BK7",
    },
    {
        .name = "f2",
        .kind = MATERIAL_KIND_GLASS,
        .ior = 1.62f,
        .abbe = 36.4f,
        .absorption = { { 0.087f, 0.077f, 0.27f } },
        .help = "flint glass",
        .source = "Schott data sheet F2",
    },
    {
        .name = "sf6",
        .kind = MATERIAL_KIND_GLASS,
        .ior = 1.8052f,
        .abbe = 25.4f,
        .absorption = { { 0.24f, 0.083f, 1.55f } },
        .help = "dense flint glass",
        .source = "Schott data sheet SF6",
    },
    {
        .name = "sf11",
        .kind = MATERIAL_KIND_GLASS,
        .ior = 1.7847f,
        .abbe = 25.8f,
        .absorption = { { 0.67f, 0.089f, 5.4f } },
        .help = "dense flint glass of prisms",
        .source = "Schott data sheet SF11",
    },
    {
        .name = "lasf9",
        .kind = MATERIAL_KIND_GLASS,
        .ior = 1.8502f,
        .abbe = 32.2f,
        .absorption = { { 0.81f, 1.0f, 6.1f } },
        .help = "lanthanum dense flint glass",
        .source = "Schott data sheet N-LASF9",
    },
    {
        .name = "plastic",
        .kind = MATERIAL_KIND_PLASTIC,
        .ior = 1.5f,
        .help = "acrylic, without absorption",
        .source = "Fernando and Kilgard 2003",
    },
    {
        .name = "acrylic",
        .kind = MATERIAL_KIND_PLASTIC,
        .ior = 1.4906f,
        .abbe = 53.2f,
        .absorption = { { 5.25f, 5.14f, 6.08f } },
        .help = "PMMA, acrylic glass",
        .source = "Sultanova 2009; absorption: Zhang 2020",
    },
    {
        .name = "polycarbonate",
        .kind = MATERIAL_KIND_PLASTIC,
        .ior = 1.5848f,
        .abbe = 27.9f,
        .absorption = { { 9.31f, 8.51f, 9.48f } },
        .help = "PC, of discs and safety goggles",
        .source = "Sultanova 2009; absorption: Zhang 2020",
    },
    {
        .name = "polystyrene",
        .kind = MATERIAL_KIND_PLASTIC,
        .ior = 1.5916f,
        .abbe = 29.5f,
        .absorption = { { 12.1f, 13.4f, 18.2f } },
        .help = "PS, of clear boxes and cups",
        .source = "Sultanova 2009; absorption: Zhang 2020",
    },
    {
        .name = "pet",
        .kind = MATERIAL_KIND_PLASTIC,
        .ior = 1.5693f,
        .abbe = 27.9f,
        .absorption = { { 24.8f, 31.0f, 41.4f } },
        .help = "PET, of bottles",
        .source = "Zhang 2020",
    },
    {
        .name = "diamond",
        .kind = MATERIAL_KIND_CRYSTAL,
        .ior = 2.417f,
        .help = "diamond without dispersion",
        .source = "Fernando and Kilgard 2003",
    },
    {
        .name = "brilliant",
        .kind = MATERIAL_KIND_CRYSTAL,
        .ior = 2.4175f,
        .abbe = 55.3f,
        .help = "diamond with dispersion (fire)",
        .source = "Peter 1923",
    },
    {
        .name = "moissanite",
        .kind = MATERIAL_KIND_CRYSTAL,
        .ior = 2.6473f,
        .abbe = 25.5f,
        .help = "silicon carbide; ordinary ray",
        .source = "Singh 1971",
    },
    {
        .name = "cubic-zirconia",
        .kind = MATERIAL_KIND_CRYSTAL,
        .ior = 2.1588f,
        .abbe = 33.5f,
        .help = "imitation of diamond",
        .source = "Wood and Nassau 1982",
    },
    {
        .name = "zircon",
        .kind = MATERIAL_KIND_CRYSTAL,
        .ior = 1.93f,
        .abbe = 42.3f,
        .help = "colourless zircon; ordinary ray",
        .source = "GIA; dispersion: Schumann 2009",
    },
    {
        .name = "quartz",
        .kind = MATERIAL_KIND_CRYSTAL,
        .ior = 1.5443f,
        .abbe = 69.7f,
        .help = "rock crystal; ordinary ray",
        .source = "Ghosh 1999",
    },
    {
        .name = "amethyst",
        .kind = MATERIAL_KIND_CRYSTAL,
        .ior = 1.5443f,
        .abbe = 69.7f,
        .absorption = { { 80.0f, 171.0f, 43.0f } },
        .help = "violet quartz; colour of an example",
        .source = "Ghosh 1999",
    },
    {
        .name = "citrine",
        .kind = MATERIAL_KIND_CRYSTAL,
        .ior = 1.5443f,
        .abbe = 69.7f,
        .absorption = { { 7.0f, 42.0f, 171.0f } },
        .help = "yellow quartz; colour of an example",
        .source = "Ghosh 1999",
    },
    {
        .name = "white-sapphire",
        .kind = MATERIAL_KIND_CRYSTAL,
        .ior = 1.7682f,
        .abbe = 72.3f,
        .help = "colourless corundum; ordinary ray",
        .source = "Malitson and Dodge 1972",
    },
    {
        .name = "sapphire",
        .kind = MATERIAL_KIND_CRYSTAL,
        .ior = 1.7682f,
        .abbe = 72.3f,
        .absorption = { { 300.0f, 197.0f, 48.0f } },
        .help = "blue corundum; colour of an example",
        .source = "Malitson and Dodge 1972",
    },
    {
        .name = "ruby",
        .kind = MATERIAL_KIND_CRYSTAL,
        .ior = 1.7682f,
        .abbe = 72.3f,
        .absorption = { { 25.0f, 351.0f, 241.0f } },
        .help = "red corundum; colour of an example",
        .source = "Malitson and Dodge 1972",
    },
    {
        .name = "emerald",
        .kind = MATERIAL_KIND_CRYSTAL,
        .ior = 1.58f,
        .abbe = 64.4f,
        .absorption = { { 281.0f, 54.0f, 143.0f } },
        .help = "green beryl; colour of an example",
        .source = "GIA; dispersion: Schumann 2009",
    },
    {
        .name = "aquamarine",
        .kind = MATERIAL_KIND_CRYSTAL,
        .ior = 1.58f,
        .abbe = 64.4f,
        .absorption = { { 60.0f, 15.0f, 11.0f } },
        .help = "light blue beryl; colour of an example",
        .source = "GIA; dispersion: Schumann 2009",
    },
    {
        .name = "topaz",
        .kind = MATERIAL_KIND_CRYSTAL,
        .ior = 1.62f,
        .abbe = 77.5f,
        .absorption = { { 5.0f, 42.0f, 120.0f } },
        .help = "golden topaz; colour of an example",
        .source = "GIA; dispersion: Schumann 2009",
    },
    {
        .name = "peridot",
        .kind = MATERIAL_KIND_CRYSTAL,
        .ior = 1.67f,
        .abbe = 55.8f,
        .absorption = { { 69.0f, 33.0f, 183.0f } },
        .help = "yellow-green olivine; colour of an example",
        .source = "GIA; dispersion: Schumann 2009",
    },
    {
        .name = "garnet",
        .kind = MATERIAL_KIND_CRYSTAL,
        .ior = 1.746f,
        .abbe = 57.4f,
        .absorption = { { 87.0f, 369.0f, 335.0f } },
        .help = "dark red pyrope; colour of an example",
        .source = "GIA; dispersion: Schumann 2009",
    },
    {
        .name = "spinel",
        .kind = MATERIAL_KIND_CRYSTAL,
        .ior = 1.7162f,
        .abbe = 60.7f,
        .help = "colourless spinel",
        .source = "Tropf 1995",
    },
    {
        .name = "fluorite",
        .kind = MATERIAL_KIND_CRYSTAL,
        .ior = 1.4338f,
        .abbe = 95.0f,
        .help = "calcium fluoride",
        .source = "Malitson 1963",
    },
    {
        .name = "whisky",
        .kind = MATERIAL_KIND_LIQUID,
        .ior = 1.3553f,
        .absorption = { { 5.0f, 33.0f, 120.0f } },
        .help = "40 % of alcohol; colour of an example",
        .source = "CRC Handbook (33 % ethanol by mass)",
    },
    {
        .name = "red-wine",
        .kind = MATERIAL_KIND_LIQUID,
        .ior = 1.3395f,
        .absorption = { { 116.0f, 252.0f, 294.0f } },
        .help = "Merlot",
        .source = "CRC Handbook (10 % ethanol by mass); absorption: Narasimhan 2006",
    },
    {
        .name = "white-wine",
        .kind = MATERIAL_KIND_LIQUID,
        .ior = 1.3395f,
        .absorption = { { 10.8f, 11.9f, 24.0f } },
        .help = "Chardonnay",
        .source = "CRC Handbook (10 % ethanol by mass); absorption: Narasimhan 2006",
    },
    {
        .name = "beer",
        .kind = MATERIAL_KIND_LIQUID,
        .ior = 1.3395f,
        .absorption = { { 11.5f, 24.9f, 57.8f } },
        .help = "lager; index of wine",
        .source = "index: CRC Handbook; absorption: Narasimhan 2006",
    },
    {
        .name = "cola",
        .kind = MATERIAL_KIND_LIQUID,
        .ior = 1.3478f,
        .absorption = { { 100.0f, 165.0f, 247.0f } },
        .help = "cola",
        .source = "CRC Handbook (10 % sucrose by mass); absorption: Narasimhan 2006",
    },
    {
        .name = "apple-juice",
        .kind = MATERIAL_KIND_LIQUID,
        .ior = 1.3478f,
        .absorption = { { 13.0f, 23.7f, 52.2f } },
        .help = "clear apple juice",
        .source = "CRC Handbook (10 % sucrose by mass); absorption: Narasimhan 2006",
    },
    {
        .name = "cranberry-juice",
        .kind = MATERIAL_KIND_LIQUID,
        .ior = 1.3478f,
        .absorption = { { 39.4f, 94.2f, 124.0f } },
        .help = "cranberry juice",
        .source = "CRC Handbook (10 % sucrose by mass); absorption: Narasimhan 2006",
    },
    {
        .name = "tea",
        .kind = MATERIAL_KIND_LIQUID,
        .ior = 1.333f,
        .absorption = { { 22.0f, 97.0f, 253.0f } },
        .help = "black tea; index of water; colour of an example",
        .source = "Fernando and Kilgard 2003",
    },
    {
        .name = "olive-oil",
        .kind = MATERIAL_KIND_LIQUID,
        .ior = 1.4677f,
        .absorption = { { 16.0f, 22.0f, 139.0f } },
        .help = "olive oil; colour of an example",
        .source = "Codex Alimentarius 33",
    },
    {
        .name = "honey",
        .kind = MATERIAL_KIND_LIQUID,
        .ior = 1.494f,
        .absorption = { { 11.0f, 54.0f, 212.0f } },
        .help = "honey with 17 % of water; colour of an example",
        .source = "Wedmore 1955",
    },
    {
        .name = "alcohol",
        .kind = MATERIAL_KIND_LIQUID,
        .ior = 1.3617f,
        .abbe = 59.4f,
        .help = "ethanol",
        .source = "Rheims 1997",
    },
    {
        .name = "glycerol",
        .kind = MATERIAL_KIND_LIQUID,
        .ior = 1.4723f,
        .abbe = 68.3f,
        .help = "glycerol",
        .source = "Rheims 1997",
    },
    {
        .name = "milk",
        .kind = MATERIAL_KIND_LIQUID,
        .ior = 1.3478f,
        .absorption = { { 1.5f, 4.6f, 19.9f } },
        .inclusions = MATERIAL_MILKY,
        .optical_depth = 60.0f,
        .help =
            "whole milk, thinner than real: an even medium of optical depth 60 across an object "
            "of any size",
        .source = "index: CRC Handbook; absorption: Narasimhan 2006",
    },
    {
        .name = "air",
        .kind = MATERIAL_KIND_GAS,
        .ior = 1.0003f,
        .help = "no refraction",
        .source = "Fernando and Kilgard 2003",
    },
    {
        .name = "vacuum",
        .kind = MATERIAL_KIND_GAS,
        .ior = 1.0f,
        .help = "index slightly below that of air",
        .source = "by definition",
    },
    { 0 },
};

bool material_choice_parse(struct material_choice *choice, const char *name, size_t length)
{
    const char *colon = memchr(name, ':', length);
    const size_t preset_length = colon ? (size_t)(colon - name) : length;
    *choice = (struct material_choice){ 0 };
    for (const struct material_preset *m = material_presets; m->name && !choice->preset; m++) {
        if (strlen(m->name) == preset_length && !strncmp(m->name, name, preset_length))
            choice->preset = m;
    }
    for (const struct material_finish *f = material_finishes; f->name && colon; f++) {
        if (strlen(f->name) == length - preset_length - 1 &&
            !strncmp(f->name, colon + 1, strlen(f->name)))
            choice->finish = f;
    }
    return choice->preset && (choice->finish || !colon);
}

vec3s material_preset_color(const struct material_preset *preset)
{
    vec3s color;
    for (int k = 0; k < 3; k++)
        color.raw[k] = expf(-preset->absorption.raw[k] * MATERIAL_COLOR_LENGTH);
    return color;
}

float material_preset_dispersion(const struct material_preset *preset)
{
    return preset->abbe > 0.0f ? 20.0f / preset->abbe : 0.0f;
}

struct material material_of_choice(const struct material_choice *choice)
{
    const struct material_preset *preset = choice->preset;
    const bool is_colored = glms_vec3_max(preset->absorption) > 0.0f;
    const bool is_milky = preset->inclusions == MATERIAL_MILKY;
    struct material material = material_make(preset->name);
    material.flags = MATERIAL_HAS_IOR | (is_milky ? MATERIAL_SCATTERS_EVENLY : 0u);
    material.ior = preset->ior;
    material.dispersion = material_preset_dispersion(preset);
    material.attenuation_color = material_preset_color(preset);
    material.attenuation_distance = is_colored ? MATERIAL_COLOR_LENGTH : 0.0f;
    material.scattering_optical_depth = preset->optical_depth;
    material.roughness = choice->finish ? choice->finish->roughness : 0.0f;
    material.transmission = 1.0f;
    material.thickness = 1.0f;
    return material;
}
