/* view_preset.c: loads and saves presets, and writes new files in the user's folders. */
#include <stdio.h>
#include <stdlib.h>
#include "src/file/atomic_file.h"
#include "src/setup/apply_preset.h"
#include "src/view/session/xdg_folders.h"
#include "src/view/view_internal.h"

enum {
    TEXT_SIZE = 200,
};

void view_load_preset(struct view *v, const char *path)
{
    char words[TEXT_SIZE];
    struct setup_scene scene = v->viewport->state.scene;
    struct view_state state = view_state_now(v);
    scene.settings = settings_default();
    scene.preset = path;
    view_clear_errors(v);
    if (setup_apply_preset(&scene) != STATUS_OK) {
        view_fail(v, "the preset was not loaded");
        return;
    }
    for (const struct setting *row = settings_next(NULL); row; row = settings_next(row)) {
        const double value = settings_get(&scene.settings, row);
        if (settings_source(&scene.settings, row) == SETTING_PRESET) {
            settings_put(&state.settings, row, value, SETTING_USER);
            settings_put(&state.user_settings, row, value, SETTING_USER);
        }
    }
    if (!view_edit(v, &state, 0))
        return;
    snprintf(words, sizeof(words), "settings loaded from %s", path);
    ui_show_message(v->ui, words);
}

/* Prints the settings that have the default value although the scene has a different value. */
static void print_defaults(const struct view *v, const struct settings *settings, FILE *out)
{
    const struct settings scene_settings = view_scene_settings(v);
    const struct settings defaults = settings_default();
    for (const struct setting *row = settings_next(NULL); row; row = settings_next(row)) {
        const double value = settings_get(settings, row);
        const double default_value = settings_get(&defaults, row);
        const double own = settings_get(&scene_settings, row);
        if (value < default_value || value > default_value ||
            !(own < default_value || own > default_value))
            continue;
        fprintf(out, "%s=", row->name);
        settings_print(settings, row, out);
        fputc('\n', out);
    }
}

static void print_preset(const struct view *v, FILE *out)
{
    const struct settings settings = view_state_now(v).settings;
    fputs("# settings for firn --preset\n", out);
    settings_print_changes(&settings, "", out);
    print_defaults(v, &settings, out);
}

void view_save_preset(struct view *v)
{
    view_save_text(v, "preset", ".txt", print_preset, NULL);
}

/* Returns what `print` prints; the caller frees it. Returns NULL if out of memory. */
static char *print_text(const struct view *v, view_print_fn *print, size_t *size)
{
    char *text = NULL;
    FILE *out = open_memstream(&text, size);
    if (!out)
        return NULL;
    print(v, out);
    if (fclose(out) == 0)
        return text;
    free(text);
    return NULL;
}

void view_save_text(struct view *v, const char *what, const char *extension, view_print_fn *print,
                    const char *omitted)
{
    char words[600];
    size_t size = 0;
    char *folder = user_files_data(what, true);
    char *path = folder ? user_files_new(folder, what, extension) : NULL;
    char *text = path ? print_text(v, print, &size) : NULL;
    const bool saved = text && file_io_write(path, text, size) == STATUS_OK;
    if (saved)
        snprintf(words, sizeof(words), "saved %s%s%s", path, omitted ? " without " : "",
                 omitted ? omitted : "");
    else
        snprintf(words, sizeof(words),
                 "the %s was not saved: set HOME or XDG_DATA_HOME to a writable folder", what);
    if (saved)
        ui_show_message(v->ui, words);
    else
        ui_show_failure(v->ui, words);
    free(text);
    free(path);
    free(folder);
}
