/* view_look.c: runs the pixel inspector, and centres the camera on a double-clicked surface. */
#include "src/view/view_internal.h"
#include "src/view/worker.h"

static bool is_same_choice(const struct look_choice *a, const struct look_choice *b)
{
    return a->layer == b->layer && a->channel == b->channel && a->false_color == b->false_color &&
           !(a->stops < b->stops || a->stops > b->stops);
}

static enum status draw(void *user)
{
    struct view *v = user;
    const struct renderer_shot shot = { .camera = v->look_seen.camera, .time = v->look_seen.time };
    return look_draw(&v->look, v->picture, &shot);
}

/* Closes the inspector after a failure, so that the image itself is still shown. */
static void give_up(struct view *v)
{
    v->look_wanted = (struct look_choice){ 0 };
    v->look.is_open = v->aims = false;
    ui_close_look(v->ui);
    view_fail(v, "the layers cannot be drawn");
}

/* Points the camera at the surface that was double-clicked. */
static void aim(struct view *v)
{
    struct look_values at;
    const struct app_picture *p = &v->picture->state;
    const double x = (v->aim_x - v->place.x) * p->width / v->place.width;
    const double y = (v->aim_y - v->place.y) * p->height / v->place.height;
    v->aims = false;
    if (x < 0.0 || y < 0.0 || !look_values(&v->look, v->picture, (uint32_t)x, (uint32_t)y, &at))
        return;
    if (!at.object) {
        ui_say(v->ui, "no surface at this point");
        return;
    }
    v->picture->camera.target = (vec3s){ { at.position[0], at.position[1], at.position[2] } };
    v->changed = true;
}

void view_look(struct view *v)
{
    struct look *look = &v->look;
    struct picture *p = v->picture;
    const bool wanted = look->is_open || v->aims || look_replaces(&v->look_wanted);
    const bool opens = look->is_open && !v->has_look_panel;
    p->instead = VK_NULL_HANDLE;
    v->has_look_panel = look->is_open;
    if (!wanted || !v->refine.shown)
        return;
    if (opens) { /* the panel appears first, because rendering its layers may take seconds */
        ui_wake(v->ui);
        return;
    }
    const bool drawn = look->layers.width && look->drawn == v->look_wanted.layer &&
                       view_refine_is_same(&v->look_seen, &v->refine.seen);
    const bool shown = drawn && look->sample_count == v->refine.shown &&
                       is_same_choice(&look->choice, &v->look_wanted);
    enum status status = shown ? STATUS_OK : screen_wait(&v->screen);
    view_attempt(v);
    look->choice = v->look_wanted;
    v->look_seen = v->refine.seen;
    if (status == STATUS_OK && !drawn)
        status = worker_run(&v->window, draw, v);
    if (status == STATUS_OK && !shown) {
        status = look_show(look, p, v->refine.shown);
        ui_wake(v->ui);
    }
    if (status != STATUS_OK)
        give_up(v);
    else if (look->rgba)
        p->instead = look->image.image;
    if (status == STATUS_OK && v->aims)
        aim(v);
}
