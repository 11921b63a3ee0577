/* view_inspect.c: runs the pixel inspector, and centres the camera on a double-clicked surface. */
#include "src/view/view_internal.h"
#include "src/view/window/worker_thread.h"

static bool is_same_choice(const struct pixel_inspector_choice *a,
                           const struct pixel_inspector_choice *b)
{
    return a->layer == b->layer && a->channel == b->channel && a->false_color == b->false_color &&
           !(a->stops < b->stops || a->stops > b->stops);
}

static enum status draw(void *user)
{
    struct view *v = user;
    const struct renderer_shot shot = { .camera = v->inspector_identity.camera,
                                        .time = v->inspector_identity.time };
    return pixel_inspector_draw(&v->inspector, v->viewport, &shot);
}

/* Closes the inspector after a failure, so that the image itself is still shown. */
static void give_up(struct view *v)
{
    v->inspector_choice = (struct pixel_inspector_choice){ 0 };
    v->inspector.is_open = v->recenters = false;
    ui_close_inspector(v->ui);
    view_fail(v, "the layers cannot be drawn");
}

/* Points the camera at the surface that was double-clicked. */
static void aim(struct view *v)
{
    struct pixel_inspector_values at;
    const struct setup_image *p = &v->viewport->state;
    const double x = (v->recenter_x - v->image_area.x) * p->width / v->image_area.width;
    const double y = (v->recenter_y - v->image_area.y) * p->height / v->image_area.height;
    v->recenters = false;
    if (x < 0.0 || y < 0.0 ||
        !pixel_inspector_values(&v->inspector, v->viewport, (uint32_t)x, (uint32_t)y, &at))
        return;
    if (!at.object) {
        ui_show_message(v->ui, "no surface at this point");
        return;
    }
    v->viewport->camera.target = (vec3s){ { at.position[0], at.position[1], at.position[2] } };
    v->changed = true;
}

void view_inspect(struct view *v)
{
    struct pixel_inspector *inspector = &v->inspector;
    struct viewport *p = v->viewport;
    const bool is_needed =
        inspector->is_open || v->recenters || pixel_inspector_replaces_image(&v->inspector_choice);
    const bool opens = inspector->is_open && !v->had_inspector_panel;
    p->replacement = VK_NULL_HANDLE;
    v->had_inspector_panel = inspector->is_open;
    if (!is_needed || !v->progressive.shown_count)
        return;
    if (opens) { /* show the panel before rendering layers, which may take seconds */
        ui_wake(v->ui);
        return;
    }
    const bool drawn = inspector->layers.width &&
                       inspector->drawn_layer == v->inspector_choice.layer &&
                       view_progressive_is_same(&v->inspector_identity, &v->progressive.identity);
    const bool shown = drawn && inspector->sample_count == v->progressive.shown_count &&
                       is_same_choice(&inspector->choice, &v->inspector_choice);
    enum status status = shown ? STATUS_OK : presenter_wait(&v->presenter);
    view_clear_errors(v);
    inspector->choice = v->inspector_choice;
    v->inspector_identity = v->progressive.identity;
    if (status == STATUS_OK && !drawn)
        status = worker_run(&v->window, draw, v);
    if (status == STATUS_OK && !shown) {
        status = pixel_inspector_show(inspector, p, v->progressive.shown_count);
        ui_wake(v->ui);
    }
    if (status != STATUS_OK)
        give_up(v);
    else if (inspector->rgba)
        p->replacement = inspector->image.image;
    if (status == STATUS_OK && v->recenters)
        aim(v);
}
