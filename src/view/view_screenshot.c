/* view_screenshot.c: saves the image, and copies it to the clipboard. */
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>
#include "src/base/clock.h"
#include "src/view/view_internal.h"
#include "src/view/window/clipboard_copy_png.h"

enum {
    NAME_SIZE = 32,
    FOLDER_SIZE = 512,
};

static bool is_taken(uint32_t number)
{
    static const char *const endings[] = { ".png", ".exr", "-left.exr", "-right.exr" };
    char name[NAME_SIZE];
    bool taken = false;
    for (size_t i = 0; i < sizeof(endings) / sizeof(endings[0]); i++) {
        snprintf(name, sizeof(name), "firn-%04u%s", number, endings[i]);
        taken = taken || access(name, F_OK) == 0;
    }
    return taken;
}

/* Copies the image through a temporary file in a private folder. */
static void copy_image_to_clipboard(struct view *v)
{
    const char *runtime = getenv("XDG_RUNTIME_DIR");
    char folder[FOLDER_SIZE];
    char png[FOLDER_SIZE + NAME_SIZE];
    const char *const paths[] = { png };
    const bool quiet = v->viewport->quiet;
    const int length =
        snprintf(folder, sizeof(folder), "%s/firn-XXXXXX", runtime ? runtime : "/tmp");
    const bool made = length < FOLDER_SIZE && mkdtemp(folder);
    snprintf(png, sizeof(png), "%s/picture.png", folder);
    v->viewport->quiet = true;
    bool copied =
        made && viewport_save(v->viewport, v->drawn_time, paths, 1, &v->signals) == STATUS_OK;
    v->viewport->quiet = quiet;
    copied = copied && clipboard_copy_png(png);
    if (made) {
        unlink(png);
        rmdir(folder);
    }
    if (copied)
        ui_show_message(v->ui, "image copied to the clipboard");
    else
        ui_show_failure(v->ui,
                        "the image was not copied: install xclip or wl-clipboard, or save it (P)");
}

/* Renders and saves the image in the requested size. By default, this is the size in the window. */
static enum status save_screenshot(struct view *v, const char *const *paths, uint32_t path_count)
{
    struct setup_image *state = &v->viewport->state;
    const VkExtent2D before = { state->width, state->height };
    const VkExtent2D size = v->screenshot_size.width ? v->screenshot_size : before;
    v->screenshot_size = (VkExtent2D){ 0, 0 };
    state->width = size.width;
    state->height = size.height;
    const enum status status =
        viewport_save(v->viewport, v->drawn_time, paths, path_count, &v->signals);
    state->width = before.width;
    state->height = before.height;
    return status;
}

/* Saves or copies the image as requested. Never overwrites existing files. */
void view_take_screenshot(struct view *v)
{
    char png[NAME_SIZE];
    char exr[NAME_SIZE];
    char words[NAME_SIZE + 16];
    const char *const paths[] = { png, exr };
    const double start = clock_seconds();
    view_clear_errors(v);
    const bool copies = v->screenshot_to_clipboard;
    v->wants_screenshot = v->screenshot_to_clipboard = false;
    if (copies) {
        copy_image_to_clipboard(v);
        view_frame_stats_exclude(&v->frame_stats, start);
        return;
    }
    while (is_taken(++v->screenshot_number))
        continue;
    snprintf(png, sizeof(png), "firn-%04u.png", v->screenshot_number);
    snprintf(exr, sizeof(exr), "firn-%04u.exr", v->screenshot_number);
    const enum status status = save_screenshot(v, paths, 2);
    snprintf(words, sizeof(words), status == STATUS_OK ? "saved %s" : "%s was not saved", png);
    if (status == STATUS_OK)
        ui_show_message(v->ui, words);
    else
        view_fail(v, words);
    view_frame_stats_exclude(&v->frame_stats, start);
}

enum status view_write_outputs(struct view *v)
{
    const struct setup_outputs *outputs = v->options->outputs;
    return viewport_save(v->viewport, v->drawn_time, outputs->paths, outputs->count, &v->signals);
}
