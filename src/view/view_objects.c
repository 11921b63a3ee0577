/* view_objects.c: selection of an object, and changes of its material, position and visibility. */
#include <cglm/struct.h>
#include <stdio.h>
#include <string.h>
#include "src/settings/scene_settings.h"
#include "src/view/view_internal.h"

void view_update_objects(struct view *v)
{
    const struct scene_objects *objects = &v->objects;
    scene_objects_update(&v->objects, v->viewport);
    if (v->selected >= objects->count ||
        strcmp(objects->all[v->selected].name, v->selected_name) != 0)
        v->selected = scene_objects_find(objects, v->selected_name);
    object_outline_update(&v->outline, v->viewport, view_time(v), v->selected);
}

void view_select(struct view *v, uint32_t index)
{
    char words[256];
    const struct scene_object *object = index < v->objects.count ? &v->objects.all[index] : NULL;
    v->selected = object ? index : SCENE_OBJECT_NONE;
    snprintf(v->selected_name, sizeof(v->selected_name), "%s", object ? object->name : "");
    if (object)
        snprintf(words, sizeof(words), "selected: %s%s%s", object->label,
                 object->material[0] ? ", " : "", object->material);
    ui_show_message(v->ui, object ? words : "no object selected");
}

void view_pick(struct view *v, float x, float y)
{
    vec3s at;
    const uint32_t found = scene_objects_pick(v->viewport, view_time(v), x, y, &at);
    if (found != SCENE_OBJECT_NONE || v->selected != SCENE_OBJECT_NONE)
        view_select(v, found);
}

void view_focus(struct view *v, float x, float y)
{
    const struct camera *camera = &v->viewport->camera;
    const struct setting *row = settings_row(&lens_settings, offsetof(struct lens_params, focus));
    struct view_state state = view_state_now(v);
    vec3s at;
    if (scene_objects_pick(v->viewport, view_time(v), x, y, &at) == SCENE_OBJECT_NONE) {
        ui_show_message(v->ui, "no surface at this point");
        return;
    }
    settings_set_value(
        &state.settings, row,
        (double)glms_vec3_dot(glms_vec3_sub(at, camera->eye), camera_basis(camera).forward));
    view_edit(v, &state, 0);
}

void view_override_material(struct view *v, const struct material_override *override)
{
    struct setup_scene scene = v->viewport->state.scene;
    uint32_t i = 0;
    while (i < scene.material_override_count &&
           strcmp(scene.material_overrides[i].name, override->name) != 0)
        i++;
    if (i == SETUP_NODE_COUNT) {
        ui_show_failure(v->ui, "16 nodes have a material of their own already: undo one of these");
        return;
    }
    scene.material_overrides[i] = *override;
    scene.material_override_count += i == scene.material_override_count;
    view_reload_scene(v, &scene, override->words);
}

void view_transform_object(struct view *v, const struct object_transform *transform)
{
    char words[SETUP_TRANSFORM_SIZE + 8];
    struct setup_scene scene = v->viewport->state.scene;
    uint32_t i = 0;
    while (i < scene.object_transform_count &&
           strcmp(scene.object_transforms[i].name, transform->name) != 0)
        i++;
    if (i == SETUP_NODE_COUNT) {
        ui_show_failure(v->ui, "16 nodes are moved or hidden already: undo one of these");
        return;
    }
    const bool was_hidden =
        i < scene.object_transform_count && scene.object_transforms[i].is_hidden;
    scene.object_transforms[i] = *transform;
    scene.object_transform_count += i == scene.object_transform_count;
    if (transform->is_hidden != was_hidden)
        snprintf(words, sizeof(words), "%s %s", transform->is_hidden ? "hide" : "show",
                 transform->name);
    else
        setup_print_transform(transform, words);
    view_reload_scene(v, &scene, words);
}
