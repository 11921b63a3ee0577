/* view_compare_actions.c: user actions of the A/B comparison, which undo can revert. */
#include <stdio.h>
#include <string.h>
#include "src/base/path.h"
#include "src/file/image_receive.h"
#include "src/view/view_internal.h"
#include "src/view/window/worker_thread.h"

void view_compare_with(struct view *v, enum view_side_b other)
{
    struct view_state state = view_state_now(v);
    view_compare_choose(v, &state, other);
    view_edit(v, &state, 0);
}

void view_compare_toggle(struct view *v)
{
    view_compare_with(v,
                      v->compare.side_b == VIEW_SIDE_B_NONE ? VIEW_SIDE_B_STATE : VIEW_SIDE_B_NONE);
}

void view_compare_store(struct view *v)
{
    struct view_compare *c = &v->compare;
    c->stored = view_state_now(v);
    c->has_stored = true;
    if (c->side_b == VIEW_SIDE_B_STATE)
        view_compare_with(v, VIEW_SIDE_B_STATE);
    ui_show_message(v->ui, "stored as B: change something, then compare with W");
}

/* Selects an image for side B if none is selected. Returns false on failure. */
static bool has_side_b(struct view *v)
{
    if (v->compare.side_b == VIEW_SIDE_B_NONE)
        view_compare_toggle(v);
    return v->compare.side_b != VIEW_SIDE_B_NONE;
}

void view_compare_flip(struct view *v)
{
    if (!has_side_b(v))
        return;
    v->viewport->flipped = !v->viewport->flipped;
    v->compare.wants_error_map = false;
}

void view_compare_toggle_error_map(struct view *v)
{
    struct view_compare *c = &v->compare;
    if (!has_side_b(v))
        return;
    c->wants_error_map = !c->wants_error_map;
    v->viewport->flipped = false;
    ui_show_message(
        v->ui, c->wants_error_map ? "the FLIP error follows when both images are at rest" : "");
}

struct reading {
    struct view *view;
    const char *path;
    struct image image;
};

static enum status read_file(void *user)
{
    struct reading *reading = user;
    return image_reader_read(&reading->image, reading->path,
                             &reading->view->viewport->state.scene.reader);
}

void view_compare_await(struct view *v)
{
    v->compare.awaits_file = true;
    ui_show_message(v->ui, "drop the .png, .exr or .hdr file to compare with");
}

bool view_compare_accepts(const struct view *v, const char *path)
{
    return v->compare.awaits_file && image_reader_knows_suffix(path);
}

void view_compare_open(struct view *v, const char *path)
{
    struct view_compare *c = &v->compare;
    struct reading reading = { v, path, { 0 } };
    struct view_state state = view_state_now(v);
    const char *slash = strrchr(path, '/');
    char words[VIEW_SIDE_SIZE + 64];
    c->awaits_file = false;
    view_clear_errors(v);
    if (worker_run(&v->window, read_file, &reading) != STATUS_OK) {
        view_fail(v, "the file was not opened");
        return;
    }
    image_finish(&c->file.linear);
    c->file.linear = reading.image;
    c->file.is_tone_mapped = path_ends_in(path, ".png");
    c->file.is_current = c->has_error_image = false;
    snprintf(c->file_name, sizeof(c->file_name), "%s", slash ? slash + 1 : path);
    view_compare_choose(v, &state, VIEW_SIDE_B_FILE);
    if (!view_edit(v, &state, 0))
        return;
    snprintf(words, sizeof(words), "compared with %s: D shows the difference, W hides it",
             c->file_name);
    ui_show_message(v->ui, words);
}
