/* key_bindings.c: table of actions with their keyboard shortcuts, labels and help texts. */
#define GLFW_INCLUDE_NONE
#include "src/view/key_bindings.h"
#include <GLFW/glfw3.h>
#include <stddef.h>
#include <string.h>

enum {
    KEYS_MAX = 2, /* maximum keys of an action */
};

/* Table of shortcuts. Letters and signs are compared by typed character, because their key codes
 * depend on the keyboard layout. */
static const struct {
    int keys[KEYS_MAX];             /* GLFW key codes; 0 if unused */
    const char *characters;         /* typed characters, or NULL */
    const char *controlled;         /* characters with Ctrl */
    const char *controlled_shifted; /* characters with Ctrl and Shift */
    bool repeats;
    const char *name;   /* shortcut name; NULL if not listed */
    const char *label;  /* label in F1 panel and palette */
    const char *help;   /* tooltip; NULL for the label alone */
    const char *button; /* button caption; NULL for the label */
} actions[VIEW_INPUT_COUNT] = {
    [VIEW_LEFT] = {
        .keys = { GLFW_KEY_LEFT },
        .repeats = true,
        .name = "Left",
        .label = "orbit to the left",
    },
    [VIEW_RIGHT] = {
        .keys = { GLFW_KEY_RIGHT },
        .repeats = true,
        .name = "Right",
        .label = "orbit to the right",
    },
    [VIEW_UP] = {
        .keys = { GLFW_KEY_UP },
        .repeats = true,
        .name = "Up",
        .label = "orbit upwards",
    },
    [VIEW_DOWN] = {
        .keys = { GLFW_KEY_DOWN },
        .repeats = true,
        .name = "Down",
        .label = "orbit downwards",
    },
    [VIEW_ZOOM_IN] = {
        .characters = "+=",
        .repeats = true,
        .name = "+, -",
        .label = "zoom in or out",
    },
    [VIEW_ZOOM_OUT] = { .characters = "-", .repeats = true, .label = "zoom out" },
    [VIEW_RESET] = {
        .keys = { GLFW_KEY_HOME },
        .characters = "rR",
        .name = "R, Home",
        .label = "reset the camera",
        .button = "Camera",
    },
    [VIEW_FRONT] = {
        .keys = { GLFW_KEY_KP_1 },
        .characters = "1",
        .name = "1, 3, 7",
        .label = "front, right or top view",
    },
    [VIEW_SIDE] = {
        .keys = { GLFW_KEY_KP_3 },
        .characters = "3",
        .label = "right view",
    },
    [VIEW_TOP] = {
        .keys = { GLFW_KEY_KP_7 },
        .characters = "7",
        .label = "top view",
    },
    [VIEW_ORTHOGRAPHIC] = {
        .keys = { GLFW_KEY_KP_5 },
        .characters = "5oO",
        .name = "5, O",
        .label = "orthographic or perspective",
        .help = "switch between an orthographic and a perspective camera; a copied command is "
                "always perspective",
    },
    [VIEW_GO_1] = {
        .controlled = "1",
        .name = "Ctrl 1-4",
        .label = "go to stored camera 1",
        .help = "go to a stored camera",
    },
    [VIEW_GO_2] = { .controlled = "2", .label = "go to stored camera 2" },
    [VIEW_GO_3] = { .controlled = "3", .label = "go to stored camera 3" },
    [VIEW_GO_4] = { .controlled = "4", .label = "go to stored camera 4" },
    [VIEW_STORE_1] = {
        .controlled_shifted = "1",
        .name = "Ctrl Shift 1-4",
        .label = "store camera 1",
        .help = "store a camera",
    },
    [VIEW_STORE_2] = { .controlled_shifted = "2", .label = "store camera 2" },
    [VIEW_STORE_3] = { .controlled_shifted = "3", .label = "store camera 3" },
    [VIEW_STORE_4] = { .controlled_shifted = "4", .label = "store camera 4" },
    [VIEW_UNDO] = {
        .controlled = "z",
        .name = "Ctrl Z",
        .label = "undo the last change",
        .button = "Undo",
    },
    [VIEW_REDO] = {
        .controlled = "y",
        .controlled_shifted = "z",
        .name = "Ctrl Shift Z",
        .label = "redo a change",
        .help = "redo the change that was undone last (also Ctrl Y)",
        .button = "Redo",
    },
    [VIEW_NEXT_FILE] = {
        .keys = { GLFW_KEY_PAGE_DOWN },
        .name = "Page Down",
        .label = "next model in the folder",
        .help = "open the next model in the folder, or the next built-in scene",
    },
    [VIEW_PREVIOUS_FILE] = {
        .keys = { GLFW_KEY_PAGE_UP },
        .name = "Page Up",
        .label = "previous model in the folder",
        .help = "open the previous model in the folder, or the previous built-in scene",
    },
    [VIEW_SAVE_SESSION] = {
        .controlled = "s",
        .name = "Ctrl S",
        .label = "save the session",
        .help = "save scene, settings, cameras, time and side B as a session (--session) in "
                "~/.local/share/firn/sessions",
    },
    [VIEW_SAVE_PRESET] = {
        .controlled_shifted = "s",
        .name = "Ctrl Shift S",
        .label = "save the settings as a preset",
        .help = "save the settings that differ from the defaults as a preset (--preset) in "
                "~/.local/share/firn/presets",
    },
    [VIEW_BRIGHTER] = {
        .characters = "e",
        .repeats = true,
        .name = "E, Shift+E",
        .label = "half a stop brighter, or darker",
        .help = "raise the exposure by half a stop; with Shift lower it",
    },
    [VIEW_DARKER] = { .characters = "E", .repeats = true, .label = "half a stop darker" },
    [VIEW_PAUSE] = {
        .characters = " ",
        .name = "Space",
        .label = "play or pause",
        .button = "Pause",
    },
    [VIEW_NEXT_FRAME] = {
        .characters = ".",
        .repeats = true,
        .name = "full stop",
        .label = "one frame later",
        .help = "step forward by one frame (motion.fps)",
    },
    [VIEW_PREVIOUS_FRAME] = {
        .characters = ",",
        .repeats = true,
        .name = "comma",
        .label = "one frame earlier",
    },
    [VIEW_SCREENSHOT] = {
        .keys = { GLFW_KEY_F12 },
        .characters = "pP",
        .name = "P, F12",
        .label = "save the image",
        .help = "save the image as firn-0001.png and firn-0001.exr, with all samples and layers, "
                "without panels",
        .button = "Save",
    },
    [VIEW_COPY] = {
        .characters = "cC",
        .name = "C",
        .label = "copy the firn render command",
        .help = "copy the firn render command of this image (side A of a comparison) to the "
                "clipboard, and print it to stdout",
        .button = "Copy",
    },
    [VIEW_COPY_IMAGE] = {
        .controlled = "c",
        .name = "Ctrl C",
        .label = "copy the image",
        .help = "copy the image, without panels, to the clipboard (needs wl-copy or xclip)",
    },
    [VIEW_SPLIT] = {
        .characters = "w",
        .name = "W",
        .label = "compare A and B side by side",
        .help = "switch between image A alone and images A and B on two sides of a draggable "
                "divider; B is the stored state or, if none is stored, the most exact refraction "
                "model",
        .button = "Compare",
    },
    [VIEW_REFERENCE] = {
        .characters = "W",
        .name = "Shift+W",
        .label = "compare with the reference",
        .help = "compare with the path-traced reference, which is rendered while the image is at "
                "rest",
    },
    [VIEW_STORE] = {
        .characters = "sS",
        .name = "S",
        .label = "store the current state as B",
        .help = "store settings and refraction model as B, to compare later changes with them",
    },
    [VIEW_FLIP] = {
        .characters = "tT",
        .name = "T",
        .label = "flip between A and B",
        .help = "show B in place of A, or A again",
    },
    [VIEW_ERROR_MAP] = {
        .characters = "dD",
        .name = "D",
        .label = "difference of A and B",
        .help = "switch between the images and the difference of A and B (FLIP error, from black "
                "to yellow)",
    },
    [VIEW_DIVIDER_LEFT] = {
        .characters = "[",
        .repeats = true,
        .name = "[, ]",
        .label = "move divider left or right",
        .help = "move the divider between A and B to the left or right",
    },
    [VIEW_DIVIDER_RIGHT] = { .characters = "]", .repeats = true, .label = "move divider right" },
    [VIEW_HIDE] = {
        .keys = { GLFW_KEY_TAB },
        .characters = "hH",
        .name = "Tab, H",
        .label = "hide or show the panels",
        .button = "Hide",
    },
    [VIEW_TIMES] = {
        .characters = "bB",
        .name = "B",
        .label = "time of each pass",
        .help = "switch between the settings and the time of each pass",
        .button = "Passes",
    },
    [VIEW_INSPECT] = {
        .characters = "iI",
        .name = "I",
        .label = "layers and pixel values",
        .help = "switch between the settings and the layers, histogram and values below the cursor",
        .button = "Inspect",
    },
    [VIEW_NEXT_LAYER] = {
        .characters = "l",
        .name = "L, Shift+L",
        .label = "next or previous layer",
        .help = "show the next layer of the image; after the last one the image itself",
    },
    [VIEW_PREVIOUS_LAYER] = { .characters = "L", .label = "previous layer" },
    [VIEW_FALSE_COLORS] = {
        .characters = "zZ",
        .name = "Z",
        .label = "false colours",
        .help = "show the image or layer in false colours, or unmodified",
    },
    [VIEW_DRAFT] = {
        .characters = "mM",
        .name = "M",
        .label = "draft or full quality in motion",
        .help = "switch between fast drafts at lower resolution and full quality while something "
                "moves",
    },
    [VIEW_FULLSCREEN] = {
        .keys = { GLFW_KEY_F11 },
        .characters = "fF",
        .name = "F, F11",
        .label = "full screen on or off",
    },
    [VIEW_LARGER] = {
        .controlled = "+=",
        .name = "Ctrl +",
        .label = "enlarge text and panels",
    },
    [VIEW_SMALLER] = {
        .controlled = "-",
        .name = "Ctrl -",
        .label = "shrink text and panels",
    },
    [VIEW_RESET_SIZE] = {
        .controlled = "0",
        .name = "Ctrl 0",
        .label = "reset size of text and panels",
    },
    [VIEW_THEME] = {
        .controlled = "t",
        .name = "Ctrl T",
        .label = "dark or light theme",
    },
    [VIEW_PALETTE] = {
        .controlled = "k",
        .name = "Ctrl K",
        .label = "find an action or a setting",
        .button = "Find",
    },
    [VIEW_HELP] = {
        .keys = { GLFW_KEY_F1 },
        .characters = "?",
        .name = "F1, ?",
        .label = "keyboard shortcuts",
        .help = "show or hide the keyboard shortcuts, and print them",
        .button = "Keys",
    },
    [VIEW_QUIT] = {
        .characters = "qQ",
        .controlled = "q",
        .name = "Q, Ctrl Q",
        .label = "close the window",
    },
    [VIEW_DRAG] = { .name = "drag", .label = "orbit around the object" },
    [VIEW_PAN] = { .name = "right drag", .label = "pan (also Shift or middle drag)" },
    [VIEW_ROTATE_LIGHT] = { .name = "Ctrl drag", .label = "rotate the light or panorama" },
    [VIEW_MOVE_SUN] = { .name = "Ctrl Shift drag", .label = "move the sun" },
    [VIEW_WHEEL] = { .name = "wheel", .label = "zoom" },
    [VIEW_CENTRE] = { .name = "double click", .label = "centre the view on this point" },
    [VIEW_SEARCH] = { .name = "/", .label = "search for a setting" },
    [VIEW_PANEL_KEYS] = { .name = "F6, Esc", .label = "focus the panel, or leave it" },
    [VIEW_DROP] = { .name = "drop a file", .label = "model, image, preset, session" },
};

static bool has_key(enum view_action action, int key)
{
    for (size_t k = 0; k < KEYS_MAX && key; k++) {
        if (actions[action].keys[k] == key)
            return true;
    }
    return false;
}

static bool is_in(const char *characters, unsigned character)
{
    return characters && character && character < 128 && strchr(characters, (int)character);
}

static enum view_action find(const struct key_press *press, bool shifted)
{
    for (enum view_action a = VIEW_ACTION_NONE; a < VIEW_ACTION_COUNT; a++) {
        const char *from = !press->control ? actions[a].characters
                           : shifted       ? actions[a].controlled_shifted
                                           : actions[a].controlled;
        if (is_in(from, press->character) || (!press->control && has_key(a, press->key)))
            return press->repeated && !actions[a].repeats ? VIEW_ACTION_NONE : a;
    }
    return VIEW_ACTION_NONE;
}

/* Ignores Shift if no shortcut requires it, because '+' needs Shift on many keyboards. */
enum view_action key_bindings_find(const struct key_press *press)
{
    const enum view_action action =
        press->control && press->shift ? find(press, true) : VIEW_ACTION_NONE;
    return action != VIEW_ACTION_NONE ? action : find(press, false);
}

const char *key_bindings_name(enum view_action action)
{
    return actions[action].name;
}

const char *key_bindings_label(enum view_action action)
{
    return actions[action].label;
}

const char *key_bindings_help(enum view_action action)
{
    return actions[action].help ? actions[action].help : actions[action].label;
}

const char *key_bindings_button(enum view_action action)
{
    return actions[action].button ? actions[action].button : actions[action].label;
}

/* Finds entry i of the shortcut list. *help is the label or, if `all`, the full help text. */
static bool find_row(uint32_t i, bool all, const char **name, const char **help)
{
    uint32_t count = 0;
    for (enum view_action a = VIEW_ACTION_NONE; a < VIEW_INPUT_COUNT; a++) {
        if (actions[a].name && count++ == i) {
            *name = actions[a].name;
            *help = all ? key_bindings_help(a) : actions[a].label;
            return true;
        }
    }
    return false;
}

bool key_bindings_row(uint32_t i, const char **name, const char **help)
{
    return find_row(i, false, name, help);
}

void key_bindings_print(FILE *out)
{
    const char *name;
    const char *help;
    for (uint32_t i = 0; find_row(i, true, &name, &help); i++)
        fprintf(out, "  %-16s %s\n", name, help);
}
