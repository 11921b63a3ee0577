/* key_bindings.h: actions, their keyboard shortcuts, labels and help texts. */
#ifndef FIRN_VIEW_KEY_BINDINGS_H
#define FIRN_VIEW_KEY_BINDINGS_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

enum view_action {
    VIEW_ACTION_NONE,
    VIEW_LEFT,
    VIEW_RIGHT,
    VIEW_UP,
    VIEW_DOWN,
    VIEW_ZOOM_IN,
    VIEW_ZOOM_OUT,
    VIEW_RESET,
    VIEW_FRONT,
    VIEW_SIDE,
    VIEW_TOP,
    VIEW_ORTHOGRAPHIC,
    VIEW_GO_1, /* go to a stored camera */
    VIEW_GO_2,
    VIEW_GO_3,
    VIEW_GO_4,
    VIEW_STORE_1,
    VIEW_STORE_2,
    VIEW_STORE_3,
    VIEW_STORE_4,
    VIEW_BRIGHTER,
    VIEW_DARKER,
    VIEW_PAUSE,
    VIEW_NEXT_FRAME,
    VIEW_PREVIOUS_FRAME,
    VIEW_UNDO,
    VIEW_REDO,
    VIEW_NEXT_FILE,
    VIEW_PREVIOUS_FILE,
    VIEW_SAVE_SESSION,
    VIEW_SAVE_PRESET,
    VIEW_SCREENSHOT,
    VIEW_DRAFT,
    VIEW_FULLSCREEN,
    VIEW_SPLIT,
    VIEW_REFERENCE,
    VIEW_STORE,
    VIEW_FLIP,
    VIEW_ERROR_MAP,
    VIEW_DIVIDER_LEFT,
    VIEW_DIVIDER_RIGHT,
    VIEW_HIDE,
    VIEW_TIMES,
    VIEW_INSPECT,
    VIEW_NEXT_LAYER,
    VIEW_PREVIOUS_LAYER,
    VIEW_FALSE_COLORS,
    VIEW_COPY,
    VIEW_COPY_IMAGE,
    VIEW_PALETTE,
    VIEW_HELP,
    VIEW_LARGER,
    VIEW_SMALLER,
    VIEW_RESET_SIZE,
    VIEW_THEME,
    VIEW_QUIT,
    VIEW_ACTION_COUNT,
    VIEW_DRAG = VIEW_ACTION_COUNT, /* VIEW_DRAG and later values cannot be run as commands */
    VIEW_PAN,
    VIEW_ROTATE_LIGHT,
    VIEW_MOVE_SUN,
    VIEW_WHEEL,
    VIEW_CENTRE,
    VIEW_SEARCH,
    VIEW_PANEL_KEYS,
    VIEW_DROP,
    VIEW_INPUT_COUNT,
};

/* Key press as reported by GLFW. */
struct key_press {
    int key;            /* GLFW key code, or 0 */
    unsigned character; /* typed character; 0 if none */
    bool repeated;      /* auto-repeat of a held key */
    bool control, shift;
};

enum view_action key_bindings_find(const struct key_press *press);

const char *key_bindings_name(enum view_action action);   /* display name, or NULL */
const char *key_bindings_label(enum view_action action);  /* a few words */
const char *key_bindings_help(enum view_action action);   /* one sentence without full stop */
const char *key_bindings_button(enum view_action action); /* one word if possible */

/* Finds shortcut i of the F1 list and its description. Returns false after the last shortcut. */
bool key_bindings_row(uint32_t i, const char **name, const char **help);

/* Prints one line for each shortcut and mouse gesture. docs/view.md contains the same list. */
void key_bindings_print(FILE *out);

#endif
