/* imgui.cpp: the one file that knows Dear ImGui, and the one in C++. */
#include "src/view/ui/imgui.h"
#include <cstring>
#include <imgui.h>
#include <new>
#ifdef IMGUI_FREETYPE
#include <imgui_freetype.h>
#endif

namespace
{

constexpr float text_size = 15.0f;        /* pixels at scale 1 */
constexpr float bitmap_text_size = 13.0f; /* of the built-in font, which has one size */
constexpr int panel_count_max = 8;

/* Latin with all accents, Greek, Cyrillic, punctuation, arrows, mathematics. */
constexpr ImWchar characters[] = { 0x20,   0x24f,  0x370,  0x3ff,  0x400,  0x4ff, 0x2000,
                                   0x206f, 0x2190, 0x21ff, 0x2200, 0x22ff, 0 };

constexpr ImGuiKey keys[IMGUI_KEY_COUNT] = {
    ImGuiKey_Tab,       ImGuiKey_LeftArrow, ImGuiKey_RightArrow, ImGuiKey_UpArrow,
    ImGuiKey_DownArrow, ImGuiKey_PageUp,    ImGuiKey_PageDown,   ImGuiKey_Home,
    ImGuiKey_End,       ImGuiKey_Delete,    ImGuiKey_Backspace,  ImGuiKey_Space,
    ImGuiKey_Enter,     ImGuiKey_Escape,    ImGuiKey_A,          ImGuiKey_C,
    ImGuiKey_V,         ImGuiKey_X,         ImGuiKey_Z,
};

bool contains(const imgui_place &place, float x, float y)
{
    return x >= place.x && y >= place.y && x < place.x + place.width && y < place.y + place.height;
}

ImVec2 position(const imgui_place &place)
{
    return { place.x, place.y };
}

ImVec2 corner(const imgui_place &place)
{
    return { place.x + place.width, place.y + place.height };
}

} // namespace

struct imgui {
    ImGuiContext *context;
    imgui_place panels[panel_count_max]; /* of the frame */
    int panel_count;
    bool popup; /* a list is open */
    float scale;
    font system; /* path "": the built-in one */
};

/* ---- life ---- */

static void set_look(float scale)
{
    ImGuiStyle &style = ImGui::GetStyle();
    style = ImGuiStyle();
    ImGui::StyleColorsDark();
    style.WindowRounding = 4.0f;
    style.FrameRounding = 3.0f;
    style.GrabRounding = 3.0f;
    style.GrabMinSize = 8.0f;
    style.ItemSpacing = ImVec2(6.0f, 3.0f);
    style.FramePadding = ImVec2(5.0f, 2.0f);
    style.WindowBorderSize = 0.0f;
    style.Colors[ImGuiCol_TitleBg] = ImVec4(0.10f, 0.17f, 0.24f, 1.0f);
    style.Colors[ImGuiCol_TitleBgCollapsed] = ImVec4(0.10f, 0.17f, 0.24f, 0.8f);
    style.Colors[ImGuiCol_WindowBg] = ImVec4(0.05f, 0.07f, 0.09f, 0.85f);
    style.Colors[ImGuiCol_PopupBg] = ImVec4(0.05f, 0.07f, 0.09f, 0.97f);
    style.ScaleAllSizes(scale);
}

/* A window of the library's own takes it in the first frame, and the first panel inherits it. */
static void lose_first_focus()
{
    ImGui::GetIO().DisplaySize = ImVec2(1.0f, 1.0f);
    ImGui::NewFrame();
    ImGui::EndFrame();
    ImGui::SetWindowFocus(nullptr);
}

/* False: the file is no font that can be used. */
static bool add_font(const imgui *ui)
{
    ImGuiIO &io = ImGui::GetIO();
    ImFontConfig config;
    config.FontNo = ui->system.index;
    const float size = static_cast<float>(static_cast<int>(text_size * ui->scale));
#ifdef IMGUI_FREETYPE
    io.Fonts->FontBuilderIO = ImGuiFreeType::GetBuilderForFreeType();
    io.Fonts->FontBuilderFlags = ImGuiFreeTypeBuilderFlags_LightHinting;
#endif
    return *ui->system.path &&
           io.Fonts->AddFontFromFileTTF(ui->system.path, size, &config, characters) &&
           io.Fonts->Build();
}

static void add_bitmap_font(float scale)
{
    ImFontAtlas *fonts = ImGui::GetIO().Fonts;
    ImFontConfig config;
    fonts->Clear();
    config.SizePixels = static_cast<float>(static_cast<int>(bitmap_text_size * scale));
    fonts->AddFontDefault(&config);
    fonts->Build();
}

bool imgui_rescale(struct imgui *ui, float scale)
{
    ui->scale = scale;
    set_look(scale);
    ImGui::GetIO().Fonts->Clear();
    if (add_font(ui))
        return true;
    add_bitmap_font(scale);
    return false;
}

struct imgui *imgui_create(const struct font *font)
{
    struct imgui *ui = new (std::nothrow) imgui();
    if (!ui)
        return nullptr;
    IMGUI_CHECKVERSION();
    ui->context = ImGui::CreateContext();
    ImGuiIO &io = ImGui::GetIO();
    io.IniFilename = nullptr; /* leaves no files */
    io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
    io.ConfigWindowsMoveFromTitleBarOnly = true;
    io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
    for (int k = 0; k < IMGUI_KEY_COUNT; k++)
        io.KeyMap[keys[k]] = k;
    io.UserData = ui;
    ui->system = *font;
    add_bitmap_font(1.0f);
    lose_first_focus();
    return ui;
}

void imgui_destroy(struct imgui *ui)
{
    if (!ui)
        return;
    ImGui::DestroyContext(ui->context);
    delete ui;
}

const uint8_t *imgui_font(const struct imgui *, uint32_t *width, uint32_t *height)
{
    unsigned char *texels;
    int w;
    int h;
    ImGui::GetIO().Fonts->GetTexDataAsAlpha8(&texels, &w, &h);
    *width = static_cast<uint32_t>(w);
    *height = static_cast<uint32_t>(h);
    return texels;
}

/* ---- a frame ---- */

void imgui_begin(struct imgui *ui, const struct imgui_input *input)
{
    ImGuiIO &io = ImGui::GetIO();
    io.DisplaySize = ImVec2(input->width, input->height);
    io.DeltaTime = input->seconds > 0.0f ? input->seconds : 1e-4f;
    io.MousePos = ImVec2(input->x, input->y);
    for (int b = 0; b < IMGUI_BUTTON_COUNT; b++)
        io.MouseDown[b] = input->buttons[b];
    io.MouseWheel = input->wheel;
    for (int k = 0; k < IMGUI_KEY_COUNT; k++)
        io.KeysDown[k] = input->keys[k];
    io.KeyCtrl = input->control;
    io.KeyShift = input->shift;
    io.KeyAlt = input->alt;
    for (uint32_t i = 0; i < input->character_count; i++)
        io.AddInputCharacter(input->characters[i]);
    ImGui::NewFrame();
    ui->panel_count = 0;
}

void imgui_end(struct imgui *ui)
{
    ui->popup = ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopup);
    ImGui::Render();
}

/* The part of a command that the window shows. */
static overlay_part clip(const ImDrawCmd &command, const ImDrawData *data)
{
    const float left = command.ClipRect.x > 0.0f ? command.ClipRect.x : 0.0f;
    const float top = command.ClipRect.y > 0.0f ? command.ClipRect.y : 0.0f;
    const float right =
        command.ClipRect.z < data->DisplaySize.x ? command.ClipRect.z : data->DisplaySize.x;
    const float bottom =
        command.ClipRect.w < data->DisplaySize.y ? command.ClipRect.w : data->DisplaySize.y;
    overlay_part part = {};
    if (right <= left || bottom <= top)
        return part;
    part.left = static_cast<int32_t>(left);
    part.top = static_cast<int32_t>(top);
    part.width = static_cast<uint32_t>(right - left);
    part.height = static_cast<uint32_t>(bottom - top);
    return part;
}

/* A list's vertices lie from `base` on; its indices become those of all vertices. */
static bool take_commands(const ImDrawList *from, uint32_t base, uint32_t *index_count,
                          uint32_t *indices, overlay_list *list)
{
    const ImDrawData *data = ImGui::GetDrawData();
    for (const ImDrawCmd &command : from->CmdBuffer) {
        overlay_part part = clip(command, data);
        if (!part.width || !part.height || !command.ElemCount)
            continue;
        if (list->part_count == OVERLAY_PART_COUNT ||
            *index_count + command.ElemCount > OVERLAY_INDEX_COUNT)
            return false;
        part.first_index = *index_count;
        part.index_count = command.ElemCount;
        const ImDrawIdx *source = &from->IdxBuffer.Data[command.IdxOffset];
        for (uint32_t i = 0; i < command.ElemCount; i++)
            indices[(*index_count)++] = base + command.VtxOffset + source[i];
        list->parts[list->part_count++] = part;
    }
    return true;
}

bool imgui_take(const struct imgui *, struct overlay_vertex *vertices, uint32_t *indices,
                struct overlay_list *list)
{
    static_assert(sizeof(ImDrawVert) == sizeof(overlay_vertex), "copied as they are");
    static_assert(offsetof(ImDrawVert, uv) == offsetof(overlay_vertex, u), "the same");
    static_assert(offsetof(ImDrawVert, col) == offsetof(overlay_vertex, color), "the same");
    const ImDrawData *data = ImGui::GetDrawData();
    uint32_t vertex_count = 0;
    uint32_t index_count = 0;
    list->part_count = 0;
    for (int l = 0; data && l < data->CmdListsCount; l++) {
        const ImDrawList *from = data->CmdLists[l];
        const uint32_t count = static_cast<uint32_t>(from->VtxBuffer.Size);
        if (vertex_count + count > OVERLAY_VERTEX_COUNT)
            return false;
        memcpy(static_cast<void *>(&vertices[vertex_count]), from->VtxBuffer.Data,
               count * sizeof(overlay_vertex));
        if (!take_commands(from, vertex_count, &index_count, indices, list))
            return false;
        vertex_count += count;
    }
    return true;
}

/* ---- between frames ---- */

bool imgui_covers(const struct imgui *ui, float x, float y)
{
    for (int p = 0; p < ui->panel_count; p++) {
        if (contains(ui->panels[p], x, y))
            return true;
    }
    return ui->popup;
}

bool imgui_has_keys(const struct imgui *)
{
    return ImGui::GetIO().WantCaptureKeyboard;
}

bool imgui_has_text(const struct imgui *)
{
    return ImGui::GetIO().WantTextInput;
}

/* ---- panels ---- */

bool imgui_panel_begin(struct imgui *ui, const char *title, struct imgui_place place, bool *open)
{
    const float scale = imgui_scale();
    ImGui::SetNextWindowPos(ImVec2(place.x * scale, place.y * scale), ImGuiCond_FirstUseEver);
    ImGui::SetNextWindowSize(ImVec2(place.width * scale, place.height * scale),
                             ImGuiCond_FirstUseEver);
    const bool shown = ImGui::Begin(title, open, ImGuiWindowFlags_NoFocusOnAppearing);
    const ImVec2 at = ImGui::GetWindowPos();
    const ImVec2 size = ImGui::GetWindowSize();
    if (ui->panel_count < panel_count_max)
        ui->panels[ui->panel_count++] = { at.x, at.y, size.x, size.y };
    return shown;
}

void imgui_panel_end(void)
{
    ImGui::End();
}

void imgui_focus_panel(const char *title)
{
    ImGui::SetWindowFocus(title);
}

bool imgui_is_active(void)
{
    return ImGui::IsAnyItemActive() || ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopup);
}

float imgui_scale(void)
{
    return static_cast<const imgui *>(ImGui::GetIO().UserData)->scale;
}

float imgui_line(void)
{
    return ImGui::GetTextLineHeight();
}

float imgui_room(void)
{
    return ImGui::GetContentRegionAvail().x;
}

/* ---- what is in them ---- */

void imgui_same_line(float x)
{
    ImGui::SameLine(x);
}

void imgui_next_width(float width)
{
    ImGui::SetNextItemWidth(width);
}

void imgui_next_focus(void)
{
    ImGui::SetKeyboardFocusHere();
}

void imgui_id_begin(const void *id)
{
    ImGui::PushID(id);
}

void imgui_id_end(void)
{
    ImGui::PopID();
}

void imgui_tip(const char *text)
{
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("%s", text);
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

void imgui_warning(const char *text)
{
    ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(1.0f, 0.45f, 0.35f, 1.0f));
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextUnformatted(text);
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
}

void imgui_separator(void)
{
    ImGui::Separator();
}

bool imgui_button(const char *label)
{
    return ImGui::Button(label);
}

bool imgui_small_button(const char *label)
{
    return ImGui::SmallButton(label);
}

bool imgui_group(const char *label, bool open)
{
    if (open)
        ImGui::SetNextItemOpen(true);
    return ImGui::CollapsingHeader(label, ImGuiTreeNodeFlags_AllowItemOverlap);
}

bool imgui_checkbox(const char *label, bool *value)
{
    return ImGui::Checkbox(label, value);
}

bool imgui_list(const char *label, const char *const *names, uint32_t count, uint32_t *index)
{
    int chosen = static_cast<int>(*index);
    const bool changed = ImGui::Combo(label, &chosen, names, static_cast<int>(count));
    *index = static_cast<uint32_t>(chosen);
    return changed;
}

bool imgui_line_of_text(const char *label, const char *hint, char *text, size_t size)
{
    return ImGui::InputTextWithHint(label, hint, text, size);
}

static ImGuiSliderFlags slider_flags(const struct imgui_slide *slide)
{
    return ImGuiSliderFlags_AlwaysClamp |
           (slide->logarithmic ? ImGuiSliderFlags_Logarithmic : ImGuiSliderFlags_None);
}

bool imgui_slider(const char *label, float *value, const struct imgui_slide *slide)
{
    return ImGui::SliderFloat(label, value, slide->min, slide->max, slide->format,
                              slider_flags(slide));
}

bool imgui_count_slider(const char *label, uint32_t *value, const struct imgui_slide *slide)
{
    const uint32_t min = static_cast<uint32_t>(slide->min);
    const uint32_t max = static_cast<uint32_t>(slide->max);
    return ImGui::SliderScalar(label, ImGuiDataType_U32, value, &min, &max, slide->format,
                               slider_flags(slide));
}

bool imgui_number(const char *label, uint32_t *value)
{
    const uint32_t step = 1;
    return ImGui::InputScalar(label, ImGuiDataType_U32, value, &step, nullptr, "%u",
                              ImGuiInputTextFlags_EnterReturnsTrue);
}

/* ---- drawing ---- */

struct imgui_place imgui_canvas(float width, float height)
{
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::Dummy(ImVec2(width, height));
    return { at.x, at.y, width, height };
}

void imgui_rectangle(struct imgui_place place, uint32_t color)
{
    ImGui::GetWindowDrawList()->AddRectFilled(position(place), corner(place), color);
}

void imgui_hint(const char *text)
{
    ImGui::SetTooltip("%s", text);
}

bool imgui_is_over(struct imgui_place place)
{
    return ImGui::IsWindowHovered() && ImGui::IsMouseHoveringRect(position(place), corner(place));
}
