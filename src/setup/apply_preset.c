/* apply_preset.c: applies the settings of --preset. */
#include "src/setup/apply_preset.h"
#include <string.h>
#include "src/file/preset.h"
#include "src/scene/scene.h"

/* Name of the built-in preset, which restores the paper's surroundings and lighting. */
static const char paper[] = "paper";
static const char *const paper_lines[] = { "ice_caustics.light=none",
                                           "ground.light=open",
                                           "ssr.steps=0",
                                           "ao.strength=0",
                                           "highlight.fresnel=off",
                                           "tonemap.exposure=0",
                                           "tonemap.dither=off",
                                           "tonemap.resolve=linear",
                                           "refract_bounce.inclusions=cracks",
                                           NULL };

static enum status apply_line(struct setup_scene *scene, const char *assignment, uint32_t number)
{
    const struct settings_location location = { scene->preset, number };
    return settings_assign(&scene->settings, assignment, SETTING_PRESET, &location);
}

/* Applies the built-in preset `paper`, which also replaces the scene `ice-cube` by `valley`. */
static enum status apply_paper(struct setup_scene *scene)
{
    enum status status = STATUS_OK;
    if (scene->name && !strcmp(scene->name, "ice-cube"))
        scene->name = "valley";
    if (scene->name && !scene->environment && !scene->surroundings && !scene->background.is_given &&
        !scene_find_builtin(scene->name))
        scene->environment = "valley";
    for (uint32_t i = 0; paper_lines[i] && status == STATUS_OK; i++)
        status = apply_line(scene, paper_lines[i], i + 1);
    return status;
}

enum status setup_apply_preset(struct setup_scene *scene)
{
    struct preset preset = { 0 };
    if (!scene->preset)
        return STATUS_OK;
    if (!strcmp(scene->preset, paper))
        return apply_paper(scene);
    enum status status = preset_read(&preset, scene->preset, &scene->reader);
    for (uint32_t i = 0; i < preset.count && status == STATUS_OK; i++)
        status = apply_line(scene, preset.lines[i].assignment, preset.lines[i].number);
    preset_finish(&preset);
    return status;
}
