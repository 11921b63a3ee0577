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
    VIEW_BOOKMARK_1,
    VIEW_BOOKMARK_2,
    VIEW_BOOKMARK_3,
    VIEW_BOOKMARK_4,
    VIEW_ADD_BOOKMARK,
    VIEW_BRIGHTER,
    VIEW_DARKER,
    VIEW_PAUSE,
    VIEW_NEXT_FRAME,
    VIEW_PREVIOUS_FRAME,
    VIEW_STOP,
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

struct key_binding {
    const char *keys;  /* shortcuts or mouse gesture, separated by ", " */
    const char *label; /* a few words, for the F1 list and the palette */
    const char *help;  /* a sentence without full stop; NULL for the label alone */
    bool repeats;      /* auto-repeat while the key is held */
};

extern const struct key_binding key_bindings[VIEW_INPUT_COUNT]; /* from VIEW_ACTION_NONE + 1 on */

/* Key press as reported by GLFW. */
struct key_press {
    int key;            /* GLFW key code, or 0 */
    unsigned character; /* typed character; 0 if none */
    bool repeated;      /* auto-repeat of a held key */
    bool control, shift;
};

enum view_action key_bindings_find(const struct key_press *press);

const char *key_bindings_help(enum view_action action); /* the help text or the label */

/* Prints one line for each shortcut and mouse gesture. See docs/reference/keys.md. */
void key_bindings_print(FILE *out);

#endif
