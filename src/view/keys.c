/* keys.c: the table of actions. */
#define GLFW_INCLUDE_NONE
#include "src/view/keys.h"
#include <GLFW/glfw3.h>
#include <stddef.h>
#include <string.h>

enum {
    KEYS_MAX = 2, /* of an action */
};

/* Letters and signs are found by what is typed: where they lie depends on the keyboard. */
static const struct {
    int keys[KEYS_MAX];             /* 0: none */
    const char *characters;         /* NULL: none */
    const char *controlled;         /* with Ctrl */
    const char *controlled_shifted; /* with both */
    bool repeats;
    const char *name;   /* of its keys; NULL: none */
    const char *label;  /* a few words */
    const char *help;   /* what it does, where the label does not say all; NULL: it does */
    const char *button; /* a word; NULL: the label */
} actions[VIEW_DEED_COUNT] = {
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
    [VIEW_NEARER] = {
        .characters = "+=",
        .repeats = true,
        .name = "+, -",
        .label = "move closer, or away",
    },
    [VIEW_FARTHER] = { .characters = "-", .repeats = true, .label = "move away" },
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
        .label = "look from front, right, above",
    },
    [VIEW_SIDE] = {
        .keys = { GLFW_KEY_KP_3 },
        .characters = "3",
        .label = "look from the right",
    },
    [VIEW_TOP] = {
        .keys = { GLFW_KEY_KP_7 },
        .characters = "7",
        .label = "look from above",
    },
    [VIEW_ORTHOGRAPHIC] = {
        .keys = { GLFW_KEY_KP_5 },
        .characters = "5oO",
        .name = "5, O",
        .label = "orthographic or perspective",
        .help = "switch between an orthographic and a perspective camera; the copied command has "
                "a perspective one",
    },
    [VIEW_GO_1] = {
        .controlled = "1",
        .name = "Ctrl 1 to 4",
        .label = "go to stored camera 1",
        .help = "go back to a camera that was stored",
    },
    [VIEW_GO_2] = { .controlled = "2", .label = "go to stored camera 2" },
    [VIEW_GO_3] = { .controlled = "3", .label = "go to stored camera 3" },
    [VIEW_GO_4] = { .controlled = "4", .label = "go to stored camera 4" },
    [VIEW_STORE_1] = {
        .controlled_shifted = "1",
        .name = "with Shift",
        .label = "store camera 1",
        .help = "Ctrl with Shift and 1 to 4: store the camera",
    },
    [VIEW_STORE_2] = { .controlled_shifted = "2", .label = "store camera 2" },
    [VIEW_STORE_3] = { .controlled_shifted = "3", .label = "store camera 3" },
    [VIEW_STORE_4] = { .controlled_shifted = "4", .label = "store camera 4" },
    [VIEW_UNDO] = {
        .controlled = "z",
        .name = "Ctrl Z",
        .label = "undo a change of settings",
        .button = "Undo",
    },
    [VIEW_REDO] = {
        .controlled = "y",
        .controlled_shifted = "z",
        .name = "Ctrl Shift Z",
        .label = "redo it",
        .help = "redo the change of settings that was undone last (also Ctrl Y)",
        .button = "Redo",
    },
    [VIEW_NEXT_FILE] = {
        .keys = { GLFW_KEY_PAGE_DOWN },
        .name = "Page Down",
        .label = "next model of the folder",
        .help = "open the next model of the folder, or the next scene of firn",
    },
    [VIEW_LAST_FILE] = {
        .keys = { GLFW_KEY_PAGE_UP },
        .name = "Page Up",
        .label = "previous model of the folder",
        .help = "open the previous model of the folder, or the previous scene of firn",
    },
    [VIEW_SAVE_SESSION] = {
        .controlled = "s",
        .name = "Ctrl S",
        .label = "save the session",
        .help = "save scene, settings, cameras, time and B as a session, for --session, in "
                "~/.local/share/firn/sessions",
    },
    [VIEW_SAVE_PRESET] = {
        .controlled_shifted = "s",
        .name = "Ctrl Shift S",
        .label = "save a preset of the settings",
        .help = "save the settings that are not the defaults as a preset, for --preset, in "
                "~/.local/share/firn/presets",
    },
    [VIEW_BRIGHTER] = {
        .characters = "e",
        .repeats = true,
        .name = "E, Shift+E",
        .label = "half a stop brighter, or darker",
        .help = "expose the picture by half a stop more; with Shift by half a stop less",
    },
    [VIEW_DARKER] = { .characters = "E", .repeats = true, .label = "half a stop darker" },
    [VIEW_PAUSE] = {
        .characters = " ",
        .name = "Space",
        .label = "pause or resume time",
        .button = "Pause",
    },
    [VIEW_NEXT_FRAME] = {
        .characters = ".",
        .repeats = true,
        .name = "., ,",
        .label = "one frame later, or earlier",
        .help = "let time pass by one frame of motion.fps, or go back by one",
    },
    [VIEW_LAST_FRAME] = { .characters = ",", .repeats = true, .label = "one frame earlier" },
    [VIEW_SCREENSHOT] = {
        .keys = { GLFW_KEY_F12 },
        .characters = "p",
        .name = "P, F12",
        .label = "save the picture",
        .help = "save the picture as firn-0001.png and firn-0001.exr: all samples and layers, "
                "without panels",
        .button = "Save",
    },
    [VIEW_SHOT_OF_ALL] = {
        .characters = "P",
        .name = "Shift+P",
        .label = "save the window, with panels",
        .help = "save a PNG file of the window as it is, with panels",
    },
    [VIEW_COPY] = {
        .characters = "cC",
        .name = "C",
        .label = "copy the firn render command",
        .help = "copy the firn render command of this picture (with a divider, of its left side) "
                "to the clipboard, and print it to stdout",
        .button = "Copy",
    },
    [VIEW_COPY_PICTURE] = {
        .controlled = "c",
        .name = "Ctrl C",
        .label = "copy the picture",
        .help = "copy the picture, without panels, to the clipboard, by wl-copy or xclip",
    },
    [VIEW_SPLIT] = {
        .characters = "w",
        .name = "W",
        .label = "compare A with B, or not",
        .help = "show A and B side by side, with a divider that can be dragged, or A alone; B is "
                "what was stored, or the most exact rung",
        .button = "Compare",
    },
    [VIEW_TRUTH] = {
        .characters = "W",
        .name = "Shift+W",
        .label = "compare with the reference",
        .help = "compare with the reference, which is traced as soon as the picture is still",
    },
    [VIEW_STORE] = {
        .characters = "sS",
        .name = "S",
        .label = "store the picture as B",
        .help = "store settings and rung as B, to be compared with what comes",
    },
    [VIEW_FLIP] = {
        .characters = "tT",
        .name = "T",
        .label = "flip between A and B",
        .help = "show B in place of A, or A again",
    },
    [VIEW_DIFFER] = {
        .characters = "dD",
        .name = "D",
        .label = "difference of A and B",
        .help = "show the differences of A and B, by FLIP from black to yellow, or the pictures",
    },
    [VIEW_DIVIDER_LEFT] = {
        .characters = "[",
        .repeats = true,
        .name = "[, ]",
        .label = "divider to the left, or right",
        .help = "move the divider between A and B to the left, or to the right",
    },
    [VIEW_DIVIDER_RIGHT] = { .characters = "]", .repeats = true, .label = "divider to the right" },
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
        .help = "show the time of each pass, or the settings",
        .button = "Passes",
    },
    [VIEW_PLAN] = {
        .characters = "gG",
        .name = "G",
        .label = "plan of the frame",
        .help = "show the compiled plan of the frame, or the settings",
        .button = "Plan",
    },
    [VIEW_LOOK] = {
        .characters = "iI",
        .name = "I",
        .label = "layers and values",
        .help = "show the layers, a histogram and the values below the cursor, or the settings",
        .button = "Look",
    },
    [VIEW_NEXT_LAYER] = {
        .characters = "l",
        .name = "L, Shift+L",
        .label = "show the next layer, or previous",
        .help = "show the next layer of the picture; after the last one the picture",
    },
    [VIEW_LAST_LAYER] = { .characters = "L", .label = "show the previous layer" },
    [VIEW_FALSE_COLORS] = {
        .characters = "zZ",
        .name = "Z",
        .label = "false colours",
        .help = "show the picture or layer in false colours, or as it is",
    },
    [VIEW_QUICK] = {
        .characters = "mM",
        .name = "M",
        .label = "movements as drafts, or in full",
        .help = "draw movements small and as drafts, so that they are fluid, or in full size and "
                "quality",
    },
    [VIEW_FULLSCREEN] = {
        .keys = { GLFW_KEY_F11 },
        .characters = "fF",
        .name = "F, F11",
        .label = "switch full screen on or off",
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
    [VIEW_USUAL_SIZE] = {
        .controlled = "0",
        .name = "Ctrl 0",
        .label = "first size of text and panels",
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
        .label = "keys",
        .help = "show or hide the list of keys, and print it",
        .button = "Keys",
    },
    [VIEW_QUIT] = {
        .characters = "qQ",
        .controlled = "q",
        .name = "Q, Ctrl Q",
        .label = "close the window",
    },
    [VIEW_DRAG] = { .name = "drag", .label = "orbit around the object" },
    [VIEW_SLIDE] = { .name = "right drag", .label = "move sideways (Shift, or middle)" },
    [VIEW_TURN_LIGHT] = { .name = "Ctrl drag", .label = "turn the light or the panorama" },
    [VIEW_MOVE_SUN] = { .name = "also Shift", .label = "Ctrl Shift drag: move the sun" },
    [VIEW_WHEEL] = { .name = "wheel", .label = "move closer or away" },
    [VIEW_AIM] = { .name = "double click", .label = "look at this point" },
    [VIEW_SEARCH] = { .name = "/", .label = "search for a setting" },
    [VIEW_PANEL_KEYS] = { .name = "F6, Esc", .label = "use the panel by keys, or not" },
    [VIEW_DROP] = { .name = "drop a file", .label = "model, picture, preset, session" },
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
    for (enum view_action a = VIEW_NOTHING; a < VIEW_ACTION_COUNT; a++) {
        const char *from = !press->control ? actions[a].characters
                           : shifted       ? actions[a].controlled_shifted
                                           : actions[a].controlled;
        if (is_in(from, press->character) || (!press->control && has_key(a, press->key)))
            return press->repeated && !actions[a].repeats ? VIEW_NOTHING : a;
    }
    return VIEW_NOTHING;
}

/* '+' is a shifted key on many keyboards, so Shift may be without a meaning. */
enum view_action keys_find(const struct key_press *press)
{
    const enum view_action action =
        press->control && press->shift ? find(press, true) : VIEW_NOTHING;
    return action != VIEW_NOTHING ? action : find(press, false);
}

const char *keys_name(enum view_action action)
{
    return actions[action].name;
}

const char *keys_label(enum view_action action)
{
    return actions[action].label;
}

const char *keys_help(enum view_action action)
{
    return actions[action].help ? actions[action].help : actions[action].label;
}

const char *keys_button(enum view_action action)
{
    return actions[action].button ? actions[action].button : actions[action].label;
}

/* The label, or with `all` the help. */
static bool find_row(uint32_t i, bool all, const char **name, const char **help)
{
    uint32_t count = 0;
    for (enum view_action a = VIEW_NOTHING; a < VIEW_DEED_COUNT; a++) {
        if (actions[a].name && count++ == i) {
            *name = actions[a].name;
            *help = all ? keys_help(a) : actions[a].label;
            return true;
        }
    }
    return false;
}

bool keys_row(uint32_t i, const char **name, const char **help)
{
    return find_row(i, false, name, help);
}

void keys_print(FILE *out)
{
    const char *name;
    const char *help;
    for (uint32_t i = 0; find_row(i, true, &name, &help); i++)
        fprintf(out, "  %-14s %s\n", name, help);
}
