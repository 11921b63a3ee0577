/* imgui.cpp: C wrapper of Dear ImGui: context, style, fonts and frames. */
#include "src/view/panels/imgui.h"
#include <cmath>
#include <cstring>
#include <new>
#ifdef IMGUI_FREETYPE
#include <imgui_freetype.h>
#endif
#include "src/view/panels/imgui_state.hpp"

namespace
{

constexpr float text_size = 15.0f;        /* font size, pixels at scale 1 */
constexpr float bitmap_text_size = 13.0f; /* size of the built-in bitmap font */

/* Glyph ranges: Latin with accents, Greek, Cyrillic, punctuation, arrows, mathematics. */
constexpr ImWchar characters[] = { 0x20,   0x24f,  0x370,  0x3ff,  0x400,  0x4ff, 0x2000,
                                   0x206f, 0x2190, 0x21ff, 0x2200, 0x22ff, 0 };

constexpr ImGuiKey keys[IMGUI_KEY_COUNT] = {
    ImGuiKey_Tab,       ImGuiKey_LeftArrow, ImGuiKey_RightArrow, ImGuiKey_UpArrow,
    ImGuiKey_DownArrow, ImGuiKey_PageUp,    ImGuiKey_PageDown,   ImGuiKey_Home,
    ImGuiKey_End,       ImGuiKey_Delete,    ImGuiKey_Backspace,  ImGuiKey_Space,
    ImGuiKey_Enter,     ImGuiKey_Escape,    ImGuiKey_A,          ImGuiKey_C,
    ImGuiKey_V,         ImGuiKey_X,         ImGuiKey_Z,
};

bool contains(const imgui_rect &area, float x, float y)
{
    return x >= area.x && y >= area.y && x < area.x + area.width && y < area.y + area.height;
}

} // namespace

static void set_colors(const theme &t)
{
    const struct {
        ImGuiCol which;
        uint32_t rgb;
    } rows[] = {
        { ImGuiCol_Text, t.text },
        { ImGuiCol_TextDisabled, t.dim },
        { ImGuiCol_WindowBg, t.panel },
        { ImGuiCol_PopupBg, t.panel },
        { ImGuiCol_Border, t.border },
        { ImGuiCol_FrameBg, t.raised },
        { ImGuiCol_FrameBgHovered, t.hover },
        { ImGuiCol_FrameBgActive, t.hover },
        { ImGuiCol_ScrollbarBg, t.panel },
        { ImGuiCol_ScrollbarGrab, t.border },
        { ImGuiCol_ScrollbarGrabHovered, t.dim },
        { ImGuiCol_ScrollbarGrabActive, t.dim },
        { ImGuiCol_CheckMark, t.accent },
        { ImGuiCol_SliderGrab, t.accent },
        { ImGuiCol_SliderGrabActive, t.accent },
        { ImGuiCol_Button, t.raised },
        { ImGuiCol_ButtonHovered, t.hover },
        { ImGuiCol_ButtonActive, t.pressed },
        { ImGuiCol_Header, t.raised },
        { ImGuiCol_HeaderHovered, t.hover },
        { ImGuiCol_HeaderActive, t.pressed },
        { ImGuiCol_Separator, t.border },
        { ImGuiCol_PlotHistogram, t.accent },
        { ImGuiCol_PlotHistogramHovered, t.changed },
        { ImGuiCol_TextSelectedBg, t.pressed },
        { ImGuiCol_NavHighlight, t.accent },
    };

    for (const auto &row : rows)
        ImGui::GetStyle().Colors[row.which] = imgui_state_color(row.rgb);
}

static void set_theme(float scale, const theme &theme)
{
    ImGuiStyle &style = ImGui::GetStyle();
    style = ImGuiStyle();
    ImGui::StyleColorsDark();
    style.WindowRounding = 0.0f;
    style.FrameRounding = 4.0f;
    style.GrabRounding = 4.0f;
    style.PopupRounding = 4.0f;
    style.GrabMinSize = 4.0f; /* keeps the number legible */
    style.ScrollbarSize = 12.0f;
    style.WindowPadding = ImVec2(8.0f, 5.0f);
    style.ItemSpacing = ImVec2(6.0f, 4.0f);
    style.FramePadding = ImVec2(6.0f, 3.0f);
    style.FrameBorderSize = 1.0f;
    style.WindowBorderSize = 0.0f;
    set_colors(theme);
    style.ScaleAllSizes(scale);
    style.WindowMinSize = ImVec2(1.0f, 1.0f); /* Dear ImGui rejects less */
}

/* Prevents Dear ImGui from focusing the first panel. An empty frame gives the initial focus to Dear
 * ImGui's fallback window; then the focus is cleared. */
static void lose_first_focus()
{
    ImGui::GetIO().DisplaySize = ImVec2(1.0f, 1.0f);
    ImGui::NewFrame();
    ImGui::EndFrame();
    ImGui::SetWindowFocus(nullptr);
}

/* Adds the system font to the font atlas. Returns false if the file is not a usable font. */
static bool add_font(const imgui *ui)
{
    ImGuiIO &io = ImGui::GetIO();
    ImFontConfig config;
    config.FontNo = ui->font.index;
    const float size = static_cast<float>(static_cast<int>(text_size * ui->scale));
#ifdef IMGUI_FREETYPE
    io.Fonts->FontBuilderIO = ImGuiFreeType::GetBuilderForFreeType();
    io.Fonts->FontBuilderFlags = ImGuiFreeTypeBuilderFlags_LightHinting;
#endif
    return *ui->font.path &&
           io.Fonts->AddFontFromFileTTF(ui->font.path, size, &config, characters) &&
           io.Fonts->Build();
}

/* Reserves a rectangle for each thumbnail in the font atlas, before the atlas is built. */
static void add_thumbnails(imgui *ui)
{
    const imgui_thumbnails &p = ui->thumbnails;
    for (uint32_t i = 0; i < p.count; i++)
        ui->rects[i] = ImGui::GetIO().Fonts->AddCustomRectRegular(static_cast<int>(p.width),
                                                                  static_cast<int>(p.height));
}

static void add_bitmap_font(imgui *ui, float scale)
{
    ImFontAtlas *fonts = ImGui::GetIO().Fonts;
    ImFontConfig config;
    fonts->Clear();
    add_thumbnails(ui);
    config.SizePixels = static_cast<float>(static_cast<int>(bitmap_text_size * scale));
    fonts->AddFontDefault(&config);
    fonts->Build();
}

static void copy_thumbnails(const imgui *ui)
{
    ImFontAtlas *fonts = ImGui::GetIO().Fonts;
    const imgui_thumbnails &p = ui->thumbnails;
    const size_t row = 4 * static_cast<size_t>(p.width);
    unsigned char *texels;
    int width;
    fonts->GetTexDataAsRGBA32(&texels, &width, nullptr);
    for (uint32_t i = 0; i < p.count; i++) {
        const ImFontAtlasCustomRect *rect = fonts->GetCustomRectByIndex(ui->rects[i]);
        for (size_t y = 0; y < p.height; y++)
            memcpy(&texels[4 * (static_cast<size_t>(width) * (rect->Y + y) + rect->X)],
                   &p.rgba[row * (static_cast<size_t>(p.height) * i + y)], row);
    }
}

void imgui_set_thumbnails(struct imgui *ui, const struct imgui_thumbnails *thumbnails)
{
    ui->thumbnails = *thumbnails;
}

bool imgui_rescale(struct imgui *ui, float scale, const struct theme *theme)
{
    ui->scale = scale;
    ui->colors = theme;
    set_theme(scale, *theme);
    ImGui::GetIO().Fonts->Clear();
    add_thumbnails(ui);
    const bool found = add_font(ui);
    if (!found)
        add_bitmap_font(ui, scale);
    copy_thumbnails(ui);
    return found;
}

struct imgui *imgui_create(const struct system_font *font)
{
    struct imgui *ui = new (std::nothrow) imgui();
    if (!ui)
        return nullptr;
    IMGUI_CHECKVERSION();
    ui->context = ImGui::CreateContext();
    ImGuiIO &io = ImGui::GetIO();
    io.IniFilename = nullptr; /* do not write a settings file */
    io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
    io.ConfigWindowsMoveFromTitleBarOnly = true;
    io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
    for (int k = 0; k < IMGUI_KEY_COUNT; k++)
        io.KeyMap[keys[k]] = k;
    io.UserData = ui;
    ui->font = *font;
    add_bitmap_font(ui, 1.0f);
    lose_first_focus();
    return ui;
}

void imgui_set_theme(struct imgui *ui, const struct theme *theme)
{
    ui->colors = theme;
    set_colors(*theme);
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
    ImGui::GetIO().Fonts->GetTexDataAsRGBA32(&texels, &w, &h);
    *width = static_cast<uint32_t>(w);
    *height = static_cast<uint32_t>(h);
    return texels;
}

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
    ui->item_count = 0;
}

void imgui_end(struct imgui *ui)
{
    ui->popup = ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopup);
    const ImGuiID active = ImGui::GetCurrentContext()->ActiveId;
    ui->gesture += active && active != ui->active ? 1 : 0;
    ui->active = active;
    ImGui::Render();
}

/* Clips a draw command's scissor rectangle to the window. */
static overlay_draw_command clip(const ImDrawCmd &command, const ImDrawData *data)
{
    const float left = command.ClipRect.x > 0.0f ? command.ClipRect.x : 0.0f;
    const float top = command.ClipRect.y > 0.0f ? command.ClipRect.y : 0.0f;
    const float right =
        command.ClipRect.z < data->DisplaySize.x ? command.ClipRect.z : data->DisplaySize.x;
    const float bottom =
        command.ClipRect.w < data->DisplaySize.y ? command.ClipRect.w : data->DisplaySize.y;
    overlay_draw_command part = {};
    if (right <= left || bottom <= top)
        return part;
    part.left = static_cast<int32_t>(left);
    part.top = static_cast<int32_t>(top);
    part.width = static_cast<uint32_t>(right - left);
    part.height = static_cast<uint32_t>(bottom - top);
    return part;
}

/* Appends a draw list, with `base` added to each vertex index. Returns false if `list` is full. */
static bool take_commands(const ImDrawList *from, uint32_t base, uint32_t *index_count,
                          uint32_t *indices, overlay_draw_list *list)
{
    const ImDrawData *data = ImGui::GetDrawData();
    for (const ImDrawCmd &command : from->CmdBuffer) {
        overlay_draw_command part = clip(command, data);
        if (!part.width || !part.height || !command.ElemCount)
            continue;
        if (list->command_count == OVERLAY_COMMAND_COUNT ||
            *index_count + command.ElemCount > OVERLAY_INDEX_COUNT)
            return false;
        part.first_index = *index_count;
        part.index_count = command.ElemCount;
        const ImDrawIdx *source = &from->IdxBuffer.Data[command.IdxOffset];
        for (uint32_t i = 0; i < command.ElemCount; i++)
            indices[(*index_count)++] = base + command.VtxOffset + source[i];
        list->commands[list->command_count++] = part;
    }
    return true;
}

bool imgui_copy_draw_list(const struct imgui *, struct overlay_vertex *vertices, uint32_t *indices,
                          struct overlay_draw_list *list)
{
    static_assert(sizeof(ImDrawVert) == sizeof(overlay_vertex),
                  "the layouts must be equal for memcpy");
    static_assert(offsetof(ImDrawVert, uv) == offsetof(overlay_vertex, u),
                  "the layouts must be equal");
    static_assert(offsetof(ImDrawVert, col) == offsetof(overlay_vertex, color),
                  "the layouts must be equal");
    const ImDrawData *data = ImGui::GetDrawData();
    uint32_t vertex_count = 0;
    uint32_t index_count = 0;
    list->command_count = 0;
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

bool imgui_wants_mouse(const struct imgui *ui, float x, float y)
{
    for (int p = 0; p < ui->panel_count; p++) {
        if (contains(ui->panels[p], x, y))
            return true;
    }
    return ui->popup;
}

bool imgui_has_popup(const struct imgui *ui)
{
    return ui->popup;
}

bool imgui_wants_keyboard(const struct imgui *)
{
    return ImGui::GetIO().WantCaptureKeyboard;
}

bool imgui_wants_text(const struct imgui *)
{
    return ImGui::GetIO().WantTextInput;
}

const struct imgui_item *imgui_items(const struct imgui *ui, uint32_t *count)
{
    *count = ui->item_count;
    return ui->items;
}

uint32_t imgui_gesture(const struct imgui *ui)
{
    return ui->gesture;
}

/* ---- drawing without a frame or a device ---- */

/* Calls `paint` for each glyph of a text, with its distance from the text's left. */
template <typename Paint> static float for_glyphs(const char *text, const Paint &paint)
{
    const ImFont *font = ImGui::GetIO().Fonts->Fonts[0];
    float x = 0.0f;
    while (*text) {
        unsigned int character;
        text += ImTextCharFromUtf8(&character, text, nullptr);
        const ImFontGlyph *glyph = font->FindGlyph(static_cast<ImWchar>(character));
        if (!glyph)
            continue;
        paint(*glyph, x);
        x += glyph->AdvanceX;
    }
    return x;
}

float imgui_painted_width(const struct imgui *, const char *text)
{
    return for_glyphs(text, [](const ImFontGlyph &, float) {});
}

/* Blends the coverage of a glyph's texels into a canvas. */
static void paint_glyph(const ImFontGlyph &glyph, int left, int top,
                        const struct imgui_canvas *canvas)
{
    unsigned char *texels;
    int width;
    int height;
    ImGui::GetIO().Fonts->GetTexDataAsAlpha8(&texels, &width, &height);
    const int u = static_cast<int>(lroundf(glyph.U0 * static_cast<float>(width)));
    const int v = static_cast<int>(lroundf(glyph.V0 * static_cast<float>(height)));
    const int columns = static_cast<int>(lroundf(glyph.X1 - glyph.X0));
    const int rows = static_cast<int>(lroundf(glyph.Y1 - glyph.Y0));
    for (int i = 0; i < columns * rows; i++) {
        const int x = left + static_cast<int>(glyph.X0) + i % columns;
        const int y = top + static_cast<int>(glyph.Y0) + i / columns;
        if (x < 0 || y < 0 || x >= static_cast<int>(canvas->width) ||
            y >= static_cast<int>(canvas->height))
            continue;
        const uint32_t cover = texels[(v + i / columns) * width + u + i % columns];
        uint32_t &pixel = canvas->pixels[y * static_cast<int>(canvas->width) + x];
        uint32_t mixed = 0;
        for (uint32_t shift = 0; shift < 24; shift += 8)
            mixed |=
                ((pixel >> shift & 255) * (255 - cover) + (canvas->rgb >> shift & 255) * cover) /
                    255
                << shift;
        pixel = mixed;
    }
}

void imgui_paint_text(const struct imgui *, const char *text, int x,
                      const struct imgui_canvas *canvas)
{
    const int top = (static_cast<int>(canvas->height) -
                     static_cast<int>(ImGui::GetIO().Fonts->Fonts[0]->FontSize)) /
                    2;
    for_glyphs(text, [&](const ImFontGlyph &glyph, float from) {
        paint_glyph(glyph, x + static_cast<int>(lroundf(from)), top, canvas);
    });
}
