/* ui.c: user interface: lifecycle, input routing and frame updates of the panels. */
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/frame/pass_list.h"
#include "src/view/ui/ui_internal.h"

enum {
    SETTLE_COUNT = 3, /* frames to draw after an event until the layout has settled */
    HOLD_COUNT = 6,   /* frames until the requested focus takes effect; Dear ImGui 1.90 needs 4 */
};

static const double drag_seconds = 0.25; /* between frames of the panels during a drag */
static const float click_reach = 3.0f;   /* pixels; a longer movement is a drag */

/* ---- dump for scripts ---- */

void ui_count_action(struct ui *ui, enum view_action action)
{
    ui->done[action]++;
}

void ui_dump(struct ui *ui, const char *path)
{
    ui->dump = path;
}

/* Replaces the file by renaming, so that readers see the old list or the new one. */
static void replace_dump(const struct ui *ui, const struct imgui_item *items, uint32_t count)
{
    char path[SYSTEM_FONT_PATH_SIZE];
    const int length = snprintf(path, sizeof(path), "%s.new", ui->dump);
    FILE *file = length > 0 && length < SYSTEM_FONT_PATH_SIZE ? fopen(path, "w") : NULL;
    if (!file)
        return;
    for (uint32_t i = 0; i < count; i++)
        fprintf(file, "%.0f %.0f %.0f %.0f %s\n", (double)items[i].place.x,
                (double)items[i].place.y, (double)items[i].place.width,
                (double)items[i].place.height, items[i].label);
    for (enum view_action a = VIEW_ACTION_NONE + 1; a < VIEW_INPUT_COUNT; a++)
        fprintf(file, "0 0 0 0 done %u: %s\n", ui->done[a], key_bindings_label(a));
    if (fclose(file) == 0)
        (void)!rename(path, ui->dump);
}

/* 32-bit FNV-1a hash */
static uint32_t hash_more(uint32_t hash, const void *bytes, size_t size)
{
    for (size_t i = 0; i < size; i++)
        hash = (hash ^ ((const uint8_t *)bytes)[i]) * 16777619u;
    return hash;
}

static void write_dump(struct ui *ui)
{
    uint32_t count;
    const struct imgui_item *items = imgui_items(ui->imgui, &count);
    const uint32_t shown = hash_more(2166136261u, items, count * sizeof(*items));
    const uint32_t hash = hash_more(shown, ui->done, sizeof(ui->done));
    if (ui->dump && hash != ui->dumped)
        replace_dump(ui, items, count);
    ui->dumped = hash;
}

/* ---- lifecycle ---- */

static enum status make_font(struct ui *ui)
{
    struct gpu_image_params params = {
        .name = "overlay.font",
        .format = VK_FORMAT_R8G8B8A8_UNORM,
    };
    params.texels = imgui_font(ui->imgui, &params.width, &params.height);
    params.texels_size = 4 * (size_t)params.width * params.height;
    return gpu_image_create(ui->gpu, &ui->font, &params);
}

enum status ui_create(struct ui **ui, struct gpu *gpu, float scale, const struct theme *theme,
                      const struct ui_thumbnails *pictures, bool quiet)
{
    struct ui *u = calloc(1, sizeof(*u));
    struct system_font font;
    *ui = u;
    const bool found = system_font_find(&font, "sans");
    if (u) {
        u->gpu = gpu;
        u->theme = theme;
        u->pictures = pictures;
        u->open[UI_MATERIAL] = u->open[UI_INSIDE] = true;
    }
    if (u)
        u->imgui = imgui_create(&font);
    if (!u || !u->imgui)
        return log_out_of_memory(NULL);
    imgui_set_thumbnails(u->imgui, &pictures->list);
    const enum status status = ui_rescale(u, scale);
    if (!u->has_font && !quiet)
        log_warning("%s%s: using the built-in bitmap font",
                    found ? font.path : "no scalable font was found",
                    found ? ": the font cannot be read" : " by fontconfig");
    return status;
}

enum status ui_rescale(struct ui *ui, float scale)
{
    gpu_image_destroy(ui->gpu, &ui->font);
    ui->scale = scale;
    ui->settle = SETTLE_COUNT;
    ui->has_font = imgui_rescale(ui->imgui, scale, ui->theme);
    return make_font(ui);
}

void ui_set_theme(struct ui *ui, const struct theme *theme)
{
    ui->theme = theme;
    ui->settle = SETTLE_COUNT;
    imgui_set_theme(ui->imgui, theme);
}

float ui_scale(const struct ui *ui)
{
    return ui->scale;
}

void ui_destroy(struct ui *ui)
{
    if (!ui)
        return;
    if (ui->dump)
        write_dump(ui); /* includes actions counted while the panels were hidden */
    gpu_image_destroy(ui->gpu, &ui->font);
    imgui_destroy(ui->imgui);
    free(ui);
}

void ui_show(struct ui *ui, bool shown)
{
    ui->shown = shown;
    ui->settle = SETTLE_COUNT;
    ui->buttons = 0;
    ui->grabbed = false;
    ui->input.event_count = 0;
    memset(ui->input.now.buttons, 0, sizeof(ui->input.now.buttons));
    memset(ui->input.now.keys, 0, sizeof(ui->input.now.keys));
}

bool ui_is_shown(const struct ui *ui)
{
    return ui->shown;
}

bool ui_drags_picture(const struct ui *ui)
{
    return ui->shown && ui->buttons && !ui->grabbed;
}

bool ui_can_skip_frame(const struct ui *ui, double now)
{
    return ui_drags_picture(ui) && !ui_is_busy(ui) && now - ui->last < drag_seconds;
}

bool ui_is_busy(const struct ui *ui)
{
    return ui->shown && (ui->settle || ui->held || ui->input.event_count);
}

const struct gpu_image *ui_font(const struct ui *ui)
{
    return &ui->font;
}

void ui_show_message(struct ui *ui, const char *words)
{
    snprintf(ui->words, sizeof(ui->words), "%s", words);
    ui->failed = false;
    ui->settle = SETTLE_COUNT;
}

void ui_show_failure(struct ui *ui, const char *words)
{
    ui_show_message(ui, words);
    ui->failed = true;
}

void ui_wake(struct ui *ui)
{
    ui->settle = SETTLE_COUNT;
}

void ui_close_inspector(struct ui *ui)
{
    ui->tab = ui->tab == UI_INSPECT ? UI_SETTINGS : ui->tab;
    ui_wake(ui);
}

void ui_set_error(struct ui *ui, const char *words)
{
    if (strncmp(ui->fault, words, sizeof(ui->fault) - 1) == 0)
        return;
    snprintf(ui->fault, sizeof(ui->fault), "%s", words);
    ui->settle = SETTLE_COUNT;
}

bool ui_toggle(struct ui *ui, enum view_action action)
{
    const enum ui_tab tab = action == VIEW_TIMES     ? UI_TIMES
                            : action == VIEW_INSPECT ? UI_INSPECT
                                                     : UI_PLAN;
    if (action == VIEW_HELP) {
        ui->keys_open = !ui->keys_open || !ui->shown;
    } else if (action == VIEW_PALETTE) {
        ui->palette_open = ui->focus_palette = ui->searches = true;
        ui->palette_entered = false;
        ui->palette_at = 0;
        *ui->palette_words = '\0';
        ui->held = HOLD_COUNT;
    } else
        ui->tab = ui->tab == tab && ui->shown ? UI_SETTINGS : tab;
    ui->settle = SETTLE_COUNT;
    return action == VIEW_HELP ? ui->keys_open : ui->tab == tab;
}

/* ---- input ---- */

/* Handles a click on the image. With the inspector open, a click that is not a drag pins the pixel
 * under the cursor or unpins it. */
static void handle_click(struct ui *ui, bool down)
{
    const float moved = fabsf(ui->x - ui->press_x) + fabsf(ui->y - ui->press_y);
    if (down) {
        ui->press_x = ui->x;
        ui->press_y = ui->y;
    } else if (ui->tab == UI_INSPECT && moved <= click_reach)
        ui->pinned = !ui->pinned;
}

static bool handle_button(struct ui *ui, const struct window_event *event)
{
    const unsigned bit = 1u << (event->code & 31);
    if (event->down && !ui->buttons)
        ui->grabbed = imgui_wants_mouse(ui->imgui, ui->x, ui->y);
    ui->buttons = event->down ? ui->buttons | bit : ui->buttons & ~bit;
    if (event->code == GLFW_MOUSE_BUTTON_LEFT && !ui->grabbed)
        handle_click(ui, event->down);
    return ui->grabbed;
}

static bool has_keys(const struct ui *ui)
{
    return imgui_wants_keyboard(ui->imgui) && !ui->released;
}

/* Handles the palette's navigation keys. Returns true if the event was one. */
static bool handle_palette_key(struct ui *ui, const struct window_event *event)
{
    const int key = event->code;
    if (!ui->palette_open)
        return false;
    const bool enter = key == GLFW_KEY_ENTER || key == GLFW_KEY_KP_ENTER;
    if (!enter && key != GLFW_KEY_DOWN && key != GLFW_KEY_UP && key != GLFW_KEY_ESCAPE)
        return false;
    if (event->down && enter)
        ui->palette_entered = true;
    else if (event->down && key == GLFW_KEY_DOWN)
        ui->palette_at++;
    else if (event->down && key == GLFW_KEY_UP)
        ui->palette_at -= ui->palette_at ? 1 : 0;
    else if (event->down) {
        ui->palette_open = false;
        ui->release = true;
    }
    return true;
}

/* Returns true for Ctrl shortcuts that a text field uses itself; all others remain actions. */
static bool is_for_text(const struct window_event *event)
{
    return event->code == GLFW_KEY_A || event->code == GLFW_KEY_C || event->code == GLFW_KEY_V ||
           event->code == GLFW_KEY_X || event->code == GLFW_KEY_Y || event->code == GLFW_KEY_Z ||
           event->code == GLFW_KEY_LEFT || event->code == GLFW_KEY_RIGHT ||
           event->code == GLFW_KEY_BACKSPACE || event->code == GLFW_KEY_DELETE;
}

/* Handles a key. Returns true if the focused panel uses it; all other keys act on the image. */
static bool handle_key(struct ui *ui, const struct window_event *event)
{
    const bool function = event->code >= GLFW_KEY_F1 && event->code <= GLFW_KEY_F25;
    const bool kept =
        !function && (event->control ? imgui_wants_text(ui->imgui) && is_for_text(event)
                                     : ui->held || has_keys(ui));
    if (event->down && event->code == GLFW_KEY_F6) {
        ui_count_action(ui, VIEW_PANEL_KEYS);
        ui->focus_panel = true;
        ui->searches = false;
        ui->held = HOLD_COUNT;
        return true;
    }
    if (event->down && event->code == GLFW_KEY_ESCAPE && !imgui_is_active()) {
        imgui_focus_panel(NULL);
        ui->keys_open = false;
        ui->released = true;
        return true;
    }
    ui_input_queue_add(&ui->input, event);
    return kept;
}

static bool handle_character(struct ui *ui, const struct window_event *event)
{
    if (imgui_wants_text(ui->imgui) || ui->held) {
        ui_input_queue_add(&ui->input, event);
        return true;
    }
    if (event->code == '/') {
        ui_count_action(ui, VIEW_SEARCH);
        ui->focus_search = ui->searches = true;
        ui->held = HOLD_COUNT;
        return true;
    }
    return event->code == ' ' && has_keys(ui);
}

bool ui_handle_event(void *user, const struct window_event *event)
{
    struct ui *ui = user;
    if (event->kind == WINDOW_CURSOR) {
        ui->x = (float)event->x;
        ui->y = (float)event->y;
    }
    if (!ui->shown)
        return false;
    if (event->kind == WINDOW_CURSOR && ui_drags_picture(ui))
        return false; /* the end of the drag is still reported */
    ui->settle = SETTLE_COUNT;
    if (event->kind == WINDOW_KEY)
        return handle_palette_key(ui, event) || handle_key(ui, event);
    if (event->kind == WINDOW_CHARACTER)
        return handle_character(ui, event);
    if (ui_drags_picture(ui))
        ui_input_queue_add(&ui->input, &(struct window_event){ .kind = WINDOW_CURSOR,
                                                               .x = (double)ui->x,
                                                               .y = (double)ui->y });
    ui_input_queue_add(&ui->input, event);
    if (event->kind == WINDOW_BUTTON)
        return handle_button(ui, event);
    return event->kind == WINDOW_WHEEL ? imgui_wants_mouse(ui->imgui, ui->x, ui->y) : ui->grabbed;
}

/* ---- a frame ---- */

static void add_times(struct ui_pass_times *sums, const struct renderer *renderer)
{
    if (!renderer)
        return;
    const struct rg_times times = renderer_times(renderer);
    ui_pass_times_add(sums, renderer_frame(renderer), &times);
}

static void measure(struct ui *ui, const struct ui_view *view)
{
    ui_frame_pacing_add(&ui->pace, &view->pace);
    add_times(&ui->frame_times, viewport_renderer(view->picture, false));
    add_times(&ui->right_times, viewport_renderer(view->picture, true));
    if (view->screen->exec) {
        const struct rg_times times = rg_exec_times(view->screen->exec);
        ui_pass_times_add(&ui->window_times, view->screen->plan, &times);
    }
}

/* Advances the input queue. Keys typed ahead are held back until the requested panel or text field
 * has the focus. */
static void take_input(struct ui *ui)
{
    const bool there = ui->searches ? imgui_wants_text(ui->imgui) : imgui_wants_keyboard(ui->imgui);
    ui->released = false;
    if (ui->held && !there) {
        ui->held--;
        return;
    }
    const bool escaped = ui->input.now.keys[IMGUI_ESCAPE];
    ui->held = 0;
    ui_input_queue_step(&ui->input);
    if (escaped || !ui->input.now.keys[IMGUI_ESCAPE])
        return;
    if (!imgui_is_active())
        imgui_focus_panel(NULL); /* the Escape key was queued before */
    else if (ui->searches && imgui_wants_text(ui->imgui))
        ui->release = true; /* a single Escape leaves the search field */
}

void ui_frame(struct ui *ui, const struct ui_view *view, struct ui_request *wish)
{
    struct imgui_input *input = &ui->input.now;
    *wish = (struct ui_request){
        .settings = frame_settings(&view->picture->state.scene.settings, &view->picture->scene),
        .refraction = view->picture->state.refraction,
        .other = view->other,
        .split = view->picture->state.split,
        .look = view->inspector_wanted,
    };
    take_input(ui);
    if (ui->input.event_count)
        ui->settle = SETTLE_COUNT; /* restart after the last event */
    else
        ui->settle -= ui->settle ? 1 : 0;
    input->seconds = ui->last > 0.0 ? (float)(view->now - ui->last) : 0.0f;
    input->width = (float)view->size.width;
    input->height = (float)view->size.height;
    ui->last = view->now;
    measure(ui, view);
    ui->picture = view->layout->picture;
    ui->list.version += ui->list.version == UINT32_MAX ? 2 : 1;
    imgui_begin(ui->imgui, input);
    ui_panels(ui, view, wish);
    imgui_end(ui->imgui);
    wish->looks = ui->tab == UI_INSPECT;
    wish->gesture = imgui_gesture(ui->imgui);
    write_dump(ui);
}

/* Returns true if a draw command lies completely outside the image; panels are axis-aligned. */
static bool is_beside(const struct ui *ui, const struct overlay_draw_command *part,
                      const struct overlay_vertex *vertices, const uint32_t *indices)
{
    float left = INFINITY, top = INFINITY, right = -INFINITY, bottom = -INFINITY;
    for (uint32_t i = 0; i < part->index_count; i++) {
        const struct overlay_vertex *v = &vertices[indices[part->first_index + i]];
        left = fminf(left, v->x);
        top = fminf(top, v->y);
        right = fmaxf(right, v->x);
        bottom = fmaxf(bottom, v->y);
    }
    const VkRect2D *p = &ui->picture;
    left = fmaxf(left, (float)part->left);
    top = fmaxf(top, (float)part->top);
    right = fminf(right, (float)part->left + (float)part->width);
    bottom = fminf(bottom, (float)part->top + (float)part->height);
    return right <= (float)p->offset.x || bottom <= (float)p->offset.y ||
           left >= (float)p->offset.x + (float)p->extent.width ||
           top >= (float)p->offset.y + (float)p->extent.height;
}

const struct overlay_draw_list *ui_copy_draw_list(struct ui *ui, struct overlay_vertex *vertices,
                                                  uint32_t *indices)
{
    struct overlay_draw_list *list = &ui->list;
    list->docked_count = 0;
    if (!ui->shown)
        list->part_count = 0;
    const bool whole = !ui->shown || imgui_copy_draw_list(ui->imgui, vertices, indices, list);
    while (list->docked_count < list->part_count &&
           is_beside(ui, &list->parts[list->docked_count], vertices, indices))
        list->docked_count++;
    if (!whole && !ui->is_full)
        log_warning("the panels exceed the vertex limit: the rest is not drawn");
    ui->is_full = ui->is_full || !whole;
    return &ui->list;
}
