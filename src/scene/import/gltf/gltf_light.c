/* gltf_light.c: reads the lights of a glTF file (KHR_lights_punctual). */
#include <cglm/struct.h>
#include <stdlib.h>
#include <string.h>
#include "src/scene/import/gltf/gltf.h"

static const char extension[] = "KHR_lights_punctual";

/* Returns a node's light index, checked by gltf_validate(), or gltf_none if it has no light. */
static uint32_t light_of(struct gltf *gltf, uint32_t node)
{
    const struct gltf_object object = gltf_element(gltf, "nodes", node);
    const struct gltf_object node_light = gltf_extension(&object, extension);
    return (uint32_t)gltf_count(&node_light, "light", gltf_none);
}

static bool read_kind(const struct gltf_object *object, struct light *light)
{
    const char *type = gltf_string(object, "type", "");
    for (light->kind = 0; light->kind < LIGHT_KIND_COUNT; light->kind++) {
        if (!strcmp(type, punctual_light_kind_name(light)))
            return true;
    }
    (void)gltf_fault(object, "type: expected directional, point or spot, got \"%.16s\"", type);
    return false;
}

/* Sets position and direction. Lights emit along -Z of their node. Node scale has no effect. */
static void set_transform(struct light *light, mat4s model_from_node)
{
    light->position = glms_mat4_mulv3(model_from_node, glms_vec3_zero(), 1);
    light->direction =
        glms_vec3_normalize(glms_mat4_mulv3(model_from_node, (vec3s){ { 0, 0, -1 } }, 0));
    if (light->kind == LIGHT_POINT)
        light->direction = (vec3s){ { 0, 0, -1 } };
}

static void read_light(struct gltf *gltf, const struct gltf_node *node, uint32_t index,
                       struct light *light)
{
    const struct gltf_object top = gltf_top(gltf);
    const struct gltf_object all = gltf_extension(&top, extension);
    const struct gltf_object object = gltf_item(&all, "lights", index);
    if (!read_kind(&object, light))
        return;
    const char *light_name = gltf_string(&object, "name", "");
    (void)snprintf(light->name, sizeof(light->name), "%s", node->name[0] ? node->name : light_name);
    light->color = glms_vec3_one();
    (void)gltf_floats(&object, "color", light->color.raw, 3);
    light->intensity = gltf_number(&object, "intensity", 1);
    light->range = gltf_number(&object, "range", 0);
    if (light->kind == LIGHT_SPOT) {
        const struct gltf_object spot = gltf_member(&object, "spot");
        light->inner_cone = gltf_number(&spot, "innerConeAngle", 0);
        light->outer_cone = gltf_number(&spot, "outerConeAngle", 0.78539816F);
    }
    set_transform(light, affine_to_mat4(&node->model_from_node, gltf->origin));
    if (!punctual_light_is_valid(light))
        (void)gltf_fault(&object, "colour, intensity, range, cone or position out of range");
}

enum status gltf_lights_read(struct gltf *gltf, struct model *model)
{
    const struct gltf_object top = gltf_top(gltf);
    uint32_t count = 0;
    for (uint32_t i = 0; i < gltf->order_count; i++)
        count += light_of(gltf, gltf->order[i]) != gltf_none;
    if (count > MODEL_LIGHT_MAX)
        return gltf_fault(&top, "expected at most %d lights in the scene, got %u", MODEL_LIGHT_MAX,
                          count);
    model->lights = calloc(count + (size_t)1, sizeof(*model->lights));
    if (!model->lights)
        return gltf_out_of_memory(gltf);
    for (uint32_t i = 0; i < gltf->order_count && gltf->status == STATUS_OK; i++) {
        const uint32_t index = light_of(gltf, gltf->order[i]);
        if (index != gltf_none)
            read_light(gltf, &gltf->nodes[gltf->order[i]], index,
                       &model->lights[model->light_count++]);
    }
    return gltf->status;
}
