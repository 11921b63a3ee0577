/*
 * imgui.h: Dear ImGui for C: as much of it as firn-view needs.
 *
 *     imgui_begin(ui, &input)
 *     ... panels and what is in them ...
 *     imgui_end(ui)
 *     imgui_take(ui, vertices, indices, &list)    if it is drawn
 *
 * Lengths are pixels. Labels name their thing within its panel: what follows "##" in them is not
 * shown. Everything between begin and end works on the one context there is: of imgui_create().
 */
#ifndef FIRN_VIEW_UI_IMGUI_H
#define FIRN_VIEW_UI_IMGUI_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include "src/view/overlay_list.h"
#include "src/view/ui/font.h"
#include "src/view/ui/theme.h"

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
    IMGUI_A, /* with Ctrl, in a line of text: all */
    IMGUI_C, /* copy */
    IMGUI_V, /* paste */
    IMGUI_X, /* cut */
    IMGUI_Z, /* undo */
    IMGUI_KEY_COUNT,
};

enum {
    IMGUI_BUTTON_COUNT = 3,     /* left, right, middle */
    IMGUI_CHARACTER_COUNT = 16, /* in a frame */
    IMGUI_PICTURE_MAX = 64,
};

/* How hands stand when a frame begins. */
struct imgui_input {
    float seconds;       /* since the last frame */
    float width, height; /* of the window */
    float x, y;          /* of the cursor */
    bool buttons[IMGUI_BUTTON_COUNT];
    float wheel; /* steps since the last frame */
    bool keys[IMGUI_KEY_COUNT];
    bool control, shift, alt;
    unsigned characters[IMGUI_CHARACTER_COUNT]; /* typed since the last frame */
    uint32_t character_count;
};

struct imgui;

/* Text is written in the font; path "": the built-in bitmap font. NULL: out of memory. There is at
 * most one. imgui_rescale() comes next. */
struct imgui *imgui_create(const struct font *font);

/* Pictures that buttons can show. */
struct imgui_pictures {
    const uint8_t *rgba;    /* one after another, rows from the top; sRGB-encoded */
    uint32_t width, height; /* of each, texels */
    uint32_t count;         /* at most IMGUI_PICTURE_MAX */
};

/* They are copied into the font's image by each imgui_rescale(); before, they are not shown. */
void imgui_use_pictures(struct imgui *ui, const struct imgui_pictures *pictures);

/* All sizes are multiplied by `scale` and all has the theme's colours from now on; the font's image
 * is another one. Between frames. False: the font cannot be read, the built-in one is used. */
bool imgui_rescale(struct imgui *ui, float scale, const struct theme *theme);
void imgui_look(struct imgui *ui, const struct theme *theme); /* other colours; between frames */
void imgui_destroy(struct imgui *ui);                         /* may be NULL */

/* The font's image, RGBA: letters are white with as much alpha as is covered, pictures opaque.
 * Valid until imgui_rescale() or imgui_destroy(). */
const uint8_t *imgui_font(const struct imgui *ui, uint32_t *width, uint32_t *height);

void imgui_begin(struct imgui *ui, const struct imgui_input *input);
void imgui_end(struct imgui *ui);

/* What the frame that ended last looks like; room for OVERLAY_*_COUNT. False: there is more, which
 * is left out. */
bool imgui_take(const struct imgui *ui, struct overlay_vertex *vertices, uint32_t *indices,
                struct overlay_list *list);

/* ---- between frames ---- */

bool imgui_covers(const struct imgui *ui, float x, float y); /* a panel lies there */
bool imgui_has_keys(const struct imgui *ui);                 /* keys move within a panel */
bool imgui_has_text(const struct imgui *ui);                 /* a line of text is being typed */

/* ---- panels, between begin and end ---- */

struct imgui_place {
    float x, y, width, height;
};

enum imgui_panel {
    IMGUI_DOCKED, /* beside the picture */
    IMGUI_LABEL,  /* over the picture */
    IMGUI_OVER,   /* over all others, with a border; a line of text in it has the keys */
};

/* `place`: pixels. Nothing of it may show; end it all the same. */
void imgui_panel_begin(struct imgui *ui, const char *title, struct imgui_place place,
                       enum imgui_panel kind);
void imgui_panel_end(void);

/* The rest of a panel scrolls, what is above stays. */
/* Between these so many pixels are between rows. */
void imgui_gap_begin(float pixels);
void imgui_gap_end(void);

void imgui_scroll_begin(const char *name);
void imgui_scroll_end(void);
void imgui_scroll_to_here(void);           /* what came last becomes visible */
void imgui_focus_panel(const char *title); /* keys go there; NULL: to none */
bool imgui_is_active(void);                /* something is being dragged, typed or chosen */
float imgui_scale(void);                   /* of imgui_rescale() */
const struct theme *imgui_theme(void);     /* the same */
float imgui_line_height(void);             /* of text */
float imgui_row_height(void);              /* of buttons and the like */
float imgui_room(void);                    /* width that is left in this row */

/* ---- what is in them ---- */

void imgui_indent(float x);    /* what comes next, alone, begins so far to the right */
void imgui_same_line(float x); /* what comes next; x from the panel's left, 0: just beside */
void imgui_next_width(float width);
void imgui_next_focus(void);         /* keys go to what comes next */
void imgui_id_begin(const void *id); /* the same labels name other things until: */
void imgui_id_end(void);
void imgui_tip(const char *text);         /* shown while the cursor rests on what came before */
float imgui_width(const char *text);      /* of a button that is called so: with its margins */
void imgui_disabled_begin(bool disabled); /* what is between cannot be used, and looks so */
void imgui_disabled_end(void);

void imgui_text(const char *text);
void imgui_text_dim(const char *text);
void imgui_value(const char *text);                 /* is among imgui_items() */
void imgui_name(const char *text);                  /* so is what came before, as this */
void imgui_text_in(const char *text, uint32_t rgb); /* 0xRRGGBB */
void imgui_text_cut(const char *text, float width); /* too long: has dots in its middle */
void imgui_text_cut_in(const char *text, float width, uint32_t rgb);
void imgui_align(void);               /* text in this row stands at the height of text in buttons */
void imgui_warning(const char *text); /* red, in as many lines as it needs */
void imgui_separator(void);
void imgui_text_wrapped(const char *text); /* in as many lines as it needs; among imgui_items() */
bool imgui_button(const char *label);
bool imgui_small_button(const char *label);
bool imgui_choice(const char *label, bool chosen); /* a button that is one of several */
bool imgui_line(const char *label, bool chosen);   /* a button as wide as the panel */

/* A button that is one of several: a picture above its label. `width`: of the button, pixels. */
bool imgui_picture(const char *label, uint32_t picture, float width, bool chosen);
bool imgui_group(const char *label, bool *open); /* a heading that opens and closes it: *open */

/* True if a hand has changed the value. `format` is printf's, of one float or unsigned. */
bool imgui_checkbox(const char *label, bool *value);
bool imgui_list(const char *label, const char *const *names, uint32_t count, uint32_t *index);
bool imgui_line_of_text(const char *label, const char *hint, char *text, size_t size);
bool imgui_entered(void); /* Enter ended the line of text that came last */

struct imgui_slide {
    float min, max;
    const char *format;
    bool logarithmic;
};

bool imgui_slider(const char *label, float *value, const struct imgui_slide *slide);
bool imgui_count_slider(const char *label, uint32_t *value, const struct imgui_slide *slide);

/* A number to be typed, with buttons for one more and one less; true when it is complete. */
bool imgui_number(const char *label, uint32_t *value);

/* ---- what was there ---- */

enum {
    IMGUI_ITEM_COUNT = 256, /* in a frame; more are left out */
};

/* Something a hand can use. */
struct imgui_item {
    char label[64]; /* without "##" before it */
    struct imgui_place place;
};

/* Of the frame that ended last, only what is visible. */
const struct imgui_item *imgui_items(const struct imgui *ui, uint32_t *count);

/* How often something has been taken hold of, typed into or chosen: while a hand drags something it
 * stays the same. */
uint32_t imgui_gesture(const struct imgui *ui);

/* ---- drawing ---- */

#define IMGUI_RGBA(r, g, b, a) \
    ((uint32_t)(a) << 24 | (uint32_t)(b) << 16 | (uint32_t)(g) << 8 | (uint32_t)(r))

/* Room in the panel: where it lies. */
struct imgui_place imgui_canvas(float width, float height);
struct imgui_place imgui_cursor(void); /* where what comes next will be; its size is 0x0 */
uint32_t imgui_rgba(uint32_t rgb);     /* of 0xRRGGBB */
void imgui_rectangle(struct imgui_place place, uint32_t color);
void imgui_hint(const char *text);            /* beside the cursor */
bool imgui_is_over(struct imgui_place place); /* the cursor */

#ifdef __cplusplus
}
#endif

#endif
