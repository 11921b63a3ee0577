/* imgui_widgets.cpp: C wrapper of Dear ImGui: panels and widgets. */
#include <cstring>
#include "src/view/panels/imgui.h"
#include "src/view/panels/imgui_state.hpp"

namespace
{

constexpr float thumbnail_width = 64.0f; /* pixels at scale 1 */

ImVec2 position(const imgui_rect &area)
{
    return { area.x, area.y };
}

ImVec2 corner(const imgui_rect &area)
{
    return { area.x + area.width, area.y + area.height };
}

} // namespace

/* ---- panels ---- */

void imgui_panel_begin(struct imgui *ui, const char *title, struct imgui_rect area,
                       enum imgui_panel kind)
{
    ImGuiWindowFlags flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                             ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing;
    if (kind != IMGUI_POPUP)
        flags |= ImGuiWindowFlags_NoBringToFrontOnFocus;
    ImGui::SetNextWindowPos(position(area));
    ImGui::SetNextWindowSize(ImVec2(area.width, area.height));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, kind == IMGUI_POPUP ? 1.0f : 0.0f);
    ImGui::Begin(title, nullptr, flags);
    ImGui::PopStyleVar();
    if (kind == IMGUI_POPUP)
        ImGui::BringWindowToDisplayFront(ImGui::GetCurrentWindow());
    if (ui->panel_count < panel_count_max)
        ui->panels[ui->panel_count++] = area;
}

void imgui_panel_end(void)
{
    ImGui::End();
}

void imgui_gap_begin(float pixels)
{
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(ImGui::GetStyle().ItemSpacing.x, pixels));
}

void imgui_gap_end(void)
{
    ImGui::PopStyleVar();
}

void imgui_scroll_begin(const char *name)
{
    ImGui::BeginChild(name);
}

void imgui_scroll_end(void)
{
    ImGui::EndChild();
}

void imgui_list_begin(const char *name, float height)
{
    ImGui::BeginChild(name, ImVec2(0.0f, height));
}

void imgui_list_end(void)
{
    ImGui::EndChild();
}

float imgui_list_row_height(void)
{
    return ImGui::GetFrameHeightWithSpacing();
}

/* Records the last widget for imgui_items(). Its name is the part of `label` before "##". If that
 * part has at most 2 characters, its name is the part after "##". */
static void note(const char *label)
{
    imgui *ui = static_cast<imgui *>(ImGui::GetIO().UserData);
    const ImVec2 from = ImGui::GetItemRectMin();
    const ImVec2 to = ImGui::GetItemRectMax();
    if (ui->item_count == IMGUI_ITEM_COUNT || !ImGui::IsItemVisible())
        return;
    imgui_item &item = ui->items[ui->item_count++];
    const char *end = strstr(label, "##");
    const bool is_named = end && end - label <= 2;
    const char *begin = is_named ? end + 2 : label;
    const size_t length = is_named || !end ? strlen(begin) : static_cast<size_t>(end - begin);
    item = {};
    memcpy(item.label, begin, length < sizeof(item.label) ? length : sizeof(item.label) - 1);
    item.rect = { from.x, from.y, to.x - from.x, to.y - from.y };
}

void imgui_focus_panel(const char *title)
{
    ImGui::SetWindowFocus(title);
    ImGuiWindow *window = title ? ImGui::FindWindowByName(title) : nullptr;
    if (!window)
        return;
    ImGui::NavInitWindow(window, true); /* select a widget from which the arrow keys can move */
    ImGui::GetCurrentContext()->NavDisableHighlight = false;
}

bool imgui_is_active(void)
{
    return ImGui::IsAnyItemActive() || ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopup);
}

bool imgui_is_item_active(void)
{
    return ImGui::IsItemActive();
}

bool imgui_is_item_clicked(void)
{
    return ImGui::IsItemClicked();
}

float imgui_scale(void)
{
    return static_cast<const imgui *>(ImGui::GetIO().UserData)->scale;
}

const struct theme *imgui_theme(void)
{
    return static_cast<const imgui *>(ImGui::GetIO().UserData)->colors;
}

float imgui_line_height(void)
{
    return ImGui::GetTextLineHeight();
}

float imgui_row_height(void)
{
    return ImGui::GetFrameHeight();
}

float imgui_available_width(void)
{
    return ImGui::GetContentRegionAvail().x;
}

/* ---- items ---- */

void imgui_indent(float x)
{
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + x);
}

void imgui_same_line(float x)
{
    ImGui::SameLine(x);
}

void imgui_next_width(float width)
{
    ImGui::SetNextItemWidth(width);
}

/* Gives the next text field the focus. In Dear ImGui 1.90, SetKeyboardFocusHere() fails if a
 * different panel has the focus. Therefore focus() sets the focus after the field is drawn. */
void imgui_next_focus(void)
{
#if IMGUI_VERSION_NUM >= 18900
    static_cast<imgui *>(ImGui::GetIO().UserData)->focuses = true;
#else
    ImGui::SetKeyboardFocusHere();
#endif
}

/* Gives the last drawn widget the keyboard focus if imgui_next_focus() was called. */
static void focus(void)
{
#if IMGUI_VERSION_NUM >= 18900
    imgui *ui = static_cast<imgui *>(ImGui::GetIO().UserData);
    ImGuiContext *context = ImGui::GetCurrentContext();
    if (!ui->focuses)
        return;
    ui->focuses = false;
    ImGui::FocusWindow(ImGui::GetCurrentWindow());
    context->NavNextActivateId = ImGui::GetItemID();
    context->NavNextActivateFlags = ImGuiActivateFlags_PreferInput;
#endif
}

void imgui_id_begin(const void *id)
{
    ImGui::PushID(id);
}

void imgui_id_end(void)
{
    ImGui::PopID();
}

void imgui_tooltip(const char *text)
{
    if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled))
        return;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(ImGui::GetFontSize() * 26.0f);
    ImGui::TextUnformatted(text);
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

float imgui_width(const char *text)
{
    return ImGui::CalcTextSize(text, nullptr, true).x + 2.0f * ImGui::GetStyle().FramePadding.x;
}

void imgui_disabled_begin(bool disabled)
{
    ImGui::BeginDisabled(disabled);
}

void imgui_disabled_end(void)
{
    ImGui::EndDisabled();
}

void imgui_text(const char *text)
{
    ImGui::TextUnformatted(text);
}

void imgui_text_dim(const char *text)
{
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
    ImGui::TextUnformatted(text);
    ImGui::PopStyleColor();
}

void imgui_text_at(float x, const char *text)
{
    const float gap = (ImGui::GetItemRectSize().y - ImGui::GetTextLineHeight()) / 2.0f;
    const ImVec2 from(x, ImGui::GetItemRectMin().y + gap);
    ImGui::GetWindowDrawList()->AddText(from, ImGui::GetColorU32(ImGuiCol_TextDisabled), text);
}

void imgui_text_beside(float x, float y, const char *text)
{
    ImGui::GetWindowDrawList()->AddText(ImVec2(x, y), ImGui::GetColorU32(ImGuiCol_TextDisabled),
                                        text);
}

void imgui_value(const char *text)
{
    ImGui::TextUnformatted(text);
    note(text);
}

void imgui_name(const char *text)
{
    note(text);
}

void imgui_text_in(const char *text, uint32_t rgb)
{
    ImGui::PushStyleColor(ImGuiCol_Text, imgui_state_color(rgb));
    ImGui::TextUnformatted(text);
    ImGui::PopStyleColor();
}

static float width_of(const char *text, const char *end)
{
    return ImGui::CalcTextSize(text, end).x;
}

static bool is_within_character(const char *at)
{
    return (*at & 0xc0) == 0x80;
}

/* Draws a text. If it is too wide, omits the middle, as names mostly differ near start and end. */
void imgui_text_elided(const char *text, float width)
{
    const char *end = text + strlen(text);
    const char *head = end;
    const char *tail = text;
    const float room = width - width_of("...", nullptr);
    if (width_of(text, end) <= width) {
        ImGui::TextUnformatted(text);
        return;
    }
    while (tail < end && (width_of(tail, end) > 0.5f * room || is_within_character(tail)))
        tail++;
    const float rest = room - width_of(tail, end);
    while (head > text && (width_of(text, head) > rest || is_within_character(head)))
        head--;
    ImGui::Text("%.*s...%s", static_cast<int>(head - text), text, tail);
}

void imgui_text_elided_in(const char *text, float width, uint32_t rgb)
{
    ImGui::PushStyleColor(ImGuiCol_Text, imgui_state_color(rgb));
    imgui_text_elided(text, width);
    ImGui::PopStyleColor();
}

void imgui_align(void)
{
    ImGui::AlignTextToFramePadding();
}

void imgui_warning(const char *text)
{
    ImGui::PushStyleColor(ImGuiCol_Text, imgui_state_color(imgui_theme()->error));
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextUnformatted(text);
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
}

void imgui_text_wrapped(const char *text)
{
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextUnformatted(text);
    ImGui::PopTextWrapPos();
    note(text);
}

bool imgui_button(const char *label)
{
    const bool pressed = ImGui::Button(label);
    note(label);
    return pressed;
}

bool imgui_small_button(const char *label)
{
    const bool pressed = ImGui::SmallButton(label);
    note(label);
    return pressed;
}

bool imgui_choice_button(const char *label, bool chosen)
{
    const theme *colors = imgui_theme();
    ImGui::PushStyleColor(ImGuiCol_Button,
                          imgui_state_color(chosen ? colors->pressed : colors->raised));
    const bool pressed = imgui_button(label);
    ImGui::PopStyleColor();
    return pressed;
}

/* Draws a thumbnail centred at the top of the last button. */
static void draw_thumbnail(const imgui *ui, uint32_t thumbnail, const ImVec2 &size)
{
    const ImFontAtlas *fonts = ImGui::GetIO().Fonts;
    const float padding = ImGui::GetStyle().FramePadding.y;
    const ImVec2 corner = ImGui::GetItemRectMin();
    const float left = corner.x + (ImGui::GetItemRectSize().x - size.x) / 2.0f;
    ImVec2 from;
    ImVec2 to;
    fonts->CalcCustomRectUV(&fonts->CustomRects[ui->rects[thumbnail]], &from, &to);
    ImGui::GetWindowDrawList()->AddImage(fonts->TexID, ImVec2(left, corner.y + padding),
                                         ImVec2(left + size.x, corner.y + padding + size.y), from,
                                         to);
}

bool imgui_thumbnail_button(const char *label, uint32_t thumbnail, float width, bool chosen)
{
    const imgui *ui = static_cast<const imgui *>(ImGui::GetIO().UserData);
    const theme *colors = imgui_theme();
    const ImVec2 padding = ImGui::GetStyle().FramePadding;
    const imgui_thumbnails &all = ui->thumbnails;
    const float across = ImMin(thumbnail_width * ui->scale, width - 2.0f * padding.x);
    const ImVec2 size(across,
                      across * static_cast<float>(all.height) / static_cast<float>(all.width));
    const ImVec2 whole(width, size.y + 3.0f * padding.y + ImGui::GetTextLineHeight());
    ImGui::PushID(label);
    ImGui::PushStyleColor(ImGuiCol_Button,
                          imgui_state_color(chosen ? colors->pressed : colors->raised));
    const bool pressed = ImGui::Button("##thumbnail", whole);
    ImGui::PopStyleColor();
    ImGui::PopID();
    note(label);
    if (thumbnail < all.count)
        draw_thumbnail(ui, thumbnail, size);
    const ImVec2 corner = ImGui::GetItemRectMin();
    const ImVec2 end = ImGui::GetItemRectMax();
    const ImVec2 from(corner.x + 1.0f, corner.y + size.y + 2.0f * padding.y);
    ImGui::RenderTextClipped(from, ImVec2(end.x - 1.0f, end.y), label, nullptr, nullptr,
                             ImVec2(0.5f, 0.0f));
    if (chosen) /* the outline shows the choice without relying on colour */
        ImGui::GetWindowDrawList()->AddRect(corner, end, imgui_rgba(colors->accent),
                                            ImGui::GetStyle().FrameRounding, 0, 2.0f * ui->scale);
    return pressed;
}

bool imgui_selectable(const char *label, bool chosen)
{
    const theme *colors = imgui_theme();
    ImGui::PushStyleColor(ImGuiCol_Header, imgui_state_color(colors->pressed));
    const bool pressed = ImGui::Selectable(label, chosen);
    note(label);
    ImGui::PopStyleColor();
    return pressed;
}

bool imgui_collapsing_header(const char *label, bool *open)
{
    ImGui::SetNextItemOpen(*open);
    *open = ImGui::CollapsingHeader(label, ImGuiTreeNodeFlags_AllowItemOverlap);
    note(label);
    return *open;
}

bool imgui_checkbox(const char *label, bool *value)
{
    const bool changed = ImGui::Checkbox(label, value);
    note(label);
    return changed;
}

bool imgui_combo(const char *label, const char *const *names, uint32_t count, uint32_t *index)
{
    bool changed = false;
    const bool open = ImGui::BeginCombo(label, *index < count ? names[*index] : "");
    note(label);
    for (uint32_t i = 0; i < count && open; i++) {
        if (imgui_selectable(names[i], i == *index)) {
            changed = i != *index;
            *index = i;
        }
    }
    if (open)
        ImGui::EndCombo();
    return changed;
}

/* Draws a ring around the last item while it has the keys. */
static void focus_ring()
{
    if (ImGui::IsItemActive())
        ImGui::GetWindowDrawList()->AddRect(ImGui::GetItemRectMin(), ImGui::GetItemRectMax(),
                                            ImGui::GetColorU32(ImGuiCol_NavHighlight),
                                            ImGui::GetStyle().FrameRounding, 0,
                                            2.0f * imgui_scale());
}

bool imgui_menu_begin(const char *label)
{
    if (imgui_button(label))
        ImGui::OpenPopup("menu");
    return ImGui::BeginPopup("menu");
}

void imgui_menu_end(void)
{
    ImGui::EndPopup();
}

bool imgui_text_field(const char *label, const char *hint, char *text, size_t size)
{
    const bool changed = ImGui::InputTextWithHint(label, hint, text, size);
    note(label);
    focus_ring();
    focus();
    return changed;
}

static ImGuiSliderFlags slider_flags(const struct imgui_slider_range *slide)
{
    return ImGuiSliderFlags_AlwaysClamp |
           (slide->logarithmic ? ImGuiSliderFlags_Logarithmic : ImGuiSliderFlags_None);
}

/* Draws a slider as a bar below its number, so that no thumb covers the number. */
static bool slider(const char *label, ImGuiDataType type, void *value, const void *min,
                   const void *max, const struct imgui_slider_range *slide)
{
    const float scale = imgui_scale();
    ImRect grab;
    ImGui::PushStyleColor(ImGuiCol_SliderGrab, ImVec4());
    ImGui::PushStyleColor(ImGuiCol_SliderGrabActive, ImVec4());
    const bool changed =
        ImGui::SliderScalar(label, type, value, min, max, slide->format, slider_flags(slide));
    ImGui::PopStyleColor(2);
    const ImVec2 from = ImGui::GetItemRectMin();
    const ImVec2 to = ImGui::GetItemRectMax();
    /* an ID that no item has makes this compute the thumb's position without any interaction */
    ImGui::SliderBehavior(ImRect(from, to), ImGui::GetID("##thumb"), type, value, min, max,
                          slide->format, slider_flags(slide), &grab);
    const float x = (grab.Min.x + grab.Max.x) / 2.0f;
    const ImU32 color = ImGui::GetColorU32(ImGuiCol_CheckMark);
    ImDrawList *list = ImGui::GetWindowDrawList();
    list->AddRectFilled(ImVec2(from.x + 2.0f * scale, to.y - 2.5f * scale),
                        ImVec2(x, to.y - 1.0f * scale), color);
    list->AddRectFilled(ImVec2(x - 2.0f * scale, to.y - 5.0f * scale),
                        ImVec2(x + 2.0f * scale, to.y), color, scale);
    return changed;
}

bool imgui_slider(const char *label, float *value, const struct imgui_slider_range *slide)
{
    const bool changed = slider(label, ImGuiDataType_Float, value, &slide->min, &slide->max, slide);
    note(label);
    return changed;
}

bool imgui_count_slider(const char *label, uint32_t *value, const struct imgui_slider_range *slide)
{
    const uint32_t min = static_cast<uint32_t>(slide->min);
    const uint32_t max = static_cast<uint32_t>(slide->max);
    const bool changed = slider(label, ImGuiDataType_U32, value, &min, &max, slide);
    note(label);
    return changed;
}

bool imgui_color(const char *label, float color[3])
{
    const bool changed = ImGui::ColorEdit3(label, color, ImGuiColorEditFlags_DisplayHex);
    note(label);
    return changed;
}

bool imgui_number_field(const char *label, uint32_t *value)
{
    const uint32_t step = 1;
    const bool changed = ImGui::InputScalar(label, ImGuiDataType_U32, value, &step, nullptr, "%u",
                                            ImGuiInputTextFlags_EnterReturnsTrue);
    note(label);
    focus_ring();
    return changed;
}

/* ---- drawing ---- */

void imgui_histogram(const char *label, const float *values, uint32_t count, uint32_t first,
                     float most, float height)
{
    ImGui::PlotHistogram(label, values, static_cast<int>(count), static_cast<int>(first), nullptr,
                         0.0f, most, ImVec2(ImGui::GetContentRegionAvail().x, height));
}

struct imgui_rect imgui_reserve(float width, float height)
{
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::Dummy(ImVec2(width, height));
    return { at.x, at.y, width, height };
}

struct imgui_rect imgui_cursor(void)
{
    const ImVec2 at = ImGui::GetCursorScreenPos();
    return { at.x, at.y, 0.0f, 0.0f };
}

uint32_t imgui_rgba(uint32_t rgb)
{
    return 0xff000000u | (rgb & 255) << 16 | (rgb & 0xff00) | (rgb >> 16 & 255);
}

void imgui_rectangle(struct imgui_rect area, uint32_t color)
{
    ImGui::GetWindowDrawList()->AddRectFilled(position(area), corner(area), color);
}

void imgui_lines_begin(struct imgui_rect area)
{
    ImGui::SetNextWindowPos(position(area));
    ImGui::SetNextWindowSize(ImVec2(area.width, area.height));
    ImGui::Begin("lines", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoBackground |
                     ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoNav |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing);
    ImGui::BringWindowToDisplayFront(ImGui::GetCurrentWindow());
}

void imgui_line(float x, float y, float to_x, float to_y, float width, uint32_t color)
{
    ImGui::GetWindowDrawList()->AddLine(ImVec2(x, y), ImVec2(to_x, to_y), color, width);
}

void imgui_lines_end(void)
{
    ImGui::End();
}

void imgui_cursor_tooltip(const char *text)
{
    ImGui::SetTooltip("%s", text);
}

bool imgui_is_hovered(struct imgui_rect area)
{
    return ImGui::IsWindowHovered() && ImGui::IsMouseHoveringRect(position(area), corner(area));
}
