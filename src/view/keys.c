/* keys.c: the table of keys. */
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
    int keys[KEYS_MAX]; /* 0: none */
    const char *characters;
    bool repeats;
    const char *name, *help;
    const char *controlled; /* characters with Ctrl; NULL: none */
} actions[VIEW_ACTION_COUNT] = {
    [VIEW_NOTHING] = { .characters = "" },
    [VIEW_LEFT] = { { GLFW_KEY_LEFT }, "", true, "Left", "orbit to the left around the object" },
    [VIEW_RIGHT] = { { GLFW_KEY_RIGHT }, "", true, "Right", "orbit to the right" },
    [VIEW_UP] = { { GLFW_KEY_UP }, "", true, "Up", "orbit upwards" },
    [VIEW_DOWN] = { { GLFW_KEY_DOWN }, "", true, "Down", "orbit downwards" },
    [VIEW_NEARER] = { { GLFW_KEY_PAGE_UP }, "+=", true, "+, Page Up", "move closer" },
    [VIEW_FARTHER] = { { GLFW_KEY_PAGE_DOWN }, "-", true, "-, Page Down", "move away" },
    [VIEW_RESET] = { { GLFW_KEY_HOME }, "rR", false, "R, Home", "reset the camera" },
    [VIEW_PAUSE] = { { 0 }, " ", false, "Space", "pause or resume time" },
    [VIEW_SCREENSHOT] = { { GLFW_KEY_F12 },
                          "p",
                          false,
                          "P, F12",
                          "save the picture as firn-0001.png and firn-0001.exr" },
    [VIEW_FULLSCREEN] = { { GLFW_KEY_F11 }, "fF", false, "F, F11", "toggle full screen" },
    [VIEW_SPLIT] = { { 0 }, "sS", false, "S", "toggle the divider between two rungs" },
    [VIEW_DIVIDER_LEFT] = { { 0 }, "[", true, "[", "move the divider to the left" },
    [VIEW_DIVIDER_RIGHT] = { { 0 }, "]", true, "]", "move the divider to the right" },
    [VIEW_SHOT_OF_ALL] = { { 0 },
                           "P",
                           false,
                           "Shift+P",
                           "save only a PNG, as the window shows it, with panels" },
    [VIEW_HIDE] = { { 0 }, "hH", false, "H", "hide or show the panels" },
    [VIEW_TIMES] = { { 0 }, "tT", false, "T", "show or hide the time of each pass" },
    [VIEW_PLAN] = { { 0 }, "gG", false, "G", "show or hide the plan of the frame" },
    [VIEW_COPY] = { { 0 },
                    "cC",
                    false,
                    "C",
                    "copy and print the command that renders this picture" },
    [VIEW_HELP] = { { GLFW_KEY_F1 }, "?", false, "F1, ?", "show or hide this list, and print it" },
    [VIEW_LARGER] = { { 0 }, "", false, "Ctrl++", "enlarge text and panels", "+=" },
    [VIEW_SMALLER] = { { 0 }, "", false, "Ctrl+-", "shrink text and panels", "-" },
    [VIEW_USUAL_SIZE] = { { 0 }, "", false, "Ctrl+0", "text and panels as large as at first", "0" },
    [VIEW_QUIT] = { { GLFW_KEY_ESCAPE }, "qQ", false, "Esc, Q", "close the window" },
};

static const struct {
    const char *name, *help;
} gestures[] = {
    { "left drag", "orbit around the object, or move the divider" },
    { "right drag", "move sideways, as Shift + left drag" },
    { "wheel", "move closer or away" },
    { "/", "search for a setting" },
    { "Tab", "navigate the panel by keys, until Esc" },
    { "drop a file", "open a model, or use an .exr or .hdr as the environment" },
};

static bool has_key(enum view_action action, int key)
{
    for (size_t k = 0; k < KEYS_MAX && key; k++) {
        if (actions[action].keys[k] == key)
            return true;
    }
    return false;
}

static bool is_typed(enum view_action action, const struct key_press *press)
{
    const char *from = press->control ? actions[action].controlled : actions[action].characters;
    return from && press->character && press->character < 128 &&
           strchr(from, (int)press->character);
}

enum view_action keys_find(const struct key_press *press)
{
    for (enum view_action a = VIEW_NOTHING; a < VIEW_ACTION_COUNT; a++) {
        if (is_typed(a, press) || (!press->control && has_key(a, press->key)))
            return press->repeated && !actions[a].repeats ? VIEW_NOTHING : a;
    }
    return VIEW_NOTHING;
}

bool keys_row(uint32_t i, const char **name, const char **help)
{
    uint32_t count = 0;
    for (enum view_action a = VIEW_NOTHING; a < VIEW_ACTION_COUNT; a++) {
        if (actions[a].name && count++ == i) {
            *name = actions[a].name;
            *help = actions[a].help;
            return true;
        }
    }
    if (i - count >= sizeof(gestures) / sizeof(gestures[0]))
        return false;
    *name = gestures[i - count].name;
    *help = gestures[i - count].help;
    return true;
}

void keys_print(FILE *out)
{
    const char *name;
    const char *help;
    for (uint32_t i = 0; keys_row(i, &name, &help); i++)
        fprintf(out, "  %-14s %s\n", name, help);
}
