/* setup_material.c: applies material presets to settings, and recognises thin walls. */
#include "src/setup/setup_material.h"
#include <cglm/struct.h>
#include <math.h>
#include <stdio.h>
#include "src/scene/material_override.h"
#include "src/tech/inclusions/air.h"
#include "src/tech/refract/absorption.h"
#include "src/tech/refract/refract.h"

/* Mean wall thickness below which an object has no inclusions, relative to its diagonal. It is the
 * default diameter of the largest bubbles. */
#define THIN_WALL 0.03f

enum {
    VALUE_COUNT = 8,
    ROUGHNESS = 5, /* index of refract.roughness in values_of() */
};

struct setting_value {
    const struct setting *row;
    double value;
};

/* Lists the settings of a material with the values that a choice gives them. */
static void values_of(struct setting_value values[static VALUE_COUNT],
                      const struct material_choice *choice, float absorption_scale)
{
    static const enum air_model models[] = {
        [MATERIAL_CLEAR] = AIR_PLANES,
        [MATERIAL_ICE] = AIR_PLANES,
        [MATERIAL_WHITE_CORE] = AIR_MEDIUM,
        [MATERIAL_MILKY] = AIR_EVEN,
    };
    const struct material_preset *preset = choice->preset;
    const vec3s absorption = glms_vec3_scale(preset->absorption, absorption_scale);
    const struct setting *density =
        settings_row(&air_settings, offsetof(struct air_params, density));

    const struct setting_value all[VALUE_COUNT] = {
        { settings_row(&refract_settings, offsetof(struct refract_params, ior)),
          (double)preset->ior },
        { settings_row(&refract_settings, offsetof(struct refract_params, dispersion)),
          (double)material_preset_dispersion(preset) },
        { settings_row(&absorb_settings, offsetof(struct absorb_params, red)),
          (double)absorption.x },
        { settings_row(&absorb_settings, offsetof(struct absorb_params, green)),
          (double)absorption.y },
        { settings_row(&absorb_settings, offsetof(struct absorb_params, blue)),
          (double)absorption.z },
        [ROUGHNESS] = { settings_row(&refract_settings, offsetof(struct refract_params, roughness)),
                        choice->finish ? (double)choice->finish->roughness : 0.0 },
        { settings_row(&air_settings, offsetof(struct air_params, model)),
          (double)models[preset->inclusions] },
        { density,
          preset->optical_depth > 0.0f ? (double)preset->optical_depth : density->initial },
    };
    for (int i = 0; i < VALUE_COUNT; i++)
        values[i] = all[i];
}

float setup_absorption_scale(const char *name, const struct scene *scene)
{
    if (!scene_find_builtin(name) || !scene->model.object.index_count)
        return 1.0f;
    const struct box box = mesh_box(&scene->model.object);
    return SETUP_BUILTIN_WIDTH / fmaxf(glms_vec3_max(glms_vec3_sub(box.max, box.min)), 1e-6f);
}

void setup_put_material(struct settings *settings, const struct material_choice *choice,
                        float absorption_scale, enum setting_source source)
{
    struct setting_value values[VALUE_COUNT];
    values_of(values, choice, absorption_scale);
    for (int i = 0; i < VALUE_COUNT; i++) {
        if (values[i].value < values[i].row->initial || values[i].value > values[i].row->initial ||
            i == 0)
            settings_put(settings, values[i].row, values[i].value, source);
    }
}

void setup_set_material(struct settings *settings, const struct material_choice *choice,
                        float absorption_scale)
{
    struct setting_value values[VALUE_COUNT];
    values_of(values, choice, absorption_scale);
    for (int i = 0; i < VALUE_COUNT; i++)
        settings_set_value(settings, values[i].row, values[i].value);
}

void setup_make_override(struct material_override *made, const char *node,
                         const struct material_choice *choice, const struct material *material)
{
    const struct material own = material_of_choice(choice);

    const struct {
        const char *name;
        float value, own;
    } keys[] = {
        { "ior", material->ior, own.ior },
        { "roughness", material->roughness, own.roughness },
        { "dispersion", material->dispersion, own.dispersion },
    };

    *made = (struct material_override){ .material = own };
    snprintf(made->name, sizeof(made->name), "%s", node);
    int length = snprintf(made->words, sizeof(made->words), "%s=%s%s%s", node, choice->preset->name,
                          choice->finish ? ":" : "", choice->finish ? choice->finish->name : "");
    for (size_t i = 0; i < sizeof(keys) / sizeof(keys[0]); i++) {
        if (keys[i].value < keys[i].own || keys[i].value > keys[i].own)
            length += snprintf(&made->words[length], sizeof(made->words) - (size_t)length,
                               ",%s=%.6g", keys[i].name, (double)keys[i].value);
    }
    made->material.ior = material->ior;
    made->material.roughness = material->roughness;
    made->material.dispersion = material->dispersion;
}

const struct material_preset *setup_find_material(const struct settings *settings,
                                                  float absorption_scale)
{
    for (const struct material_preset *m = material_presets; m->name; m++) {
        struct setting_value values[VALUE_COUNT];
        bool is_equal = true;
        values_of(values, &(struct material_choice){ .preset = m }, absorption_scale);
        for (int i = 0; i < VALUE_COUNT && is_equal; i++) {
            const double is = settings_get(settings, values[i].row);
            is_equal = i == ROUGHNESS || fabs(is - values[i].value) <= 1e-6 * fabs(is);
        }
        if (is_equal)
            return m;
    }
    return NULL;
}

float setup_wall_thickness(const struct mesh *mesh, uint32_t first_index, uint32_t index_count)
{
    double volume = 0.0, area = 0.0;
    for (uint32_t i = first_index; i + 2 < first_index + index_count; i += 3) {
        vec3s p[3];
        for (uint32_t k = 0; k < 3; k++)
            p[k] = mesh->vertices[mesh->indices[i + k]].position;
        const vec3s n = glms_vec3_cross(glms_vec3_sub(p[1], p[0]), glms_vec3_sub(p[2], p[0]));
        volume += (double)glms_vec3_dot(glms_vec3_sub(p[0], mesh->vertices[0].position), n) / 6.0;
        area += (double)glms_vec3_norm(n) / 2.0;
    }
    return area > 0.0 ? (float)(2.0 * fabs(volume) / area) : 0.0f;
}

bool setup_has_thin_walls(const struct scene *scene)
{
    const struct model *model = &scene->model;
    if (model->object_count != 1 || scene->has_pool || model->objects[0].open_edge_count)
        return false;
    const struct object *object = &model->objects[0];
    const float wall =
        setup_wall_thickness(&model->object, object->first_index, object->index_count);
    return wall < THIN_WALL * box_diagonal(mesh_box(&model->object));
}
