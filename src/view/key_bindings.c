/* key_bindings.c: table of actions with their keyboard shortcuts, labels and help texts. */
#define GLFW_INCLUDE_NONE
#include "src/view/key_bindings.h"
#include <GLFW/glfw3.h>
#include <ctype.h>
#include <stddef.h>
#include <string.h>

const struct key_binding key_bindings[VIEW_INPUT_COUNT] = {
    [VIEW_LEFT] = { "Left", "orbit to the left", .repeats = true },
    [VIEW_RIGHT] = { "Right", "orbit to the right", .repeats = true },
    [VIEW_UP] = { "Up", "orbit upwards", .repeats = true },
    [VIEW_DOWN] = { "Down", "orbit downwards", .repeats = true },
    [VIEW_ZOOM_IN] = { "+", "zoom in", .repeats = true },
    [VIEW_ZOOM_OUT] = { "-", "zoom out", .repeats = true },
    [VIEW_RESET] = { "R, Home", "reset the camera" },
    [VIEW_FRONT] = { "1", "front view" },
    [VIEW_SIDE] = { "3", "right view" },
    [VIEW_TOP] = { "7", "top view" },
    [VIEW_ORTHOGRAPHIC] = { "5, O", "orthographic or perspective",
                            "switch between an orthographic and a perspective camera; a copied "
                            "command is always perspective" },
    [VIEW_BOOKMARK_1] = { "Ctrl 1", "camera of bookmark 1" },
    [VIEW_BOOKMARK_2] = { "Ctrl 2", "camera of bookmark 2" },
    [VIEW_BOOKMARK_3] = { "Ctrl 3", "camera of bookmark 3" },
    [VIEW_BOOKMARK_4] = { "Ctrl 4", "camera of bookmark 4" },
    [VIEW_ADD_BOOKMARK] = { "Ctrl B", "bookmark this camera",
                            "store the camera as the next of 4 bookmarks" },
    [VIEW_UNDO] = { "Ctrl Z", "undo the last change" },
    [VIEW_REDO] = { "Ctrl Shift Z, Ctrl Y", "redo the change undone last" },
    [VIEW_NEXT_FILE] = { "Page Down", "next model in the folder",
                         "open the next model in the folder, or the next built-in scene" },
    [VIEW_PREVIOUS_FILE] = { "Page Up", "previous model in the folder",
                             "open the previous model in the folder, or the previous built-in "
                             "scene" },
    [VIEW_SAVE_SESSION] = { "Ctrl S", "save the session",
                            "save scene, settings, camera, time and refraction model as a session "
                            "(--session) in ~/.local/share/firn/sessions" },
    [VIEW_SAVE_PRESET] = { "Ctrl Shift S", "save the settings as a preset",
                           "save the settings that differ from the defaults as a preset (--preset) "
                           "in ~/.local/share/firn/presets" },
    [VIEW_BRIGHTER] = { "E", "raise exposure by half a stop", .repeats = true },
    [VIEW_DARKER] = { "Shift E", "lower exposure by half a stop", .repeats = true },
    [VIEW_PAUSE] = { "Space", "play or pause" },
    [VIEW_STOP] = { "Esc", "stop or continue drawing samples",
                    "stop drawing samples of this view, or continue" },
    [VIEW_NEXT_FRAME] = { "full stop", "one frame later", .repeats = true },
    [VIEW_PREVIOUS_FRAME] = { "comma", "one frame earlier", .repeats = true },
    [VIEW_SCREENSHOT] = { "P, F12", "save the image",
                          "save the image as firn-0001.png and firn-0001.exr, with all samples and "
                          "layers, without panels" },
    [VIEW_COPY] = { "C", "copy the firn render command",
                    "copy the firn render command of this image (side A of a comparison) to the "
                    "clipboard, and print it to stdout" },
    [VIEW_COPY_IMAGE] = { "Ctrl C", "copy the image",
                          "copy the image, without panels, to the clipboard (needs wl-copy or "
                          "xclip)" },
    [VIEW_SPLIT] = { "W", "compare A and B side by side",
                     "switch between image A alone and images A and B on two sides of a draggable "
                     "divider; B is the stored state or, if none is stored, the most exact "
                     "refraction model" },
    [VIEW_REFERENCE] = { "Shift W", "compare with the reference",
                         "compare with the path-traced reference, which is rendered while the "
                         "image is at rest" },
    [VIEW_STORE] = { "S", "store the current state as B",
                     "store settings and refraction model as B, to compare later changes with "
                     "them" },
    [VIEW_FLIP] = { "T", "flip between A and B" },
    [VIEW_ERROR_MAP] = { "D", "difference of A and B",
                         "switch between the images and the difference of A and B (FLIP error, "
                         "from black to yellow)" },
    [VIEW_DIVIDER_LEFT] = { "[", "move the divider left", .repeats = true },
    [VIEW_DIVIDER_RIGHT] = { "]", "move the divider right", .repeats = true },
    [VIEW_HIDE] = { "Tab, H", "hide or show the panels" },
    [VIEW_TIMES] = { "B", "time of each pass",
                     "switch between the settings and the time of each pass" },
    [VIEW_INSPECT] = { "I", "layers and pixel values",
                       "switch between the settings and the layers, histogram and values below "
                       "the cursor" },
    [VIEW_NEXT_LAYER] = { "L", "next layer of the image" },
    [VIEW_PREVIOUS_LAYER] = { "Shift L", "previous layer of the image" },
    [VIEW_FALSE_COLORS] = { "Z", "false colours" },
    [VIEW_DRAFT] = { "M", "draft or full quality in motion",
                     "switch between fast drafts at lower resolution and full quality while "
                     "something moves" },
    [VIEW_FULLSCREEN] = { "F, F11", "full screen on or off" },
    [VIEW_LARGER] = { "Ctrl +", "enlarge text and panels" },
    [VIEW_SMALLER] = { "Ctrl -", "shrink text and panels" },
    [VIEW_RESET_SIZE] = { "Ctrl 0", "reset size of text and panels" },
    [VIEW_THEME] = { "Ctrl T", "dark or light theme" },
    [VIEW_PALETTE] = { "Ctrl K", "find an action or a setting" },
    [VIEW_HELP] = { "F1, ?", "keyboard shortcuts",
                    "show or hide the keyboard shortcuts, and print them" },
    [VIEW_QUIT] = { "Q, Ctrl Q", "close the window" },
    [VIEW_DRAG] = { "drag", "orbit around the object" },
    [VIEW_PAN] = { "right drag", "pan (also Shift or middle drag)" },
    [VIEW_ROTATE_LIGHT] = { "Ctrl drag", "rotate the light or panorama" },
    [VIEW_MOVE_SUN] = { "Ctrl Shift drag", "move the sun" },
    [VIEW_WHEEL] = { "wheel", "zoom" },
    [VIEW_CENTRE] = { "double click", "centre the view on this point" },
    [VIEW_SEARCH] = { "/", "search for a setting" },
    [VIEW_PANEL_KEYS] = { "F6, Esc", "focus the panel, or leave it" },
    [VIEW_DROP] = { "drop a file", "model, image, preset, session" },
};

/* Keys that have a name in the table: GLFW key codes, and characters below 128. */
static const struct {
    const char *name;
    int code;
} named_keys[] = {
    { "Left", GLFW_KEY_LEFT },
    { "Right", GLFW_KEY_RIGHT },
    { "Up", GLFW_KEY_UP },
    { "Down", GLFW_KEY_DOWN },
    { "Page Up", GLFW_KEY_PAGE_UP },
    { "Page Down", GLFW_KEY_PAGE_DOWN },
    { "Home", GLFW_KEY_HOME },
    { "Tab", GLFW_KEY_TAB },
    { "Esc", GLFW_KEY_ESCAPE },
    { "F1", GLFW_KEY_F1 },
    { "F11", GLFW_KEY_F11 },
    { "F12", GLFW_KEY_F12 },
    { "Space", ' ' },
    { "comma", ',' },
    { "full stop", '.' },
};

static int find_code(const char *name, size_t length)
{
    for (size_t i = 0; i < sizeof(named_keys) / sizeof(named_keys[0]); i++) {
        if (strlen(named_keys[i].name) == length && !strncmp(named_keys[i].name, name, length))
            return named_keys[i].code;
    }
    return length == 1 ? tolower((unsigned char)*name) : 0;
}

static bool skip(const char **text, const char *prefix)
{
    const bool found = !strncmp(*text, prefix, strlen(prefix));
    *text += found ? strlen(prefix) : 0;
    return found;
}

/* Returns true if a shortcut of the table, such as "Ctrl Shift Z", was pressed. Letters and signs
 * are compared by typed character, because their key codes depend on the keyboard layout. */
static bool is_pressed(const char *text, size_t length, const struct key_press *press, bool shift)
{
    const char *end = text + length;
    const bool needs_control = skip(&text, "Ctrl ");
    const bool needs_shift = skip(&text, "Shift ");
    const int code = find_code(text, (size_t)(end - text));
    const unsigned typed = press->character == '=' ? '+' : press->character; /* on the same key */
    if (!code || needs_control != press->control || needs_shift != shift)
        return false;
    return code < 128 ? typed < 128 && tolower((int)typed) == code : press->key == code;
}

static enum view_action find(const struct key_press *press, bool shift)
{
    for (enum view_action a = VIEW_ACTION_NONE + 1; a < VIEW_ACTION_COUNT; a++) {
        const char *at = key_bindings[a].keys;
        while (at) {
            const char *next = strstr(at, ", ");
            const size_t length = next ? (size_t)(next - at) : strlen(at);
            if (is_pressed(at, length, press, shift))
                return press->repeated && !key_bindings[a].repeats ? VIEW_ACTION_NONE : a;
            at = next ? next + 2 : NULL;
        }
    }
    return VIEW_ACTION_NONE;
}

/* Ignores Shift if no shortcut requires it, because '+' needs Shift on many keyboards. */
enum view_action key_bindings_find(const struct key_press *press)
{
    const bool is_upper = press->character < 128 && isupper((int)press->character);
    const enum view_action action = press->shift || is_upper ? find(press, true) : VIEW_ACTION_NONE;
    return action != VIEW_ACTION_NONE ? action : find(press, false);
}

const char *key_bindings_help(enum view_action action)
{
    return key_bindings[action].help ? key_bindings[action].help : key_bindings[action].label;
}

void key_bindings_print(FILE *out)
{
    for (enum view_action a = VIEW_ACTION_NONE + 1; a < VIEW_INPUT_COUNT; a++)
        fprintf(out, "  %-20s %s\n", key_bindings[a].keys, key_bindings_help(a));
}
