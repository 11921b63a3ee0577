/* ui_setting_groups.c: table that assigns settings to the groups of the settings panel. */
#include "src/view/panels/ui_setting_groups.h"
#include <assert.h>
#include <string.h>

static const char *const names[UI_GROUP_COUNT] = {
    [UI_OBJECT] = "Object", [UI_MATERIAL] = "Material",
    [UI_INSIDE] = "Inside", [UI_LIGHT] = "Light & environment",
    [UI_CAMERA] = "Camera", [UI_QUALITY] = "Quality",
    [UI_WATER] = "Water",   [UI_EXPERT] = "Expert",
};

/* Settings of each group, in display order. */
static const struct {
    enum ui_setting_group group;
    const char *setting;
} table[] = {
    { UI_OBJECT, "motion.ice" },
    { UI_OBJECT, "motion.time" },
    { UI_OBJECT, "motion.count" },
    { UI_OBJECT, "motion.objects" },
    { UI_OBJECT, "ice.melt" },
    { UI_OBJECT, "motion.melt" },
    { UI_OBJECT, "object.triangles" },
    { UI_MATERIAL, "refract.ior" },
    { UI_MATERIAL, "refract.dispersion" },
    { UI_MATERIAL, "highlight.strength" },
    { UI_MATERIAL, "highlight.shininess" },
    { UI_MATERIAL, "bump.strength" },
    { UI_MATERIAL, "refract.roughness" },
    { UI_MATERIAL, "bump.scale" },
    { UI_MATERIAL, "bump.mask" },
    { UI_MATERIAL, "bump.mapping" },
    { UI_MATERIAL, "bump.seed" },
    { UI_MATERIAL, "frost.amount" },
    { UI_MATERIAL, "frost.roughness" },
    { UI_MATERIAL, "refract.ior_outside" },
    { UI_MATERIAL, "absorb.red" },
    { UI_MATERIAL, "absorb.green" },
    { UI_MATERIAL, "absorb.blue" },
    { UI_INSIDE, "cracks.count" },
    { UI_INSIDE, "bubbles.count" },
    { UI_INSIDE, "bubbles.size" },
    { UI_INSIDE, "bubbles.shape" },
    { UI_INSIDE, "bubbles.aspect" },
    { UI_INSIDE, "air.count" },
    { UI_INSIDE, "air.strength" },
    { UI_INSIDE, "air.haze" },
    { UI_INSIDE, "air.size" },
    { UI_INSIDE, "air.frequency" },
    { UI_INSIDE, "cracks.refract" },
    { UI_INSIDE, "cracks.strength" },
    { UI_INSIDE, "cracks.shininess" },
    { UI_INSIDE, "cracks.bump" },
    { UI_INSIDE, "cracks.seed" },
    { UI_INSIDE, "bubbles.seed" },
    { UI_INSIDE, "air.seed" },
    { UI_LIGHT, "sky.sun_elevation" },
    { UI_LIGHT, "sky.sun_azimuth" },
    { UI_LIGHT, "sky.sun_strength" },
    { UI_LIGHT, "sky.strength" },
    { UI_LIGHT, "env.blur" },
    { UI_LIGHT, "env.sun" },
    { UI_LIGHT, "env.sun_strength" },
    { UI_LIGHT, "env.sun_elevation" },
    { UI_LIGHT, "env.sun_azimuth" },
    { UI_LIGHT, "light.count" },
    { UI_LIGHT, "light.strength" },
    { UI_LIGHT, "ice_caustics.light" },
    { UI_LIGHT, "landscape.flat" },
    { UI_LIGHT, "ground.light" },
    { UI_LIGHT, "ssr.steps" },
    { UI_LIGHT, "ao.strength" },
    { UI_LIGHT, "light.azimuth" },
    { UI_LIGHT, "light.elevation" },
    { UI_LIGHT, "light.distance" },
    { UI_LIGHT, "motion.lights" },
    { UI_LIGHT, "ice_caustics.shadow" },
    { UI_LIGHT, "ice_caustics.surroundings_shadow" },
    { UI_LIGHT, "ice_caustics.radius" },
    { UI_CAMERA, "lens.f_stop" },
    { UI_CAMERA, "lens.focus" },
    { UI_CAMERA, "tonemap.exposure" },
    { UI_CAMERA, "tonemap.curve" },
    { UI_CAMERA, "motion.fps" },
    { UI_QUALITY, "refract.fresnel" },
    { UI_QUALITY, "refract.lookup" },
    { UI_QUALITY, "refract.crossfade" },
    { UI_QUALITY, "env_cube.size" },
    { UI_QUALITY, "env_cube.dynamic" },
    { UI_QUALITY, "refract_bounce.reflections" },
    { UI_QUALITY, "ground.shading" },
    { UI_QUALITY, "texture.anisotropy" },
    { UI_QUALITY, "inclusions.scale" },
    { UI_WATER, "pool.water" },
    { UI_WATER, "pool.ice" },
    { UI_WATER, "water.height" },
    { UI_WATER, "water.speed" },
    { UI_WATER, "water.scale" },
    { UI_WATER, "caustics.method" },
    { UI_WATER, "pool.depth" },
    { UI_WATER, "pool.size" },
    { UI_WATER, "pool.tile" },
    { UI_WATER, "water.wave" },
    { UI_WATER, "water.frequency" },
    { UI_WATER, "water.amplitude" },
    { UI_WATER, "water.octaves" },
    { UI_WATER, "water.ior" },
    { UI_WATER, "water.red" },
    { UI_WATER, "water.green" },
    { UI_WATER, "water.blue" },
};

enum {
    ROW_COUNT = sizeof(table) / sizeof(table[0]),
};

const char *ui_setting_groups_name(enum ui_setting_group group)
{
    return names[group];
}

enum ui_setting_group ui_setting_groups_of(const struct setting *row)
{
    for (size_t i = 0; i < ROW_COUNT; i++) {
        if (!strcmp(table[i].setting, row->name))
            return table[i].group;
    }
    return UI_EXPERT;
}

static const struct setting *expert_row(uint32_t i)
{
    const struct setting *row = settings_next(NULL);
    while (row && (ui_setting_groups_of(row) != UI_EXPERT || i--))
        row = settings_next(row);
    return row;
}

const struct setting *ui_setting_groups_row(enum ui_setting_group group, uint32_t i)
{
    if (group == UI_EXPERT)
        return expert_row(i);
    for (size_t t = 0; t < ROW_COUNT; t++) {
        if (table[t].group != group || i--)
            continue;
        const struct setting *row = settings_find(table[t].setting);
        assert(row);
        return row;
    }
    return NULL;
}
