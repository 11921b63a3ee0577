/* frame_media.c: media of a scene's objects: refractive index, absorption, surface parameters. */
#include "src/tech/frame_media.h"
#include "src/tech/refract/absorption.h"
#include "src/tech/refract/refract.h"

#include <cglm/struct.h>
#include <math.h>

/* Computes the refractive indices for red, green and blue by KHR_materials_dispersion. */
static void disperse(float ior[static 3], float green, float dispersion)
{
    const float half = (green - 1.0f) * 0.025f * dispersion;
    ior[0] = green - half;
    ior[1] = green;
    ior[2] = green + half;
}

static struct frame_medium medium_of_settings(const struct refract_params *refract,
                                              vec3s absorption)
{
    struct frame_medium medium = { .absorption = absorption,
                                   .tint = glms_vec3_one(),
                                   .roughness = refract->roughness,
                                   .rank = 1 };
    disperse(medium.ior, refract->ior, refract->dispersion);
    return medium;
}

static struct frame_medium medium_of(const struct material *material, bool has_own_ior,
                                     const struct refract_params *refract, vec3s absorption)
{
    struct frame_medium medium = {
        .absorption = material_absorption(material),
        .tint = material->base_color,
        .roughness = refract->roughness > 0.0f ? refract->roughness : material->roughness,
        .opacity = 1.0f - material->transmission,
        .is_thin = !(material->thickness > 0.0f),
        .is_textured = material_is_textured(material),
    };
    if (absorption.x > 0.0f || absorption.y > 0.0f || absorption.z > 0.0f)
        medium.absorption = absorption;
    disperse(medium.ior, has_own_ior ? material->ior : refract->ior,
             refract->dispersion > 0.0f ? refract->dispersion : material->dispersion);
    return medium;
}

float frame_media_air(const struct scene *scene)
{
    /* glTF files assume a vacuum around objects; Seipel and Nivfors (2006) assume air. */
    return frame_media_are_from_settings(scene) ? REFRACT_IOR_AIR : 1.0f;
}

/* Returns the refractive index of the medium around the objects. */
static float outside_of(const struct scene *scene, const struct settings *settings)
{
    const float outside = refract_outside(scene, settings);
    const bool is_set = outside < REFRACT_IOR_AIR || outside > REFRACT_IOR_AIR;
    return is_set ? outside : frame_media_air(scene);
}

uint32_t frame_media_count(const struct scene *scene)
{
    return (scene->model.object_count ? scene->model.object_count : 1) + 1;
}

bool frame_media_are_from_settings(const struct scene *scene)
{
    const struct model *model = &scene->model;
    return !model->object_count ||
           model->materials[model->objects[0].material].flags & MATERIAL_FROM_SETTINGS;
}

bool frame_media_disperse(const struct scene *scene, const struct settings *settings)
{
    const struct model *model = &scene->model;
    const struct refract_params *refract = settings_of(settings, &refract_settings);
    if (refract->dispersion > 0.0f)
        return true;
    for (uint32_t i = 0; i < model->object_count && !frame_media_are_from_settings(scene); i++) {
        if (model->materials[model->objects[i].material].dispersion > 0.0f)
            return true;
    }
    return false;
}

bool frame_media_are_equal(const struct frame_medium *a, const struct frame_medium *b)
{
    for (int c = 0; c < 3; c++) {
        if (a->ior[c] != b->ior[c] || a->absorption.raw[c] != b->absorption.raw[c] ||
            a->tint.raw[c] != b->tint.raw[c])
            return false;
    }
    return a->roughness == b->roughness && a->opacity == b->opacity && a->is_thin == b->is_thin;
}

struct frame_medium frame_medium_at(const struct scene *scene, const struct settings *settings,
                                    uint32_t index)
{
    const struct model *model = &scene->model;
    const struct refract_params *refract = settings_of(settings, &refract_settings);
    const struct absorb_params *absorb = settings_of(settings, &absorb_settings);
    const vec3s absorption = { { absorb->red, absorb->green, absorb->blue } };
    const bool is_from_settings = frame_media_are_from_settings(scene);
    struct frame_medium medium = { .tint = glms_vec3_one() };
    if (index + 1 == frame_media_count(scene)) {
        disperse(medium.ior, outside_of(scene, settings), 0.0f);
    } else if (is_from_settings) {
        medium = medium_of_settings(refract, absorption);
    } else {
        medium = medium_of(&model->materials[model->objects[index].material],
                           refract->ior == scene->model_ior, refract, absorption);
        medium.rank = model->objects[index].rank;
    }
    return medium;
}
