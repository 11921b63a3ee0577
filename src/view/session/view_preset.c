/* view_preset.c: loads and saves presets, files of settings. */
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
static void print_defaults(const struct view *v, const struct view_state *state, FILE *out)
{
    const struct settings scene_settings = view_scene_settings(v);
    const struct settings defaults = settings_default();
    for (const struct setting *row = settings_next(NULL); row; row = settings_next(row)) {
        const double value = settings_get(&state->settings, row);
        const double default_value = settings_get(&defaults, row);
        const double own = settings_get(&scene_settings, row);
        if (value < default_value || value > default_value ||
            !(own < default_value || own > default_value))
            continue;
        fprintf(out, "%s=", row->name);
        settings_print(&state->settings, row, out);
        fputc('\n', out);
    }
}

static char *print_preset(const struct view *v, const struct view_state *state, size_t *size)
{
    char *text = NULL;
    FILE *out = open_memstream(&text, size);
    if (!out)
        return NULL;
    fputs("# settings for firn --preset\n", out);
    settings_print_changes(&state->settings, "", out);
    print_defaults(v, state, out);
    if (fclose(out) == 0)
        return text;
    free(text);
    return NULL;
}

void view_save_preset(struct view *v)
{
    char words[TEXT_SIZE];
    size_t size = 0;
    const struct view_state state = view_state_now(v);
    char *folder = user_files_presets(true);
    char *path = folder ? user_files_new(folder, "preset", ".txt") : NULL;
    char *text = path ? print_preset(v, &state, &size) : NULL;
    if (text && file_io_write(path, text, size) == STATUS_OK) {
        snprintf(words, sizeof(words), "saved %s", path);
        ui_show_message(v->ui, words);
    } else {
        ui_show_failure(v->ui, "the preset was not saved: set HOME or XDG_DATA_HOME to a writable "
                               "folder");
    }
    free(text);
    free(path);
    free(folder);
}
