/* view_inspect.c: runs the pixel inspector, and centres the camera on a double-clicked surface. */
#include "src/view/view_internal.h"
#include "src/view/worker.h"

static bool is_same_choice(const struct pixel_inspector_choice *a,
                           const struct pixel_inspector_choice *b)
{
    return a->layer == b->layer && a->channel == b->channel && a->false_color == b->false_color &&
           !(a->stops < b->stops || a->stops > b->stops);
}

static enum status draw(void *user)
{
    struct view *v = user;
    const struct renderer_shot shot = { .camera = v->inspector_seen.camera,
                                        .time = v->inspector_seen.time };
    return pixel_inspector_draw(&v->look, v->picture, &shot);
}

/* Closes the inspector after a failure, so that the image itself is still shown. */
static void give_up(struct view *v)
{
    v->inspector_wanted = (struct pixel_inspector_choice){ 0 };
    v->look.is_open = v->aims = false;
    ui_close_inspector(v->ui);
    view_fail(v, "the layers cannot be drawn");
}

/* Points the camera at the surface that was double-clicked. */
static void aim(struct view *v)
{
    struct pixel_inspector_values at;
    const struct app_image *p = &v->picture->state;
    const double x = (v->aim_x - v->place.x) * p->width / v->place.width;
    const double y = (v->aim_y - v->place.y) * p->height / v->place.height;
    v->aims = false;
    if (x < 0.0 || y < 0.0 ||
        !pixel_inspector_values(&v->look, v->picture, (uint32_t)x, (uint32_t)y, &at))
        return;
    if (!at.object) {
        ui_show_message(v->ui, "no surface at this point");
        return;
    }
    v->picture->camera.target = (vec3s){ { at.position[0], at.position[1], at.position[2] } };
    v->changed = true;
}

void view_inspect(struct view *v)
{
    struct pixel_inspector *look = &v->look;
    struct viewport *p = v->picture;
    const bool wanted =
        look->is_open || v->aims || pixel_inspector_replaces_image(&v->inspector_wanted);
    const bool opens = look->is_open && !v->had_inspector_panel;
    p->instead = VK_NULL_HANDLE;
    v->had_inspector_panel = look->is_open;
    if (!wanted || !v->refine.shown)
        return;
    if (opens) { /* the panel appears first, because rendering its layers may take seconds */
        ui_wake(v->ui);
        return;
    }
    const bool drawn = look->layers.width && look->drawn == v->inspector_wanted.layer &&
                       view_progressive_is_same(&v->inspector_seen, &v->refine.seen);
    const bool shown = drawn && look->sample_count == v->refine.shown &&
                       is_same_choice(&look->choice, &v->inspector_wanted);
    enum status status = shown ? STATUS_OK : presenter_wait(&v->screen);
    view_clear_errors(v);
    look->choice = v->inspector_wanted;
    v->inspector_seen = v->refine.seen;
    if (status == STATUS_OK && !drawn)
        status = worker_run(&v->window, draw, v);
    if (status == STATUS_OK && !shown) {
        status = pixel_inspector_show(look, p, v->refine.shown);
        ui_wake(v->ui);
    }
    if (status != STATUS_OK)
        give_up(v);
    else if (look->rgba)
        p->instead = look->image.image;
    if (status == STATUS_OK && v->aims)
        aim(v);
}
