/*
 * imgui.h: C interface to the parts of Dear ImGui that firn-view needs.
 *
 *     imgui_begin(ui, &input)
 *     ... panels and their items ...
 *     imgui_end(ui)
 *     imgui_copy_draw_list(ui, vertices, indices, &list)    if it is drawn
 *
 * Lengths are pixels. Labels identify items within their panel; the part after "##" is not shown.
 * All functions between begin and end use the one context of imgui_create().
 */
#ifndef FIRN_VIEW_PANELS_IMGUI_H
#define FIRN_VIEW_PANELS_IMGUI_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include "src/view/panels/system_font.h"
#include "src/view/panels/theme.h"
#include "src/view/window/overlay_draw_list.h"

#ifdef __cplusplus
extern "C" {
#endif

enum imgui_key {
    IMGUI_TAB,
    IMGUI_LEFT,
    IMGUI_RIGHT,
    IMGUI_UP,
    IMGUI_DOWN,
    IMGUI_PAGE_UP,
    IMGUI_PAGE_DOWN,
    IMGUI_HOME,
    IMGUI_END,
    IMGUI_DELETE,
    IMGUI_BACKSPACE,
    IMGUI_SPACE,
    IMGUI_ENTER,
    IMGUI_ESCAPE,
    IMGUI_A, /* Ctrl: select all */
    IMGUI_C, /* Ctrl: copy */
    IMGUI_V, /* Ctrl: paste */
    IMGUI_X, /* Ctrl: cut */
    IMGUI_Z, /* Ctrl: undo */
    IMGUI_KEY_COUNT,
};

enum {
    IMGUI_BUTTON_COUNT = 3,     /* left, right, middle mouse button */
    IMGUI_CHARACTER_COUNT = 16, /* maximum typed characters per frame */
    IMGUI_THUMBNAIL_MAX = 96,
};

/* State of the input devices at the start of a frame. */
struct imgui_input {
    float seconds;       /* since the previous frame */
    float width, height; /* size of the window */
    float x, y;          /* cursor position */
    bool buttons[IMGUI_BUTTON_COUNT];
    float wheel; /* wheel steps since the previous frame */
    bool keys[IMGUI_KEY_COUNT];
    bool control, shift, alt;
    unsigned characters[IMGUI_CHARACTER_COUNT]; /* typed since the previous frame */
    uint32_t character_count;
};

struct imgui;

/* Creates the only Dear ImGui context; call imgui_rescale() next. If the font path is empty, the
 * built-in bitmap font is used. Returns NULL if out of memory. */
struct imgui *imgui_create(const struct system_font *font);

/* Thumbnails for imgui_thumbnail_button() buttons. */
struct imgui_thumbnails {
    const uint8_t *rgba;    /* sRGB-encoded RGBA, top row first */
    uint32_t width, height; /* size of each image, texels */
    uint32_t count;         /* at most IMGUI_THUMBNAIL_MAX */
};

/* Sets the thumbnails. Each imgui_rescale() copies them into the font atlas. */
void imgui_set_thumbnails(struct imgui *ui, const struct imgui_thumbnails *thumbnails);

/* Multiplies all sizes by `scale`, applies the theme and rebuilds the font atlas. Must not be
 * called within a frame. If the font cannot be read, uses the built-in font and returns false. */
bool imgui_rescale(struct imgui *ui, float scale, const struct theme *theme);
void imgui_set_theme(struct imgui *ui, const struct theme *theme); /* not within a frame */
void imgui_destroy(struct imgui *ui);                              /* may be NULL */

/* Returns the font atlas as RGBA pixels. Letters are white, with coverage in alpha. Thumbnails are
 * opaque. The pixels are valid until imgui_rescale() or imgui_destroy(). */
const uint8_t *imgui_font(const struct imgui *ui, uint32_t *width, uint32_t *height);

void imgui_begin(struct imgui *ui, const struct imgui_input *input);
void imgui_end(struct imgui *ui);

/* Writes the last frame's draw list to buffers of OVERLAY_*_COUNT elements. If the list does not
 * fit, omits its end and returns false. */
bool imgui_copy_draw_list(const struct imgui *ui, struct overlay_vertex *vertices,
                          uint32_t *indices, struct overlay_draw_list *list);

/* ---- between frames ---- */

bool imgui_wants_mouse(const struct imgui *ui, float x, float y); /* a panel covers this point */
bool imgui_wants_keyboard(const struct imgui *ui);                /* a panel has the focus */
bool imgui_has_popup(const struct imgui *ui);                     /* a list is open */
bool imgui_wants_text(const struct imgui *ui);                    /* a text field has the focus */

/* ---- panels, within a frame ---- */

struct imgui_rect {
    float x, y, width, height;
};

enum imgui_panel {
    IMGUI_DOCKED, /* beside the image */
    IMGUI_LABEL,  /* label over the image */
    IMGUI_POPUP,  /* bordered popup above other panels */
};

/* Begins a panel at `area`. imgui_panel_end() must follow, even if the panel is hidden. */
void imgui_panel_begin(struct imgui *ui, const char *title, struct imgui_rect area,
                       enum imgui_panel kind);
void imgui_panel_end(void);

/* Sets the vertical spacing of rows, in pixels, until imgui_gap_end(). */
void imgui_gap_begin(float pixels);
void imgui_gap_end(void);

void imgui_scroll_begin(const char *name);
void imgui_scroll_end(void);

/* A list that scrolls, `height` pixels high. */
void imgui_list_begin(const char *name, float height);
void imgui_list_end(void);
float imgui_list_row_height(void); /* of rows with a check box */

void imgui_focus_panel(const char *title); /* NULL clears the keyboard focus */
bool imgui_is_active(void);                /* true while an item is used */
bool imgui_is_item_active(void);           /* true while the last item is used */
bool imgui_is_item_clicked(void);          /* true if the last item was clicked now */
float imgui_scale(void);                   /* scale set by imgui_rescale() */
const struct theme *imgui_theme(void);     /* current theme */
float imgui_line_height(void);             /* height of a line of text */
float imgui_row_height(void);              /* height of a button or slider */
float imgui_available_width(void);         /* remaining width in the current row */

/* ---- items ---- */

void imgui_indent(float x);
void imgui_same_line(float x); /* 0 for after the last item */
void imgui_next_width(float width);
void imgui_next_focus(void);         /* focuses the next item */
void imgui_id_begin(const void *id); /* scope of item labels */
void imgui_id_end(void);
void imgui_tooltip(const char *text);     /* tooltip of the last item */
float imgui_width(const char *text);      /* width of such a button */
void imgui_disabled_begin(bool disabled); /* greyed out until imgui_disabled_end() */
void imgui_disabled_end(void);

void imgui_text(const char *text);
void imgui_text_dim(const char *text);
void imgui_value(const char *text);            /* listed in imgui_items() */
void imgui_name(const char *text);             /* lists the last item in imgui_items() */
void imgui_text_at(float x, const char *text); /* dim, in the row of the last item */
void imgui_text_beside(float x, float y, const char *text); /* dim, at a point of the window */
void imgui_text_in(const char *text, uint32_t rgb);         /* colour 0xRRGGBB */
void imgui_text_elided(const char *text, float width);      /* shortened by "..." in the middle */
void imgui_text_elided_in(const char *text, float width, uint32_t rgb);
void imgui_align(void);                    /* aligns text with buttons */
void imgui_warning(const char *text);      /* red, wrapped */
void imgui_text_wrapped(const char *text); /* wrapped; listed in imgui_items() */
bool imgui_button(const char *label);
bool imgui_small_button(const char *label);
bool imgui_choice_button(const char *label, bool chosen); /* one of exclusive buttons */
bool imgui_selectable(const char *label, bool chosen);    /* row as wide as the panel */

/* Draws one of several exclusive buttons, `width` pixels wide. A thumbnail is above the label. If
 * the index `thumbnail` is out of range, draws only the label. */
bool imgui_thumbnail_button(const char *label, uint32_t thumbnail, float width, bool chosen);
bool imgui_collapsing_header(const char *label,
                             bool *open); /* collapsible heading; toggles *open */

/* Draws a checkbox. Like imgui_combo(), returns true if the user has changed the value. */
bool imgui_checkbox(const char *label, bool *value);
bool imgui_combo(const char *label, const char *const *names, uint32_t count, uint32_t *index);
bool imgui_text_field(const char *label, const char *hint, char *text, size_t size);

/* Draws a button that opens a menu. If it returns true, the menu's items and imgui_menu_end() must
 * follow. */
bool imgui_menu_begin(const char *label);
void imgui_menu_end(void);

struct imgui_slider_range {
    float min, max;
    const char *format; /* printf format; float or unsigned */
    bool logarithmic;
};

bool imgui_slider(const char *label, float *value, const struct imgui_slider_range *slide);
bool imgui_count_slider(const char *label, uint32_t *value, const struct imgui_slider_range *slide);

bool imgui_color(const char *label, float color[3]); /* sRGB-encoded, with a picker */

/* Draws a number field with - and + buttons. Returns true when the input is complete. */
bool imgui_number_field(const char *label, uint32_t *value);

/* ---- last frame's items ---- */

enum {
    IMGUI_ITEM_COUNT = 256, /* maximum items listed per frame */
};

/* An interactive item. */
struct imgui_item {
    char label[64]; /* label without the text before "##" */
    struct imgui_rect rect;
};

/* Returns the visible interactive widgets of the last frame. */
const struct imgui_item *imgui_items(const struct imgui *ui, uint32_t *count);

/* Returns the current gesture number. Changes during one drag of a widget have the same number. */
uint32_t imgui_gesture(const struct imgui *ui);

/* ---- drawing without a frame or a device ---- */

struct imgui_canvas {
    uint32_t *pixels; /* 0xRRGGBB, top row first */
    uint32_t width, height;
    uint32_t rgb; /* colour of the text */
};

/* Paints a line of text from x on, at half the canvas's height. */
void imgui_paint_text(const struct imgui *ui, const char *text, int x,
                      const struct imgui_canvas *canvas);
float imgui_painted_width(const struct imgui *ui, const char *text);

/* ---- drawing ---- */

#define IMGUI_RGBA(r, g, b, a) \
    ((uint32_t)(a) << 24 | (uint32_t)(b) << 16 | (uint32_t)(g) << 8 | (uint32_t)(r))

/* Draws a ring of values, the oldest at index `first`, as bars as wide as the panel. `most` is the
 * value at the top. A tooltip shows the value at the cursor. */
void imgui_histogram(const char *label, const float *values, uint32_t count, uint32_t first,
                     float most, float height);

/* Reserves an area of the panel for drawing, and returns its position. */
struct imgui_rect imgui_reserve(float width, float height);
struct imgui_rect imgui_cursor(void); /* of the next item; size 0x0 */
uint32_t imgui_rgba(uint32_t rgb);    /* converts 0xRRGGBB to packed RGBA */
void imgui_rectangle(struct imgui_rect area, uint32_t color);

/* Lines over an area beside the panels, in front of the image and behind later panels. */
void imgui_lines_begin(struct imgui_rect area);
void imgui_line(float x, float y, float to_x, float to_y, float width, uint32_t color);
void imgui_lines_end(void);

void imgui_cursor_tooltip(const char *text);   /* tooltip at the cursor */
bool imgui_is_hovered(struct imgui_rect area); /* the cursor is in the rectangle */

#ifdef __cplusplus
}
#endif

#endif
