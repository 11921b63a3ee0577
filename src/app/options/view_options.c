/* view_options.c: setters of the options of firn view. */
#include "src/app/options/view_options.h"
#include <string.h>
#include "src/app/options/option_values.h"

const char *const app_themes[] = { "dark", "light", NULL };

enum status option_present(const struct option *option, void *at, const char *value)
{
    struct setup_window *view = at;
    return gpu_swapchain_mode_find(value, &view->present)
               ? STATUS_OK
               : option_refuse(option, value, "fifo, mailbox or immediate");
}

enum status option_split(const struct option *option, void *at, const char *value)
{
    struct setup_image *image = at;
    image->split = techniques_find_refraction(value);
    return image->split
               ? STATUS_OK
               : option_refuse_name(option, OPTION_REFRACTION_MODELS, value, strlen(value));
}

enum status option_watch(const struct option *option, void *at, const char *value)
{
    struct setup_window *view = at;
    (void)option;
    view->watch = value ? value : "shaders";
    return STATUS_OK;
}

enum status option_overlay(const struct option *option, void *at, const char *value)
{
    struct setup_window *view = at;
    if (strcmp(value, "on") != 0 && strcmp(value, "off") != 0)
        return option_refuse(option, value, "on or off");
    view->overlay = value[1] == 'n' ? SETUP_OVERLAY_ON : SETUP_OVERLAY_OFF;
    return STATUS_OK;
}

enum status option_ui_scale(const struct option *option, void *at, const char *value)
{
    struct setup_window *view = at;
    float scale;
    if (!option_parse_numbers(value, ',', &scale, 1) || scale < SETUP_UI_SCALE_MIN ||
        scale > SETUP_UI_SCALE_MAX)
        return option_refuse(option, value, "a factor from 0.5 to 4");
    view->ui_scale = scale;
    return STATUS_OK;
}

enum status option_theme(const struct option *option, void *at, const char *value)
{
    struct setup_window *view = at;
    const int found = option_find_word(app_themes, 2, value);
    if (found < 0)
        return option_refuse(option, value, "dark or light");
    view->theme = (uint32_t)found;
    return STATUS_OK;
}
