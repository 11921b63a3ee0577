/* ui.c: user interface: lifecycle, input routing and frame updates of the panels. */
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/render/frame/pass_list.h"
#include "src/view/panels/ui_internal.h"

enum {
    PENDING_FRAMES = 3, /* frames until the layout has settled */
    FOCUS_FRAMES = 6,   /* frames until the requested focus takes effect; Dear ImGui 1.90 needs 4 */
};

static const double drag_seconds = 0.25; /* seconds between panel updates during drags */
static const float click_reach = 3.0f;   /* pixels; longer mouse movements are drags */

/* ---- dump for scripts ---- */

void ui_dump(struct ui *ui, const char *path)
{
    ui->dump_path = path;
}

/* Writes a new dump file, then renames it, so that scripts never read an incomplete one. */
static void write_dump(const struct ui *ui)
{
    char path[SYSTEM_FONT_PATH_SIZE];
    uint32_t count;
    const struct imgui_item *items = imgui_items(ui->imgui, &count);
    const int length = snprintf(path, sizeof(path), "%s.new", ui->dump_path);
    FILE *file = length > 0 && length < SYSTEM_FONT_PATH_SIZE ? fopen(path, "w") : NULL;
    if (!file)
        return;
    for (uint32_t i = 0; i < count; i++)
        fprintf(file, "%.0f %.0f %.0f %.0f %s\n", (double)items[i].rect.x, (double)items[i].rect.y,
                (double)items[i].rect.width, (double)items[i].rect.height, items[i].label);
    if (fclose(file) == 0)
        (void)!rename(path, ui->dump_path);
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
                      const struct ui_thumbnails *thumbnails, bool quiet)
{
    struct ui *u = calloc(1, sizeof(*u));
    struct system_font font;
    *ui = u;
    const bool found = system_font_find(&font, "sans");
    if (u) {
        u->gpu = gpu;
        u->theme = theme;
        u->thumbnails = thumbnails;
        u->open[UI_MATERIAL] = u->open[UI_INSIDE] = true;
    }
    if (u)
        u->imgui = imgui_create(&font);
    if (!u || !u->imgui)
        return log_out_of_memory(NULL);
    imgui_set_thumbnails(u->imgui, &thumbnails->list);
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
    ui->pending_frames = PENDING_FRAMES;
    ui->has_font = imgui_rescale(ui->imgui, scale, ui->theme);
    return make_font(ui);
}

void ui_set_theme(struct ui *ui, const struct theme *theme)
{
    ui->theme = theme;
    ui->pending_frames = PENDING_FRAMES;
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
    gpu_image_destroy(ui->gpu, &ui->font);
    imgui_destroy(ui->imgui);
    free(ui);
}

void ui_show(struct ui *ui, bool shown)
{
    ui->shown = shown;
    ui->pending_frames = PENDING_FRAMES;
    ui->buttons = 0;
    ui->pressed_panel = false;
    ui->input.event_count = 0;
    memset(ui->input.now.buttons, 0, sizeof(ui->input.now.buttons));
    memset(ui->input.now.keys, 0, sizeof(ui->input.now.keys));
}

bool ui_is_shown(const struct ui *ui)
{
    return ui->shown;
}

bool ui_drags_image(const struct ui *ui)
{
    return ui->shown && ui->buttons && !ui->pressed_panel;
}

bool ui_can_skip_frame(const struct ui *ui, double now)
{
    return ui_drags_image(ui) && !ui_is_busy(ui) && !ui->has_outline &&
           now - ui->last_frame_at < drag_seconds;
}

bool ui_is_busy(const struct ui *ui)
{
    return ui->shown && (ui->pending_frames || ui->focus_wait_frames || ui->input.event_count);
}

const struct gpu_image *ui_font(const struct ui *ui)
{
    return &ui->font;
}

void ui_show_message(struct ui *ui, const char *message)
{
    snprintf(ui->message, sizeof(ui->message), "%s", message);
    ui->is_failure = false;
    ui->pending_frames = PENDING_FRAMES;
}

void ui_show_failure(struct ui *ui, const char *message)
{
    ui_show_message(ui, message);
    ui->is_failure = true;
}

void ui_wake(struct ui *ui)
{
    ui->pending_frames = PENDING_FRAMES;
}

void ui_close_inspector(struct ui *ui)
{
    ui->tab = ui->tab == UI_INSPECT ? UI_SETTINGS : ui->tab;
    ui_wake(ui);
}

void ui_set_error(struct ui *ui, const char *message)
{
    if (strncmp(ui->error, message, sizeof(ui->error) - 1) == 0)
        return;
    snprintf(ui->error, sizeof(ui->error), "%s", message);
    ui->pending_frames = PENDING_FRAMES;
}

bool ui_toggle(struct ui *ui, enum view_action action)
{
    const enum ui_tab tab = action == VIEW_TIMES ? UI_TIMES : UI_INSPECT;
    if (action == VIEW_HELP) {
        ui->keys_open = !ui->keys_open || !ui->shown;
    } else if (action == VIEW_PALETTE) {
        ui->palette_open = ui->focus_palette = ui->focused_search = true;
        ui->palette_entered = false;
        ui->palette_row = 0;
        *ui->palette_query = '\0';
        ui->focus_wait_frames = FOCUS_FRAMES;
    } else
        ui->tab = ui->tab == tab && ui->shown ? UI_SETTINGS : tab;
    ui->pending_frames = PENDING_FRAMES;
    return action == VIEW_HELP ? ui->keys_open : ui->tab == tab;
}

/* ---- input ---- */

/* Handles a click on the image. If the inspector is open, a click pins the pixel under the cursor
 * or unpins the pinned pixel; else it selects the object there. A drag does neither. */
static void handle_click(struct ui *ui, bool down)
{
    if (down) {
        ui->press_x = ui->x;
        ui->press_y = ui->y;
        ui->press_reach = 0.0f;
    } else if (ui->tab == UI_INSPECT && ui->press_reach <= click_reach)
        ui->pinned = !ui->pinned;
    else
        ui->has_clicked = ui->press_reach <= click_reach;
}

static bool handle_button(struct ui *ui, const struct window_event *event)
{
    const unsigned bit = 1u << (event->code & 31);
    if (event->down)
        ui->has_panel_keys = false;
    if (event->down && !ui->buttons)
        ui->pressed_panel = imgui_wants_mouse(ui->imgui, ui->x, ui->y);
    ui->buttons = event->down ? ui->buttons | bit : ui->buttons & ~bit;
    if (event->code == GLFW_MOUSE_BUTTON_LEFT && !ui->pressed_panel)
        handle_click(ui, event->down);
    return ui->pressed_panel;
}

/* Returns true if keys are for the panels: in text fields, open lists, and after F6. */
static bool has_keys(const struct ui *ui)
{
    return !ui->releases_keys && (imgui_wants_text(ui->imgui) || imgui_has_popup(ui->imgui) ||
                                  (ui->has_panel_keys && imgui_wants_keyboard(ui->imgui)));
}

/* Handles a navigation key of the open command palette. Returns false for other keys. */
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
        ui->palette_row++;
    else if (event->down && key == GLFW_KEY_UP)
        ui->palette_row -= ui->palette_row ? 1 : 0;
    else if (event->down) {
        ui->palette_open = false;
        ui->release = true;
    }
    return true;
}

/* Returns true for the Ctrl shortcuts of text fields. Other Ctrl shortcuts are viewer actions. */
static bool is_for_text(const struct window_event *event)
{
    return event->code == GLFW_KEY_A || event->code == GLFW_KEY_C || event->code == GLFW_KEY_V ||
           event->code == GLFW_KEY_X || event->code == GLFW_KEY_Y || event->code == GLFW_KEY_Z ||
           event->code == GLFW_KEY_LEFT || event->code == GLFW_KEY_RIGHT ||
           event->code == GLFW_KEY_BACKSPACE || event->code == GLFW_KEY_DELETE;
}

/* Handles a key. Returns true if the focused panel uses the key, false if the viewer should. */
static bool handle_key(struct ui *ui, const struct window_event *event)
{
    const bool function = event->code >= GLFW_KEY_F1 && event->code <= GLFW_KEY_F25;
    const bool keeps =
        !function && (event->control ? imgui_wants_text(ui->imgui) && is_for_text(event)
                                     : ui->focus_wait_frames || has_keys(ui));
    if (event->down && event->code == GLFW_KEY_F6) {
        ui->focus_panel = ui->has_panel_keys = true;
        ui->focused_search = false;
        ui->focus_wait_frames = FOCUS_FRAMES;
        return true;
    }
    if (event->down && event->code == GLFW_KEY_ESCAPE && !imgui_is_active()) {
        const bool closes = ui->keys_open || has_keys(ui);
        imgui_focus_panel(NULL);
        ui->keys_open = ui->has_panel_keys = false;
        ui->releases_keys = true;
        return closes;
    }
    /* a key of the viewer must not also activate the widget that was used last */
    if (keeps || !event->down || event->control || event->code >= GLFW_KEY_LEFT_SHIFT)
        ui_input_queue_add(&ui->input, event);
    return keeps;
}

static bool handle_character(struct ui *ui, const struct window_event *event)
{
    if (imgui_wants_text(ui->imgui) || ui->focus_wait_frames) {
        ui_input_queue_add(&ui->input, event);
        return true;
    }
    if (event->code == '/') {
        ui->focus_search = ui->focused_search = true;
        ui->focus_wait_frames = FOCUS_FRAMES;
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
        ui->press_reach =
            fmaxf(ui->press_reach, fabsf(ui->x - ui->press_x) + fabsf(ui->y - ui->press_y));
    }
    if (!ui->shown)
        return false;
    if (event->kind == WINDOW_CURSOR && ui_drags_image(ui))
        return false; /* the viewer handles image drags */
    ui->pending_frames = PENDING_FRAMES;
    if (event->kind == WINDOW_KEY)
        return handle_palette_key(ui, event) || handle_key(ui, event);
    if (event->kind == WINDOW_CHARACTER)
        return handle_character(ui, event);
    if (ui_drags_image(ui))
        ui_input_queue_add(&ui->input, &(struct window_event){ .kind = WINDOW_CURSOR,
                                                               .x = (double)ui->x,
                                                               .y = (double)ui->y });
    ui_input_queue_add(&ui->input, event);
    if (event->kind == WINDOW_BUTTON)
        return handle_button(ui, event);
    return event->kind == WINDOW_WHEEL ? imgui_wants_mouse(ui->imgui, ui->x, ui->y)
                                       : ui->pressed_panel;
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
    add_times(&ui->frame_times, viewport_renderer(view->viewport, false));
    add_times(&ui->right_times, viewport_renderer(view->viewport, true));
    if (view->presenter->exec) {
        const struct rg_times times = rg_exec_times(view->presenter->exec);
        ui_pass_times_add(&ui->window_times, view->presenter->plan, &times);
    }
}

/* Advances the input queue. Keys wait until the requested panel or text field has the focus. */
static void take_input(struct ui *ui)
{
    const bool has_focus =
        ui->focused_search ? imgui_wants_text(ui->imgui) : imgui_wants_keyboard(ui->imgui);
    ui->releases_keys = false;
    if (ui->focus_wait_frames && !has_focus) {
        ui->focus_wait_frames--;
        return;
    }
    const bool escaped = ui->input.now.keys[IMGUI_ESCAPE];
    ui->focus_wait_frames = 0;
    ui_input_queue_step(&ui->input);
    if (escaped || !ui->input.now.keys[IMGUI_ESCAPE])
        return;
    if (!imgui_is_active())
        imgui_focus_panel(NULL); /* the Escape key was queued before */
    else if (ui->focused_search && imgui_wants_text(ui->imgui))
        ui->release = true; /* one Escape leaves the search field */
}

/* Turns a click on the image into a request to select what is there. */
static void take_click(struct ui *ui, const struct ui_view *view, struct ui_request *request)
{
    const struct present_area *p = view->image_area;
    request->pick_x = p->width ? (ui->press_x - (float)p->x) / (float)p->width : -1.0f;
    request->pick_y = p->height ? (ui->press_y - (float)p->y) / (float)p->height : -1.0f;
    const bool is_inside = request->pick_x >= 0.0f && request->pick_x < 1.0f &&
                           request->pick_y >= 0.0f && request->pick_y < 1.0f;
    request->focuses = ui->has_clicked && is_inside && ui->focuses;
    request->picks = ui->has_clicked && is_inside && !ui->focuses;
    ui->focuses = ui->focuses && !request->focuses;
    ui->has_clicked = false;
}

void ui_frame(struct ui *ui, const struct ui_view *view, struct ui_request *request)
{
    struct imgui_input *input = &ui->input.now;
    *request = (struct ui_request){
        .settings = frame_settings(&view->viewport->state.scene.settings, &view->viewport->scene),
        .refraction = view->viewport->state.refraction,
        .side_b = view->side_b,
        .split = view->viewport->state.split,
        .inspector_choice = view->inspector_choice,
        .env_rotate = view->viewport->state.scene.env_rotate,
        .env_exposure = view->viewport->state.scene.env_exposure,
        .ground = view->viewport->state.scene.ground.ground,
    };
    take_input(ui);
    if (ui->input.event_count)
        ui->pending_frames = PENDING_FRAMES; /* restart after the last event */
    else
        ui->pending_frames -= ui->pending_frames ? 1 : 0;
    input->seconds = ui->last_frame_at > 0.0 ? (float)(view->now - ui->last_frame_at) : 0.0f;
    input->width = (float)view->size.width;
    input->height = (float)view->size.height;
    ui->last_frame_at = view->now;
    measure(ui, view);
    ui->image_area = view->layout->image;
    ui->list.version += ui->list.version == UINT32_MAX ? 2 : 1;
    take_click(ui, view, request);
    imgui_begin(ui->imgui, input);
    ui_panels(ui, view, request);
    imgui_end(ui->imgui);
    request->inspects = ui->tab == UI_INSPECT;
    request->gesture = imgui_gesture(ui->imgui);
    if (ui->dump_path)
        write_dump(ui);
}

/* Returns true if a draw command's bounding box lies outside the image area. */
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
    const VkRect2D *p = &ui->image_area;
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
        list->command_count = 0;
    const bool whole = !ui->shown || imgui_copy_draw_list(ui->imgui, vertices, indices, list);
    while (list->docked_count < list->command_count &&
           is_beside(ui, &list->commands[list->docked_count], vertices, indices))
        list->docked_count++;
    if (!whole && !ui->is_full)
        log_warning("the panels have too many vertices: some of them are not drawn");
    ui->is_full = ui->is_full || !whole;
    return &ui->list;
}
