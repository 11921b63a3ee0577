/*
 * keys.h: actions and their keys: the one table behind keys, buttons, their tips and F1.
 */
#ifndef FIRN_VIEW_KEYS_H
#define FIRN_VIEW_KEYS_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

enum view_action {
    VIEW_NOTHING,
    VIEW_LEFT,
    VIEW_RIGHT,
    VIEW_UP,
    VIEW_DOWN,
    VIEW_NEARER,
    VIEW_FARTHER,
    VIEW_RESET,
    VIEW_FRONT,
    VIEW_SIDE,
    VIEW_TOP,
    VIEW_ORTHOGRAPHIC,
    VIEW_GO_1, /* cameras that were stored */
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
    VIEW_LAST_FRAME,
    VIEW_UNDO,
    VIEW_REDO,
    VIEW_NEXT_FILE,
    VIEW_LAST_FILE,
    VIEW_SAVE_SESSION,
    VIEW_SAVE_PRESET,
    VIEW_SCREENSHOT,
    VIEW_QUICK,
    VIEW_FULLSCREEN,
    VIEW_SPLIT,
    VIEW_TRUTH,
    VIEW_STORE,
    VIEW_FLIP,
    VIEW_DIFFER,
    VIEW_DIVIDER_LEFT,
    VIEW_DIVIDER_RIGHT,
    VIEW_SHOT_OF_ALL,
    VIEW_HIDE,
    VIEW_TIMES,
    VIEW_PLAN,
    VIEW_LOOK,
    VIEW_NEXT_LAYER,
    VIEW_LAST_LAYER,
    VIEW_FALSE_COLORS,
    VIEW_COPY,
    VIEW_COPY_PICTURE,
    VIEW_PALETTE,
    VIEW_HELP,
    VIEW_LARGER,
    VIEW_SMALLER,
    VIEW_USUAL_SIZE,
    VIEW_THEME,
    VIEW_QUIT,
    VIEW_ACTION_COUNT,
    VIEW_DRAG = VIEW_ACTION_COUNT, /* what no button does: */
    VIEW_SLIDE,
    VIEW_TURN_LIGHT,
    VIEW_MOVE_SUN,
    VIEW_WHEEL,
    VIEW_AIM,
    VIEW_SEARCH,
    VIEW_PANEL_KEYS,
    VIEW_DROP,
    VIEW_DEED_COUNT,
};

/* How a key went down. */
struct key_press {
    int key;            /* as GLFW names keys; 0: none */
    unsigned character; /* that is typed, or with Ctrl would be without; 0: none */
    bool repeated;      /* it is held down; only movements are done again then */
    bool control, shift;
};

enum view_action keys_find(const struct key_press *press);

const char *keys_name(enum view_action action);   /* of its keys; NULL: none */
const char *keys_label(enum view_action action);  /* a few words */
const char *keys_help(enum view_action action);   /* one sentence, no full stop */
const char *keys_button(enum view_action action); /* as short as can be */

/* Row i of F1: a key's name and what it does; false: there are no more. */
bool keys_row(uint32_t i, const char **name, const char **help);

/* One line an action, with its help, and what the mouse does; docs/view.md has the same. */
void keys_print(FILE *out);

#endif
