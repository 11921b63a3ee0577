/* view_look.c: layers and values of a picture at rest. */
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

/* On failure nothing is asked for any more: the picture itself goes on. */
static void give_up(struct view *v)
{
    v->look_wanted = (struct look_choice){ 0 };
    v->look.is_open = false;
    ui_close_look(v->ui);
    ui_fail(v->ui, "this picture's layers cannot be drawn: the terminal says why");
}

void view_look(struct view *v)
{
    struct look *look = &v->look;
    struct picture *p = v->picture;
    const bool wanted = look->is_open || look_replaces(&v->look_wanted);
    p->instead = VK_NULL_HANDLE;
    if (!wanted || !v->refine.shown)
        return;
    const bool drawn = look->layers.width && look->drawn == v->look_wanted.layer &&
                       view_refine_is_same(&v->look_seen, &v->refine.seen);
    const bool shown = drawn && look->sample_count == v->refine.shown &&
                       is_same_choice(&look->choice, &v->look_wanted);
    enum status status = shown ? STATUS_OK : screen_wait(&v->screen);
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
}
