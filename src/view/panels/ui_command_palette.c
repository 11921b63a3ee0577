/* ui_command_palette.c: command palette: search of actions, settings and files. */
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/render/frame/pass_list.h"
#include "src/scene/scene.h"
#include "src/setup/setup_material.h"
#include "src/tech/refract/refract.h"
#include "src/view/panels/ui_internal.h"
#include "src/view/panels/ui_settings.h"
#include "src/view/session/recent_files.h"
#include "src/view/session/xdg_folders.h"

enum {
    ENTRIES_MAX = 480,
    SHOWN_MAX = 12, /* visible rows */
    LABEL_SIZE = 96,
};

enum entry_kind {
    ENTRY_ACTION,
    ENTRY_MATERIAL,
    ENTRY_OPEN,
    ENTRY_SHOT,
    ENTRY_OTHER,
    ENTRY_SETTING,
};

/* Quality of a match, best first. */
enum rank {
    RANK_WORD,  /* words of the label begin with the typed ones */
    RANK_LABEL, /* the label contains the typed words */
    RANK_HELP,  /* a setting's texts contain them */
    RANK_NONE,
};

/* An entry of the palette. */
struct entry {
    enum entry_kind kind;
    uint32_t index;  /* index in its kind's table */
    VkExtent2D size; /* size of a saved image */
    const struct setting *row;
    char *open;      /* file, scene or environment to open, malloc'd; NULL for other kinds */
    const char *key; /* keyboard shortcut, or NULL */
    enum rank rank;
    char label[LABEL_SIZE];
};

struct palette {
    struct entry entries[ENTRIES_MAX];
    const struct entry *order[ENTRIES_MAX]; /* entries sorted by rank */
    uint32_t count;
    const char *query;
    float absorption_scale; /* factor on absorption coefficients of material presets */
};

static enum rank rank_of(const struct palette *p, const struct entry *e)
{
    const char *const label = e->label;
    if (ui_settings_contain(&label, 1, p->query, true))
        return RANK_WORD;
    if (ui_settings_contain(&label, 1, p->query, false))
        return RANK_LABEL;
    return e->row && ui_settings_match(e->row, p->query) ? RANK_HELP : RANK_NONE;
}

/* Adds an entry if it matches the query. Takes ownership of entry->open. */
__attribute__((format(printf, 3, 4))) static void add(struct palette *p, const struct entry *entry,
                                                      const char *format, ...)
{
    struct entry e = *entry;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(e.label, sizeof(e.label), format, arguments);
    va_end(arguments);
    e.rank = rank_of(p, &e);
    if (p->count < ENTRIES_MAX && e.rank != RANK_NONE)
        p->entries[p->count++] = e;
    else
        free(e.open);
}

/* Sorts the entries by rank. Entries of equal rank keep their order. */
static void sort(struct palette *p)
{
    uint32_t count = 0;
    for (enum rank rank = RANK_WORD; rank < RANK_NONE; rank++) {
        for (uint32_t i = 0; i < p->count; i++) {
            if (p->entries[i].rank == rank)
                p->order[count++] = &p->entries[i];
        }
    }
}

/* Adds a file, scene or environment. Takes ownership of `path`. */
static void add_file(struct palette *p, const char *what, char *path)
{
    const char *slash = strrchr(path, '/');
    add(p, &(struct entry){ ENTRY_OPEN, .open = path }, "%s %s", what, slash ? slash + 1 : path);
}

/* Adds the user's presets or sessions. */
static void add_folder(struct palette *p, const char *what, const char *extension)
{
    const char *const extensions[] = { extension, NULL };
    char *folder = user_files_data(what, false);
    char *path;
    for (uint32_t i = 0; folder && (path = user_files_at(folder, extensions, i)); i++)
        add_file(p, what, path);
    free(folder);
}

/* Adds scenes, environments and the user's files. */
static void collect_files(struct palette *p)
{
    char *path;
    for (uint32_t i = 0; scene_name(i) && (path = strdup(scene_name(i))); i++)
        add_file(p, "open", path);
    for (uint32_t i = 0; ui_environment(i) && (path = strdup(ui_environment(i))); i++)
        add_file(p, "environment", path);
    add_folder(p, "preset", ".txt");
    add_folder(p, "session", ".firn");
    for (uint32_t i = 0; (path = recent_files_at(i)); i++)
        add_file(p, "recent", path);
}

/* Adds entries that save the image in a common size or in a size that the user typed. */
static void collect_sizes(struct palette *p)
{
    static const VkExtent2D sizes[] = { { 1920, 1080 }, { 3840, 2160 }, { 2048, 2048 } };
    const char *digits = p->query + strcspn(p->query, "0123456789");
    VkExtent2D typed;
    char end;
    for (size_t i = 0; i < sizeof(sizes) / sizeof(sizes[0]); i++)
        add(p, &(struct entry){ ENTRY_SHOT, .size = sizes[i] }, "save the image, %ux%u",
            sizes[i].width, sizes[i].height);
    if (sscanf(digits, "%5ux%5u%c", &typed.width, &typed.height, &end) == 2 && typed.width &&
        typed.height)
        add(p, &(struct entry){ ENTRY_SHOT, .size = typed }, "save the image, %ux%u", typed.width,
            typed.height);
}

static void collect(struct palette *p)
{
    const struct setting *row;
    p->count = 0;
    for (enum view_action a = VIEW_ACTION_NONE + 1; a < VIEW_ACTION_COUNT; a++) {
        if (a != VIEW_PALETTE)
            add(p, &(struct entry){ ENTRY_ACTION, a, .key = key_bindings[a].keys }, "%s",
                key_bindings[a].label);
    }
    for (uint32_t i = 0; material_presets[i].name; i++)
        add(p, &(struct entry){ ENTRY_MATERIAL, i }, "material %s", material_presets[i].name);
    for (uint32_t i = 0; techniques_refraction(i); i++)
        add(p, &(struct entry){ ENTRY_OTHER, i }, "compare with %s",
            techniques_refraction(i)->refraction.name);
    collect_files(p);
    collect_sizes(p);
    for (enum ui_setting_group g = UI_OBJECT; g < UI_GROUP_COUNT; g++) {
        for (uint32_t i = 0; (row = ui_setting_groups_row(g, i)); i++)
            add(p, &(struct entry){ ENTRY_SETTING, 0, .row = row }, "%s (%s)", row->label,
                row->name);
    }
    sort(p);
}

static void choose(struct ui *ui, const struct palette *p, const struct entry *e,
                   struct ui_request *request)
{
    switch (e->kind) {
    case ENTRY_ACTION:
        request->action = (enum view_action)e->index;
        break;
    case ENTRY_MATERIAL:
        setup_set_material(&request->settings,
                           &(struct material_choice){ .preset = &material_presets[e->index] },
                           p->absorption_scale);
        request->changed = true;
        break;
    case ENTRY_OPEN:
        free(request->open);
        request->open = strdup(e->open);
        break;
    case ENTRY_SHOT:
        request->screenshot_size = e->size;
        break;
    case ENTRY_OTHER:
        request->side_b = VIEW_SIDE_B_MODEL;
        request->split = techniques_refraction(e->index);
        break;
    case ENTRY_SETTING:
        snprintf(ui->filter, sizeof(ui->filter), "%s", e->row->name);
        ui->tab = UI_SETTINGS;
        break;
    }
    ui->palette_open = false;
    ui->release = true;
}

static void rows(struct ui *ui, const struct palette *p, struct ui_request *request)
{
    const uint32_t first = ui->palette_row >= SHOWN_MAX ? ui->palette_row - SHOWN_MAX + 1 : 0;
    const float right = imgui_available_width();
    for (uint32_t i = first; i < p->count && i < first + SHOWN_MAX; i++) {
        const struct entry *e = p->order[i];
        imgui_id_begin(e);
        if (imgui_selectable(e->label, i == ui->palette_row))
            choose(ui, p, e, request);
        if (e->row)
            imgui_tooltip(e->row->help);
        if (e->key) {
            imgui_same_line(right - imgui_width(e->key));
            imgui_text_dim(e->key);
        }
        imgui_id_end();
    }
    if (!p->count)
        imgui_text_dim("no matches");
}

void ui_command_palette(struct ui *ui, const struct ui_view *view, struct ui_request *request)
{
    const float scale = ui->scale;
    const float row = imgui_row_height();
    const float window = (float)view->size.width;
    const float width = 440.0f * scale < window ? 440.0f * scale : window;
    const float height = row * 1.2f + (float)SHOWN_MAX * 21.0f * scale + 10.0f * scale;
    const struct imgui_rect area = { (window - width) / 2.0f, row, width,
                                     height < (float)view->size.height
                                         ? height
                                         : (float)view->size.height - row };
    struct palette *p = malloc(sizeof(*p));
    if (!p)
        return;
    p->query = ui->palette_query;
    p->absorption_scale =
        setup_absorption_scale(view->viewport->state.scene.name, &view->viewport->scene);
    imgui_panel_begin(ui->imgui, "palette", area, IMGUI_POPUP);
    if (ui->focus_palette)
        imgui_next_focus();
    imgui_next_width(imgui_available_width());
    if (imgui_text_field("##palette", "search actions, settings, materials, scenes",
                         ui->palette_query, sizeof(ui->palette_query)))
        ui->palette_row = 0;
    collect(p);
    ui->palette_row = p->count && ui->palette_row >= p->count ? p->count - 1 : ui->palette_row;
    /* Enter waits until the search has used all queued text */
    const bool entered = ui->palette_entered && !ui->focus_wait_frames && !ui->input.event_count;
    if (entered && ui->palette_row < p->count)
        choose(ui, p, p->order[ui->palette_row], request);
    else
        rows(ui, p, request);
    imgui_panel_end();
    ui->focus_palette = false;
    ui->palette_entered = ui->palette_entered && !entered;
    for (uint32_t i = 0; i < p->count; i++)
        free(p->entries[i].open);
    free(p);
}
