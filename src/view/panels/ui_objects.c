/* ui_objects.c: list of the scene's objects, and rows of the selected one. */
#include "src/view/panels/ui_objects.h"
#include <cglm/struct.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include "src/base/path.h"
#include "src/scene/bundled_assets.h"
#include "src/setup/setup_material.h"
#include "src/tech/frame_media.h"

enum {
    ROWS_MAX = 7,     /* rows of the list that show without scrolling */
    LISTED_MAX = 500, /* objects in the list */
    TEXT_SIZE = 200,
};

static const char axes[3] = { 'X', 'Y', 'Z' };

const struct scene_object *ui_objects_selected(const struct ui_view *view)
{
    return view->selected < view->objects->count ? &view->objects->all[view->selected] : NULL;
}

/* ---- what can be changed ---- */

static bool is_builtin(const struct ui_view *view)
{
    return scene_find_builtin(view->viewport->state.scene.name);
}

static bool is_gltf(const struct ui_view *view)
{
    const char *name = view->viewport->state.scene.name;
    return path_ends_in(name, ".gltf") || path_ends_in(name, ".glb") ||
           asset_find(name, ASSET_SCENE);
}

/* Returns why an object can be neither transformed nor hidden; NULL if it can. */
static const char *why_fixed(const struct ui_view *view, const struct scene_object *object)
{
    if (is_builtin(view))
        return "Only nodes of model files can be moved and hidden, not built-in scenes.";
    if (!object->is_of_file)
        return "This is no node of the model file. Ground, in Light & environment, chooses floors.";
    return object->name[0] ? NULL : "It has no name by which --transform could find it.";
}

bool ui_objects_have_own_material(const struct ui_view *view)
{
    const struct scene_object *object = ui_objects_selected(view);
    return object &&
           !(object->is_refractive && frame_media_are_from_settings(&view->viewport->scene));
}

const char *ui_objects_why_no_material(const struct ui_view *view)
{
    const struct scene_object *object = ui_objects_selected(view);
    if (!ui_objects_have_own_material(view))
        return NULL;
    if (object->is_hidden)
        return "It is hidden.";
    if (is_builtin(view) || !object->is_of_file)
        return "Surroundings that are no nodes of a model file keep their materials.";
    if (!is_gltf(view))
        return "Only nodes of glTF files can have a material of their own. Without a selection, a "
               "click replaces all materials.";
    return object->name[0] ? NULL : "It has no name by which --material could find it.";
}

const struct material_override *ui_objects_override(const struct ui_view *view)
{
    const struct scene_object *object = ui_objects_selected(view);
    const struct setup_scene *scene = &view->viewport->state.scene;
    for (uint32_t i = scene->material_override_count; object && object->name[0] && i--;) {
        if (!strcmp(scene->material_overrides[i].name, object->name))
            return &scene->material_overrides[i];
    }
    return NULL;
}

void ui_objects_choose_material(const struct ui_view *view, struct ui_request *request,
                                const struct material_choice *choice)
{
    const struct material material = material_of_choice(choice);
    request->overrides = true;
    setup_make_override(&request->override, ui_objects_selected(view)->name, choice, &material);
}

void ui_objects_material_rows(struct ui *ui, const struct ui_view *view, struct ui_request *request)
{
    static const struct imgui_slider_range indices = { 1.0f, 4.0f, "%.4g", false };

    static const struct imgui_slider_range unit = { 0.0f, 1.0f, "%.3g", false };

    static const struct imgui_slider_range dispersions = { 0.0f, 10.0f, "%.3g", false };
    const struct material_override *is = ui_objects_override(view);
    struct material_choice choice = { 0 };
    if (!is || !material_choice_parse(&choice, &is->words[strlen(is->name) + 1],
                                      strcspn(&is->words[strlen(is->name) + 1], ","))) {
        imgui_text_wrapped("Choose a material for this object to change its index and roughness.");
        return;
    }
    struct material material = is->material;
    bool changed = ui_deferred_slider(ui, "Own index", &material.ior, &indices,
                                      "refractive index (--material NODE=NAME,ior=N)");
    changed = ui_deferred_slider(ui, "Own roughness", &material.roughness, &unit,
                                 "roughness of the surface (roughness=N); 0 is smooth") ||
              changed;
    changed = ui_deferred_slider(ui, "Own dispersion", &material.dispersion, &dispersions,
                                 "20 / Abbe number (dispersion=N)") ||
              changed;
    if (!changed)
        return;
    request->overrides = true;
    setup_make_override(&request->override, is->name, &choice, &material);
}

/* ---- transform ---- */

/* Returns the transform of the selected object. */
static struct object_transform transform_of(const struct ui_view *view,
                                            const struct scene_object *object)
{
    const struct setup_scene *scene = &view->viewport->state.scene;
    struct object_transform none = { .scale = 1.0f };
    for (uint32_t i = 0; i < scene->object_transform_count; i++) {
        if (!strcmp(scene->object_transforms[i].name, object->name))
            return scene->object_transforms[i];
    }
    memcpy(none.name, object->name, sizeof(none.name));
    return none;
}

static void transform_rows(struct ui *ui, const struct ui_view *view,
                           const struct scene_object *object, struct ui_request *request)
{
    const float reach = 2.0f * fmaxf(box_diagonal(view->viewport->scene.box),
                                     glms_vec3_distance(object->box.min, object->box.max));
    const struct imgui_slider_range moves = { -reach, reach, "%.4g m", false };
    const struct imgui_slider_range turns = { -180.0f, 180.0f, "%.4g\xc2\xb0", false };
    const struct imgui_slider_range scales = { 0.1f, 10.0f, "%.4g", true };
    struct object_transform t = transform_of(view, object);
    bool changed = false;
    char name[32];
    for (int k = 0; k < 3; k++) {
        snprintf(name, sizeof(name), "Move %c", axes[k]);
        changed =
            ui_deferred_slider(ui, name, &t.move.raw[k], &moves,
                               "metres along this axis (--transform); Ctrl+click types a number") ||
            changed;
    }
    for (int k = 0; k < 3; k++) {
        snprintf(name, sizeof(name), "Rotate %c", axes[k]);
        changed = ui_deferred_slider(
                      ui, name, &t.rotate_deg.raw[k], &turns,
                      "degrees about this axis, through the centre of the object (--transform)") ||
                  changed;
    }
    t.scale = t.scale > 0.0f ? t.scale : 1.0f;
    changed = ui_deferred_slider(ui, "Scale", &t.scale, &scales,
                                 "factor, about the centre of the object (--transform)") ||
              changed;
    if (changed) {
        request->transforms = true;
        request->transform = t;
    }
}

/* ---- list and facts ---- */

static void list_row(const struct ui_view *view, uint32_t i, struct ui_request *request)
{
    char id[MATERIAL_NAME_SIZE + 32];
    const struct scene_object *object = &view->objects->all[i];
    const char *reason = why_fixed(view, object);
    const char *material = object->is_hidden ? "hidden" : object->material;
    bool is_visible = !object->is_hidden;
    snprintf(id, sizeof(id), "##show %s", object->label);
    imgui_id_begin(object);
    imgui_disabled_begin(reason);
    if (imgui_checkbox(id, &is_visible)) {
        request->transforms = true;
        request->transform = transform_of(view, object);
        request->transform.is_hidden = !is_visible;
    }
    imgui_disabled_end();
    imgui_tooltip(reason ? reason : "show or leave out this object (--hide)");
    imgui_same_line(0.0f);
    const float width = imgui_width(material);
    const float room = imgui_available_width();
    const float x = imgui_cursor().x;
    if (imgui_selectable(object->label, i == view->selected)) {
        request->selects = true;
        request->selected = i == view->selected ? SCENE_OBJECT_NONE : i;
    }
    imgui_tooltip("select this object, or deselect it; a click in the image does the same");
    if (*material && room > width + imgui_width(object->label))
        imgui_text_at(x + room - width, material);
    imgui_id_end();
}

static void list(const struct ui_view *view, struct ui_request *request)
{
    const struct scene_objects *all = view->objects;
    uint32_t rows = 0;
    for (uint32_t i = 0; i < all->count && rows < ROWS_MAX; i++)
        rows += all->all[i].triangle_count || all->all[i].is_hidden;
    imgui_list_begin("objects", (float)rows * imgui_list_row_height());
    for (uint32_t i = 0; i < all->count && i < LISTED_MAX; i++) {
        if (all->all[i].triangle_count || all->all[i].is_hidden)
            list_row(view, i, request);
    }
    imgui_list_end();
}

static void print_facts(const struct ui_view *view, char text[static TEXT_SIZE])
{
    const struct scene *scene = &view->viewport->scene;
    const struct scene_object *object = ui_objects_selected(view);
    const struct box box = object ? object->box : scene->box;
    const vec3s size = glms_vec3_sub(box.max, box.min);
    int length;
    if (object && object->is_hidden) {
        snprintf(text, TEXT_SIZE, "%s: hidden", object->label);
        return;
    }
    if (object)
        length =
            snprintf(text, TEXT_SIZE, "%s: %u triangles, %s", object->label, object->triangle_count,
                     !object->is_refractive    ? "opaque"
                     : object->open_edge_count ? "open shell"
                                               : "closed shell");
    else
        length = snprintf(text, TEXT_SIZE, "%u refractive triangles, %u opaque, open shells: %u",
                          scene->model.object.index_count / 3,
                          scene->model.surroundings.index_count / 3, view->objects->open_count);
    if (length > 0 && length < TEXT_SIZE)
        snprintf(&text[length], (size_t)(TEXT_SIZE - length),
                 "; %.3g \xc3\x97 %.3g \xc3\x97 %.3g m", (double)size.x, (double)size.y,
                 (double)size.z);
}

void ui_objects_rows(struct ui *ui, const struct ui_view *view, struct ui_request *request)
{
    char text[TEXT_SIZE];
    const struct scene_object *object = ui_objects_selected(view);
    list(view, request);
    print_facts(view, text);
    imgui_text_wrapped(text);
    if (!object || object->is_hidden)
        return;
    const char *reason = why_fixed(view, object);
    if (reason)
        imgui_text_wrapped(reason);
    imgui_disabled_begin(reason);
    transform_rows(ui, view, object, request);
    imgui_disabled_end();
}

void ui_objects_outline(struct ui *ui, const struct ui_view *view)
{
    const struct present_area *p = view->image_area;
    const struct object_outline *outline = view->outline;
    const struct imgui_rect area = { (float)p->x, (float)p->y, (float)p->width, (float)p->height };
    ui->has_outline = outline->count && view->viewport->extent.width && p->width;
    if (!ui->has_outline)
        return;
    imgui_lines_begin(area);
    for (uint32_t pass = 0; pass < 2; pass++) {
        for (uint32_t i = 0; i < outline->count; i++) {
            const vec4s l = outline->lines[i];
            imgui_line(area.x + l.x * area.width, area.y + l.y * area.height,
                       area.x + l.z * area.width, area.y + l.w * area.height,
                       (pass ? 1.5f : 3.5f) * ui->scale,
                       pass ? imgui_rgba(ui->theme->accent) : IMGUI_RGBA(0, 0, 0, 128));
        }
    }
    imgui_lines_end();
}
